// Whatever a scene, its materials and its weather say within their ranges: every number of a picture is one.
#include <array>
#include <random>
#include <sstream>

#include "gpu/outputs/aov_table.h"
#include "tests/gpu/chequered_textures.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class FinitePictures : public GpuTest {
protected:
    std::mt19937 random_{11};
    // What a pipeline is made for is one of few shapes, which all scenes share; numbers are of each frame alone.
    static constexpr int kShapes = 3;
    float unit() { return static_cast<float>(random_() >> 8) / 16777216.0f; }
    bool one_in(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)) == 0; }
    template <class T> T one_of(std::initializer_list<T> all) { return all.begin()[random_() % all.size()]; }

    // Ends of a range are asked as often as what lies between.
    float any(float low, float high)
    {
        low = std::max(low, -1e6f);
        high = std::min(high, 1e6f);
        return one_of<float>({low, high, low + (high - low) * unit()});
    }

    glm::vec4 any_value(const scene::MaterialProperty& row, const Material& m)
    {
        glm::vec4 value = row.get(m);
        for (int i = 0; i < row.count; ++i) {
            value[i] = any(row.low[i], row.high[i]);
            if (row.kind != scene::PropertyKind::Number) value[i] = std::floor(value[i]);
            if (!std::isnan(row.also) && one_in(4)) value[i] = row.also;
        }
        return value;
    }

    void mutate(Material& m)
    {
        for (const scene::MaterialProperty& row : scene::material_table()) {
            if (row.at_load || !one_in(4)) continue;
            row.set(m, any_value(row, m));
        }
        for (const scene::MaterialTexture& row : scene::material_textures()) {
            if (one_in(4)) row.edit(m) = use_of(row.name);
        }
    }

    // Ground, a slope, a wall, and things that ought not to be.
    Scene mutated_scene()
    {
        std::vector<Primitive> parts{quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0), quad({-2, 0, 0}, {2, 0, 0}, {0, 1, -1}, 1),
                                     quad({0.5f, 0, -1}, {1, 0, 0}, {0, 1.2f, 0}, 2)};
        for (Primitive& part : parts) {
            if (one_in(4)) part.uv0.assign(part.uv0.size(), glm::vec2(0.3f));  // no area in the texture
            if (one_in(4)) part.uv0.clear();
            if (one_in(4)) part.tangents.clear();
            if (one_in(4)) {
                for (const glm::vec2& uv : part.uv0) part.uv1.push_back(uv * 1e4f);
            }
            if (one_in(3)) part.weather.assign(part.positions.size(), glm::vec4(any(0, 1), any(0, 1), any(0, 1), any(0, 1)));
            if (one_in(4)) part.colors.assign(part.positions.size(), glm::vec4(any(0, 1), any(0, 1), any(0, 1), any(0, 1)));
        }
        Primitive point = quad({0, 0.3f, 1}, {1, 0, 0}, {0, 1, 0}, 1);
        point.positions.assign(4, glm::vec3(0.0f, 0.3f, 1.0f));
        Primitive line = quad({-1, 0.2f, 1}, {1, 0, 0}, {0, 1, 0}, 2);
        for (glm::vec3& at : line.positions) at.y = 0.2f;
        parts.push_back(point);
        parts.push_back(line);
        std::vector<Material> materials(3, plain_material(glm::vec3(0.5f), 0.5f));
        for (Material& m : materials) mutate(m);
        Scene scene = scene_of(std::move(parts), std::move(materials));
        scene.materials[1].lighting_model = "skin";
        return scene;
    }

    Light any_lamp(LightKind kind)
    {
        Light lamp;
        lamp.kind = kind;
        lamp.color = {any(0, 1), any(0, 1), any(0, 1)};
        lamp.intensity = one_of({0.0f, 1e-3f, 10.0f, 1e6f});
        lamp.range_m = one_of({0.0f, 1e-3f, 4.0f, 1e5f});
        lamp.position_m = one_of({glm::vec3(0), glm::vec3(0, 0, 0.5f), glm::vec3(0.5f, 1, 1), glm::vec3(0, 1e4f, 0)});
        lamp.inner_cone_rad = any(0.0f, 0.7f);
        lamp.outer_cone_rad = lamp.inner_cone_rad + any(1e-3f, 0.8f);
        lamp.radius_m = lamp.kind == LightKind::Rectangle ? 0.0f : one_of({0.0f, 0.01f, 3.0f});
        lamp.half_u_m = glm::vec3(one_of({1e-3f, 0.5f, 50.0f}), 0, 0);
        lamp.half_v_m = glm::vec3(0, 0, one_of({1e-3f, 0.5f, 50.0f}));
        lamp.specular = any(0, 1);
        return lamp;
    }

    // Rain alone, or all there is: pipelines are made for either.
    void mutate(shared::WeatherMoment& w, bool white)
    {
        for (float* share : {&w.rain, &w.flood_cracks, &w.flood_puddles, &w.film_albedo, &w.film_smoothness, &w.cloud_fraction}) {
            *share = any(0, 1);
        }
        if (white) {
            for (float* share : {&w.snowfall, &w.snow_amount, &w.water_to_snow, &w.freeze_exp, &w.melt, &w.melt_exp, &w.frost}) *share = any(1e-4f, 1);
        }
        w.snow_start_height_m = one_of({-100.0f, 0.0f, 0.5f, 9000.0f});
        w.snow_height_blend_m = one_of({0.0f, 1e-3f, 10.0f});
        w.rain_kg_m2_s = one_of({0.0f, 1e-4f, 500.0f / 3600.0f});
        w.snowfall_kg_m2_s = white ? one_of({0.0f, 1e-4f, 0.02f}) : 0.0f;
        w.film_mm = one_of({0.0f, 0.4f, 10.0f});
        w.snow_depth_m = white ? one_of({0.0f, 1e-4f, 0.2f, 100.0f}) : 0.0f;
        w.swe_kg_m2 = 200.0f * w.snow_depth_m;
        w.wind_m_s = glm::vec2(one_of({3.0f, 60.0f}), 0.0f);
        w.visibility_m = one_of({0.5f, 50.0f, 20000.0f, 1e9f});
        w.air_temperature_k = one_of({203.15f, 273.15f, 288.15f, 323.15f});
    }

    static void shape(Frame& frame, int k)
    {
        frame.settings.gamma = k == 1;
        frame.settings.lazarov = k == 2;
        frame.settings.horizon_fade = k == 1 ? 0.0f : 1.0f;
        frame.settings.area_lights = std::array{AreaLights::Ltc, AreaLights::Nearest, AreaLights::Off}[static_cast<std::size_t>(k)];
        frame.fog.mode = std::array{FogMode::Exp, FogMode::Metres, FogMode::Off}[static_cast<std::size_t>(k)];
        frame.sky.sun_illuminance = k == 2 ? 0.0f : 100000.0f;
        frame.sky.moon_lux = k == 2 ? 0.3f : 0.0f;
    }

    Frame mutated_frame(int k)
    {
        Frame frame;
        mutate(frame.weather, k != 0);
        shape(frame, k);
        frame.camera = look(one_of({glm::vec3(0, 1.6f, 3.2f), glm::vec3(0, 3, 0), glm::vec3(0, -1, 2), glm::vec3(0, 0, 1)}), {0, 0.3f, -0.3f},
                            one_of({1e-3f, 0.8f, 3.0f}));
        if (one_in(4)) frame.camera.orthographic_height_m = one_of({1e-3f, 3.0f, 1e4f});
        frame.settings.width = 48;
        frame.settings.height = 32;
        frame.settings.samples = one_of({1, 4});
        frame.settings.time_s = one_of({0.0, 0.37, 1e6});
        frame.settings.bloom = any(0, 1);
        frame.settings.wet_lens = any(0, 1);
        frame.settings.specular_aa = any(0, 4);
        frame.settings.occlusion_direct = any(0, 1);
        frame.settings.tone_map = one_of({ToneMap::Linear, ToneMap::Filmic, ToneMap::Agx, ToneMap::Aces, ToneMap::Neutral});
        frame.sky.sun_elevation_rad = one_of({-1.5707963f, -0.05f, 0.0f, 0.6f, 1.5707963f});
        frame.sky.cloud_cover = frame.weather.cloud_fraction;
        frame.sky.turbidity = any(1.5f, 10.0f);
        frame.sky.moon_elevation_rad = one_of({-1.0f, 0.0f, 1.0f});
        frame.fog.per_m = one_of({0.0f, 0.01f, 100.0f});
        frame.fog.height_m = one_of({0.0f, 1.0f, 120.0f});
        frame.falling.shutter_s = one_of({1e-6f, 0.004f, 1.0f});
        for (const AovInfo& row : aov_table()) frame.settings.aovs.emplace_back(row.name);
        return frame;
    }

    static std::string first_that_is_none(const RenderResult& r)
    {
        std::ostringstream said;
        for (std::size_t i = 0; i < r.beauty.size(); ++i) {
            if (std::isfinite(half_to_float(r.beauty[i]))) continue;
            said << "beauty[" << i % 4 << "] = " << half_to_float(r.beauty[i]) << " at " << i / 4 % static_cast<std::size_t>(r.width) << " " << i / 4 / static_cast<std::size_t>(r.width);
            return said.str();
        }
        for (const AovImage& image : r.aovs) {
            for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                const float x = image.pixels[i];
                if (std::isfinite(x) || (image.name == "depth" && x == INFINITY)) continue;
                const auto channels = static_cast<std::size_t>(image.channels);
                said << image.name << "[" << i % channels << "] = " << x << " at " << i / channels % static_cast<std::size_t>(r.width) << " "
                     << i / channels / static_cast<std::size_t>(r.width);
                return said.str();
            }
        }
        return "";
    }
};

