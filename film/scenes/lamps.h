#ifndef PETRICHOR_FILM_SCENES_LAMPS_H
#define PETRICHOR_FILM_SCENES_LAMPS_H

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "gpu/frame/frame.h"
#include "scene/scene.h"

namespace petrichor::film {

struct AppliedLamps {
    std::vector<std::string> unmatched;  ///< globs that match no lamp, with a hint, for the log
    std::string content;                 ///< fingerprint of the files that were read; "" without
};

/// Applies the overrides in the order of the file (a later one wins). Files that they name are looked for
/// in `folder`. Throws Error for one that cannot be read, and for a shape that a lamp cannot have.
AppliedLamps apply_lamp_overrides(const std::vector<LampOverride>& overrides,
                                  const std::filesystem::path& folder, scene::Scene& scene);

struct SunCookies {
    std::map<std::string, gpu::SunCookie> of_file;  ///< as the scenario names them
    std::string content;                            ///< fingerprint of the files; "" without
};

/// Reads the pictures before the sun of all conditions and lays them behind the scene's profiles. Throws
/// Error for one that cannot be read.
SunCookies read_sun_cookies(const std::vector<std::string>& files, const std::filesystem::path& folder,
                            scene::Scene& scene);

}  // namespace petrichor::film

#endif
