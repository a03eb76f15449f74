#ifndef PETRICHOR_CLI_BENCH_RENDER_BENCH_H
#define PETRICHOR_CLI_BENCH_RENDER_BENCH_H

#include <string>
#include "gpu/frame/frame.h"

namespace petrichor::cli {

/// What `petrichor bench` times: a frame of a scenario, or a plain one of a scene, again and again.
struct RenderBenchOptions {
    std::string scenario;  ///< .toml, scene, preset; its own weather, sky, size and samples
    int frame = 0;         ///< of the scenario
    std::string variant, view;
    std::string scene;  ///< instead: a scene with nothing that is not asked for
    std::string size;   ///< "": the scenario's, or 1280x720
    std::string camera;
    std::string device;
    std::string picture;
    int repeat = 5;
    int samples = 0;  ///< 0: the scenario's, or 1
    int threads = 0;
    bool json = false;
    bool apart = false;  ///< waits for each pass and tells its CPU time
    gpu::SurfacePath surface_path = gpu::SurfacePath::Auto;
    bool relight = false;  ///< the light between surfaces is solved in each frame
    bool film = false;     ///< each timed frame follows another one, untimed, and pays for what is not the same
    bool shadows = false;
    bool ambient_occlusion = false;
    bool image_based_light = false;
    bool sky = false;
    bool rain = false;
    bool compare = false;       ///< with other renderers, where they are installed
    std::string peers = ".";    ///< the folder whose node_modules they are in
    std::string peer_pictures;  ///< where their pictures are kept; "": nowhere
    int peer_limit_s = 300;
};
/// Renders and prints the report. Throws Error for what the user can mend.
void run_render_bench(const RenderBenchOptions& options);

}  // namespace petrichor::cli

#endif
