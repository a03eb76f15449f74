#include "texproc/study/fresh_maps.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "texproc/study/detail/made_surface.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

// Numbers of one surface of one set.
struct Dice {
    std::uint32_t seed, which;
    float operator()(std::uint32_t number, float low, float high) const
    {
        return low + (high - low) * Place{seed, which}.uniform(1000 + number);
    }
    int whole(std::uint32_t number, int low, int high) const
    {
        return static_cast<int>(
            (*this)(number, static_cast<float>(low), static_cast<float>(high) + 0.999f));
    }
    // A place of this surface: other seeds hold other numbers.
    Place at(int x, int y) const
    {
        return {static_cast<std::uint32_t>(x) + 7919u * seed,
                static_cast<std::uint32_t>(y) + 104729u * which};
    }
};

float smooth(float t)
{
    return t * t * (3.0f - 2.0f * t);
}

// Value noise with its slopes, of about unit height and cells of `cell` texels.
struct Wave {
    float height, slope_x, slope_y;
};
Wave noise(const Dice& dice, float x, float y, float cell, std::uint32_t which)
{
    const float u = x / cell, v = y / cell;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const float fu = u - std::floor(u), fv = v - std::floor(v);
    const auto corner = [&](int di, int dj) { return dice.at(i + di, j + dj).uniform(which); };
    const float a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
    const float su = smooth(fu), sv = smooth(fv);
    const float across = (b - a) * (1.0f - sv) + (d - c) * sv;
    const float up = (c - a) * (1.0f - su) + (d - b) * su;
    const auto slope = [&](float f) { return 6.0f * f * (1.0f - f) / cell; };
    return {(a + (b - a) * su) * (1.0f - sv) + (c + (d - c) * su) * sv, across * slope(fu),
            up * slope(fv)};
}

// The nearest of points strewn one to a cell: domes, stones, rivets.
struct Nearest {
    float dx, dy, distance;
    Place who;
};
Nearest nearest(const Dice& dice, int x, int y, int cell, float jitter)
{
    Nearest best{0, 0, 1e9f, {0, 0}};
    for (int j = y / cell - 1; j <= y / cell + 1; ++j) {
        for (int i = x / cell - 1; i <= x / cell + 1; ++i) {
            const Place p = dice.at(i + 10, j + 10);
            const float half = 0.5f * static_cast<float>(cell);
            const float cx =
                static_cast<float>(i * cell) + half + jitter * half * (2 * p.uniform(0) - 1);
            const float cy =
                static_cast<float>(j * cell) + half + jitter * half * (2 * p.uniform(1) - 1);
            const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - cy;
            const float d = std::sqrt(dx * dx + dy * dy);
            if (d < best.distance) best = {dx, dy, d, p};
        }
    }
    return best;
}

// Lacquer with orange peel and straight scratches, sparse.
MadeTexel lacquer(const Dice& d, int x, int y, int size)
{
    const float p = d(0, 0.1f, 0.22f);
    const int lines = d.whole(1, 8, 30);
    for (int k = 0; k < lines; ++k) {
        const Place line = d.at(k, 77);
        const float angle = 3.14159265f * line.uniform(0);
        const float nx = std::cos(angle), ny = std::sin(angle);
        const float off = nx * static_cast<float>(x) + ny * static_cast<float>(y) -
                          static_cast<float>(size) * (1.4f * line.uniform(1) - 0.2f);
        const float steep = d(2, 0.2f, 0.7f);
        if (std::abs(off) < 1.2f) return {steep * off * nx, steep * off * ny, p + 0.25f};
    }
    const Wave peel = noise(d, static_cast<float>(x), static_cast<float>(y), d(3, 8, 24), 5);
    return {d(4, 0.5f, 2.0f) * peel.slope_x, d(4, 0.5f, 2.0f) * peel.slope_y, p};
}

// Round rivets on sheet metal.
MadeTexel rivets(const Dice& d, int x, int y, int)
{
    const int cell = d.whole(0, 20, 44);
    const float radius = d(1, 0.12f, 0.25f) * static_cast<float>(cell);
    const Nearest r = nearest(d, x, y, cell, 0.0f);
    const Place grain = d.at(x, y);
    if (r.distance >= radius) {
        return {d(2, 0.01f, 0.06f) * grain.gaussian(3), 0.01f * grain.gaussian(4),
                d(3, 0.25f, 0.45f)};
    }
    const float rise =
        1.0f / std::sqrt(std::max(0.15f, 1.3f - r.distance * r.distance / (radius * radius)));
    return {r.dx / radius * rise, r.dy / radius * rise, d(4, 0.15f, 0.3f)};
}

