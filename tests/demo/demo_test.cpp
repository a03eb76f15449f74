#include "demo/street.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "base/error.h"
#include "demo/mesh_builder.h"
#include "demo/street_parts.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::demo {
namespace {

scene::Scene read_back(const std::vector<std::byte>& glb)
{
    return scene::load_gltf(glb, "test", [](const std::string& uri) -> std::vector<std::byte> {
        throw Error("no file " + uri, "Keep everything inside the GLB.");
    });
}

const scene::Scene& street()
{
    static const scene::Scene scene = make_demo_street({.texture_size = 64, .threads = 2});
    return scene;
}

const scene::Primitive& part(const std::string& name)
{
    for (const scene::Mesh& mesh : street().meshes) {
        if (mesh.name == name) return mesh.primitives.front();
    }
    throw std::runtime_error("no part " + name);
}

std::uint32_t word(const std::vector<std::byte>& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

TEST(DemoStreet, SameOptionsGiveTheSameBytes)
{
    const auto a = write_glb(street());
    const auto b = write_glb(make_demo_street({.texture_size = 64, .threads = 1}));
    EXPECT_TRUE(a == b);
    EXPECT_FALSE(a == write_glb(make_demo_street({.seed = 2, .texture_size = 64, .threads = 2})));
}

TEST(DemoStreet, KeepsItsBudget)
{
    std::size_t triangles = 0;
    std::size_t primitives = 0;
    for (const scene::Mesh& mesh : street().meshes) {
        for (const scene::Primitive& p : mesh.primitives) {
            triangles += p.indices.size() / 3;
            ++primitives;
        }
    }
    EXPECT_LE(triangles, 350000u);
    EXPECT_GE(triangles, 100000u);
    EXPECT_LE(primitives, 60u);
    EXPECT_EQ(street().instances.size(), street().meshes.size());
}

TEST(DemoStreet, AttributesAreWhole)
{
    for (const scene::Mesh& mesh : street().meshes) {
        const scene::Primitive& p = mesh.primitives.front();
        ASSERT_EQ(p.normals.size(), p.positions.size()) << mesh.name;
        ASSERT_EQ(p.uv0.size(), p.positions.size()) << mesh.name;
        for (const glm::vec3& n : p.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-3f) << mesh.name;
        for (const glm::vec3& q : p.positions) {
            ASSERT_TRUE(std::abs(q.x) < 100.0f && q.y > -1.0f && q.y < 15.0f &&
                        std::abs(q.z) < 100.0f)
                << mesh.name;
        }
        for (const std::uint32_t i : p.indices) ASSERT_LT(i, p.positions.size()) << mesh.name;
    }
}

// A triangle whose winding disagrees with its normals would be culled or lit from behind.
TEST(DemoStreet, TrianglesFaceTheWayTheirNormalsPoint)
{
    for (const scene::Mesh& mesh : street().meshes) {
        const scene::Primitive& p = mesh.primitives.front();
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            const std::uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
            const glm::vec3 n =
                glm::cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]);
            if (glm::length(n) < 1e-7f) continue;  // at the pole of a bush's core
            if (glm::dot(n, p.normals[a] + p.normals[b] + p.normals[c]) < 0.0f) ++wrong;
        }
        EXPECT_EQ(wrong, 0u) << mesh.name << " of " << p.indices.size() / 3;
    }
}

TEST(DemoStreet, TextureCoordinatesAreMetresOverTheTile)
{
    // On the level parts of the pavement a metre is the same step everywhere in the texture.
    const scene::Primitive& paving = part("paving");
    double smallest = 1e9, largest = 0.0;
    for (std::size_t i = 0; i + 2 < paving.indices.size(); i += 3) {
        const std::uint32_t a = paving.indices[i], b = paving.indices[i + 1];
        const float rise = std::abs(paving.positions[b].y - paving.positions[a].y);
        if (paving.normals[a].y < 0.99f || paving.positions[a].y > 0.2f || rise > 0.008f) continue;
        const double metres =
            static_cast<double>(glm::length(paving.positions[b] - paving.positions[a]));
        const double uv = static_cast<double>(glm::length(paving.uv0[b] - paving.uv0[a]));
        smallest = std::min(smallest, metres / uv);
        largest = std::max(largest, metres / uv);
    }
    EXPECT_NEAR(smallest, 2.4, 0.03);
    EXPECT_NEAR(largest, 2.4, 0.03);
}

