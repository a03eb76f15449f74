#ifndef PETRICHOR_TEXPROC_GLTF_IMAGE_PLAN_H
#define PETRICHOR_TEXPROC_GLTF_IMAGE_PLAN_H

#include <cstddef>
#include <string>
#include <vector>

#include "texproc/filter/mips.h"
#include "texproc/gltf/gltf_file.h"

namespace petrichor::texproc {

/// What an image of a scene holds, by the slots of the materials that use it.
enum class ImageMeaning {
    Color,    ///< sRGB, alpha beside it
    Normal,   ///< tangent space, green up
    Surface,  ///< occlusion, roughness, metallic
    Data,     ///< anything else that is linear
    SecondLobe,  ///< made: normal, roughness and share of a second lobe of each texel
};

/// Where a material has the textures of two lobes of a texel: normalTexture and metallicRoughnessTexture of
/// the first, which take the place of the material's own for who knows the extension, and
/// secondLobeTexture. Its own stay those of one lobe.
inline constexpr const char* kTwoLobes = "PETRICHOR_materials_two_lobes";

/// One image to be made: a source image, and what of its materials its levels depend on. Uses that
/// agree in all of this share one image; others get one each.
struct ImageRecipe {
    std::size_t image = 0;  ///< of the scene
    ImageMeaning meaning = ImageMeaning::Data;
    Edge edge_u = Edge::Wrap, edge_v = Edge::Wrap;
    bool alpha_covers = false;  ///< Color: not opaque
    float alpha_cutoff = -1.0f;
    int normal = -1;   ///< Color, Surface: image of the normals that belong to it
    int surface = -1;  ///< Color: image whose blue is metal; Normal: with whose roughness it goes
    float normal_scale = 1.0f;
    float roughness_factor = 1.0f;
    float metallic_factor = 1.0f;
    int lobes = 1;  ///< Surface, Normal: 2: of the first of two lobes, which are fitted together
    bool operator==(const ImageRecipe&) const = default;
};

/// A textureInfo of a material: where it stands, and which image it is to show.
struct TextureSlot {
    std::size_t material = 0;
    std::vector<std::string> keys;  ///< from the material down: pbrMetallicRoughness, ...
    std::size_t texture = 0;        ///< of the scene, as it is
    std::size_t recipe = 0;         ///< of ImagePlan::recipes
    std::vector<std::string> like = {};  ///< of a slot that the material lacks: that whose textureInfo it takes
};

struct ImagePlan {
    std::vector<ImageRecipe> recipes;
    std::vector<TextureSlot> slots;
    std::vector<std::size_t> kept_textures;    ///< that something unknown uses as well
    std::vector<std::size_t> baked_materials;  ///< whose roughness factor goes into the image
    std::vector<std::string> notes;            ///< what is left as it was, and why
};

/// Reads the materials of a scene; no pixels.
///
///   bake_roughness  may put the roughness factor of a material into its image
///   by_class        surfaces and their normals depend on how much of the material is metal
///   lobes           2: opaque materials with normals and roughness that lie alike get kTwoLobes as well
///   throws          Error for an index that points outside its list
ImagePlan plan_images(const GltfFile& file, bool bake_roughness, int lobes = 1, bool by_class = false);

/// The image that a texture shows as PNG, JPEG or WebP; -1: none, or it brings its own levels.
int source_image(const GltfFile& file, std::size_t texture);

}  // namespace petrichor::texproc

#endif
