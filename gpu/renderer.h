#ifndef PETRICHOR_GPU_RENDERER_H
#define PETRICHOR_GPU_RENDERER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gpu/scene.h"

namespace petrichor::gpu {

/// One Vulkan device of this machine, as `petrichor doctor` lists it.
struct DeviceInfo {
    std::string name;
    std::string driver;
    std::string kind;         ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;  ///< "1.3.230"
    bool usable = false;
    std::string why_not;  ///< what is missing, when not usable
};

/// All Vulkan devices, best first. Empty when there is no loader or no driver; never throws for
/// that.
std::vector<DeviceInfo> list_devices();

enum class TexelFormat {
    Rgba8Srgb,   ///< colour, sRGB-encoded bytes
    Rgba8Unorm,  ///< data
    Rg8Unorm,    ///< two-channel data
    R8Unorm,     ///< one-channel data
    Rgba16Float,
};

/// A texture ready for upload: mips[0] is width x height, each next level floor(half), at least 1.
struct Texture {
    std::string name;
    TexelFormat format = TexelFormat::Rgba8Unorm;
    int width = 0;
    int height = 0;
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    bool nearest = false;
    std::vector<std::vector<std::byte>> mips;
};

/// A lat-long HDR environment: linear RGB radiance, row 0 = straight up, column 0 = -x... The image
/// centre looks along -z; u grows to the right (+x).
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  ///< width * height * 3
};

/// Light from the sky. With an environment map the map lights the scene (scaled), else an analytic
/// sky does: clear air by single scattering, clouds over it.
struct Sky {
    float sun_elevation_rad = 0.7f;  ///< -pi/2 .. pi/2
    float sun_azimuth_rad = 0.6f;    ///< from -z (north) clockwise towards +x (east)
    float sun_illuminance =
        100000.0f;                   ///< lux, on a plane facing the sun above the atmosphere's haze
    float cloud_cover = 0.0f;        ///< 0 clear .. 1 overcast
    float turbidity = 2.5f;          ///< 1.5 very clear .. 10 hazy
    float ground_albedo = 0.2f;      ///< of the land beyond the scene
    float environment_scale = 1.0f;  ///< multiplies the environment map
    float environment_rotation_rad = 0.0f;
    bool analytic_sun = true;  ///< false: the scene's own directional lights replace the sun
};

/// The weather of one frame in the 0..1 terms of the renderer (Lux 2.02 "published values").
struct SurfaceWeather {
    float rain = 0.0f;             ///< intensity r
    float snowfall = 0.0f;         ///< intensity f
    float flood_cracks = 0.0f;     ///< c
    float flood_puddles = 0.0f;    ///< p
    float film_albedo = 0.0f;      ///< m ka (1 - W)
    float film_smoothness = 0.0f;  ///< m ks (1 - W)
    float snow_amount = 0.0f;      ///< s W
    float water_to_snow = 0.0f;    ///< W
    float freeze_exp = 0.0f;       ///< 1 - 2^(-10 W)
    float melt = 0.0f;             ///< 1 - C(W)
    float melt_exp = 0.0f;         ///< 1 - 2^(-10 melt)
    float snow_start_height_m = -100.0f;
    float snow_height_blend_m = 10.0f;
    float frost = 0.0f;  ///< hoar frost on cold, dry, exposed surfaces, 0..1
    glm::vec3 snow_color{0.92f, 0.94f, 0.97f};
    glm::vec2 wind_m_s{0.0f};       ///< where the air goes, x and z
    float visibility_m = 20000.0f;  ///< 2 % contrast; > 0
};

/// How a frame is taken.
struct FrameSettings {
    int width = 640;
    int height = 360;
    int samples = 8;         ///< jittered samples a pixel, 1..256
    double time_s = 0.0;     ///< drives ripples and flow
    std::uint32_t seed = 1;  ///< jitter
    float exposure = 0.0f;   ///< > 0: linear scale; 0: metered from sun and sky, statelessly
    float exposure_bias_stops = 0.0f;
    bool shadows = true;
    bool ambient_occlusion = true;
    bool image_based_light = true;
    bool draw_sky = true;
    bool tone_map = true;     ///< false: PNG bytes are plain sRGB of the exposed colour
    bool shelter = true;      ///< roofs keep rain and snow off
    bool all_lights = false;  ///< every pixel asks every light: slow, for checking light lists
    std::vector<std::string> aovs;  ///< names from aov_table()
};

struct Frame {
    Camera camera;
    Sky sky;
    SurfaceWeather weather;
    std::vector<Light> extra_lights;  ///< added to the scene's own (a lamp lit at dusk)
    float scene_light_scale = 1.0f;   ///< multiplies point and spot lights of the scene
    float emissive_scale = 1.0f;      ///< multiplies emission of materials
    FrameSettings settings;
};

/// One output of the renderer besides the beauty. Labels come from the pixel-centre sample.
struct AovInfo {
    std::string name;      ///< as in --aov
    std::string channels;  ///< EXR channel suffixes, "XYZ"
    std::string meaning;   ///< with the unit
};
const std::vector<AovInfo>& aov_table();

struct AovImage {
    std::string name;
    int channels = 0;
    std::vector<float> pixels;  ///< width * height * channels
};

struct PassTime {
    std::string name;
    double milliseconds = 0.0;  ///< of the device, all samples of the frame together
};

struct RenderResult {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> beauty;  ///< RGBA half bits, linear, unexposed (scene-referred)
    std::vector<std::uint8_t> display;  ///< RGBA8 sRGB, exposed and tone mapped
    float exposure = 1.0f;              ///< the scale that display used
    std::vector<AovImage> aovs;
    std::vector<PassTime> passes;
    std::uint32_t light_list_overflows = 0;  ///< tiles that saw more lights than a list holds
};

struct RendererOptions {
    std::string device;       ///< part of a device name or an index; empty: best GPU, else CPU
    bool validation = false;  ///< load the validation layer and collect its messages
};

/// Renders frames of one scene. Movable, not copyable; not thread-safe. Same input, same bytes.
class Renderer {
public:
    /// Throws Error when no device fits, naming what was found and what is needed.
    explicit Renderer(const RendererOptions& options);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Uploads the scene. `textures[i]` belongs to scene.textures[i] (empty mips: white).
    /// Replaces what was loaded before.
    void load(const Scene& scene, const std::vector<Texture>& textures);

    /// Lights the scene from an HDR environment; an empty map returns to the analytic sky.
    void set_environment(const EnvironmentMap& environment);

    RenderResult render(const Frame& frame);

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
