#ifndef PETRICHOR_SCENE_SNOW_SNOW_CAPS_H
#define PETRICHOR_SCENE_SNOW_SNOW_CAPS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/interrupted.h"
#include "scene/patches/tracer.h"
#include "scene/scene.h"
#include "scene/snow/snow_levels.h"

namespace petrichor::scene {

struct SnowCapOptions {
    std::vector<glm::vec3> eyes_m;  ///< where cameras stand over the film; none: as if near everywhere
    float finest_m = 0.006f;        ///< edges at the rim of a cap, near an eye
    float coarsest_m = 0.6f;
    float per_metre = 0.006f;       ///< edges are at least so long a metre from the nearest eye
    float reach_m = 50.0f;          ///< no caps beyond this from the nearest eye
    /// Share of the depth that is trodden away at a place; none: nowhere.
    std::function<float(const glm::vec3&)> pressed = {};
    bool presses = true;                   ///< false: what is trodden is cut as fine, and lies as high as all around
    std::size_t most_triangles = 120'000;  ///< more than what faces up has by itself
    StopRequest stop = {};                 ///< asked several times a second
};

/// A cover over all that faces up and is open to the sky, ready to be lifted by the depth of the snow.
struct SnowCaps {
    static constexpr std::uint32_t kUncovered = 0xffffffffu;
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr float kAnyDepth_m = 1.0e9f;
    /// Depths that `fill_m` is told for; between them and 0 it is linear.
    static constexpr std::size_t kFills = 4;
    static constexpr std::array<float, kFills> kFillDepths_m{0.03f, 0.07f, 0.14f, 0.28f};
    struct Point {
        glm::vec3 base_m{0.0f};       ///< on the scene
        float share = 0.0f;           ///< of the depth on open ground, by shelter and slope ..
        float broad = 0.0f;           ///< .. and of deep snow, which knows no slope of a bevel
        float slope = 1.0f;           ///< what of `share` the slope leaves, shelter aside ..
        float broad_slope = 1.0f;     ///< .. and of `broad`
        float edge_m = 1.0e9f;        ///< to the nearest edge where the snow ends in the open
        float support_m = 1.0e9f;     ///< how wide the ground below is: half a post's width
        glm::vec2 out{0.0f};          ///< towards that edge, world x and z
        float most_m = kAnyDepth_m;   ///< of snow that holds here, by the angle of repose from the edges ..
        /// .. and of snow between a depth of `kFillDepths_m` and the next, which lies over steps that it closes as one sheet: from the others alone
        std::array<float, kFills> sheet_most_m{kAnyDepth_m, kAnyDepth_m, kAnyDepth_m, kAnyDepth_m};
        std::array<float, kFills> fill_m{};  ///< up to the ground as snow of a depth smooths it: without joints, stones, steps
        float wide = 1.0f;            ///< 0 on posts and small things, on which no step is closed .. 1 on ground
        float drop_m = 1.0e9f;        ///< of that edge, or of the one that `most_m` is from: how far below it lies what is beyond
        float uneven = 1.0f;          ///< times the depth
        glm::vec2 bridge_m{0.0f};     ///< at a border: into the wall, over the joint or the slot
        float slot_m = 1.0e9f;        ///< to the nearest slot, as of a grating ..
        float gap_m = 1.0e9f;         ///< .. and how wide it is
        std::uint32_t beyond = kNone;  ///< the point on what lies beyond that edge, kNone: nothing near below it
        float low_m = 1.0e9f;         ///< to the nearest edge of a step as low as a board ..
        std::uint32_t below = kNone;  ///< .. and the point down there
        float bank = 0.0f;            ///< 1: of a bank, which lies over the steps of the caps; 0: of a cap
        float bank_m = 0.0f;          ///< the highest step below the bank here; 0: there is no bank
        float corner = 0.0f;          ///< of a bank: 1 over the edge of a step .. 0 a hand's width away
        float fade = 0.0f;            ///< of a bank: 1 where it goes under the caps; of a cap: 1 where a bank lies over it
        std::array<float, kFills> bank_fill_m{};  ///< of a cap: up to the ground as the bank smooths it
    };
    struct Part {
        std::uint32_t material = 0;
        std::uint32_t instance = 0;
        std::uint32_t first_index = 0;  ///< into `indices`
        std::uint32_t index_count = 0;
        std::uint32_t first_corner = 0;
        std::uint32_t primitive = 0;    ///< of the instance's mesh: which one it lies on
        /// Of each of its triangles, the one of that primitive below; kUncovered where parts of that have no cap.
        std::vector<std::uint32_t> below;
        Primitive source;  ///< vertices of its corners, in the world; no indices
    };
    std::vector<Point> points;
    std::vector<std::uint32_t> corner_points;  ///< of each vertex of all parts, in their order
    std::vector<std::uint32_t> indices;        ///< 3 a triangle, into corner_points
    std::vector<Part> parts;
    SnowLevels levels;      ///< the same triangles, and fewer of them
    float finest_m = 0.0f;  ///< as it became; coarser than asked where a limit bit

