#include "texproc/filter/bump_slopes.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

constexpr float kLeastZ = 0.001f;

}  // namespace

Image bump_slopes(const Image& map, Edge u, Edge v)
{
    if (map.channels != 1 && map.channels != 3) {
        throw Error("bump slopes: " + std::to_string(map.channels) + " channels",
                    "Give heights (1 channel) or normals (3).");
    }
    Image out(map.width, map.height, 6, ColorSpace::Data);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            float h = -1.0f, s = 0.0f, t = 0.0f;
            if (map.channels == 1) {
                const auto at = [&](int dx, int dy) {
                    return map.at(edge_index(x + dx, map.width, u), edge_index(y + dy, map.height, v),
                                  0);
                };
                h = at(0, 0);
                s = (at(1, -1) + 2.0f * at(1, 0) + at(1, 1) - at(-1, -1) - 2.0f * at(-1, 0) -
                     at(-1, 1)) / 8.0f;
                t = (at(-1, 1) + 2.0f * at(0, 1) + at(1, 1) - at(-1, -1) - 2.0f * at(0, -1) -
                     at(1, -1)) / 8.0f;
            } else {
                const float z = std::max(2.0f * map.at(x, y, 2) - 1.0f, kLeastZ);
                s = (1.0f - 2.0f * map.at(x, y, 0)) / z;
                t = (1.0f - 2.0f * map.at(x, y, 1)) / z;
            }
            float* to = &out.at(x, y, 0);
            to[0] = h, to[1] = s, to[2] = t, to[3] = s * s, to[4] = t * t, to[5] = s * t;
        }
    return out;
}

}  // namespace petrichor::texproc
