// The height map as geometry: where points go, and how finely the mesh is cut.
#include "film/scenes/displacement.h"

#include <gtest/gtest.h>


#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "scene/material_table.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kTexels = 64;

scene::EncodedImage picture(const std::function<float(vec2)>& height)
{
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            const float h = height((vec2(x, y) + 0.5f) / static_cast<float>(kTexels));
            for (int c = 0; c < 3; ++c)
                rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(h, 0.0f, 1.0f))));
        }
    }
    scene::EncodedImage image;
    image.name = "height";
    image.bytes = texproc::encode_png8(kTexels, kTexels, 3, rgb);
    image.wrap_u = image.wrap_v = scene::Wrap::Clamp;
    return image;
}

// Level ground from x = 0 to `length`, 1 m wide, whose texture lies over it once.
scene::Scene ground(float length = 1.0f)
{
    scene::Scene scene;
    scene.textures.push_back(picture([](vec2 uv) { return uv.x; }));
    scene::Material m;
    m.name = "ground";
    m.weather.height.texture = 0;
    m.displacement.height_m = 0.4f;
    m.displacement.edge_m = 0.1f;
    scene.materials = {m};
    scene::Primitive p;
    for (const vec2 at : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
        p.positions.emplace_back(at.x * length, 0.0f, -at.y);
        p.normals.emplace_back(0.0f, 1.0f, 0.0f);
        p.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        p.uv0.push_back(at);
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back({"ground", {p}});
    scene.instances.push_back({"ground", 0, glm::mat4(1.0f)});
    return scene;
}

const scene::Primitive& shape_of(const scene::Scene& scene)
{
    return scene.meshes[0].primitives[0];
}

std::size_t triangles(const scene::Scene& scene)
{
    return shape_of(scene).indices.size() / 3;
}

float longest_edge(const scene::Primitive& p, float from_x = -1e9f, float to_x = 1e9f)
{
    float longest = 0.0f;
    for (std::size_t k = 0; k < p.indices.size(); ++k) {
        const vec3 a = p.positions[p.indices[k]];
        const vec3 b = p.positions[p.indices[k % 3 == 2 ? k - 2 : k + 1]];
        if (std::min(a.x, b.x) >= from_x && std::max(a.x, b.x) <= to_x)
            longest = std::max(longest, glm::length(vec2(a.x - b.x, a.z - b.z)));
    }
    return longest;
}

TEST(Displacement, MovesPointsByTheHeightMap)
{
    scene::Scene scene = ground();
    EXPECT_TRUE(wants_displacement(scene));
    EXPECT_TRUE(displace(scene, {}).empty());
    const scene::Primitive& p = shape_of(scene);
    EXPECT_GT(p.positions.size(), 100u);
    float worst = 0.0f;
    for (const vec3& x : p.positions) {
        // At its edge the map is filtered from one side.
        if (x.x > 0.1f && x.x < 0.9f) worst = std::max(worst, std::abs(x.y - 0.4f * (x.x - 0.5f)));
    }
    EXPECT_LT(worst, 0.006f);
    // Without a normal map the normals are those of the new shape: 0.4 m in a metre.
    const auto middle = std::find_if(p.positions.begin(), p.positions.end(), [](const vec3& x) {
        return std::abs(x.x - 0.5f) < 0.1f && std::abs(x.z + 0.5f) < 0.1f;
    });
    ASSERT_NE(middle, p.positions.end());
    const vec3 n = p.normals[static_cast<std::size_t>(middle - p.positions.begin())];
    EXPECT_NEAR(-n.x / n.y, 0.4f, 0.03f);
}

TEST(Displacement, OffItLeavesTheMeshAlone)
{
    scene::Scene scene = ground();
    scene.materials[0].displacement.height_m = 0.0f;
    EXPECT_FALSE(wants_displacement(scene));
    displace(scene, {});
    EXPECT_EQ(triangles(scene), 2u);
}

TEST(Displacement, NoEdgeIsLongerThanItsLimit)
{
    for (const float edge : {0.3f, 0.1f, 0.04f}) {
        scene::Scene scene = ground();
        scene.materials[0].displacement.edge_m = edge;
        displace(scene, {});
        EXPECT_LE(longest_edge(shape_of(scene)), edge);
        EXPECT_GT(longest_edge(shape_of(scene)), 0.4f * edge);
    }
}

// The eye is at x = 0: up to 4 m edges are short, then longer, and from 12 m on nothing is cut or moved.
TEST(Displacement, EdgesAndHeightsFollowTheDistanceOfTheNearestEye)
{
    scene::Scene scene = ground(32.0f);
    scene::Displacement& d = scene.materials[0].displacement;
    d.near_m = 4.0f;
    d.far_m = 12.0f;
    d.most = 1024.0f;
    const std::vector<vec3> eyes{{0.0f, 0.5f, -0.5f}};
    displace(scene, eyes);
    const scene::Primitive& p = shape_of(scene);
    EXPECT_LE(longest_edge(p, -1.0f, 3.5f), 0.1f);
    EXPECT_GT(longest_edge(p, 8.0f, 11.0f), 0.15f);
    EXPECT_GT(longest_edge(p, 14.0f, 40.0f), 2.0f);
    float far_up = 0.0f, near_up = 0.0f;
    for (const vec3& x : p.positions) {
        if (x.x > 12.6f) far_up = std::max(far_up, std::abs(x.y));
        if (x.x < 4.0f) near_up = std::max(near_up, std::abs(x.y));
    }
    EXPECT_EQ(far_up, 0.0f);
    EXPECT_NEAR(near_up, 0.2f, 0.03f);
    scene::Scene everywhere = ground(32.0f);
    everywhere.materials[0].displacement.near_m = 100.0f;
    everywhere.materials[0].displacement.far_m = 200.0f;
    everywhere.materials[0].displacement.most = 1024.0f;
    displace(everywhere, eyes);
    EXPECT_GT(triangles(everywhere), 2 * triangles(scene));
}

TEST(Displacement, AnEdgeBecomesAtMostSoMany)
{
    scene::Scene scene = ground();
    scene.materials[0].displacement.edge_m = 0.001f;
    scene.materials[0].displacement.most = 4.0f;
    displace(scene, {});
    EXPECT_EQ(triangles(scene), 32u);
    scene.meshes = ground().meshes;
    scene.materials[0].displacement.most = 1024.0f;
    const auto notes = displace(scene, {});
    EXPECT_LE(triangles(scene), 2'000'000u);
    ASSERT_EQ(notes.size(), 1u) << "the limit of triangles is said";
    EXPECT_NE(notes[0].find("triangles"), std::string::npos);
}

TEST(Displacement, PhongAloneRoundsAMesh)
{
    scene::Scene scene = ground();
    scene.materials[0].displacement.height_m = 0.0f;
    scene.materials[0].displacement.phong = 0.75f;
    // Normals that lean outwards: the sheet is the top of a dome.
    for (auto& p : scene.meshes[0].primitives) {
        for (std::size_t v = 0; v < p.normals.size(); ++v)
            p.normals[v] = glm::normalize(vec3(p.positions[v].x - 0.5f, 1.0f, p.positions[v].z + 0.5f));
    }
    displace(scene, {});
    float top = 0.0f;
    for (const vec3& x : shape_of(scene).positions) top = std::max(top, x.y);
    EXPECT_GT(top, 0.1f);
}

// Half of the ground is the first set, half the second: heights are mixed as colours are.
TEST(Displacement, MixedSetsMixTheirHeights)
{
    scene::Scene scene = ground();
    scene.textures = {picture([](vec2) { return 1.0f; }), picture([](vec2) { return 0.25f; }),
                      picture([](vec2 uv) { return uv.x < 0.5f ? 1.0f : 0.0f; })};
    scene::Material& m = scene.materials[0];
    m.second.use = scene::SecondSetUse::Mix;
    m.second.height.texture = 1;
    m.second.mix_mask.texture = 2;
    displace(scene, {});
    for (const vec3& x : shape_of(scene).positions) {
        if (x.x < 0.3f || x.x > 0.7f) {
            EXPECT_NEAR(x.y, x.x < 0.3f ? 0.2f : -0.1f, 0.003f) << x.x;
        }
    }
}

// A box whose faces have coordinates of their own: where two faces meet they read other heights, and
// still move as one.
TEST(Displacement, SeamsStayTogether)
{
    scene::Scene scene = ground();
    scene.textures[0] = picture([](vec2 uv) {
        return 0.5f + 0.5f * std::sin(17.0f * uv.x) * std::cos(11.0f * uv.y);
    });
    scene::Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1.0f;
            const auto first = static_cast<std::uint32_t>(p.positions.size());
            for (const vec2 at : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
                p.positions.push_back(0.5f * (n + u * at.x + v * at.y));
                p.normals.push_back(n);
                p.uv0.push_back(0.5f + 0.3f * at + 0.1f * vec2(n.x, n.z));
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
        }
    }
    scene.meshes[0].primitives = {p};
    displace(scene, {});
    std::map<std::array<float, 6>, int> ways;
    const scene::Primitive& q = shape_of(scene);
    float low = 9.0f, high = 0.0f;
    for (std::size_t k = 0; k < q.indices.size(); ++k) {
        const vec3 a = q.positions[q.indices[k]];
        const vec3 b = q.positions[q.indices[k % 3 == 2 ? k - 2 : k + 1]];
        const std::array<float, 6> there{a.x, a.y, a.z, b.x, b.y, b.z};
        const std::array<float, 6> back{b.x, b.y, b.z, a.x, a.y, a.z};
        ways[std::min(there, back)] += there < back ? 1 : -1;
        const vec3 size = glm::abs(a);
        const float face = std::max({size.x, size.y, size.z});
        low = std::min(low, face);
        high = std::max(high, face);
    }
    EXPECT_GT(high - low, 0.1f) << "it is displaced";
    EXPECT_EQ(std::count_if(ways.begin(), ways.end(), [](const auto& w) { return w.second != 0; }), 0);
}

