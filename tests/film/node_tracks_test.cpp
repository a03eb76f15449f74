// Tracks that moving nodes leave in snow: where and when they go near the ground, filled by what falls on them.
#include "film/scenes/node_tracks.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.h"
#include "film/jobs/film_tracks.h"
#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "film/weather/snow_history.h"
#include "scene/animation/settle.h"
#include "scene/gltf/gltf.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing_gltf::GltfBuilder;
using testing_program::Workplace;

// Ground of 12 by 8 m. A cart of 1 m goes along +x in two seconds, from -3 to 3 m, 10 cm over it; a bird does 1 m over it;
// a foot is lifted between two places; a stone lies still.
GltfBuilder yard()
{
    GltfBuilder b;
    const int mesh = b.mesh(testing_gltf::quad_of(b));
    const double s = std::sqrt(0.5);
    const testing_gltf::json flat = {-s, 0, 0, s};
    b.node({{"name", "ground"}, {"mesh", mesh}, {"rotation", flat}, {"scale", {12, 8, 1}}});
    b.node({{"name", "cart"}, {"mesh", mesh}, {"rotation", flat}});
    b.node({{"name", "bird"}, {"mesh", mesh}, {"rotation", flat}, {"scale", {0.2, 0.2, 0.2}}});
    b.node({{"name", "foot.left"}, {"mesh", mesh}, {"rotation", flat}, {"scale", {0.1, 0.28, 0.1}}});
    b.node({{"name", "stone"}, {"mesh", mesh}, {"rotation", flat}, {"translation", {0, 0.05, 3}}, {"scale", {0.3, 0.3, 0.3}}});
    b.animate("cart", 1, "translation", {0, 2}, "VEC3", {-3, 0.1f, 0, 3, 0.1f, 0});
    b.animate("bird", 2, "translation", {0, 2}, "VEC3", {-3, 1, 2, 3, 1, 2});
    b.animate("foot", 3, "translation", {0, 0.5f, 0.75f, 1, 2}, "VEC3",
              {-1, 0.01f, -2, -1, 0.01f, -2, 0, 0.4f, -2, 1, 0.01f, -2, 1, 0.01f, -2});
    return b;
}

scene::Scene settled(const GltfBuilder& b, bool loop = false)
{
    scene::Scene scene = scene::load_gltf(b.glb(), "yard.glb", nullptr);
    scene::settle_animation(scene, {.animation = "all", .loop = loop});
    return scene;
}

ScenarioTrack track_of(std::vector<std::string> nodes, bool tyre = true)
{
    ScenarioTrack track;
    track.nodes = std::move(nodes);
    track.tyre = tyre;
    track.place = "s.toml:3";
    return track;
}

constexpr AnimationClock kTwoSeconds{0.0, 1.0, 24.0, 49};

TEST(NodeTracks, AreWhereAndWhenANodeGoes)
{
    const scene::Scene scene = settled(yard());
    std::vector<std::string> notes;
    const auto ways = node_ways({track_of({"cart"})}, scene, kTwoSeconds, notes);
    ASSERT_EQ(ways.size(), 1u);
    EXPECT_TRUE(notes.empty());
    EXPECT_NEAR(ways[0].way.points.front().x, -3.0, 1e-5);
    EXPECT_NEAR(ways[0].way.points.back().x, 3.0, 1e-5);
    for (std::size_t i = 0; i < ways[0].at_s.size(); ++i) {
        EXPECT_NEAR(ways[0].way.points[i].x, -3.0 + 3.0 * ways[0].at_s[i], 1e-4);
        EXPECT_NEAR(ways[0].way.points[i].y, 0.0, 1e-6);
    }
    // Two tyres within its width.
    EXPECT_NEAR(ways[0].way.gauge_m + ways[0].way.width_m, 1.0, 1e-4);
    const NodeWay half = gone_by(ways[0], 1.0);
    EXPECT_NEAR(half.way.points.back().x, 0.0, 1e-4);
    EXPECT_TRUE(gone_by(ways[0], -1.0).way.points.empty());
    // What it went before the film began is there at once.
    const auto later = node_ways({track_of({"cart"})}, scene, {1.0, 1.0, 24.0, 25}, notes);
    ASSERT_EQ(later.size(), 1u);
    EXPECT_NEAR(gone_by(later[0], 0.0).way.points.front().x, -3.0, 1e-5);
    EXPECT_NEAR(gone_by(later[0], 0.0).way.points.back().x, 0.0, 1e-4);
}

