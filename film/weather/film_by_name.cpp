#include "film/weather/film_by_name.h"

#include "film/weather/patch_sites.h"

namespace petrichor::film {
namespace {

constexpr float kFilmOnBlades = 0.35f;

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

}  // namespace petrichor::film
