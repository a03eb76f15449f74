#ifndef PETRICHOR_GPU_RENDERER_H
#define PETRICHOR_GPU_RENDERER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device/device_info.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/metering.h"
#include "gpu/frame/patch_scene.h"
#include "gpu/frame/picture_tile.h"
#include "gpu/frame/weather_maps.h"
#include "gpu/outputs/aov_table.h"
#include "gpu/upload/texture.h"

namespace petrichor::scene {
struct SnowCaps;
struct DripPoint;
struct Icicles;
}

namespace petrichor::gpu {

struct AovImage {
    std::string name;
    int channels = 0;
    std::vector<float> pixels;  ///< width * height * channels
};

struct RenderResult {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> beauty;  ///< RGBA half bits, linear, unexposed (scene-referred)
    std::vector<std::uint8_t> display;  ///< RGBA8 sRGB, exposed and tone mapped; empty with exposed_light
    /// With FrameSettings::exposed_light: RGBA half bits, linear, as the lens shows it (glare, drops), white balanced and
    /// exposed, at most 65504; alpha 1.
    std::vector<std::uint16_t> exposed;
    float exposure = 1.0f;              ///< the scale that display used
    std::vector<AovImage> aovs;
    FallingFacts falling;
    LightFacts light;
    std::vector<PassTime> passes;
    double patch_light_cpu_ms = 0.0;  ///< CPU time of solving the light between surfaces; 0 where it was as before
};

struct PictureAround;  // gpu/passes/reflections/picture_around.h

/// Renders frames of one scene. Movable, not copyable; not thread-safe. Same input, same bytes.
class Renderer {
public:
    /// Throws Error when no device fits, naming what was found and what is needed.
    /// `weather_maps`: those that are given are used instead of drawn ones.
    explicit Renderer(const RendererOptions& options, const WeatherMaps& weather_maps = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Uploads the scene. `textures[i]` belongs to scene.textures[i] (empty mips: white).
    /// Replaces what was loaded before. With `snow` what lies deep has a body in frames that want it,
    /// with `icicles` what hangs from edges.
    void load(const Scene& scene, const std::vector<Texture>& textures,
              std::shared_ptr<const scene::SnowCaps> snow = nullptr, std::shared_ptr<const scene::Icicles> icicles = nullptr);

    /// Lights the scene from an HDR environment; an empty map returns to the analytic sky.
    void set_environment(const EnvironmentMap& environment);

    /// Light between the surfaces of the loaded scene goes by these patches from now on (and the
    /// switch of each frame); null, and load(): by none.
    void set_patches(std::shared_ptr<const PatchScene> patches);

    /// Where drops come off edges in frames that are wet (scene/drips); null, and load(): nowhere.
    void set_drips(std::shared_ptr<const std::vector<scene::DripPoint>> drips);

    /// Tracks that come to be while a film goes on, in place of those of the weather's maps, which have all of theirs
    /// over it (TrackMap::over_time). Not empty.
    void set_tracks(std::shared_ptr<const TrackSource> source);

    RenderResult render(const Frame& frame);

    /// A small picture of the frame, which mirrors in its windows see beyond them; null where nothing mirrors the picture.
    std::shared_ptr<PictureAround> look_around(const Frame& frame);

    /// A window of the frame's picture, as large as the tile. Where nothing reaches it from beyond the window its pixels
    /// are the picture's to rounding: glare and drops on the lens reach far. Mirrors see `around` there, of the same frame;
    /// null: nothing. What falls and what lights is told of the whole picture. The tile begins at multiples of kTileStep.
    RenderResult render(const Frame& frame, const PictureTile& tile, const std::shared_ptr<PictureAround>& around = nullptr);

    /// Meters what the frame shows: renders it small, without a sample pattern (gpu/frame/metering.h). A function
    /// of the frame alone, as render() is. `exposure` and `aovs` of the frame do not count.
    MeterReading meter(const Frame& frame, MeterOf what = MeterOf::Exposure);

    /// No more frames are metered. What only they needed, most of all pipelines, is given up: 4 MiB each on a CPU.
    void end_metering();

    const DeviceInfo& device() const;
    /// Messages of the validation layer since construction (severity warning and above).
    const std::vector<std::string>& validation_messages() const;
    /// One line a pass of the last frame: its name and what it reads and writes.
    std::string describe_graph() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::gpu

#endif
