#include "film/jobs/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "formulas/light/exposure.h"

namespace petrichor::film {
namespace {

Sequence sequence_of(const std::string& text)
{
    Sequence sequence = make_sequence(parse_scenario(text, "s.toml"));
    sequence.framing.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    sequence.content = "content";
    return sequence;
}

TEST(ExposureFormula, AStopHalvesTheScaleAndTheMeterIsThatOfCameras)
{
    for (float ev = -8.0f; ev < 20.0f; ev += 0.5f) {
        EXPECT_NEAR(shared::exposure_of_ev100(ev + 1.0f) / shared::exposure_of_ev100(ev), 0.5f,
                    1e-6f);
    }
    EXPECT_NEAR(shared::ev100_of_luminance(4096.0f), 15.0f, 1e-5f);  // sunlit: sunny 16
    EXPECT_NEAR(shared::exposure_of_ev100(0.0f) * 1.2f, 1.0f, 1e-6f);
}

TEST(ExposureFormula, DayIsPlacedHalfAStopBelowGreyAndNightStaysDarker)
{
    const auto shown = [](float luminance) {  // share of white that a metered luminance becomes
        const float ev = shared::metered_setting(shared::ev100_of_luminance(luminance));
        return luminance * shared::exposure_of_ev100(ev);
    };
    EXPECT_NEAR(shown(4000.0f), 0.125f, 0.0005f);
    EXPECT_NEAR(shown(129.0f), 0.125f, 0.001f);
    float before = 1.0f;
    for (float luminance = 1e5f; luminance > 1e-5f; luminance *= 0.5f) {
        EXPECT_LE(shown(luminance), before + 1e-4f);
        EXPECT_GE(shown(luminance), 0.125f / 8.1f);
        before = shown(luminance);
    }
    EXPECT_NEAR(shown(std::exp2(-5.0f)), 0.125f / 8.0f, 0.001f);
    float last = -1e9f;
    for (float ev = -12.0f; ev < 20.0f; ev += 0.1f) {
        EXPECT_GT(shared::metered_setting(ev), last);
        last = shared::metered_setting(ev);
    }
}

TEST(MeteredJobs, AreTheFramesAroundWithWeightsOfOne)
{
    const Sequence sequence = sequence_of("[output]\nframes = 40\nfps = 12\n");
    const auto jobs = metered_jobs(sequence, {20});
    // A quarter of a second is three frames; every other one is metered.
    ASSERT_EQ(jobs.size(), 3u);
    double sum = 0.0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        EXPECT_EQ(jobs[i].job.frame, 18 + 2 * static_cast<int>(i));
        EXPECT_NEAR(jobs[i].weight, jobs[jobs.size() - 1 - i].weight, 1e-12);
        EXPECT_LE(jobs[i].weight, jobs[1].weight);
        sum += jobs[i].weight;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_EQ(metered_jobs(sequence, {0}).front().job.frame, 0) << "not before the first";
    EXPECT_EQ(metered_jobs(sequence, {0}).size(), 2u);
    EXPECT_EQ(metered_jobs(sequence, {21}).size(), 4u) << "18, 20, 22 and 24";
    EXPECT_EQ(metered_jobs(sequence, {39}).back().job.frame, 38);
    EXPECT_EQ(metered_jobs(sequence_of("[camera]\nexposure_smoothing_s = 0\n"), {5}).size(), 1u);
    for (const char* other : {"exposure = \"incident\"", "exposure = 0.001",
                              "exposure = \"fixed\"\nev100 = 12", "ev100 = 12"}) {
        const Sequence fixed = sequence_of(std::string("[camera]\n") + other + "\n");
        EXPECT_TRUE(metered_jobs(fixed, {5}).empty()) << other;
    }
}

TEST(MeteredJobs, AFewPicturesOfALongTimeAreExposedEachForItself)
{
    for (const int frames : {1, 2, 7}) {
        const Sequence few = sequence_of("[output]\nfps = 24\nframes = " + std::to_string(frames) + "\n");
        for (int frame = 0; frame < frames; ++frame)
            EXPECT_EQ(metered_jobs(few, {frame}).size(), 1u) << frame << " of " << frames;
    }
    const Sequence film = sequence_of("[output]\nfps = 24\nframes = 48\n");
    EXPECT_GT(metered_jobs(film, {20}).size(), 2u);
    // By the clock of a weather file: twenty minutes a frame leave one neighbour, an hour none.
    Sequence timed = film;
    for (const double minutes : {1.0, 20.0, 60.0}) {
        const double us_a_frame = minutes * 60e6;
        timed.variants[0].weather.utc_us = [&, us_a_frame](double time_s) {
            return static_cast<std::int64_t>(time_s / (frame_time_s(timed, 1) - frame_time_s(timed, 0)) * us_a_frame);
        };
        const auto jobs = metered_jobs(timed, {20});
        for (const MeteredJob& one : jobs) EXPECT_LE(std::abs(one.job.frame - 20) * minutes, 30.0);
        EXPECT_EQ(jobs.size() == 1, minutes == 60.0) << minutes;
    }
}

TEST(MeteredJobs, SayWhereLessIsSmoothedThanAsked)
{
    const auto notes = [](const char* text) { return smoothing_notes(sequence_of(text)); };
    const auto short_film = notes("[camera]\nexposure_smoothing_s = 2\n[output]\nfps = 24\nframes = 48\n");
    ASSERT_EQ(short_film.size(), 1u);
    EXPECT_NE(short_film[0].find("6 frames on each side, not the 48"), std::string::npos) << short_film[0];
    EXPECT_TRUE(notes("[camera]\nexposure_smoothing_s = 2\n[output]\nfps = 24\nframes = 480\n").empty());
    EXPECT_TRUE(notes("[output]\nfps = 24\nframes = 2\n").empty()) << "nobody asked";
}

TEST(MeteredJobs, SpreadAStepOfLightOverManyFrames)
{
    const Sequence sequence = sequence_of("[output]\nframes = 40\nfps = 12\n");
    const ScenarioCamera& camera = sequence.views[0].camera;
    double before = 0.0;
    double largest = 0.0;
    for (int frame = 0; frame < 40; ++frame) {
        const auto jobs = metered_jobs(sequence, {frame});
        std::vector<gpu::MeterReading> ev100;
        for (const MeteredJob& one : jobs) ev100.push_back({one.job.frame < 20 ? 12.0f : 4.0f, {}});
        const double now = metered_setting(camera, jobs, ev100).ev100;
        if (frame > 0) largest = std::max(largest, std::abs(now - before));
        before = now;
    }
    EXPECT_GT(largest, 0.5);
    EXPECT_LT(largest, 2.1) << "eight stops in one frame become two a frame at most";
}

TEST(MeteredSetting, StaysWithinTheLimitsAndLeavesBlackFramesOut)
{
    const Sequence sequence =
        sequence_of("[camera]\nev100_limits = [2, 11]\n[output]\nfps = 12\nframes = 9\n");
    const ScenarioCamera& camera = sequence.views[0].camera;
    const auto jobs = metered_jobs(sequence, {4});
    using Many = std::vector<gpu::MeterReading>;
    EXPECT_EQ(metered_setting(camera, jobs, Many(jobs.size(), {15.0f, {}})).ev100, 11.0);
    EXPECT_EQ(metered_setting(camera, jobs, Many(jobs.size(), {-9.0f, {}})).ev100, 2.0);
    EXPECT_EQ(metered_setting(camera, jobs, Many(jobs.size())).ev100, 2.0);
    EXPECT_FALSE(metered_setting(camera, jobs, Many(jobs.size())).metered_ev100);
    Many some(jobs.size());
    some[0].ev100 = 8.0f;
    EXPECT_NEAR(*metered_setting(camera, jobs, some).metered_ev100, 8.0, 1e-9);
}

TEST(MeteredWhite, IsTheMeanOfTheFramesAroundWhoeverDecidesTheExposure)
{
    for (const char* exposure : {"", "exposure = \"incident\"\n", "ev100 = 12\n"}) {
        const Sequence sequence =
            sequence_of(std::string("[camera]\nwhite_balance_k = \"auto\"\n") + exposure + "[output]\nframes = 40\nfps = 12\n");
        const auto jobs = metered_jobs(sequence, {20});
        ASSERT_GT(jobs.size(), 2u) << exposure;
        std::vector<gpu::MeterReading> readings;
        for (const MeteredJob& one : jobs) {
            readings.push_back({{}, one.job.frame < 20 ? glm::vec3(0.5f, 1.0f, 2.0f) : glm::vec3(2.0f, 1.0f, 0.5f)});
        }
        const glm::vec3 white = metered_white(jobs, readings);
        EXPECT_GT(white.x, white.z) << "the frame itself is among the later ones";
        EXPECT_GT(white.z, 0.6f);
        EXPECT_NEAR(white.y, 1.0f, 1e-6f);
        readings.assign(jobs.size(), {});
        EXPECT_EQ(metered_white(jobs, readings), glm::vec3(0.0f));
        EXPECT_FLOAT_EQ(frame_at(sequence, {20}).frame.settings.white_share, 0.8f);
    }
    EXPECT_TRUE(metered_jobs(sequence_of("[camera]\nwhite_balance_k = 5000\nev100 = 12\n"), {5}).empty());
}

TEST(MeteredWhite, OfAScenarioIsAutoOrANumber)
{
    for (const char* wrong : {"white_balance_k = \"warm\"", "white_balance_k = -5", "white_balance_strength = 0.5",
                              "white_balance_k = 5000\nwhite_balance_strength = 0.5",
                              "white_balance_k = \"auto\"\nwhite_balance_strength = 1.5"}) {
        EXPECT_THROW(sequence_of(std::string("[camera]\n") + wrong + "\n"), Error) << wrong;
    }
}

TEST(FixedExposure, IsANumberOrAnEv100OverTime)
{
    const Sequence by_ev = sequence_of(
        "[camera]\nexposure = \"fixed\"\nev100 = [[0, 10], [10, 12]]\ninterpolation = "
        "\"linear\"\n");
    EXPECT_NEAR(fixed_exposure(by_ev.views[0].camera, 5.0), 1.0 / (1.2 * 2048.0), 1e-9);
    const Sequence by_number = sequence_of("[camera]\nexposure = 0.25\n");
    EXPECT_FLOAT_EQ(frame_at(by_number, {3}).frame.settings.exposure, 0.25f);
    EXPECT_EQ(frame_at(sequence_of(""), {3}).frame.settings.exposure, 0.0f) << "not known yet";
}

TEST(ExposureKeys, AreRefusedWhereTheyMeanNothing)
{
    for (const char* bad :
         {"exposure = \"fixed\"", "exposure = \"auto\"\nev100 = 12", "exposure = 0.1\nev100 = 12",
          "exposure = \"bright\"", "exposure = true", "ev100_limits = [5, 2]", "ev100_limits = [5]",
          "exposure_smoothing_s = -1", "exposure = \"fixed\"\nev100 = nan"}) {
        EXPECT_THROW(parse_scenario(std::string("[camera]\n") + bad + "\n", "s.toml"), Error)
            << bad;
    }
}

TEST(FrameFingerprint, KnowsTheFramesThatAreMetered)
{
    const auto print = [](const std::string& text) {
        const Sequence sequence = sequence_of(text +
                                              "[output]\nframes = 12\nfps = 12\n"
                                              "duration_s = 12\n");
        return fingerprint_of(frame_parts(sequence, frame_at(sequence, {5})));
    };
    // Frame 5 itself is the same; the sun of frame 7 is not.
    const std::string early = "[sun]\nelevation_degrees = [[0, 30], [5.5, 30], [7, 30]]\n";
    const std::string later = "[sun]\nelevation_degrees = [[0, 30], [5.5, 30], [7, 10]]\n";
    EXPECT_NE(print(early), print(later));
    const std::string alone = "[camera]\nexposure_smoothing_s = 0\n";
    EXPECT_EQ(print(alone + early), print(alone + later));
    EXPECT_NE(print(early + "[camera]\nev100_limits = [0, 9]\n"), print(early));
    EXPECT_NE(print(early + "[camera]\nexposure = \"incident\"\n"), print(early));
}

}  // namespace
}  // namespace petrichor::film