TEST(DemoStreet, AwningSheltersPavementAndEdgeOfTheRoad)
{
    const scene::Primitive& awning = part("copper sheet");
    float left = 1e9f, right = -1e9f, lowest = 1e9f;
    for (const glm::vec3& p : awning.positions) {
        if (p.y > 3.2f) continue;  // the ball on the turret is of the same metal
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        lowest = std::min(lowest, p.y);
    }
    EXPECT_LT(left, kLeftWall + 0.05f);
    EXPECT_GT(right, -kRoadHalf + 0.1f);
    EXPECT_GT(lowest, pavement_height(kLeftWall) + 1.9f);
}

TEST(DemoStreet, PuddlesHaveLowGroundAndSmoothMasks)
{
    const scene::Primitive& road = part("cobble");
    ASSERT_EQ(road.weather.size(), road.positions.size());
    Kit kit;
    int wet = 0, dry = 0;
    for (float z = -9.0f; z < 7.0f; z += 0.1f) {
        for (float x = -2.0f; x <= 2.0f; x += 0.1f) {
            const RoadPoint here = road_at(kit, x, z);
            ASSERT_TRUE(here.puddle >= 0.0f && here.puddle <= 1.0f);
            const RoadPoint beside = road_at(kit, x + 0.02f, z);
            ASSERT_LT(std::abs(here.puddle - beside.puddle), 0.2f);
            ASSERT_LT(std::abs(here.height_m - beside.height_m), 0.006f);
            // Below the crown by the depth of the hollow.
            const float crown = 0.045f * (1.0f - x * x / (kRoadHalf * kRoadHalf));
            if (here.puddle > 0.99f) {
                EXPECT_LT(here.height_m, crown - 0.02f);
                ++wet;
            } else if (here.puddle < 0.01f) {
                EXPECT_GT(here.height_m, crown - 0.009f);
                ++dry;
            }
        }
    }
    EXPECT_GT(wet, 300);
    EXPECT_GT(dry, 1500);
}

TEST(DemoStreet, CobblesHaveReliefInTheMesh)
{
    const scene::Primitive& road = part("cobble");
    Kit kit;
    float low = 1e9f, high = -1e9f;
    for (const glm::vec3& p : road.positions) {
        if (std::abs(p.x) > 0.5f || p.z < 0.0f || p.z > 0.9f) continue;
        const float relief = p.y - road_at(kit, p.x, p.z).height_m;
        low = std::min(low, relief);
        high = std::max(high, relief);
    }
    EXPECT_GT(high - low, 0.010f);
    EXPECT_LT(high - low, 0.035f);
}

TEST(DemoStreet, HasItsCamerasAndLamp)
{
    std::set<std::string> names;
    for (const scene::Camera& camera : street().cameras) names.insert(camera.name);
    EXPECT_TRUE(names.contains("main") && names.contains("low") && names.contains("top"));
    ASSERT_EQ(street().lights.size(), 1u);
    const scene::Light& lamp = street().lights.front();
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.kind, scene::LightKind::Point);
    // Inside its lantern.
    const scene::Primitive& glass = part("lantern glass");
    glm::vec3 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : glass.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_TRUE(glm::all(glm::greaterThan(lamp.position_m, low)) &&
                glm::all(glm::lessThan(lamp.position_m, high)));
}

