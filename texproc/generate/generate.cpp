#include "texproc/generate/generate.h"

#include <array>
#include <thread>

#include "base/error.h"
#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc {

using namespace detail;

const std::vector<MaterialKindInfo>& material_kinds()
{
    static const std::vector<MaterialKindInfo> kinds = {
        {MaterialKind::Cobble, "cobble", "worn granite setts in irregular courses"},
        {MaterialKind::Brick, "brick", "brickwork in running bond, chipped and sooty"},
        {MaterialKind::Asphalt, "asphalt", "stone chippings in bitumen, fine cracks"},
        {MaterialKind::Concrete, "concrete", "cast concrete with pores and stains"},
        {MaterialKind::Paving, "paving", "riven stone slabs in courses"},
        {MaterialKind::Granite, "granite", "bush-hammered granite without joints"},
        {MaterialKind::Plank, "plank", "weathered boards, grain along v"},
        {MaterialKind::RoofTile, "roof_tile", "clay plain tiles with rounded tails"},
        {MaterialKind::Soil, "soil", "trodden earth with pebbles"},
        {MaterialKind::GrassGround, "grass_ground", "short grass over soil"},
        {MaterialKind::MetalPlate, "metal_plate", "galvanised sheet with spangle and scratches"},
        {MaterialKind::PaintedIron, "painted_iron", "dark paint on cast iron, chipped and rusty"},
        {MaterialKind::StandingSeam, "standing_seam", "patinated sheet roof with seams"},
        {MaterialKind::Plaster, "plaster", "lime plaster with stains and hair cracks"},
    };
    return kinds;
}

std::optional<MaterialKind> find_material_kind(std::string_view name)
{
    for (const MaterialKindInfo& info : material_kinds()) {
        if (info.name == name) return info.kind;
    }
    return std::nullopt;
}

namespace {

void make_surface(MaterialKind kind, MaterialSurface& surface)
{
    switch (kind) {
        case MaterialKind::Cobble:
            return make_cobble(surface);
        case MaterialKind::Brick:
            return make_brick(surface);
        case MaterialKind::Asphalt:
            return make_asphalt(surface);
        case MaterialKind::Concrete:
            return make_concrete(surface);
        case MaterialKind::Paving:
            return make_paving(surface);
        case MaterialKind::Granite:
            return make_granite(surface);
        case MaterialKind::Plank:
            return make_plank(surface);
        case MaterialKind::RoofTile:
            return make_roof_tile(surface);
        case MaterialKind::Soil:
            return make_soil(surface);
        case MaterialKind::GrassGround:
            return make_grass_ground(surface);
        case MaterialKind::MetalPlate:
            return make_metal_plate(surface);
        case MaterialKind::PaintedIron:
            return make_painted_iron(surface);
        case MaterialKind::StandingSeam:
            return make_standing_seam(surface);
        case MaterialKind::Plaster:
            return make_plaster(surface);
    }
}

// How much of the sky a texel sees, from how far it lies below the mean around it at four radii.
void add_occlusion(const MaterialSurface& surface, const std::vector<float>& height_m,
                   Image& occlusion)
{
    std::fill(occlusion.pixels.begin(), occlusion.pixels.end(), 1.0f);
    for (const float radius_m : {0.0025f, 0.006f, 0.015f, 0.04f}) {
        const int radius = static_cast<int>(std::lround(radius_m / surface.texel_m()));
        if (radius < 1) continue;
        const std::vector<float> mean = box_blur(height_m, surface.size, radius, surface.threads);
        const float strength = 1.1f * surface.occlusion_strength / radius_m;
        for_rows(surface.size, surface.threads, [&](int first, int last) {
            const auto n = static_cast<std::size_t>(surface.size);
            for (std::size_t k = static_cast<std::size_t>(first) * n;
                 k < static_cast<std::size_t>(last) * n; ++k) {
                const float below = std::max(mean[k] - height_m[k], 0.0f) * strength;
                occlusion.pixels[k] /= 1.0f + below;
            }
        });
    }
}

void add_normals(const MaterialSurface& surface, const std::vector<float>& height_m, Image& normal)
{
    const int size = surface.size;
    const auto n = static_cast<std::size_t>(size);
    const float inverse_m = 0.5f / surface.texel_m();
    for_rows(size, surface.threads, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            const float* row = height_m.data() + static_cast<std::size_t>(j) * n;
            const float* above =
                height_m.data() + static_cast<std::size_t>(wrap_index(j - 1, size)) * n;
            const float* below =
                height_m.data() + static_cast<std::size_t>(wrap_index(j + 1, size)) * n;
            for (int i = 0; i < size; ++i) {
                const int left = i == 0 ? size - 1 : i - 1;
                const int right = i + 1 == size ? 0 : i + 1;
                const float slope_x = (row[right] - row[left]) * inverse_m;
                const float slope_up = (above[i] - below[i]) * inverse_m;
                const float scale =
                    0.5f / std::sqrt(slope_x * slope_x + slope_up * slope_up + 1.0f);
                float* out = normal.pixels.data() + normal.index(i, j, 0);
                out[0] = 0.5f - slope_x * scale;
                out[1] = 0.5f - slope_up * scale;
                out[2] = 0.5f + scale;
            }
        }
    });
}

}  // namespace

