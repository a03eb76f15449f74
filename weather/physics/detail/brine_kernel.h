// Salt on the ground: how much of the water stays liquid below 0 C, and the heat that it takes.
//
// Water and ice of a salted cell are in equilibrium: the brine is as strong as its temperature
// asks. Melting lowers the temperature, which stops it, so the two are found together:
//
//   slope (free - T) + Lf / dt (liquid - brine(T)) = 0
//
// falls with T all the way and has one root: where all is melted, where all is frozen, at the eutectic, or
// between them. There, times the salt's share in brine, it is a polynomial, and Newton's steps find the root.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_BRINE_KERNEL_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_BRINE_KERNEL_H

#include "weather/physics/brine.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/melting_kernel.h"
#include "weather/physics/detail/snow_kernel.h"

namespace petrichor::weather::detail {

constexpr int kBrineSteps = 4;
constexpr double kFirstShare_1_k = 0.0155;  // salt in brine over its depression, as it is at some 5 K

// Bodnar 1993, for a depression of 0 .. 21.2 K: salt in brine that is about to freeze, 0..0.233.
template <class Real>
PETRICHOR_INLINE Real brine_share_of(const Real& depression_k)
{
    const Real d = clamped(depression_k, Real(0.0), Real(kEutecticDepression_k));
    return (d * (d * (d * 0.000557 - 0.0442) + 1.78)) * 0.01;
}
// Water that `salt` keeps liquid, of `water` that is there, both kg/m2.
template <class Real>
PETRICHOR_INLINE Real brine_water_of(const Real& salt, const Real& water, const Real& temp_c)
{
    const Real share = brine_share_of(temp_c * -1.0);
    const Real held = salt * (1.0 - share) / larger(share, Real(1e-12));
    const Real below = select(temp_c < -kEutecticDepression_k, Real(0.0), smaller(held, water));
    return select(temp_c >= 0.0, water, below);
}

// A salted surface, or the base of a pack on salted ground.
template <class Real>
struct BrineStores {
    Real salt, liquid, water;  // kg/m2; water: liquid and ice
};
// Heat that goes into melting (> 0) or comes from freezing, W/m2.
//   free_c  the temperature without either
//   slope   W m-2 K-1 by which a warmer surface would lose more
template <class Real>
PETRICHOR_KERNEL Real brine_flux(const BrineStores<Real>& s, const Real& free_c, const Real& slope,
                                 double dt_s)
{
    // What is liquid through and through, or dry, has the temperature that it would have anyway.
    const Real freezing = s.liquid - brine_water_of(s.salt, s.water, free_c);
    const auto settled = (freezing >= 0.0) & (freezing <= 0.0);
    if (!any(select(settled, Real(0.0), Real(1.0)) > 0.5)) return 0.0;
    const double latent = kLatentFusion / dt_s;
    const Real per_slope = 1.0 / slope;
    const Real melted = free_c - (s.water - s.liquid) * per_slope * latent;
    const Real frozen = free_c + s.liquid * per_slope * latent;
    // Depressions d between which it lies; share(d) (slope (free + d) + (liquid + salt) Lf / dt) = salt Lf / dt.
    const Real zero = 0.0, eutectic = kEutecticDepression_k;
    const Real low = clamped(frozen * -1.0, zero, eutectic);
    const Real high = clamped(melted * -1.0, zero, eutectic);
    const Real constant = slope * free_c + (s.liquid + s.salt) * latent;
    const Real wanted = s.salt * latent;
    // The first guess takes share(d) for straight.
    const Real steep = wanted * slope * (4.0 / kFirstShare_1_k);
    const Real size = square_root(constant * constant + steep) + larger(constant, constant * -1.0);
    const Real guess = select(constant > 0.0, wanted * (2.0 / kFirstShare_1_k) / size, size * 0.5 * per_slope);
    Real d = clamped(guess, low, high);
    for (int i = 0; i < kBrineSteps; ++i) {
        const Real share = brine_share_of(d);
        const Real rise = (d * (d * 0.001671 - 0.0884) + 1.78) * 0.01;
        const Real other = slope * d + constant;
        const Real rest = share * other - wanted;
        d = clamped(d - rest / (rise * other + share * slope), low, high);
    }
    Real root_c = d * -1.0;
    const Real at_eutectic = slope * (free_c + eutectic) +
                             (s.liquid - brine_water_of(s.salt, s.water, Real(-kEutecticDepression_k))) * latent;
    root_c = select(at_eutectic < 0.0, Real(-kEutecticDepression_k), root_c);
    root_c = select(frozen < -kEutecticDepression_k, frozen, root_c);
    root_c = select(brine_water_of(s.salt, s.water, melted) >= s.water, melted, root_c);
    return select(settled, zero, slope * (free_c - root_c));
}

// As change_phase, for the cells of the mask: `root` moves to where brine and balance agree.
template <class Real, class Mask, class Wetness>
PETRICHOR_KERNEL void change_brine(const SurfacePoint<Real, Mask, Wetness>& p,
                                   const BrineStores<Real>& s, const Mask& salted, double dt_s,
                                   SurfaceRoot<Real, Wetness>& root, PhaseChange<Real>& change)
{
    const Real zero = 0.0;
    const Real vapour = larger(fluxes_at(p, root).vapour, zero) * dt_s;
    BrineStores<Real> left = s;  // what vapour does not take first
    left.water = larger(s.water - vapour, zero);
    left.liquid = smaller(s.liquid, left.water);
    const Real flux = brine_flux(left, root.surface_c, root.slope, dt_s);
    // Where nothing freezes or melts the root is found.
    const Mask moved = salted & ((flux > zero) | (flux < zero));
    if (!any(moved)) return;
    SurfaceRoot<Real, Wetness> held = root;
    held.surface_c = root.surface_c - flux / root.slope;
    for (int i = 0; i < 2; ++i) {
        follow(held.vapour, p, held.surface_c);
        const auto at = balance_with(p, humidity_at(held.vapour, held.surface_c), held.wet,
                                     held.surface_c, held.exchange);
        held.surface_c = held.surface_c + (at.balance - flux) / at.slope;
    }
    follow(held.vapour, p, held.surface_c);
    take(moved, held, root);
    change.melt_flux = select(moved, flux, change.melt_flux);
    change.melting = select(moved & (flux > zero), Real(1.0), change.melting);
}

// Salt under a pack eats it from below, with the heat of the ground; where brine is weaker than the
// base is cold, it freezes. Returns the water that leaves the pack, and moves the base's
// temperature by what that takes or gives.
template <class Real, class Mask>
PETRICHOR_KERNEL Real changed_by_salt(CellVars<Real>& c, const Mask& salted,
                                      const BrineStores<Real>& s, double conductance, double dt_s,
                                      Real& base_c)
{
    const Real zero = 0.0;
    Real flow = 0.0;
    const Real wanted = select(salted, brine_flux(s, base_c, Real(conductance), dt_s), zero) *
                        (dt_s / kLatentFusion);
    const Real frozen = smaller(c.film, larger(wanted * -1.0, zero));
    const Real below = smaller(c.film_ice, larger(wanted, zero));
    c.film += below - frozen;
    c.film_ice += frozen - below;
    Real melted = below;
    const Real rest = larger(wanted, zero) - below;
    if (any(rest > zero)) melted += melt_base(c, rest, flow);
    base_c += (frozen - melted) * (kLatentFusion / (conductance * dt_s));
    c.total_melt += melted;
    return flow;
}

// Salt leaves with the water that carries it, as strong as what stays.
template <class Real>
PETRICHOR_INLINE void carry_salt(CellVars<Real>& c, const Real& water_gone, double kept)
{
    const Real liquid = c.film + c.crack + c.puddle;
    const Real gone = larger(water_gone, Real(0.0));
    const Real share = select(gone > 0.0, liquid / larger(liquid + gone, Real(1e-12)), Real(1.0));
    Real left = c.salt * (share * kept);
    left = select(left < kNoSalt_kg_m2, Real(0.0), left);
    c.total_salt_lost += c.salt - left;
    c.salt = left;
}

}  // namespace petrichor::weather::detail

#endif
