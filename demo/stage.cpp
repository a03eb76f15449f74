#include "demo/stage.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "demo/mesh_builder.h"
#include "scene/light_shape.h"

namespace petrichor::demo {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kTurn = 6.2831853f;
constexpr vec3 kBust{0.0f, 0.95f, -0.7f}, kUrn{-1.35f, 0.75f, -0.75f}, kRing{1.35f, 0.85f, -0.75f};

struct Builder {
    scene::Scene scene;

    std::uint32_t material(const std::string& name, const vec3& color, float roughness, float metallic = 0.0f)
    {
        scene::Material m;
        m.name = name;
        m.base_color = glm::vec4(color, 1.0f);
        m.roughness = roughness;
        m.metallic = metallic;
        scene.materials.push_back(std::move(m));
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    void place(MeshBuilder& mesh, std::uint32_t material)
    {
        const std::string name = scene.materials[material].name;
        scene.meshes.push_back({name, {mesh.take(material)}});
        scene.instances.push_back({.name = name, .mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1)});
    }
};

// A rectangle with second coordinates that cover it once.
void add_sheet(Builder& to, std::uint32_t material, const vec3& corner, const vec3& along, const vec3& up,
               int columns, int rows)
{
    MeshBuilder mesh(1.0f);
    const vec3 normal = glm::normalize(glm::cross(along, up));
    mesh.grid(columns, rows, [&](int i, int j) {
        const float u = static_cast<float>(i) / static_cast<float>(columns);
        const float v = static_cast<float>(j) / static_cast<float>(rows);
        return MeshBuilder::Point{corner + u * along + v * up, normal,
                                  vec2(u * glm::length(along), -v * glm::length(up))};
    });
    to.place(mesh, material);
    scene::Primitive& p = to.scene.meshes.back().primitives.front();
    for (const vec3& at : p.positions) {
        const vec3 way = at - corner;
        p.uv1.emplace_back(glm::dot(way, along) / glm::dot(along, along),
                           1.0f - glm::dot(way, up) / glm::dot(up, up));
    }
}

// A closed shape about a centre: how far its surface lies in a direction, on an ellipsoid.
template <class Reach>
void add_round(MeshBuilder& mesh, const vec3& centre, const vec3& half, int columns, int rows, Reach reach)
{
    const auto at = [&](float i, float j) {
        const float a = 0.5f * kTurn * j / static_cast<float>(rows), b = kTurn * i / static_cast<float>(columns);
        const vec3 d(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b));
        return centre + d * half * reach(d);
    };
    mesh.grid(columns, rows, [&](int i, int j) {
        const auto x = static_cast<float>(i), y = static_cast<float>(j);
        const bool pole = j == 0 || j == rows;
        const vec3 p = at(x, y);
        const vec3 down = at(x, y + 0.01f) - at(x, y - 0.01f);
        const vec3 right = at(x + 0.01f, y) - at(x - 0.01f, y);
        const vec3 normal = pole ? vec3(0.0f, j == 0 ? 1.0f : -1.0f, 0.0f) : glm::normalize(glm::cross(down, right));
        return MeshBuilder::Point{p, normal, vec2(x / static_cast<float>(columns), y / static_cast<float>(rows))};
    });
}

struct Bump {
    vec3 towards;
    float height, sharp;
};

// Nose, brow, sockets, cheeks, lips and chin, as bumps of an ellipsoid.
constexpr std::array<Bump, 15> kFace{{
    {{0.0f, -0.16f, 1.0f}, 0.22f, 110.0f},  {{0.0f, 0.02f, 1.0f}, 0.12f, 120.0f},
    {{0.0f, 0.16f, 1.0f}, 0.06f, 90.0f},    {{0.28f, 0.30f, 0.92f}, 0.05f, 60.0f},
    {{-0.28f, 0.30f, 0.92f}, 0.05f, 60.0f}, {{0.32f, 0.12f, 0.93f}, -0.10f, 90.0f},
    {{-0.32f, 0.12f, 0.93f}, -0.10f, 90.0f}, {{0.55f, -0.12f, 0.8f}, 0.05f, 25.0f},
    {{-0.55f, -0.12f, 0.8f}, 0.05f, 25.0f}, {{0.0f, -0.44f, 0.95f}, 0.07f, 160.0f},
    {{0.0f, -0.56f, 0.93f}, 0.07f, 160.0f}, {{0.0f, -0.5f, 0.95f}, -0.03f, 400.0f},
    {{0.0f, -0.82f, 0.72f}, 0.12f, 40.0f},  {{0.45f, -0.7f, 0.4f}, 0.06f, 14.0f},
    {{-0.45f, -0.7f, 0.4f}, 0.06f, 14.0f},
}};

