#include "gpu/frame/view.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

namespace {

struct Axes {
    glm::vec3 position, right, up, forward;
};

// The camera's frame without the scale that a node may carry.
Axes axes_of(const Camera& camera)
{
    const glm::mat4& m = camera.to_world;
    Axes axes;
    axes.position = glm::vec3(m[3]);
    axes.forward = -glm::normalize(glm::vec3(m[2]));
    axes.right = glm::normalize(glm::cross(axes.forward, glm::vec3(m[1])));
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

// Distances along the view axis between which the scene lies.
glm::vec2 depth_range_m(const Axes& axes, const Bounds& scene)
{
    glm::vec2 range(1e30f, -1e30f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? scene.high.x : scene.low.x,
                          (corner & 2) ? scene.high.y : scene.low.y,
                          (corner & 4) ? scene.high.z : scene.low.z);
        const float along = glm::dot(p - axes.position, axes.forward);
        range.x = std::min(range.x, along);
        range.y = std::max(range.y, along);
    }
    return range;
}

float far_m(const Axes& axes, const Camera& camera, const Bounds& scene)
{
    return std::max(depth_range_m(axes, scene).y * 1.01f, camera.near_m * 4.0f);
}

// What the maps from above cover: a small scene whole, else the surroundings of the camera.
struct Window {
    glm::vec3 centre_m;
    float radius_m;
};
Window window_of(const Axes& axes, const Bounds& scene)
{
    const float reach = 40.0f;
    const float scene_radius = 0.5f * glm::length(scene.high - scene.low);
    if (scene_radius <= reach * 1.2f) {
        return {0.5f * (scene.low + scene.high), std::max(scene_radius, 1e-3f)};
    }
    glm::vec3 level(axes.forward.x, 0.0f, axes.forward.z);
    if (glm::length(level) > 1e-3f) level = glm::normalize(level);
    const glm::vec3 ahead = axes.position + level * (0.6f * reach);
    // Steps of four metres: the maps are kept while the camera moves less.
    return {glm::round(ahead * 0.25f) * 4.0f, reach};
}

}  // namespace

glm::vec2 sample_offset(std::uint32_t index, std::uint32_t seed)
{
    if (index == 0) return glm::vec2(0.0f);
    // A rank-1 lattice by the plastic number: even over any count. The seed picks where it starts.
    const double start = static_cast<double>(seed % 4096u) * 0.618033988749895;
    const double i = static_cast<double>(index) + start;
    const auto within_pixel = [](double x) { return static_cast<float>(x - std::floor(x)) - 0.5f; };
    return {within_pixel(0.7548776662466927 * i), within_pixel(0.5698402909980532 * i)};
}

glm::vec2 lens_offset(std::uint32_t index, int count, std::uint32_t seed)
{
    if (index == 0) return glm::vec2(0.0f);
    // A spiral by the golden angle: rings of the same area hold the same number.
    const float radius = std::sqrt(static_cast<float>(index) / static_cast<float>(std::max(count, 1)));
    const float turn = 2.39996323f * static_cast<float>(index) + static_cast<float>(seed % 4096u);
    return radius * glm::vec2(std::cos(turn), std::sin(turn));
}

glm::vec3 lamp_offset_m(const Light& lamp, std::uint32_t index, int count, std::uint32_t seed)
{
    if (index == 0) return glm::vec3(0.0f);
    const double start = static_cast<double>(seed % 4096u) * 0.618033988749895;
    const double i = static_cast<double>(index) + start;
    const auto part = [](double x) { return static_cast<float>(x - std::floor(x)); };
    // A lattice in three dimensions (Roberts 2018).
    const glm::vec3 u(part(0.8191725133961645 * i), part(0.6710436067037893 * i),
                      part(0.5497004779019703 * i));
    if (lamp.kind == LightKind::Rectangle)
        return lamp.half_u_m * (2.0f * u.x - 1.0f) + lamp.half_v_m * (2.0f * u.y - 1.0f);
    if (lamp.kind == LightKind::Spot) {
        const glm::vec2 disc = lens_offset(index, count, seed) * lamp.radius_m;
        return lamp.up * disc.x + glm::cross(lamp.direction, lamp.up) * disc.y;
    }
    // Within a ball so that it is an even disc from every side: r is the sine of an angle whose sine
    // squared is its density.
    float angle = 0.5f * 3.14159265f * std::cbrt(u.x);
    for (int step = 0; step < 8; ++step) {
        const float sine = std::sin(angle);
        const float off = angle - sine * std::cos(angle) - u.x * 0.5f * 3.14159265f;
        angle = std::clamp(angle - off / std::max(2.0f * sine * sine, 1.0e-3f), 0.0f, 1.5707963f);
    }
    const float up = 2.0f * u.y - 1.0f;
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    const float turn = 6.2831853f * u.z;
    glm::vec3 at = glm::vec3(level * std::cos(turn), up, level * std::sin(turn)) *
                   (std::sin(angle) * lamp.radius_m);
    if (lamp.length_m > 0.0f) at += lamp.up * (lamp.length_m * (part(0.618033988749895 * i) - 0.5f));
    return at;
}

