#include "gpu/passes/patch_light/patch_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formulas/weather/apply_weather.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/surface_weather.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/place_io.h"
#include "scene/basins/water.h"
#include "scene/material_table.h"
#include "scene/patches/visible_way.h"

namespace petrichor::gpu {

namespace {

constexpr float kDropSpeed_m_s = 6.0f;

// Towards where rain comes from; a calm that is no number counts as calm.
glm::vec3 against_rain(glm::vec2 wind_m_s)
{
    const glm::vec2 wind = std::isfinite(wind_m_s.x + wind_m_s.y) ? wind_m_s : glm::vec2(0.0f);
    return glm::normalize(glm::vec3(-wind.x, kDropSpeed_m_s, -wind.y));
}

bool any_weather(const shared::WeatherMoment& w, const MaterialWeather& m)
{
    return w.snow_amount > 0.0f || w.flood_cracks > 0.0f || w.flood_puddles > 0.0f ||
           w.film_albedo > 0.0f || w.frost > 0.0f || m.water_accumulation.x > 0.0f ||
           m.water_accumulation.z > 0.0f || m.snow_accumulation.x > 0.0f;
}

float film_of(const MaterialWeather& m)
{
    return m.film >= 0.0f ? m.film : 1.0f;
}

// Middles of the quarters of what snow_texel (formulas/weather/weather_maps.h) holds.
constexpr std::array<float, 4> kQuarters{0.543f, 0.665f, 0.75f, 0.867f};

// Cover of hoar as pixels have it, a mean over the map of its crystals (gpu/passes/surface/frost.glsl): of what is no
// edge and as rough as ground is. By the amount itself the land beyond a white lawn was dark.
float mean_frost(float amount)
{
    constexpr float kEdge = 0.125f;
    if (!(amount > 0.0f)) return 0.0f;
    float sum = 0.0f;
    for (const float wide : kQuarters)
        for (const float fine : kQuarters)
            sum += shared::frost_cover(amount, shared::saturate(0.5f + 2.6f * (0.6f * wide + 0.4f * fine - 0.5f)), kEdge);
    return sum / static_cast<float>(kQuarters.size() * kQuarters.size());
}

// Cover of snow, a mean over the two masks of the snow map.
float mean_snow(float amount, float height_factor, float up, const MaterialWeather& m, float melt)
{
    float sum = 0.0f;
    for (const float mask : kQuarters) {
        for (const float detail : kQuarters) {
            sum += shared::snow_cover(amount, height_factor, up + shared::snow_rests(up), m.snow_slope_damp, 1.0f,
                                      mask, detail, melt, 0.0f)
                       .snow;
        }
    }
    return sum / static_cast<float>(kQuarters.size() * kQuarters.size());
}

shared::SurfaceState state_of(const MaterialWeather& m, const shared::WeatherMoment& w,
                              float snow_line, float up, float open)
{
    shared::SurfaceState state{};
    const float amount = shared::saturate(w.snow_amount * open * shared::smooth_edge(0.0f, 0.4f, up) *
                                              m.snow_accumulation.y +
                                          m.snow_accumulation.x);
    if (amount > 0.0f) {
        state.snow = mean_snow(amount, snow_line, up, m, w.melt * m.snow_accumulation.y);
    }
    const glm::vec2 flood{w.flood_cracks * open * m.water_accumulation.y + m.water_accumulation.x,
                          w.flood_puddles * open * m.water_accumulation.w + m.water_accumulation.z};
    if (m.wetness != Wetness::None && (flood.x > 0.0f || flood.y > 0.0f)) {
        state.water =
            shared::water_cover(flood, m.default_height, 1.0f, up, m.water_slope_damp).anywhere;
    }
    state.film =
        std::sqrt(open) * shared::saturate(up + 1.0f - m.water_slope_damp) * film_of(m);
    state.frost = mean_frost(w.frost * open * shared::saturate(up * 0.6f + 0.5f)) * (1.0f - state.water);
    state.snow_smoothness = 0.3f;
    state.way = shared::kMeanWaterWay;
    return state;
}

// As a pixel takes it from its patch (gpu/passes/surface/cover.glsl): slope and shelter are in it.
shared::SurfaceState state_of_place(const MaterialWeather& m, const shared::WeatherMoment& w,
                                    float snow_line, const glm::vec4* texels, float pond)
{
    glm::vec4 shown = texels[0];
    const float frost = texels[1].x;
    // A level in the relief: how much lies below it is known.
    const bool volume = texels[1].w > 0.0f;
    const float under_water = std::max(volume ? shown.y : 0.0f, pond);
    if (volume) shown.y = shown.z = 0.0f;

    shared::SurfaceState state{};
    const float amount =
        shared::saturate(shown.w * m.snow_accumulation.y + m.snow_accumulation.x);
    if (amount > 0.0f) {
        state.snow = mean_snow(amount, snow_line, 1.0f, m, w.melt * m.snow_accumulation.y);
    }
    const glm::vec2 flood{shown.y * m.water_accumulation.y + m.water_accumulation.x,
                          shown.z * m.water_accumulation.w + m.water_accumulation.z};
    if (m.wetness != Wetness::None && (flood.x > 0.0f || flood.y > 0.0f)) {
        state.water =
            shared::water_cover(flood, m.default_height, 1.0f, 1.0f, m.water_slope_damp).anywhere;
    }
    if (m.wetness != Wetness::None) state.water = std::max(state.water, under_water);
    state.film = std::max(shown.x, shared::wetness_of_film(texels[3].z)) * film_of(m);
    state.frost = mean_frost(frost) * (1.0f - state.water);
    state.snow_smoothness = 0.3f;
    state.way = shared::kMeanWaterWay;
    return state;
}

bool belongs(const PlaceWeather* place, const scene::Patches& patches)
{
    return place && place->shape && place->shape->grid.levels > 0 &&
           place->states.size() >= std::size_t{patches.count} * PLACE_STATE_TEXELS &&
           place->shape->table.size() >= patches.table.size() &&
           std::equal(patches.table.begin(), patches.table.end(), place->shape->table.begin());
}

// Share of a patch that lies below the water of the hollow under it.
float pond_over(const PlaceWeather& place, const scene::Patches& p, std::uint32_t i)
{
    const PlaceShape& shape = *place.shape;
    const glm::vec3 n = p.normal[i];
    if (n.y < 0.3f) return 0.0f;
    constexpr int kAcross = 4;
    const float size_m = p.level_cell_m(scene::level_of(p.key[i]));
    float sum = 0.0f, all = 0.0f;
    for (int k = 0; k < kAcross * kAcross; ++k) {
        const glm::vec2 way =
            ((glm::vec2(k % kAcross, k / kAcross) + 0.5f) / float{kAcross} - 0.5f) * size_m;
        const glm::vec2 at = glm::vec2(p.position_m[i].x, p.position_m[i].z) + way;
        const glm::vec2 cell = glm::floor((at - shape.basin_corner_m) / shape.basin_cell_m);
        if (!(cell.x >= 0.0f && cell.y >= 0.0f && cell.x < static_cast<float>(shape.basin_width) &&
              cell.y < static_cast<float>(shape.basin_depth)))
            continue;
        all += 1.0f;
        const std::uint32_t label = shape.labels[static_cast<std::size_t>(cell.y) * shape.basin_width +
                                                 static_cast<std::size_t>(cell.x)];
        if (label == 0 || label == 0xffffffffu) continue;
        const float height_m = p.position_m[i].y - (n.x * way.x + n.z * way.y) / n.y;
        const float depth_m = place.levels_m[label] - height_m;
        // As pixels take it (gpu/frame/place.glsl, cover.glsl).
        if (depth_m < 2.0f) sum += shared::smooth_edge(0.0f, 0.002f, depth_m);
    }
    return sum / std::max(all, 1.0f);
}

// Of each patch; none where no hollow has water.
std::vector<float> ponds_over(const PlaceWeather* place, const scene::Patches& p)
{
    if (place == nullptr || !place->shape || place->shape->labels.empty()) return {};
    if (std::none_of(place->levels_m.begin() + 1, place->levels_m.end(), [](float level_m) { return level_m > scene::kDry_m; })) return {};
    std::vector<float> ponds(p.count);
    for (std::uint32_t i = 0; i < p.count; ++i) ponds[i] = pond_over(*place, p, i);
    return ponds;
}

// A factor now over what it was when the patches were coloured; what was 0 stays as it is.
float over(float now, float before)
{
    return before > 0.0f ? now / before : 1.0f;
}
glm::vec3 over(glm::vec3 now, glm::vec3 before)
{
    return {over(now.x, before.x), over(now.y, before.y), over(now.z, before.z)};
}

std::vector<Material> changed(std::vector<Material> materials,
                              const std::vector<scene::MaterialChange>& changes)
{
    for (const scene::MaterialChange& change : changes) {
        const scene::MaterialProperty* property = scene::find_property(change.property);
        if (property && change.material < materials.size())
            property->set(materials[change.material], change.value);
    }
    return materials;
}

// What decides a surface's look besides the weather of the frame.
struct Surface {
    std::uint32_t material;
    const scene::PatchSurface& dry;
    glm::vec3 position_m, normal;
    const std::array<std::uint32_t, 8>& visible;
    std::uint32_t patch;  // whose place it is
};

struct Look {
    glm::vec3 albedo, emission;
};

struct Looks {
    const PatchScene& scene;
    const shared::WeatherMoment& weather;
    shared::WeatherMoment closed;
    const shared::WeatherLook& look;
    bool shelter;
    std::vector<Material> materials;
    const PlaceWeather* place;    // null: not of these patches
    std::vector<float> ponds;
    scene::VisibleWay rain;

