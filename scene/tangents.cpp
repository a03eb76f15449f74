#include "scene/tangents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <span>

namespace petrichor::scene {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Numbers rows of N words: equal rows get the same number. An open-addressing hash table; sorting
// the rows instead took three times as long on a ship of 70 000 triangles.
template <std::size_t N>
class RowTable {
public:
    using Row = std::array<std::uint32_t, N>;

    explicit RowTable(std::size_t expected)
    {
        slots_.assign(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), kNone);
        rows_.reserve(expected);
    }
    std::size_t size() const { return rows_.size(); }

    /// The number of the row; size() - 1 when it is new.
    std::uint32_t number(const Row& row)
    {
        if (2 * rows_.size() >= slots_.size()) grow();
        std::uint32_t& slot = slot_of(row);
        if (slot == kNone) {
            slot = static_cast<std::uint32_t>(rows_.size());
            rows_.push_back(row);
        }
        return slot;
    }

private:
    std::uint32_t& slot_of(const Row& row)
    {
        std::uint64_t hash = 0;
        for (const std::uint32_t word : row) {
            hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
            hash ^= hash >> 32;
        }
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash & mask;
        while (slots_[at] != kNone && rows_[slots_[at]] != row) at = (at + 1) & mask;
        return slots_[at];
    }
    void grow()
    {
        slots_.assign(2 * slots_.size(), kNone);
        for (std::uint32_t i = 0; i < rows_.size(); ++i) slot_of(rows_[i]) = i;
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Row> rows_;
};

std::uint32_t bits(float value)
{
    return std::bit_cast<std::uint32_t>(value + 0.0f);
}  // -0 is 0

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// v / |v|, or nothing when it has no direction. In double: squares of small edges vanish in float.
bool normalize_if_possible(glm::vec3& v)
{
    const glm::dvec3 wide(v);
    const double length = glm::length(wide);
    if (!(length > static_cast<double>(FLT_MIN)) || !std::isfinite(length)) return false;
    v = glm::vec3(wide / length);
    return true;
}

glm::vec4 any_tangent(const glm::vec3& normal)
{
    const glm::vec3 a = glm::abs(normal);
    const glm::vec3 axis = a.x <= a.y && a.x <= a.z ? glm::vec3(1.0f, 0.0f, 0.0f)
                           : a.y <= a.z             ? glm::vec3(0.0f, 1.0f, 0.0f)
                                                    : glm::vec3(0.0f, 0.0f, 1.0f);
    glm::vec3 tangent = axis - normal * glm::dot(normal, axis);
    if (!normalize_if_possible(tangent)) tangent = glm::vec3(1.0f, 0.0f, 0.0f);
    return {tangent, 1.0f};
}

// Gives every corner a vertex that carries the corner's own value: where the corners of a vertex
// disagree, the vertex is copied. Returns the values by vertex; unused vertices get `unused`.
std::vector<glm::vec4> split_by_value(Primitive& primitive,
                                      std::span<const glm::vec4> corner_values,
                                      const glm::vec4& unused)
{
    const std::size_t old_count = primitive.positions.size();
    std::vector<glm::vec4> values(old_count, unused);
    std::vector<bool> seen(old_count, false);
    const std::size_t influences_each =
        old_count == 0 ? 0 : primitive.influences.size() / old_count;
    RowTable<5> copies(0);
    std::vector<std::uint32_t> vertex_of_copy;
    for (std::size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        std::uint32_t& index = primitive.indices[corner];
        const glm::vec4 value = corner_values[corner];
        if (!seen[index]) {
            seen[index] = true;
            values[index] = value;
        }
        if (values[index] == value) continue;
        const std::uint32_t copy =
            copies.number({index, bits(value.x), bits(value.y), bits(value.z), bits(value.w)});
        if (copy == vertex_of_copy.size()) {
            vertex_of_copy.push_back(static_cast<std::uint32_t>(values.size()));
            values.push_back(value);
            const auto duplicate = [index](auto& attribute) {
                if (attribute.empty()) return;
                const auto original = attribute[index];  // push_back may move the array
                attribute.push_back(original);
            };
            duplicate(primitive.positions);
            duplicate(primitive.normals);
            duplicate(primitive.tangents);
            duplicate(primitive.uv0);
            duplicate(primitive.uv1);
            duplicate(primitive.colors);
            duplicate(primitive.weather);
            for (MorphTarget& target : primitive.targets) {
                duplicate(target.positions);
                duplicate(target.normals);
                duplicate(target.tangents);
            }
            for (std::size_t i = 0; i < influences_each; ++i) {
                const Influence original = primitive.influences[index * influences_each + i];
                primitive.influences.push_back(original);
            }
        }
        index = vertex_of_copy[copy];
    }
    return values;
}

// What MikkTSpace keeps of a triangle.
struct Face {
    std::array<std::uint32_t, 3> point{};  ///< welded corners
    std::array<std::uint32_t, 3> neighbor{kNone, kNone,
                                          kNone};  ///< across the edge corner k -> k + 1
    glm::vec3 along_u{0.0f};                       ///< unit direction in which u grows, or zero
    bool degenerate = false;                       ///< two corners at one position
    bool has_uv_area = false;
    bool mirrored = false;  ///< the uv triangle is wound the other way
};

std::size_t next_corner(std::size_t corner)
{
    return corner == 2 ? 0 : corner + 1;
}
std::size_t previous_corner(std::size_t corner)
{
    return corner == 0 ? 2 : corner - 1;
}

std::vector<Face> make_faces(const Primitive& primitive, const std::vector<glm::vec2>& uv)
{
    std::vector<Face> faces(primitive.indices.size() / 3);
    RowTable<8> points(primitive.positions.size());
    std::vector<std::uint32_t> point_of(primitive.positions.size());
    for (std::size_t v = 0; v < point_of.size(); ++v) {
        const glm::vec3& p = primitive.positions[v];
        const glm::vec3& n = primitive.normals[v];
        point_of[v] = points.number({bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y),
                                     bits(n.z), bits(uv[v].x), bits(uv[v].y)});
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Face& face = faces[f];
        const std::uint32_t* index = &primitive.indices[3 * f];
        for (std::size_t c = 0; c < 3; ++c) face.point[c] = point_of[index[c]];
        const glm::vec3& p0 = primitive.positions[index[0]];
        const glm::vec3& p1 = primitive.positions[index[1]];
        const glm::vec3& p2 = primitive.positions[index[2]];
        face.degenerate = p0 == p1 || p1 == p2 || p0 == p2;
        const glm::vec2 uv1 = uv[index[1]] - uv[index[0]];
        const glm::vec2 uv2 = uv[index[2]] - uv[index[0]];
        const float area = uv1.x * uv2.y - uv1.y * uv2.x;
        face.along_u = uv2.y * (p1 - p0) - uv1.y * (p2 - p0);
        const glm::vec3 along_v = uv1.x * (p2 - p0) - uv2.x * (p1 - p0);
        // v grows downwards in glTF, so the image's handedness is the opposite of the sign of
        // `area`.
        face.mirrored = area > 0.0f;
        const bool has_u = normalize_if_possible(face.along_u);
        face.has_uv_area =
            std::abs(area) > FLT_MIN && has_u && finite(along_v) && along_v != glm::vec3(0.0f);
        if (area < 0.0f) face.along_u = -face.along_u;
    }
    return faces;
}

