// What drops and splashes are made from: hashed numbers, counts, the light of lamps.
#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_NUMBERS_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_NUMBERS_H

#include <cmath>
#include <cstdint>
#include <vector>

#include "formulas/noise/noise.h"
#include "gpu/frame/frame.h"

namespace petrichor::gpu {

inline constexpr double kLargestNumber = 1.0 - 1.0 / 16777216.0;

/// Numbers of 0..kLargestNumber that follow from a seed.
class Numbers {
public:
    explicit Numbers(std::uint32_t seed) : state_(seed) {}
    float next() { return static_cast<float>(bits() >> 8) * (1.0f / 16777216.0f); }
    std::uint32_t bits()
    {
        state_ += 0x9e3779b9u;
        return shared::hash_u(state_);
    }

private:
    std::uint32_t state_;
};

/// A seed and a number make another seed.
inline std::uint32_t mixed(std::uint32_t h, std::int64_t value)
{
    const auto bits = static_cast<std::uint64_t>(value);
    h = shared::hash_u(h ^ static_cast<std::uint32_t>(bits));
    return shared::hash_u(h + static_cast<std::uint32_t>(bits >> 32) * 0x85ebca6bu);
}

/// How many a cell holds: Poisson's law by its inverse, so that a heavier fall keeps those that are
/// there.
inline int poisson(double mean, double u)
{
    double term = std::exp(-mean);
    double sum = term;
    int count = 0;
    while (u >= sum && count < 2000) {
        ++count;
        term *= mean / count;
        sum += term;
    }
    return count;
}

/// Radiance that lamps give a drop or a flake towards the eye.
glm::vec3 light_of(const std::vector<Light>& lamps, const glm::vec3& p, const glm::vec3& eye_m,
                   bool flake);

}  // namespace petrichor::gpu

#endif
