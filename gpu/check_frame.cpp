#include "gpu/check_frame.h"

#include <vulkan/vulkan.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "gpu/passes/lamp_shadows/lamp_shadows.h"

namespace petrichor::gpu {

void check_frame(const Frame& frame, const VkPhysicalDeviceLimits& limits)
{
    const FrameSettings& s = frame.settings;
    const auto limit = static_cast<int>(limits.maxImageDimension2D);
    if (s.width < 1 || s.height < 1 || s.width > limit || s.height > limit) {
        throw Error("render: a picture of " + std::to_string(s.width) + " x " +
                        std::to_string(s.height) + " is not possible; sides of 1 to " +
                        std::to_string(limit) + " pixels are",
                    "Choose another --size.");
    }
    const auto pixels = static_cast<double>(s.width) * static_cast<double>(s.height);
    if (pixels * 16.0 > static_cast<double>(limits.maxStorageBufferRange)) {
        throw Error("render: a picture of " + std::to_string(s.width) + " x " +
                        std::to_string(s.height) + " needs more than the " +
                        std::to_string(limits.maxStorageBufferRange >> 20) +
                        " MiB that this device reads back at once",
                    "Choose a smaller --size.");
    }
    if (s.samples < 1 || s.samples > kMaxSamples) {
        throw Error("render: samples must be 1 to " + std::to_string(kMaxSamples) + ", got " +
                        std::to_string(s.samples),
                    "Choose another --samples.");
    }
    if (!(std::isfinite(frame.sky.sun_elevation_rad) && std::isfinite(frame.sky.sun_azimuth_rad))) {
        throw Error("render: the sun's direction is not a number", "Give finite angles.");
    }
    if (s.lamp_shadows < 0 || s.lamp_shadows > kMostLampShadows) {
        throw Error("render: shadows of 0 to " + std::to_string(kMostLampShadows) +
                        " lamps are possible, got " + std::to_string(s.lamp_shadows),
                    "Choose another lamp_shadows.");
    }
    if (s.transparent_layers < 0 || s.transparent_layers > 8) {
        throw Error("render: 0 to 8 transparent layers are possible, got " +
                        std::to_string(s.transparent_layers),
                    "Choose another transparent_layers.");
    }
    if (!(s.bloom >= 0.0f && s.bloom <= 1.0f)) {
        throw Error("render: bloom must be 0 to 1, got " + std::to_string(s.bloom),
                    "It is the share of the light that is scattered.");
    }
    if (!(s.wet_lens >= 0.0f && s.wet_lens <= 1.0f)) {
        throw Error("render: wet_lens must be 0 to 1, got " + std::to_string(s.wet_lens),
                    "It is how many drops the lens has while it rains.");
    }
    if (!frame.shutter.empty() && frame.shutter.size() != static_cast<std::size_t>(s.samples)) {
        throw Error("render: " + std::to_string(frame.shutter.size()) + " moments of the shutter for " +
                        std::to_string(s.samples) + " samples",
                    "Give one a sample, or none.");
    }
    const Camera& camera = frame.camera;
    if (frame.lens.radius_m != 0.0f &&
        !(frame.lens.radius_m > 0.0f && frame.lens.radius_m < 1e3f &&
          frame.lens.focus_m > camera.near_m && camera.orthographic_height_m <= 0.0f)) {
        throw Error("render: a lens of " + std::to_string(frame.lens.radius_m) + " m focused at " +
                        std::to_string(frame.lens.focus_m) + " m is not possible",
                    "Give a radius of 0 to 1000 m and a focus beyond the near distance; orthographic "
                    "cameras have no lens.");
    }
    const bool fov = camera.vertical_fov_rad > 0.0f && camera.vertical_fov_rad < 3.14159f;
    if (!(camera.orthographic_height_m > 0.0f) && !fov) {
        throw Error(
            "render: the camera's vertical field of view must be in (0, 180) degrees, got " +
                std::to_string(camera.vertical_fov_rad * 57.29578f),
            "Set another field of view.");
    }
    if (!(camera.near_m > 0.0f)) {
        throw Error("render: the camera's near distance must be above 0, got " +
                        std::to_string(camera.near_m),
                    "Set a near distance such as 0.05.");
    }
}

}  // namespace petrichor::gpu
