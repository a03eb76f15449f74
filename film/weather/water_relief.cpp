#include "film/weather/water_relief.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "formulas/weather/ground_relief.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr int kMostSide = 512;  // of a height map: finer detail holds no water
constexpr std::size_t kPieces = 128, kStorePieces = 32;
constexpr double kSpillShare = 1.0 / 3.0;  // as of the ground without a height map (ground_relief.h)
constexpr double kFlat_mm = 0.5;           // that flat ground holds
constexpr float kMappedUp = 0.72f, kBareUp = 0.9976f;
constexpr float kLeastRange = 1e-4f;  // flatter is flat

// One channel of an image of a scene.
class NumberMap {
public:
    NumberMap(const scene::EncodedImage& source, scene::Channel channel) : source_(&source)
    {
        const Image image = texproc::decode_image(
            source.bytes, source.name, {.space = ColorSpace::Data, .max_side = kMostSide});
        width_ = image.width;
        height_ = image.height;
        const int last = image.channels - 1;
        const int wanted = static_cast<int>(channel);
        // Grey stands for red, green and blue; a missing alpha is 1.
        const bool missing = wanted == 3 && image.channels != 2 && image.channels != 4;
        const int c = wanted == 3 ? last : image.channels <= 2 ? 0 : std::min(wanted, last);
        values_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                values_.push_back(missing ? 1.0f : image.at(x, y, c));
    }
    float at(glm::vec2 uv) const
    {
        const int x = texel(uv.x, source_->wrap_u, width_), y = texel(uv.y, source_->wrap_v, height_);
        return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)];
    }

private:
    static int texel(float x, scene::Wrap wrap, int size)
    {
        if (!std::isfinite(x)) return 0;
        float part = std::clamp(x, 0.0f, 1.0f);
        if (wrap != scene::Wrap::Clamp) {
            const float whole = std::floor(x);
            part = x - whole;
            if (wrap != scene::Wrap::Repeat && std::fmod(whole, 2.0f) != 0.0f) part = 1.0f - part;
        }
        return std::clamp(static_cast<int>(part * static_cast<float>(size)), 0, size - 1);
    }

    const scene::EncodedImage* source_;
    int width_ = 1, height_ = 1;
    std::vector<float> values_;
};

class NumberMaps {
public:
    NumberMaps(const scene::Scene& scene, std::vector<std::string>& notes)
        : scene_(scene), notes_(notes)
    {
    }
    // Null without a texture that can be read.
    const NumberMap* find(const scene::TextureUse& use)
    {
        if (!use.present() || static_cast<std::size_t>(use.texture) >= scene_.textures.size())
            return nullptr;
        const auto key = std::make_pair(use.texture, use.channel);
        auto found = maps_.find(key);
        if (found == maps_.end()) {
            std::vector<NumberMap> made;
            try {
                const auto& source = scene_.textures[static_cast<std::size_t>(use.texture)];
                if (!source.bytes.empty()) made.emplace_back(source, use.channel);
            } catch (const Error& error) {
                notes_.push_back(std::string("water stands as without it: ") + error.what());
            }
            found = maps_.emplace(key, std::move(made)).first;
        }
        return found->second.empty() ? nullptr : &found->second.front();
    }

private:
    const scene::Scene& scene_;
    std::vector<std::string>& notes_;
    std::map<std::pair<scene::TextureIndex, scene::Channel>, std::vector<NumberMap>> maps_;
};

struct Weighted {
    float height, area;
};

WaterRelief relief_of(std::vector<Weighted> points, double unit_mm)
{
    WaterRelief relief;
    if (points.empty()) return relief;
    relief.unit_mm = unit_mm;
    float low = points.front().height, high = low;
    double area = 0.0;
    for (const Weighted& p : points) {
        low = std::min(low, p.height);
        high = std::max(high, p.height);
        area += static_cast<double>(p.area);
    }
    relief.lowest = low;
    const float range = high - low;
    if (!(range > kLeastRange)) {
        relief.curve.depth_mm = 0.0;
        return relief;
    }
    const double piece = static_cast<double>(range) * unit_mm / static_cast<double>(kPieces);
    std::vector<double> bins(kPieces, 0.0);
    for (const Weighted& p : points) {
        const auto at = static_cast<std::size_t>((p.height - low) / range * float{kPieces});
        bins[std::min(at, kPieces - 1)] += static_cast<double>(p.area) / area;
    }
    relief.curve.depth_mm = static_cast<double>(range) * unit_mm;
    relief.curve.area_fraction.assign(1, 0.0);
    relief.curve.volume_mm.assign(1, 0.0);
    for (const double bin : bins) {
        const double before = relief.curve.area_fraction.back(), now = std::min(before + bin, 1.0);
        relief.curve.volume_mm.push_back(relief.curve.volume_mm.back() + 0.5 * piece * (before + now));
        relief.curve.area_fraction.push_back(now);
    }
    return relief;
}

}  // namespace

bool holds_water(const scene::Material& material, const glm::vec3& normal)
{
    return normal.y > (material.weather.height.present() ? kMappedUp : kBareUp);
}

