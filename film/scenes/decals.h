#ifndef PETRICHOR_FILM_SCENES_DECALS_H
#define PETRICHOR_FILM_SCENES_DECALS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"

namespace petrichor::film {

/// Gives the scene the boxes of [decals]; a material that it does not have is added, for
/// [materials."glob"] to describe. Call it before those are applied. Throws Error for a node that is not
/// there and for a material that nothing describes. Returns a fingerprint; "" without any.
std::string add_decals(const std::vector<ScenarioDecal>& decals,
                       const std::vector<MaterialOverride>& materials, scene::Scene& scene);

/// After materials were described. Throws Error when a decal shows a material with a `surface` of its own;
/// warns of a lighting model, which a decal does not have.
void check_decals(scene::Scene& scene);

}  // namespace petrichor::film

#endif
