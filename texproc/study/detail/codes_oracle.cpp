#include "texproc/study/detail/codes_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "texproc/prefilter/detail/simplex.h"

namespace petrichor::texproc::detail {

namespace {

constexpr float kReach = 2.5f;         // steps of a code
constexpr std::size_t kLookedAt = 48;  // directions that are tried with every roughness
constexpr int kRoughnesses = 12;       // codes to either side of the best

struct Try {
    Codes codes;
    double error = 2.0;
    bool kept = false;
};

// Every code whose direction is within reach of one of these, once for each direction and class of
// length.
std::vector<Try> codes_about(const std::vector<Direction>& about, const StoredAs& as)
{
    const int top = (1 << as.bits) - 1;
    const float step = 2.0f / static_cast<float>(top);
    std::set<std::array<int, 3>> seen;
    std::vector<Try> tries;
    for (const Direction& n : about) {
        for (int z = top / 2 + 1; z <= top; ++z) {
            const float length = (step * static_cast<float>(z) - 1.0f) / n.z;
            const auto middle = [&](float v) {
                return 0.5f * (length * v + 1.0f) * static_cast<float>(top);
            };
            const float x = middle(n.x), y = middle(as.green_down ? -n.y : n.y);
            const int reach = static_cast<int>(std::ceil(kReach));
            for (int i = -reach; i <= reach; ++i) {
                for (int j = -reach; j <= reach; ++j) {
                    const std::array<int, 3> c{static_cast<int>(std::lround(x)) + i,
                                               static_cast<int>(std::lround(y)) + j, z};
                    if (std::min(c[0], c[1]) < 0 || std::max(c[0], c[1]) > top) continue;
                    if (!seen.insert(c).second) continue;
                    Try one;
                    float square = 0.0f;
                    for (std::size_t k = 0; k < 3; ++k) {
                        one.codes.normal[k] = static_cast<float>(c[k]) / static_cast<float>(top);
                        const float v = 2.0f * one.codes.normal[k] - 1.0f;
                        square += v * v;
                    }
                    const Direction d = read_normal(one.codes, as);
                    const Direction off{d.x - n.x, d.y - n.y, d.z - n.z};
                    if (dot(off, off) > kReach * step * kReach * step) {
                        seen.erase(c);
                        continue;
                    }
                    one.kept = as.rebuild_z || square >= kShortestNormal * kShortestNormal;
                    tries.push_back(one);
                }
            }
        }
    }
    return tries;
}

}  // namespace

CodeErrors best_codes(Samples& samples, const std::array<double, kViews>& mass,
                      const std::vector<EllipticLobe>& about, double narrowest, float light2,
                      const StoredAs& as)
{
    // alpha2: with the light
    const auto error = [&](const Direction& n, float alpha2) {
        return measure(samples, mass, round_lobe(n, std::clamp(alpha2, kMinAlpha2, 1.0f))).error;
    };
    // Where no code binds: the best lobe about each direction, then of all directions.
    std::vector<Direction> directions;
    float best2 = 0.0f;
    double best = std::numeric_limits<double>::max();
    Direction start;
    for (const EllipticLobe& lobe : about) {
        const Direction n{lobe.nx, lobe.ny, lobe.nz};
        directions.push_back(n);
        for (float a2 = static_cast<float>(narrowest * narrowest); a2 < 1.0f; a2 *= 1.3f) {
            const double e = error(n, a2);
            if (e < best) {
                best = e;
                best2 = a2;
                start = n;
            }
        }
    }
    if (directions.empty()) return {};
    const Frame frame = frame_about(start);
    const float alpha = std::sqrt(best2);
    const auto lobe_at = [&](const std::array<float, 3>& x) {
        const float u = alpha * x[0], v = alpha * x[1];
        return normalized({frame.n.x + frame.t.x * u + frame.b.x * v,
                           frame.n.y + frame.t.y * u + frame.b.y * v,
                           frame.n.z + frame.t.z * u + frame.b.z * v});
    };
    const auto free_lobe =
        simplex<3>({0.0f, 0.0f, 0.0f}, static_cast<float>(best), {0.3f, 0.3f, 0.3f}, 120, 1e-5f,
                   [&](const std::array<float, 3>& x) {
                       const Direction n = lobe_at(x);
                       return n.z < 0.05f ? 2.0f
                                          : static_cast<float>(error(n, best2 * std::exp(x[2])));
                   })
            .first;
    directions.push_back(lobe_at(free_lobe));
    const float wide2 = best2 * std::exp(free_lobe[2]);

    const int top = (1 << as.bits) - 1;
    const auto rough_of = [&](float alpha2) {
        return rounded({0.0f, 0.0f, 1.0f}, alpha2, as).rough;
    };
    std::vector<Try> tries = codes_about(directions, as);
    for (Try& one : tries) {
        Codes codes = one.codes;
        for (const float wider : {1.0f, 1.8f, 3.2f}) {
            codes.rough = rough_of(std::max(wider * wide2 - light2, 0.0f));
            const double e = error(read_normal(codes, as), read_alpha2(codes, as) + light2);
            if (e < one.error) {
                one.error = e;
                one.codes.rough = codes.rough;
            }
        }
    }
    CodeErrors found;
    for (const bool kept : {false, true}) {
        std::vector<Try> best_of = tries;
        if (kept) std::erase_if(best_of, [](const Try& t) { return !t.kept; });
        const std::size_t count = std::min(kLookedAt, best_of.size());
        std::partial_sort(best_of.begin(), best_of.begin() + static_cast<std::ptrdiff_t>(count),
                          best_of.end(), [](const Try& a, const Try& b) {
                              return a.error != b.error ? a.error < b.error
                                                        : a.codes.normal < b.codes.normal;
                          });
        double& least = kept ? found.kept : found.any;
        for (std::size_t i = 0; i < count; ++i) {
            Codes codes = best_of[i].codes;
            const int middle = static_cast<int>(std::lround(codes.rough * static_cast<float>(top)));
            for (int r = std::max(0, middle - kRoughnesses);
                 r <= std::min(top, middle + kRoughnesses); ++r) {
                codes.rough = static_cast<float>(r) / static_cast<float>(top);
                least =
                    std::min(least, error(read_normal(codes, as), read_alpha2(codes, as) + light2));
            }
        }
    }
    return found;
}

}  // namespace petrichor::texproc::detail