TEST(Displacement, WithoutAHeightMapItIsSaid)
{
    scene::Scene scene = ground();
    scene.materials[0].weather.height.texture = scene::kNoTexture;
    const auto notes = displace(scene, {});
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("height_texture"), std::string::npos);
    EXPECT_EQ(triangles(scene), 2u);
}

// A row of the material table that nothing reads cannot exist.
TEST(Displacement, EveryRowOfItChangesTheMesh)
{
    int rows = 0;
    for (const scene::MaterialProperty& row : scene::material_table()) {
        if (!row.at_load) continue;
        ++rows;
        EXPECT_FALSE(row.keyed) << row.name;
        const auto made = [&](bool changed) {
            scene::Scene scene = ground(16.0f);
            scene::Material& m = scene.materials[0];
            m.displacement.edge_m = 0.4f;
            m.displacement.most = 32.0f;
            for (vec3& n : scene.meshes[0].primitives[0].normals) n = glm::normalize(vec3(n.x + 0.3f, 1, 0));
            scene.meshes[0].primitives[0].normals[0] = vec3(0, 1, 0);
            if (changed) {
                glm::vec4 value = row.get(m);
                value.x = row.name == "displacement_phong" ? 0.5f : 0.5f * value.x;
                row.set(m, value);
            }
            displace(scene, std::vector<vec3>{{0.0f, 1.0f, 0.0f}});
            return shape_of(scene).positions;
        };
        EXPECT_NE(made(false), made(true)) << row.name;
    }
    EXPECT_EQ(rows, 6);
}

}  // namespace
}  // namespace petrichor::film
