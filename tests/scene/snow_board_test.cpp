// Snow around and on a board of a model: a thing as it stands on a table, looked at from near.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scene/snow_scenes.h"
#include "tests/scene/snowed.h"

namespace petrichor::scene {
namespace {

using namespace snow_scenes;
using glm::vec2;
using glm::vec3;

constexpr float kHalf_m = 0.15f, kHigh_m = 0.1f, kDepth_m = 0.064f;

// The ground ends in teeth a few millimetres within the board, as that below models does, and is turned against it.
struct Table {
    Scene scene = empty_scene();
    std::array<vec3, 4> corners;
    SnowCaps caps;

    Table()
    {
        const vec2 along(std::cos(0.5f), std::sin(0.5f)), across(-along.y, along.x);
        const auto at = [&](float x, float z) {
            const vec2 place = x * along + z * across;
            return vec3(place.x, 0.0f, place.y);
        };
        corners = {at(kHalf_m, kHalf_m), at(-kHalf_m, kHalf_m), at(-kHalf_m, -kHalf_m), at(kHalf_m, -kHalf_m)};
        for (std::size_t k = 0; k < 4; ++k)
            add_face(scene, corners[(k + 1) % 4], corners[k] - corners[(k + 1) % 4], {0, kHigh_m, 0});
        const vec3 up(0, kHigh_m, 0);
        add_face(scene, corners[0] + up, corners[3] - corners[0], corners[1] - corners[0]);
        constexpr float kCell = 1.0f / 128.0f;  // without rounding: they hang together
        for (int z = -64; z < 64; ++z) {
            for (int x = -64; x < 64; ++x) {
                const vec2 middle = kCell * (vec2(static_cast<float>(x), static_cast<float>(z)) + 0.5f);
                const float within = std::max(std::abs(glm::dot(middle, along)), std::abs(glm::dot(middle, across)));
                if (within < kHalf_m - 0.004f) continue;
                add_face(scene, {middle.x - 0.5f * kCell, 0, middle.y + 0.5f * kCell}, {kCell, 0, 0}, {0, 0, -kCell});
            }
        }
        // A roof beside it: the share of the sky goes up along its sides.
        add_face(scene, {-0.25f, 0.5f, 0.3f}, {0, 0, -0.6f}, {-0.15f, 0, 0});
        caps = caps_seen_from(scene, {-0.76f, 0.73f, 1.3f});
    }
};
const Table& table()
{
    static const Table made;
    return made;
}

TEST(SnowAtABoard, LiesAgainstItsSidesInALine)
{
    const Snowed snowed(table().scene, table().caps, kDepth_m);
    float tooth = 0.0f, highest = 0.0f, lowest = 1.0f;
    for (std::size_t k = 0; k < 4; ++k) {
        const vec3 from = table().corners[k], to = table().corners[(k + 1) % 4];
        const vec3 along = glm::normalize(to - from), out = glm::normalize(from + to);
        // Up to where the side is hidden by the snow at its foot.
        std::vector<float> line;
        for (float s = 0.03f; s < 2.0f * kHalf_m - 0.03f; s += 0.003f) {
            float hidden = 0.0f;
            for (float h = 0.0f; h < kHigh_m; h += 0.0005f) {
                const vec3 target = from + along * s + vec3(0, h, 0);
                const auto seen = snowed.look(target + 0.4f * out + vec3(0, 0.25f, 0), target);
                if (!seen.snow) break;
                hidden = h;
            }
            line.push_back(hidden);
            highest = std::max(highest, hidden);
            lowest = std::min(lowest, hidden);
        }
        // Off the mean of what lies a centimetre to either side.
        for (std::size_t i = 3; i + 3 < line.size(); ++i)
            tooth = std::max(tooth, std::abs(line[i] - 0.5f * (line[i - 3] + line[i + 3])));
    }
    RecordProperty("tooth_m", std::to_string(tooth));
    RecordProperty("highest_m", std::to_string(highest));
    RecordProperty("lowest_m", std::to_string(lowest));
    EXPECT_LT(tooth, 0.004f);
    EXPECT_LT(highest, 1.15f * kDepth_m) << "it climbs no side";
    EXPECT_GT(lowest, 0.2f * kDepth_m);
}

// What reaches into it goes straight in, whichever way the teeth of the ground look.
TEST(SnowAtABoard, ReachesStraightIntoItsSides)
{
    int all = 0;
    float least = 1.0f;
    for (const SnowCaps::Point& point : table().caps.points) {
        const float reach = glm::length(point.bridge_m);
        if (std::abs(point.base_m.y) > 1.0e-4f || !(reach > 0.0f)) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const vec3 from = table().corners[k], to = table().corners[(k + 1) % 4];
            const vec3 along = glm::normalize(to - from), out = glm::normalize(from + to);
            const float at = glm::dot(point.base_m - from, along), off = glm::dot(point.base_m - from, out);
            if (std::abs(off) > 0.02f || at < 0.05f || at > 2.0f * kHalf_m - 0.05f) continue;
            ++all;
            least = std::min(least, -glm::dot(vec2(out.x, out.z), point.bridge_m) / reach);
        }
    }
    RecordProperty("points", all);
    RecordProperty("least", std::to_string(least));
    EXPECT_GT(all, 80);
    EXPECT_GT(least, 0.8f);
}

}  // namespace
}  // namespace petrichor::scene
