#include "film/scenes/snow_scene.h"

#include <cstdio>

#include "film/scenes/transport.h"

namespace petrichor::film {

std::shared_ptr<const scene::SnowCaps> prepare_snow(const scene::Scene& scene,
                                                    const std::vector<glm::vec3>& eyes_m,
                                                    std::vector<std::string>& notes)
{
    std::vector<std::string> said;  // by the patches already
    const scene::Triangles triangles(scene, alpha_images(scene, said));
    const scene::Tracer tracer(triangles);
    scene::SnowCapOptions options;
    options.eyes_m = eyes_m;
    auto caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, options));
    if (caps->finest_m > 1.01f * options.finest_m) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "snow: rims of %.3g m would be more than %zu triangles; they are %.3g m",
                      static_cast<double>(options.finest_m), options.most_triangles,
                      static_cast<double>(caps->finest_m));
        notes.emplace_back(text);
    }
    return caps;
}

}  // namespace petrichor::film
