#include "demo/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace petrichor::demo {

using glm::vec2;
using glm::vec3;

std::uint32_t MeshBuilder::add_vertex(const vec3& position, const vec3& normal, const vec2& uv_m)
{
    primitive_.positions.push_back(position);
    primitive_.normals.push_back(normal);
    primitive_.uv0.push_back((uv_m + uv_offset_m) * (uv_scale / tile_m_));
    primitive_.colors.push_back(color);
    primitive_.weather.push_back(weather);
    return static_cast<std::uint32_t>(primitive_.positions.size() - 1);
}

void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    const std::vector<vec3>& p = primitive_.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;  // the apex of a lathe or a fan
    primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
}

// u and v (down) in the plane of a face, so that u x -v = normal.
void MeshBuilder::face_uv_axes(const vec3& normal, const vec3& up, vec3& u, vec3& v) const
{
    vec3 w = up - normal * glm::dot(up, normal);
    if (glm::dot(w, w) < 1e-4f) {
        const vec3 other = std::abs(normal.z) < 0.9f ? vec3(0, 0, -1) : vec3(1, 0, 0);
        w = other - normal * glm::dot(other, normal);
    }
    w = glm::normalize(w);
    u = glm::cross(w, normal);
    v = -w;
}

void MeshBuilder::quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d, const vec3& up)
{
    const vec3 normal = glm::normalize(glm::cross(c - a, d - b));
    vec3 u, v;
    face_uv_axes(normal, up, u, v);
    std::array<std::uint32_t, 4> corner{};
    std::size_t k = 0;
    for (const vec3& p : {a, b, c, d}) {
        corner[k++] = add_vertex(p, normal, vec2(glm::dot(p, u), glm::dot(p, v)));
    }
    add_triangle(corner[0], corner[1], corner[2]);
    add_triangle(corner[0], corner[2], corner[3]);
}

void MeshBuilder::triangle(const vec3& a, const vec3& b, const vec3& c, const vec3& up)
{
    const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    vec3 u, v;
    face_uv_axes(normal, up, u, v);
    std::array<std::uint32_t, 3> corner{};
    std::size_t k = 0;
    for (const vec3& p : {a, b, c}) {
        corner[k++] = add_vertex(p, normal, vec2(glm::dot(p, u), glm::dot(p, v)));
    }
    add_triangle(corner[0], corner[1], corner[2]);
}

void MeshBuilder::box(const BoxShape& shape)
{
    const float bevel = std::min(
        shape.bevel_m, 0.49f * 2.0f * std::min({shape.half.x, shape.half.y, shape.half.z}));
    vec3 along(0.0f);
    along[shape.grain] = 1.0f;
    const auto to_world = [&](const vec3& local) { return shape.centre + shape.axes * local; };
    const auto emit = [&](const vec3& local, const vec3& local_normal, const vec3& u,
                          const vec3& v) {
        return add_vertex(to_world(local), glm::normalize(shape.axes * local_normal),
                          vec2(glm::dot(local, u), glm::dot(local, v)));
    };
    // Where the corner (sx, sy, sz) lies on the face across `axis`: full there, inset on the
    // others.
    const auto corner_on = [&](const vec3& sign, int axis) {
        vec3 p = sign * (shape.half - vec3(bevel));
        p[axis] = sign[axis] * shape.half[axis];
        return p;
    };
    const auto axis_vector = [](int axis, float sign) {
        vec3 n(0.0f);
        n[axis] = sign;
        return n;
    };
    // Triangles are wound by asking which way they face, which keeps the cases few.
    const auto face = [&](std::array<std::uint32_t, 4> q, int count, const vec3& outward) {
        const vec3 out = shape.axes * outward;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const vec3 n = glm::cross(primitive_.positions[b] - primitive_.positions[a],
                                      primitive_.positions[c] - primitive_.positions[a]);
            if (glm::dot(n, out) >= 0.0f) {
                add_triangle(a, b, c);
            } else {
                add_triangle(a, c, b);
            }
        };
        add(q[0], q[1], q[2]);
        if (count == 4) add(q[0], q[2], q[3]);
    };

    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3;
        const int c = (axis + 2) % 3;
        for (const float sign : {-1.0f, 1.0f}) {
            const vec3 normal = axis_vector(axis, sign);
            vec3 u, v;
            face_uv_axes(normal, along, u, v);
            const auto corner = [&](float sb, float sc) {
                vec3 s(0.0f);
                s[axis] = sign;
                s[b] = sb;
                s[c] = sc;
                return emit(corner_on(s, axis), normal, u, v);
            };
            face({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, 4, normal);
        }
        if (bevel <= 0.0f) continue;
        // The four edges that run along `axis`, textured like the face across b.
        for (const float sb : {-1.0f, 1.0f}) {
            for (const float sc : {-1.0f, 1.0f}) {
                const vec3 nb = axis_vector(b, sb);
                const vec3 nc = axis_vector(c, sc);
                vec3 u, v;
                face_uv_axes(nb, along, u, v);
                std::array<std::uint32_t, 4> q{};
                std::size_t k = 0;
                for (const float sa : {-1.0f, 1.0f}) {
                    vec3 s(0.0f);
                    s[axis] = sa;
                    s[b] = sb;
                    s[c] = sc;
                    const std::uint32_t on_b = emit(corner_on(s, b), nb, u, v);
                    const std::uint32_t on_c = emit(corner_on(s, c), nc, u, v);
                    q[k++] = sa < 0.0f ? on_b : on_c;
                    q[k++] = sa < 0.0f ? on_c : on_b;
                }
                face(q, 4, nb + nc);
            }
        }
    }
    if (bevel <= 0.0f) return;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 s((corner & 1) != 0 ? 1.0f : -1.0f, (corner & 2) != 0 ? 1.0f : -1.0f,
                     (corner & 4) != 0 ? 1.0f : -1.0f);
        vec3 u, v;
        face_uv_axes(axis_vector(0, s.x), along, u, v);
        std::array<std::uint32_t, 4> q{};
        for (int axis = 0; axis < 3; ++axis) {
            q[static_cast<std::size_t>(axis)] =
                emit(corner_on(s, axis), axis_vector(axis, s[axis]), u, v);
        }
        face(q, 3, s);
    }
}