void add_bust(MeshBuilder& mesh, const vec3& foot)
{
    mesh.lathe(foot, {{0.0f, 0.0f}, {0.13f, 0.0f}, {0.14f, 0.015f}, {0.10f, 0.04f}, {0.075f, 0.08f},
                      {0.20f, 0.12f}, {0.245f, 0.18f}, {0.22f, 0.245f}, {0.135f, 0.285f}, {0.088f, 0.315f},
                      {0.078f, 0.36f}, {0.082f, 0.44f}, {0.0f, 0.45f}}, 64);
    const vec3 head = foot + vec3(0.0f, 0.53f, 0.015f);
    add_round(mesh, head, vec3(0.125f, 0.165f, 0.15f), 96, 72, [](const vec3& d) {
        float reach = 1.0f - 0.10f * std::max(-d.y, 0.0f) * std::max(-d.z, 0.0f);
        for (const Bump& b : kFace) {
            const float away = 1.0f - glm::dot(d, glm::normalize(b.towards));
            reach += b.height * std::exp(-b.sharp * away);
        }
        return reach;
    });
    // Ears: thin, so that light comes through.
    for (const float side : {-1.0f, 1.0f}) {
        add_round(mesh, head + vec3(side * 0.128f, 0.01f, -0.012f), vec3(0.012f, 0.042f, 0.026f), 24, 16,
                  [&](const vec3& d) { return 1.0f + 0.15f * d.y - 0.2f * std::exp(-6.0f * (1.0f - side * d.x)); });
        // Eyes.
        add_round(mesh, head + vec3(side * 0.043f, 0.022f, 0.112f), vec3(0.021f, 0.017f, 0.018f), 24, 16,
                  [](const vec3&) { return 1.0f; });
    }
}

void add_ring(MeshBuilder& mesh, const vec3& centre, float radius, float thick)
{
    constexpr int kAround = 72, kAcross = 28;
    mesh.grid(kAround, kAcross, [&](int i, int j) {
        const float a = kTurn * static_cast<float>(i) / kAround, b = kTurn * static_cast<float>(j) / kAcross;
        const vec3 out(std::cos(a), std::sin(a), 0.0f);
        const vec3 n = out * std::cos(b) + vec3(0.0f, 0.0f, -std::sin(b));
        return MeshBuilder::Point{centre + out * radius + n * thick, n, vec2(a * radius, b * thick)};
    });
}

// A lamp of a shape and a body that shows it.
void add_lamp(Builder& to, scene::Light light, const scene::LightShape& shape, MeshBuilder body)
{
    const std::string problem = scene::shape_light(light, shape);
    if (problem.empty()) scene::turn_shape(light);
    const vec3 color = light.color;
    const std::uint32_t glow = to.material(light.name, vec3(0.8f), 0.6f);
    scene::Material& m = to.scene.materials[glow];
    m.emissive = color;
    m.emissive_strength = 600.0f;
    m.casts_shadows = false;
    // Left out of the patches, whose rays would start within.
    m.alpha_mode = scene::AlphaMode::Blend;
    to.scene.lights.push_back(std::move(light));
    to.place(body, glow);
}

// 0: not said.
scene::LightShape shape_of(float radius_m, float length_m, float width_m, float height_m)
{
    scene::LightShape shape;
    if (radius_m > 0.0f) shape.radius_m = radius_m;
    if (length_m > 0.0f) shape.length_m = length_m;
    if (width_m > 0.0f) shape.width_m = width_m;
    if (height_m > 0.0f) shape.height_m = height_m;
    return shape;
}

scene::Light lamp(const char* name, scene::LightKind kind, const vec3& color, float candela, const vec3& at)
{
    scene::Light light;
    light.name = name;
    light.kind = kind;
    light.color = color;
    light.intensity = candela;
    light.range_m = 12.0f;
    light.position_m = at;
    return light;
}

