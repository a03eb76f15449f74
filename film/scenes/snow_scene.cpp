#include "film/scenes/snow_scene.h"

#include <cstdio>

#include "film/scenes/transport.h"

namespace petrichor::film {
namespace {

// As trodden_at() of gpu/passes/surface/tracks.glsl, of the nearest texel.
float pressed_at(const gpu::TrackMap& tracks, const glm::vec3& at)
{
    if (!(at.y >= tracks.low_m && at.y <= tracks.high_m)) return 0.0f;
    const glm::vec2 texel = (glm::vec2(at.x, at.z) - tracks.corner_m) / tracks.texel_m;
    if (!(texel.x >= 0.0f && texel.y >= 0.0f && texel.x < static_cast<float>(tracks.width) &&
          texel.y < static_cast<float>(tracks.height)))
        return 0.0f;
    const std::size_t index = static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(tracks.width) +
                              static_cast<std::size_t>(texel.x);
    return static_cast<float>(tracks.rgba[4 * index]) / 255.0f;
}

}  // namespace

std::shared_ptr<const scene::SnowCaps> prepare_snow(const scene::Scene& scene,
                                                    const std::vector<glm::vec3>& eyes_m,
                                                    const gpu::TrackMap& tracks,
                                                    std::vector<std::string>& notes)
{
    std::vector<std::string> said;  // by the patches already
    const scene::Triangles triangles(scene, alpha_images(scene, said));
    const scene::Tracer tracer(triangles);
    scene::SnowCapOptions options;
    options.eyes_m = eyes_m;
    if (tracks.width > 0)
        options.pressed = [&tracks](const glm::vec3& at) { return pressed_at(tracks, at); };
    auto caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, options));
    if (caps->finest_m > 1.01f * options.finest_m) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "snow: rims of %.3g m would be more than %zu triangles; they are %.3g m",
                      static_cast<double>(options.finest_m), options.most_triangles,
                      static_cast<double>(caps->finest_m));
        notes.emplace_back(text);
    }
    if (!caps->empty())
        notes.push_back("snow has a body of " + std::to_string(caps->indices.size() / 3) + " triangles");
    return caps;
}

}  // namespace petrichor::film
