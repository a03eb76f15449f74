#ifndef PETRICHOR_TEXPROC_MATERIAL_SOURCE_MAPS_H
#define PETRICHOR_TEXPROC_MATERIAL_SOURCE_MAPS_H

#include <map>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"
#include "texproc/material/plan.h"

namespace petrichor::texproc {

/// One map as its file holds it.
struct MadeSource {
    std::string role;
    int width = 0, height = 0, channels = 0, bits = 0;
};

/// Level 0 of everything that the outputs of a material draw from, by role.
struct SourceMaps {
    std::map<std::string, RawImage> images;
    std::vector<MadeSource> sources;  ///< the maps that were read
    std::vector<std::string> notes{};  ///< maps that were resampled
    std::string green;  ///< what was done to the normal map: "up", "down, turned, ..."

    const RawImage* find(const std::string& role) const
    {
        const auto at = images.find(role);
        return at == images.end() ? nullptr : &at->second;
    }
    /// A role that is there, as numbers.
    Image data(const std::string& role) const
    {
        return to_image(images.at(role), ColorSpace::Data);
    }
    /// The roughness, or the smoothness where that is what there is.
    std::string rough_role() const { return find("roughness") ? "roughness" : "smoothness"; }
};

/// Reads the maps that the outputs need, turns the normals green up and bakes what is missing.
/// Throws Error that names the file at fault.
SourceMaps read_source_maps(const PlannedMaterial& plan, int threads);

/// Where a role came from, for people: a file, or "the baked height".
std::string file_of(const PlannedMaterial& plan, const std::string& role);

}  // namespace petrichor::texproc

#endif