void set_camera(shared::FrameConstants& c, const Camera& camera, int width, int height,
                const glm::vec2& jitter, const Bounds& scene, const glm::vec2& lens_m, float focus_m)
{
    Axes axes = axes_of(camera);
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    if (camera.orthographic_height_m > 0.0f) {
        c.far_m = far_m(axes, camera, scene);
        c.flags |= FRAME_ORTHOGRAPHIC;
    }
    const glm::vec2 half = scene::half_extent_m(camera, width, height);
    glm::mat4 projection = scene::clip_projection(camera, width, height, c.far_m);
    for (int i = 0; i < 4; ++i) projection[i][1] = -projection[i][1];  // rows of a picture go down

    // Another point of the lens sees what is in focus where its middle does.
    const glm::vec3 aside = axes.right * lens_m.x + axes.up * lens_m.y;
    axes.position += aside;
    glm::mat4 refocus(1.0f);
    refocus[2][0] = -lens_m.x / focus_m;
    refocus[2][1] = -lens_m.y / focus_m;

    glm::mat4 view(1.0f);
    for (int i = 0; i < 3; ++i) {
        view[i][0] = axes.right[i];
        view[i][1] = axes.up[i];
        view[i][2] = -axes.forward[i];
    }
    view[3] = glm::vec4(-glm::dot(axes.right, axes.position), -glm::dot(axes.up, axes.position),
                        glm::dot(axes.forward, axes.position), 1.0f);
    // The picture moves against the jitter, so that each pixel sees its sample at the centre.
    glm::mat4 shift(1.0f);
    shift[3][0] = -2.0f * jitter.x / w;
    shift[3][1] = -2.0f * jitter.y / h;
    c.world_to_clip = shift * projection * view;
    if (lens_m != glm::vec2(0.0f)) c.world_to_clip = shift * projection * refocus * view;

    c.camera_m = axes.position;
    c.forward = axes.forward;
    c.near_m = camera.near_m;
    c.ray_dx = axes.right * (2.0f * half.x / w);
    c.ray_dy = -axes.up * (2.0f * half.y / h);
    const glm::vec2 middle = half * camera.shift;
    const glm::vec3 corner = axes.right * (middle.x - half.x) + axes.up * (middle.y + half.y) +
                             c.ray_dx * jitter.x + c.ray_dy * jitter.y;
    c.ray_corner = axes.forward + corner;
    if (lens_m != glm::vec2(0.0f)) c.ray_corner -= aside / focus_m;
    c.origin_corner = axes.position + corner;
    c.pixel_angle = 2.0f * half.y / h;
    c.size = glm::ivec2(width, height);
}

glm::vec3 cascade_ends_m(const Camera& camera, const Bounds& scene)
{
    const Axes axes = axes_of(camera);
    const float end = std::min(far_m(axes, camera, scene), 250.0f);
    const float begin =
        std::max(camera.near_m, std::max(depth_range_m(axes, scene).x, 0.02f * end));
    glm::vec3 ends;
    for (int i = 0; i < SHADOW_CASCADES; ++i) {
        const float t = static_cast<float>(i + 1) / SHADOW_CASCADES;
        const float logarithmic = begin * std::pow(end / begin, t);
        const float even = begin + (end - begin) * t;
        ends[i] = 0.75f * logarithmic + 0.25f * even;
    }
    return ends;
}

