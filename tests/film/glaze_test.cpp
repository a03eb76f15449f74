// Rain that freezes coats what stands out of the ground with clear ice, leaves and twigs as walls.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "film/jobs/render_job.h"
#include "film/jobs/scene_places.h"
#include "film/jobs/scene_source.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing_gltf::GltfBuilder;
using testing_program::Workplace;

// A yard, a wall, and a leaf that sways: what moves has no patches, as foliage has none.
GltfBuilder yard()
{
    GltfBuilder b;
    b.document["materials"] = {{{"name", "matt"},
                                {"pbrMetallicRoughness", {{"baseColorFactor", {0.4, 0.4, 0.4, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}}};
    testing_gltf::json quad = testing_gltf::quad_of(b);
    quad["material"] = 0;
    const int mesh = b.mesh(quad);
    const double s = std::sqrt(0.5);
    b.node({{"name", "ground"}, {"mesh", mesh}, {"rotation", {-s, 0, 0, s}}, {"scale", {8, 8, 1}}});
    b.node({{"name", "wall"}, {"mesh", mesh}, {"translation", {-0.8, 0.8, 0}}, {"scale", {1, 1.6, 1}}});
    b.node({{"name", "leaf"}, {"mesh", mesh}, {"rotation", {-0.3826834, 0, 0, 0.9238795}}, {"translation", {0.8, 0.8, 0}}});
    b.animate("sway", 2, "translation", {0, 1}, "VEC3", {0.8f, 0.8f, 0, 0.81f, 0.8f, 0});
    return b;
}

class Glaze : public gpu::GpuTest {
protected:
    struct Seen {
        float film = 0.0f, light = 0.0f;
    };
    struct Picture {
        Seen leaf, wall;
    };
    static Picture picture(const std::string& keys, bool patches = true)
    {
        const Workplace place("glaze");
        const auto glb = yard().glb();
        std::ofstream(place / "yard.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
        Scenario scenario = parse_scenario("[scene]\nfile = \"yard.glb\"\nground = \"none\"\n[weather]\nkeys = [" + keys +
                                               "]\n[camera]\nposition_m = [0, 1.2, 3]\nlook_at_m = [0, 0.8, 0]\nexposure = 1e-5\n"
                                               "[sun]\nelevation_degrees = 45\nazimuth_degrees = 180\n"
                                               "[ground]\npatches = " + (patches ? "true" : "false") + "\n"
                                               "[output]\nframes = 1\nstart_s = 40\nwidth = 160\nheight = 90\nsamples = 1\n"
                                               "aovs = [\"film\", \"position\"]\n",
                                           "s.toml");
        scenario.folder = place.path();
        Sequence sequence = make_sequence(std::move(scenario));
        load_sequence_scene(sequence, 2);
        RenderRequest request;
        request.validation = true;
        RenderReport report;
        ScenePlaces places(sequence, 2, {}, {}, report.notes);
        SequenceFrame frame = frame_at(sequence, {0});
        FrameFacts facts;
        places.place(sequence, {0}, frame, facts);
        gpu::Renderer renderer = sequence_renderer(sequence, request, report);
        const gpu::RenderResult r = renderer.render(frame.frame);
        EXPECT_TRUE(renderer.validation_messages().empty());
        Picture seen;
        int leaves = 0, walls = 0;
        for (int y = 0; y < r.height; ++y) {
            for (int x = 0; x < r.width; ++x) {
                const float px = gpu::aov(r, "position", x, y, 0), py = gpu::aov(r, "position", x, y, 1), pz = gpu::aov(r, "position", x, y, 2);
                const bool leaf = std::abs(px - 0.8f) < 0.4f && std::abs(py - 0.8f) < 0.3f && std::abs(pz) < 0.4f;
                const bool wall = std::abs(px + 0.8f) < 0.4f && std::abs(py - 0.9f) < 0.5f && std::abs(pz) < 0.01f;
                if (!leaf && !wall) continue;
                ++(leaf ? leaves : walls);
                Seen& one = leaf ? seen.leaf : seen.wall;
                one.film += gpu::aov(r, "film", x, y, 0);
                one.light += gpu::luminance(gpu::pixel(r, x, y));
            }
        }
        EXPECT_GT(leaves, 100);
        EXPECT_GT(walls, 100);
        for (float* v : {&seen.leaf.film, &seen.leaf.light}) *v /= static_cast<float>(std::max(leaves, 1));
        for (float* v : {&seen.wall.film, &seen.wall.light}) *v /= static_cast<float>(std::max(walls, 1));
        return seen;
    }
};

const std::string kDryFrost = "{ time_s = 0, temperature_c = 2, rainfall = 0 }, { time_s = 30.5, temperature_c = 2, rainfall = 0 }, "
                              "{ time_s = 33, temperature_c = -8, rainfall = 0 }, { time_s = 60, temperature_c = -8 }";
const std::string kRainThatFroze = "{ time_s = 0, temperature_c = 2, rainfall = 0.5 }, { time_s = 30.5, temperature_c = 2, rainfall = 0.5 }, "
                                   "{ time_s = 31, temperature_c = 2, rainfall = 0 }, { time_s = 33, temperature_c = -8, rainfall = 0 }, "
                                   "{ time_s = 60, temperature_c = -8 }";

// The frame has one state then, and what falls finds walls and leaves by their slopes.
TEST_F(Glaze, LiesThereWithoutPatchesToo)
{
    const Picture dry = picture(kDryFrost, false), frozen = picture(kRainThatFroze, false);
    EXPECT_LT(frozen.leaf.light, 0.9f * dry.leaf.light);
    EXPECT_LT(frozen.wall.light, 0.95f * dry.wall.light);
}

TEST_F(Glaze, LiesOnLeavesAndWallsAfterRainThatFroze)
{
    const Picture dry = picture(kDryFrost), frozen = picture(kRainThatFroze);
    EXPECT_LT(dry.leaf.film, 0.01f);
    EXPECT_LT(dry.wall.film, 0.01f);
    EXPECT_GT(frozen.leaf.film, 0.3f);
    EXPECT_GT(frozen.wall.film, 0.05f);
    // Clear ice darkens what is matt.
    EXPECT_LT(frozen.leaf.light, 0.9f * dry.leaf.light);
    EXPECT_LT(frozen.wall.light, 0.95f * dry.wall.light);
}

}  // namespace
}  // namespace petrichor::film
