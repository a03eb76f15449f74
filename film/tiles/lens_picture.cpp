#include "film/tiles/lens_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "formulas/color/srgb.h"
#include "formulas/color/tone_map.h"
#include "formulas/color/white_balance.h"
#include "formulas/light/wet_lens.h"
#include "formulas/noise/noise.h"
#include "gpu/frame/frame_constants.h"

namespace petrichor::film {
namespace {

glm::vec3 light_of(const std::uint16_t* halves)
{
    return {glm::unpackHalf1x16(halves[0]), glm::unpackHalf1x16(halves[1]), glm::unpackHalf1x16(halves[2])};
}

glm::vec2 mod(const glm::vec2& a, const glm::vec2& b)
{
    return a - b * glm::floor(a / b);
}

// As through_drop() of gpu/passes/resolve: the mean of a disc of the picture.
glm::vec3 through_drop(const ExposedLight& light, int x, int y, const shared::LensDrop& drop)
{
    const glm::vec2 size(light.width(), light.height());
    const glm::vec2 middle = glm::vec2(x, y) + 0.5f + drop.shift * glm::vec2(1.0f, -1.0f) * size.y;
    const float radius = 0.02f * size.y;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < 16; ++i) {
        const float turn = 2.39996323f * static_cast<float>(i);
        glm::vec2 at = middle + radius * std::sqrt((static_cast<float>(i) + 0.5f) / 16.0f) *
                                    glm::vec2(std::cos(turn), std::sin(turn));
        at = size - glm::abs(mod(at, 2.0f * size) - size);  // beyond the picture: its mirror image
        const glm::ivec2 there = glm::clamp(glm::ivec2(glm::floor(at)), glm::ivec2(0),
                                            glm::ivec2(light.width(), light.height()) - 1);
        sum += light_of(light.all() + 3 * (static_cast<std::size_t>(there.y) * static_cast<std::size_t>(light.width()) +
                                           static_cast<std::size_t>(there.x)));
    }
    return sum * (drop.bright / 16.0f);
}

}  // namespace

gpu::Frame without_lens(const gpu::Frame& frame)
{
    gpu::Frame bare = frame;
    bare.settings.exposed_light = true;
    bare.settings.bloom = 0.0f;
    bare.settings.wet_lens = 0.0f;
    bare.settings.white_balance_k = 0.0f;
    bare.settings.white_light = glm::vec3(0.0f);
    return bare;
}

LensPicture::LensPicture(const gpu::Frame& frame, const ExposedLight& light, const DisplayTransform* transform, int threads)
    : frame_(&frame), light_(&light), transform_(transform), wet_(gpu::lens_wetness(frame)),
      balanced_(gpu::is_white_balanced(frame.settings)), gains_(gpu::white_gains(frame.settings))
{
    if (frame.settings.bloom > 0.0f) glare_.emplace(light, threads);
}

glm::vec3 LensPicture::seen(int x, int y, const std::uint16_t* pixel) const
{
    glm::vec3 seen = light_of(pixel);
    if (wet_ > 0.0f) {
        const glm::vec2 size(light_->width(), light_->height());
        const glm::vec2 p = (glm::vec2(x, y) + 0.5f - 0.5f * size) / size.y;
        const shared::LensDrop drop =
            shared::lens_drops({p.x, -p.y}, wet_, static_cast<float>(frame_->settings.time_s));
        if (drop.cover > 0.0f) seen = glm::mix(seen, through_drop(*light_, x, y, drop), drop.cover);
    }
    if (glare_) seen = glm::mix(seen, glare_->at(x, y), frame_->settings.bloom);
    if (balanced_) seen = glm::max(shared::white_balanced(seen, gains_), glm::vec3(0.0f));
    return seen;
}

std::vector<std::byte> LensPicture::rows(std::size_t first, std::size_t end) const
{
    const auto width = static_cast<std::size_t>(light_->width());
    const std::vector<std::uint16_t> from = light_->rows(static_cast<int>(first), static_cast<int>(end - first));
    const gpu::FrameSettings& s = frame_->settings;
    std::vector<std::byte> rgb(from.size());
    std::vector<std::uint16_t> light;  // what a studio's own curve is given
    if (transform_) light.resize(from.size() / 3 * 4);
    for (std::size_t i = 0; i < from.size() / 3; ++i) {
        const glm::ivec2 pixel(static_cast<int>(i % width), static_cast<int>(first + i / width));
        const glm::vec3 exposed = seen(pixel.x, pixel.y, &from[3 * i]);
        if (transform_) {
            for (int c = 0; c < 3; ++c)
                light[4 * i + static_cast<std::size_t>(c)] = glm::packHalf1x16(std::min(exposed[c], 65504.0f));
            continue;
        }
        const glm::vec3 mapped = shared::display_light(static_cast<int>(s.tone_map), exposed);
        const float noise = s.dither ? shared::dither(pixel, 0u) - 0.5f : 0.0f;
        for (int c = 0; c < 3; ++c) {
            const float encoded = s.gamma ? std::clamp(exposed[c], 0.0f, 1.0f) : shared::srgb_encode(mapped[c]);
            const float code = std::clamp(encoded * 255.0f + 0.5f + noise, 0.0f, 255.0f);
            rgb[3 * i + static_cast<std::size_t>(c)] = static_cast<std::byte>(static_cast<std::uint8_t>(code));
        }
    }
    if (transform_) {
        const auto codes = transform_->picture(light, light_->width(), s.dither, static_cast<int>(first));
        for (std::size_t i = 0; i < from.size() / 3; ++i)
            for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = static_cast<std::byte>(codes[4 * i + c]);
    }
    return rgb;
}

}  // namespace petrichor::film
