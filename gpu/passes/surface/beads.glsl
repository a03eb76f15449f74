// Water that stands in beads on a surface point, in place of a film.
#ifndef PETRICHOR_SURFACE_BEADS_GLSL
#define PETRICHOR_SURFACE_BEADS_GLSL

#include "formulas/light/water_film.h"
#include "formulas/weather/beads.h"
#include "gpu/passes/surface/cover.glsl"

// Water enough for a level surface of its own; not so much that it hides what it stands on.
const float kBeadWater = 0.6;

// Beads take the film's water; from afar, where a pixel holds many, it is a film again.
void stand_in_beads(inout Cover c, SurfaceInput at, float porosity)
{
    const float share = beading_share(material.beads, porosity) * (1.0 - smooth_edge(0.05, 0.3, c.water)) *
                        (1.0 - c.snow) * (1.0 - c.frost);
    float film = c.film;
#if defined(SURFACE_LAYER) && SURFACE_LAYER
    // Drops on the far side of a pane are seen as well.
    SurfaceInput behind = at;
    behind.normal = -at.normal;
    const LocalWeather there = local_weather(behind);
    // Of what drives against it little is enough.
    film = max(film, max(there.film, film_share(there.open)));
#endif
    const float pouring = saturate(2.0 * frame.weather.rain);
    const float wet = max(frame.weather.film_smoothness / kClosedFilm, pouring * step(1.0e-4, frame.weather.film_smoothness));
    const float amount = saturate(film * wet) * share;
    const float pixel_m = min(length(at.position_dx), length(at.position_dy));
    const Beads b = beads_on(at.position, at.normal, amount, pouring, pixel_m, frame.time_s);
    const float seen = bead_seen(kMiddleBead_m, pixel_m) * share;
    c.film *= 1.0 - seen * mix(0.8, 1.0, b.wiped);
    c.water = max(c.water, kBeadWater * b.cover);
    c.normal = normalize(mix(c.normal, bead_normal(b, at.normal), b.cover));
}

#endif