// Pairs the two sides of every edge: same two points, run through in opposite directions. Where
// more than two triangles meet, they pair in the order of their index.
void link_neighbors(std::vector<Face>& faces)
{
    struct Edge {
        std::uint64_t ends;  ///< the smaller point, then the larger
        std::uint32_t side;  ///< 3 * face + corner
        bool forward;        ///< runs from the smaller to the larger
    };
    std::vector<Edge> edges;
    edges.reserve(3 * faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (faces[f].degenerate) continue;
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint64_t from = faces[f].point[c];
            const std::uint64_t to = faces[f].point[next_corner(c)];
            edges.push_back({std::min(from, to) << 32 | std::max(from, to), 3 * f + c, from < to});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.side < b.side;
    });
    std::vector<std::uint32_t> waiting;  // unpaired sides of this edge, all in one direction
    std::size_t first_waiting = 0;
    bool waiting_forward = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i == 0 || edges[i].ends != edges[i - 1].ends) {
            waiting.clear();
            first_waiting = 0;
        }
        const bool any = first_waiting < waiting.size();
        if (any && waiting_forward != edges[i].forward) {
            const std::uint32_t a = waiting[first_waiting++];
            const std::uint32_t b = edges[i].side;
            faces[a / 3].neighbor[a % 3] = b / 3;
            faces[b / 3].neighbor[b % 3] = a / 3;
        } else {
            waiting.push_back(edges[i].side);
            waiting_forward = edges[i].forward;
        }
    }
}