WaterReliefs water_reliefs(const scene::Patches& patches, const scene::Triangles& triangles,
                           std::vector<std::string>& notes)
{
    const scene::Scene& scene = triangles.scene();
    NumberMaps maps(scene, notes);
    std::vector<std::vector<Weighted>> points(scene.materials.size());
    std::vector<bool> masked(scene.materials.size(), false);
    WaterReliefs reliefs;
    reliefs.hollow.assign(patches.count, false);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const scene::Material& m = scene.materials[patches.material[i]];
        const glm::vec4& takes = m.weather.water_accumulation;
        if (m.weather.sheltered || !(std::max(takes.y, takes.w) > 0.0f) ||
            !holds_water(m, patches.normal[i]))
            continue;
        const NumberMap* heights = maps.find(m.weather.height);
        const NumberMap* mask = maps.find(m.weather.puddle_mask);
        float open_sum = 0.0f;
        for (int k = 0; k < scene::kPatchSamples; ++k) {
            const scene::PatchSample& s =
                patches.samples[std::size_t{i} * scene::kPatchSamples + static_cast<std::size_t>(k)];
            if (triangles.material(s.triangle) != patches.material[i]) continue;
            float open = triangles.weather(s.triangle, s.at).g;
            if (mask != nullptr)
                open *= mask->at(triangles.uv(s.triangle, s.at, m.weather.puddle_mask));
            open_sum += open;
            if (open < 0.5f) masked[patches.material[i]] = true;
            float height = 0.0f;
            if (heights != nullptr) {
                height = heights->at(triangles.uv(s.triangle, s.at, m.weather.height));
            } else {
                const glm::vec3 at = triangles.point(s.triangle, s.at);
                height = m.weather.default_height +
                         shared::kGroundRelief *
                             shared::ground_relief_of(glm::vec2(at.x, at.z) * m.weather.hollow_tiling, m.weather.hollow_tiling);
            }
            points[patches.material[i]].push_back({height, patches.area_m2[i]});
        }
        reliefs.hollow[i] = open_sum > 0.5f * float{scene::kPatchSamples};
    }
    for (std::uint32_t i = 0; i < patches.count; ++i)
        if (!masked[patches.material[i]]) reliefs.hollow[i] = false;
    for (std::size_t m = 0; m < points.size(); ++m) {
        const auto& weather = scene.materials[m].weather;
        const float unit_m = weather.height.present() && weather.height_scale_m > 0.0f
                                 ? weather.height_scale_m
                                 : shared::kGroundReliefUnit_m;
        reliefs.of_material.push_back(
            relief_of(std::move(points[m]), 1e3 * static_cast<double>(unit_m)));
    }
    return reliefs;
}

weather::Hypsometry store_of_relief(const WaterRelief& relief, bool hollow)
{
    const weather::Hypsometry& whole = relief.curve;
    if (!(whole.depth_mm > 0.0)) return weather::uniform_hypsometry(2.0 * kFlat_mm);
    double spill_mm = whole.depth_mm;
    if (!hollow) {
        const auto first = std::find_if(whole.area_fraction.begin(), whole.area_fraction.end(),
                                        [](double share) { return share >= kSpillShare; });
        spill_mm *= static_cast<double>(std::max<std::ptrdiff_t>(
                        first - whole.area_fraction.begin(), 1)) /
                    static_cast<double>(kPieces);
    }
    weather::Hypsometry store;
    store.depth_mm = spill_mm;
    for (std::size_t k = 0; k <= kStorePieces; ++k) {
        const double level =
            spill_mm * static_cast<double>(k) / static_cast<double>(kStorePieces);
        store.area_fraction.push_back(k > 0 ? weather::wet_area(whole, level) : 0.0);
        if (k > 0) {
            store.volume_mm.push_back(
                store.volume_mm.back() + 0.5 * spill_mm / static_cast<double>(kStorePieces) *
                                             (store.area_fraction[k] + store.area_fraction[k - 1]));
        } else {
            store.volume_mm.push_back(0.0);
        }
    }
    return store;
}

float relief_level(const WaterRelief& relief, double mean_mm)
{
    if (!(relief.unit_mm > 0.0) || !(mean_mm > 0.0)) return relief.lowest - 1.0f;
    double level_mm = 0.0, over_mm = mean_mm;
    if (relief.curve.depth_mm > 0.0) {
        over_mm = std::max(0.0, mean_mm - relief.curve.capacity_kg_m2());
        level_mm = weather::water_level_mm(relief.curve, mean_mm - over_mm);
    }
    return relief.lowest + static_cast<float>((level_mm + over_mm) / relief.unit_mm);
}

float drowned_share(const WaterRelief& relief, float level)
{
    if (!(relief.unit_mm > 0.0) || level <= relief.lowest) return 0.0f;
    if (!(relief.curve.depth_mm > 0.0)) return 1.0f;
    const double level_mm = static_cast<double>(level - relief.lowest) * relief.unit_mm;
    return static_cast<float>(
        weather::wet_area(relief.curve, std::min(level_mm, relief.curve.depth_mm)));
}

}  // namespace petrichor::film
