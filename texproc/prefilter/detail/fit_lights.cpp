#include "texproc/prefilter/detail/fit_lights.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>

#include "texproc/prefilter/detail/lit_floor.h"

namespace petrichor::texproc::detail {

namespace {

glm::vec3 direction(float azimuth, float height)
{
    const float flat = portable_cos(height);
    return {portable_cos(azimuth) * flat, portable_sin(azimuth) * flat, portable_sin(height)};
}

// What a light of a view is drawn from (docs/textures.md, 7): the stated distribution of lights.
enum class Around { Ahead, High, Beside, Behind, Anywhere, Window, Sky };
void draw_light(FitDice& dice, Around around, bool metal, float azimuth, const glm::vec3& eye,
                std::size_t i, FitLights& to)
{
    float low = 20.0f, high = 65.0f, turned = 0.0f;
    constexpr float kAhead = 0.45f;  // radians, of a Gaussian: highlights are ahead, so most are
    if (around == Around::Beside) {
        const float side = dice(-1.0f, 1.0f) < 0.0f ? -1.0f : 1.0f;
        turned = side * dice(0.6f, 1.8f);
    } else if (around == Around::Behind) {
        turned = 0.5f * kFitTurn + dice(-1.0f, 1.0f);
    } else if (around == Around::Anywhere) {
        turned = dice(0.0f, kFitTurn);
    } else {
        turned = kAhead * dice.gaussian();
        low = around == Around::High ? 30.0f : 12.0f;
        high = around == Around::High ? 70.0f : 45.0f;
    }
    const glm::vec3 l = direction(azimuth + turned, kFitDegree * dice(low, high));
    const glm::vec3 h = glm::normalize(l + eye);
    to.lx[i] = l.x, to.ly[i] = l.y, to.lz[i] = l.z;
    to.hx[i] = h.x, to.hy[i] = h.y, to.hz[i] = h.z;
    const float m = 1.0f - std::clamp(glm::dot(l, h), 0.0f, 1.0f), m2 = m * m, rim = m2 * m2 * m;
    const float sun = around == Around::Sky ? 0.0f : 1.0f;
    const float paint = kPaintF0 + (1.0f - kPaintF0) * rim;
    to.fresnel[i] = sun * (metal ? rim : paint);
    to.fresnel_metal[i] = metal ? sun * kMetalF0 * (1.0f - rim) : 0.0f;
    to.albedo[i] = metal ? 0.0f : sun * (1.0f - paint) * kPaintAlbedo * (1.0f / shared::kPi);
    const float window = dice(0.08f, 0.14f);
    to.alpha2[i] = around == Around::Window ? window * window : 0.0f;
    // Beside half of the suns the sky gives a tenth to a third of the light; beside all that metal is
    // not ahead of, since it would be black without.
    const bool needs_sky =
        metal && (around == Around::Beside || around == Around::Behind || around == Around::Anywhere);
    const bool has_sky = needs_sky || dice(0.0f, 1.0f) < 0.5f;
    const float beside = has_sky ? dice(0.05f, 0.2f) : 0.0f;
    to.sky[i] = around == Around::Sky ? 1.0f : around == Around::Window ? 0.0f : beside;
    to.f0[i] = metal ? 0.0f : kPaintF0;
    to.f0_metal[i] = metal ? kMetalF0 : 0.0f;
    to.sky_albedo[i] = metal ? 0.0f : kPaintAlbedo * (1.0f - kPaintF0);
}

}  // namespace

void draw_fit_lights(FitDice& dice, SurfaceClass surface, float azimuth, const glm::vec3& eye, FitLights& to)
{
    using enum Around;
    for (int c = 0; c < 3; ++c) to.eye[c] = eye[c];
    std::size_t number = 0;
    const auto add = [&](bool metal, std::initializer_list<Around> one_of) {
        const Around around = *(one_of.begin() + dice.whole() % one_of.size());
        draw_light(dice, around, metal, azimuth, eye, number++, to);
    };
    if (surface == SurfaceClass::Both) {
        add(false, {Ahead});
        add(false, {Ahead, High});
        add(false, {Beside});
        add(false, {Behind});
        add(false, {Window, Window, Sky, Anywhere});
        add(true, {Ahead});
        add(true, {Ahead, High, Beside, Sky});
        add(true, {Beside, Behind, Behind, Anywhere});
        return;
    }
    const bool metal = surface == SurfaceClass::Metal;
    for (const Around around : {Ahead, Ahead, High, Beside, Behind, Window}) add(metal, {around});
    add(metal, {Anywhere, Ahead});
    add(metal, {Sky, Behind});
}

}  // namespace petrichor::texproc::detail
