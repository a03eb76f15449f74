#include "gpu/passes/lamp_glow/lamp_glow.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formulas/light/fog.h"
#include "formulas/light/lamp_glow.h"
#include "gpu/passes/lamp_glow/lamp_glow_io.h"
#include "gpu/passes/lights/lights.h"
#include "gpu/passes/lights/lights_io.h"

namespace petrichor::gpu {

static_assert(kBrightestLamps == LAMP_GLOW_MOST);

namespace {

constexpr int kTableSize = 64;

std::vector<std::byte> function_texels()
{
    std::vector<float> values;
    for (int y = 0; y < kTableSize; ++y) {
        const float v = 1.5707963f * static_cast<float>(y) / (kTableSize - 1);
        for (int x = 0; x < kTableSize; ++x) {
            const float t = static_cast<float>(x) / (kTableSize - 1);
            values.push_back(shared::glow_tail(shared::kGlowMost * t * t, v));
        }
    }
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

// Extinction that scatters: of a day of 20 km sight none, as with the veil of the sky.
float scattering_per_m(const Frame& frame, const shared::FrameConstants& c)
{
    if (frame.fog.mode == FogMode::Metres) return shared::fog_beyond_haze(c.fog_per_m);
    return frame.fog.mode == FogMode::Exp ? c.fog_per_m : 0.0f;
}

}  // namespace

LampGlow::LampGlow(const Device& device)
    : arena_(device),
      lamps_(arena_.buffer({.name = "glow_lamps",
                            .size = sizeof(shared::GlowLamps),
                            .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                            .host = true})),
      function_(arena_.image(
          {.name = "glow_function",
           .format = VK_FORMAT_R32_SFLOAT,
           .width = kTableSize,
           .height = kTableSize,
           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT})),
      linear_(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                           VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE))
{
    upload_image(device, *function_, {function_texels()});
}

bool LampGlow::prepare(const Frame& frame, const shared::FrameConstants& c,
                       const std::vector<Light>& lamps)
{
    const float per_m = scattering_per_m(frame, c);
    const bool flat = frame.camera.orthographic_height_m > 0.0f;
    if (!frame.settings.lamp_glow || per_m <= 0.0f || lamps.empty() || flat) return false;
    shared::GlowLamps table{};
    for (const Light& lamp : lamps) {
        shared::GlowLamp& g = table.lamps[table.count++];
        g.position_m = lamp.position_m;
        const float above = std::max(lamp.position_m.y - c.fog_base_m, 0.0f);
        g.per_m = c.fog_height_m > 0.0f ? per_m * std::exp(-above / c.fog_height_m) : per_m;
        const bool rectangle = lamp.kind == LightKind::Rectangle;
        const float area =
            rectangle ? 4.0f * glm::length(lamp.half_u_m) * glm::length(lamp.half_v_m) : 1.0f;
        g.color = lamp.color * (lamp.intensity * area);
        g.kind = lamp.kind == LightKind::Spot ? std::cos(lamp.outer_cone_rad)
                 : !rectangle                 ? LIGHT_POINT
                 : lamp.both_sides            ? LIGHT_BOTH_SIDES
                                              : LIGHT_ONE_SIDE;
        g.direction = lamp.direction;
        g.inner_cosine = std::cos(lamp.inner_cone_rad);
    }
    std::memcpy(lamps_->mapped, &table, sizeof(table));
    return true;
}

void add_lamp_glow(FrameGraph& graph, FrameTargets& targets, const LampGlow& glow,
                   const ConstantsRange& constants)
{
    GpuImage& coarse = *targets.lamp_glow;
    graph.add(ComputePass{
        .name = "lamp_glow",
        .shader = "lamp_glow.comp",
        .constants = {},
        .bindings = {{LAMP_GLOW_FRAME, frame_binding(constants)},
                     {LAMP_GLOW_LAMPS, uniform(glow.lamps(), 0, sizeof(shared::GlowLamps))},
                     {LAMP_GLOW_FUNCTION, sampled(glow.function(), glow.linear())},
                     {LAMP_GLOW_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {LAMP_GLOW_TARGET, storage(coarse)}},
        .push = {},
        .groups = groups_over(coarse.width, coarse.height, LAMP_GLOW_TILE)});
    graph.add(ComputePass{
        .name = "lamp_glow",
        .shader = "lamp_glow_over.comp",
        .constants = {},
        .bindings = {{LAMP_GLOW_OVER_FRAME, frame_binding(constants)},
                     {LAMP_GLOW_OVER_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {LAMP_GLOW_OVER_COARSE, sampled(coarse, targets.nearest)},
                     {LAMP_GLOW_OVER_ACCUMULATED, storage(*targets.accumulated)}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, LAMP_GLOW_TILE)});
}

}  // namespace petrichor::gpu