// One group's corners: 3 * face + corner, in the order of the faces.
using Group = std::vector<std::uint32_t>;

glm::vec4 group_tangent(const Primitive& primitive, const std::vector<Face>& faces,
                        const Group& group, bool mirrored)
{
    glm::vec3 sum(0.0f);
    const glm::vec3 normal = primitive.normals[primitive.indices[group.front()]];
    const auto flatten = [&normal](glm::vec3 v) {
        v -= normal * glm::dot(normal, v);
        return normalize_if_possible(v) ? v : glm::vec3(0.0f);
    };
    for (const std::uint32_t side : group) {
        const Face& face = faces[side / 3];
        if (!face.has_uv_area) continue;
        const std::size_t corner = side % 3;
        const std::uint32_t* index = &primitive.indices[side - corner];
        const glm::vec3& here = primitive.positions[index[corner]];
        const glm::vec3 a = flatten(primitive.positions[index[previous_corner(corner)]] - here);
        const glm::vec3 b = flatten(primitive.positions[index[next_corner(corner)]] - here);
        const float angle = std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
        sum += angle * flatten(face.along_u);
    }
    if (!finite(sum) || !normalize_if_possible(sum)) return glm::vec4(0.0f);
    return {sum, mirrored ? -1.0f : 1.0f};
}

class Grouping {
public:
    Grouping(const Primitive& primitive, std::vector<Face>& faces)
        : primitive_(primitive), faces_(faces), taken_(primitive.indices.size(), false)
    {
    }

    /// Tangents by corner; zero where no group decides.
    std::vector<glm::vec4> run()
    {
        std::vector<glm::vec4> tangents(taken_.size(), glm::vec4(0.0f));
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (faces_[f].degenerate || !faces_[f].has_uv_area) continue;
            for (std::uint32_t c = 0; c < 3; ++c) {
                if (taken_[3 * f + c]) continue;
                Group group = collect(3 * f + c);
                std::sort(group.begin(), group.end());
                const glm::vec4 tangent =
                    group_tangent(primitive_, faces_, group, faces_[f].mirrored);
                for (const std::uint32_t side : group) tangents[side] = tangent;
            }
        }
        return tangents;
    }

