#ifndef PETRICHOR_SCENE_SCENE_H
#define PETRICHOR_SCENE_SCENE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petrichor::scene {

/// Index into Scene::textures; none when negative.
using TextureIndex = std::int32_t;
inline constexpr TextureIndex kNoTexture = -1;

enum class Wrap { Repeat, Clamp, Mirror };

enum class Channel { R, G, B, A };

/// How a material reads one texture (KHR_texture_transform folded in).
/// uv' = rotate(rotation_rad) * (uv * scale) + offset, as the extension defines it.
struct TextureUse {
    TextureIndex texture = kNoTexture;
    int texcoord = 0;  ///< 0 or 1; a mesh without 1 is read at 0
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation_rad = 0.0f;
    Channel channel = Channel::R;  ///< of a texture that holds one number

    bool present() const { return texture >= 0; }
};

enum class AlphaMode { Opaque, Mask, Blend };

/// How water stands on a material (the feature sets of Lux 2.02).
enum class Wetness {
    None,     ///< a film only, and what melting snow leaves
    Simple,   ///< standing water with a flat surface
    Ripples,  ///< ... with rings of rain drops
    Flow,     ///< ... with waves of flowing water
    Full,     ///< ... with both
};

/// How the height map moves what is seen (Lux 2.02): heights below 1 lie below the geometry.
enum class Parallax {
    None,
    Simple,     ///< two look-ups
    Occlusion,  ///< a ray is walked through the relief
};

/// Which rule lays snow on a material (Lux 2.02).
enum class SnowRule {
    Surface,  ///< by slope, height of the world and masks
    Grass,    ///< on blades: the lighter a vertex, the more
    Vertex,   ///< by slope alone, the same over a whole surface
};

/// Where the maps of the snow are laid.
enum class SnowMapping { World, Local };

/// What weather does to a material. Symbols and defaults: Lux 2.02 (docs/lux.md, 7). All linear.
/// Ranges, meanings and the glTF extension's names: material_table.h.
struct MaterialWeather {
    Wetness wetness = Wetness::Full;
    TextureUse height;  ///< 0 low .. 1 high
    float height_scale_m = 0.02f;
    Parallax parallax = Parallax::None;
    float parallax_steps = 20.0f;
    float parallax_level = -1.0f;  ///< of the height map's mips; negative: by the pixel's footprint
    float default_height = 0.25f;
    float hollow_tiling = 1.0f;  ///< hollows of ground without a height map: how many times narrower than a step
    TextureUse puddle_mask;  ///< 1 puddles may stand, 0 never
    TextureUse snow_mask;    ///< 1 snow may lie, 0 never
    float porosity = -1.0f;  ///< negative: from the roughness
    float film = -1.0f;      ///< how far a film of water shows; negative: wholly
    float beads = -1.0f;     ///< how far water stands in beads in place of a film; negative: as none
    float water_slope_damp = 0.5f;
    glm::vec4 water_accumulation{0.0f, 1.0f, 0.0f, 1.0f};
    glm::vec4 water_color{0.0f};
    float ripple_refraction = 1.0f;
    float flow_tiling = 2.0f;
    float flow_speed = 0.05f;
    float flow_interval_s = 1.0f;
    float flow_refraction = 0.02f;
    float flow_normal_strength = 1.0f;
    float snow_slope_damp = 0.75f;
    glm::vec2 snow_accumulation{0.0f, 1.0f};
    float snow_normal_strength = 1.0f;
    float snow_detail_strength = 0.3f;
    float snow_opacity = 0.5f;
    SnowRule snow_rule = SnowRule::Surface;
    SnowMapping snow_mapping = SnowMapping::World;
    glm::vec4 snow_local_tiling{2.0f, 4.0f, 0.3f, 4.0f};
    TextureUse snow_mask_normal;  ///< of the snow where the snow mask has it trodden down
    float snow_mask_normal_scale = 1.0f;
    bool sheltered = false;
};

/// What the second set of textures is for.
enum class SecondSetUse {
    None,
    Mix,     ///< another material beside the first
    Detail,  ///< fine structure on the first
    Layers,  ///< four materials, by the weights of a control map: the ground of a terrain
};

/// The third or fourth material of a ground of layers. Ranges and meanings: material_table.h.
struct GroundLayer {
    TextureUse base_color_texture;
    TextureUse normal_texture;
    TextureUse metallic_roughness_texture;  ///< R occlusion, G roughness, B metallic
    glm::vec2 tiling{1.0f};  ///< of the three
    glm::vec3 color{1.0f};   ///< linear
    float roughness = 1.0f;
};

