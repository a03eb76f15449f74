#include "base/ordered_work.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace petrichor {
namespace {

void nothing(std::size_t, std::size_t) {}

std::vector<std::size_t> first(std::size_t count)
{
    std::vector<std::size_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

TEST(OrderedWork, BeginAndFinishInOrderHoweverLongItTakes)
{
    for (const std::size_t workers : {1u, 2u, 5u}) {
        std::vector<std::size_t> begun, finished;
        std::vector<std::atomic<int>> made(40);
        run_ordered(workers, made.size(), {},
                  {[&](std::size_t, std::size_t i) { begun.push_back(i); },
                   [&](std::size_t worker, std::size_t i) {
                       EXPECT_LT(worker, workers);
                       if (i % 3 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
                       ++made[i];
                   },
                   [&](std::size_t, std::size_t i) {
                       EXPECT_EQ(made[i], 1);
                       finished.push_back(i);
                   }});
        EXPECT_EQ(begun, first(40));
        EXPECT_EQ(finished, first(40));
    }
}

TEST(OrderedWork, WorkAtTheSameTime)
{
    // Each waits for the other: one worker after the other would never end.
    std::atomic<int> there{0};
    run_ordered(2, 2, {}, {nothing, [&](std::size_t, std::size_t) {
                             ++there;
                             while (there < 2) std::this_thread::yield();
                         }, nothing});
    EXPECT_EQ(there, 2);
}

TEST(OrderedWork, FinishWhatComesBeforeAFailureAndThrowIt)
{
    for (const int where : {0, 1, 2}) {
        for (const std::size_t workers : {1u, 3u}) {
            std::vector<std::size_t> finished;
            const auto step = [&](int here) {
                return [&, here](std::size_t, std::size_t i) {
                    if (here == where && (i == 7 || i == 9))
                        throw std::runtime_error(std::to_string(i));
                    if (here == 1 && i == 6) std::this_thread::sleep_for(std::chrono::milliseconds(5));
                    if (here == 2) finished.push_back(i);
                };
            };
            try {
                run_ordered(workers, 20, {}, {step(0), step(1), step(2)});
                FAIL() << "nothing was thrown";
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), "7");
            }
            EXPECT_EQ(finished, first(7));
        }
    }
}

TEST(OrderedWork, AfterAStopWhatWasBegunIsFinished)
{
    std::atomic<bool> stop{false};
    std::size_t begun = 0, finished = 0;
    run_ordered(3, 100, [&] { return stop.load(); },
              {[&](std::size_t, std::size_t) { ++begun; },
               [&](std::size_t, std::size_t i) {
                   if (i == 10) stop = true;
               },
               [&](std::size_t, std::size_t) { ++finished; }});
    EXPECT_EQ(begun, finished);
    EXPECT_GE(begun, 11u);
    EXPECT_LT(begun, 100u);
}

TEST(OrderedWork, OfNothingDoNothing)
{
    run_ordered(2, 0, {}, {nothing, nothing, nothing});
    run_ordered(2, 5, [] { return true; },
              {[](std::size_t, std::size_t) { FAIL(); }, nothing, nothing});
}

}  // namespace
}  // namespace petrichor
