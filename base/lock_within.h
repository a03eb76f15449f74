#ifndef PETRICHOR_BASE_LOCK_WITHIN_H
#define PETRICHOR_BASE_LOCK_WITHIN_H

#include <chrono>
#include <mutex>
#include <thread>

namespace petrichor {

/// Tries for a mutex until it has it or the time is over; the lock says which. Asked for again and
/// again instead of by the clock of a timed mutex, which the thread sanitizer does not know.
inline std::unique_lock<std::mutex> lock_within(std::mutex& mutex, std::chrono::milliseconds time)
{
    const auto end = std::chrono::steady_clock::now() + time;
    std::unique_lock lock(mutex, std::try_to_lock);
    while (!lock && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (lock.try_lock()) break;
    }
    return lock;
}

}  // namespace petrichor

#endif
