#include "scene/patches/mask_channels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

bool meet(const LampReach& a, const LampReach& b)
{
    return glm::length(a.centre_m - b.centre_m) < a.radius_m + b.radius_m;
}

// Lamps of one name.
struct Group {
    std::vector<std::size_t> lamps;
    float candela = 0.0f;  // of the strongest
};

}  // namespace

LampReach lamp_reach(const Light& light, float least_lux)
{
    LampReach reach{light.position_m, std::numeric_limits<float>::infinity()};
    if (light.kind == LightKind::Directional) return reach;
    const float brightest = std::max({light.color.r, light.color.g, light.color.b, 0.0f});
    const float far_m = light.range_m > 0.0f ? light.range_m
                                             : std::sqrt(light_candela(light) * brightest / least_lux);
    reach.radius_m = far_m;
    if (light.kind != LightKind::Spot) return reach;
    // The smallest ball round the cone and its cap.
    const float cosine = std::cos(light.outer_cone_rad);
    if (cosine > 0.70710678f) {
        reach.radius_m = 0.5f * far_m / cosine;
        reach.centre_m += light.direction * reach.radius_m;
    } else if (cosine > 0.0f) {
        reach.radius_m = far_m * std::sin(light.outer_cone_rad);
        reach.centre_m += light.direction * (far_m * cosine);
    }
    return reach;
}

std::vector<int> mask_channels(std::span<const Light> lamps, const std::vector<bool>& wanted)
{
    std::vector<LampReach> reaches;
    std::vector<Group> groups;
    std::map<std::string, std::size_t> of_name;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        reaches.push_back(lamp_reach(lamps[i]));
        if (!wanted.empty() && !wanted[i]) continue;
        const auto [found, fresh] = of_name.try_emplace(lamps[i].name, groups.size());
        if (fresh) groups.emplace_back();
        Group& group = groups[found->second];
        group.lamps.push_back(i);
        group.candela = std::max(group.candela, light_candela(lamps[i]));
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.candela > b.candela; });
    std::vector<int> channels(lamps.size(), 0);
    std::vector<std::size_t> held[kMaskChannels];
    for (const Group& group : groups) {
        bool apart = true;
        for (std::size_t i = 0; i < group.lamps.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k)
                apart = apart && !meet(reaches[group.lamps[i]], reaches[group.lamps[k]]);
        }
        for (int c = 0; apart && c < kMaskChannels; ++c) {
            const bool free = std::all_of(group.lamps.begin(), group.lamps.end(), [&](std::size_t lamp) {
                return std::none_of(held[c].begin(), held[c].end(),
                                    [&](std::size_t other) { return meet(reaches[lamp], reaches[other]); });
            });
            if (!free) continue;
            for (const std::size_t lamp : group.lamps) {
                channels[lamp] = c + 1;
                held[c].push_back(lamp);
            }
            break;
        }
    }
    return channels;
}

}  // namespace petrichor::scene
