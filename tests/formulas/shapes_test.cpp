#include "formulas/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace petrichor::shared {
namespace {

using Random = std::mt19937;

glm::dvec3 in_cube(Random& random, double half)
{
    std::uniform_real_distribution<double> u(-half, half);
    const double x = u(random), y = u(random), z = u(random);
    return {x, y, z};
}

glm::dvec3 unit(Random& random)
{
    for (;;) {
        const glm::dvec3 d = in_cube(random, 1.0);
        const double size = glm::length(d);
        if (size > 0.01 && size < 1.0) return d / size;
    }
}

// What the sets are, told again without any fold: small copies of the whole.
struct Part {
    glm::dvec3 middle;
    double size;
};

std::vector<Part> parts_of(const std::vector<glm::dvec3>& places, double scale, int levels)
{
    std::vector<Part> parts{{glm::dvec3(0.0), 1.0}};
    for (int k = 0; k < levels; ++k) {
        std::vector<Part> finer;
        for (const Part& part : parts) {
            for (const glm::dvec3& place : places)
                finer.push_back({part.middle + part.size * (1.0 - scale) * place, part.size * scale});
        }
        parts = std::move(finer);
    }
    return parts;
}

const std::vector<glm::dvec3> kCorners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

std::vector<glm::dvec3> cubes_that_stay()
{
    std::vector<glm::dvec3> cubes;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if ((x == 0) + (y == 0) + (z == 0) < 2) cubes.emplace_back(x, y, z);
    return cubes;
}

double to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b)
{
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a));
}

double to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    const glm::dvec3 q = p - n * glm::dot(p - a, n);
    const bool inside = glm::dot(glm::cross(b - a, q - a), n) >= 0.0 &&
                        glm::dot(glm::cross(c - b, q - b), n) >= 0.0 &&
                        glm::dot(glm::cross(a - c, q - c), n) >= 0.0;
    if (inside) return std::abs(glm::dot(p - a, n));
    return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

double to_tetrahedron(const glm::dvec3& p)
{
    double planes = -1e9, outside = 1e9;
    for (std::size_t i = 0; i < 4; ++i) {
        planes = std::max(planes, (glm::dot(p, -kCorners[i]) - 1.0) / std::sqrt(3.0));
        outside = std::min(outside, to_triangle(p, kCorners[(i + 1) % 4], kCorners[(i + 2) % 4],
                                                kCorners[(i + 3) % 4]));
    }
    return planes <= 0.0 ? planes : outside;
}