/// A second set of textures on a material (Lux 2.02). Ranges and meanings: material_table.h.
struct SecondSet {
    SecondSetUse use = SecondSetUse::None;
    float mix_factor = 1.0f;  ///< share of the first set
    TextureUse mix_mask;      ///< times it; times red of _WEATHER
    glm::vec2 mix_mask_tiling{1.0f};
    TextureUse base_color_texture;
    TextureUse normal_texture;
    TextureUse metallic_roughness_texture;  ///< R occlusion, G roughness, B metallic
    TextureUse height;
    glm::vec2 tiling{1.0f};  ///< of the four
    glm::vec3 color{1.0f};   ///< linear
    float metallic = 0.0f;
    float roughness = 1.0f;
    float specular = -1.0f;  ///< negative: as the first set
    float normal_scale = 1.0f;
    bool occlusion_in_alpha = false;  ///< of the colour texture; false: red of the packed one
    glm::vec3 scatter_color{0.0f};    ///< of a rim of fibres, as of the first set
    float scatter_bias = 0.0f;
    float scatter_power = 8.0f;
    bool own_water = false;  ///< false: that of the first set
    glm::vec4 water_accumulation{0.0f, 1.0f, 0.0f, 1.0f};
    glm::vec4 water_color{0.0f};
    // Of layers alone.
    GroundLayer third;
    GroundLayer fourth;
    float by_height = 0.0f;  ///< 0 blended by weight .. 1 the higher layer wins
    TextureUse far_texture;  ///< colour of all of it from afar
    float far_start_m = 150.0f;
    float far_fade_m = 100.0f;
};

/// Where a plant's vertices learn how far they are from its root, 0 .. 1.
enum class WindWeight {
    Height,  ///< above the lowest point of the mesh
    Uv,      ///< v of the first coordinates: roots at 1, tops at 0
    Mask,    ///< alpha of _WEATHER
};

/// How a material bends in the wind (scene/animation/wave.h). Ranges and meanings: material_table.h.
struct WindLook {
    float bend = 0.0f;
    float flutter_m = 0.0f;
    float sway_hz = 0.8f;
    float height_m = 0.0f;
    WindWeight weight = WindWeight::Height;

    bool moves() const { return bend > 0.0f || flutter_m > 0.0f; }
};

/// Of a material that is laid over what lies below it instead of being a surface of its own. Ranges and
/// meanings: material_table.h.
struct DecalLook {
    bool on = false;
    glm::vec4 weights{1.0f, 1.0f, 1.0f, 0.0f};  ///< colour; normal; roughness and the like; weather
    float order = 0.0f;                         ///< higher ones lie over lower ones
    float reach_m = 0.05f;
    bool received = true;  ///< of what lies below: it takes decals
};

/// Textures of what lies over, in and beside the base: a share each of the factor of its name. At most
/// kMostLayerTextures of a material are shown.
inline constexpr int kMostLayerTextures = 6;
struct LayerTextures {
    TextureUse clearcoat;              ///< R
    TextureUse clearcoat_roughness;    ///< G
    TextureUse clearcoat_normal;       ///< of the coat alone
    TextureUse sheen_color;            ///< sRGB
    TextureUse sheen_roughness;        ///< A
    TextureUse anisotropy;             ///< RG direction in the tangent frame, B strength
    TextureUse diffuse_transmission;   ///< A
    TextureUse diffuse_transmission_color;  ///< sRGB
    TextureUse transmission;           ///< R
    TextureUse thickness;              ///< G
    TextureUse specular;               ///< A
    TextureUse specular_color;         ///< sRGB
    TextureUse iridescence;            ///< R
    TextureUse iridescence_thickness;  ///< G
    TextureUse specular_glossiness;    ///< sRGB reflectance, A smoothness
    TextureUse translucency;
    TextureUse skin_curvature;
    /// A second lobe of each texel, beside normal_texture and metallic_roughness_texture, which then hold
    /// the first: RG normal, B roughness, A share of what shines (formulas/light/second_lobe.h).
    TextureUse second_lobe;
};

/// The height map as geometry: the mesh is cut when it is loaded, and its points are moved along their
/// normals. Ranges and meanings: material_table.h.
struct Displacement {
    float height_m = 0.0f;  ///< height 1 above height 0; what is half high stays; 0: off
    float edge_m = 0.05f;
    float near_m = 7.0f;
    float far_m = 25.0f;
    float phong = 0.0f;
    float most = 64.0f;
};