void add_lamps(Builder& to)
{
    {
        const vec3 at(-1.5f, 2.0f, -1.5f);
        MeshBuilder body(1.0f);
        body.tube({at - vec3(0.6f, 0, 0), at + vec3(0.6f, 0, 0)}, 0.03f, 24);
        scene::Light light = lamp("tube", scene::LightKind::Point, {1.0f, 0.78f, 0.5f}, 90.0f, at);
        light.up = vec3(1, 0, 0);
        add_lamp(to, light, shape_of(0.03f, 1.2f, 0, 0), std::move(body));
    }
    {
        const vec3 at(2.3f, 1.7f, -0.4f);
        MeshBuilder body(1.0f);
        const vec3 right(0, 0, -0.35f), up(0, 0.45f, 0);
        body.quad(at - right - up, at - right + up, at + right + up, at + right - up);
        body.quad(at - right - up, at + right - up, at + right + up, at - right + up);
        scene::Light light = lamp("panel", scene::LightKind::Spot, {0.55f, 0.75f, 1.0f}, 120.0f, at);
        light.direction = vec3(-1, 0, 0);
        light.outer_cone_rad = 1.4f;
        add_lamp(to, light, shape_of(0, 0, 0.7f, 0.9f), std::move(body));
    }
    {
        const vec3 at(1.72f, 0.34f, 0.75f);
        MeshBuilder body(1.0f);
        add_round(body, at, vec3(0.11f), 32, 24, [](const vec3&) { return 1.0f; });
        add_lamp(to, lamp("bulb", scene::LightKind::Point, {1.0f, 0.35f, 0.2f}, 14.0f, at), shape_of(0.11f, 0, 0, 0),
                 std::move(body));
    }
    {
        const vec3 at(-2.6f, 1.3f, 0.9f);
        MeshBuilder body(1.0f);
        const glm::mat3 lies(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, -1));
        body.lathe(at, {{0.28f, 0.0f}, {0.0f, 0.004f}}, 48, lies);
        scene::Light light = lamp("disc", scene::LightKind::Spot, {0.6f, 1.0f, 0.7f}, 60.0f, at);
        light.direction = vec3(1, 0, 0);
        light.outer_cone_rad = 1.4f;
        add_lamp(to, light, shape_of(0.28f, 0, 0, 0), std::move(body));
    }
}

}  // namespace

scene::Scene make_demo_stage()
{
    Builder to;
    to.scene.name = "stage";
    add_sheet(to, to.material("floor", vec3(0.3f), 0.3f), {-5, 0, 4}, {10, 0, 0}, {0, 0, -6}, 40, 24);
    add_sheet(to, to.material("wall", {0.5f, 0.48f, 0.45f}, 0.9f), {-5, 0, -2}, {10, 0, 0}, {0, 3.4f, 0}, 40, 14);
    const std::uint32_t stone = to.material("plinth", {0.46f, 0.45f, 0.43f}, 0.75f);
    for (const vec3& top : {kBust, kUrn, kRing}) {
        MeshBuilder mesh(1.0f);
        const float half = 0.5f * top.y;
        mesh.box({.centre = {top.x, half - 0.02f, top.z}, .half = {0.24f, half - 0.02f, 0.24f}, .bevel_m = 0.012f});
        mesh.box({.centre = {top.x, top.y - 0.03f, top.z}, .half = {0.28f, 0.03f, 0.28f}, .bevel_m = 0.01f});
        to.place(mesh, stone);
    }
    {
        MeshBuilder mesh(1.0f);
        add_bust(mesh, kBust);
        to.place(mesh, to.material("bust", {0.75f, 0.5f, 0.4f}, 0.42f));
    }
    {
        MeshBuilder mesh(1.0f);
        mesh.lathe(kUrn, {{0.0f, 0.0f}, {0.10f, 0.0f}, {0.105f, 0.02f}, {0.05f, 0.06f}, {0.045f, 0.09f},
                          {0.14f, 0.18f}, {0.18f, 0.29f}, {0.165f, 0.38f}, {0.10f, 0.445f}, {0.085f, 0.47f},
                          {0.11f, 0.51f}, {0.125f, 0.52f}, {0.115f, 0.525f}, {0.075f, 0.475f}, {0.0f, 0.46f}}, 72);
        to.place(mesh, to.material("urn", {0.55f, 0.22f, 0.12f}, 0.28f));
    }
    {
        MeshBuilder mesh(1.0f);
        add_ring(mesh, kRing + vec3(0.0f, 0.27f, 0.0f), 0.2f, 0.07f);
        to.place(mesh, to.material("ring", {0.95f, 0.78f, 0.4f}, 0.3f, 1.0f));
    }
    const std::array<float, 5> rough{0.12f, 0.35f, 0.75f, 0.18f, 0.42f};
    for (int i = 0; i < 5; ++i) {
        MeshBuilder mesh(1.0f);
        const vec3 at(-1.5f + 0.62f * static_cast<float>(i), 0.24f, 0.45f);
        add_round(mesh, at, vec3(0.24f), 56, 40, [](const vec3&) { return 1.0f; });
        const bool metal = i >= 3;
        to.place(mesh, to.material("ball " + std::to_string(i + 1), metal ? vec3(0.9f) : vec3(0.45f, 0.47f, 0.5f),
                                   rough[static_cast<std::size_t>(i)], metal ? 1.0f : 0.0f));
    }
    add_lamps(to);
    scene::Camera camera;
    camera.name = "main";
    const vec3 from(0.15f, 1.55f, 4.6f), at(0.0f, 0.85f, -0.6f);
    const vec3 back = glm::normalize(from - at), right = glm::normalize(glm::cross(vec3(0, 1, 0), back));
    camera.to_world = glm::mat4(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                                glm::vec4(back, 0.0f), glm::vec4(from, 1.0f));
    camera.vertical_fov_rad = 0.6f;
    to.scene.cameras.push_back(camera);
    return std::move(to.scene);
}

}  // namespace petrichor::demo
