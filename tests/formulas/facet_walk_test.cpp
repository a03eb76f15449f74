// Light from facet to facet beside a walk over them: where it goes, not only how much of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "formulas/light/iridescence.h"
#include "formulas/light/layers.h"

namespace petrichor::shared {
namespace {

using glm::dvec3;

constexpr double kTurn = 6.283185307179586;
constexpr int kRings = 6, kTurns = 6;
using Sent = std::array<double, kRings * kTurns>;  // shares by cosine and by turn from the plane of the eye

std::size_t bin(const dvec3& w)
{
    const double turn = std::abs(std::atan2(w.y, w.x)) / (0.5 * kTurn);
    return static_cast<std::size_t>(std::min(static_cast<int>(w.z * kRings), kRings - 1) * kTurns +
                                    std::min(static_cast<int>(turn * kTurns), kTurns - 1));
}

// Smith's facets over heights that are alike between -1 and 1 (Heitz et al. 2016, Multiple-Scattering Microfacet BSDFs
// with the Smith Model); what is mirrored loses nothing.
class Walk {
public:
    Walk(double along, double across) : along_(along), across_(across) {}

    // The way that light leaves by.
    dvec3 operator()(const dvec3& eye)
    {
        return (*this)(eye, [](double) {});
    }

    // The same; `meets` is told the cosine to each facet on the way.
    template <typename Meets>
    dvec3 operator()(const dvec3& eye, Meets&& meets)
    {
        dvec3 w = -eye;
        double below = 1.0;  // share of the heights
        for (int bounce = 0; bounce < 40; ++bounce) {
            const double shade = shadow(w), unit = number();
            if (w.z > 0.9999 || (w.z > 0.0 && unit > 1.0 - std::pow(below, shade))) return w;
            below = w.z < -0.9999 ? unit * below : below / std::pow(std::max(1.0 - unit, 1e-12), 1.0 / shade);
            below = std::clamp(below, 1e-9, 1.0);
            const dvec3 facet = seen_facet(-w);
            meets(-glm::dot(w, facet));
            w -= 2.0 * glm::dot(w, facet) * facet;
        }
        return {0.0, 0.0, -1.0};
    }

private:
    double number() { return static_cast<double>(numbers_() >> 8) / 16777216.0; }

    double shadow(const dvec3& w) const
    {
        const double slope = (along_ * along_ * w.x * w.x + across_ * across_ * w.y * w.y) / std::max(w.z * w.z, 1e-12);
        return 0.5 * (std::copysign(std::sqrt(1.0 + slope), w.z) - 1.0);
    }

    // Dupuy and Benyoub 2023: a cap of the sphere, for eyes below the surface too.
    dvec3 seen_facet(const dvec3& v)
    {
        const dvec3 s = glm::normalize(dvec3(along_ * v.x, across_ * v.y, v.z));
        const double turn = kTurn * number();
        const double up = (1.0 - number()) * (1.0 + s.z) - s.z;
        const double level = std::sqrt(std::clamp(1.0 - up * up, 0.0, 1.0));
        const dvec3 h = dvec3(level * std::cos(turn), level * std::sin(turn), up) + s;
        return glm::normalize(dvec3(along_ * h.x, across_ * h.y, std::max(h.z, 1e-9)));
    }

    double along_, across_;
    std::mt19937 numbers_{7};
};

Sent by_walk(double along, double across, const dvec3& eye, int walks)
{
    Walk walk(along, across);
    Sent sent{};
    for (int i = 0; i < walks; ++i) {
        const dvec3 w = walk(eye);
        if (w.z > 0.0) sent[bin(w)] += 1.0 / walks;
    }
    return sent;
}

template <typename Answer>
Sent by_formula(Answer&& answer)
{
    const int rows = 240, columns = 288;
    Sent sent{};
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double up = (i + 0.5) / rows, level = std::sqrt(1.0 - up * up), turn = kTurn * (j + 0.5) / columns;
            const dvec3 l(level * std::cos(turn), level * std::sin(turn), up);
            sent[bin(l)] += static_cast<double>(answer(glm::vec3(l)).g) * kTurn / (rows * columns);
        }
    }
    return sent;
}

// The middle of the relative errors of what is worth a look.
double error(const Sent& seen, const Sent& truth, double least = 5e-4)
{
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i] > least) errors.push_back(std::abs(seen[i] - truth[i]) / truth[i]);
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    return errors[errors.size() / 2];
}

const glm::vec3 kUp(0, 0, 1), kWhite(1.0f);

TEST(FacetWalk, LightGoesWhereAWalkFromFacetToFacetSendsIt)
{
    for (const float roughness : {0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f}) {
        for (const double up : {0.5, 0.9}) {
            const dvec3 eye(std::sqrt(1.0 - up * up), 0.0, up);
            const float alpha = roughness * roughness;
            const Sent walked = by_walk(static_cast<double>(alpha), static_cast<double>(alpha), eye, 400000);
            const Lobe alone = make_lobe(kUp, glm::vec3(eye), glm::vec3(0.0f), kWhite, alpha);
            const Lobe all = with_all_light(alone, roughness, lost_along_lobe(roughness));
            EXPECT_LT(error(by_formula([&](const glm::vec3& l) { return shade_lobe(all, l); }), walked), 0.08) << roughness << " " << up;
            EXPECT_GT(error(by_formula([&](const glm::vec3& l) { return shade_lobe(alone, l); }), walked), 0.12) << roughness << " " << up;
        }
    }
}

