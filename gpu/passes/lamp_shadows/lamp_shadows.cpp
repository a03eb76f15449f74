#include "gpu/passes/lamp_shadows/lamp_shadows.h"

#include <algorithm>
#include <cmath>

#include "gpu/passes/lamp_shadows/lamp_shadows_io.h"
#include "scene/patches/lanterns.h"

namespace petrichor::gpu {

namespace {

static_assert(LANTERN_HALF_M == scene::kLanternHalf_m && LAMP_MAP_NEAR_M == scene::kLampItself_m);

// Across, down and along each face.
const std::array<std::array<glm::vec3, 3>, 6> kFaces{{
    {{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}},
    {{{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}}},
    {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
    {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}},
    {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
    {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}},
}};

// A face that no ray of the lamp meets has no casters: a spot's cone, or a rectangle's front. It is emptied all the same:
// some pixels ask for it, and saw what the memory held before, or a former lamp of the same number.
bool is_lit(const Light& lamp, const glm::vec3& along)
{
    if (lamp.kind == LightKind::Point || lamp.both_sides) return true;
    const float half = lamp.kind == LightKind::Spot ? lamp.outer_cone_rad : 0.5f * 3.14159265f;
    const float corner = 0.9553f;  // of a face, from its middle
    const float angle = std::acos(std::clamp(glm::dot(lamp.direction, along), -1.0f, 1.0f));
    return angle < half + corner + 0.02f;
}

}  // namespace

glm::mat4 lamp_face_view(const glm::vec3& position_m, int face, float near_m)
{
    const auto& [across, down, along] = kFaces[static_cast<std::size_t>(face)];
    glm::mat4 m(0.0f);
    const auto set_row = [&](int row, const glm::vec3& axis, float scale) {
        for (int c = 0; c < 3; ++c) m[c][row] = axis[c] * scale;
        m[3][row] = -glm::dot(axis, position_m) * scale;
    };
    set_row(0, across, LAMP_MAP_COVER);
    set_row(1, down, LAMP_MAP_COVER);
    set_row(3, along, 1.0f);
    m[3][2] = near_m;
    return m;
}

LampShadows::LampShadows(const Device& device)
    : device_(&device)
{
    reserve(1);
}

void LampShadows::reserve(int lamps)
{
    const int layers = 6 * std::clamp(lamps, 1, kMostLampShadows);
    if (map_ && map_->layers >= layers) return;
    layers_.clear();
    map_ = nullptr;
    drawn_.clear();
    arena_ = std::make_unique<MemoryArena>(*device_);
    map_ = arena_->image(
        {.name = "lamp_shadows",
         .format = VK_FORMAT_D32_SFLOAT,
         .width = LAMP_MAP_SIZE,
         .height = LAMP_MAP_SIZE,
         .layers = layers,
         .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
    for (int i = 0; i < layers; ++i) {
        layers_.push_back(layer_view(*device_, *map_, static_cast<std::uint32_t>(i)));
    }
}

void LampShadows::add(FrameGraph& graph, const GpuScene& scene, SeenTriangles& triangles,
                      const std::vector<Light>& lamps)
{
    reserve(static_cast<int>(lamps.size()));
    drawn_.resize(std::max(drawn_.size(), lamps.size()));
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const Light& lamp = lamps[i];
        const Drawn wanted{lamp.position_m, lamp.direction,
                           lamp.kind == LightKind::Spot        ? lamp.outer_cone_rad
                           : lamp.kind == LightKind::Rectangle ? -1.0f
                                                               : -2.0f,
                           lamp.in_lantern ? LANTERN_HALF_M : LAMP_MAP_NEAR_M};
        if (drawn_[i] == wanted) continue;
        drawn_[i] = wanted;
        for (int face = 0; face < 6; ++face) {
            const bool lit = is_lit(lamp, kFaces[static_cast<std::size_t>(face)][2]);
            const glm::mat4 view = lamp_face_view(wanted.position_m, face, wanted.near_m);
            const Casters casters =
                lit ? casters_in(triangles, scene, view, LAMP_MAP_SIZE, Falls::Lamp) : Casters{};
            graph.add(DrawPass{
                .name = "lamp_shadows",
                .colors = {},
                .depth = Attachment(*map_, layers_[6 * i + static_cast<std::size_t>(face)].get()),
                .width = LAMP_MAP_SIZE,
                .height = LAMP_MAP_SIZE,
                .bindings = {},
                .record = [&scene, view, casters, lit](PassContext& pass) {
                    if (lit) draw_casters(pass, scene, view, Falls::Lamp, casters);
                }});
        }
    }
}

}  // namespace petrichor::gpu