double to_cube(const glm::dvec3& p)
{
    const glm::dvec3 q = glm::abs(p) - 1.0;
    return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

template <class To>
double to_nearest(const std::vector<Part>& parts, const glm::dvec3& p, To&& to)
{
    double least = 1e9;
    for (const Part& part : parts) least = std::min(least, part.size * to((p - part.middle) / part.size));
    return least;
}

TEST(Shapes, TetrahedronIsThatOfItsCopies)
{
    Random random(1);
    for (const int levels : {0, 1, 2, 4}) {
        const std::vector<Part> parts = parts_of(kCorners, 0.5, levels);
        ASSERT_EQ(parts.size(), std::size_t{1} << (2 * levels));
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 p = in_cube(random, i % 2 == 0 ? 1.1 : 4.0);
            const double told = sierpinski_distance(glm::vec3(p), static_cast<float>(levels));
            const double is = to_nearest(parts, p, to_tetrahedron);
            ASSERT_NEAR(told, is, 2e-6) << levels << ": " << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(Shapes, SpongeIsThatOfItsCubes)
{
    Random random(2);
    for (const int levels : {0, 1, 2, 3}) {
        const std::vector<Part> parts = parts_of(cubes_that_stay(), 1.0 / 3.0, levels);
        for (int i = 0; i < (levels < 3 ? 4000 : 600); ++i) {
            const glm::dvec3 p = in_cube(random, i % 2 == 0 ? 1.1 : 4.0);
            const double told = menger_distance(glm::vec3(p), static_cast<float>(levels));
            const double is = to_nearest(parts, p, to_cube);
            // Where cubes share a face the whole is deeper than each of them.
            ASSERT_NEAR(told, is, 3e-6) << levels << ": " << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(Shapes, SetsHoldTheShareThatTheirRuleLeaves)
{
    Random random(3);
    constexpr int kPoints = 200000;
    for (const int levels : {1, 2, 4}) {
        int sponge = 0, corners = 0, whole = 0;
        for (int i = 0; i < kPoints; ++i) {
            const glm::vec3 p(in_cube(random, 1.0));
            sponge += menger_distance(p, static_cast<float>(levels)) <= 0.0f;
            corners += sierpinski_distance(p, static_cast<float>(levels)) <= 0.0f;
            whole += sierpinski_distance(p, 0.0f) <= 0.0f;
        }
        const auto near_share = [&](int found, double share) {
            const double spread = std::sqrt(share * (1.0 - share) / kPoints);
            EXPECT_NEAR(static_cast<double>(found) / kPoints, share, 4.0 * spread) << levels;
        };
        near_share(sponge, std::pow(20.0 / 27.0, levels));
        near_share(whole, 1.0 / 3.0);
        near_share(corners, std::pow(0.5, levels) / 3.0);
    }
}

TEST(Shapes, PartsOfALevelLieBetweenItsNeighbours)
{
    Random random(4);
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 p(in_cube(random, 1.2));
        for (const auto distance : {&sierpinski_distance, &menger_distance}) {
            float before = distance(p, 2.0f);
            for (const float levels : {2.25f, 2.5f, 2.75f, 3.0f}) {
                const float d = distance(p, levels);
                ASSERT_GE(d, before - 1e-6f) << "finer sets are smaller";
                before = d;
            }
        }
    }
}

bool stays(const glm::dvec3& c, double power, int steps)
{
    glm::dvec3 v = c;
    for (int i = 0; i < steps; ++i) {
        const double r = glm::length(v);
        if (r > static_cast<double>(kBulbEscape)) return false;
        const double theta = power * std::acos(std::clamp(v.y / std::max(r, 1e-300), -1.0, 1.0));
        const double phi = power * std::atan2(v.z, v.x);
        v = std::pow(r, power) * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                            std::sin(theta) * std::sin(phi)) +
            c;
    }
    return glm::length(v) <= static_cast<double>(kBulbEscape);
}

// Balls of the distance around points on the way to the bulb: no point in them may be one of the bulb.
TEST(Shapes, BulbIsNeverNearerThanItsDistance)
{
    Random random(5);
    long asked = 0, on_the_way = 0;
    for (const int power : {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}) {
        for (const int steps : {4, 8, 12}) {
            for (int ray = 0; ray < 60; ++ray) {
                const glm::dvec3 from = 2.2 * unit(random);
                const glm::dvec3 along = glm::normalize(in_cube(random, 0.9) - from);
                double t = 0.0;
                for (int step = 0; step < 60 && t < 5.0; ++step) {
                    const glm::dvec3 p = from + along * t;
                    const double d = mandelbulb_distance(glm::vec3(p), static_cast<float>(power), steps);
                    if (d < 1e-4) break;
                    ++on_the_way;
                    for (int i = 0; i < 8; ++i, ++asked)
                        ASSERT_FALSE(stays(p + unit(random) * (0.999 * d), power, steps))
                            << power << ' ' << steps << ": " << p.x << ' ' << p.y << ' ' << p.z;
                    t += d;
                }
            }
        }
    }
    EXPECT_GT(asked, 200000) << on_the_way;
}

TEST(Shapes, BulbHoldsWhoseOrbitsStay)
{
    Random random(6);
    int inside = 0;
    for (const double power : {2.0, 3.0, 5.5, 8.0, 12.0}) {
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 p = in_cube(random, 1.2);
            const bool is = stays(p, power, 8);
            // At the rim the last digit decides.
            const float d = mandelbulb_distance(glm::vec3(p), static_cast<float>(power), 8);
            if (std::abs(d) > 1e-5f) {
                ASSERT_EQ(d <= 0.0f, is) << power << ": " << p.x << ' ' << p.y << ' ' << p.z;
            }
            if (!is) continue;
            ++inside;
            const float half = shape_half(SHAPE_MANDELBULB, static_cast<float>(power)).x;
            ASSERT_LE(glm::length(p), static_cast<double>(half) + 0.1) << "8 steps do not tell it to the last digit";
        }
    }
    EXPECT_GT(inside, 3000);
}

// On the axis the second power is the plain square, on the equator the fifth that of complex numbers.
TEST(Shapes, BulbHasTheKnownSetsInIt)
{
    for (double y = -2.4; y < 1.0; y += 0.0137) {
        const bool in_set = y >= -2.0 && y <= 0.25;
        const float d = mandelbulb_distance({0.0f, static_cast<float>(y), 0.0f}, 2.0f, 8);
        // Eight steps do not part the ends from what is beside them; more leave the axis by rounding.
        if (std::abs(y + 2.0) < 0.02 || (y > 0.25 && y < 0.5)) continue;
        EXPECT_EQ(d <= 0.0f, in_set) << y;
    }
    int different = 0, inside = 0;
    for (double x = -1.3; x < 1.3; x += 0.041) {
        for (double z = -1.3; z < 1.3; z += 0.041) {
            std::complex<double> w(x, z);
            bool in_set = true;
            for (int i = 0; i < 12 && in_set; ++i) {
                w = w * w * w * w * w + std::complex<double>(x, z);
                in_set = std::abs(w) <= static_cast<double>(kBulbEscape);
            }
            const float d = mandelbulb_distance({static_cast<float>(x), 0.0f, static_cast<float>(z)}, 5.0f, 12);
            different += (d <= 0.0f) != in_set && std::abs(d) > 1e-4f;
            inside += in_set;
        }
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(inside, 500);
}

TEST(Shapes, BulbTurnsIntoItself)
{
    Random random(7);
    for (const int power : {3, 5, 8, 12}) {
        const double turn = 2.0 * 3.14159265358979 / (power - 1);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 p = unit(random) * std::uniform_real_distribution<double>(0.6, 1.6)(random);
            const glm::dvec3 q(p.x * std::cos(turn) - p.z * std::sin(turn), p.y,
                               p.x * std::sin(turn) + p.z * std::cos(turn));
            const auto n = static_cast<float>(power);
            const float d = mandelbulb_distance(glm::vec3(p), n, 3);
            EXPECT_NEAR(mandelbulb_distance(glm::vec3(q), n, 3), d, 2e-3f * std::abs(d) + 1e-4f);
            EXPECT_NEAR(mandelbulb_distance(glm::vec3(p.x, p.y, -p.z), n, 3), d, 2e-3f * std::abs(d) + 1e-4f);
        }
    }
}

TEST(Shapes, SphereBoxAndRingHaveTheirDistances)
{
    Random random(8);
    const MarchedShape ball{SHAPE_SPHERE, 0, 0.0f, vec3(1.0f)};
    const MarchedShape box{SHAPE_BOX, 0, 0.0f, vec3(1.0f, 0.5f, 0.25f)};
    const MarchedShape ring{SHAPE_TORUS, 0, 0.0f, vec3(1.25f, 0.25f, 1.25f)};
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 p = in_cube(random, 2.0);
        EXPECT_NEAR(shape_distance(ball, glm::vec3(p), 0.0f), glm::length(p) - 1.0, 1e-6);
        // The nearest of many points of the ring's middle line.
        double line = 1e9;
        for (int k = 0; k < 2000; ++k) {
            const double a = 3.14159265358979 * k / 1000.0;
            line = std::min(line, glm::length(p - glm::dvec3(std::cos(a), 0.0, std::sin(a))));
        }
        EXPECT_NEAR(shape_distance(ring, glm::vec3(p), 0.0f), line - 0.25, 1e-5);
        const glm::dvec3 nearest = glm::clamp(p, glm::dvec3(-1.0, -0.5, -0.25), glm::dvec3(1.0, 0.5, 0.25));
        const double outside = glm::length(p - nearest);
        const float d = shape_distance(box, glm::vec3(p), 0.0f);
        if (outside > 0.0) {
            EXPECT_NEAR(d, outside, 1e-6);
        } else {
            EXPECT_LE(d, 0.0f);
        }
    }
}

// Where a ray enters a cube; nothing where it passes by.
double entry(const Part& cube, const glm::dvec3& from, const glm::dvec3& along)
{
    double first = 0.0, last = 1e9;
    for (int i = 0; i < 3; ++i) {
        const double a = (cube.middle[i] - cube.size - from[i]) / along[i];
        const double b = (cube.middle[i] + cube.size - from[i]) / along[i];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last ? first : 1e9;
}

TEST(Shapes, RaysMeetTheSpongeWhereTheyMeetItsCubes)
{
    Random random(9);
    const std::vector<Part> cubes = parts_of(cubes_that_stay(), 1.0 / 3.0, 2);
    const MarchedShape sponge{SHAPE_MENGER, 2, 0.0f, vec3(1.0f)};
    const float footprint = 2e-4f;
    int met = 0, doubtful = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 from = 3.0 * unit(random);
        const glm::dvec3 along = glm::normalize(in_cube(random, 1.0) - from);
        double is = 1e9;
        for (const Part& cube : cubes) is = std::min(is, entry(cube, from, along));
        const vec2 ends = through_box(glm::vec3(from), glm::vec3(along), vec3(1.0f));
        const double told = ends.x < ends.y ? static_cast<double>(shape_met(sponge, glm::vec3(from), glm::vec3(along), ends.x,
                                                                            ends.y, vec2(footprint, 0.0f)))
                                            : -1.0;
        met += is < 1e8;
        if ((told >= 0.0) != (is < 1e8)) {
            ++doubtful;  // past an edge, nearer than the footprint
        } else if (told >= 0.0) {
            // So near, and not behind it; along a face it is met early.
            EXPECT_LE(told, is + 1e-5);
            const glm::dvec3 at = from + along * told;
            EXPECT_LE(to_nearest(cubes, at, to_cube), 4.0 * static_cast<double>(footprint));
        }
    }
    EXPECT_GT(met, 2000);
    EXPECT_LE(doubtful, 20);
}

TEST(Shapes, RaysMeetASphereAtItsSurface)
{
    const MarchedShape ball{SHAPE_SPHERE, 0, 0.0f, vec3(1.0f)};
    Random random(10);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 from = 4.0 * unit(random);
        const glm::dvec3 along = glm::normalize(in_cube(random, 1.2) - from);
        const double b = glm::dot(from, along);
        const double h = b * b - (glm::dot(from, from) - 1.0);
        const vec2 ends = through_box(glm::vec3(from), glm::vec3(along), vec3(1.0f));
        const float told = ends.x < ends.y
                               ? shape_met(ball, glm::vec3(from), glm::vec3(along), ends.x, ends.y, vec2(0.0f, 1e-4f))
                               : -1.0f;
        if (std::abs(h) < 1e-3) continue;
        EXPECT_EQ(told < 0.0f, h < 0.0);
        if (h < 0.0) continue;
        const glm::vec3 at = glm::vec3(from) + glm::vec3(along) * told;
        EXPECT_LE(told, -b - std::sqrt(h) + 1e-5) << "not behind it";
        EXPECT_NEAR(glm::length(at), 1.0, 1e-4f * kShapeTouch * 4.0f) << "and near it";
        EXPECT_GT(glm::dot(shape_normal(ball, at, 1e-3f), glm::normalize(at)), 0.9999f);
    }
}

// Also where two of its cubes touch: there is no seam.
TEST(Shapes, FacesOfTheSpongeAreFlat)
{
    const MarchedShape sponge{SHAPE_MENGER, 4, 0.0f, vec3(1.0f)};
    Random random(11);
    int flat = 0;
    for (int i = 0; i < 20000; ++i) {
        glm::vec3 p(in_cube(random, 1.0));
        p.z = 1.0f;
        const float f = 2e-3f;
        // Not within a pixel of an edge.
        bool open = false;
        for (const glm::vec2 aside : {glm::vec2(f, 0), glm::vec2(-f, 0), glm::vec2(0, f), glm::vec2(0, -f), glm::vec2(f, f),
                                      glm::vec2(-f, -f), glm::vec2(f, -f), glm::vec2(-f, f), glm::vec2(0, 0)})
            open = open || menger_distance(p + glm::vec3(aside.x, aside.y, 0.0f), 4.0f) > 1e-6f;
        if (open) continue;
        ++flat;
        ASSERT_GT(shape_normal(sponge, p, f).z, 0.9999f) << p.x << ' ' << p.y;
    }
    EXPECT_GT(flat, 8000);
}

TEST(Shapes, AreOpenWhereTheyBulgeAndClosedInHoles)
{
    Random random(12);
    const MarchedShape ball{SHAPE_SPHERE, 0, 0.0f, vec3(1.0f)};
    const MarchedShape sponge{SHAPE_MENGER, 2, 0.0f, vec3(1.0f)};
    const MarchedShape ring{SHAPE_TORUS, 0, 0.0f, vec3(1.0f, 0.25f, 1.0f)};
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 n(unit(random));
        EXPECT_NEAR(shape_open(ball, n, n, 1e-3f), 1.0f, 1e-4f);
        const float any = shape_open(sponge, glm::vec3(in_cube(random, 1.0)), n, 1e-3f);
        EXPECT_GE(any, 0.0f);
        EXPECT_LE(any, 1.0f);
    }
    // Its outer face, away from edges; the floor of the tunnel through it; a corner of that.
    const float face = shape_open(sponge, {0.0f, 0.5f, 1.0f}, {0, 0, 1}, 1e-3f);
    const float tunnel = shape_open(sponge, {0.0f, -1.0f / 3.0f, 0.7f}, {0, 1, 0}, 1e-3f);
    const float corner = shape_open(sponge, {0.32f, -1.0f / 3.0f, 0.7f}, {0, 1, 0}, 1e-3f);
    EXPECT_NEAR(face, 1.0f, 1e-3f);
    EXPECT_LT(tunnel, 0.9f);
    EXPECT_LT(corner, 0.6f * tunnel);
    EXPECT_NEAR(shape_open(ring, {1.0f, 0.0f, 0.0f}, {1, 0, 0}, 1e-3f), 1.0f, 1e-4f);
    EXPECT_LE(shape_open(ring, {0.5f, 0.0f, 0.0f}, {-1, 0, 0}, 1e-3f), 1.0f);
}

TEST(Shapes, APointGoesThroughItsCode)
{
    for (float x = -1.0f; x <= 1.0f; x += 0.11f) {
        for (float open = 0.0f; open <= 1.0f; open += 0.13f) {
            const vec3 back = shape_decode(shape_code({x, -x * 0.5f}, open));
            EXPECT_NEAR(back.x, x, 1.3e-4f);
            EXPECT_NEAR(back.y, -x * 0.5f, 1.3e-4f);
            EXPECT_NEAR(back.z, open, 0.5f / 63.0f + 1e-5f);
        }
    }
    EXPECT_EQ(shape_decode(shape_code({1.0f, -1.0f}, 1.0f)), vec3(1.0f, -1.0f, 1.0f));
}

}  // namespace
}  // namespace petrichor::shared
