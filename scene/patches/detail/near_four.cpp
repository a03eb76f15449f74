#include "scene/patches/detail/near_four.h"

#include <limits>

#include "formulas/light/near_light.h"

namespace petrichor::scene {
namespace {

Four chosen(Signs where, Four a, Four b)
{
    return where ? a : b;
}
Four3 chosen(Signs where, const Four3& a, const Four3& b)
{
    return {chosen(where, a.x, b.x), chosen(where, a.y, b.y), chosen(where, a.z, b.z)};
}
Four magnitude(Four x)
{
    return x < all(0.0f) ? -x : x;
}

// As formulas/light/near_light.h has them.
Four3 direction(const Four3& corner)
{
    return corner * (all(1.0f) / square_root(larger(dot(corner, corner), all(1.0e-24f))));
}

Four edge(const Four3& p, const Four3& q, Four length_p, Four length_q, const Four3& n)
{
    const Four3 between = p * length_q + q * length_p;
    const Four v = 2.0f * length_p * length_q;
    const Four w = larger(square_root(dot(between, between)), 5.0e-8f * v);
    const Four above = 0.8543985f * v * v + (0.4965155f * v + 0.0145206f * w) * w;
    const Four below = 3.4175940f * v * v + (4.1616724f * v + w) * w;
    return 2.0f * dot(cross(q, p), n) * above / larger(below * w, all(1.0e-37f));
}

Four3 crossing(const Four3& p, const Four3& q, Four height_p, Four height_q)
{
    return p * magnitude(height_q) + q * magnitude(height_p);
}

}  // namespace

FourPoints::FourPoints(std::span<const SamplePoint> points)
{
    for (std::size_t first = 0; first < points.size(); first += 4) {
        float at[3][4], up[3][4];
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const SamplePoint& p = points[first + lane < points.size() ? first + lane : points.size() - 1];
            for (int k = 0; k < 3; ++k) {
                at[k][lane] = p.position_m[k];
                up[k][lane] = p.normal[k];
            }
        }
        position_m.push_back(four3(at));
        normal.push_back(four3(up));
    }
}

PETRICHOR_ALSO_AVX Four near_form_factors(const std::array<glm::vec3, 4>& corners, const Four3& position_m,
                                          const Four3& n)
{
    const Four zero = all(0.0f);
    std::array<Four3, 4> corner;
    std::array<Four, 4> height, length;
    std::array<Signs, 4> up;
    Signs any_down = zero > zero, above = any_down;
    for (std::size_t k = 0; k < 4; ++k) {
        corner[k] = all3(corners[k]) - position_m;
        height[k] = dot(corner[k], n);
        length[k] = square_root(dot(corner[k], corner[k]));
        up[k] = height[k] >= zero;
        any_down |= ~up[k];
        above |= height[k] > zero;
    }
    Four sum;
    if (none(any_down)) {
        const auto part = [&](std::size_t k) {
            return edge(corner[k], corner[(k + 1) % 4], length[k], length[(k + 1) % 4], n);
        };
        sum = part(0) + part(1) + part(2) + part(3);
    } else {
        std::array<Four3, 4> between;  // a corner and the next
        for (std::size_t k = 0; k < 4; ++k)
            between[k] = crossing(corner[k], corner[(k + 1) % 4], height[k], height[(k + 1) % 4]);
        Four3 down{zero, zero, zero}, rising{zero, zero, zero};
        for (std::size_t k = 4; k-- > 0;) {
            const std::size_t next = (k + 1) % 4;
            down = chosen(up[k] & ~up[next], between[k], down);
            rising = chosen(~up[k] & up[next], between[k], rising);
        }
        down = direction(down);
        rising = direction(rising);
        const Four one = all(1.0f);
        const auto part = [&](std::size_t k) {
            const std::size_t next = (k + 1) % 4;
            const Four side = edge(chosen(up[k], corner[k], rising), chosen(up[next], corner[next], down),
                                   chosen(up[k], length[k], one), chosen(up[next], length[next], one), n);
            return chosen(up[k] | up[next], side, zero);
        };
        sum = part(0) + part(1) + part(2) + part(3) + edge(down, rising, one, one, n);
    }
    const Four3 way = corner[2] - corner[0], other = corner[3] - corner[1];
    const Four3 area = cross(way, other);
    const Four area2 = dot(area, area);
    const Four before = -dot(area, corner[0]), against = -dot(area, n);
    const Signs own_sheet = (against > zero) & (against * against > 0.5f * area2) &
                            (before * before < shared::kNearSheet * shared::kNearSheet * area2 * dot(way, way));
    return chosen(above & (before > zero) & ~own_sheet, smaller(larger(sum, zero), all(1.0f)), zero);
}

PETRICHOR_ALSO_AVX Four3 nearest_in(const NearPolygon& p, glm::vec3 n, const Four3& x)
{
    constexpr float kMargin_m = 1e-6f;
    const Four zero = all(0.0f);
    const Four3 normal = all3(n), first = all3(p.corner[0]);
    const Four3 foot = x - normal * dot(x - first, normal);
    Signs outside = p.count < 3 ? zero <= zero : magnitude(dot(foot - first, normal)) > all(kMargin_m);
    Four3 best = first;
    Four least2 = all(std::numeric_limits<float>::max());
    for (int k = 0; k < p.count; ++k) {
        const glm::vec3 corner = p.corner[static_cast<std::size_t>(k)];
        const glm::vec3 side = p.corner[static_cast<std::size_t>((k + 1) % p.count)] - corner;
        const float length2 = glm::dot(side, side);
        const Four3 a = all3(corner), edge = all3(side);
        const Four inside = dot(cross(edge, foot - a), normal);
        outside |= (inside < zero) & (inside * inside > all(kMargin_m * kMargin_m * length2));
        const Four along = length2 > 0.0f ? smaller(larger(dot(x - a, edge) / all(length2), zero), all(1.0f)) : zero;
        const Four3 there = a + edge * along, way = x - there;
        const Four far2 = dot(way, way);
        const Signs nearer = far2 < least2;
        least2 = chosen(nearer, far2, least2);
        best = chosen(nearer, there, best);
    }
    return chosen(outside, best, foot);
}

}  // namespace petrichor::scene
