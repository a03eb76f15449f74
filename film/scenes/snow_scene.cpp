#include "film/scenes/snow_scene.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "film/data/source_fingerprint.h"
#include "film/scenes/transport.h"
#include "scene/snow/snow_caps_file.h"

namespace petrichor::film {
namespace {

constexpr const char* kKind = "snow_caps";

std::string key_of(const scene::Scene& scene, const scene::Triangles& triangles,
                   const scene::SnowCapOptions& options, const gpu::TrackMap& tracks)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(scene::snow_caps_fingerprint(what_rays_see(scene, triangles), scene, options));
    for (const int v : {tracks.width, tracks.height}) hasher.add(v);
    if (tracks.over_time) hasher.add("over time");
    for (const float v : {tracks.corner_m.x, tracks.corner_m.y, tracks.texel_m, tracks.low_m, tracks.high_m})
        hasher.add(v);
    hasher.add_bytes(std::as_bytes(std::span(tracks.rgba)));
    return hasher.text();
}

}  // namespace

std::shared_ptr<const scene::SnowCaps> prepare_snow(const scene::Scene& scene,
                                                    const std::vector<glm::vec3>& eyes_m,
                                                    const gpu::TrackMap& tracks,
                                                    const ContentCache& cache, const StopRequest& stop,
                                                    std::vector<std::string>& notes)
{
    scene::SnowCapOptions options;
    options.eyes_m = eyes_m;
    options.stop = stop;
    if (tracks.width > 0)
        options.pressed = [&tracks](const glm::vec3& at) { return gpu::pressed_at(tracks, at); };
    options.presses = !tracks.over_time;
    std::string key;
    std::optional<scene::SnowCaps> found;
    const scene::Triangles plain(scene, {});
    if (cache.on()) {
        key = key_of(scene, plain, options, tracks);
        if (const auto bytes = cache.find(kKind, key)) found = scene::snow_caps_from_bytes(*bytes, scene);
    }
    if (!found) {
        std::vector<std::string> said;  // by the patches already
        const auto alphas = alpha_images(scene, said);
        const bool holes = std::any_of(alphas.begin(), alphas.end(),
                                       [](const auto& image) { return !image.alpha.empty(); });
        const std::optional<scene::Triangles> cut =
            holes ? std::optional<scene::Triangles>(std::in_place, scene, alphas) : std::nullopt;
        const scene::Tracer tracer(cut ? *cut : plain);
        found = scene::build_snow_caps(tracer, options);
        if (cache.on()) {
            try {
                const std::vector<std::byte> bytes = scene::snow_caps_to_bytes(*found);
                cache.keep(kKind, key, {bytes});
            } catch (const Error& error) {
                notes.push_back(std::string(error.what()) + ": snow is shaped again at every start. " +
                                error.fix());
            }
        }
    }
    auto caps = std::make_shared<const scene::SnowCaps>(std::move(*found));
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
