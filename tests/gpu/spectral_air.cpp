#include "tests/gpu/spectral_air.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kEarth = 6360e3, kTop = 6440e3;
constexpr double kAgainTop = 60e3, kLowestSun = -0.32;
constexpr int kHeights = 64, kUps = 128;    // of the table of depths
constexpr int kRows = 16, kSuns = 64;       // of the table of light scattered more than once

// From 360 nm, means of 10 nm: the sun above the air in W/m2/nm (ASTM G-173, ETR), and ozone in m2 (Serdyuchenko
// et al. 2014, 233 K), both binned by Bruneton 2017.
constexpr std::array<double, 44> kSun = {
    1.11776, 1.14259, 1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474, 2.02042,
    2.02212, 1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,  1.85149, 1.8504,  1.8341,  1.8345,
    1.8147,  1.78158, 1.7533,  1.6965,  1.68194, 1.64654, 1.6048,  1.52143, 1.55622, 1.5113,  1.474,
    1.4482,  1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758, 1.2367,  1.2082,  1.18737, 1.14683};
constexpr std::array<double, 44> kOzone = {
    1.18e-27,  2.182e-28, 2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27, 1.582e-26,
    2.316e-26, 3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25, 2.139e-25, 2.755e-25,
    3.091e-25, 3.5e-25,   4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25, 5.019e-25, 4.305e-25, 3.74e-25,
    3.215e-25, 2.662e-25, 2.238e-25, 1.852e-25, 1.473e-25, 1.209e-25, 9.423e-26, 7.455e-26, 6.566e-26,
    5.105e-26, 4.15e-26,  4.228e-26, 3.237e-26, 2.451e-26, 2.801e-26, 2.534e-26, 1.624e-26};
constexpr double kOzonePeak = 300.0 * 2.687e20 / 15000.0;  // molecules per m3 of 300 Dobson units in the tent

// A bin's mean is the value at its middle, five nanometres above the wavelength that it is listed by.
double at(const std::array<double, 44>& bins, double nm)
{
    const double x = std::clamp((nm - 365.0) / 10.0, 0.0, 42.999);
    const auto i = static_cast<std::size_t>(x);
    return bins[i] + (bins[i + 1] - bins[i]) * (x - static_cast<double>(i));
}