namespace {

// Drops and flakes whose middle lies beside the view, metres.
constexpr float kBeside_m = 0.3f;

// Of the slice of the view from `begin` to `end` metres: the sphere around it, whose size does not change as the camera turns.
// It is asked up to `until`.
DepthView slice_view(const Camera& camera, float aspect, const glm::vec3& to_sun, const Bounds& scene,
                     float begin, float end, float until)
{
    const Axes axes = axes_of(camera);
    const float half_y = scene::half_extent_m(camera, 1, 1).y;
    // Where a lens is shifted, the sphere lies around the axis all the same and holds what is farthest from it.
    const glm::vec2 farthest = 1.0f + glm::abs(camera.shift);
    const float k = half_y * half_y * (farthest.y * farthest.y + aspect * aspect * farthest.x * farthest.x);
    float along;
    float radius;
    if (camera.orthographic_height_m > 0.0f) {
        along = 0.5f * (begin + end);
        radius = std::sqrt(k + 0.25f * (end - begin) * (end - begin));
    } else {
        along = std::min(0.5f * (begin + end) * (1.0f + k), end);
        radius = std::sqrt((end - along) * (end - along) + k * end * end);
    }
    const float scene_radius = 0.5f * glm::length(scene.high - scene.low);
    glm::vec3 centre = axes.position + axes.forward * along;
    if (scene_radius < radius) {  // a small scene: no texels are spent around it
        centre = 0.5f * (scene.low + scene.high);
        radius = scene_radius;
    }
    DepthView view = orthographic_view(-to_sun, centre, std::max(radius, 1e-3f), scene, kShadowMapSize);
    std::array<glm::vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const float away = (i & 1) ? until : begin;
        const glm::vec2 side(i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
        const float wide = camera.orthographic_height_m > 0.0f ? half_y : half_y * away;
        const glm::vec2 at = (side + camera.shift) * glm::vec2(aspect * wide, wide);
        corners[i] = axes.position + axes.forward * away + axes.right * at.x + axes.up * at.y;
    }
    view.asked = asked_part(view, corners, kBeside_m);
    return view;
}

}  // namespace

std::array<DepthView, SHADOW_CASCADES> cascade_views(const Camera& camera, float aspect,
                                                     const glm::vec3& to_sun, const Bounds& scene)
{
    const glm::vec3 ends = cascade_ends_m(camera, scene);
    const float farthest = std::max(far_m(axes_of(camera), camera, scene), ends[SHADOW_CASCADES - 1]);
    std::array<DepthView, SHADOW_CASCADES> views;
    for (int i = 0; i < SHADOW_CASCADES; ++i) {
        const float begin = i == 0 ? camera.near_m : ends[i - 1] * 0.97f;
        views[static_cast<std::size_t>(i)] =
            slice_view(camera, aspect, to_sun, scene, begin, ends[i], i + 1 < SHADOW_CASCADES ? ends[i] : farthest);
    }
    return views;
}

std::array<DepthView, SHADOW_CASCADES> coarse_views(const Camera& camera, float aspect,
                                                    const glm::vec3& to_sun, const Bounds& scene)
{
    std::array<DepthView, SHADOW_CASCADES> views;
    const float end = cascade_ends_m(camera, scene)[SHADOW_CASCADES - 1];
    views[kCoarseCascade] = slice_view(camera, aspect, to_sun, scene, camera.near_m, end,
                                       std::max(far_m(axes_of(camera), camera, scene), end));
    return views;
}

glm::vec3 sky_direction(int index)
{
    const float u = (static_cast<float>(index) + 0.5f) / SKY_DIRECTIONS;
    const float phi = 2.3999632f * static_cast<float>(index);
    const float level = std::sqrt(u);
    return {level * std::cos(phi), std::sqrt(1.0f - u), level * std::sin(phi)};
}

std::array<DepthView, SKY_DIRECTIONS> sky_views(const Camera& camera, const Bounds& scene)
{
    const Window window = window_of(axes_of(camera), scene);
    std::array<DepthView, SKY_DIRECTIONS> views;
    for (int i = 0; i < SKY_DIRECTIONS; ++i) {
        views[static_cast<std::size_t>(i)] = orthographic_view(-sky_direction(i), window.centre_m,
                                                               window.radius_m, scene, kSkyMapSize);
    }
    return views;
}

DepthView rain_view(const Camera& camera, const glm::vec3& fall_m_s, const Bounds& scene)
{
    const Axes axes = axes_of(camera);
    // Steps of a sixteenth keep the map while the wind wavers.
    glm::vec2 slope = glm::vec2(fall_m_s.x, fall_m_s.z) / std::max(-fall_m_s.y, 0.1f);
    slope *= 0.6f / std::max(glm::length(slope), 0.6f);
    slope = glm::round(slope * 16.0f) / 16.0f;
    const Window window = window_of(axes, scene);
    return orthographic_view(glm::normalize(glm::vec3(slope.x, -1.0f, slope.y)), window.centre_m,
                             window.radius_m, scene, kShelterMapSize);
}

}  // namespace petrichor::gpu
