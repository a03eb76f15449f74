#ifndef PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H
#define PETRICHOR_FILM_SCENARIO_MATERIAL_KEYS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "scene/scene.h"

namespace petrichor::film {

/// A weather property of a material that a scenario may set by [materials."glob"].
struct MaterialKey {
    std::string name;
    int count = 1;  ///< numbers: 1, 2 or 4; 0 for true or false
    double low = 0.0;
    double high = 1.0;
    std::string example;
    std::string meaning;
    void (*set)(scene::MaterialWeather&, const std::vector<double>&) = nullptr;
};
const std::vector<MaterialKey>& material_keys();

/// Applies the overrides in the order of the file (a later one wins) and returns the globs that
/// match no material, with a hint, for the log.
std::vector<std::string> apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                                  std::vector<scene::Material>& materials);

}  // namespace petrichor::film

#endif
