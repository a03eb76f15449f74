#include "base/ordered_work.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace petrichor {
namespace {

class Workers {
public:
    Workers(std::size_t count, const StopRequest& stop, const OrderedWork& work)
        : count_(count), stop_(stop), work_(work)
    {
    }

    void run(std::size_t worker)
    {
        for (std::size_t item = 0; begin(worker, item);) {
            try {
                work_.make(worker, item);
            } catch (...) {
                fail(item);
                return;
            }
            if (!finish(worker, item)) return;
        }
    }

    void rethrow() const
    {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    bool begin(std::size_t worker, std::size_t& item)
    {
        const std::lock_guard lock(begin_mutex_);
        if (next_ >= count_ || failed() || (stop_ && stop_())) return false;
        item = next_++;
        try {
            work_.begin(worker, item);
        } catch (...) {
            fail(item);
            return false;
        }
        return true;
    }

    bool finish(std::size_t worker, std::size_t item)
    {
        std::unique_lock lock(finish_mutex_);
        turn_came_.wait(lock, [&] { return turn_ == item || failed_ < item; });
        if (failed_ < item) return false;
        try {
            work_.finish(worker, item);
        } catch (...) {
            fail_locked(item);
            return false;
        }
        ++turn_;
        turn_came_.notify_all();
        return true;
    }

    bool failed()
    {
        const std::lock_guard lock(finish_mutex_);
        return failed_ != kNone;
    }

    void fail(std::size_t item)
    {
        const std::lock_guard lock(finish_mutex_);
        fail_locked(item);
    }

    void fail_locked(std::size_t item)
    {
        if (item < failed_) {
            failed_ = item;
            failure_ = std::current_exception();
        }
        turn_came_.notify_all();
    }

    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const std::size_t count_;
    const StopRequest& stop_;
    const OrderedWork& work_;
    std::mutex begin_mutex_;
    std::size_t next_ = 0;
    std::mutex finish_mutex_;  // taken after begin_mutex_ where both are
    std::condition_variable turn_came_;
    std::size_t turn_ = 0;
    std::size_t failed_ = kNone;
    std::exception_ptr failure_;
};

}  // namespace

void run_ordered(std::size_t workers, std::size_t count, const StopRequest& stop, const OrderedWork& work)
{
    Workers state(count, stop, work);
    workers = std::min(workers, count);
    std::vector<std::thread> others;
    try {
        for (std::size_t worker = 1; worker < workers; ++worker)
            others.emplace_back([&state, worker] { state.run(worker); });
    } catch (const std::system_error&) {
        // No more threads: those that are there do it.
    }
    state.run(0);
    for (std::thread& thread : others) thread.join();
    state.rethrow();
}

}  // namespace petrichor