void MeshBuilder::beam(const vec3& from, const vec3& to, float width_m, float height_m,
                       float bevel_m, const vec3& side)
{
    const vec3 y = glm::normalize(to - from);
    vec3 z = side - y * glm::dot(side, y);
    if (glm::dot(z, z) < 1e-4f)
        z = std::abs(y.x) < 0.9f ? vec3(1, 0, 0) - y * y.x : vec3(0, 0, 1) - y * y.z;
    z = glm::normalize(z);
    const vec3 x = glm::cross(y, z);
    box({.centre = 0.5f * (from + to),
         .half = vec3(0.5f * width_m, 0.5f * glm::length(to - from), 0.5f * height_m),
         .bevel_m = bevel_m,
         .axes = glm::mat3(x, y, z),
         .grain = 1});
}

void MeshBuilder::grid(int columns, int rows, const std::function<Point(int, int)>& point)
{
    const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
    const glm::vec4 kept_color = color;
    const glm::vec4 kept_weather = weather;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const Point p = point(i, j);
            color = p.color;
            weather = p.weather;
            add_vertex(p.position, p.normal, p.uv_m);
        }
    }
    color = kept_color;
    weather = kept_weather;
    const auto at = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (columns + 1) + i);
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const std::array<std::uint32_t, 4> q = {at(i, j), at(i + 1, j), at(i + 1, j + 1),
                                                    at(i, j + 1)};
            const vec3 n = glm::cross(primitive_.positions[q[2]] - primitive_.positions[q[0]],
                                      primitive_.positions[q[3]] - primitive_.positions[q[1]]);
            if (glm::dot(n, primitive_.normals[q[0]] + primitive_.normals[q[2]]) >= 0.0f) {
                add_triangle(q[0], q[1], q[2]);
                add_triangle(q[0], q[2], q[3]);
            } else {
                add_triangle(q[0], q[2], q[1]);
                add_triangle(q[0], q[3], q[2]);
            }
        }
    }
}