// Stones with water between them.
MadeTexel gravel(const Dice& d, int x, int y, int)
{
    const int cell = d.whole(0, 6, 16);
    const Nearest s = nearest(d, x, y, cell, 0.8f);
    const float radius = 0.5f * static_cast<float>(cell) * (0.6f + 0.5f * s.who.uniform(5));
    const Wave ground = noise(d, static_cast<float>(x), static_cast<float>(y), d(1, 40, 90), 9);
    const float dome = 1.0f - s.distance * s.distance / (radius * radius);
    if (ground.height + 0.4f * std::max(0.0f, dome) < d(2, 0.4f, 0.6f))
        return {0, 0, d(3, 0.04f, 0.09f)};
    const Place grain = d.at(x, y);
    const float rough = 0.15f;
    if (dome <= 0.0f) return {rough * grain.gaussian(6), rough * grain.gaussian(7), 0.9f};
    return {0.9f * s.dx / radius + rough * grain.gaussian(6),
            0.9f * s.dy / radius + rough * grain.gaussian(7), 0.5f + 0.35f * s.who.uniform(8)};
}

// Threads over and under each other.
MadeTexel cloth(const Dice& d, int x, int y, int)
{
    const int thread = d.whole(0, 3, 7);
    const float steep = d(1, 0.4f, 1.0f);
    const int i = x / thread, j = y / thread;
    const float u =
        2.0f * (static_cast<float>(x % thread) + 0.5f) / static_cast<float>(thread) - 1.0f;
    const float v =
        2.0f * (static_cast<float>(y % thread) + 0.5f) / static_cast<float>(thread) - 1.0f;
    const bool along_y = (i + j * d.whole(2, 1, 3)) % 2 == 0;
    const float fuzz = 0.08f * d.at(x, y).gaussian(1);
    return along_y ? MadeTexel{steep * u + fuzz, 0.4f * steep * v, d(3, 0.35f, 0.7f)}
                   : MadeTexel{0.4f * steep * u, steep * v + fuzz, d(3, 0.35f, 0.7f) + 0.1f};
}

// Dents of a round hammer in polished metal.
MadeTexel hammered(const Dice& d, int x, int y, int)
{
    const int cell = d.whole(0, 9, 26);
    const Nearest s = nearest(d, x, y, cell, 0.7f);
    const float steep = d(1, 0.2f, 0.6f) / static_cast<float>(cell);
    return {-steep * s.dx, -steep * s.dy, d(2, 0.1f, 0.22f)};
}

// Two glosses, flat.
MadeTexel glosses(const Dice& d, int x, int y, int)
{
    const int edge = d.whole(0, 1, 9);
    return {0, 0, ((x / edge) + (y / edge)) % 2 ? d(1, 0.08f, 0.3f) : d(2, 0.55f, 0.95f)};
}

MadeTexel corrugated(const Dice& d, int x, int y, int)
{
    const float angle = d(0, 0.0f, 3.14f), wave = 6.2831853f / d(1, 5, 40);
    const float nx = std::cos(angle), ny = std::sin(angle);
    const float s = d(2, 0.2f, 0.9f) *
                    std::sin(wave * (nx * static_cast<float>(x) + ny * static_cast<float>(y)));
    return {s * nx, s * ny, d(3, 0.15f, 0.5f)};
}

// Clear ice with frost in patches.
MadeTexel ice(const Dice& d, int x, int y, int)
{
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    const Wave large = noise(d, fx, fy, d(0, 20, 60), 3), fine = noise(d, fx, fy, d(1, 4, 9), 4);
    const bool frost = noise(d, fx, fy, d(2, 10, 40), 6).height > d(3, 0.45f, 0.65f);
    const Place grain = d.at(x, y);
    const float rough = frost ? 0.25f : 0.0f;
    return {3.0f * large.slope_x + 0.3f * fine.slope_x + rough * grain.gaussian(7),
            3.0f * large.slope_y + 0.3f * fine.slope_y + rough * grain.gaussian(8),
            frost ? 0.65f : d(4, 0.05f, 0.14f)};
}

// Chippings, the lower part of them wet.
MadeTexel wet_asphalt(const Dice& d, int x, int y, int)
{
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    const Wave stone = noise(d, fx, fy, d(0, 3, 7), 3);
    const float wet = d(1, 0.3f, 0.7f);
    const float share = stone.height < wet ? 0.35f : 1.0f;
    const float steep = d(2, 1.5f, 4.0f) * share;
    return {steep * stone.slope_x, steep * stone.slope_y,
            stone.height < wet ? d(3, 0.1f, 0.3f) : 0.85f};
}

// Small glass tiles, each tilted its own way, in mortar.
MadeTexel mosaic(const Dice& d, int x, int y, int)
{
    const int tile = d.whole(0, 6, 14), joint = d.whole(1, 1, 2);
    const Place grain = d.at(x, y);
    if (x % tile < joint || y % tile < joint)
        return {0.25f * grain.gaussian(0), 0.25f * grain.gaussian(1), 0.9f};
    const Place who = d.at(x / tile + 5000, y / tile);
    const float tilt = d(2, 0.02f, 0.15f);
    return {tilt * who.gaussian(2), tilt * who.gaussian(3),
            0.07f + d(3, 0.0f, 0.3f) * who.uniform(9)};
}