/// A dry material: glTF 2.0 metallic-roughness and the extensions that we read (material_table.h).
struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};  ///< linear
    TextureUse base_color_texture;
    float metallic = 1.0f;
    float roughness = 1.0f;                 ///< perceptual
    TextureUse metallic_roughness_texture;  ///< G roughness, B metallic
    TextureUse normal_texture;              ///< +y up
    float normal_scale = 1.0f;
    TextureUse occlusion_texture;
    float occlusion_strength = 1.0f;
    glm::vec3 emissive{0.0f};  ///< linear
    float emissive_strength = 1.0f;
    TextureUse emissive_texture;
    TextureUse light_map{kNoTexture, 1};  ///< baked light, over the second coordinates
    float light_map_scale = 1.0f;         ///< lux of a texel of 1
    float light_map_sky = 1.0f;           ///< share of the sky's light that comes on top
    float ior = 1.5f;
    float specular = 1.0f;           ///< KHR_materials_specular factor
    glm::vec3 specular_color{1.0f};  ///< KHR_materials_specular colour
    float diffuse_transmission = 0.0f;  ///< KHR_materials_diffuse_transmission factor
    glm::vec3 diffuse_transmission_color{1.0f};  ///< .. and the colour of what comes through
    bool diffuse_transmission_of_base = false;  ///< it has the base colour instead, with vertex colours and weather
    float transmission = 0.0f;       ///< KHR_materials_transmission factor
    float thickness = 0.0f;          ///< KHR_materials_volume: of what light passes, mesh units
    float attenuation_distance_m = 0.0f;  ///< in it; 0: it is clear
    glm::vec3 attenuation_color{1.0f};    ///< what is left of white light after that distance
    float dispersion = 0.0f;              ///< 20 / Abbe number
    bool specular_workflow = false;  ///< reflectance and smoothness instead of metallic and roughness
    glm::vec3 workflow_specular{1.0f};  ///< of it: reflectance at normal incidence
    float glossiness = 1.0f;            ///< of it: 1 - perceptual roughness
    float iridescence = 0.0f;           ///< of a thin film
    float iridescence_ior = 1.3f;
    float iridescence_thickness_min_nm = 100.0f;  ///< where its texture is 0
    float iridescence_thickness_max_nm = 400.0f;  ///< .. and 1, or is none
    float clearcoat = 0.0f;
    float clearcoat_roughness = 0.0f;
    float clearcoat_normal_scale = 1.0f;
    glm::vec3 sheen_color{0.0f};
    float sheen_roughness = 0.0f;
    float anisotropy = 0.0f;
    float anisotropy_rotation_rad = 0.0f;
    float translucency = 0.0f;  ///< light that comes through (Lux 2.02), of the models that have it
    float translucency_power = 4.0f;
    float translucency_distortion = 0.1f;
    float translucency_scale = 4.0f;
    float translucency_shadow = 0.7f;
    glm::vec3 translucency_color{1.0f};
    glm::vec3 scatter_color{0.0f};  ///< of a rim of fibres (Lux 2.02: diffuse scattering)
    float scatter_bias = 0.0f;
    float scatter_power = 8.0f;
    float skin_curvature = 0.1f;  ///< of the model "skin"
    float skin_curvature_scale = 0.0f;
    float skin_blur = 0.0f;  ///< .. how far normals are blurred for its diffuse light
    float hair_shift = 0.1f;  ///< of the model "hair"
    float vertex_occlusion = 0.0f;  ///< how far green of COLOR_0 is occlusion too
    LayerTextures maps;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool premultiplied_alpha = false;  ///< Blend: what is mirrored does not fade with alpha
    bool casts_shadows = true;
    bool receives_shadows = true;  ///< false: sun and lamps light it as if nothing stood in their way
    bool area_lights = true;  ///< false: lamps light it as points, whatever their size
    bool double_sided = false;
    bool cull_front = false;
    bool unlit = false;  ///< KHR_materials_unlit: the model "unlit", if none is named
    std::string lighting_model;  ///< a built-in name, or a GLSL file's path; empty: the standard one
    std::string surface;  ///< path of a GLSL file that changes the dry surface; empty: none
    MaterialWeather weather;
    SecondSet second;
    DecalLook decal;
    WindLook wind;
    Displacement displacement;
};

/// What a shape that a mesh is morphed to adds at weight 1. Each is empty or has positions.size()
/// entries.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// One joint's share of a vertex.
struct Influence {
    std::uint32_t joint = 0;  ///< index into Skin::joints
    float weight = 0.0f;      ///< those of a vertex sum up to 1
};

