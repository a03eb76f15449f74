#include "cli/scene/lamp_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/light_lines.h"

namespace petrichor::cli {
namespace {

// A run of points on the picture, in pixels.
struct Segment {
    glm::vec2 from, to;
};

class Screen {
public:
    Screen(const scene::Camera& camera, int width, int height)
        : from_world_(glm::inverse(camera.to_world)), half_(scene::half_extent_m(camera, width, height)),
          shift_(camera.shift), size_(width, height), near_m_(std::max(camera.near_m, 1.0e-3f)),
          orthographic_(camera.orthographic_height_m > 0.0f)
    {
    }

    // What of a line lies before the eye.
    std::optional<Segment> operator()(const glm::vec3& a, const glm::vec3& b) const
    {
        glm::vec3 from(from_world_ * glm::vec4(a, 1.0f)), to(from_world_ * glm::vec4(b, 1.0f));
        if (from.z > to.z) std::swap(from, to);  // `from` is farther away
        if (from.z > -near_m_) return {};
        if (to.z > -near_m_) to = glm::mix(from, to, (-near_m_ - from.z) / (to.z - from.z));
        return Segment{pixel(from), pixel(to)};
    }

private:
    glm::vec2 pixel(const glm::vec3& p) const
    {
        const glm::vec2 at = glm::vec2(p) / half_ / (orthographic_ ? 1.0f : -p.z) - shift_;
        return glm::vec2(at.x * 0.5f + 0.5f, 0.5f - at.y * 0.5f) * size_;
    }

    glm::mat4 from_world_;
    glm::vec2 half_, shift_, size_;
    float near_m_;
    bool orthographic_;
};

void draw(Pixels& pixels, int height, const Segment& s, const glm::vec3& color, float width)
{
    const float reach = 0.5f * width + 1.0f;
    // A line may end far beside the picture.
    const auto first = [&](float v) { return static_cast<int>(std::clamp(v - reach, 0.0f, 1.0e6f)); };
    const auto last = [&](float v, int limit) {
        return static_cast<int>(std::ceil(std::clamp(v + reach, -1.0f, static_cast<float>(limit - 1))));
    };
    const glm::vec2 way = s.to - s.from;
    const float square = std::max(glm::dot(way, way), 1.0e-6f);
    for (int y = first(std::min(s.from.y, s.to.y)); y <= last(std::max(s.from.y, s.to.y), height); ++y) {
        for (int x = first(std::min(s.from.x, s.to.x)); x <= last(std::max(s.from.x, s.to.x), pixels.width); ++x) {
            const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const float along = std::clamp(glm::dot(at - s.from, way) / square, 0.0f, 1.0f);
            const float apart = glm::length(at - s.from - way * along);
            const float covers = std::clamp(0.5f * width + 0.5f - apart, 0.0f, 1.0f);
            if (covers <= 0.0f) continue;
            std::uint8_t* out = pixels.rgb.data() +
                                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) +
                                     static_cast<std::size_t>(x));
            for (int c = 0; c < 3; ++c) {
                const float before = static_cast<float>(out[c]);
                out[c] = static_cast<std::uint8_t>(before + (255.0f * color[c] - before) * covers + 0.5f);
            }
        }
    }
}

}  // namespace

void draw_lamps(Pixels& pixels, int height, const scene::Scene& scene, const scene::Camera& camera)
{
    const Screen screen(camera, pixels.width, height);
    std::vector<Segment> segments;
    for (const scene::Light& light : scene.lights) {
        for (const auto& line : scene::light_lines(light)) {
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                if (const auto segment = screen(line[i], line[i + 1])) segments.push_back(*segment);
            }
        }
    }
    // A dark rim first: they are seen on any ground.
    for (const Segment& s : segments) draw(pixels, height, s, {0.05f, 0.05f, 0.08f}, 3.4f);
    for (const Segment& s : segments) draw(pixels, height, s, {1.0f, 0.86f, 0.2f}, 1.6f);
}

}  // namespace petrichor::cli