    float pond(std::uint32_t patch) const { return ponds.empty() ? 0.0f : ponds[patch]; }

    // Flat: the frame's weather and look are structures that a call takes by value.
    [[gnu::flatten]] Look of(const Surface& surface) const
    {
        const Material& material = materials[surface.material];
        const Material& before = scene.materials[surface.material];
        const MaterialWeather& m = material.weather;
        shared::DryMaterial dry{};
        dry.base_color = glm::clamp(
            surface.dry.base_color *
                over(glm::vec3(material.base_color), glm::vec3(before.base_color)),
            0.0f, 1.0f);
        dry.metallic = std::clamp(surface.dry.metallic * over(material.metallic, before.metallic),
                                  0.0f, 1.0f);
        const float root = (material.ior - 1.0f) / (material.ior + 1.0f);
        dry.f0 = glm::min(root * root * material.specular_color, glm::vec3(1.0f)) * material.specular;
        if (material.specular_workflow) dry.f0 = material.workflow_specular;
        dry.roughness = std::clamp(
            surface.dry.roughness * over(material.roughness, before.roughness), 0.0f, 1.0f);
        dry.occlusion = 1.0f;
        dry.porosity = m.porosity >= 0.0f
                           ? m.porosity
                           : shared::porosity_from_smoothness(1.0f - dry.roughness);
        dry.water_color = m.water_color;
        dry.snow_opacity = m.snow_opacity;
        shared::WeatheredMaterial now = shared::dry_material(dry);
        const float snow_line =
            shared::snow_line_factor(surface.position_m, weather.snow_start_height_m,
                                     weather.snow_height_blend_m, look.snow_line_ragged);
        if (!m.sheltered && place) {
            const glm::vec4* texels = &place->states[std::size_t{surface.patch} * PLACE_STATE_TEXELS];
            now = shared::apply_weather(
                dry,
                state_of_place(m, weather, snow_line, texels, pond(surface.patch)),
                closed, look);
        } else if (!m.sheltered && any_weather(weather, m)) {
            const float open = shelter ? rain.share(surface.visible) : 1.0f;
            shared::SurfaceState state = state_of(m, weather, snow_line, surface.normal.y, open);
            if (m.wetness != Wetness::None)
                state.water = std::max(state.water, pond(surface.patch));
            now = shared::apply_weather(dry, state, weather, look);
        }
        const float mirrored = std::max({now.specular.x, now.specular.y, now.specular.z});
        const glm::vec3 glow =
            surface.dry.emission * over(material.emissive * material.emissive_strength,
                                        before.emissive * before.emissive_strength);
        return {glm::clamp(now.albedo * (1.0f - mirrored) + now.specular, 0.0f, 1.0f),
                glow * now.emission_scale};
    }
};

}  // namespace

PatchLook patch_look(const PatchScene& scene, const shared::WeatherMoment& weather,
                     const shared::WeatherLook& look, bool shelter,
                     const std::vector<scene::MaterialChange>& changes, const PlaceWeather* place)
{
    const scene::Patches& p = scene.patches;
    const Looks looks{scene,   weather,
                      with_closed_film(weather),
                      look,    shelter,
                      changed(scene.materials, changes),
                      belongs(place, p) ? place : nullptr,
                      ponds_over(place, p),
                      scene::VisibleWay(against_rain(weather.wind_m_s))};
    PatchLook result;
    result.albedo.reserve(p.count);
    result.emission.reserve(p.count);
    for (std::uint32_t i = 0; i < p.count; ++i) {
        const Look now = looks.of(
            {p.material[i], scene.surfaces[i], p.position_m[i], p.normal[i], p.visible[i], i});
        result.albedo.push_back(now.albedo);
        result.emission.push_back(now.emission);
    }
    const scene::NearLinks& near = scene.near;
    const std::size_t sources = std::min(near.sources(), scene.near_surfaces.size());
    result.near_albedo.reserve(sources);
    result.near_emission.reserve(sources);
    for (std::size_t s = 0; s < sources; ++s) {
        const Look now = looks.of({near.material[s], scene.near_surfaces[s], scene::near_middle(near, s),
                                   near.normal[s], near.visible[s], near.sender[s]});
        result.near_albedo.push_back(now.albedo);
        result.near_emission.push_back(now.emission);
    }
    return result;
}

}  // namespace petrichor::gpu
