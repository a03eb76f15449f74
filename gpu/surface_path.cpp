#include "gpu/surface_path.h"

namespace petrichor::gpu {

SurfacePath chosen_surface_path(SurfacePath asked, const Device& device, const GpuScene& scene,
                                int width, int height, bool adaptive)
{
    if (!device.primitive_ids() || !scene.as_texels()) return SurfacePath::Fragment;
    // Users' own surfaces, textures of layers and marched shapes are the resolve's alone.
    if (scene.own_surfaces().any() || scene.layer_shares() || !scene.shapes().empty()) return SurfacePath::Visibility;
    if (asked != SurfacePath::Auto) return asked;
    // The one GPU that was measured is faster so in every picture of the page, 1.3 to 2.2 times.
    if (device.info().kind != "cpu") return SurfacePath::Visibility;
    // Later samples leave out the pixels that are known only there: FlightHelmet 0.82, truck_town 0.62 of
    // the time of fragments.
    if (adaptive) return SurfacePath::Visibility;
    // From about a triangle for every 8 pixels on; set after seeing the scenes of the page.
    constexpr double kPixelsATriangle = 8.0;
    double triangles = 0.0;
    for (const Draw& draw : scene.draws()) triangles += draw.overlay ? 0.0 : draw.index_count / 3.0;
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    return triangles * kPixelsATriangle > pixels ? SurfacePath::Visibility : SurfacePath::Fragment;
}

}  // namespace petrichor::gpu