void MeshBuilder::lathe(const vec3& foot, const std::vector<vec2>& profile, int sides,
                        const glm::mat3& axes)
{
    assert(profile.size() >= 2);
    const int rows = static_cast<int>(profile.size()) - 1;
    std::vector<float> along(profile.size(), 0.0f);
    float widest = 0.0f;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        widest = std::max(widest, profile[i].x);
        if (i > 0) along[i] = along[i - 1] + glm::length(profile[i] - profile[i - 1]);
    }
    // Each segment has its own normals where the outline bends by more than 50 degrees.
    for (int j = 0; j < rows; ++j) {
        const auto k = static_cast<std::size_t>(j);
        const vec2 a = profile[k];
        const vec2 b = profile[k + 1];
        const auto outward = [](const vec2& from, const vec2& to) {
            const vec2 d = to - from;
            const float n = glm::length(d);
            return n > 1e-6f ? vec2(d.y, -d.x) / n : vec2(1.0f, 0.0f);
        };
        const vec2 here = outward(a, b);
        vec2 start = here;
        vec2 end = here;
        if (k > 0) {
            const vec2 before = outward(profile[k - 1], a);
            if (glm::dot(before, here) > 0.64f) start = glm::normalize(before + here);
        }
        if (k + 2 < profile.size()) {
            const vec2 after = outward(b, profile[k + 2]);
            if (glm::dot(after, here) > 0.64f) end = glm::normalize(after + here);
        }
        grid(sides, 1, [&](int i, int row) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
            const vec2 p = row == 0 ? a : b;
            const vec2 n = row == 0 ? start : end;
            const float c = std::cos(angle);
            const float s = std::sin(angle);
            return Point{foot + axes * vec3(p.x * c, p.y, -p.x * s),
                         glm::normalize(axes * vec3(n.x * c, n.y, -n.x * s)),
                         vec2(angle * widest, -along[k + static_cast<std::size_t>(row)]), color,
                         weather};
        });
    }
}

void MeshBuilder::tube(const std::vector<vec3>& path, const std::vector<float>& radius_m, int sides)
{
    assert(path.size() >= 2 && radius_m.size() == path.size());
    const int rows = static_cast<int>(path.size()) - 1;
    std::vector<glm::mat3> frames;
    vec3 side(0.0f);
    std::vector<float> along(path.size(), 0.0f);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const vec3 before = i > 0 ? glm::normalize(path[i] - path[i - 1]) : vec3(0.0f);
        const vec3 after = i + 1 < path.size() ? glm::normalize(path[i + 1] - path[i]) : vec3(0.0f);
        const vec3 forward = glm::normalize(before + after);
        if (i == 0) side = std::abs(forward.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
        side = glm::normalize(side - forward * glm::dot(side, forward));  // carried along, no twist
        frames.emplace_back(side, glm::cross(forward, side), forward);
        if (i > 0) along[i] = along[i - 1] + glm::length(path[i] - path[i - 1]);
    }
    grid(sides, rows, [&](int i, int j) {
        const auto k = static_cast<std::size_t>(j);
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
        const vec3 n = frames[k][0] * std::cos(angle) + frames[k][1] * std::sin(angle);
        return Point{path[k] + radius_m[k] * n, n, vec2(angle * radius_m[0], -along[k]), color,
                     weather};
    });
    for (const bool end : {false, true}) {
        const std::size_t k = end ? path.size() - 1 : 0;
        if (radius_m[k] < 1e-4f) continue;
        const vec3 normal = end ? frames[k][2] : -frames[k][2];
        const std::uint32_t middle = add_vertex(path[k], normal, vec2(0.0f));
        std::uint32_t previous = 0;
        for (int i = 0; i <= sides; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
            const vec2 flat(std::cos(angle), std::sin(angle));
            const std::uint32_t now =
                add_vertex(path[k] + radius_m[k] * (frames[k][0] * flat.x + frames[k][1] * flat.y),
                           normal, radius_m[k] * flat);
            if (i > 0) {
                if (end) {
                    add_triangle(middle, previous, now);
                } else {
                    add_triangle(middle, now, previous);
                }
            }
            previous = now;
        }
    }
}

void MeshBuilder::tube(const std::vector<vec3>& path, float radius_m, int sides)
{
    tube(path, std::vector<float>(path.size(), radius_m), sides);
}

scene::Primitive MeshBuilder::take(std::uint32_t material)
{
    const auto all_one = [](const std::vector<glm::vec4>& values) {
        return std::all_of(values.begin(), values.end(),
                           [](const glm::vec4& v) { return v == glm::vec4(1.0f); });
    };
    scene::Primitive result = std::move(primitive_);
    primitive_ = {};
    result.material = material;
    if (all_one(result.colors)) result.colors.clear();
    if (all_one(result.weather)) result.weather.clear();
    return result;
}

}  // namespace petrichor::demo
