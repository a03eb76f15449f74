#include <gtest/gtest.h>

#include <thread>

#include "film/jobs/render_job.h"

namespace petrichor::film {
namespace {

gpu::DeviceInfo device(const char* kind)
{
    gpu::DeviceInfo info;
    info.kind = kind;
    return info;
}

TEST(FramesInFlight, AreOneOnAGpuAndForFewPictures)
{
    EXPECT_EQ(frames_in_flight(device("discrete"), 0, 100), 1);
    EXPECT_EQ(frames_in_flight(device("cpu"), 1, 100), 1);
    for (const std::size_t few : {0u, 1u, 7u}) EXPECT_EQ(frames_in_flight(device("cpu"), 0, few), 1);
}

TEST(FramesInFlight, GrowWithThreadsAndPicturesToFour)
{
    const auto cores = static_cast<int>(std::thread::hardware_concurrency());
    if (cores < 2) {
        EXPECT_EQ(frames_in_flight(device("cpu"), 0, 100), 1);
        return;
    }
    int before = 2;
    for (int threads = 2; threads <= cores; ++threads) {
        const int now = frames_in_flight(device("cpu"), threads, 1000);
        EXPECT_GE(now, before);
        EXPECT_LE(now, 4);
        EXPECT_LE(now, threads);
        before = now;
    }
    EXPECT_EQ(frames_in_flight(device("cpu"), 0, 8), 2);
}

}  // namespace
}  // namespace petrichor::film
