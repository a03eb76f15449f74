// A light map on a real scene: what a directional light sends onto FlightHelmet is baked into maps
// over its coordinates, and lights it as the light itself does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "film/scenario/material_keys.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/assets.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using testing_program::Workplace;

constexpr int kSize = 512;
constexpr float kLux = 1000.0f;
// In the plane of symmetry: the model lays mirrored halves over each other.
const glm::vec3 kToLight = glm::normalize(glm::vec3(0.0f, 0.6f, 0.8f));

// The irradiance of one material's triangles over their coordinates; -1 where there is none.
class Bake {
public:
    void add(const scene::Primitive& p, const glm::mat4& to_world)
    {
        const glm::mat3 turn(to_world);
        for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
            glm::vec2 uv[3];
            float lux[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t at = p.indices[i + k];
                uv[k] = p.uv0[at] * static_cast<float>(kSize);
                const glm::vec3 n = glm::normalize(turn * p.normals[at]);
                lux[k] = kLux * glm::dot(n, kToLight);
            }
            fill(uv, lux);
        }
    }
    void write(const fs::path& file)
    {
        for (int round = 0; round < 96; ++round) spread();
        texproc::ExrChannel channel;
        for (const float lux : lux_) channel.floats.push_back(std::max(lux, 0.0f));
        std::vector<texproc::ExrChannel> channels;
        for (const char* name : {"R", "G", "B"}) {
            channels.push_back(channel);
            channels.back().name = name;
        }
        texproc::write_exr(file, kSize, kSize, channels, {});
    }

private:
    static constexpr float kEmpty = -1e9f;
    float& at(int x, int y) { return lux_[static_cast<std::size_t>(y * kSize + x)]; }
    static int wrapped(int i) { return ((i % kSize) + kSize) % kSize; }

    void fill(const glm::vec2 (&uv)[3], const float (&lux)[3])
    {
        const glm::vec2 low = glm::min(uv[0], glm::min(uv[1], uv[2]));
        const glm::vec2 high = glm::max(uv[0], glm::max(uv[1], uv[2]));
        const glm::vec2 e1 = uv[1] - uv[0], e2 = uv[2] - uv[0];
        const float area = e1.x * e2.y - e1.y * e2.x;
        if (std::abs(area) < 1e-6f) return;
        for (int y = static_cast<int>(std::floor(low.y)); y <= static_cast<int>(high.y); ++y) {
            // Where the row enters and leaves the triangle, a texel wider: some are long and thin.
            float from = low.x, to = high.x;
            const auto keep_positive = [&](float at_zero, float slope) {
                if (slope > 0.0f) from = std::max(from, -at_zero / slope);
                if (slope < 0.0f) to = std::min(to, -at_zero / slope);
            };
            const float dx = 0.5f - uv[0].x, dy = static_cast<float>(y) + 0.5f - uv[0].y;
            const float b0 = (dx * e2.y - dy * e2.x) / area, b1 = e2.y / area;
            const float c0 = (e1.x * dy - e1.y * dx) / area, c1 = -e1.y / area;
            keep_positive(b0, b1);
            keep_positive(c0, c1);
            keep_positive(1.0f - b0 - c0, -b1 - c1);
            // Along an edge that is nearly level both may lie beyond any whole number.
            from = std::min(from, high.x);
            to = std::max(to, low.x);
            for (int x = static_cast<int>(std::floor(from)) - 1; x <= static_cast<int>(to) + 1; ++x) {
                const glm::vec2 d = glm::vec2(x, y) + 0.5f - uv[0];
                const float b = (d.x * e2.y - d.y * e2.x) / area;
                const float c = (e1.x * d.y - e1.y * d.x) / area;
                if (b < 0.0f || c < 0.0f || b + c > 1.0f) continue;
                at(wrapped(x), wrapped(y)) = lux[0] + b * (lux[1] - lux[0]) + c * (lux[2] - lux[0]);
            }
        }
    }
    // Beyond the edges of what is there, so that filtering finds no gap.
    void spread()
    {
        const std::vector<float> before = lux_;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (at(x, y) != kEmpty) continue;
                float sum = 0.0f, count = 0.0f;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        const float v = before[static_cast<std::size_t>(wrapped(y + dy) * kSize +
                                                                        wrapped(x + dx))];
                        if (v == kEmpty) continue;
                        sum += v;
                        count += 1.0f;
                    }
                }
                if (count > 0.0f) at(x, y) = sum / count;
            }
        }
    }

    std::vector<float> lux_ = std::vector<float>(static_cast<std::size_t>(kSize * kSize), kEmpty);
};

