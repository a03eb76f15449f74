#ifndef PETRICHOR_TEXPROC_MATERIAL_MATERIAL_NAMES_H
#define PETRICHOR_TEXPROC_MATERIAL_MATERIAL_NAMES_H

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "texproc/filter/mips.h"

namespace petrichor::texproc {

/// A file and, after the last colon, some of its channels: "wall.png", "arm.png:g", "spec.png:rgb".
struct InputMap {
    std::filesystem::path path;
    std::string channels;  ///< letters of "rgba"; empty: all
    std::string text() const { return path.string() + (channels.empty() ? "" : ":" + channels); }
};
InputMap parse_input_map(const std::string& text);

/// Which way the green channel of a normal map points. Auto: the name does not say.
enum class Green { Auto, Up, Down };

/// The maps of one material, by role.
struct MaterialFiles {
    std::string name;                        ///< "Bricks102", for the names of outputs
    std::filesystem::path folder;            ///< below the folder that was searched; may be empty
    std::string tile;                        ///< of a UDIM set: "1001"; empty: none
    std::map<std::string, InputMap> inputs;  ///< "albedo", "normal", "roughness", ...
    Green green = Green::Auto;               ///< what the name of the normal map says
    Edge edge_u = Edge::Wrap, edge_v = Edge::Wrap;  ///< of a scene: what its sampler says
    std::vector<std::string> notes;          ///< files that another one won over
};

/// What the words of a file name say it holds: every role and its channels; empty when they say
/// nothing. `wall_nor_gl_2k` is the normal map of `wall`, `Wall_LuxSPEC` its specular colour and
/// smoothness, `wall_arm` three maps at once, `T_Wall_N` Unreal's.
struct NamedMaps {
    std::string material;                      ///< the rest of the name
    std::string short_name;                    ///< the same without marks of resolution and format
    std::string tile;                          ///< of a UDIM set: "1001"
    std::map<std::string, std::string> roles;  ///< role -> channels
    Green green = Green::Auto;
};
NamedMaps maps_named(const std::string& stem);

/// All materials below a folder, sorted by folder and name, by the names that ambientCG, Poly
/// Haven, Lux and most tools give their maps. Throws Error when there is no such folder or nothing
/// in it can be recognised.
std::vector<MaterialFiles> find_materials(const std::filesystem::path& folder);

/// Images below a folder whose names do not say what they hold, which find_materials() passes over.
std::vector<std::filesystem::path> unnamed_images(const std::filesystem::path& folder);

/// The tiles of a set whose paths hold <UDIM>, in order: every tile for which a file of one of the
/// maps is there. Itself when no path holds it. Throws Error when there is no tile.
std::vector<MaterialFiles> udim_tiles(const MaterialFiles& set);

/// The roles that maps can have, for messages and completion.
const std::vector<std::string>& map_roles();

}  // namespace petrichor::texproc

#endif