    bool empty() const { return indices.empty(); }
};

/// Cuts what snow lies on: opaque, unsheltered surfaces that face up, of what does not move. Open is
/// what sees the sky overhead, by rays; an edge is open where the ground falls away beyond it, closed
/// where a wall rises or other ground goes on. Over slots of up to 14 cm, as of a grating, deep snow closes.
///
/// The same caps for any thread count. They reach over primitives and meshes: places that are shared
/// are one point, so there are no cracks. Throws Interrupted when `stop` says so.
SnowCaps build_snow_caps(const Tracer& tracer, const SnowCapOptions& options);

/// Whether snow on a material has a body.
bool holds_snow_body(const Material& material);

/// What of the depth a slope holds, by y of its normal. EN 1991-1-3: all of it up to 30 degrees, none from 60 on.
float snow_on_slope(float up);

/// Drawn snow is at most about so deep: what stands in the scene would drown.
inline constexpr float kDeepestSnow_m = 0.4f;
float drawn_snow_m(float depth_m);

/// Share of a step that snow of a depth closes: 1 of steps up to 1.45 of that, 0 from kHighestClosed of it on: what rounding takes
/// from an edge, (1 - pi / 4) of the depth squared a metre, is enough for a bank of 55 degrees there.
inline constexpr float kHighestClosed = 1.75f;
float step_closed(float step_m, float depth_m);

/// The caps under snow.
struct SnowShape {
    std::vector<glm::vec3> positions;  ///< of each point
    std::vector<glm::vec3> normals;
    std::vector<float> thickness_m;    ///< of each point, 0 or more
    std::vector<float> deep_m;         ///< of each point: before its edges are rounded off, thickness_m or more
    float thickest_m = 0.0f;
};

/// What of the caps is shaped.
struct DrawnSnow {
    static constexpr std::uint8_t kBeside = 1, kDrawn = 2;
    std::vector<std::uint8_t> points;      ///< of each: 0, kDrawn, or kBeside of those that are a drawn one's `beyond` or `below` alone
    std::vector<std::uint32_t> triangles;  ///< that are drawn: 3 points each; they make the normals
};

/// depth_m: of each point, of snow on open ground there. Snow rounds off towards open edges as a quarter of
/// an ellipse, as wide as deep and at most as wide as what it lies on, and stands out over them a
/// little; it is nowhere deeper than what holds there. What edges shed leans against them: over a step that is lower
/// than this bank and the snow below there is one sheet. Where there is none the cap lies below the surface.
SnowShape snow_shape(const SnowCaps& caps, std::span<const float> depth_m);
/// Points that are not drawn stay on the ground.
/// held_shares: of each point, what of the fall the slope of its place holds, where depth_m is of that place already, with its slope:
/// from 8 cm on steepness counts once, and a point that is steeper than its place, as the bevel of a stone, holds less of that; up to 3 cm it
/// counts for the body once more. None: 1, open ground.
SnowShape snow_shape(const SnowCaps& caps, std::span<const float> depth_m, const DrawnSnow& drawn, std::span<const float> held_shares = {});
DrawnSnow all_drawn(const SnowCaps& caps);

}  // namespace petrichor::scene

#endif
