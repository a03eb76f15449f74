#include "film/jobs/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "scene/shapes.h"

namespace petrichor::film {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kFramingFov_rad = 35.0 * kDegree;
constexpr double kThingElevation_rad = 14.0 * kDegree;  // by eye: the horizon is a tenth below the picture's upper edge
constexpr double kThing = 0.35, kLand = 0.15;  // height over width of what is no land, and of what is
constexpr double kLandFrom_m = 15.0, kLand_m = 40.0;  // and how wide
constexpr double kLandShare = 0.75;  // of a land's points that are seen at least
constexpr double kHorizon = 0.62;  // of the way from the middle of the picture to its upper edge
constexpr double kDefaultFov_rad = 45.0 * kDegree;

// Path of one attribute of the keys.
template <class Get>
std::vector<PathKey> path_of(const std::vector<CameraKey>& keys, Get get)
{
    std::vector<PathKey> path;
    for (const CameraKey& key : keys) path.push_back({key.time_s, get(key)});
    return path;
}

const scene::Camera& named_camera(const scene::Scene& scene, const std::string& name)
{
    std::vector<std::string> names;
    for (const scene::Camera& camera : scene.cameras) {
        if (camera.name == name) return camera;
        names.push_back(camera.name);
    }
    throw Error("camera: the scene " + scene.name + " has no camera \"" + name + "\"." +
                    did_you_mean(name, names),
                names.empty()
                    ? "Leave the name out: the scene has no cameras and is framed as a whole."
                    : "Use one of: " + join_words(names) + ".");
}

// The direction that a framing camera looks from, and how far it sees to its sides.
struct View {
    View(double elevation_rad, double tan_up, double tan_side) : tan_y(tan_up), tan_x(tan_side)
    {
        const double azimuth = -30.0 * kDegree;
        back = {std::sin(azimuth) * std::cos(elevation_rad), std::sin(elevation_rad),
                std::cos(azimuth) * std::cos(elevation_rad)};
        right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
        up = glm::cross(back, right);
    }

    // From the point looked at, so that a place (relative to it) just touches the edge of the frame.
    [[nodiscard]] double distance_to_see(const glm::dvec3& place) const
    {
        return glm::dot(place, back) + std::max(std::abs(glm::dot(place, up)) / tan_y,
                                                std::abs(glm::dot(place, right)) / tan_x);
    }

    double tan_y, tan_x;
    glm::dvec3 back, right, up;
};

glm::dvec3 middle_of(const std::vector<glm::vec3>& points)
{
    glm::dvec3 middle;
    std::vector<float> values(points.size());
    for (int i = 0; i < 3; ++i) {
        std::transform(points.begin(), points.end(), values.begin(), [i](const glm::vec3& p) { return p[i]; });
        const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), half, values.end());
        middle[i] = static_cast<double>(*half);
    }
    return middle;
}

// How far from the middle a camera among the points stands: it sees most of them, and none of them is around or above it.
double distance_among(const std::vector<glm::vec3>& points, const glm::dvec3& middle, const View& view)
{
    std::vector<double> distances;
    for (const glm::vec3& point : points) {
        distances.push_back(view.distance_to_see(glm::dvec3(point) - middle));
    }
    std::sort(distances.begin(), distances.end());
    double distance = distances.back();
    for (double share = kLandShare; share < 1.0; share += 0.05) {
        distance = distances[static_cast<std::size_t>(share * static_cast<double>(distances.size()))];
        const glm::dvec3 eye = middle + view.back * distance;
        const bool free = std::none_of(points.begin(), points.end(), [&](const glm::vec3& point) {
            const glm::dvec3 to = glm::dvec3(point) - eye;
            return std::hypot(to.x, to.z) < 0.1 * distance && to.y > -0.05 * distance;
        });
        if (free) return distance;
    }
    return std::max(distance, distances.back());
}

}  // namespace

scene::Bounds content_bounds(const scene::Scene& scene)
{
    const scene::Bounds all = scene::scene_bounds(scene);
    std::array<std::vector<float>, 3> axes;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                const auto world = glm::vec3(instance.to_world * glm::vec4(position, 1.0f));
                for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)].push_back(world[i]);
            }
        }
    }
    if (axes[0].size() < 100) return all;
    scene::Bounds middle;
    for (int i = 0; i < 3; ++i) {
        auto& values = axes[static_cast<std::size_t>(i)];
        const auto cut = static_cast<std::ptrdiff_t>(values.size() / 50);
        std::nth_element(values.begin(), values.begin() + cut, values.end());
        middle.low[i] = values[static_cast<std::size_t>(cut)];
        std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
        middle.high[i] = *(values.end() - 1 - cut);
    }
    const bool few_far_points =
        glm::length(middle.high - middle.low) < 0.4f * glm::length(all.high - all.low);
    if (!few_far_points) return all;
    // Who puts a shape there wants to see it.
    for (const scene::MarchedShape& shape : scene.shapes) {
        const scene::Bounds reach = shape.reach.value_or(scene::shape_bounds(shape, shape.rest));
        middle.low = glm::min(middle.low, reach.low);
        middle.high = glm::max(middle.high, reach.high);
    }
    return middle;
}

