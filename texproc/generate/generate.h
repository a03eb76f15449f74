#ifndef PETRICHOR_TEXPROC_GENERATE_GENERATE_H
#define PETRICHOR_TEXPROC_GENERATE_GENERATE_H

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

enum class MaterialKind {
    Cobble,        ///< worn granite setts in irregular courses, sand and moss in the joints
    Brick,         ///< running bond, chipped edges, recessed mortar, some sooty bricks
    Asphalt,       ///< stone chippings in bitumen, fine cracks
    Concrete,      ///< cast slab: pores, stains, faint board marks
    Paving,        ///< riven stone slabs in courses, narrow joints
    Granite,       ///< bush-hammered block without joints, for kerbs, gutters and sills
    Plank,         ///< weathered boards, the grain runs along v
    RoofTile,      ///< clay plain tiles with rounded tails, v down the slope
    Soil,          ///< trodden earth with pebbles
    GrassGround,   ///< short grass over soil
    MetalPlate,    ///< galvanised sheet with spangle and scratches
    PaintedIron,   ///< dark paint on cast iron, chipped, with rust
    StandingSeam,  ///< patinated sheet roof, a seam every 0.4 m, v down the slope
    Plaster,       ///< lime plaster: trowel marks, stains, hair cracks
    Gravel,        ///< broken or rounded stone of several sizes, heaped
    Slate,         ///< riven roofing slates, v down the slope
    Moss,          ///< cushions of small shoots
    Mud,           ///< wet or dried earth: wheel ruts, shrinkage cracks
    Snow,          ///< wind-packed snow: drifts, ripples, grains
};

/// A number of a kind that can be chosen.
struct MaterialParameter {
    std::string name;     ///< "joint_m"
    std::string unit;     ///< "m", "share" (0..1), "count", "factor"
    float usual = 0.0f;   ///< what it is unless chosen
    float low = 0.0f;     ///< accepted: low..high
    float high = 1.0f;
    std::string meaning;  ///< one line
};

struct MaterialKindInfo {
    MaterialKind kind;
    std::string name;     ///< as on the command line: "roof_tile"
    std::string meaning;  ///< one line
    std::vector<MaterialParameter> parameters;  ///< those that all kinds have (tile_m, relief, wetness) first
};

/// What to make. The same recipe gives the same bits on any machine.
struct MaterialRecipe {
    MaterialKind kind = MaterialKind::Cobble;
    int size = 1024;         ///< texels of a side, 16..8192
    std::uint32_t seed = 1;
    int threads = 0;         ///< 0: all cores
    std::map<std::string, float, std::less<>> values;  ///< of its parameters; the others are as usual
    std::optional<glm::vec3> color;  ///< mean albedo, linear 0..1, in place of the kind's own
};

/// All kinds, in the order of the enumeration.
const std::vector<MaterialKindInfo>& material_kinds();

/// The kind of that name, none when there is no such kind.
std::optional<MaterialKind> find_material_kind(std::string_view name);

/// One square material that tiles in both directions. All images are size x size.
struct MaterialMaps {
    Image albedo;       ///< 3 channels, Linear, 0..1
    Image normal;       ///< 3 channels, 0.5 + 0.5 n, +x right, +y up the image, unit length
    Image height;       ///< 1 channel, 0 lowest .. 1 highest, both reached
    Image roughness;    ///< 1 channel, perceptual
    Image occlusion;    ///< 1 channel, 1 = open
    Image metallic;     ///< 1 channel
    Image puddle_mask;  ///< 1 channel, 1 = low ground where puddles may stand; smooth, large scale
    float tile_m = 1.0f;          ///< edge of the square in the world
    float height_scale_m = 0.0f;  ///< height 1 above height 0
};

/// Makes a material from a seed. Tiles exactly; the normals are those of the height at true scale
/// (height_scale_m over tile_m). Same arguments, same bits, for any thread count.
///
///   size     16 .. 8192 texels
///   threads  0: all cores
///   throws   Error when size or a value is out of range or no parameter has that name.
MaterialMaps generate_material(const MaterialRecipe& recipe);

/// The same with all parameters as usual.
MaterialMaps generate_material(MaterialKind kind, int size, std::uint32_t seed, int threads = 0);

}  // namespace petrichor::texproc

#endif
