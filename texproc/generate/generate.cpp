#include "texproc/generate/generate.h"

#include <algorithm>
#include <thread>

#include "base/error.h"
#include "base/words.h"
#include "formulas/weather/apply_weather.h"
#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc {

using namespace detail;

namespace {

const std::vector<KindRow>& rows()
{
    static const std::vector<KindRow> all = [] {
        std::vector<KindRow> joined;
        for (const auto& kinds : {stone_kinds(), masonry_kinds(), roof_kinds(), road_kinds(), ground_kinds(),
                                  wood_and_metal_kinds(), gravel_kinds(), soft_kinds()}) {
            joined.insert(joined.end(), kinds.begin(), kinds.end());
        }
        std::sort(joined.begin(), joined.end(),
                  [](const KindRow& a, const KindRow& b) { return a.kind < b.kind; });
        return joined;
    }();
    return all;
}

}  // namespace

const std::vector<MaterialKindInfo>& material_kinds()
{
    static const std::vector<MaterialKindInfo> kinds = [] {
        std::vector<MaterialKindInfo> infos;
        for (const KindRow& row : rows()) {
            MaterialKindInfo info{row.kind, row.name, row.meaning, {}};
            info.parameters = {
                {"tile_m", "m", row.tile_m, 0.1f, 50.0f, "edge of the square that repeats"},
                {"relief", "factor", 1.0f, 0.0f, 4.0f, "of all heights"},
                {"wetness", "share", 0.0f, 0.0f, 1.0f, "film of water in colour and roughness (0 where weather comes later)"}};
            info.parameters.insert(info.parameters.end(), row.parameters.begin(), row.parameters.end());
            infos.push_back(std::move(info));
        }
        return infos;
    }();
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

// Every parameter, chosen or as usual.
std::map<std::string, float, std::less<>> all_values(const MaterialRecipe& recipe,
                                                     const MaterialKindInfo& info)
{
    std::map<std::string, float, std::less<>> values;
    std::vector<std::string> names;
    for (const MaterialParameter& parameter : info.parameters) {
        values[parameter.name] = parameter.usual;
        names.push_back(parameter.name);
    }
    for (const auto& [name, value] : recipe.values) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            throw Error("material " + info.name + ": there is no parameter '" + name + "'." +
                            did_you_mean(name, names),
                        "It has " + join_words(names) + ".");
        }
        const MaterialParameter& parameter =
            info.parameters[static_cast<std::size_t>(found - names.begin())];
        if (!(value >= parameter.low && value <= parameter.high)) {
            throw Error("material " + info.name + ": " + name + " is " +
                            number_text(value) + ", outside of " +
                            number_text(parameter.low) + " to " +
                            number_text(parameter.high),
                        "It means: " + parameter.meaning + ".");
        }
        values[name] = value;
    }
    return values;
}

// Gives the texels another mean: partly by the channels, so that stones of two colours stay two, partly by lightness
// alone, so that no strange hues come up. What would pass 1 stays at it.
void recolor(std::vector<MaterialTexel>& texels, const glm::vec3& color)
{
    glm::dvec3 sum(0.0);
    for (const MaterialTexel& texel : texels) sum += glm::dvec3(texel.albedo);
    const glm::vec3 mean = glm::max(glm::vec3(sum / static_cast<double>(texels.size())), glm::vec3(1e-4f));
    const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    const float mean_light = glm::dot(mean, weights);
    for (MaterialTexel& texel : texels) {
        const float light = glm::dot(texel.albedo, weights) / mean_light;
        texel.albedo = color * mix(texel.albedo / mean, glm::vec3(light), 0.65f);
    }
}

// A film as the renderer lays it on dry surfaces (formulas/weather/apply_weather.h): matt ground is darker and
// smoother below it.
void wet(std::vector<MaterialTexel>& texels, float film)
{
    for (MaterialTexel& texel : texels) {
        shared::WeatheredMaterial dry{};
        dry.albedo = glm::clamp(texel.albedo, 0.0f, 1.0f);
        dry.specular = glm::mix(glm::vec3(0.04f), texel.albedo, texel.metallic);
        dry.smoothness = 1.0f - texel.roughness;
        dry.metallic = texel.metallic;
        const float porosity = saturate((texel.roughness - 0.5f) / 0.4f);
        const shared::WeatheredMaterial wet =
            shared::apply_water(dry, glm::vec2(film), 0.0f, glm::vec4(0.0f), porosity);
        texel.albedo = wet.albedo;
        texel.roughness = 1.0f - wet.smoothness;
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
    return generate_material({kind, size, seed, threads, {}, {}});
}

MaterialMaps generate_material(const MaterialRecipe& recipe)
{
    const int size = recipe.size;
    if (!(size >= 16 && size <= 8192)) {
        throw Error("material: the size must be 16 to 8192 texels, got " + std::to_string(size),
                    "Choose a size in that range, for example 1024.");
    }
    const auto index = static_cast<std::size_t>(recipe.kind);
    MaterialSurface surface;
    surface.size = size;
    surface.threads = recipe.threads > 0
                          ? std::min(recipe.threads, 256)
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    surface.seed =
        hash_u32(recipe.seed * 0x9e3779b1u + static_cast<std::uint32_t>(recipe.kind) * 7919u + 1u);
    surface.values = all_values(recipe, material_kinds()[index]);
    surface.tile_m = surface.value("tile_m");
    surface.texels.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    rows()[index].make(surface);
    if (recipe.color) recolor(surface.texels, *recipe.color);
    const float film = surface.value("wetness");
    if (film > 0.0f) wet(surface.texels, film);
    const float relief = surface.value("relief");
    for (MaterialTexel& texel : surface.texels) texel.height_m *= relief;

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