// A mirror that glows in a bright room: each part is held below the largest half, their sum is above it.
TEST_F(FinitePictures, WhatIsBrighterThanAHalfHoldsIsTheLargestHalf)
{
    Material mirror = plain_material(glm::vec3(1.0f), 0.05f, 1.0f);
    mirror.emissive = glm::vec3(1.0f);
    mirror.emissive_strength = 50000.0f;
    renderer->set_environment(constant_environment(50000.0f));
    renderer->load(scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {mirror}), {});
    Frame frame;
    frame.camera = look({0, 0.5f, 0.5f}, {0, 0, 0}, 0.1f);
    frame.settings.width = frame.settings.height = 9;
    frame.settings.exposure = 1.0f;
    EXPECT_EQ(pixel(renderer->render(frame), 4, 4), glm::vec3(65504.0f));
}

// Few materials and many frames: pipelines are made for materials, numbers change from frame to frame.
TEST_F(FinitePictures, OfMutatedScenes)
{
    const std::vector<Texture> pixels = chequered_textures();
    int lit = 0, pictures = 0;
    Scene mutated = mutated_scene();
    for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Rectangle}) mutated.lights.push_back(any_lamp(kind));
    std::array<std::vector<MaterialChange>, kShapes> keyed;
    for (auto& values : keyed) {
        for (std::uint32_t m = 0; m < mutated.materials.size(); ++m) {
            for (const scene::MaterialProperty& row : scene::material_table()) {
                if (row.keyed && one_in(3)) values.push_back({m, row.name, any_value(row, mutated.materials[m])});
            }
        }
    }
    for (const float scale : {1.0f, 0.0025f, 2500.0f}) {  // 4 m, 1 cm and 10 km wide
        Scene scene = mutated;
        scene.instances[0].to_world = glm::scale(glm::mat4(1.0f), glm::vec3(scale));
        for (Light& lamp : scene.lights) lamp.position_m *= scale;
        renderer->load(scene, pixels);
        for (int k = 0; k < 2 * kShapes; ++k) {
            Frame frame = mutated_frame(k % kShapes);
            frame.settings.surface_path = scale < 1.0f ? SurfacePath::Fragment : SurfacePath::Visibility;
            frame.settings.any_light = true;
            frame.camera.to_world[3] *= glm::vec4(glm::vec3(scale), 1.0f);
            frame.camera.near_m = std::min(0.05f, 0.02f * scale);
            frame.materials = keyed[static_cast<std::size_t>(k % kShapes)];
            const RenderResult r = renderer->render(frame);
            EXPECT_EQ(first_that_is_none(r), "") << 4 * scale << " m wide, frame " << k;
            lit += luminance(pixel(r, 24, 20)) > 0.0f;
            ++pictures;
        }
    }
    EXPECT_GT(lit, pictures / 2) << "most show something";
}

}  // namespace
}  // namespace petrichor::gpu