MaterialMaps generate_material(MaterialKind kind, int size, std::uint32_t seed, int threads)
{
    if (!(size >= 16 && size <= 8192)) {
        throw Error("material: the size must be 16 to 8192 texels, got " + std::to_string(size),
                    "Choose a size in that range, for example 1024.");
    }
    MaterialSurface surface;
    surface.size = size;
    surface.threads = threads > 0
                          ? std::min(threads, 256)
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    surface.seed = hash_u32(seed * 0x9e3779b1u + static_cast<std::uint32_t>(kind) * 7919u + 1u);
    surface.texels.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    make_surface(kind, surface);

    float low = surface.texels.front().height_m;
    float high = low;
    for (const MaterialTexel& texel : surface.texels) {
        low = std::min(low, texel.height_m);
        high = std::max(high, texel.height_m);
    }
    MaterialMaps maps;
    maps.tile_m = surface.tile_m;
    maps.height_scale_m = high - low;
    maps.albedo = Image(size, size, 3, ColorSpace::Linear);
    maps.normal = Image(size, size, 3, ColorSpace::Data);
    for (Image* image :
         {&maps.height, &maps.roughness, &maps.occlusion, &maps.metallic, &maps.puddle_mask}) {
        *image = Image(size, size, 1, ColorSpace::Data);
    }

    const std::vector<float> hollows =
        noise_layer(surface, {0.5f * surface.tile_m, 0.5f * surface.tile_m, 3, 0.4f, 9001u});
    std::vector<float> height_m(surface.texels.size());
    const float to_unit = 1.0f / std::max(high - low, 1e-9f);
    const auto n = static_cast<std::size_t>(size);
    for_rows(size, surface.threads, [&](int first, int last) {
        for (std::size_t k = static_cast<std::size_t>(first) * n;
             k < static_cast<std::size_t>(last) * n; ++k) {
            const MaterialTexel& texel = surface.texels[k];
            height_m[k] = texel.height_m - low;
            maps.height.pixels[k] = saturate(height_m[k] * to_unit);
            for (int c = 0; c < 3; ++c) {
                maps.albedo.pixels[3 * k + static_cast<std::size_t>(c)] = saturate(texel.albedo[c]);
            }
            maps.roughness.pixels[k] = std::clamp(texel.roughness, 0.02f, 1.0f);
            maps.metallic.pixels[k] = saturate(texel.metallic);
            maps.puddle_mask.pixels[k] = smooth_step(-0.15f, 0.35f, hollows[k]);
        }
    });
    surface.texels = {};
    add_normals(surface, height_m, maps.normal);
    add_occlusion(surface, height_m, maps.occlusion);
    return maps;
}

}  // namespace petrichor::texproc