TEST(DemoStreet, ReadsBackAsItWasWritten)
{
    const std::vector<std::byte> glb = write_glb(street());
    ASSERT_EQ(word(glb, 0), 0x46546c67u);
    ASSERT_EQ(word(glb, 4), 2u);
    ASSERT_EQ(word(glb, 8), glb.size());
    ASSERT_EQ(word(glb, 12) % 4, 0u);
    const scene::Scene scene = read_back(glb);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ASSERT_EQ(scene.meshes.size(), street().meshes.size());
    ASSERT_EQ(scene.materials.size(), street().materials.size());
    ASSERT_EQ(scene.textures.size(), street().textures.size());
    // The reader keeps the images in the order of their first use.
    const auto sorted_images = [](const scene::Scene& from) {
        std::vector<std::string> images;
        for (const scene::EncodedImage& image : from.textures) {
            images.emplace_back(reinterpret_cast<const char*>(image.bytes.data()),
                                image.bytes.size());
        }
        std::sort(images.begin(), images.end());
        return images;
    };
    EXPECT_TRUE(sorted_images(scene) == sorted_images(street()));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const scene::Material& a = scene.materials[i];
        const scene::Material& b = street().materials[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.normal_texture.present(), b.normal_texture.present());
        EXPECT_EQ(a.weather.height.present(), b.weather.height.present());
        EXPECT_NEAR(a.weather.height_scale_m, b.weather.height_scale_m, 1e-6f);
        EXPECT_NEAR(a.weather.porosity, b.weather.porosity, 1e-6f);
        EXPECT_NEAR(glm::length(a.weather.water_accumulation - b.weather.water_accumulation), 0.0f,
                    1e-5f);
        const glm::vec3 read = a.emissive * a.emissive_strength;
        EXPECT_NEAR(glm::length(read - b.emissive) / (1.0f + glm::length(b.emissive)), 0.0f, 1e-5f);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const scene::Primitive& a = scene.meshes[i].primitives.front();
        const scene::Primitive& b = street().meshes[i].primitives.front();
        EXPECT_EQ(a.indices.size(), b.indices.size()) << scene.meshes[i].name;
        EXPECT_EQ(a.weather.empty(), b.weather.empty()) << scene.meshes[i].name;
        EXPECT_EQ(a.colors.empty(), b.colors.empty()) << scene.meshes[i].name;
    }
    ASSERT_EQ(scene.cameras.size(), street().cameras.size());
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        EXPECT_EQ(scene.cameras[i].name, street().cameras[i].name);
        for (int c = 0; c < 4; ++c) {
            EXPECT_NEAR(glm::length(scene.cameras[i].to_world[c] - street().cameras[i].to_world[c]),
                        0.0f, 1e-4f);
        }
    }
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_NEAR(glm::length(scene.lights[0].position_m - street().lights[0].position_m), 0.0f,
                1e-4f);
    EXPECT_NEAR(scene.lights[0].intensity, street().lights[0].intensity, 1e-2f);
}

TEST(DemoStreet, RefusesTextureSizesOutOfRange)
{
    EXPECT_THROW(make_demo_street({.texture_size = 8}), Error);
    EXPECT_THROW(make_demo_street({.texture_size = 5000}), Error);
}