// On smooth surfaces all that goes on meets a steep facet and the ground beside it: the dark beside a highlight has a tenth to a third of
// its light from there.
TEST(FacetWalk, ASteepFacetAndTheGroundLightTheDarkBesideAHighlight)
{
    for (const float roughness : {0.2f, 0.25f, 0.3f, 0.35f}) {
        for (const double up : {0.4, 0.9}) {
            const dvec3 eye(std::sqrt(1.0 - up * up), 0.0, up);
            const float alpha = roughness * roughness;
            const Sent walked = by_walk(static_cast<double>(alpha), static_cast<double>(alpha), eye, 2000000);
            const Lobe alone = make_lobe(kUp, glm::vec3(eye), glm::vec3(0.0f), kWhite, alpha);
            const Lobe all = with_all_light(alone, roughness, lost_along_lobe(roughness));
            const double with = error(by_formula([&](const glm::vec3& l) { return shade_lobe(all, l); }), walked, 5e-5);
            const double without = error(by_formula([&](const glm::vec3& l) { return shade_lobe(alone, l); }), walked, 5e-5);
            EXPECT_LT(with, 0.06) << roughness << " " << up;
            EXPECT_GT(without, 2.5 * with) << roughness << " " << up;
        }
    }
}

double total(const Sent& sent)
{
    double sum = 0.0;
    for (const double share : sent) sum += share;
    return sum;
}

// Up to the longest lobe that KHR_materials_anisotropy has.
TEST(FacetWalk, AlongAGrainItGoesByItsLength)
{
    for (const float roughness : {0.2f, 0.4f, 0.6f}) {
        for (const float anisotropy : {0.5f, 0.7f, 0.85f, 1.0f}) {
            for (const dvec3& towards : {dvec3(0.5, 0.0, 0.8), dvec3(0.0, 0.5, 0.8), dvec3(0.9, 0.0, 0.3), dvec3(0.0, 0.9, 0.3)}) {
                const float across = roughness * roughness, along = alpha_along(roughness, anisotropy);
                const dvec3 eye = glm::normalize(towards);
                const Sent walked = by_walk(static_cast<double>(along), static_cast<double>(across), eye, 100000);
                Layers layers{};
                layers.anisotropy = anisotropy;
                layers.tangent = glm::vec3(1, 0, 0);
                const Lobe alone = make_lobe(kUp, glm::vec3(eye), glm::vec3(0.0f), kWhite, across);
                const auto sent = [&](const Lobe& lobe) {
                    return by_formula([&](const glm::vec3& l) { return shade_layered_lobe(lobe, l, roughness, layers); });
                };
                const Sent all = sent(with_light_along_grain(alone, roughness, layers.tangent, anisotropy));
                EXPECT_LT(error(all, walked), 0.19) << roughness << " " << anisotropy << " " << eye.x << " " << eye.z;
                EXPECT_NEAR(total(all), 1.0, 0.09) << roughness << " " << anisotropy << " " << eye.x << " " << eye.z;
                EXPECT_GT(error(sent(alone), walked), 1.5 * error(all, walked)) << roughness << " " << anisotropy << " " << eye.x << " " << eye.z;
            }
        }
    }
}

// What a film sends from facet to facet has the mean of its colours, not those of the half vector.
TEST(FacetWalk, AThinFilmSendsOnTheMeanOfItsColours)
{
    const ThinFilm film{1.0f, 1.4f, 380.0f, glm::vec3(0.6f)};
    const float roughness = 0.6f, alpha = roughness * roughness;
    double most_saved = 0.0;
    for (const double up : {0.5, 0.9}) {
        const dvec3 eye(std::sqrt(1.0 - up * up), 0.0, up);
        std::array<Sent, 3> walked{};
        Walk walk(static_cast<double>(alpha), static_cast<double>(alpha));
        const int walks = 400000;
        for (int i = 0; i < walks; ++i) {
            glm::vec3 left(1.0f);
            const dvec3 w = walk(eye, [&](double cosine) { left *= thin_film_fresnel(film.ior, film.thickness_nm, film.f0, static_cast<float>(cosine)); });
            if (w.z <= 0.0) continue;
            for (int c = 0; c < 3; ++c) walked[static_cast<std::size_t>(c)][bin(w)] += static_cast<double>(left[c]) / walks;
        }
        for (int c = 0; c < 3; ++c) {
            const auto sent = [&](bool by_mean) {
                return by_formula([&](const glm::vec3& l) {
                    const glm::vec3 f0 = filmed_f0(film, glm::dot(half_vector(glm::vec3(eye), l), l));
                    Lobe lobe = with_all_light(make_lobe(kUp, glm::vec3(eye), glm::vec3(0.0f), by_mean ? filmed_mean_f0(film) : f0, alpha), roughness, lost_along_lobe(roughness));
                    lobe.f0 = f0;
                    return glm::vec3(shade_lobe(lobe, l)[c]);
                });
            };
            const Sent& truth = walked[static_cast<std::size_t>(c)];
            const double by_mean = error(sent(true), truth), by_half = error(sent(false), truth);
            EXPECT_LT(by_mean, 0.09) << up << " " << c;
            EXPECT_LT(by_mean, by_half) << up << " " << c;
            most_saved = std::max(most_saved, by_half - by_mean);
        }
    }
    EXPECT_GT(most_saved, 0.04);
}

}  // namespace
}  // namespace petrichor::shared
