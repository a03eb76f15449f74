// Grass along the garden wall, a bush and ivy: small curved triangles, no alpha.
#include <algorithm>
#include <cmath>

#include "demo/street_parts.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using texproc::hash_cell;
using texproc::hash_signed;
using texproc::hash_unit;

void add_leaf(MeshBuilder& plants, const vec3& at, const vec3& outward, float size, std::uint32_t h,
              const vec3& color)
{
    vec3 hang(hash_signed(h, 1), -0.6f + 0.6f * hash_signed(h, 2), hash_signed(h, 3));
    const vec3 facing = glm::normalize(
        outward + 0.45f * vec3(hash_signed(h, 4), 0.5f + hash_signed(h, 5), hash_signed(h, 6)));
    hang = glm::normalize(hang - facing * glm::dot(hang, facing));
    const vec3 side = glm::cross(facing, hang);
    const vec3 tip = at + size * hang;
    const vec3 wing = at + 0.45f * size * hang - 0.12f * size * facing;
    plants.color = vec4(color, 1.0f);
    const vec3 normal = glm::normalize(facing + 0.6f * outward);
    const std::uint32_t a = plants.add_vertex(at, normal, vec2(0.5f, 0.0f));
    const std::uint32_t b = plants.add_vertex(
        wing + 0.42f * size * side, glm::normalize(normal + 0.3f * side), vec2(1.0f, 0.5f));
    const std::uint32_t c = plants.add_vertex(tip, normal, vec2(0.5f, 1.0f));
    const std::uint32_t d = plants.add_vertex(
        wing - 0.42f * size * side, glm::normalize(normal - 0.3f * side), vec2(0.0f, 0.5f));
    plants.add_triangle(a, c, b);
    plants.add_triangle(a, d, c);
}

namespace {

// Two bent segments and a tip. Normals lean upwards, so a clump shades as one soft mass.
void add_blade(MeshBuilder& plants, const vec3& root, float height, float width, std::uint32_t h,
               const vec3& color)
{
    const float heading = 6.2831853f * hash_unit(h, 1);
    const vec3 lean(std::cos(heading), 0.0f, std::sin(heading));
    const float turn = heading + 1.57f + 0.8f * hash_signed(h, 2);
    const vec3 across(std::cos(turn), 0.0f, std::sin(turn));
    const float bend = height * (0.20f + 0.45f * hash_unit(h, 3));
    const vec3 face = glm::normalize(
        glm::cross(across, vec3(0.0f, 0.85f * height, 0.0f) + bend * lean));
    const vec3 normal = glm::normalize(vec3(0.0f, 0.75f, 0.0f) + 0.45f * face);
    std::uint32_t previous[2] = {0, 0};
    for (int k = 0; k < 3; ++k) {
        const float t = 0.5f * static_cast<float>(k);
        const vec3 p =
            root + vec3(0.0f, height * (t - 0.15f * t * t), 0.0f) + lean * (bend * t * t);
        const float half = 0.5f * width * (1.0f - 0.35f * t);
        const float light = 0.45f + 0.65f * t;
        plants.color = vec4(glm::min(color * light, vec3(1.0f)), 1.0f);
        if (k == 2) {
            const std::uint32_t tip = plants.add_vertex(p, normal, vec2(0.0f, 1.0f - t));
            plants.add_triangle(previous[0], previous[1], tip);
            break;
        }
        const std::uint32_t a = plants.add_vertex(p - half * across, normal, vec2(0.0f, 1.0f - t));
        const std::uint32_t b = plants.add_vertex(p + half * across, normal, vec2(1.0f, 1.0f - t));
        if (k > 0) {
            plants.add_triangle(previous[0], previous[1], b);
            plants.add_triangle(previous[0], b, a);
        }
        previous[0] = a;
        previous[1] = b;
    }
}

vec3 grass_color(std::uint32_t h)
{
    const float dry = hash_unit(h, 11);
    const vec3 fresh =
        glm::mix(vec3(0.075f, 0.150f, 0.026f), vec3(0.165f, 0.235f, 0.050f), hash_unit(h, 12));
    return dry > 0.85f ? glm::mix(fresh, vec3(0.26f, 0.21f, 0.10f), 0.8f) : fresh;
}

}  // namespace