scene::Camera camera_towards(const glm::dvec3& position_m, const glm::dvec3& look_at_m,
                             double fov_rad)
{
    const glm::dvec3 away = position_m - look_at_m;
    const double distance = glm::length(away);
    const glm::dvec3 back = distance > 0.0 ? away / distance : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 up_hint =
        std::abs(back.y) > 0.9999 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up_hint, back));
    const glm::dvec3 up = glm::cross(back, right);
    scene::Camera camera;
    camera.to_world =
        glm::mat4(glm::vec4(glm::vec3(right), 0.0f), glm::vec4(glm::vec3(up), 0.0f),
                  glm::vec4(glm::vec3(back), 0.0f), glm::vec4(glm::vec3(position_m), 1.0f));
    camera.vertical_fov_rad = static_cast<float>(fov_rad);
    return camera;
}

Framing framing_of(const scene::Scene& scene)
{
    constexpr std::size_t kPoints = 8192;
    Framing framing{content_bounds(scene), {}};
    std::size_t count = 0;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            count += primitive.positions.size();
        }
    }
    const std::size_t step = count / kPoints + 1;
    std::size_t index = 0;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                if (index++ % step != 0) continue;
                const auto world = glm::vec3(instance.to_world * glm::vec4(position, 1.0f));
                const bool inside =
                    glm::all(glm::greaterThanEqual(world, framing.bounds.low)) &&
                    glm::all(glm::lessThanEqual(world, framing.bounds.high));
                if (inside) framing.points.push_back(world);
            }
        }
    }
    return framing;
}

scene::Camera framing_camera(const Framing& framing, double aspect)
{
    glm::dvec3 low(framing.bounds.low);
    glm::dvec3 high(framing.bounds.high);
    if (!(glm::length(high - low) > 0.0)) {
        low = glm::dvec3(-0.5);
        high = glm::dvec3(0.5);
    }
    // Below the horizon, which is in the picture: without it ground is an endless sheet. A land is seen from lower, as a
    // photographer would take it.
    const glm::dvec3 size = high - low;
    const double width = std::max(size.x, size.z);
    const double land = std::clamp((kThing - size.y / width) / (kThing - kLand), 0.0, 1.0) *
                        std::clamp((width - kLandFrom_m) / (kLand_m - kLandFrom_m), 0.0, 1.0);
    const double tan_y = std::tan(0.5 * kFramingFov_rad);
    const View view(glm::mix(kThingElevation_rad, std::atan(kHorizon * tan_y), land), tan_y, tan_y * aspect);
    glm::dvec3 centre = 0.5 * (low + high);
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                           corner & 4 ? high.z : low.z);
        distance = std::max(distance, view.distance_to_see(p - centre));
    }
    if (land > 0.0 && !framing.points.empty()) {
        const glm::dvec3 middle = middle_of(framing.points);
        centre = glm::mix(centre, middle, land);
        distance = glm::mix(distance, distance_among(framing.points, centre, view), land);
    }
    distance *= 1.05;  // a little air around it
    scene::Camera camera = camera_towards(centre + view.back * distance, centre, kFramingFov_rad);
    camera.name = "framed";
    camera.near_m = static_cast<float>(std::max(1e-4, distance * 0.002));
    return camera;
}

scene::Camera camera_at(const ScenarioCamera& camera, const scene::Scene& scene,
                        const Framing& framing, double aspect, double time_s)
{
    scene::Camera result;
    const bool placed = !camera.keys.empty() && camera.keys.front().position_m.has_value();
    if (placed) {
        const auto position =
            path_of(camera.keys, [](const CameraKey& key) { return *key.position_m; });
        const auto target =
            path_of(camera.keys, [](const CameraKey& key) { return *key.look_at_m; });
        const auto fov = path_of(camera.keys, [](const CameraKey& key) {
            return glm::dvec3(key.fov_degrees ? *key.fov_degrees * kDegree : kDefaultFov_rad, 0.0,
                              0.0);
        });
        result = camera_towards(point_at(position, camera.interpolation, time_s),
                                point_at(target, camera.interpolation, time_s),
                                point_at(fov, camera.interpolation, time_s).x);
        result.name = "scenario";
    } else if (!camera.name.empty()) {
        result = named_camera(scene, camera.name);
    } else if (!scene.cameras.empty()) {
        result = scene.cameras.front();
    } else {
        result = framing_camera(framing, aspect);
    }
    if (!placed && !camera.keys.empty() && camera.keys.front().fov_degrees) {
        result.vertical_fov_rad = static_cast<float>(*camera.keys.front().fov_degrees * kDegree);
    }
    if (camera.near_m) result.near_m = static_cast<float>(*camera.near_m);
    result.shift = glm::vec2(camera.shift);
    return result;
}

}  // namespace petrichor::film
