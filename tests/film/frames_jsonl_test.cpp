#include "film/frames/frames_jsonl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing_program::read_file;
namespace fs = std::filesystem;
using testing_program::Workplace;
using testing_program::write_file;

FrameFacts facts_of(int frame, const std::string& camera)
{
    FrameFacts facts;
    facts.job.frame = frame;
    facts.made_from = {{"camera", camera}};
    facts.files = {{"frame.png", {3, "0a"}}};
    facts.input.weather.rain = 0.1f;
    return facts;
}

TEST(FramesJsonl, LinesComeBackAndStayInOrder)
{
    const Workplace place("jsonl");
    merge_frame_lines(place.path(),
                      {{{7}, frame_line(facts_of(7, "a"))}, {{2}, frame_line(facts_of(2, "a"))}});
    merge_frame_lines(place.path(),
                      {{{5}, frame_line(facts_of(5, "b"))}, {{7}, frame_line(facts_of(7, "c"))}});
    const auto records = read_frame_records(place.path());
    ASSERT_EQ(records.size(), 3u);
    EXPECT_EQ(records.at({2}).made_from, (FrameParts{{"camera", "a"}}));
    EXPECT_EQ(records.at({7}).made_from, (FrameParts{{"camera", "c"}}));
    EXPECT_EQ(records.at({7}).files.at("frame.png").bytes, 3u);
    EXPECT_EQ(read_file(place / "frames.jsonl"), frame_line(facts_of(2, "a")) + "\n" +
                                                     frame_line(facts_of(5, "b")) + "\n" +
                                                     frame_line(facts_of(7, "c")) + "\n");
}

TEST(FramesJsonl, NumbersAreShortAndThereIsNoClock)
{
    const std::string line = frame_line(facts_of(1, "a"));
    EXPECT_THAT(line, testing::HasSubstr("\"rain\":0.1,"));
    EXPECT_EQ(line, frame_line(facts_of(1, "a")));
}

TEST(FramesJsonl, SayWhatFallsAndWhatOfItIsDrawn)
{
    FrameFacts facts = facts_of(1, "a");
    EXPECT_THAT(frame_line(facts), testing::Not(testing::HasSubstr("falling\":{")));
    facts.falling = {.drawn = 300, .seen = 5000.2, .per_m3 = 12.5f, .extinction_per_m = 0.001f,
                     .drawn_reach_m = 3.5f, .visibility_m = 800.0f};
    EXPECT_THAT(frame_line(facts),
                testing::HasSubstr("\"falling\":{\"drawn\":300,\"extinguished\":4700.0,"
                                   "\"per_m3\":12.5,\"extinction_per_m\":0.001,"
                                   "\"drawn_reach_m\":3.5,\"visibility_m\":800.0}"));
}

TEST(FramesJsonl, SayWhatLightsTheScene)
{
    FrameFacts facts = facts_of(1, "a");
    EXPECT_THAT(frame_line(facts), testing::HasSubstr("\"light\":{\"lamps\":0,\"glowing\":0}"));
    facts.light = {.direct = gpu::LightFacts::Direct::Moon, .towards = {0.0f, 1.0f, 0.0f},
                   .lux = glm::vec3(0.25f), .lamps = 3, .glowing = 1};
    EXPECT_THAT(frame_line(facts),
                testing::HasSubstr("\"light\":{\"lamps\":3,\"glowing\":1,\"direct\":{\"of\":\"moon\","
                                   "\"towards\":[0.0,1.0,0.0],\"illuminance_lux\":0.25,"
                                   "\"rgb_lux\":[0.25,0.25,0.25]}}"));
}

TEST(FramesJsonl, SayHowAFrameIsExposed)
{
    FrameFacts facts = facts_of(1, "a");
    facts.exposure = 1.0f / (1.2f * 1024.0f);
    EXPECT_THAT(frame_line(facts), testing::HasSubstr("\"exposure_mode\":\"fixed\",\"ev100\":10."));
    EXPECT_THAT(frame_line(facts), testing::Not(testing::HasSubstr("metered_ev100")));
    facts.exposure_by = {"auto", 9.5f, glm::vec3(1.25f, 1.0f, 0.5f)};
    EXPECT_THAT(frame_line(facts), testing::HasSubstr("\"metered_ev100\":9.5,"));
    EXPECT_THAT(frame_line(facts), testing::HasSubstr("\"white_balance\":{\"light_rgb\":[1.25,1.0,0.5],\"share\":1.0}"));
}