TEST(NodeTracks, AFootLeavesAPrintWhereItIsSetDown)
{
    std::vector<std::string> notes;
    const auto ways = node_ways({track_of({"foot.*"}, false)}, settled(yard()), kTwoSeconds, notes);
    ASSERT_EQ(ways.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(ways[i].way.one_print);
        const glm::dvec2 middle = 0.5 * (ways[i].way.points[0] + ways[i].way.points[1]);
        EXPECT_NEAR(middle.x, i == 0 ? -1.0 : 1.0, 0.25);
        EXPECT_GT(ways[i].way.points[1].x, ways[i].way.points[0].x) << "toes point along the way";
    }
    EXPECT_EQ(ways[0].at_s[0], 0.0);
    EXPECT_GT(ways[1].at_s[0], 0.75);
}

TEST(NodeTracks, AClipThatBeginsAgainLeavesNoWayBack)
{
    std::vector<std::string> notes;
    const auto ways = node_ways({track_of({"cart"})}, settled(yard(), true), {0.0, 1.0, 24.0, 85}, notes);
    ASSERT_EQ(ways.size(), 2u);
    for (const NodeWay& way : ways)
        for (std::size_t i = 1; i < way.way.points.size(); ++i)
            EXPECT_LT(std::abs(way.way.points[i].x - way.way.points[i - 1].x), 0.5);
    EXPECT_GE(ways[1].at_s.front(), 2.0);
}

TEST(NodeTracks, SayWhatLeavesNone)
{
    const scene::Scene scene = settled(yard());
    std::vector<std::string> notes;
    EXPECT_TRUE(node_ways({track_of({"bird", "stone"})}, scene, kTwoSeconds, notes).empty());
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_NE(notes[0].find("\"bird\" comes nowhere near the ground"), std::string::npos) << notes[0];
    EXPECT_NE(notes[1].find("\"stone\" does not move"), std::string::npos) << notes[1];
    try {
        node_ways({track_of({"card"})}, scene, kTwoSeconds, notes);
        FAIL() << "a node that is not there";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("s.toml:3"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("Did you mean \"cart\"?"), std::string::npos) << error.what();
        EXPECT_NE(error.fix().find("bird, cart, foot.left, ground, stone"), std::string::npos) << error.fix();
    }
}

TEST(SnowHistory, NewSnowFillsWhatWasTrodden)
{
    const auto depth = [](double s) { return s < 1.0 ? 0.2 : 0.2 * s; };
    const SnowHistory snow(depth, 2.0, 200);
    EXPECT_NEAR(snow.left(0.0, 0.5), 1.0, 1e-9);
    EXPECT_NEAR(snow.left(0.0, 2.0), 0.5 * std::exp(-1.0), 1e-6);
    EXPECT_NEAR(snow.left(1.5, 2.0), 0.75 * std::exp(-1.0 / 3.0), 1e-6);
    EXPECT_NEAR(snow.left(2.0, 2.0), 1.0, 1e-9);
    // What melts takes its share of old and new.
    const SnowHistory melting([](double s) { return s < 1.0 ? 0.1 + 0.1 * s : 0.2 - 0.15 * (s - 1.0); }, 2.0, 200);
    EXPECT_NEAR(melting.left(0.0, 1.0), melting.left(0.0, 2.0), 1e-6);
    // Snow that begins anew knows no track of the one before.
    const SnowHistory anew([](double s) { return std::abs(1.0 - s) * 0.1; }, 2.0, 200);
    EXPECT_EQ(anew.left(0.5, 1.5), 0.0);
    EXPECT_NEAR(anew.left(0.5, 0.9), 1.0, 1e-6);
    EXPECT_EQ(SnowHistory().left(0.0, 9.0), 1.0);
}