/// Triangles of one material. All attribute arrays have positions.size() entries; uv1, colors and
/// weather may be empty. Tangents are as MikkTSpace defines them, w the bitangent sign.
struct Primitive {
    std::vector<glm::vec3> positions;  ///< object space, metres
    std::vector<glm::vec3> normals;    ///< unit
    std::vector<glm::vec4> tangents;   ///< unit xyz, w = -1 or 1
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors;  ///< COLOR_0, linear; multiplies the base colour
    std::vector<glm::vec4>
        weather;  ///< _WEATHER, 0..1: r mix, g puddle mask, b snow mask, a how far wind moves it
    std::vector<std::uint32_t> indices;  ///< 3 a triangle, each < positions.size()
    std::uint32_t material = 0;          ///< index into Scene::materials
    std::vector<MorphTarget> targets;    ///< empty: it is not morphed
    std::vector<Influence> influences;   ///< as many for each vertex; empty: it has no skin
    bool flat = false;                   ///< normals are those of the triangles, in every shape

    bool deforms() const { return !targets.empty() || !influences.empty(); }
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// One of several shapes of a thing, finer and coarser: it is shown while the thing's sphere is so high in
/// the picture, as a share of the picture's height.
struct DetailLevel {
    std::uint32_t level = 0;  ///< 0 the finest, which alone counts for light, water and bounds
    float low = 0.0f;         ///< 0: however small
    float high = 0.0f;        ///< of coarser levels
    glm::vec3 centre_m{0.0f};
    float radius_m = 0.0f;    ///< of the finest; 0: there are no others

    bool operator==(const DetailLevel&) const = default;
};

/// What one instance has instead of its materials' own values.
struct InstanceLook {
    std::optional<glm::vec3> color;  ///< linear, for base_color_factor
    std::optional<float> metallic;   ///< for metallic_factor
    std::optional<float> roughness;  ///< for roughness_factor
    std::optional<float> emission;   ///< times what its materials send out

    bool operator==(const InstanceLook&) const = default;
};

/// Nodes, skins and animations of a scene: scene/animation/rig.h.
struct Rig;
inline constexpr std::int32_t kNoNode = -1;

/// A mesh placed in the world. Several instances may share a mesh.
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    glm::mat4 to_world{1.0f};
    /// What the program put around the scene: seen and shaded, but no part of its bounds and hollows;
    /// patches only near the scene.
    bool backdrop = false;
    /// Its place or shape is another in other frames; `to_world` is that at rest. No part of patches,
    /// hollows and ground.
    bool moves = false;
    std::int32_t node = kNoNode;  ///< of the rig, that carries it; read while it `moves`
    std::int32_t skin = -1;       ///< of the rig; joints alone place it then
    glm::mat4 in_node{1.0f};      ///< from the mesh to the node
    InstanceLook look = {};
    DetailLevel detail = {};

    /// It takes part in what is worked out once: bounds, patches, hollows.
    bool stands() const { return !moves && detail.level == 0; }
};

/// A material that is projected onto all that lies in a box: along its -z, u along its x, v down its y.
struct ProjectedDecal {
    std::string name;
    std::uint32_t material = 0;        ///< index into Scene::materials
    glm::mat4 to_world{1.0f};          ///< from the cube of -0.5 to 0.5, at rest
    float full_angle_rad = 0.8f;       ///< to faces turned no more than so from its z; then it fades ..
    float none_angle_rad = 1.3f;       ///< .. and ends here
    float edge_fade = 0.0f;            ///< share of the half box over which it fades at all sides
    std::int32_t node = kNoNode;       ///< of the rig, that carries it
    glm::mat4 in_node{1.0f};           ///< from the cube to the node
};

struct Bounds {
    glm::vec3 low{0.0f};
    glm::vec3 high{0.0f};
};

/// What of a marched shape may be other in another frame.
struct ShapeMoment {
    glm::mat4 to_world{1.0f};  ///< from its own space: a turn, one scale and a shift
    float power = 8.0f;        ///< of a Mandelbulb, 2 to 12

    bool operator==(const ShapeMoment&) const = default;
};

/// A thing without triangles, to whose surface rays are marched (scene/shapes.h). Seen, shadowed and under
/// the weather as all else, but no part of patches, hollows and snow with a body.
struct MarchedShape {
    std::string name;
    int kind = 0;                ///< SHAPE_... of formulas/geometry/shapes.h
    std::uint32_t material = 0;  ///< index into Scene::materials; opaque
    int iterations = 0;          ///< of what is made in steps
    glm::vec3 half{1.0f};        ///< of a box; of a torus: half as wide as it is, radius of its tube, the first again
    ShapeMoment rest;
    std::optional<Bounds> reach;  ///< of all its moments; none: it rests
};

enum class LightKind { Directional, Point, Spot, Rectangle };

