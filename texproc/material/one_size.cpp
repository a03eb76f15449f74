#include "texproc/material/one_size.h"

#include <algorithm>
#include <utility>

#include "texproc/filter/normal.h"
#include "texproc/filter/resample.h"
#include "texproc/material/chains.h"

namespace petrichor::texproc {

namespace {

using Roles = std::vector<std::string>;

// The maps that a baked role is made from.
Roles sources_of(const std::string& baked, const std::map<std::string, RawImage>& maps)
{
    if (baked == "porosity")
        return {maps.count("roughness") ? "roughness" : "smoothness", "metallic"};
    return {baked == "height" ? "normal" : "height"};
}

class Groups {
public:
    explicit Groups(const std::map<std::string, RawImage>& maps) : maps_(maps)
    {
        for (const auto& [role, map] : maps) group_[role] = role;
    }

    // The roles that are there belong together.
    void join(const Roles& roles)
    {
        std::string first;
        for (const std::string& role : roles) {
            if (group_.count(role) == 0) continue;
            if (first.empty()) first = group_[role];
            const std::string old = group_[role];
            for (auto& [name, group] : group_) {
                if (group == old) group = first;
            }
        }
    }

    // The largest map of the group of a role.
    const RawImage& largest(const std::string& role) const
    {
        const RawImage* best = &maps_.at(role);
        const auto texels = [](const RawImage& map) {
            return static_cast<long long>(map.width) * map.height;
        };
        for (const auto& [name, group] : group_) {
            if (group == group_.at(role) && texels(maps_.at(name)) > texels(*best))
                best = &maps_.at(name);
        }
        return *best;
    }

private:
    const std::map<std::string, RawImage>& maps_;
    std::map<std::string, std::string> group_;
};

Groups groups_of(const PlannedMaterial& plan, const std::map<std::string, RawImage>& maps)
{
    Groups groups(maps);
    bool prefiltered = false;
    for (const PlannedOutput& output : plan.outputs) {
        Roles together = output.roles;
        for (const std::string& role : output.roles) {
            if (std::find(plan.baked.begin(), plan.baked.end(), role) == plan.baked.end()) continue;
            const Roles from = sources_of(role, maps);
            together.insert(together.end(), from.begin(), from.end());
        }
        groups.join(together);
        prefiltered = prefiltered || output.prefiltered;
    }
    if (prefiltered) groups.join({"normal", maps.count("roughness") ? "roughness" : "smoothness"});
    return groups;
}

std::string size_text(int width, int height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

RawImage in_size(const RawImage& map, const std::string& role, int width, int height, int threads)
{
    const bool integers = map.type == PixelType::U8 || map.type == PixelType::U16;
    Image image = to_image(map, is_color(role) && integers ? ColorSpace::Linear : ColorSpace::Data);
    image = resized(image, width, height, threads);
    if (role == "normal" && image.channels == 3) renormalize(image);
    return to_raw(image, map.type);
}

}  // namespace

std::vector<std::string> bring_to_one_size(const PlannedMaterial& plan,
                                           std::map<std::string, RawImage>& maps, int threads)
{
    const Groups groups = groups_of(plan, maps);
    std::map<std::string, std::pair<int, int>> sizes;
    for (const auto& [role, map] : maps) {
        const RawImage& largest = groups.largest(role);
        sizes[role] = {largest.width, largest.height};
    }
    std::vector<std::string> notes;
    for (auto& [role, map] : maps) {
        const auto [width, height] = sizes[role];
        if (map.width == width && map.height == height) continue;
        notes.push_back(role + ": " + size_text(map.width, map.height) + " resampled to " +
                        size_text(width, height));
        map = in_size(map, role, width, height, threads);
    }
    return notes;
}

}  // namespace petrichor::texproc
