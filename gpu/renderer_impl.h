// What a renderer holds, for the files that share it: renderer.cpp (the front door), prepare_lights.cpp, prepare_targets.cpp,
// render_frame.cpp.
#ifndef PETRICHOR_GPU_RENDERER_IMPL_H
#define PETRICHOR_GPU_RENDERER_IMPL_H

#include <memory>
#include <string>
#include <vector>

#include "gpu/build_frame.h"
#include "gpu/check_frame.h"
#include "gpu/icicles/icicle_body.h"
#include "gpu/passes/own_moves/own_moves.h"
#include "gpu/renderer.h"
#include "gpu/snow/frame_tracks.h"
#include "gpu/snow/snow_body.h"

namespace petrichor::gpu {

// Images of one frame size; they die before their memory.
struct TargetSet {
    explicit TargetSet(const Device& device) : arena(std::make_unique<MemoryArena>(device)) {}
    std::unique_ptr<MemoryArena> arena;
    FrameTargets targets;
    int words = 0;
    std::unique_ptr<MemoryArena> resolve_arena;
    ResolveTables resolve;
    std::unique_ptr<MemoryArena> transparent_arena;
    TransparentTargets transparent;
    int transparent_words = 0;
    std::unique_ptr<MemoryArena> decal_arena;
    DecalTargets decals;
    std::unique_ptr<MemoryArena> parts_arena;
    LightParts parts;
    int parts_width = 0, parts_height = 0;
    std::unique_ptr<MemoryArena> adaptive_arena;
    AdaptiveTargets adaptive;
};

struct Renderer::Impl {
    Impl(const RendererOptions& options, const WeatherMaps& weather_maps);

    // exposure: as of least_lux().
    LightFacts prepare_lights(const Frame& frame, const Frame& whole, const Sun& by_day, const Light* sun, float exposure);

    // The linear scale of the frame's display; behind the sky's passes, where it is by the light that falls in.
    float exposure_of(const Frame& frame) const;

    void prepare_targets(TargetSet& set, const FrameSettings& s,
                         const std::vector<AovGroup>& aov_groups);

    // Snow and icicles as they are in the frame.
    void lay_over(const Frame& frame);

    // True when surfaces of users' own have moved something.
    bool move_own(const Frame& frame, double time_s, bool posed);

    // True when this frame resolves a visibility buffer; its tables are then made for its size.
    bool prepare_resolve(TargetSet& set, const Frame& frame, const FrameSettings& whole);

    // True when this frame blends what lets light through in layers.
    bool prepare_transparent(TargetSet& set, const FrameSettings& s);

    // True when the scene has decals; their targets are then made for the frame's size.
    bool prepare_decals(TargetSet& set, const FrameSettings& s);

    void prepare_parts(TargetSet& set, const FrameSettings& s, const std::vector<std::size_t>& rows,
                       bool layered, bool adaptive);

    // True when later samples go by what the first two saw; the targets are then made for the frame's size.
    bool prepare_adaptive(TargetSet& set, const Frame& frame);

    /// `whole`: of the picture that the frame is a window of; else the frame itself.
    /// around: beyond the window; kept: where this frame is kept as one.
    RenderResult render(const Frame& frame, const Frame& whole, TargetSet& set, PictureAround* around = nullptr,
                        PictureAround* kept = nullptr);

    Device device;
    PipelineCache pipelines;
    DescriptorArena descriptors;
    MemoryArena shared_arena;
    std::unique_ptr<GpuBuffer> constants;
    VkDeviceSize constants_stride = 0;
    SurfaceMaps surface_maps;
    DepthMaps depth_maps;
    LightTables light_tables;
    LampShadows lamp_shadows;
    SkyMaps sky;
    LampGlow lamp_glow;
    FallingTable falling;
    std::shared_ptr<const std::vector<scene::DripPoint>> drips;
    FallingTable splashes;
    PatchLights patches;
    ProbeTable probes;
    TargetSet pictures;  ///< of the frames that are asked for
    TargetSet metering;  ///< of the small ones that tell their exposure
    bool metering_ended = false;  ///< before the next picture
    GpuPlace place;
    SeenTriangles triangles;
    VertexLight vertex_light;
    std::unique_ptr<MemoryArena> light_arena;
    LightTable light_table;
    std::unique_ptr<MemoryArena> environment_arena;
    std::unique_ptr<GpuImage> environment;
    std::unique_ptr<GpuScene> scene;
    std::unique_ptr<OwnMoves> own_moves;  // null: nothing is moved by them
    std::unique_ptr<SnowBody> snow;
    std::unique_ptr<IcicleBody> icicles;
    std::vector<scene::DripPoint> tips;  // where icicles drip, in place of `drips`
    FrameTracks tracks;
    std::uint32_t falls_before = 0;
    bool own_lighting = false;
    std::string graph_text;
};

}  // namespace petrichor::gpu

#endif
