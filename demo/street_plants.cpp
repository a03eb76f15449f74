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
              const vec3& color, float half_width)
{
    vec3 hang(hash_signed(h, 1), -0.6f + 0.6f * hash_signed(h, 2), hash_signed(h, 3));
    const vec3 facing = glm::normalize(
        outward + 0.45f * vec3(hash_signed(h, 4), 0.5f + hash_signed(h, 5), hash_signed(h, 6)));
    hang = glm::normalize(hang - facing * glm::dot(hang, facing));
    const vec3 side = glm::cross(facing, hang);
    const vec3 tip = at + size * hang;
    const vec3 wing = at + 0.45f * size * hang - 0.12f * size * facing;
    plants.color = vec4(color, 1.0f);
    // A leaf catches the light by itself, and a little as the mass that it is part of.
    const vec3 normal = glm::normalize(facing + 0.35f * outward);
    const std::uint32_t a = plants.add_vertex(at, normal, vec2(0.5f, 0.0f));
    const std::uint32_t b = plants.add_vertex(
        wing + half_width * size * side, glm::normalize(normal + 0.3f * side), vec2(1.0f, 0.5f));
    const std::uint32_t c = plants.add_vertex(tip, normal, vec2(0.5f, 1.0f));
    const std::uint32_t d = plants.add_vertex(
        wing - half_width * size * side, glm::normalize(normal - 0.3f * side), vec2(0.0f, 0.5f));
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

// A flat strip that ends in a point.
void add_twig(MeshBuilder& plants, const vec3& root, const vec3& bend, const vec3& tip, float width)
{
    const vec3 side = glm::normalize(glm::cross(tip - root, vec3(0.3f, 1.0f, 0.5f))) * (0.5f * width);
    const vec3 normal = glm::normalize(glm::cross(side, tip - root));
    const std::uint32_t a = plants.add_vertex(root - side, normal, vec2(0.5f)), b = plants.add_vertex(root + side, normal, vec2(0.5f));
    const std::uint32_t c = plants.add_vertex(bend - 0.7f * side, normal, vec2(0.5f)), d = plants.add_vertex(bend + 0.7f * side, normal, vec2(0.5f));
    const std::uint32_t e = plants.add_vertex(tip, normal, vec2(0.5f));
    plants.add_triangle(a, b, d);
    plants.add_triangle(a, d, c);
    plants.add_triangle(c, d, e);
}

// Twigs that bear leaves on their outer half. A garden wall hides its foot, which has none.
void add_bush(Kit& kit, const vec3& centre, const vec3& radii, int leaves, int index)
{
    MeshBuilder& plants = kit[Slot::Blades];
    const auto lump = [](const vec3& n) { return 1.0f + 0.13f * std::sin(5.0f * std::atan2(n.z, n.x) + 3.0f * n.y) + 0.08f * std::sin(9.0f * n.y); };
    // A dark core, so that the leaves need not hide what is behind.
    plants.color = vec4(0.010f, 0.019f, 0.006f, 1.0f);
    plants.grid(16, 8, [&](int i, int j) {
        const float angle = 6.2831853f * static_cast<float>(i) / 16.0f;
        const float polar = 3.14159265f * static_cast<float>(j) / 8.0f;
        const vec3 n(std::sin(polar) * std::cos(angle), std::cos(polar), std::sin(polar) * std::sin(angle));
        // Its poles are points.
        const float lumpy = 1.0f + (lump(n) - 1.0f) * std::sin(polar);
        return MeshBuilder::Point{centre + 0.44f * lumpy * radii * n, glm::normalize(n / radii), vec2(0.5f), plants.color, plants.weather};
    });
    constexpr int kPerTwig = 14;
    for (int k = 0; k < leaves / kPerTwig; ++k) {
        const std::uint32_t h = hash_cell(k, index, kit.seed + 84u);
        const float up = -0.35f + 1.35f * hash_unit(h, 30);
        const float angle = 6.2831853f * hash_unit(h, 31);
        const float flat = std::sqrt(std::max(0.0f, 1.0f - up * up));
        const vec3 out(flat * std::cos(angle), up, flat * std::sin(angle));
        const float reach = lump(out) * (0.80f + 0.32f * hash_unit(h, 32) * hash_unit(h, 33));
        const vec3 tip = centre + radii * out * reach + vec3(0.0f, 0.06f, 0.0f);
        const vec3 root = centre + radii * out * (0.35f * reach);
        const vec3 bend = 0.5f * (root + tip) - vec3(0.0f, 0.05f, 0.0f);
        plants.color = vec4(0.060f, 0.044f, 0.028f, 1.0f);
        add_twig(plants, root, bend, tip, 0.010f);
        // Leaves of a twig are of an age.
        const vec3 fresh = glm::mix(vec3(0.055f, 0.120f, 0.028f), vec3(0.150f, 0.215f, 0.048f), hash_unit(h, 34));
        for (int i = 0; i < kPerTwig; ++i) {
            const std::uint32_t g = hash_cell(i, k, kit.seed + 86u + static_cast<std::uint32_t>(index));
            const float t = 0.32f + 0.68f * std::sqrt(hash_unit(g, 50));
            const vec3 on = (1.0f - t) * ((1.0f - t) * root + t * bend) + t * ((1.0f - t) * bend + t * tip);
            const vec3 beside(hash_signed(g, 51), hash_signed(g, 52), hash_signed(g, 53));
            const vec3 outward = glm::normalize(out + 0.55f * beside);
            const float light = (0.30f + 0.75f * t * t) * (0.80f + 0.20f * out.y) * (0.80f + 0.40f * hash_unit(g, 54));
            const vec3 color = hash_unit(g, 55) > 0.965f ? vec3(0.22f, 0.17f, 0.05f) : fresh;
            add_leaf(plants, on + 0.085f * (1.25f - 0.5f * t) * beside, outward, 0.058f + 0.034f * hash_unit(g, 56), g, color * light, 0.31f);
        }
    }
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
    const Bush bushes[] = {{{4.25f, 0.85f, -1.1f}, {0.62f, 0.72f, 0.72f}, 2400},
                           {{4.05f, 0.70f, 0.55f}, {0.50f, 0.55f, 0.60f}, 1500},
                           {{5.2f, 1.15f, -0.6f}, {0.85f, 1.05f, 0.85f}, 2200}};
    int index = 0;
    for (const Bush& bush : bushes) {
        add_bush(kit, bush.centre, bush.radii, bush.leaves, index++);
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
        const float off = hash_unit(h, 43);
        const vec3 at(kLeftWall + 0.02f + 0.11f * hump * off, pavement_height(kLeftWall) + v, z);
        // Those by the wall lie in the shade of the others; here and there one is young, or turns.
        const float kind = hash_unit(h, 44);
        const vec3 green = kind > 0.97f   ? vec3(0.23f, 0.13f, 0.04f)
                           : kind > 0.80f ? vec3(0.165f, 0.240f, 0.055f)
                                          : glm::mix(vec3(0.040f, 0.105f, 0.026f), vec3(0.105f, 0.180f, 0.042f), kind / 0.8f);
        const vec3 color = green * ((0.35f + 0.65f * off) * (0.75f + 0.45f * hash_unit(h, 45)));
        add_leaf(plants, at, vec3(1, 0, 0), 0.065f + 0.045f * hash_unit(h, 46), h, color);
    }
    plants.color = vec4(1.0f);
    plants.weather = vec4(1.0f);
}

}  // namespace petrichor::demo
