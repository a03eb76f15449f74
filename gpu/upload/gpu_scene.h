#ifndef PETRICHOR_GPU_UPLOAD_GPU_SCENE_H
#define PETRICHOR_GPU_UPLOAD_GPU_SCENE_H

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/device/pipelines.h"
#include "gpu/lighting/lighting_models.h"
#include "gpu/surface/own_surfaces.h"
#include "gpu/upload/material_io.h"
#include "gpu/upload/emissive_lights.h"
#include "gpu/upload/pose.h"
#include "gpu/upload/steep_triangles.h"
#include "gpu/upload/texture.h"
#include "gpu/upload/vertex.h"
#include "scene/material_table.h"

namespace petrichor::gpu {

const std::vector<VertexAttribute>& vertex_attributes();
/// Of the buffer of positions alone.
VertexAttribute position_attribute();

/// One primitive of one instance.
struct Draw {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_vertex = 0;  ///< from vertex_offset: the least of its indices
    std::uint32_t vertex_count = 0;
    std::uint32_t most_indices = 0;  ///< index_count where it is shown
    std::uint32_t material = 0;
    std::uint32_t instance_id = 0;
    std::uint32_t primitive = 0;  ///< number in the instance's mesh
    std::uint32_t look = 0;  ///< number of its instance's look, from 1; 0: none
    DetailLevel detail;
    std::uint32_t fade = 0;  ///< DrawConstants::fade, of this frame
    bool shown = true;       ///< in this frame, as its level of detail has it
    bool casts = true;       ///< likewise
    glm::mat4 to_world{1.0f};
    glm::vec3 centre_m{0.0f};  ///< bounding sphere, world
    float radius_m = 0.0f;
    bool mirrored = false;
    std::int32_t moving = -1;  ///< index of what moves it; negative: nothing does
    std::int32_t waving = -1;  ///< likewise of how wind bends it
    bool overlay = false;
    bool ice = false;          ///< of an overlay: no snow
    std::int32_t shape = -1;  ///< number in the scene's shapes; negative: triangles
};

/// What is laid over the surfaces: triangles, or a box that projects.
struct Decal {
    float order = 0.0f;
    Draw draw;  ///< of a box: its material and place alone
    std::optional<ProjectedDecal> box;
};
inline constexpr Bounds kDecalBox{glm::vec3(-0.5f), glm::vec3(0.5f)};

/// What lies on a scene in some frames, and is shaped anew for each: in the world, under the materials
/// and the names of what it lies on.
struct Overlay {
    struct Part {
        std::uint32_t material = 0;
        std::uint32_t instance_id = 0;
        std::uint32_t first_index = 0;
        std::uint32_t index_count = 0;
        Bounds box;  ///< that it never leaves
        bool ice = false;  ///< it is no snow
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Part> parts;
};

/// Triangles of a primitive that the overlay hides: kFromSun in maps, for it throws the same shadows; kFromEye to all eyes over it.
struct Covered {
    static constexpr std::uint8_t kFromSun = 1, kFromEye = 2;
    std::uint32_t instance_id = 0;
    std::uint32_t primitive = 0;
    std::vector<std::uint8_t> triangles;
};

/// An overlay as it lies in a frame.
struct LaidOverlay {
    std::span<const Vertex> vertices;
    std::span<const std::uint32_t> indices;  ///< of its triangles; those of a part from where they begin in the Overlay
    std::span<const std::uint32_t> counts;   ///< of each part: how many of its indices are drawn
    std::span<const std::uint8_t> hidden;    ///< of each triangle, as in Covered: what need not be drawn from there; those of a part likewise
    std::span<const Covered> covered;
    bool snow = true;  ///< some of it is
};

/// The bounding sphere of a draw, from the box of its vertices.
void place_sphere(Draw& draw, const Bounds& box);

struct GpuMaterial {
    VkCullModeFlags cull = VK_CULL_MODE_BACK_BIT;
    bool masked = false;
    bool blended = false;
    bool bends = false;  ///< it is, and what is seen through it is bent or blurred
    bool glows = false;
    bool casts_shadows = true;
    bool decal_weather = false;        ///< as a decal it brings its own
    bool looks = false;                ///< some instance has other values than it
    bool on_shapes = false;            ///< some marched shape shows it
    bool sheds = true;                 ///< only what falls puts water on it: none stands where it is steep
    bool in_world = true;              ///< what shows it is laid out in the world, and stays
    std::uint32_t slots = 0;           ///< texture slots present, one bit each
    std::uint32_t parallax = 0;        ///< PARALLAX_...; none without a height map
    std::uint32_t water = 0;           ///< WATER_... bits of its wetness
    std::uint32_t snow = 0;            ///< SNOW_... bits of its rule and mapping
    std::uint32_t second = 0;          ///< SECOND_... of its second set of textures
    std::uint32_t own_surface = 0;     ///< number of a user's own surface; 0: none
    std::uint32_t lighting_model = 0;  ///< its number
    std::uint32_t layers = 0;          ///< LAYERS_... that it has
    std::uint32_t layers_row = 0;      ///< of the table of layers, from 1; 0: none yet
    std::array<std::uint32_t, LAYER_ROLE_WORDS> layer_roles{};  ///< of its textures of layers
    bool light_textures = false;       ///< some of them are shares that lighting reads
    std::uint32_t besides = 0;         ///< BESIDES_... of its surface
    std::vector<Binding> bindings;     ///< constants, then the texture slots
};

/// A scene on the device: geometry in one buffer, textures, material constants.
class GpuScene {
public:
    /// Throws Error when a material names a lighting model that does not exist.
    GpuScene(const Device& device, const Scene& scene, const std::vector<Texture>& textures,
             const Overlay& overlay = {});