// A scene with one of everything that the writer knows.
scene::Scene small_scene()
{
    scene::Scene scene;
    scene.name = "small";
    const std::vector<std::uint8_t> grey = {0, 64, 128, 255};
    scene.textures.push_back({.name = "grey",
                              .bytes = texproc::encode_png8(2, 2, 1, grey),
                              .wrap_u = scene::Wrap::Clamp,
                              .wrap_v = scene::Wrap::Mirror,
                              .nearest = true});
    scene::Material material;
    material.name = "all";
    material.base_color = {0.5f, 0.25f, 0.125f, 0.75f};
    material.base_color_texture = {
        .texture = 0, .offset = {0.1f, 0.2f}, .scale = {2.0f, 3.0f}, .rotation_rad = 0.4f};
    material.metallic = 0.25f;
    material.roughness = 0.625f;
    material.emissive = {20.0f, 10.0f, 5.0f};
    material.ior = 1.33f;
    material.specular = 0.5f;
    material.transmission = 0.3f;
    material.clearcoat = 0.7f;
    material.clearcoat_roughness = 0.2f;
    material.sheen_color = {0.1f, 0.2f, 0.3f};
    material.sheen_roughness = 0.4f;
    material.anisotropy = 0.6f;
    material.anisotropy_rotation_rad = 0.3f;
    material.alpha_mode = scene::AlphaMode::Mask;
    material.alpha_cutoff = 0.3f;
    material.double_sided = true;
    material.weather.height = {.texture = 0};
    material.weather.snow_mask = {.texture = 0};
    material.weather.puddle_mask = {.texture = 0};
    material.weather.height_scale_m = 0.031f;
    material.weather.snow_slope_damp = 1.5f;
    material.weather.snow_accumulation = {0.1f, 0.9f};
    material.weather.water_color = {0.1f, 0.2f, 0.3f, 0.4f};
    material.weather.flow_speed = 0.7f;
    material.weather.sheltered = true;
    scene.materials.push_back(material);
    MeshBuilder box(1.0f);
    box.color = {0.2f, 0.4f, 0.6f, 1.0f};
    box.weather = {1.0f, 0.4f, 0.8f, 1.0f};
    box.box({.half = glm::vec3(0.5f), .bevel_m = 0.1f});
    scene.meshes.push_back({.name = "box", .primitives = {box.take(0)}});
    glm::mat4 to_world(1.0f);
    to_world[3] = {1.0f, 2.0f, 3.0f, 1.0f};
    scene.instances.push_back({.name = "first", .mesh = 0});
    scene.instances.push_back({.name = "second", .mesh = 0, .to_world = to_world});
    scene::Light spot;
    spot.name = "spot";
    spot.kind = scene::LightKind::Spot;
    spot.direction = glm::normalize(glm::vec3(1.0f, -2.0f, 0.5f));
    spot.inner_cone_rad = 0.2f;
    spot.outer_cone_rad = 0.5f;
    spot.range_m = 7.0f;
    scene.lights.push_back(spot);
    scene::Camera camera;
    camera.name = "map";
    camera.orthographic_height_m = 4.0f;
    scene.cameras.push_back(camera);
    return scene;
}

TEST(GlbWriter, KeepsEveryField)
{
    const scene::Scene scene = read_back(write_glb(small_scene()));
    const scene::Material& a = scene.materials.front();
    const scene::Scene original = small_scene();
    const scene::Material& b = original.materials.front();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.base_color_texture.offset, b.base_color_texture.offset);
    EXPECT_EQ(a.base_color_texture.scale, b.base_color_texture.scale);
    EXPECT_FLOAT_EQ(a.base_color_texture.rotation_rad, b.base_color_texture.rotation_rad);
    EXPECT_FLOAT_EQ(a.metallic, b.metallic);
    EXPECT_FLOAT_EQ(a.roughness, b.roughness);
    EXPECT_NEAR(a.emissive.x * a.emissive_strength, b.emissive.x, 1e-4f);
    EXPECT_FLOAT_EQ(a.ior, b.ior);
    EXPECT_FLOAT_EQ(a.specular, b.specular);
    EXPECT_FLOAT_EQ(a.transmission, b.transmission);
    EXPECT_FLOAT_EQ(a.clearcoat, b.clearcoat);
    EXPECT_FLOAT_EQ(a.clearcoat_roughness, b.clearcoat_roughness);
    EXPECT_FLOAT_EQ(a.sheen_roughness, b.sheen_roughness);
    EXPECT_FLOAT_EQ(a.anisotropy, b.anisotropy);
    EXPECT_FLOAT_EQ(a.anisotropy_rotation_rad, b.anisotropy_rotation_rad);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_FLOAT_EQ(a.alpha_cutoff, b.alpha_cutoff);
    EXPECT_TRUE(a.double_sided);
    EXPECT_TRUE(a.weather.height.present() && a.weather.snow_mask.present() &&
                a.weather.puddle_mask.present());
    EXPECT_FLOAT_EQ(a.weather.height_scale_m, b.weather.height_scale_m);
    EXPECT_FLOAT_EQ(a.weather.snow_slope_damp, b.weather.snow_slope_damp);
    EXPECT_FLOAT_EQ(a.weather.snow_accumulation.x, b.weather.snow_accumulation.x);
    EXPECT_FLOAT_EQ(a.weather.water_color.w, b.weather.water_color.w);
    EXPECT_FLOAT_EQ(a.weather.flow_speed, b.weather.flow_speed);
    EXPECT_TRUE(a.weather.sheltered);
    EXPECT_LT(a.weather.porosity, 0.0f);
    const scene::EncodedImage& image = scene.textures.front();
    EXPECT_EQ(image.wrap_u, scene::Wrap::Clamp);
    EXPECT_EQ(image.wrap_v, scene::Wrap::Mirror);
    EXPECT_TRUE(image.nearest);
    const scene::Primitive& p = scene.meshes.front().primitives.front();
    ASSERT_FALSE(p.weather.empty());
    EXPECT_NEAR(p.weather.front().y, 0.4f, 0.5f / 255.0f + 1e-6f);
    EXPECT_NEAR(p.colors.front().z, 0.6f, 0.5f / 255.0f + 1e-6f);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].to_world[3], glm::vec4(1.0f, 2.0f, 3.0f, 1.0f));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_NEAR(glm::length(scene.lights[0].direction - original.lights[0].direction), 0.0f, 1e-5f);
    EXPECT_FLOAT_EQ(scene.lights[0].outer_cone_rad, 0.5f);
    EXPECT_FLOAT_EQ(scene.cameras[0].orthographic_height_m, 4.0f);
}

