#include "gpu/passes/patch_light/patch_light.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <span>

#include "base/hash.h"
#include "formulas/light/brdf.h"
#include "gpu/passes/patch_light/patch_albedo.h"
#include "gpu/passes/patch_light/patch_light_io.h"
#include "scene/patches/lamps.h"
#include "scene/patches/lookup.h"

namespace petrichor::gpu {

namespace {

// Snow sends light on many times over.
constexpr int kBounces = 3;
constexpr int kBouncesBright = 4;
constexpr float kBright = 0.6f;

std::unique_ptr<GpuBuffer> host_texels(MemoryArena& arena, const char* name, std::size_t count,
                                       VkFormat format)
{
    return arena.buffer({.name = name,
                         .size = count * 16,
                         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         .texel_format = format,
                         .host = true});
}

template <class T>
void add_list(Hasher& hasher, const std::vector<T>& list)
{
    hasher.add_bytes(std::as_bytes(std::span(list)));
}

// Open ground in the outer fifth of a scene, where it fills half of each eighth around: else what stands at the rim
// is a house, and no land goes on from it.
std::vector<std::uint32_t> rim_of(const scene::Patches& p)
{
    glm::vec3 low(1.0e30f), high(-1.0e30f);
    for (std::uint32_t i = 0; i < p.count; ++i) {
        low = glm::min(low, p.position_m[i]);
        high = glm::max(high, p.position_m[i]);
    }
    const glm::vec2 middle = 0.5f * glm::vec2(low.x + high.x, low.z + high.z);
    const glm::vec2 half = glm::max(0.5f * glm::vec2(high.x - low.x, high.z - low.z), glm::vec2(1.0e-3f));
    constexpr float kInner = 0.8f;
    std::vector<std::uint32_t> rim;
    std::array<float, 8> filled{};
    for (std::uint32_t i = 0; i < p.count; ++i) {
        const glm::vec2 at = (glm::vec2(p.position_m[i].x, p.position_m[i].z) - middle) / half;
        if (std::max(std::abs(at.x), std::abs(at.y)) < kInner || p.normal[i].y < 0.7f || p.sky_view[i] < 0.5f) continue;
        rim.push_back(i);
        const int eighth = (at.x > 0.0f ? 1 : 0) + (at.y > 0.0f ? 2 : 0) + (std::abs(at.x) > std::abs(at.y) ? 4 : 0);
        filled[static_cast<std::size_t>(eighth)] += p.area_m2[i];
    }
    const float eighth_m2 = 0.5f * (1.0f - kInner * kInner) * half.x * half.y;
    for (const float area : filled)
        if (area < 0.5f * eighth_m2) return {};
    return rim;
}

}  // namespace

PatchLights::PatchLights(const Device& device) : device_(&device)
{
    make_buffers(1, 1, 1, 1);
}

void PatchLights::make_buffers(std::size_t nodes, std::size_t slots, std::size_t ways,
                               std::size_t near)
{
    for (auto* buffer : {&table_, &ways_, &planes_, &irradiance_, &gradient_, &near_, &sky_bins_})
        *buffer = nullptr;
    arena_ = std::make_unique<MemoryArena>(*device_);
    table_ = host_texels(*arena_, "patch_table", slots, VK_FORMAT_R32G32B32A32_UINT);
    ways_ = arena_->buffer({.name = "patch_ways",
                            .size = ways * 4,
                            .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                            .texel_format = VK_FORMAT_R32_UINT,
                            .host = true});
    planes_ = host_texels(*arena_, "patch_planes", nodes, VK_FORMAT_R32G32B32A32_SFLOAT);
    irradiance_ = host_texels(*arena_, "patch_irradiance", nodes, VK_FORMAT_R32G32B32A32_SFLOAT);
    gradient_ = host_texels(*arena_, "patch_gradient", nodes, VK_FORMAT_R32G32B32A32_SFLOAT);
    near_ = host_texels(*arena_, "patch_near", near, VK_FORMAT_R32G32B32A32_SFLOAT);
    sky_bins_ = arena_->buffer({.name = "sky_bins",
                                .size = static_cast<VkDeviceSize>(shared::kSkyBins + 2 * shared::kVisibilityTexels) * 16,
                                .host = true});
}

void PatchLights::load(std::shared_ptr<const PatchScene> scene)
{
    scene_ = std::move(scene);
    ++loads_;
    lit_by_.clear();
    radiosity_.clear();
    rim_.clear();
    rim_radiance_.reset();
    grid_ = {};
    if (!loaded()) {
        make_buffers(1, 1, 1, 1);
        return;
    }
    const scene::Patches& p = scene_->patches;
    rim_ = rim_of(p);
    standing_ = scene::standing_links(p, &scene_->near);
    const scene::LookupWays ways = scene::lookup_ways(p, &scene_->near);
    make_buffers(p.nodes(), ways.table.size(), ways.ways.size(),
                 std::max<std::size_t>(4 * scene_->near.entries(), 1));
    grid_ = ways.grid;
    const auto planes = scene::lookup_planes(p);
    std::memcpy(table_->mapped, ways.table.data(), ways.table.size() * sizeof(ways.table[0]));
    std::memcpy(ways_->mapped, ways.ways.data(), ways.ways.size() * sizeof(ways.ways[0]));
    std::memcpy(planes_->mapped, planes.data(), planes.size() * sizeof(planes[0]));
    const auto near = scene::near_texels(scene_->near);
    std::memcpy(near_->mapped, near.data(), near.size() * sizeof(near[0]));
}

void PatchLights::relight(const Frame& frame, const Sun& sun, const Light* scene_sun,
                          const std::vector<Light>& lights)
{
    relight_ms_ = 0.0;
    relight_cpu_ms_ = 0.0;
    if (!loaded()) return;
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    const scene::Patches& p = scene_->patches;
    const auto texel_of_sky = [&](std::size_t i) {
        glm::vec4 texel;
        std::memcpy(&texel, sky_bins_->mapped + i * sizeof texel, sizeof texel);
        return glm::vec3(texel);
    };
    std::vector<glm::vec3> sky(static_cast<std::size_t>(shared::kSkyBins));
    for (std::size_t i = 0; i < sky.size(); ++i) sky[i] = texel_of_sky(i);
    std::vector<scene::SkyTexel> sky_above(static_cast<std::size_t>(shared::kVisibilityTexels));
    for (std::size_t i = 0; i < sky_above.size(); ++i)
        sky_above[i] = {texel_of_sky(sky.size() + 2 * i), texel_of_sky(sky.size() + 2 * i + 1)};

    Hasher hasher;
    add_list(hasher, sky);
    for (const glm::vec3& v : {sun.direction, sun.illuminance})
        hasher.add_numbers(std::span<const float>(&v.x, 3));
    hasher.add_bytes(std::as_bytes(std::span(&frame.weather, 1)));
    hasher.add_bytes(std::as_bytes(std::span(&frame.look, 1)));
    if (frame.place) {
        // What shows of a patch; what it holds in SI goes on with every frame.
        for (std::size_t i = 0; i + 1 < frame.place->states.size(); i += PLACE_STATE_TEXELS) {
            hasher.add_numbers(std::span<const float>(&frame.place->states[i].x, 4));
            hasher.add(frame.place->states[i + 1].x);
        }
    }
    add_list(hasher, frame.patch_albedo);
    hasher.add(frame.settings.shelter);
    hasher.add(frame.scene_light_scale);
    hasher.add(frame.emissive_scale);
    hasher.add(frame.emissive_lights);
    hasher.add(frame.settings.reflections);
    hasher.add(frame.sky.analytic_sun);
    for (const Light& l : frame.extra_lights) {
        hasher.add(l.kind);
        for (const glm::vec3& v : {l.color, l.position_m, l.direction})
            hasher.add_numbers(std::span<const float>(&v.x, 3));
        for (const float v : {l.intensity, l.range_m, l.inner_cone_rad, l.outer_cone_rad})
            hasher.add(v);
    }
    for (const scene::MaterialChange& change : frame.materials) {
        hasher.add(change.material);
        hasher.add(change.property);
        hasher.add_numbers(std::span<const float>(&change.value.x, 4));
    }
    const std::string lit_by = hasher.text();
    if (lit_by == lit_by_) return;

    PatchLook look = patch_look(*scene_, frame.weather, frame.look, frame.settings.shelter,
                                frame.materials, frame.place.get());
    if (frame.patch_albedo.size() == p.count) {
        look.albedo = frame.patch_albedo;
        for (std::size_t s = 0; s < look.near_albedo.size(); ++s)
            look.near_albedo[s] = look.albedo[scene_->near.sender[s]];
    }
    std::vector<glm::vec3> direct(p.count, glm::vec3(0.0f)), emission(p.count);
    std::vector<glm::vec3> near_direct(scene_->near.sources(), glm::vec3(0.0f));
    scene::add_sun(p, sun.direction, sun.illuminance, direct);
    scene::add_sun(scene_->near, sun.direction, sun.illuminance, near_direct);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (&lights[i] == scene_sun) continue;
        if (lights[i].kind == LightKind::Directional && frame.sky.analytic_sun) continue;
        Light light = lights[i];
        if (light.kind != LightKind::Directional) light.intensity *= frame.scene_light_scale;
        std::span<const std::uint8_t> reach;
        if (i < scene_->lamp_reach.size()) reach = scene_->lamp_reach[i];
        scene::add_lamp(p, light, scene_->light_profiles, reach, direct);
        std::span<const std::uint8_t> near_reach;
        if (i < scene_->near_reach.size()) near_reach = scene_->near_reach[i];
        scene::add_lamp(scene_->near, light, scene_->light_profiles, near_reach, near_direct);
    }
    for (const Light& light : frame.extra_lights) {
        scene::add_lamp(p, light, {}, {}, direct);
        scene::add_lamp(scene_->near, light, {}, {}, near_direct);
    }
    float bright = 0.0f, area = 0.0f;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        emission[i] = look.emission[i] * (shared::kPi * frame.emissive_scale);
        const glm::vec3 a = look.albedo[i];
        bright += p.area_m2[i] * (a.x + a.y + a.z) / 3.0f;
        area += p.area_m2[i];
    }
    for (glm::vec3& radiance : look.near_emission) radiance *= shared::kPi * frame.emissive_scale;
    scene::Relight input;
    input.albedo = look.albedo;
    input.direct = direct;
    input.emission = emission;
    input.sky = sky;
    input.sky_above = sky_above;
    input.glow = &scene_->glow;
    input.near = &scene_->near;
    input.standing = &standing_;
    input.near_texels = {reinterpret_cast<glm::vec4*>(near_->mapped), 4 * scene_->near.entries()};
    input.near_albedo = look.near_albedo;
    input.near_direct = near_direct;
    input.near_emission = look.near_emission;
    input.bounces = bright > kBright * area ? kBouncesBright : kBounces;
    const scene::PatchIrradiance lit = scene::relight(p, input);
    std::memcpy(irradiance_->mapped, lit.irradiance.data(),
                lit.irradiance.size() * sizeof(lit.irradiance[0]));
    std::memcpy(gradient_->mapped, lit.gradient.data(),
                lit.gradient.size() * sizeof(lit.gradient[0]));
    radiosity_ = lit.radiosity;
    rough_radiosity_ = lit.radiosity;
    if (frame.emissive_lights) {
        for (std::size_t i = 0; i < rough_radiosity_.size(); ++i) rough_radiosity_[i] -= emission[i];
        if (!frame.settings.reflections) radiosity_ = rough_radiosity_;
    }
    rim_radiance_.reset();
    if (!rim_.empty()) {
        glm::vec3 sum(0.0f);
        float rim_m2 = 0.0f;
        for (const std::uint32_t i : rim_) {
            sum += p.area_m2[i] * lit.radiosity[i];
            rim_m2 += p.area_m2[i];
        }
        rim_radiance_ = sum / (rim_m2 * shared::kPi);
    }
    lit_by_ = lit_by;
    relight_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                      .count();
    relight_cpu_ms_ = 1e3 * static_cast<double>(std::clock() - cpu_start) / static_cast<double>(CLOCKS_PER_SEC);
}

void add_sky_bins(FrameGraph& graph, SkyMaps& sky, PatchLights& lights)
{
    graph.add(ComputePass{
        .name = "sky_bins",
        .shader = "sky_bins.comp",
        .constants = {},
        .bindings = {{SKY_BINS_SOURCE, sampled(*sky.cube, sky.linear)},
                     {SKY_BINS_TARGET, storage_buffer(lights.sky_bins())}},
        .push = {},
        .groups = {(static_cast<std::uint32_t>(shared::kSkyBins + shared::kVisibilityTexels) + SKY_BINS_GROUP - 1) /
                       SKY_BINS_GROUP,
                   1, 1}});
    graph.read_back({&lights.sky_bins()});
}

}  // namespace petrichor::gpu