    /// Gives the materials the values of a frame; those that it does not name are as loaded again.
    /// True when holes, and with them shadows, may have changed. The device must not be drawing.
    /// Throws Error for a material or property that is not there, or one that cannot change.
    bool set_materials(const std::vector<MaterialChange>& changes);

    /// Brings what moves to where it is at this moment of its clips and in this wind, for the frames that
    /// follow. True when anything may have moved. The device must not be drawing.
    bool pose(const Device& device, double time_s, const scene::Wind& wind = {});
    /// What users' own surfaces move, where it stands now; and all vertices that bend, of which those are some.
    const std::vector<OwnMover>& own_movers() const { return movers_; }
    std::span<const Vertex> bending() const { return bending_; }
    /// Moves those vertices: by number of a bending vertex. The device must not be drawing.
    void move_own(const Device& device, std::span<const MovedVertex> moved);
    /// Shapes the overlay of the frames that follow; empty: there is none in them. The device must not
    /// be drawing.
    void lay(const Device& device, const LaidOverlay& overlay);
    bool snow_lies() const { return snow_lies_; }
    /// Length over width of what its textures' samplers read at most (Device::texture_anisotropy).
    std::uint32_t texture_stretch() const { return texture_stretch_; }
    std::uint64_t lays() const { return lays_; }  ///< grows with each
    /// By the triangles of a draw, from where they need not be drawn (Covered); empty: from nowhere.
    std::span<const std::uint8_t> covered(const Draw& draw) const
    {
        return covered_[static_cast<std::size_t>(&draw - draws_.data())];
    }
    const SteepTriangles& steep() const { return steep_; }
    /// Shows of every thing the level of detail that this camera wants. `scale` makes things count as
    /// larger. True when what casts shadows has changed.
    bool choose_levels(const Camera& camera, float scale);
    /// Brings marched shapes to these moments; those behind the list, to rest. True when any has changed. Throws
    /// Error for a moment that cannot be.
    bool set_shapes(const std::vector<ShapeMoment>& moments);
    const std::vector<MarchedShape>& shapes() const { return shapes_; }  ///< `rest`: of the frame
    /// Something may be elsewhere at another moment.
    bool moves() const { return rig_ != nullptr || !waving_.empty(); }
    /// Constants of all draws, of those that one call may draw at once (gpu/passes/surface/surface_draws_io.h).
    GpuBuffer& draw_rows() const { return *draw_rows_; }
    /// Brings them to where things are. The device must not be drawing.
    void update_draw_rows(const Device& device);
    /// A pose moves its vertices, and not the whole of it alone.
    bool bends(const Draw& draw) const { return !draw.overlay && static_cast<std::size_t>(draw.vertex_offset) >= first_bending_; }
    /// Grows whenever something may have moved.
    std::uint64_t poses() const { return poses_; }