void add_plants(Kit& kit)
{
    MeshBuilder& plants = kit[Slot::Blades];
    plants.weather = vec4(1.0f, 0.0f, 0.6f, 1.0f);

    // The verge: clumps, thicker towards the wall.
    constexpr int kClumps = 460;
    for (int c = 0; c < kClumps; ++c) {
        const std::uint32_t h = hash_cell(c, 1, kit.seed + 80u);
        const float z = kGarden + 0.2f + (6.4f - kGarden) * hash_unit(h, 1);
        const float t = std::sqrt(hash_unit(h, 2));
        const float x = kKerbEnd + 0.03f + (kRightWall - kKerbEnd - 0.05f) * t;
        const bool by_lamp = glm::length(vec2(x - kLampFoot.x, z - kLampFoot.z)) < 0.22f;
        if (by_lamp) continue;
        const int blades = 6 + static_cast<int>(7.0f * hash_unit(h, 3));
        const float tall = (0.09f + 0.15f * hash_unit(h, 4)) * (0.6f + 0.55f * t);
        for (int b = 0; b < blades; ++b) {
            const std::uint32_t g = hash_cell(b, c, kit.seed + 81u);
            const float angle = 6.2831853f * hash_unit(g, 20);
            const float r = 0.055f * hash_unit(g, 21);
            add_blade(plants,
                      vec3(x + r * std::cos(angle), kKerbTop - 0.03f, z + r * std::sin(angle)),
                      tall * (0.6f + 0.6f * hash_unit(g, 22)), 0.005f + 0.005f * hash_unit(g, 23),
                      g, grass_color(g));
        }
    }
    // Tufts in the joints: along kerbs, walls and the foot of things.
    for (int c = 0; c < 120; ++c) {
        const std::uint32_t h = hash_cell(c, 2, kit.seed + 82u);
        const float z = 6.0f - 15.5f * hash_unit(h, 1);
        const int where = static_cast<int>(4.0f * hash_unit(h, 2));
        const bool dry = z < -1.0f && z > -5.4f;
        float x = kLeftWall + 0.035f;
        float y = pavement_height(x);
        if (where == 1) {
            x = -kGutterEnd + 0.01f;
            y = -0.03f;
        } else if (where == 2) {
            x = kGutterEnd - 0.01f;
            y = -0.03f;
        } else if (where == 3) {
            x = -kKerbEnd - 0.01f;
            y = kKerbTop - 0.01f;
        } else if (dry) {
            continue;
        }
        const int blades = 4 + static_cast<int>(5.0f * hash_unit(h, 3));
        for (int b = 0; b < blades; ++b) {
            const std::uint32_t g = hash_cell(b, c, kit.seed + 83u);
            add_blade(plants,
                      vec3(x + 0.012f * hash_signed(g, 20), y, z + 0.04f * hash_signed(g, 21)),
                      0.04f + 0.07f * hash_unit(g, 22), 0.004f + 0.003f * hash_unit(g, 23), g,
                      grass_color(g));
        }
    }
    // A bush behind the garden wall, and a smaller one by the lamp.
    struct Bush {
        vec3 centre;
        vec3 radii;
        int leaves;
    };
    const Bush bushes[] = {{{4.25f, 0.85f, -1.1f}, {0.62f, 0.72f, 0.72f}, 1900},
                           {{4.05f, 0.70f, 0.55f}, {0.50f, 0.55f, 0.60f}, 1300},
                           {{5.2f, 1.15f, -0.6f}, {0.85f, 1.05f, 0.85f}, 2200}};
    int index = 0;
    for (const Bush& bush : bushes) {
        // A dark core, so that the leaves need not hide what is behind.
        plants.color = vec4(0.018f, 0.034f, 0.010f, 1.0f);
        plants.grid(16, 8, [&](int i, int j) {
            const float angle = 6.2831853f * static_cast<float>(i) / 16.0f;
            const float polar = 3.14159265f * static_cast<float>(j) / 8.0f;
            const vec3 n(std::sin(polar) * std::cos(angle), std::cos(polar),
                         std::sin(polar) * std::sin(angle));
            return MeshBuilder::Point{bush.centre + 0.72f * bush.radii * n,
                                      glm::normalize(n / bush.radii), vec2(0.5f), plants.color,
                                      plants.weather};
        });
        for (int k = 0; k < bush.leaves; ++k) {
            const std::uint32_t h = hash_cell(k, index, kit.seed + 84u);
            const float up = hash_signed(h, 30);
            const float angle = 6.2831853f * hash_unit(h, 31);
            const float flat = std::sqrt(std::max(0.0f, 1.0f - up * up));
            const vec3 outward(flat * std::cos(angle), up, flat * std::sin(angle));
            const float depth = 1.0f - 0.38f * hash_unit(h, 32) * hash_unit(h, 33);
            const float lump = 1.0f + 0.13f * std::sin(5.0f * angle + 3.0f * up) +
                               0.08f * std::sin(9.0f * up + 2.0f * angle);
            const float light = (0.30f + 0.70f * (depth - 0.62f) / 0.38f) * (0.75f + 0.25f * up);
            const vec3 color = glm::mix(vec3(0.070f, 0.145f, 0.034f), vec3(0.150f, 0.220f, 0.050f),
                                        hash_unit(h, 34)) *
                               std::max(light, 0.12f);
            add_leaf(plants, bush.centre + bush.radii * outward * depth * lump, outward,
                     0.050f + 0.030f * hash_unit(h, 35), h, color);
        }
        ++index;
    }
    // Ivy climbs the brick wall beside the door and spreads.
    for (int k = 0; k < 2400; ++k) {
        const std::uint32_t h = hash_cell(k, 9, kit.seed + 85u);
        const float v = 3.4f * std::pow(hash_unit(h, 40), 1.25f);
        const float spread = 0.14f + 0.26f * v * (1.0f - 0.17f * v);
        const float stem = -0.88f + 0.16f * std::sin(1.7f * v) + 0.07f * std::sin(5.1f * v + 1.0f);
        const float across = hash_signed(h, 41) * (0.35f + 0.65f * hash_unit(h, 42));
        const float z = stem + spread * across;
        const float hump = 1.0f - std::abs(across);
        const vec3 at(kLeftWall + 0.02f + 0.07f * hump * hash_unit(h, 43),
                      pavement_height(kLeftWall) + v, z);
        const vec3 color =
            glm::mix(vec3(0.050f, 0.125f, 0.028f), vec3(0.130f, 0.205f, 0.045f), hash_unit(h, 44)) *
            (0.55f + 0.45f * hash_unit(h, 45));
        add_leaf(plants, at, vec3(1, 0, 0), 0.065f + 0.045f * hash_unit(h, 46), h, color);
    }
    plants.color = vec4(1.0f);
    plants.weather = vec4(1.0f);
}

}  // namespace petrichor::demo
