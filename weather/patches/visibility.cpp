#include "weather/patches/visibility.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr double kHorizon_rad = 7.0 * kPi / 180.0;
constexpr double kZenith_rad = 30.0 * kPi / 180.0;
constexpr double kWindAbove_rad = 27.0 * kPi / 180.0;
constexpr double kWindBeside_rad = 45.0 * kPi / 180.0;
constexpr int kWindAcross = 9, kWindUp = 3;

Direction raw_direction(int texel)
{
    const double u =
        (static_cast<double>(texel % kVisibleAcross) + 0.5) / kVisibleAcross * 2.0 - 1.0;
    const double v =
        (static_cast<double>(texel / kVisibleAcross) + 0.5) / kVisibleAcross * 2.0 - 1.0;
    const double x = 0.5 * (u + v), z = 0.5 * (u - v);
    return {x, 1.0 - std::abs(x) - std::abs(z), z};
}

struct Texel {
    Direction direction;
    double solid_angle_sr = 0.0;
    // Means over the texel, so that sums over open sky are exact: of the direction, and of the
    // direction times ln sec z, which grows without end towards the horizon; solid angle likewise.
    Direction mean, log_secant;
    bool near_horizon = false, near_zenith = false;
};
void set_means(Texel& t, int texel)
{
    constexpr int kParts = 16;
    const double step = 2.0 / kVisibleAcross / kParts;
    const double u0 = static_cast<double>(texel % kVisibleAcross) / kVisibleAcross * 2.0 - 1.0;
    const double v0 = static_cast<double>(texel / kVisibleAcross) / kVisibleAcross * 2.0 - 1.0;
    t.mean = t.log_secant = {0.0, 0.0, 0.0};
    const Direction middle = raw_direction(texel);
    const double middle2 = dot(middle, middle);
    const double centre = 1.0 / (middle2 * std::sqrt(middle2));
    double all = 0.0;
    const auto add = [](Direction& sum, const Direction& d, double weight) {
        sum = {sum.x + d.x * weight, sum.y + d.y * weight, sum.z + d.z * weight};
    };
    for (int k = 0; k < kParts * kParts; ++k) {
        const double u = u0 + (k % kParts + 0.5) * step, v = v0 + (k / kParts + 0.5) * step;
        const double x = 0.5 * (u + v), z = 0.5 * (u - v), y = 1.0 - std::abs(x) - std::abs(z);
        const double length = std::sqrt(x * x + y * y + z * z);
        const Direction d{x / length, y / length, z / length};
        const double weight = 1.0 / (length * length * length);
        add(t.mean, d, weight);
        add(t.log_secant, d, -weight * detail::logarithm(d.y));
        all += weight;
    }
    t.solid_angle_sr *= all / (kParts * kParts) / centre;
    t.mean = {t.mean.x / all, t.mean.y / all, t.mean.z / all};
    t.log_secant = {t.log_secant.x / all, t.log_secant.y / all, t.log_secant.z / all};
}
std::array<Texel, kVisibleBits> make_texels()
{
    std::array<Texel, kVisibleBits> all;
    for (int i = 0; i < kVisibleBits; ++i) {
        Texel& t = all[static_cast<std::size_t>(i)];
        t.direction = visible_direction(i);
        t.solid_angle_sr = visible_solid_angle_sr(i);
        set_means(t, i);
        t.near_horizon = t.direction.y < detail::sine_cosine(kHorizon_rad).sin;
        t.near_zenith = t.direction.y > detail::sine_cosine(kZenith_rad).cos;
    }
    return all;
}
const std::array<Texel, kVisibleBits>& texels()
{
    static const std::array<Texel, kVisibleBits> all = make_texels();
    return all;
}

}  // namespace

Direction direction_of(double azimuth_rad, double elevation_rad, double north_rad)
{
    const auto around = detail::sine_cosine(azimuth_rad + north_rad);
    const auto up = detail::sine_cosine(elevation_rad);
    return {around.sin * up.cos, up.sin, -around.cos * up.cos};
}

Direction visible_direction(int texel)
{
    const Direction raw = raw_direction(texel);
    const double scale = 1.0 / std::sqrt(dot(raw, raw));
    return {raw.x * scale, raw.y * scale, raw.z * scale};
}

double visible_solid_angle_sr(int texel)
{
    const Direction raw = raw_direction(texel);
    const double length2 = dot(raw, raw);
    const double step = 2.0 / kVisibleAcross;
    return 0.5 * step * step / (length2 * std::sqrt(length2));
}

VisibleBits open_sky(const Direction& normal)
{
    VisibleBits bits{};
    for (int i = 0; i < kVisibleBits; ++i)
        if (dot(texels()[static_cast<std::size_t>(i)].direction, normal) > 0.0)
            bits[static_cast<std::size_t>(i >> 5)] |= 1u << (i & 31);
    return bits;
}