    const GpuBuffer& vertices() const { return *vertices_; }
    /// Of all vertices, by themselves: what asks for no more reads a fifth of the memory.
    const GpuBuffer& positions() const { return *positions_; }
    const GpuBuffer& indices() const { return *indices_; }
    /// Both buffers can be bound as texels: RGBA32UI, four a vertex, and R32UI.
    bool as_texels() const { return as_texels_; }
    GpuBuffer& vertex_texels() const { return *vertices_; }
    GpuBuffer& index_texels() const { return *indices_; }
    const std::vector<Draw>& draws() const { return draws_; }  ///< sorted by state
    const std::vector<Decal>& decals() const { return decals_; }  ///< lower ones first
    bool decals_refused() const { return decals_refused_; }  ///< some material takes none
    const std::vector<GpuMaterial>& materials() const { return materials_; }
    GpuBuffer& material_looks() const { return *looks_; }  ///< MATERIAL_LOOK_TEXELS each
    GpuBuffer& instance_looks() const { return *instance_looks_; }  ///< INSTANCE_LOOK_TEXELS each, from 1
    GpuBuffer& layers() const { return *layers_; }  ///< LAYERS_TEXELS each
    const std::vector<Light>& lights() const { return lights_; }
    const std::vector<Light>& glows() const { return glows_; }  ///< glowing surfaces as lights
    const Bounds& bounds() const { return bounds_; }
    bool emissive() const { return emissive_; }  ///< any material emits light
    /// Some light comes with the surface: of light maps, or of lamps at vertices.
    bool baked() const { return light_maps_ || vertex_lamps_; }
    bool light_maps() const { return light_maps_; }  ///< any material has one
    /// Some lamps light by vertex; never where the vertices cannot be read.
    bool vertex_lamps() const { return vertex_lamps_; }
    bool beads() const { return beads_; }  ///< on some of it a film stands in beads
    bool constant_weather() const { return constant_weather_; }  ///< any is wet or white by itself
    /// Lighting reads shares of layers a pixel: some material has textures of them.
    bool layer_shares() const { return layer_shares_; }
    /// Some body that light passes has a texture of its thickness.
    bool body_shares() const { return body_shares_; }
    /// Some material mixes two sets that water or light that passes treats differently.
    bool point_lamps() const { return point_lamps_; }  ///< some materials see lamps as points
    bool unshadowed() const { return unshadowed_; }  ///< some materials receive no shadows
    bool two_sets() const { return two_sets_; }
    const OwnSurfaces& own_surfaces() const { return own_surfaces_; }
    const LightingModels& lighting_models() const { return lighting_models_; }
    /// What the G-buffer has for a material that has layers of its own; 0: it has none.
    std::uint32_t layered_model(std::uint32_t material) const;

private:
    void upload_looks(const Device& device, const Scene& scene);
    bool pose_rig(double time_s);
    bool bend(const scene::Wind& wind, bool moved);
    void upload_bending(const Device& device);
    void upload_geometry(const Device& device, const Scene& scene, const Overlay& overlay);
    void upload_vertices(const Device& device, std::span<const Vertex> vertices, std::size_t first);
    void upload_textures(const Device& device, const std::vector<Texture>& textures);
    void make_materials(const Device& device, const Scene& scene);
    void set_material(std::size_t index, const Material& source);
    void sum_up_materials();
    static bool mirrors_as_glass(const GpuMaterial& material, const shared::MaterialConstants& c);
    std::uint32_t set_layers(GpuMaterial& material, const Material& source);
    const SamplerHandle& sampler(const Device& device, Wrap u, Wrap v, bool nearest);

