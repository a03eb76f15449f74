#ifndef PETRICHOR_CLI_BENCH_RENDER_BENCH_H
#define PETRICHOR_CLI_BENCH_RENDER_BENCH_H

#include <string>
#include "gpu/frame/frame.h"

namespace petrichor::cli {

/// What `petrichor bench --scene` times: one frame, again and again.
struct RenderBenchOptions {
    std::string scene;
    std::string size = "1280x720";
    std::string camera;
    std::string device;
    std::string picture;
    int repeat = 5;
    int samples = 1;
    int threads = 0;
    bool json = false;
    gpu::SurfacePath surface_path = gpu::SurfacePath::Auto;
    bool shadows = false;
    bool ambient_occlusion = false;
    bool image_based_light = false;
    bool sky = false;
    bool rain = false;
};
/// Renders and prints the report. Throws Error for what the user can mend.
void run_render_bench(const RenderBenchOptions& options);

}  // namespace petrichor::cli

#endif