private:
    // Walks around the point of the seed corner in both directions, as far as edges are shared and
    // the handedness stays.
    Group collect(std::uint32_t seed)
    {
        const std::uint32_t point = faces_[seed / 3].point[seed % 3];
        const bool mirrored = faces_[seed / 3].mirrored;
        Group group;
        open_.assign(1, seed / 3);
        while (!open_.empty()) {
            Face& face = faces_[open_.back()];
            const std::uint32_t f = open_.back();
            open_.pop_back();
            const std::size_t c = face.point[0] == point ? 0 : face.point[1] == point ? 1 : 2;
            assert(face.point[c] == point);
            const std::size_t side = 3 * std::size_t{f} + c;
            if (taken_[side]) continue;
            // A triangle without uv area has no handedness; the first group that reaches it
            // decides.
            const std::size_t first = side - c;
            const bool untouched = !taken_[first] && !taken_[first + 1] && !taken_[first + 2];
            if (!face.has_uv_area && untouched) face.mirrored = mirrored;
            if (face.mirrored != mirrored) continue;
            taken_[side] = true;
            group.push_back(static_cast<std::uint32_t>(side));
            for (const std::uint32_t neighbor :
                 {face.neighbor[previous_corner(c)], face.neighbor[c]}) {
                if (neighbor != kNone) open_.push_back(neighbor);
            }
        }
        return group;
    }

    const Primitive& primitive_;
    std::vector<Face>& faces_;
    std::vector<bool> taken_;  ///< by corner
    std::vector<std::uint32_t> open_;
};

// Corners that no group decided follow a decided corner at the same point.
void fill_gaps(const Primitive& primitive, const std::vector<Face>& faces,
               std::vector<glm::vec4>& tangents)
{
    std::vector<std::uint32_t> example(primitive.positions.size(), kNone);  // by point
    const auto decided = [&](std::size_t side) { return tangents[side].w != 0.0f; };
    for (std::uint32_t side = 0; side < tangents.size(); ++side) {
        std::uint32_t& slot = example[faces[side / 3].point[side % 3]];
        if (slot == kNone && decided(side)) slot = side;
    }
    for (std::uint32_t side = 0; side < tangents.size(); ++side) {
        if (decided(side)) continue;
        const std::uint32_t other = example[faces[side / 3].point[side % 3]];
        tangents[side] = other != kNone ? tangents[other]
                                        : any_tangent(primitive.normals[primitive.indices[side]]);
    }
}

}  // namespace

void generate_flat_normals(Primitive& primitive)
{
    primitive.normals.clear();
    primitive.tangents.clear();
    std::vector<glm::vec4> corner_normals(primitive.indices.size());
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::dvec3 p0(primitive.positions[primitive.indices[i]]);
        const glm::dvec3 p1(primitive.positions[primitive.indices[i + 1]]);
        const glm::dvec3 p2(primitive.positions[primitive.indices[i + 2]]);
        const glm::dvec3 across = glm::cross(p1 - p0, p2 - p0);
        const double area = glm::length(across);
        glm::vec3 normal(0.0f, 1.0f, 0.0f);
        if (area > 0.0 && std::isfinite(area)) normal = glm::vec3(across / area);
        for (std::size_t c = 0; c < 3; ++c) corner_normals[i + c] = glm::vec4(normal, 0.0f);
    }
    const auto normals =
        split_by_value(primitive, corner_normals, glm::vec4(0.0f, 1.0f, 0.0f, 0.0f));
    primitive.normals.assign(normals.begin(), normals.end());
    primitive.flat = true;
}

void generate_tangents(Primitive& primitive, int texcoord)
{
    assert(primitive.normals.size() == primitive.positions.size());
    primitive.tangents.clear();
    const auto& uv = texcoord == 1 ? primitive.uv1 : primitive.uv0;
    // Without texture coordinates any frame is as good as another.
    if (uv.empty() || std::all_of(uv.begin(), uv.end(), [&](auto& c) { return c == uv.front(); })) {
        for (const glm::vec3& normal : primitive.normals) {
            primitive.tangents.push_back(any_tangent(normal));
        }
        return;
    }
    std::vector<Face> faces = make_faces(primitive, uv);
    link_neighbors(faces);
    std::vector<glm::vec4> tangents = Grouping(primitive, faces).run();
    fill_gaps(primitive, faces, tangents);
    auto by_vertex = split_by_value(primitive, tangents, glm::vec4(0.0f));
    for (std::size_t v = 0; v < by_vertex.size(); ++v) {
        if (by_vertex[v].w == 0.0f) by_vertex[v] = any_tangent(primitive.normals[v]);
    }
    primitive.tangents = std::move(by_vertex);
}

}  // namespace petrichor::scene