TEST(GlbWriter, RefusesWhatDoesNotFit)
{
    scene::Scene bad = small_scene();
    bad.meshes[0].primitives[0].indices[4] = 100000;
    EXPECT_THROW(write_glb(bad), Error);
    bad = small_scene();
    bad.meshes[0].primitives[0].uv0.pop_back();
    EXPECT_THROW(write_glb(bad), Error);
    bad = small_scene();
    bad.materials[0].normal_texture.texture = 3;
    EXPECT_THROW(write_glb(bad), Error);
    bad = small_scene();
    bad.instances[0].mesh = 1;
    EXPECT_THROW(write_glb(bad), Error);
}

TEST(MeshBuilder, BoxIsClosed)
{
    // Every edge of a closed surface is shared by two triangles that run along it in opposite ways.
    for (const float bevel : {0.0f, 0.05f}) {
        MeshBuilder builder(1.0f);
        builder.box({.centre = {1.0f, 2.0f, 3.0f}, .half = {0.5f, 0.25f, 0.75f}, .bevel_m = bevel});
        const scene::Primitive p = builder.take(0);
        const auto key = [&](std::uint32_t i) {
            std::ostringstream text;
            text << std::lround(p.positions[i].x * 1e4f) << ' '
                 << std::lround(p.positions[i].y * 1e4f) << ' '
                 << std::lround(p.positions[i].z * 1e4f);
            return text.str();
        };
        std::map<std::string, int> edges;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::string a = key(p.indices[i + k]);
                const std::string b = key(p.indices[i + (k + 1) % 3]);
                ++edges[a + ">" + b];
                --edges[b + ">" + a];
            }
        }
        for (const auto& [edge, count] : edges) EXPECT_EQ(count, 0) << edge;
        EXPECT_EQ(p.indices.size() / 3, bevel > 0.0f ? 44u : 12u);
    }
}

TEST(MeshBuilder, WallTextureRunsRightAndDown)
{
    MeshBuilder builder(2.0f);
    // A wall that faces +z, seen from +z: x to the right, y up.
    builder.quad({0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0});
    const scene::Primitive p = builder.take(0);
    EXPECT_NEAR(p.normals[0].z, 1.0f, 1e-6f);
    EXPECT_NEAR(p.uv0[1].x - p.uv0[0].x, 2.0f, 1e-5f);
    EXPECT_NEAR(p.uv0[3].y - p.uv0[0].y, -1.0f, 1e-5f);
}

}  // namespace
}  // namespace petrichor::demo
