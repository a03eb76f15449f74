#include "texproc/prefilter/lux.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace petrichor::texproc {

float lux_smoothness(float g, float l)
{
    if (l != l) return 0.0f;  // one normal with x^2 + y^2 > 1 poisons its whole footprint
    const float k = l < 1.0f ? (3.0f * l - l * l * l) / (1.0f - l * l) : 10000.0f;
    const float p = 1.0f - g;
    const float smoothness = 1.0f - std::sqrt(p * p + 1.0f / k);
    return std::clamp(smoothness, 0.0f, 1.0f);  // 1/k is infinite at k = 0: 0
}

std::vector<std::vector<std::uint8_t>> lux_smoothness_mips(
    const std::vector<std::uint8_t>& normal_x, const std::vector<std::uint8_t>& normal_y,
    const std::vector<std::vector<std::uint8_t>>& mips, int size)
{
    const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    if (size < 1 || (size & (size - 1)) != 0 || normal_x.size() != texels ||
        normal_y.size() != texels) {
        throw Error("lux: the compatible rule needs square maps of a power of two, got " +
                        std::to_string(size),
                    "Use the rule lux-formula (same formula, exact footprints) or moments.");
    }
    std::vector<std::vector<std::uint8_t>> out(mips.size());
    for (std::size_t m = 1; m <= mips.size(); ++m) {
        const int side = std::max(1, size >> m);
        const int footprint = 1 << m;
        if (footprint > size ||
            mips[m - 1].size() != static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {
            throw Error("lux: level " + std::to_string(m) + " does not belong to a map of " +
                            std::to_string(size),
                        "Pass every level from 1 on, each half the size of the one before.");
        }
        out[m - 1].resize(mips[m - 1].size());
        parallel_for(static_cast<std::size_t>(side), 0, [&](std::size_t j) {
            for (int i = 0; i < side; ++i) {
                const int x0 = i * footprint;
                const int y0 = static_cast<int>(j) * footprint;
                float sx = 0.0f, sy = 0.0f, sz = 0.0f;
                for (int b = 0; b < footprint; ++b) {
                    for (int a = 0; a < footprint; ++a) {
                        const std::size_t at =
                            static_cast<std::size_t>(y0 + b) * static_cast<std::size_t>(size) +
                            static_cast<std::size_t>(x0 + a);
                        const float x = 2.0f * static_cast<float>(normal_x[at]) / 255.0f - 1.0f;
                        const float y = 2.0f * static_cast<float>(normal_y[at]) / 255.0f - 1.0f;
                        const float z = std::sqrt(1.0f - x * x - y * y);
                        const float length = std::sqrt(x * x + y * y + z * z);
                        sx += x / length;
                        sy += y / length;
                        sz += z / length;
                    }
                }
                const float count = static_cast<float>(footprint) * static_cast<float>(footprint);
                const float nx = sx / count, ny = sy / count, nz = sz / count;
                const float l = std::sqrt(nx * nx + ny * ny + nz * nz);
                const std::size_t at =
                    j * static_cast<std::size_t>(side) + static_cast<std::size_t>(i);
                const float g = static_cast<float>(mips[m - 1][at]) / 255.0f;
                out[m - 1][at] = static_cast<std::uint8_t>(255.0f * lux_smoothness(g, l));
            }
        });
    }
    return out;
}

}  // namespace petrichor::texproc
