#include "film/scenario/probe_keys.h"

#include "gpu/frame/patch_scene.h"

namespace petrichor::film {
namespace {

scene::ProbePlace read_probe(const TomlValue& one, ScenarioProbePicture& picture)
{
    scene::ProbePlace place;
    bool decode = false;
    bool stands = false;
    for (const auto& [name, entry] : one.entries(
             {"position_m", "low_m", "high_m", "blend_m", "importance", "intensity",
              "picture", "decode"})) {
        if (name == "position_m") {
            place.position_m = glm::vec3(entry.point());
            stands = true;
        } else if (name == "low_m") {
            place.low_m = glm::vec3(entry.point());
        } else if (name == "high_m") {
            place.high_m = glm::vec3(entry.point());
        } else if (name == "blend_m") {
            place.blend_m = static_cast<float>(entry.number(0.0, 1e4));
        } else if (name == "importance") {
            place.importance = static_cast<float>(entry.number(0.0, 5.0));
        } else if (name == "picture") {
            picture.file = entry.text();
        } else if (name == "decode") {
            picture.decode = static_cast<LightCode>(entry.choice({"auto", "float", "rgbm", "dldr"}));
            decode = true;
        } else {
            place.intensity = static_cast<float>(entry.number(0.0, 1e6));
        }
    }
    if (decode && picture.file.empty()) one.refuse("a picture beside decode");
    if (!stands) one.refuse("a table with position_m");
    for (int i = 0; i < 3; ++i) {
        if (!(place.low_m[i] < place.position_m[i] && place.position_m[i] < place.high_m[i]))
            one.refuse("a probe whose position_m lies between low_m and high_m");
    }
    return place;
}

}  // namespace

ScenarioProbes read_probes(const TomlValue& value)
{
    ScenarioProbes probes;
    if (!value.is_array()) {
        probes.automatic = value.choice({"auto", "off"}) == 0;
        return probes;
    }
    probes.automatic = false;
    for (const TomlValue& one : value.elements()) {
        probes.pictures.emplace_back();
        probes.places.push_back(read_probe(one, probes.pictures.back()));
    }
    if (probes.places.size() > gpu::kMostProbes)
        value.refuse("at most " + std::to_string(gpu::kMostProbes) + " probes");
    return probes;
}

}  // namespace petrichor::film