class LightMap : public gpu::GpuTest {};

TEST_F(LightMap, LightsARealSceneAsTheLightThatWasBaked)
{
    NEED_ASSETS(assets);
    const Workplace place("light-map");
    const std::string head = "[scene]\nfile = \"" + assets.string() +
                             "/models/FlightHelmet/FlightHelmet.gltf\"\nmax_texture = 256\nground = \"none\"\n"
                             "[sun]\nsource = \"scene\"\n"
                             "[render]\nimage_based_light = false\nshadows = false\ndraw_sky = false\n"
                             "[output]\nwidth = 192\nheight = 192\nsamples = 4\nframes = 1\n"
                             "[materials.\"*\"]\nlighting_model = \"lambert\"\nnormal_texture = \"\"\n"
                             "metallic_roughness_texture = \"\"\nmetallic_factor = 0.0\nocclusion_strength = 0.0\n"
                             "alpha_mode = \"OPAQUE\"\n";
    const auto picture = [&](const std::string& more, std::vector<scene::Light> lights) {
        Scenario scenario = parse_scenario(head + more, "s.toml");
        scenario.folder = place.path();
        Sequence sequence = make_sequence(std::move(scenario));
        load_sequence_scene(sequence, 2);
        sequence.scene.lights = std::move(lights);
        RenderRequest request;
        RenderReport report;
        gpu::Renderer with = sequence_renderer(sequence, request, report);
        gpu::RenderResult result = with.render(frame_at(sequence, {0, "", ""}).frame);
        return std::make_pair(std::move(result), std::move(sequence.scene));
    };
    scene::Light light;
    light.kind = scene::LightKind::Directional;
    light.intensity = kLux;
    light.direction = -kToLight;
    const auto [lit, scene] = picture("", {light});

    std::vector<Bake> maps(scene.materials.size());
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives)
            maps[p.material].add(p, instance.to_world);
    }
    std::string keys;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const std::string file = "light_" + std::to_string(i) + ".exr";
        maps[i].write(place / file);
        keys += "[materials.\"" + scene.materials[i].name + "\"]\nlight_map_texture = \"" + file +
                "\"\n";
    }
    const gpu::RenderResult baked = picture(keys, {}).first;
    std::vector<float> errors;
    for (int y = 0; y < 192; ++y) {
        for (int x = 0; x < 192; ++x) {
            const float a = gpu::luminance(gpu::pixel(lit, x, y));
            const float b = gpu::luminance(gpu::pixel(baked, x, y));
            if (std::max(a, b) > 1.0f) errors.push_back(std::abs(a - b) / std::max(a, b));
        }
    }
    ASSERT_GT(errors.size(), 4000u);
    std::sort(errors.begin(), errors.end());
    std::printf("  %zu pixels, error median %.4f, 80 %% %.4f\n", errors.size(),
                static_cast<double>(errors[errors.size() / 2]),
                static_cast<double>(errors[errors.size() * 8 / 10]));
    // Set after seeing them: small levels of a map mix islands that meet in it and not on the model.
    EXPECT_LT(errors[errors.size() / 2], 0.03f);
    EXPECT_LT(errors[errors.size() * 8 / 10], 0.2f);
}

}  // namespace
}  // namespace petrichor::film