// A point of the world is where the line's numbers and its formula put it: where the renderer draws it.
TEST(FramesJsonl, ACamerasNumbersFindAPointInThePicture)
{
    for (const auto& [height_m, shift] : {std::pair{0.0f, glm::vec2(0.0f)}, {6.0f, glm::vec2(0.0f)},
                                          {0.0f, glm::vec2(0.3f, -0.7f)}, {6.0f, glm::vec2(-0.4f, 0.9f)}}) {
        FrameFacts facts = facts_of(1, "a");
        facts.input.settings.width = 320;
        facts.input.settings.height = 200;
        scene::Camera& camera = facts.input.camera;
        camera.to_world = glm::inverse(glm::lookAt(glm::vec3(3, 2, 5), glm::vec3(0.5f, 1, 0), glm::vec3(0, 1, 0)));
        camera.orthographic_height_m = height_m;
        camera.shift = shift;
        const nlohmann::json line = nlohmann::json::parse(frame_line(facts)).at("camera");
        const glm::vec4 point(0.2f, 0.4f, -0.7f, 1.0f);
        double at[3];
        for (std::size_t row = 0; row < 3; ++row) {
            at[row] = 0.0;
            for (std::size_t i = 0; i < 4; ++i)
                at[row] += line.at("view").at(row).at(i).get<double>() * static_cast<double>(point[static_cast<int>(i)]);
        }
        const bool parallel = height_m > 0.0f;
        EXPECT_THAT(line.at("conventions").get<std::string>(),
                    testing::HasSubstr(parallel ? "u = cx + fx x, v = cy - fy y," : "u = cx + fx x / -z, v = cy - fy y / -z"));
        const auto& k = line.at("intrinsics");
        const double away = parallel ? 1.0 : -at[2];
        const double u = k.at("cx").get<double>() + k.at("fx").get<double>() * at[0] / away;
        const double v = k.at("cy").get<double>() - k.at("fy").get<double>() * at[1] / away;
        const glm::vec4 clip = scene::clip_projection(camera, 320, 200, 100.0f) * glm::inverse(camera.to_world) * point;
        EXPECT_NEAR(u, 160.0 * (1.0 + static_cast<double>(clip.x / clip.w)), 0.01) << height_m;
        EXPECT_NEAR(v, 100.0 * (1.0 - static_cast<double>(clip.y / clip.w)), 0.01) << height_m;
    }
}

TEST(FramesJsonl, BrokenLinesAreLeftOut)
{
    const Workplace place("broken");
    write_file(place / "frames.jsonl",
               frame_line(facts_of(1, "a")) + "\nnot json\n{\"frame\":\"x\"}\n[]\n{\"fra");
    EXPECT_EQ(read_frame_records(place.path()).size(), 1u);
    EXPECT_TRUE(read_frame_records(place / "nowhere").empty());
}

TEST(FramesJsonl, FilesAreWholeOnlyWithTheirSizeAndHash)
{
    const Workplace place("whole");
    write_file(place / "frame.png", "123");
    FrameFacts facts = facts_of(1, "a");
    facts.files["frame.png"] = file_mark(place / "frame.png");
    merge_frame_lines(place.path(), {{{1}, frame_line(facts)}});
    const auto record = read_frame_records(place.path()).at({1});
    EXPECT_EQ(wrong_with_files(record, place.path()), "");
    for (const char* other : {"1234", "124", ""}) {
        write_file(place / "frame.png", other);
        EXPECT_THAT(wrong_with_files(record, place.path()),
                    testing::HasSubstr("not the file that was written"));
    }
    fs::remove(place / "frame.png");
    EXPECT_THAT(wrong_with_files(record, place.path()), testing::HasSubstr("is missing"));
    // A line of an edited file must not lead out of the folder.
    write_file(place / "frames.jsonl", "{\"frame\":1,\"files\":{\"../x\":3}}\n");
    EXPECT_TRUE(read_frame_records(place.path()).at({1}).files.empty());
}

// Several programs render parts of one sequence into one folder.
TEST(FramesJsonl, WritersAtOnceLoseNothing)
{
    const Workplace place("shared");
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 4; ++writer) {
        writers.emplace_back([&place, writer] {
            for (int i = 0; i < 25; ++i) {
                const int frame = writer * 25 + i;
                merge_frame_lines(place.path(), {{{frame}, frame_line(facts_of(frame, "a"))}});
            }
        });
    }
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(read_frame_records(place.path()).size(), 100u);
}

}  // namespace
}  // namespace petrichor::film
