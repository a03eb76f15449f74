#include "scene/subdivide/subdivide.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace petrichor::scene {
namespace {

using glm::vec3;

constexpr std::uint32_t kNone = 0xffffffffu;

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b)
{
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

struct PlaceHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const
    {
        std::uint64_t h = 0x9e3779b97f4a7c15ull;
        for (const std::uint32_t b : bits) {
            h = (h ^ b) * 0xff51afd7ed558ccdull;
            h ^= h >> 32;
        }
        return static_cast<std::size_t>(h);
    }
};

std::array<std::uint32_t, 3> place_of(const vec3& p)
{
    // -0 and 0 are one place.
    return {std::bit_cast<std::uint32_t>(p.x + 0.0f), std::bit_cast<std::uint32_t>(p.y + 0.0f),
            std::bit_cast<std::uint32_t>(p.z + 0.0f)};
}

bool before(const vec3& a, const vec3& b)
{
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

vec3 unit_or(const vec3& v, const vec3& otherwise)
{
    const float length = glm::length(v);
    return length > 1.0e-20f ? v / length : otherwise;
}

template <class T>
void add_mean(std::vector<T>& list, std::size_t a, std::size_t b)
{
    if (list.empty()) return;
    list.push_back(0.5f * (list[a] + list[b]));
}

// Half of each end's joints; of too many the strongest stay.
void add_influences(std::vector<Influence>& all, std::size_t each, std::size_t a, std::size_t b)
{
    if (each == 0) return;
    std::vector<Influence> both;
    for (const std::size_t end : {a, b}) {
        for (std::size_t i = 0; i < each; ++i) {
            const Influence& one = all[end * each + i];
            const auto same = std::find_if(both.begin(), both.end(), [&](const Influence& other) {
                return other.joint == one.joint;
            });
            if (same == both.end()) {
                both.push_back({one.joint, 0.5f * one.weight});
            } else {
                same->weight += 0.5f * one.weight;
            }
        }
    }
    std::stable_sort(both.begin(), both.end(), [](const Influence& x, const Influence& y) {
        return std::make_tuple(-x.weight, x.joint) < std::make_tuple(-y.weight, y.joint);
    });
    both.resize(each, Influence{});
    float sum = 0.0f;
    for (const Influence& one : both) sum += one.weight;
    for (Influence& one : both) {
        if (sum > 0.0f) one.weight /= sum;
        all.push_back(one);
    }
}

std::uint32_t add_middle(Primitive& p, std::uint32_t first, std::uint32_t second)
{
    // One order for both triangles at the edge, so that sums round alike.
    const std::size_t a = std::min(first, second);
    const std::size_t b = std::max(first, second);
    const std::size_t each = p.influences.empty() ? 0 : p.influences.size() / p.positions.size();
    add_influences(p.influences, each, a, b);
    for (MorphTarget& target : p.targets) {
        add_mean(target.positions, a, b);
        add_mean(target.normals, a, b);
        add_mean(target.tangents, a, b);
    }
    if (!p.normals.empty()) p.normals.push_back(unit_or(p.normals[a] + p.normals[b], p.normals[a]));
    if (!p.tangents.empty()) {
        const vec3 along = unit_or(vec3(p.tangents[a]) + vec3(p.tangents[b]), vec3(p.tangents[a]));
        p.tangents.emplace_back(along, p.tangents[a].w);
    }
    add_mean(p.uv0, a, b);
    add_mean(p.uv1, a, b);
    add_mean(p.colors, a, b);
    add_mean(p.weather, a, b);
    add_mean(p.positions, a, b);
    return static_cast<std::uint32_t>(p.positions.size() - 1);
}

// Where a point lies on a triangle of the mesh as it was.
struct Origin {
    std::array<std::uint32_t, 3> corners{kNone, kNone, kNone};
    vec3 shares{0.0f};
};

struct Triangle {
    std::array<std::uint32_t, 3> vertices;
    std::array<std::uint32_t, 3> corners;  // points of the triangle that it is a part of
    std::array<vec3, 3> shares;            // of those corners at its own
    std::uint32_t number;                  // of that triangle in its primitive
};

class Cutter {
public:
    Cutter(const std::vector<Primitive>& primitives, const SubdivideOptions& options)
        : options_(options)
    {
        mesh_.primitives = primitives;
        weld();
    }

    CutMesh run()
    {
        for (int level = 0; level < options_.most_levels; ++level) {
            if (!cut_once()) break;
        }
        for (std::size_t i = 0; i < mesh_.primitives.size(); ++i) {
            std::vector<std::uint32_t>& indices = mesh_.primitives[i].indices;
            indices.clear();
            auto& origins = mesh_.origins.emplace_back();
            for (const Triangle& t : triangles_[i]) {
                indices.insert(indices.end(), t.vertices.begin(), t.vertices.end());
                origins.push_back(t.number);
            }
        }
        if (options_.phong > 0.0f) smooth();
        mesh_.normals = std::move(normals_);
        mesh_.pinned = std::move(pinned_);
        return std::move(mesh_);
    }

private:
    bool is_cut(std::size_t primitive) const
    {
        return primitive >= options_.cut.size() || options_.cut[primitive];
    }

    void weld()
    {
        std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, PlaceHash> places;
        for (std::size_t i = 0; i < mesh_.primitives.size(); ++i) {
            const Primitive& p = mesh_.primitives[i];
            auto& points = mesh_.points.emplace_back();
            for (std::size_t v = 0; v < p.positions.size(); ++v) {
                const auto [place, is_new] = places.try_emplace(
                    place_of(p.positions[v]), static_cast<std::uint32_t>(positions_.size()));
                if (is_new) {
                    positions_.push_back(p.positions[v]);
                    normals_.emplace_back(0.0f);
                    origins_.emplace_back();
                    pinned_.push_back(false);
                }
                points.push_back(place->second);
                if (!p.normals.empty()) normals_[place->second] += p.normals[v];
                if (!is_cut(i)) pinned_[place->second] = true;
            }
        }
        for (vec3& n : normals_) n = unit_or(n, vec3(0.0f, 1.0f, 0.0f));
        for (std::size_t i = 0; i < mesh_.primitives.size(); ++i) {
            const Primitive& p = mesh_.primitives[i];
            auto& list = triangles_.emplace_back();
            const auto& points = mesh_.points[i];
            for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
                Triangle t{{p.indices[k], p.indices[k + 1], p.indices[k + 2]}, {}, {},
                           static_cast<std::uint32_t>(k / 3)};
                for (std::size_t c = 0; c < 3; ++c) {
                    t.corners[c] = points[t.vertices[c]];
                    t.shares[c] = vec3(0.0f);
                    t.shares[c][static_cast<int>(c)] = 1.0f;
                }
                list.push_back(t);
                if (is_cut(i)) continue;
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::uint64_t key = pair_key(t.corners[c], t.corners[(c + 1) % 3]);
                    pinned_edges_.try_emplace(key, true);
                }
            }
        }
    }

    std::uint32_t point(std::size_t primitive, std::uint32_t vertex) const
    {
        return mesh_.points[primitive][vertex];
    }

    // The middles of all edges that are too long; false when there is none, or no room.
    bool find_middles()
    {
        middles_.clear();
        std::size_t more = 0;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (!is_cut(i)) continue;
            for (const Triangle& t : triangles_[i]) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::uint32_t a = point(i, t.vertices[c]);
                    const std::uint32_t b = point(i, t.vertices[(c + 1) % 3]);
                    if (a == b) continue;
                    const auto [edge, is_new] = middles_.try_emplace(pair_key(a, b), kNone);
                    if (is_new) {
                        const vec3& p = positions_[a];
                        const vec3& q = positions_[b];
                        if (!(before(q, p) ? options_.too_long(q, p) : options_.too_long(p, q)))
                            continue;
                        edge->second = new_point(a, b);
                    }
                    more += edge->second != kNone ? 1 : 0;
                }
            }
        }
        std::size_t count = more;
        for (const auto& list : triangles_) count += list.size();
        mesh_.limited = count > options_.most_triangles;
        return more > 0 && !mesh_.limited;
    }

    std::uint32_t new_point(std::uint32_t a, std::uint32_t b)
    {
        const auto number = static_cast<std::uint32_t>(positions_.size());
        const std::uint32_t low = std::min(a, b), high = std::max(a, b);
        positions_.push_back(0.5f * (positions_[low] + positions_[high]));
        normals_.push_back(unit_or(normals_[low] + normals_[high], normals_[low]));
        origins_.emplace_back();
        const bool pin = pinned_edges_.count(pair_key(a, b)) != 0;
        pinned_.push_back(pin);
        if (pin) {
            pinned_edges_.try_emplace(pair_key(a, number), true);
            pinned_edges_.try_emplace(pair_key(b, number), true);
        }
        return number;
    }

    bool cut_once()
    {
        const std::size_t points = positions_.size();
        if (!find_middles()) {
            positions_.resize(points);
            normals_.resize(points);
            origins_.resize(points);
            pinned_.resize(points);
            return false;
        }
        for (std::size_t i = 0; i < triangles_.size(); ++i) cut_primitive(i);
        return true;
    }

    void cut_primitive(std::size_t i)
    {
        Primitive& p = mesh_.primitives[i];
        std::unordered_map<std::uint64_t, std::uint32_t> vertices;
        std::vector<Triangle> out;
        out.reserve(triangles_[i].size() * 2);
        for (const Triangle& t : triangles_[i]) {
            std::array<std::uint32_t, 3> middle{kNone, kNone, kNone};
            std::array<vec3, 3> shares{};
            int cuts = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t a = t.vertices[c], b = t.vertices[(c + 1) % 3];
                const auto edge = middles_.find(pair_key(point(i, a), point(i, b)));
                if (edge == middles_.end() || edge->second == kNone) continue;
                const auto [vertex, is_new] = vertices.try_emplace(pair_key(a, b), kNone);
                if (is_new) {
                    vertex->second = add_middle(p, a, b);
                    p.positions.back() = positions_[edge->second];
                    mesh_.points[i].push_back(edge->second);
                }
                middle[c] = vertex->second;
                shares[c] = 0.5f * (t.shares[c] + t.shares[(c + 1) % 3]);
                Origin& origin = origins_[edge->second];
                if (origin.corners[0] == kNone) origin = {t.corners, shares[c]};
                ++cuts;
            }
            if (cuts == 0) {
                out.push_back(t);
                continue;
            }
            split(t, middle, shares, cuts, i, out);
        }
        triangles_[i] = std::move(out);
    }

    void split(const Triangle& t, const std::array<std::uint32_t, 3>& middle,
               const std::array<vec3, 3>& shares, int cuts, std::size_t primitive,
               std::vector<Triangle>& out) const
    {
        // Corners 0..2, then the middles of the edges 01, 12, 20.
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            Triangle part{{}, t.corners, {}, t.number};
            const std::array<std::size_t, 3> which{a, b, c};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t w = which[k];
                part.vertices[k] = w < 3 ? t.vertices[w] : middle[w - 3];
                part.shares[k] = w < 3 ? t.shares[w] : shares[w - 3];
            }
            out.push_back(part);
        };
        if (cuts == 3) {
            add(0, 3, 5);
            add(3, 1, 4);
            add(5, 4, 2);
            add(3, 4, 5);
            return;
        }
        // Turned so that the edge 01 is the one that is cut, or the one that is not.
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = k, b = (k + 1) % 3, c = (k + 2) % 3;
            if (cuts == 1 && middle[k] != kNone) {
                add(a, 3 + k, c);
                add(3 + k, b, c);
            }
            if (cuts == 2 && middle[k] == kNone) {
                const std::size_t bc = 3 + b, ca = 3 + c;
                add(ca, bc, c);
                const auto at = [&](std::size_t w) {
                    return positions_[point(primitive, w < 3 ? t.vertices[w] : middle[w - 3])];
                };
                // The shorter diagonal of what is left.
                if (glm::distance(at(a), at(bc)) <= glm::distance(at(b), at(ca))) {
                    add(a, b, bc);
                    add(a, bc, ca);
                } else {
                    add(a, b, ca);
                    add(b, bc, ca);
                }
            }
        }
    }

    void smooth()
    {
        std::vector<vec3> moved = positions_;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const Origin& origin = origins_[i];
            if (origin.corners[0] == kNone || pinned_[i]) continue;
            const vec3 p = positions_[i];
            vec3 sum(0.0f);
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t corner = origin.corners[static_cast<std::size_t>(c)];
                const vec3 n = normals_[corner];
                sum += origin.shares[c] * (p - glm::dot(p - positions_[corner], n) * n);
            }
            moved[i] = glm::mix(p, sum, options_.phong);
        }
        for (std::size_t i = 0; i < mesh_.primitives.size(); ++i) {
            for (std::size_t v = 0; v < mesh_.points[i].size(); ++v)
                mesh_.primitives[i].positions[v] = moved[mesh_.points[i][v]];
        }
    }

    const SubdivideOptions& options_;
    CutMesh mesh_;
    std::vector<std::vector<Triangle>> triangles_;  // of each primitive
    std::vector<vec3> positions_, normals_;         // of each point
    std::vector<Origin> origins_;
    std::vector<bool> pinned_;
    std::unordered_map<std::uint64_t, bool> pinned_edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

CutMesh subdivide(const std::vector<Primitive>& primitives, const SubdivideOptions& options)
{
    assert(options.too_long);
    return Cutter(primitives, options).run();
}

std::vector<glm::vec3> point_normals(const CutMesh& mesh)
{
    std::vector<vec3> sums(mesh.normals.size(), vec3(0.0f));
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const std::uint32_t* t = &p.indices[k];
            const vec3 face = glm::cross(p.positions[t[1]] - p.positions[t[0]],
                                         p.positions[t[2]] - p.positions[t[0]]);
            for (int c = 0; c < 3; ++c) sums[mesh.points[i][t[c]]] += face;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = unit_or(sums[i], mesh.normals[i]);
    return sums;
}

}  // namespace petrichor::scene