    MemoryArena arena_;
    std::uint32_t texture_stretch_ = 1;
    std::unique_ptr<GpuBuffer> vertices_;
    std::unique_ptr<GpuBuffer> positions_;
    std::unique_ptr<GpuBuffer> indices_;
    std::unique_ptr<GpuBuffer> constants_;
    std::unique_ptr<GpuBuffer> looks_;
    std::unique_ptr<GpuBuffer> layers_;
    std::unique_ptr<GpuBuffer> instance_looks_;
    std::unique_ptr<GpuBuffer> draw_rows_;
    std::optional<std::uint64_t> rows_poses_;  // that they are of
    bool has_runs_ = false;                    // some draws are alike
    std::uint32_t layers_used_ = 0;
    std::uint32_t second_lobe_row_ = 0;  // of materials that have a second lobe alone; 0: none yet
    std::vector<std::unique_ptr<GpuImage>> images_;
    std::unique_ptr<GpuImage> white_;
    std::vector<const SamplerHandle*> image_samplers_;
    std::map<int, SamplerHandle> samplers_;
    std::vector<Draw> draws_;
    std::vector<Decal> decals_;
    std::vector<MarchedShape> shapes_;       // as they are in the frame
    std::vector<ShapeMoment> rest_shapes_;
    std::shared_ptr<const scene::Rig> rig_;  // null: nothing moves
    std::vector<MovingDraw> moving_;
    std::vector<WavingDraw> waving_;
    std::vector<OwnMover> movers_;
    scene::Wind wind_;  // that the vertices are bent in
    std::vector<Vertex> bending_;  // the last vertices of the buffer
    std::size_t first_bending_ = 0;
    std::size_t first_overlay_ = 0;
    std::size_t first_overlay_index_ = 0;
    std::uint64_t lays_ = 0;
    std::vector<std::uint32_t> overlay_parts_;  // numbers of the overlay's draws, in their order
    bool overlaid_ = false;
    bool snow_lies_ = false;
    std::vector<std::vector<std::uint8_t>> covered_;  // of each draw
    SteepTriangles steep_;
    std::vector<Light> rest_lights_;
    std::vector<GlowSource> rest_glow_sources_;
    Bounds rest_bounds_, posed_bounds_;  // the second without what own surfaces move
    std::optional<double> posed_s_;
    std::uint64_t poses_ = 0;
    std::vector<GpuMaterial> materials_;
    std::vector<Material> sources_;  // as loaded
    std::vector<Material> current_;  // with the changes of the frame
    std::vector<MaterialChange> changes_;
    std::vector<bool> loaded_;  // textures that have pixels
    std::vector<bool> wide_ground_;  // by material
    VkDeviceSize constants_stride_ = 0;
    std::vector<Light> lights_;
    std::vector<GlowSource> glow_sources_;
    std::vector<Light> glows_;
    LightingModels lighting_models_;
    OwnSurfaces own_surfaces_;
    Bounds bounds_;
    bool emissive_ = false;
    bool light_maps_ = false;
    bool vertex_lamps_ = false;
    bool decals_refused_ = false;
    bool constant_weather_ = false;
    bool beads_ = false;
    bool point_lamps_ = false;
    bool unshadowed_ = false;
    bool two_sets_ = false;
    bool layer_shares_ = false;
    bool body_shares_ = false;
    bool as_texels_ = false;
    bool levels_ = false;  // some thing has several levels of detail
};

}  // namespace petrichor::gpu

#endif
