#include "weather/physics/surface_energy.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/detail/surface_kernel.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

namespace {

using Point = detail::SurfacePoint<double, bool, detail::FixedShare<double>>;

Point make_point(const SurfaceForcing& f, const SurfaceSkin& skin, const ExchangeParams& exchange)
{
    Point p{};
    const double wind = std::max(f.wind_m_s, exchange.min_wind_m_s);
    p.absorbed = (1.0 - skin.albedo) * f.shortwave_w_m2 + skin.emissivity * f.longwave_w_m2;
    p.emitting = skin.emissivity * kStefanBoltzmann;
    p.air_c = f.air_temp_k - kZeroCelsiusK;
    p.q_air =
        specific_humidity(vapour_pressure_pa(f.air_temp_k, f.rel_humidity_pct), f.pressure_pa);
    p.pressure = f.pressure_pa;
    p.exchange = air_density_kg_m3(f.air_temp_k, p.q_air, f.pressure_pa) *
                 neutral_exchange(skin.wind_height_m, skin.temp_height_m, skin.roughness_m) * wind;
    p.richardson_k =
        detail::richardson_per_k_of(1.0 / (f.air_temp_k * wind * wind), skin.wind_height_m) *
        skin.gravity_across;
    p.upright = 1.0 - std::abs(skin.gravity_across);
    p.convection =
        convection_coefficient(skin.wind_height_m, skin.roughness_m, 0.1 * skin.roughness_m);
    p.wet.beta = skin.wet_fraction;
    p.most_vapour = 1e30;
    p.icy = skin.icy;
    p.latent_heat = skin.icy ? kLatentSublimation : kLatentVaporisation;
    p.rain_heat = f.rain_kg_m2_s * (exchange.rain_heat * kWaterHeatCapacity);
    p.conductance = skin.conductance_w_m2_k;
    p.below_c = skin.below_temp_k - kZeroCelsiusK;
    return p;
}

SurfaceFluxes named(const detail::PointFluxes<double>& f, double surface_c)
{
    return {surface_c + kZeroCelsiusK,
            f.net_radiation,
            f.sensible,
            f.latent,
            f.vapour,
            f.ground,
            f.rain_heat,
            f.balance};
}

}  // namespace

SurfaceFluxes surface_balance(const SurfaceForcing& forcing, const SurfaceSkin& skin,
                              const ExchangeParams& exchange, double surface_temp_k)
{
    const Point p = make_point(forcing, skin, exchange);
    const double surface_c = surface_temp_k - kZeroCelsiusK;
    const double exchanged = detail::exchange_at(p, exchange, surface_c);
    detail::SurfaceVapour<double> vapour{};
    detail::centre_vapour(vapour, p, surface_c);
    const auto humidity = detail::humidity_at_middle(vapour);
    detail::WetLine<detail::FixedShare<double>, double> wet{};
    detail::lay_wet_line(p, humidity, exchanged, wet);
    return named(detail::fluxes_with(p, humidity, wet, surface_c, exchanged), surface_c);
}

SurfaceFluxes solve_surface(const SurfaceForcing& forcing, const SurfaceSkin& skin,
                            const ExchangeParams& exchange, double first_guess_k)
{
    const Point p = make_point(forcing, skin, exchange);
    detail::SurfaceRoot<double, detail::FixedShare<double>> root{};
    detail::surface_root(p, exchange, first_guess_k - kZeroCelsiusK, root);
    return named(detail::fluxes_at(p, root), root.surface_c);
}

}  // namespace petrichor::weather
