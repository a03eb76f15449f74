#include "film/weather/film_by_name.h"

#include "film/weather/patch_sites.h"

namespace petrichor::film {
namespace {

constexpr float kFilmOnBlades = 0.35f;
constexpr float kClearGlass = 0.3f;      // rougher blended surfaces are leaves, smoke, cloth
constexpr float kSeenFromNear_m = 3.0f;  // a helmet, a chair, a motorcycle

}  // namespace

void set_films_by_name(scene::Scene& scene)
{
    const weather::Surface otherwise;
    for (scene::Material& m : scene.materials) {
        if (m.weather.film >= 0.0f) continue;
        const bool lawn = surface_of_material(m, otherwise).name == "lawn";
        m.weather.film = lawn ? kFilmOnBlades : 1.0f;
    }
}

void set_beads(scene::Scene& scene, float size_m)
{
    for (scene::Material& m : scene.materials) {
        if (m.weather.beads >= 0.0f) continue;
        const bool clear = m.transmission > 0.0f ||
                           (m.alpha_mode == scene::AlphaMode::Blend && m.roughness <= kClearGlass);
        m.weather.beads = clear || m.clearcoat > 0.0f || size_m <= kSeenFromNear_m ? 1.0f : 0.0f;
    }
}

}  // namespace petrichor::film