// Dull sand with single bright grains.
MadeTexel mica(const Dice& d, int x, int y, int)
{
    const Place grain = d.at(x, y);
    const float rough = d(0, 0.1f, 0.4f);
    if (grain.uniform(9) < d(1, 0.01f, 0.15f))
        return {0.5f * grain.gaussian(0), 0.5f * grain.gaussian(1), d(2, 0.08f, 0.2f)};
    return {rough * grain.gaussian(0), rough * grain.gaussian(1), d(3, 0.6f, 0.95f)};
}

// Brushed at an angle; strokes of some width.
MadeTexel strokes(const Dice& d, int x, int y, int)
{
    const float angle = d(0, 0.0f, 3.14f), nx = std::cos(angle), ny = std::sin(angle);
    const int stroke = static_cast<int>(
        std::floor((nx * static_cast<float>(x) + ny * static_cast<float>(y)) / d(1, 1.0f, 2.5f)));
    const float s = d(2, 0.1f, 0.35f) * d.at(stroke + 4000, 3).gaussian(0);
    const Place grain = d.at(x, y);
    return {s * nx + 0.02f * grain.gaussian(1), s * ny + 0.02f * grain.gaussian(2),
            d(3, 0.15f, 0.35f)};
}

// A slow ramp of gloss over fine bumps.
MadeTexel ramp(const Dice& d, int x, int y, int size)
{
    const Place grain = d.at(x, y);
    const float t =
        0.5f - 0.5f * std::cos(6.2831853f * static_cast<float>(x) / static_cast<float>(size));
    const float bump = d(0, 0.0f, 0.2f);
    return {bump * grain.gaussian(0), bump * grain.gaussian(1),
            d(1, 0.04f, 0.2f) + t * d(2, 0.3f, 0.75f)};
}

// Facets of a crystal: flat, steep, all one gloss.
MadeTexel facets(const Dice& d, int x, int y, int)
{
    const Nearest s = nearest(d, x, y, d.whole(0, 8, 30), 0.9f);
    const float tilt = d(1, 0.1f, 0.6f);
    return {tilt * s.who.gaussian(2), tilt * s.who.gaussian(3), d(2, 0.1f, 0.5f)};
}

}  // namespace

std::vector<ScoredMaps> fresh_maps(int size, std::uint32_t seed)
{
    struct Kind {
        const char* name;
        MadeTexel (*surface)(const Dice&, int, int, int);
        float width, height;  // of size
    };
    static constexpr Kind kKinds[] = {{"lacquer", lacquer, 1.0f, 1.0f},
                                      {"rivets", rivets, 0.79f, 1.0f},
                                      {"gravel", gravel, 1.0f, 1.0f},
                                      {"cloth", cloth, 1.0f, 0.5f},
                                      {"hammered", hammered, 1.0f, 1.0f},
                                      {"glosses", glosses, 0.61f, 0.83f},
                                      {"corrugated", corrugated, 1.0f, 1.0f},
                                      {"ice", ice, 0.5f, 1.0f},
                                      {"wet asphalt", wet_asphalt, 1.0f, 1.0f},
                                      {"mosaic", mosaic, 0.93f, 0.47f},
                                      {"mica", mica, 1.0f, 1.0f},
                                      {"strokes", strokes, 1.0f, 0.66f},
                                      {"ramp", ramp, 1.0f, 1.0f},
                                      {"facets", facets, 0.71f, 0.71f}};
    std::vector<ScoredMaps> all;
    for (std::uint32_t k = 0; k < std::size(kKinds); ++k) {
        const Kind& kind = kKinds[k];
        const Dice dice{seed, k};
        const auto part = [&](float share) {
            return static_cast<int>(share * static_cast<float>(size));
        };
        all.push_back(made_material(kind.name + (" " + std::to_string(seed)), part(kind.width),
                                    part(kind.height),
                                    [&](int x, int y) { return kind.surface(dice, x, y, size); }));
    }
    return all;
}

ScoredMaps patchwork(const ScoredMaps& a, const ScoredMaps& b, int patch)
{
    ScoredMaps out{a.name + " | " + b.name, a.normal, a.roughness};
    const auto lay = [patch](const RawImage& from, RawImage& to) {
        const std::size_t texel = size_of(to.type) * static_cast<std::size_t>(to.channels);
        for (int y = 0; y < to.height; ++y) {
            for (int x = 0; x < to.width; ++x) {
                if ((x / patch + y / patch) % 2 == 0) continue;
                const std::size_t source = static_cast<std::size_t>(y % from.height) *
                                               static_cast<std::size_t>(from.width) +
                                           static_cast<std::size_t>(x % from.width);
                const std::size_t at =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) +
                    static_cast<std::size_t>(x);
                std::memcpy(&to.bytes[at * texel], &from.bytes[source * texel], texel);
            }
        }
    };
    lay(b.normal, out.normal);
    lay(b.roughness, out.roughness);
    return out;
}

}  // namespace petrichor::texproc
