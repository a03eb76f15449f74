#include "texproc/prefilter/detail/codes.h"

#include <algorithm>
#include <cmath>

namespace petrichor::texproc::detail {

namespace {

float top(const StoredAs& as)
{
    return static_cast<float>((1 << as.bits) - 1);
}

float rounded(float v, const StoredAs& as)
{
    if (as.bits == 0) return v;
    return std::floor(std::clamp(v, 0.0f, 1.0f) * top(as) + 0.5f) / top(as);
}

float stored(float alpha2, const StoredAs& as)
{
    float p = std::sqrt(std::sqrt(std::clamp(alpha2, 0.0f, 1.0f)));
    if (as.alpha) p *= p;
    return as.smoothness ? 1.0f - p : p;
}

// |a x b|^2 of unit vectors: how far apart two directions are.
float apart(const Direction& a, const Direction& b)
{
    const Direction d{a.x - b.x, a.y - b.y, a.z - b.z};
    return dot(d, d);
}

struct Aim {
    Codes codes;
    float off = 4.0f;
};
constexpr std::size_t kAims = 8;

// Steps of roughness from the rounded code: a lobe that cannot be aimed is better wide enough to
// reach where it should be, for the narrowest twice as wide and more.
constexpr std::array<int, 10> kSteps{-1, 0, 1, 2, 3, 4, 6, 8, 11, 15};

// The nearest storable directions: for every length that keeps z a code, x and y rounded.
std::array<Aim, kAims> nearest(const Direction& normal, const StoredAs& as)
{
    std::array<Aim, kAims> best;
    const auto offer = [&](const Direction& vector) {
        Aim aim{rounded(vector, 1.0f, as), 0.0f};
        aim.off = apart(read_normal(aim.codes, as), normal);
        for (Aim& place : best) {
            if (aim.codes.normal == place.codes.normal) return;
            if (aim.off < place.off) std::swap(aim, place);
        }
    };
    const float levels = top(as);
    const float z_code = std::floor((0.5f + 0.5f * normal.z) * levels + 0.5f);
    for (int down = 0; down <= 32; ++down) {
        const float z = 2.0f * (z_code - static_cast<float>(down)) / levels - 1.0f;
        const float length = z / normal.z;
        if (as.rebuild_z || !(length > kShortestNormal)) break;
        offer({normal.x * length, normal.y * length, z});
    }
    // Neighbours of the rounded codes too: all that is left where z is rebuilt.
    const float step = 2.0f / levels;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            offer({normal.x + step * static_cast<float>(i), normal.y + step * static_cast<float>(j),
                   normal.z});
        }
    }
    return best;
}

}  // namespace

Codes rounded(const Direction& n, float alpha2, const StoredAs& as)
{
    const float y = as.green_down ? -n.y : n.y;
    return {{rounded(0.5f + 0.5f * n.x, as), rounded(0.5f + 0.5f * y, as),
             rounded(0.5f + 0.5f * n.z, as)},
            rounded(stored(alpha2, as), as)};
}

Direction read_normal(const Codes& codes, const StoredAs& as)
{
    const auto& c = codes.normal;
    Direction n{2.0f * c[0] - 1.0f, 2.0f * c[1] - 1.0f, 2.0f * c[2] - 1.0f};
    if (as.green_down) n.y = -n.y;
    if (as.rebuild_z) n.z = std::sqrt(std::max(0.0f, 1.0f - n.x * n.x - n.y * n.y));
    return normalized(n);
}

float read_alpha2(const Codes& codes, const StoredAs& as)
{
    float p = as.smoothness ? 1.0f - codes.rough : codes.rough;
    if (as.alpha) p = std::sqrt(p);
    return (p * p) * (p * p);
}

bool coarse_codes(float lit_alpha2, const StoredAs& as)
{
    // A direction is off by up to 0.7 steps of 2 / 255; alpha 0.15 is 25 times that.
    return as.bits == 8 && lit_alpha2 < 0.15f * 0.15f;
}

Codes cheapest_codes(const LobeCost& cost, const Direction& normal, float alpha2,
                     const Codes& plain, float light2, const StoredAs& as)
{
    Codes best = plain;
    const auto lit = [&](const Codes& c) {
        return std::clamp(read_alpha2(c, as) + light2, kMinAlpha2, 1.0f);
    };
    float least = cost(read_normal(plain, as), lit(plain));
    const float towards_rough = (as.smoothness ? -1.0f : 1.0f) / top(as);
    for (const Aim& aim : nearest(normal, as)) {
        if (aim.off >= 4.0f) continue;
        std::array<Codes, kSteps.size()> tried;
        std::array<float, kSteps.size()> alpha2s, costs;
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
            tried[k] = aim.codes;
            tried[k].rough = rounded(
                rounded(stored(alpha2, as), as) + towards_rough * static_cast<float>(kSteps[k]),
                as);
            alpha2s[k] = lit(tried[k]);
        }
        cost(read_normal(aim.codes, as), alpha2s.data(), static_cast<int>(kSteps.size()),
             costs.data());
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
            if (costs[k] < least - 1e-4f) {
                least = costs[k];
                best = tried[k];
            }
        }
    }
    return best;
}

}  // namespace petrichor::texproc::detail
