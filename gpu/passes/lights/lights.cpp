#include "gpu/passes/lights/lights.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <span>

#include "base/error.h"
#include "formulas/color/tone_map.h"
#include "formulas/light/brdf.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/lights/lights_io.h"
#include "gpu/upload/morton.h"
#include "scene/light_shape.h"

namespace petrichor::gpu {

namespace {

// Codes of the display for linear light behind the exposure.
float codes_of(const FrameSettings& settings, float exposed)
{
    if (settings.gamma) return 255.0f * exposed;
    return 255.0f * shared::srgb_encode(
                        shared::display_light(static_cast<int>(settings.tone_map), glm::vec3(exposed)).g);
}

// The most codes by which so much exposed light of one more changes the picture, for small changes.
float steepest(const FrameSettings& settings)
{
    float most = 0.0f;
    float below = 0.0f;
    float codes_below = codes_of(settings, 0.0f);
    for (int i = -56; i <= 8; ++i) {  // quarters of a stop: 2^-14 to 4
        const float above = std::exp2(0.25f * static_cast<float>(i));
        const float codes = codes_of(settings, above);
        most = std::max(most, (codes - codes_below) / (above - below));
        below = above;
        codes_below = codes;
    }
    return most;
}

}  // namespace

float least_lux(const FrameSettings& settings, float exposure)
{
    if (settings.least_lux > 0.0f) return settings.least_lux;
    if (!(exposure > 0.0f)) return kFaintestLux;
    // White paper sends out a pi-th of what falls on it.
    return std::max(kFaintestLux, shared::kPi * kUnseenCodes / (steepest(settings) * exposure));
}

float light_radius_m(const Light& light, float least_lux)
{
    // Of a rectangle: as candela, straight on.
    const float area = light.kind == LightKind::Rectangle
                           ? 4.0f * glm::length(light.half_u_m) * glm::length(light.half_v_m)
                           : 1.0f;
    const float strongest =
        area * light.intensity * std::max({light.color.r, light.color.g, light.color.b});
    float radius = std::sqrt(std::max(strongest, 0.0f) / least_lux);
    radius += light.shaped ? glm::length(light.half_u_m) + glm::length(light.half_v_m)
                           : light.radius_m + 0.5f * light.length_m;
    if (light.range_m > 0.0f) {
        const float range = std::max(light.range_m, 0.75f * light.length_m);
        radius = least_lux > kFaintestLux ? std::min(range, radius) : range;
    }
    return std::clamp(radius, 0.0f, 5000.0f);
}

void check_light_lists(const VkPhysicalDeviceLimits& limits, std::size_t lights, int width,
                       int height)
{
    const auto words = static_cast<int>((lights + 31) / 32);
    const VkDeviceSize bytes = light_lists_bytes(width, height, words);
    const VkDeviceSize elements = std::max<VkDeviceSize>(bytes / sizeof(glm::uvec2), LIGHT_TEXELS * lights);
    if (bytes > limits.maxStorageBufferRange || elements > limits.maxTexelBufferElements) {
        throw Error("render: the lists of " + std::to_string(lights) + " lights over " +
                        std::to_string(width) + " x " + std::to_string(height) + " pixels take " +
                        std::to_string(bytes >> 20) + " MiB; this device holds " +
                        std::to_string(limits.maxStorageBufferRange >> 20) + " MiB and " +
                        std::to_string(limits.maxTexelBufferElements) + " texels in one buffer",
                    "Choose a smaller --size or fewer lights.");
    }
}

void check_light_crowd(const LightTable& table, const FrameSettings& settings,
                       const std::vector<shared::FrameConstants>& views, std::size_t walks)
{
    if (table.count * walks <= kLightsAnywhere) return;
    LightCrowd crowd{table.count, table.count};
    if (!settings.all_lights) {
        const std::uint32_t ranges = table.ways & (LIGHTS_SHADOWED | LIGHTS_SHADOWED_SHAPED | LIGHTS_PLAIN | LIGHTS_SHAPED);
        crowd = largest_light_crowd(table.balls, std::popcount(ranges), views, settings.width, settings.height);
    }
    if (crowd.turns * walks <= kMostLightTurns) return;
    std::string again;
    if (walks > 1) again = " where a pixel goes over them " + std::to_string(walks) + " times (parts of the light, models that gather or keep shadows alone)";
    throw Error("render: up to " + std::to_string(crowd.lights) + " of " + std::to_string(table.count) +
                    " lights reach one part of the picture; " + std::to_string(kLightsAnywhere / walks) + " always may" + again,
                "Give them shorter ranges ([lamps] range_m), or leave out the faintest.");
}

namespace {

// Numbers of the lamps that give most light at the eye, brightest first.
template <typename Wanted>
std::vector<std::size_t> brightest(const std::vector<Light>& lights, int most, const glm::vec3& eye_m, Wanted&& wanted)
{
    if (most <= 0) return {};
    std::vector<std::pair<float, std::size_t>> ranked;
    ranked.reserve(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        if (light.kind == LightKind::Directional || !wanted(light)) continue;
        float strength = light.intensity;
        if (light.range_m <= 0.0f) {
            const float reach = light_radius_m(light);
            strength = kFaintestLux * reach * reach;
        }
        const glm::vec3 away = light.position_m - eye_m;
        ranked.emplace_back(strength / std::max(glm::dot(away, away), 1.0f), i);
    }
    const auto end = ranked.begin() + std::min<std::ptrdiff_t>(most, std::ssize(ranked));
    std::partial_sort(ranked.begin(), end, ranked.end(), [](const auto& a, const auto& b) {
        return a.first > b.first || (a.first == b.first && a.second < b.second);
    });
    std::vector<std::size_t> chosen;
    for (auto at = ranked.begin(); at != end; ++at) chosen.push_back(at->second);
    return chosen;
}

}  // namespace

namespace {

// Round all of them.
Bounds cube_of(const std::vector<Light>& lights)
{
    Bounds box{glm::vec3(1.0e30f), glm::vec3(-1.0e30f)};
    for (const Light& light : lights) {
        box.low = glm::min(box.low, light.position_m);
        box.high = glm::max(box.high, light.position_m);
    }
    const glm::vec3 size = box.high - box.low;
    box.high = box.low + glm::vec3(std::max({size.x, size.y, size.z}));
    return box;
}

// The order of the table: directional lights, with a shadow points and what is lit by its shape, without one both,
// lamps by vertex.
constexpr int kVertexKind = 5;

// How the size of a lamp is lit.
enum class Shape { None, Rectangle, Nearest, Ltc };

Shape shape_of(const Light& light, AreaLights area)
{
    const bool rectangle = light.kind == LightKind::Rectangle;
    if (area != AreaLights::Off && (light.radius_m > 0.0f || light.shaped)) {
        if (area == AreaLights::Ltc) return Shape::Ltc;
        if (!rectangle) return Shape::Nearest;
    }
    return rectangle ? Shape::Rectangle : Shape::None;
}

// Intensity as the shader takes it: of what has a size, radiance.
float strength_of(const Light& light, bool sized)
{
    if (!sized || light.kind == LightKind::Rectangle) return light.intensity;
    const float r = light.radius_m;
    return light.intensity / (3.14159265f * r * r + 2.0f * r * light.length_m);
}

}  // namespace

LightTable make_light_table(const Device& device, MemoryArena& arena,
                            const std::vector<Light>& lights, const LightTableParams& params)
{
    const AreaLights area = params.area;
    const auto reach_m = [&](const Light& light) { return light_radius_m(light, params.least_lux); };
    const auto is_seen = [&](const Light& light) {
        return !params.in_view || light.kind == LightKind::Directional ||
               params.in_view(light.position_m, reach_m(light));
    };
    std::vector<int> shadow(lights.size(), -1);  // number of its shadow, by number of the light
    LightTable table;
    const auto number_of = [&](const Light* light) {
        return static_cast<std::size_t>(light - lights.data());
    };
    // Who owns one does not depend on what is seen: it would come and go. Lamps by vertex have none.
    const auto throws_shadows = [](const Light& light) { return light.shadow_strength > 0.0f && !scene::lit_by_vertex(light); };
    const auto all = [](const Light&) { return true; };
    for (const std::size_t i : brightest(lights, params.shadows, params.eye_m, throws_shadows)) {
        if (!is_seen(lights[i])) continue;
        shadow[i] = static_cast<int>(table.shadowed.size());
        table.shadowed.push_back(lights[i]);
    }
    for (const std::size_t i : brightest(lights, kBrightestLamps, params.eye_m, all))
        table.brightest.push_back(lights[i]);
    const auto kind_of = [&](const Light& light, int its_shadow) {
        if (light.kind == LightKind::Directional) return 0;
        if (scene::lit_by_vertex(light)) return kVertexKind;
        return (its_shadow >= 0 ? 1 : 3) + (shape_of(light, area) == Shape::None ? 0 : 1);
    };
    // Neighbours share the words of a tile's list. What is not seen is left out before anything is sorted.
    struct Place {
        std::uint64_t at;  // its kind, then where it lies in the box of all
        const Light* light;
    };
    const Bounds box = cube_of(lights);
    std::vector<Place> places;
    for (const Light& light : lights) {
        table.glows = table.glows || light.glows;
        if (!is_seen(light)) continue;
        const int kind = kind_of(light, shadow[number_of(&light)]);
        places.push_back({static_cast<std::uint64_t>(kind) << 32 | (kind > 0 ? morton(light.position_m, box) : 0u), &light});
    }
    std::sort(places.begin(), places.end(),
              [](const Place& x, const Place& y) { return x.at < y.at || (x.at == y.at && x.light < y.light); });
    std::vector<const Light*> ordered;
    ordered.reserve(places.size());
    for (const Place& place : places) ordered.push_back(place.light);
    const auto first_of = [&](int kind) {
        const auto first = std::partition_point(places.begin(), places.end(), [kind](const Place& place) {
            return place.at < static_cast<std::uint64_t>(kind) << 32;
        });
        return static_cast<std::uint32_t>(first - places.begin());
    };
    table.count = first_of(kVertexKind);
    table.directional = first_of(1);
    table.shaped_shadows = first_of(2);
    table.plain = first_of(3);
    table.shaped = first_of(4);
    if (table.directional > 0) table.ways |= LIGHTS_FAR;
    if (table.shaped_shadows > table.directional) table.ways |= LIGHTS_SHADOWED;
    if (table.plain > table.shaped_shadows) table.ways |= LIGHTS_SHADOWED_SHAPED;
    if (table.shaped > table.plain) table.ways |= LIGHTS_PLAIN;
    if (table.count > table.shaped) table.ways |= LIGHTS_SHAPED;
    if (device.info().kind != "cpu") table.ways |= LIGHTS_SKIP;
    else if (device.subgroup_size() == LIGHTS_AT_ONCE)
        table.ways |= LIGHTS_TOGETHER;
    if (table.words() == 1) table.ways |= LIGHTS_ONE_WORD;
    if (table.count > LIGHTS_FEW) table.ways |= LIGHTS_MANY;
    // Rectangles end without a window where that is too faint to be seen at night.
    const float windowed = std::clamp(params.least_lux / kFaintestLux - 1.0f, 0.0f, 1.0f);
    std::vector<glm::vec4> texels;
    texels.reserve(LIGHT_TEXELS * ordered.size());
    for (const Light* light : ordered) {
        const bool spot = light->kind == LightKind::Spot;
        const bool rectangle = light->kind == LightKind::Rectangle;
        const bool by_vertex = scene::lit_by_vertex(*light);
        const Shape shape = by_vertex ? Shape::None : shape_of(*light, area);
        std::uint32_t& ways = by_vertex ? table.vertex_ways : table.ways;
        if (by_vertex) table.vertex_balls.emplace_back(light->position_m, reach_m(*light));
        const bool sized = shape == Shape::Ltc || shape == Shape::Nearest;
        table.rectangles = table.rectangles || shape == Shape::Rectangle;
        if (shape == Shape::Ltc) ways |= LIGHTS_LTC;
        if (shape == Shape::Nearest) ways |= LIGHTS_NEAREST;
        if ((light->specular != 1.0f || (light->glows && shape == Shape::None)) && light->kind != LightKind::Directional)
            ways |= LIGHTS_FILL;
        if (spot) ways |= LIGHTS_CONE;
        if (light->mask_channel > 0) ways |= LIGHTS_MASKED;
        if (light->shadow_strength != 1.0f && !by_vertex) ways |= LIGHTS_WEAK_SHADOWS;
        if (light->profile >= 0) ways |= light->in_lantern ? LIGHTS_LANTERN : LIGHTS_PROFILE;
        const float kind = spot                ? std::cos(light->outer_cone_rad)
                           : !rectangle        ? LIGHT_POINT
                           : light->both_sides ? LIGHT_BOTH_SIDES
                                               : LIGHT_ONE_SIDE;
        texels.emplace_back(light->position_m, reach_m(*light));
        texels.emplace_back(light->color * strength_of(*light, shape == Shape::Ltc), kind);
        texels.emplace_back(rectangle ? light->half_u_m : light->direction,
                            std::cos(light->inner_cone_rad));
        texels.emplace_back(rectangle               ? light->half_v_m
                            : light->length_m > 0.0f ? light->up
                                                     : up_of(*light),
                            static_cast<float>(shadow[number_of(light)]) +
                                LIGHT_MASK_STEP * static_cast<float>(light->mask_channel) +
                                0.5f * (1.0f - light->shadow_strength));
        texels.emplace_back(!sized ? 0.0f : rectangle ? 1.0f : light->radius_m,
                            rectangle ? windowed : 0.5f * light->length_m, light->glows ? static_cast<float>(LIGHT_GLOWS) : light->specular,
                            static_cast<float>(light->profile) + (light->in_lantern ? 0.5f : 0.0f));
    }
    table.vertex_ways &= LIGHTS_CONE | LIGHTS_PROFILE | LIGHTS_LANTERN;
    if (table.count * kMostLightWalks > kLightsAnywhere)
        for (const Light* light : std::span(ordered).first(table.count)) table.balls.emplace_back(light->position_m, reach_m(*light));
    if (texels.empty()) texels.emplace_back(0.0f);
    table.texels = arena.buffer(
        {.name = "lights",
         .size = texels.size() * sizeof(glm::vec4),
         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
         .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
    upload_buffer(device, *table.texels, std::as_bytes(std::span(texels)));
    return table;
}

void add_light_lists(FrameGraph& graph, FrameTargets& targets, LightTable& lights,
                     const ConstantsRange& constants)
{
    if (lights.count == lights.directional) return;  // no loop reads them
    if (lights.words() > 0) {
        const std::uint32_t groups = (lights.words() + LIGHT_COARSE_GROUP - 1) / LIGHT_COARSE_GROUP;
        const int tiles = targets.coarse_x() * targets.coarse_y();
        graph.add(
            ComputePass{.name = "light_coarse",
                        .shader = "light_coarse.comp",
                        .constants = {},
                        .bindings = {{LIGHT_COARSE_FRAME, frame_binding(constants)},
                                     {LIGHT_COARSE_LIGHTS, texels(*lights.texels)},
                                     {LIGHT_COARSE_WORDS, storage_buffer(*targets.coarse_lights)}},
                        .push = {},
                        .groups = {groups, static_cast<std::uint32_t>(tiles), 1}});
    }
    graph.add(ComputePass{
        .name = "light_lists",
        .shader = "light_lists.comp",
        .constants = {},
        .bindings = {{LIGHT_LISTS_FRAME, frame_binding(constants)},
                     {LIGHT_LISTS_LIGHTS, texels(*lights.texels)},
                     {LIGHT_LISTS_WORDS, texels(*targets.coarse_lights)},
                     {LIGHT_LISTS_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {LIGHT_LISTS_LISTS, storage_buffer(*targets.light_lists)}},
        .push = {},
        .groups = groups_over(targets.tiles_x(), targets.tiles_y(), LIGHT_LISTS_TILE)});
}

}  // namespace petrichor::gpu