double lobe(double nm, double middle, double below, double above)
{
    const double t = (nm - middle) / (nm < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

// Linear sRGB of one wavelength: CIE 1931 after Wyman, Sloan and Shirley 2013.
glm::dvec3 rgb_of(double nm)
{
    const double x = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                     0.065 * lobe(nm, 501.1, 20.4, 26.2);
    const double y = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    const double z = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
    return {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
            0.0557 * x - 0.2040 * y + 1.0570 * z};
}

double to_space(double height, double up)
{
    const double r = kEarth + height, b = r * up;
    return -b + std::sqrt(std::max(b * b + kTop * kTop - r * r, 0.0));
}

double to_ground(double height, double up)
{
    const double r = kEarth + height, b = r * up, inside = b * b + kEarth * kEarth - r * r;
    return up >= 0.0 || inside < 0.0 ? -1.0 : -b - std::sqrt(inside);
}

double horizon(double height)
{
    const double ratio = kEarth / (kEarth + height);
    return -std::sqrt(std::max(1.0 - ratio * ratio, 0.0));
}

double height_along(double height, double up, double distance)
{
    const double r = kEarth + height;
    return std::max(std::sqrt(r * r + distance * distance + 2.0 * r * distance * up) - kEarth, 0.0);
}

// step(distance, length) over a ray, longer parts far out.
template <typename Step>
void march(double reach, int steps, const Step& step)
{
    double before = 0.0;
    for (int i = 1; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps, after = reach * u * u;
        step(0.5 * (before + after), after - before);
        before = after;
    }
}

double in_table(const std::vector<double>& table, int columns, double row, double column)
{
    const int rows = static_cast<int>(table.size()) / columns;
    const int r = std::min(static_cast<int>(row), rows - 2), c = std::min(static_cast<int>(column), columns - 2);
    const double fr = row - r, fc = column - c;
    const auto entry = [&](int i, int j) { return table[static_cast<std::size_t>(i * columns + j)]; };
    return (entry(r, c) * (1.0 - fc) + entry(r, c + 1) * fc) * (1.0 - fr) +
           (entry(r + 1, c) * (1.0 - fc) + entry(r + 1, c + 1) * fc) * fr;
}

}  // namespace

SpectralAir::SpectralAir(double turbidity, double ground_albedo)
{
    glm::dvec3 white(0.0);
    for (double nm = 382.5; nm < 780.0; nm += 5.0) {
        Line line{.molecules = 1.24062e-6 / std::pow(1e-3 * nm, 4.0),
                  .haze = 2.6e-6 * std::max(turbidity - 1.0, 0.0),
                  .ozone = kOzonePeak * at(kOzone, nm),
                  .rgb = at(kSun, nm) * rgb_of(nm),
                  .depths = {},
                  .again = {}};
        white += line.rgb;
        fill(line, ground_albedo);
        lines_.push_back(std::move(line));
    }
    for (Line& line : lines_) line.rgb /= white;
}

double SpectralAir::scattering(const Line& line, double height)
{
    return line.molecules * std::exp(-height / 8000.0) + line.haze * std::exp(-height / 1200.0);
}

double SpectralAir::extinction(const Line& line, double height)
{
    return line.molecules * std::exp(-height / 8000.0) + 1.1 * line.haze * std::exp(-height / 1200.0) +
           line.ozone * std::max(0.0, 1.0 - std::abs(height - 25000.0) / 15000.0);
}

double SpectralAir::depth(const Line& line, double height, double up)
{
    double sum = 0.0;
    march(to_space(height, up), 40, [&](double distance, double length) {
        sum += extinction(line, height_along(height, up, distance)) * length;
    });
    return sum;
}

double SpectralAir::transmittance(const Line& line, double height, double up)
{
    const double h = std::min(height, kTop - kEarth), low = horizon(h);
    if (up < low) return 0.0;
    return std::exp(-in_table(line.depths, kUps, std::sqrt(h / (kTop - kEarth)) * (kHeights - 1),
                              std::sqrt((up - low) / (1.0 - low)) * (kUps - 1)));
}

double SpectralAir::scattered_again(const Line& line, double height, double sun_up)
{
    return std::exp(in_table(line.again, kSuns, std::sqrt(std::min(height / kAgainTop, 1.0)) * (kRows - 1),
                             std::sqrt(std::max(sun_up - kLowestSun, 0.0) / (1.0 - kLowestSun)) * (kSuns - 1)));
}

void SpectralAir::fill(Line& line, double ground_albedo)
{
    for (int row = 0; row < kHeights; ++row) {
        const double x = static_cast<double>(row) / (kHeights - 1), height = (kTop - kEarth) * x * x;
        for (int column = 0; column < kUps; ++column) {
            const double y = static_cast<double>(column) / (kUps - 1), low = horizon(height);
            line.depths.push_back(depth(line, height, low + (1.0 - low) * y * y));
        }
    }
    constexpr int kSlants = 8, kSides = 8;
    for (int row = 0; row < kRows; ++row) {
        const double x = static_cast<double>(row) / (kRows - 1), height = std::max(kAgainTop * x * x, 1.0);
        std::array<double, kSuns> twice{};
        double sent_on = 0.0;
        for (int k = 0; k < kSlants; ++k) {
            const double slant = 2.0 * (k + 0.5) / kSlants - 1.0, up = slant * std::abs(slant);
            const double share = 2.0 * std::abs(slant) / kSlants, level = std::sqrt(1.0 - up * up);
            const auto add = [&](double distance, double weight, const auto& light) {
                const double there = height_along(height, up, distance);
                for (int column = 0; column < kSuns; ++column) {
                    const double y = static_cast<double>(column) / (kSuns - 1);
                    const double sun = kLowestSun + (1.0 - kLowestSun) * y * y;
                    const double sun_level = std::sqrt(std::max(0.0, 1.0 - sun * sun));
                    for (int s = 0; s < kSides; ++s) {
                        const double turn = up * sun + level * sun_level * std::cos(kPi * (s + 0.5) / kSides);
                        twice[static_cast<std::size_t>(column)] +=
                            weight * share / kSides *
                            light(there, ((kEarth + height) * sun + distance * turn) / (kEarth + there));
                    }
                }
            };
            const double ground = to_ground(height, up);
            double left = 1.0;
            march(ground > 0.0 ? ground : to_space(height, up), 16, [&](double distance, double length) {
                const double h = height_along(height, up, distance), out = extinction(line, h);
                const double passed = std::exp(-out * length);
                const double scattered = left * scattering(line, h) * (1.0 - passed) / std::max(out, 1e-14);
                sent_on += scattered * share;
                add(distance, 0.25 / kPi * scattered,
                    [&](double there, double sun) { return transmittance(line, there, sun); });
                left *= passed;
            });
            if (ground > 0.0)
                add(ground, ground_albedo * left / kPi,
                    [&](double, double sun) { return transmittance(line, 0.0, sun) * std::max(sun, 0.0); });
        }
        for (const double light : twice) line.again.push_back(std::log(std::max(light / (1.0 - sent_on), 1e-14)));
    }
}

double SpectralAir::radiance_of(const Line& line, double up, double sun_up, double sun_angle)
{
    constexpr double kEye = 2.0, kForward = 0.76, kForward2 = kForward * kForward;
    const double by_molecules = 3.0 / (16.0 * kPi) * (1.0 + sun_angle * sun_angle);
    const double base = std::max(1.0 + kForward2 - 2.0 * kForward * sun_angle, 1e-4);
    const double by_haze = 3.0 / (8.0 * kPi) * (1.0 - kForward2) * (1.0 + sun_angle * sun_angle) /
                           ((2.0 + kForward2) * base * std::sqrt(base));
    double sum = 0.0, depth_so_far = 0.0;
    march(to_space(kEye, up), 32, [&](double distance, double length) {
        const double h = height_along(kEye, up, distance), out = extinction(line, h);
        const double sun = std::clamp(((kEarth + kEye) * sun_up + distance * sun_angle) / (kEarth + h), -1.0, 1.0);
        const double once = line.molecules * std::exp(-h / 8000.0) * by_molecules +
                            line.haze * std::exp(-h / 1200.0) * by_haze;
        sum += std::exp(-depth_so_far - 0.5 * out * length) * length *
               (transmittance(line, h, sun) * once + scattering(line, h) * scattered_again(line, h, sun));
        depth_so_far += out * length;
    });
    return sum;
}

glm::dvec3 SpectralAir::sun(double sun_up) const
{
    return color([&](const Line& line) { return std::exp(-depth(line, 2.0, sun_up)); });
}

glm::dvec3 SpectralAir::radiance(double up, double sun_up, double sun_angle) const
{
    return color([&](const Line& line) { return radiance_of(line, up, sun_up, sun_angle); });
}

glm::dvec3 SpectralAir::level(double sun_up) const
{
    constexpr int kUpwards = 10, kAround = 8;
    const double sun_level = std::sqrt(std::max(0.0, 1.0 - sun_up * sun_up));
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kUpwards; ++i) {
        const double v = (i + 0.5) / kUpwards, up = v * v, level = std::sqrt(1.0 - up * up);
        for (int j = 0; j < kAround; ++j) {
            const double side = std::cos(kPi * (j + 0.5) / kAround);
            sum += radiance(up, sun_up, up * sun_up + level * sun_level * side) * (up * 2.0 * v);
        }
    }
    return sum * (2.0 * kPi / (kUpwards * kAround));
}

}  // namespace petrichor::gpu