/// KHR_lights_punctual in world space, and glowing rectangles.
struct Light {
    std::string name;
    LightKind kind = LightKind::Point;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;  ///< lux for directional, candela for point and spot, cd/m2 of a rectangle
    float range_m = 0.0f;    ///< 0: unlimited
    glm::vec3 position_m{0.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< the light travels this way, unit
    float inner_cone_rad = 0.0f;
    float outer_cone_rad = 0.785398163f;
    glm::vec3 half_u_m{0.0f};  ///< of a rectangle: half its edges; `direction` is its front
    glm::vec3 half_v_m{0.0f};
    bool both_sides = false;
    glm::vec3 up{0.0f, 1.0f, 0.0f};  ///< unit, across `direction`: how it is turned about it
    float radius_m = 0.0f;   ///< > 0: a point is a sphere or tube, a spot a disc
    float length_m = 0.0f;   ///< of a tube, along `up`
    bool shaped = false;     ///< a rectangle that is a lamp, not a surface that glows
    bool per_vertex = false; ///< a point's or a spot's diffuse light is worked out at vertices; it gives no other
    bool glows = false;      ///< a surface that glows, which is seen by itself, too
    float specular = 1.0f;   ///< 0..1: of highlights; 0 fills without any
    float shadow_strength = 1.0f;  ///< 0..1: share of the light that its shadows take away
    int mask_channel = 0;    ///< of shadow masks, that its shadow is baked in: 1..3; 0: none
    std::int32_t node = kNoNode;  ///< of the rig, that carries it
    std::int32_t profile = -1;  ///< index into Scene::light_profiles; none when negative
    bool in_lantern = false;  ///< its shadows are those of what lies outside its lantern (scene/patches/lanterns.h); `profile` has the rest
};

/// How a lamp shines by direction, at most 1: a measured distribution (IES) over angles, or a picture
/// before a spot (cookie). kLightProfileSide squared texels, by rows; of a picture before the sun then the
/// smaller ones, to one texel.
inline constexpr int kLightProfileSide = 128;
struct LightProfile {
    std::string name;
    bool picture = false;  ///< over the square of a spot's cone, `up` up; else over angles: a column a
                           ///< turn about `direction` from `up`, a row an angle from it, 0 to pi
    std::vector<glm::vec3> texels;
    bool lantern = false;  ///< over an octahedron around the axes of the world (formulas/codec/octahedral.h): share
                           ///< of the lamp that is seen past its lantern, and metres to what lies first that way
};

/// Looks along -z of `to_world`, +y up.
struct Camera {
    std::string name;
    glm::mat4 to_world{1.0f};
    float vertical_fov_rad = 0.8f;  ///< (0, pi); ignored when orthographic
    float near_m = 0.05f;
    float orthographic_height_m = 0.0f;  ///< > 0: orthographic
    std::int32_t node = kNoNode;         ///< of the rig, that carries it
    glm::vec2 shift{0.0f};  ///< where the picture's middle lies from the axis, right and up, in halves of its width and height
};
/// Half of what a picture of width x height shows at a distance of 1 m, metres; orthographic: at
/// any.
glm::vec2 half_extent_m(const Camera& camera, int width, int height);
/// Camera space to clip space, y up, depth reversed: 1 at the near plane, 0 infinitely far.
/// Orthographic: 1 at the camera, 0 at `far_m`.
glm::mat4 clip_projection(const Camera& camera, int width, int height, float far_m);

/// An image of the scene as it lies in the file: bytes still encoded (PNG, JPEG, WebP, KTX2, ...).
struct EncodedImage {
    std::string name;  ///< for messages: the URI or "image 3 (name)"
    std::vector<std::byte> bytes;
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    bool nearest = false;  ///< magnification filter
};

/// One texture = one image and one sampler. The pixels are decoded outside of this room.
struct Scene {
    std::string name;
    std::vector<EncodedImage> textures;
    std::vector<Material> materials;  ///< never empty once loaded; index 0 may be the default
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<ProjectedDecal> decals;
    std::vector<MarchedShape> shapes;
    std::vector<Light> lights;
    std::vector<LightProfile> light_profiles;
    std::vector<Camera> cameras;
    std::vector<std::string> warnings;  ///< what was ignored or mended, for the log
    std::shared_ptr<const Rig> rig;     ///< null: nothing moves
    std::optional<Bounds> reach;        ///< of all that moves, over time
};

/// World-space bounds of all instances but backdrops, and of shapes; of what moves, all that it passes through.
Bounds scene_bounds(const Scene& scene);

}  // namespace petrichor::scene

#endif
