// Deep snow on the kerbs of the demo: one sheet, seen from where people stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "demo/street.h"
#include "scene/snow/snow_caps.h"
#include "tests/scene/snowed.h"

namespace petrichor::scene {
namespace {

using glm::vec3;
using namespace snow_scenes;

struct Street {
    Scene scene = demo::make_demo_street({.texture_size = 16});
    SnowCaps caps = caps_seen_from(scene, {0.0f, 1.6f, 7.0f});
};
const Street& street()
{
    static const Street made;
    return made;
}

const vec3 kAfar(0.9f, 1.5f, 6.0f);
const SnowCaps& caps_from_afar()
{
    static const SnowCaps made = caps_seen_from(street().scene, kAfar);
    return made;
}

// Kerbs of 11 cm, their blocks tilted and bevelled, with joints between; a gutter of blocks before them, paving or a verge
// behind. Along what lies in the open.
struct Kerb {
    const char* name;
    float side, from_z, to_z;
};
constexpr Kerb kKerbs[] = {{"left", -1.0f, 4.6f, 6.5f}, {"right", 1.0f, 2.9f, 6.5f}};

// Snow lies where it fell: nowhere is it higher above its ground than it is deep and than a step that a bank covers.
TEST(SnowOnKerbs, StandsNowhereUp)
{
    for (const float depth : {0.05f, 0.12f, 0.2f, 0.3f}) {
        const SnowShape shape = snow_shape(street().caps, std::vector<float>(street().caps.points.size(), depth));
        float highest = 0.0f;
        for (std::size_t i = 0; i < shape.positions.size(); ++i)
            highest = std::max(highest, shape.positions[i].y - street().caps.points[i].base_m.y);
        EXPECT_LT(highest, 1.5f * depth + 0.3f) << "at " << depth;
        EXPECT_GT(highest, depth) << "at " << depth;
    }
}

// No stone is seen between the snow on a kerb and that beside it, by someone who stands in the street.
TEST(SnowOnKerbs, LeavesNoStoneBetween)
{
    for (const float depth : {0.12f, 0.15f, 0.2f, 0.3f}) {
        const Snowed snowed(street().scene, street().caps, depth);
        for (const Kerb& kerb : kKerbs) {
            int all = 0, stone = 0;
            for (float z = kerb.from_z; z < kerb.to_z; z += 0.011f) {
                for (float x = 2.2f; x < 2.9f; x += 0.013f) {
                    ++all;
                    stone += snowed.look({0.0f, 1.6f, 8.5f}, {kerb.side * x, 0.1f, z}).snow ? 0 : 1;
                }
            }
            const double share = static_cast<double>(stone) / all;
            RecordProperty(std::string(kerb.name) + std::to_string(depth), std::to_string(share));
            EXPECT_LT(share, 0.0005) << kerb.name << " " << depth;
        }
    }
}

// Nor farther from the eye, at joints of both the kerb and its gutter, under snow that is hardly as deep as the kerb is high.
TEST(SnowOnKerbs, LeavesNoStoneAtJointsAndFarAway)
{
    const vec3 eye = kAfar;
    const SnowCaps& caps = caps_from_afar();
    struct Look {
        const char* name;
        float depth, side, from_z, to_z, most;
    };
    for (const Look& part : {Look{"left", 0.087f, -1.0f, 1.0f, 5.0f, 0.001f}, Look{"right", 0.087f, 1.0f, -3.9f, 5.0f, 0.001f},
                             Look{"far", 0.16f, 1.0f, -6.9f, -5.0f, 0.001f}}) {
        const Snowed snowed(street().scene, caps, part.depth);
        int all = 0, stone = 0;
        for (float z = part.from_z; z < part.to_z; z += 0.017f) {
            for (float x = 2.4f; x < 2.6f; x += 0.013f) {
                ++all;
                stone += snowed.look(eye, {part.side * x, 0.1f, z}).snow ? 0 : 1;
            }
        }
        const float share = static_cast<float>(stone) / static_cast<float>(all);
        RecordProperty(part.name, std::to_string(share));
        EXPECT_LE(share, part.most) << part.name;
    }
}

// One sheet: seen from above it has no steps, and hardly a crease.
TEST(SnowOnKerbs, IsOneSheet)
{
    for (const float depth : {0.12f, 0.2f, 0.3f}) {
        const Snowed snowed(street().scene, street().caps, depth);
        for (const Kerb& kerb : kKerbs) {
            int all = 0, steps = 0, creases = 0;
            for (float z = kerb.from_z; z < kerb.to_z; z += 0.037f) {
                Snowed::Seen before;
                for (float x = 2.1f; x < 2.78f; x += 0.01f) {
                    const auto seen = snowed.look({kerb.side * x, 3.0f, z}, {kerb.side * x, 0.0f, z});
                    if (seen.snow && before.snow) {
                        ++all;
                        steps += std::abs(seen.at.y - before.at.y) > 0.02f ? 1 : 0;
                        creases += glm::dot(seen.normal, before.normal) < 0.9f ? 1 : 0;
                    }
                    before = seen;
                }
            }
            EXPECT_GT(all, 1000);
            RecordProperty(std::string("steps_") + kerb.name + std::to_string(depth), steps);
            RecordProperty(std::string("creases_") + kerb.name + std::to_string(depth), creases);
            EXPECT_LT(steps, all / 500) << kerb.name << " " << depth;
            EXPECT_LT(creases, all / 100) << kerb.name << " " << depth;
        }
    }
}

// The same over the grating in the right gutter, whose bars lie five centimetres apart.
TEST(SnowOnKerbs, IsOneSheetOverTheGrating)
{
    const SnowCaps& caps = caps_from_afar();
    for (const float depth : {0.087f, 0.15f}) {
        const Snowed snowed(street().scene, caps, depth);
        int all = 0, steps = 0, creases = 0;
        for (float x = 2.25f; x < 2.45f; x += 0.021f) {
            Snowed::Seen before;
            for (float z = 0.6f; z < 1.2f; z += 0.005f) {
                const auto seen = snowed.look({x, 3.0f, z}, {x, 0.0f, z});
                if (seen.snow && before.snow) {
                    ++all;
                    steps += std::abs(seen.at.y - before.at.y) > 0.01f ? 1 : 0;
                    creases += glm::dot(seen.normal, before.normal) < 0.9f ? 1 : 0;
                }
                before = seen;
            }
        }
        RecordProperty("steps" + std::to_string(depth), steps);
        RecordProperty("creases" + std::to_string(depth), creases);
        EXPECT_GT(all, 1000);
        EXPECT_LT(steps, all / 100) << depth;
        EXPECT_LT(creases, all / 12) << depth << ": at its frame alone";
    }
}

}  // namespace
}  // namespace petrichor::scene
