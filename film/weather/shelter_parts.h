#ifndef PETRICHOR_FILM_WEATHER_SHELTER_PARTS_H
#define PETRICHOR_FILM_WEATHER_SHELTER_PARTS_H

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/place/place_parts.h"
#include "scene/patches/patches.h"
#include "weather/patches/patches.h"

namespace petrichor::film {

/// Patches across which a shelter ends, cut into parts that have their own weather, finer than the patch: along
/// the lines below the edges of awnings, eaves, cars and benches.
///
/// The first part of a patch keeps its number among weather patches, the one below the sky; others come behind
/// all patches.
struct ShelterParts {
    struct Cut {
        gpu::PlaceParts parts;
        std::uint32_t extra = 0;  ///< number of the weather patch of its second part; the next ones follow
        std::uint32_t weather_patch(std::uint32_t part) const
        {
            return part == 0 ? parts.patch : extra + part - 1;
        }
    };
    std::uint32_t patches = 0;  ///< of the scene
    std::vector<Cut> cuts;
    std::vector<glm::vec3> position_m;   ///< middles of all weather patches
    std::vector<std::uint32_t> of;       ///< the patch of each
};

/// Cuts a set, whose patches are those of the scene. Every part has its share of the patch's area, so that
/// what falls on the parts is what falls on the patch, and sees what rays of its own find; links, ways of water and
/// what stands upwind are the patch's.
///
/// Asked are patches of ground and roofs above which both sky and shelter are seen, straight up from 8 x 8 cells each:
/// part 0 lies below the sky, part 1 below something. Shade of leaves falls apart into too many pieces and is left alone.
ShelterParts cut_at_shelters(weather::PatchSet& set, const scene::Patches& patches, const scene::Tracer& tracer);

/// States of weather patches, `texels` of them each, as pictures have them: patches, those that are cut the mean of
/// their parts by area, then all parts.
///   area_m2  of the weather patches
std::vector<glm::vec4> states_with_parts(std::vector<glm::vec4> states, std::size_t texels, const ShelterParts& shelter,
                                         std::span<const double> area_m2);

}  // namespace petrichor::film

#endif