VisibleLookup visible_lookup(const Direction& d)
{
    VisibleLookup out;
    if (!(d.y > 0.0)) return out;
    out.above = true;
    const double scale = 1.0 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    const double half = 0.5 * kVisibleAcross;
    const double u = ((d.x + d.z) * scale + 1.0) * half - 0.5;
    const double v = ((d.x - d.z) * scale + 1.0) * half - 0.5;
    const double u0 = std::floor(u), v0 = std::floor(v);
    for (int k = 0; k < 4; ++k) {
        const bool right = (k & 1) != 0, lower = (k >> 1) != 0;
        const int x = std::clamp(static_cast<int>(u0) + (right ? 1 : 0), 0, kVisibleAcross - 1);
        const int y = std::clamp(static_cast<int>(v0) + (lower ? 1 : 0), 0, kVisibleAcross - 1);
        const auto i = static_cast<std::size_t>(k);
        out.texel[i] = static_cast<std::int16_t>(y * kVisibleAcross + x);
        out.weight[i] = static_cast<float>((right ? u - u0 : 1.0 - (u - u0)) *
                                           (lower ? v - v0 : 1.0 - (v - v0)));
    }
    return out;
}

SkyShares sky_shares(const VisibleBits& bits, const Direction& normal)
{
    double sky = 0.0, log_secant = 0.0, horizon = 0.0, horizon_all = 0.0;
    double zenith = 0.0, zenith_all = 0.0;
    for (int i = 0; i < kVisibleBits; ++i) {
        const Texel& t = texels()[static_cast<std::size_t>(i)];
        const bool seen = sees(bits, i);
        const double facing = std::max(0.0, dot(t.mean, normal)) * t.solid_angle_sr;
        if (t.near_zenith) {
            zenith_all += t.solid_angle_sr;
            if (seen) zenith += t.solid_angle_sr;
        }
        if (t.near_horizon) {
            horizon_all += facing;
            if (seen) horizon += facing;
        }
        if (!seen) continue;
        sky += facing;
        log_secant += std::max(0.0, dot(t.log_secant, normal)) * t.solid_angle_sr;
    }
    SkyShares out;
    out.sky = std::min(1.0, sky / kPi);
    out.horizon = horizon_all > 0.0 ? horizon / horizon_all : 0.0;
    out.zenith = zenith / zenith_all;
    out.log_secant = sky > 0.0 ? log_secant / sky : 0.5;
    return out;
}

std::array<float, kWindClasses> wind_blocking(const VisibleBits& bits)
{
    struct Ray {
        std::int16_t texel;
        float weight;
    };
    using Fan = std::array<Ray, static_cast<std::size_t>(kWindAcross) * kWindUp>;
    static const std::array<Fan, kWindClasses> fans = [] {
        std::array<Fan, kWindClasses> all{};
        for (std::size_t c = 0; c < kWindClasses; ++c) {
            const double middle = 2.0 * kPi * static_cast<double>(c) / kWindClasses;
            double sum = 0.0;
            for (int k = 0; k < kWindAcross * kWindUp; ++k) {
                const double beside =
                    kWindBeside_rad * ((2.0 * (k % kWindAcross) + 1.0) / kWindAcross - 1.0);
                const double up = kWindAbove_rad * ((k / kWindAcross) + 0.5) / kWindUp;
                const VisibleLookup at = visible_lookup(direction_of(middle + beside, up));
                // The nearest bit is the one with the most weight.
                const auto most = static_cast<std::size_t>(
                    std::max_element(at.weight.begin(), at.weight.end()) - at.weight.begin());
                const double weight = detail::sine_cosine(beside).cos;
                all[c][static_cast<std::size_t>(k)] = {at.texel[most], static_cast<float>(weight)};
                sum += weight;
            }
            for (Ray& ray : all[c]) ray.weight = ray.weight / static_cast<float>(sum);
        }
        return all;
    }();
    std::array<float, kWindClasses> blocked{};
    for (std::size_t c = 0; c < kWindClasses; ++c)
        for (const Ray& ray : fans[c])
            if (!sees(bits, ray.texel)) blocked[c] += ray.weight;
    return blocked;
}

double blocking_from(const std::array<float, kWindClasses>& blocked, double azimuth_rad)
{
    const double turn = azimuth_rad / (2.0 * kPi);
    const double at = (turn - std::floor(turn)) * kWindClasses;
    const auto low = static_cast<std::size_t>(at) % kWindClasses;
    const double part = at - std::floor(at);
    return static_cast<double>(blocked[low]) * (1.0 - part) +
           static_cast<double>(blocked[(low + 1) % kWindClasses]) * part;
}

}  // namespace petrichor::weather