class NodeTracksPicture : public gpu::GpuTest {
protected:
    static Sequence sequence_of(const Workplace& place)
    {
        const auto glb = yard().glb();
        std::ofstream(place / "yard.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
        Scenario scenario = parse_scenario("[scene]\nfile = \"yard.glb\"\nanimation_loop = false\n"
                                           "[ground]\ntracks = [{ node = \"cart\" }]\n"
                                           "[weather]\nkeys = ["
                                           "{ time_s = 0, temperature_c = -6, rainfall = 0.0, script_controlled = 0, snow = 0.95, "
                                           "water_to_snow = 1.0 }]\n"
                                           "[camera]\nposition_m = [0, 5, 4]\nlook_at_m = [0, 0, 0]\n"
                                           "[render]\nindirect = \"ambient\"\n"
                                           "[output]\nframes = 25\nfps = 12\nwidth = 160\nheight = 90\nsamples = 1\n"
                                           "aovs = [\"position\"]\n",
                                           "s.toml");
        scenario.folder = place.path();
        Sequence sequence = make_sequence(std::move(scenario));
        load_sequence_scene(sequence, 2);
        return sequence;
    }
    static gpu::Renderer renderer_of(Sequence& sequence)
    {
        RenderReport report;
        RenderRequest request;
        request.validation = true;
        return sequence_renderer(sequence, request, report);
    }
    // The lowest snow of a strip of the cart's right tyre.
    static float lowest(const gpu::RenderResult& r, float x)
    {
        float low = 1e30f;
        for (int py = 0; py < r.height; ++py) {
            for (int px = 0; px < r.width; ++px) {
                const float dx = gpu::aov(r, "position", px, py, 0) - x, z = gpu::aov(r, "position", px, py, 2);
                if (std::abs(dx) < 0.3f && std::abs(z - 0.39f) < 0.08f) low = std::min(low, gpu::aov(r, "position", px, py, 1));
            }
        }
        return low;
    }
};

TEST_F(NodeTracksPicture, AreThereOnceItHasPassedAndAFrameAloneIsThatOfTheRun)
{
    const Workplace place("node_tracks");
    Sequence run = sequence_of(place);
    gpu::Renderer drawn = renderer_of(run);
    const gpu::RenderResult first = drawn.render(frame_at(run, {0}).frame);
    const gpu::RenderResult middle = drawn.render(frame_at(run, {12}).frame);
    const gpu::RenderResult last = drawn.render(frame_at(run, {24}).frame);
    const gpu::RenderResult again = drawn.render(frame_at(run, {12}).frame);
    EXPECT_EQ(middle.display, again.display);
    Sequence other = sequence_of(place);
    gpu::Renderer fresh = renderer_of(other);
    const gpu::RenderResult alone = fresh.render(frame_at(other, {12}).frame);
    EXPECT_EQ(middle.display, alone.display);
    EXPECT_EQ(middle.aovs[0].pixels, alone.aovs[0].pixels);
    EXPECT_TRUE(drawn.validation_messages().empty() && fresh.validation_messages().empty());
    // Snow of some 20 cm, pressed by more than half of it.
    const float behind = lowest(first, -1.2f), ahead = lowest(first, 1.5f);
    EXPECT_GT(behind, 0.1f);
    EXPECT_LT(lowest(middle, -1.2f), 0.5f * behind);
    EXPECT_NEAR(lowest(middle, 1.5f), ahead, 0.01f);
    EXPECT_LT(lowest(last, 1.5f), 0.5f * ahead);
    EXPECT_NE(frame_parts(run, frame_at(run, {12})).at("tracks"), frame_parts(run, frame_at(run, {24})).at("tracks"));
}

}  // namespace
}  // namespace petrichor::film
