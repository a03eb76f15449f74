#include "scene/snow/detail/bank.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/detail/circle_plane.h"

namespace petrichor::scene::detail {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kWideGround_m2 = 0.6f;  // ground that hangs together and is no larger keeps its shape
constexpr float kWidePlateau_m2 = 0.25f;  // what stands higher than all around it and is no larger is a thing
constexpr float kStep_m = 0.02f;        // from cell to cell: lower ones are relief
constexpr float kSteepStep = 0.7f;      // .. and no steeper than this they are slopes
constexpr float kReach_m = 0.22f;       // so far from a step the sheet reaches
constexpr float kFade_m = 0.07f;        // .. and goes under the caps along the last of it
constexpr int kThing = 3;               // cells: what is narrower than twice this and one is no ground
constexpr int kJoint = 3;               // cells without ground between ground are a joint
constexpr float kWidth = 1.6f;          // radius of the circle, over the depth, as that of the caps
constexpr float kSteepest = 0.87f;      // y of the normal of the smoothed ground: steeper is no place for a bank
constexpr float kEdge_m = 0.1f;         // from a deep edge: none within this, a whole one from twice as far on
constexpr float kFine_m = 3.0f;         // as fine as the sheet's cells up to here from an eye, half as fine beyond
constexpr float kOverlap_m = 0.4f;
constexpr float kFarthest_m = 11.0f;
constexpr float kOfGround_m = 0.04f;
constexpr float kHolds = 0.02f;         // share of the depth: less is no ground that snow lies on

class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t i) const
    {
        while (parent_[i] != i) i = parent_[i];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = shortened(a);
        b = shortened(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }
    /// Members of each group, at its root. Afterwards each member's parent is its root.
    std::vector<std::uint32_t> sizes()
    {
        std::vector<std::uint32_t> count(parent_.size(), 0);
        for (std::uint32_t i = 0; i < parent_.size(); ++i) ++count[parent_[i] = root(i)];
        return count;
    }

private:
    std::vector<std::uint32_t> parent_;

    std::uint32_t shortened(std::uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
};

// One ground: of each cell the highest layer of ground that hangs together over steps and is wide.
class OneGround {
public:
    explicit OneGround(const Sheet& sheet) : sheet_(&sheet), width_(sheet.width()), height_(sheet.height())
    {
        const auto& layers = sheet.layers();
        // Over a joint or a bevel too.
        const auto beside = [&](const auto& visit) {
            for (int z = 0; z < height_; ++z)
                for (int x = 0; x < width_; ++x)
                    for (int k = 1; k <= kJoint; ++k)
                        for (const ivec2 to : {ivec2(x + k, z), ivec2(x, z + k)}) {
                            if (to.x >= width_ || to.y >= height_) continue;
                            for (std::uint32_t a = sheet.first(x, z); a != Sheet::kNoLayer; a = layers[a].next)
                                for (std::uint32_t b = sheet.first(to.x, to.y); b != Sheet::kNoLayer; b = layers[b].next)
                                    if (std::abs(layers[a].height_m - layers[b].height_m) < kHighestStep_m) visit(a, b);
                        }
        };
        Groups grounds(layers.size()), plateaus(layers.size());
        beside([&](std::uint32_t a, std::uint32_t b) {
            grounds.join(a, b);
            if (std::abs(layers[a].height_m - layers[b].height_m) < kStep_m) plateaus.join(a, b);
        });
        const float cell_m2 = sheet.cell_m() * sheet.cell_m();
        const std::vector<std::uint32_t> cells = grounds.sizes(), level = plateaus.sizes();
        const auto wide_plateau = [&](std::uint32_t i) {
            return static_cast<float>(level[plateaus.root(i)]) * cell_m2 >= kWidePlateau_m2;
        };
        // A bevel or a slot lies by what is higher and wide; what does not is the top of a thing.
        std::vector<bool> beneath(layers.size(), false);
        beside([&](std::uint32_t a, std::uint32_t b) {
            if (layers[b].height_m < layers[a].height_m) std::swap(a, b);
            if (wide_plateau(b)) beneath[plateaus.root(a)] = true;
        });
        const auto is_ground = [&](std::uint32_t i) {
            return static_cast<float>(cells[grounds.root(i)]) * cell_m2 >= kWideGround_m2 &&
                   (wide_plateau(i) || beneath[plateaus.root(i)]);
        };
        top_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Sheet::kNoLayer);
        for (int z = 0; z < height_; ++z) {
            for (int x = 0; x < width_; ++x) {
                std::uint32_t& top = top_[index(x, z)];
                for (std::uint32_t k = sheet.first(x, z); k != Sheet::kNoLayer; k = layers[k].next) {
                    if (!is_ground(k)) continue;
                    if (top == Sheet::kNoLayer || layers[k].height_m > layers[top].height_m) top = k;
                }
            }
        }
        leave_out_things(is_ground);
        close_joints();
    }

    bool found(int x, int z) const { return at(x, z) != nullptr; }
    float height_m(int x, int z) const { return heights_[index(x, z)]; }
    std::size_t index(int x, int z) const { return static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x); }
    bool inside(int x, int z) const { return x >= 0 && z >= 0 && x < width_ && z < height_; }
    const Sheet::Layer* at(int x, int z) const
    {
        if (!inside(x, z)) return nullptr;
        const std::uint32_t top = top_[index(x, z)];
        return top == Sheet::kNoLayer ? nullptr : &sheet_->layers()[top];
    }
    int width() const { return width_; }
    int height() const { return height_; }

    struct Smoothed {
        float height_m = 0.0f;
        vec2 slope{0.0f};
        float open = 0.0f;  ///< of what is open: what lies below bars counts little
        float whole = 0.0f;
    };
    // By the plane through what lies in a circle.
    Smoothed smoothed(int x, int z, float depth_m, float own_m, const vec2& place) const
    {
        const vec2 off = (place - sheet_->place(x, z)) / sheet_->cell_m();
        const float reach = std::max(kWidth * depth_m / sheet_->cell_m(), 1.5f);
        const int around = static_cast<int>(reach + 0.5f);
        const int stride = reach > 9.0f ? 2 : 1;
        CirclePlane plane;
        float open = 0.0f, opens = 0.0f, all = 0.0f;
        for (int j = -around; j <= around; j += stride) {
            for (int i = -around; i <= around; i += stride) {
                const vec2 way = (vec2(static_cast<float>(i), static_cast<float>(j)) - off) / reach;
                const float in = 1.0f - glm::dot(way, way);
                if (!(in > 0.0f)) continue;
                const float w = in * in;
                all += w;
                const Sheet::Layer* here = at(x + i, z + j);
                if (here == nullptr) continue;
                const float rise = heights_[index(x + i, z + j)] - own_m;
                if (std::abs(rise) > 2.0f * kHighestStep_m) continue;
                plane.add(w, way, rise);
                open += w * here->open;
                opens += w * here->open * here->open;
            }
        }
        if (!(plane.weight() > 0.0f)) return {own_m};
        const CirclePlane::Fit fit = plane.fit();
        return {own_m + fit.rise_m, fit.slope_m / (reach * sheet_->cell_m()), opens / std::max(open, 1.0e-6f), plane.weight() / all};
    }

private:
    const Sheet* sheet_;
    int width_, height_;
    std::vector<std::uint32_t> top_;
    std::vector<float> heights_;  // what lies in a joint is as high as its stones

    // What is narrower than a few cells and stands over the ground around is a thing on it: the ground goes on below.
    template <class Wide>
    void leave_out_things(const Wide& is_wide)
    {
        const std::size_t count = top_.size();
        std::vector<float> own(count, 1.0e9f);
        for (std::size_t i = 0; i < count; ++i)
            if (top_[i] != Sheet::kNoLayer) own[i] = sheet_->layers()[top_[i]].height_m;
        // The lowest around, then the highest of those, along rows and columns; where there is no ground nothing counts.
        const auto filtered = [&](const std::vector<float>& from, bool lowest) {
            std::vector<float> rows(count), both(count);
            const auto pass = [&](const std::vector<float>& in, std::vector<float>& out, int dx, int dz) {
                for (int z = 0; z < height_; ++z) {
                    for (int x = 0; x < width_; ++x) {
                        float best = 1.0e9f;
                        for (int k = -kThing; k <= kThing; ++k) {
                            if (!inside(x + k * dx, z + k * dz)) continue;
                            const float there = in[index(x + k * dx, z + k * dz)];
                            if (there > 1.0e8f) continue;
                            best = best > 1.0e8f ? there : lowest ? std::min(best, there) : std::max(best, there);
                        }
                        out[index(x, z)] = best;
                    }
                }
            };
            pass(from, rows, 1, 0);
            pass(rows, both, 0, 1);
            return both;
        };
        const std::vector<float> opened = filtered(filtered(own, true), false);
        for (int z = 0; z < height_; ++z) {
            for (int x = 0; x < width_; ++x) {
                const std::size_t i = index(x, z);
                if (top_[i] == Sheet::kNoLayer || !(own[i] - opened[i] > kStep_m)) continue;
                for (std::uint32_t k = sheet_->first(x, z); k != Sheet::kNoLayer; k = sheet_->layers()[k].next) {
                    const auto off = [&](std::uint32_t layer) { return std::abs(sheet_->layers()[layer].height_m - opened[i]); };
                    if (is_wide(k) && off(k) < off(top_[i])) top_[i] = k;
                }
            }
        }
    }

    void close_joints()
    {
        heights_.assign(top_.size(), 0.0f);
        std::vector<float> highest(top_.size(), -1.0e9f);
        const auto around = [&](int x, int z, const auto& visit) {
            for (int k = 0; k < 9; ++k)
                if (inside(x + k % 3 - 1, z + k / 3 - 1)) visit(x + k % 3 - 1, z + k / 3 - 1);
        };
        for (int z = 0; z < height_; ++z)
            for (int x = 0; x < width_; ++x)
                around(x, z, [&](int i, int j) {
                    if (const Sheet::Layer* there = at(i, j)) highest[index(x, z)] = std::max(highest[index(x, z)], there->height_m);
                });
        for (int z = 0; z < height_; ++z) {
            for (int x = 0; x < width_; ++x) {
                const Sheet::Layer* own = at(x, z);
                if (own == nullptr) continue;
                float lowest = 1.0e9f;
                around(x, z, [&](int i, int j) {
                    if (highest[index(i, j)] > -1.0e8f) lowest = std::min(lowest, highest[index(i, j)]);
                });
                heights_[index(x, z)] = lowest - own->height_m < kHighestStep_m ? std::max(lowest, own->height_m) : own->height_m;
            }
        }
    }
};

// How high a step is that a cell lies at; 0 at none.
float step_at(const OneGround& ground, int x, int z, float cell_m)
{
    if (!ground.found(x, z)) return 0.0f;
    float step = 0.0f;
    for (const ivec2 way : {ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1)}) {
        int apart = 1;
        while (!ground.found(x + apart * way.x, z + apart * way.y) && apart < kJoint) ++apart;
        if (!ground.found(x + apart * way.x, z + apart * way.y)) continue;
        const float rise = std::abs(ground.height_m(x + apart * way.x, z + apart * way.y) - ground.height_m(x, z));
        if (rise > kHighestStep_m) continue;
        if (rise > kStep_m && rise > kSteepStep * cell_m * static_cast<float>(apart)) step = std::max(step, rise);
    }
    return step;
}

// How far each cell is from where the ground falls away deeper than a bank is high, up to 3 kEdge_m.
std::vector<float> from_edges(const OneGround& ground, const Sheet& sheet, const std::vector<Border>& open)
{
    std::vector<float> away(static_cast<std::size_t>(ground.width()) * static_cast<std::size_t>(ground.height()), 1.0e9f);
    const int reach = static_cast<int>(std::ceil(3.0f * kEdge_m / sheet.cell_m()));
    for (const Border& edge : open) {
        if (!(edge.drop_m > kHighestStep_m)) continue;
        // A slot, when the ground goes on behind it.
        const vec3 middle = 0.5f * (edge.from + edge.to);
        const auto goes_on = [&](float out_m) {
            const ivec2 cell = sheet.cell_of(vec2(middle.x, middle.z) + out_m * edge.out);
            return ground.found(cell.x, cell.y) && std::abs(ground.height_m(cell.x, cell.y) - middle.y) < kHighestStep_m;
        };
        if (goes_on(0.08f) || goes_on(0.13f) || goes_on(0.18f)) continue;
        const int pieces = 1 + static_cast<int>(glm::distance(edge.from, edge.to) / sheet.cell_m());
        for (int piece = 0; piece <= pieces; ++piece) {
            const vec3 at = glm::mix(edge.from, edge.to, static_cast<float>(piece) / static_cast<float>(pieces));
            const ivec2 cell = sheet.cell_of(vec2(at.x, at.z));
            for (int j = -reach; j <= reach; ++j) {
                for (int i = -reach; i <= reach; ++i) {
                    if (!ground.inside(cell.x + i, cell.y + j)) continue;
                    // Of the same ground.
                    if (ground.found(cell.x + i, cell.y + j) && std::abs(ground.height_m(cell.x + i, cell.y + j) - at.y) > kHighestStep_m) continue;
                    float& least = away[ground.index(cell.x + i, cell.y + j)];
                    least = std::min(least, sheet.cell_m() * std::sqrt(static_cast<float>(i * i + j * j)));
                }
            }
        }
    }
    return away;
}

// What the surface of a triangle carries at a place, also a little outside of it.
struct Carried {
    vec2 uv0, uv1;
    vec4 color, weather, tangent;
};
Carried carried_at(const Primitive& p, std::uint32_t first, const vec3& at)
{
    const std::array<std::uint32_t, 3> t{p.indices[first], p.indices[first + 1], p.indices[first + 2]};
    const auto plan = [&](std::uint32_t v) { return vec2(p.positions[v].x, p.positions[v].z); };
    const vec2 u = plan(t[1]) - plan(t[0]), v = plan(t[2]) - plan(t[0]), w = vec2(at.x, at.z) - plan(t[0]);
    const float area = u.x * v.y - u.y * v.x;
    float b1 = 0.0f, b2 = 0.0f;
    if (std::abs(area) > 1.0e-12f) {
        b1 = std::clamp((w.x * v.y - w.y * v.x) / area, -2.0f, 2.0f);
        b2 = std::clamp((u.x * w.y - u.y * w.x) / area, -2.0f, 2.0f);
    }
    const float b0 = 1.0f - b1 - b2;
    const auto mean = [&](const auto& list) { return b0 * list[t[0]] + b1 * list[t[1]] + b2 * list[t[2]]; };
    return {mean(p.uv0), mean(p.uv1), glm::clamp(mean(p.colors), vec4(0.0f), vec4(1.0f)),
            glm::clamp(mean(p.weather), vec4(0.0f), vec4(1.0f)), p.tangents[t[0]]};
}

}  // namespace

std::vector<BankPart> lay_banks(SnowCaps& caps, const CutMesh& mesh, const Sheet& sheet, const std::vector<Border>& open,
                                const SnowCapOptions& options)
{
    const int width = sheet.width(), height = sheet.height();
    if (width < 3 || height < 3) return {};
    const float cell_m = sheet.cell_m();
    const OneGround ground(sheet);
    // The steps, and how far each cell is from the nearest; the highest within reach counts.
    const int reach = static_cast<int>(std::ceil(kReach_m / cell_m));
    std::vector<float> away(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0e9f), step(away.size(), 0.0f);
    for (int z = 0; z < height; ++z) {
        for (int x = 0; x < width; ++x) {
            const float here = step_at(ground, x, z, cell_m);
            if (!(here > 0.0f)) continue;
            const float far_m = here > 0.04f ? kReach_m : std::min(kReach_m, kFade_m + 2.0f * here + 0.02f);
            for (int j = -reach; j <= reach; ++j) {
                for (int i = -reach; i <= reach; ++i) {
                    if (!ground.inside(x + i, z + j)) continue;
                    const float apart = cell_m * std::sqrt(static_cast<float>(i * i + j * j));
                    if (apart > far_m) continue;
                    const std::size_t k = ground.index(x + i, z + j);
                    away[k] = std::min(away[k], apart + kReach_m - far_m);
                    step[k] = std::max(step[k], here * (1.0f - shared::smooth_edge(0.3f * kReach_m, kReach_m, apart)));
                }
            }
        }
    }
    const std::vector<float> from_edge = from_edges(ground, sheet, open);
    const auto place = [&](int x, int z) { return sheet.place(x, z); };
    const auto eye_m = [&](const vec3& p) {
        float nearest = options.eyes_m.empty() ? 0.0f : 1.0e30f;
        for (const vec3& eye : options.eyes_m) nearest = std::min(nearest, glm::distance(eye, p));
        return nearest;
    };
    // Ground at a place, or beside it: into a wall and over a joint.
    const auto below = [&](int x, int z) {
        const Sheet::Layer* found = nullptr;
        for (int ring = 0; ring <= 2 && found == nullptr; ++ring) {
            for (int j = -ring; j <= ring; ++j) {
                for (int i = -ring; i <= ring; ++i) {
                    const Sheet::Layer* there = ground.at(x + i, z + j);
                    if (there != nullptr && (found == nullptr || there->height_m > found->height_m)) found = there;
                }
            }
        }
        return found;
    };
    const std::size_t caps_alone = caps.points.size();
    std::vector<SnowCaps::Point> laid;
    std::map<std::uint32_t, BankPart> parts;
    std::map<std::pair<int, int>, std::uint32_t> numbers;  // of a level's cell
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> corners;  // of a primitive and a point
    for (int level = 0; level < 2; ++level) {
        const int stride = 1 << level;
        const float from_m = level == 0 ? 0.0f : kFine_m - kOverlap_m, to_m = level == 0 ? kFine_m : kFarthest_m;
        numbers.clear();
        const auto point_of = [&](int x, int z, const Sheet::Layer& layer) {
            const auto [found, fresh] = numbers.try_emplace({x, z}, static_cast<std::uint32_t>(laid.size()));
            if (!fresh) return found->second;
            const vec2 at = place(x, z);
            SnowCaps::Point point;
            point.base_m = vec3(at.x, layer.height_m, at.y);
            const float far = eye_m(point.base_m);
            float seen = layer.open;
            vec2 slope(0.0f);
            for (std::size_t k = 0; k < SnowCaps::kFills; ++k) {
                const OneGround::Smoothed there = ground.smoothed(x, z, SnowCaps::kFillDepths_m[k], layer.height_m, at);
                point.fill_m[k] = there.height_m - layer.height_m;
                if (k == 2) seen = std::min(there.open, 1.0f);
                if (k == 3) slope = there.slope;
            }
            const float up = 1.0f / std::sqrt(1.0f + glm::dot(slope, slope));
            point.share = point.broad = seen * snow_on_slope(up);
            point.uneven = uneven_at(point.base_m, cell_m * static_cast<float>(stride));
            const std::size_t cell = ground.index(x, z);
            point.bank = 1.0f;
            point.bank_m = std::max(step[cell], 1.0e-3f);
            float fade = shared::smooth_edge(kReach_m - kFade_m, kReach_m - 0.5f * cell_m, away[cell]);
            fade = std::max(fade, shared::smooth_edge(to_m - kOverlap_m, to_m - 0.1f, far));
            fade = std::max(fade, 1.0f - shared::smooth_edge(kSteepest - 0.05f, kSteepest + 0.05f, up));
            fade = std::max(fade, 1.0f - shared::smooth_edge(kEdge_m, 2.0f * kEdge_m, from_edge[cell]));
            point.fade = point.broad > kHolds ? fade : 1.0f;
            laid.push_back(point);
            return found->second;
        };
        for (int z = 0; z + stride < height; z += stride) {
            for (int x = 0; x + stride < width; x += stride) {
                const std::array<ivec2, 4> quad{ivec2(x, z), ivec2(x, z + stride), ivec2(x + stride, z + stride), ivec2(x + stride, z)};
                std::array<const Sheet::Layer*, 4> layers{};
                bool near = false, whole = true;
                for (std::size_t c = 0; c < 4; ++c) {
                    near = near || away[ground.index(quad[c].x, quad[c].y)] < kReach_m;
                    if (near) break;
                }
                if (!near) continue;
                for (std::size_t c = 0; c < 4; ++c) {
                    layers[c] = below(quad[c].x, quad[c].y);
                    whole = whole && layers[c] != nullptr;
                }
                if (!whole) continue;
                const auto [low, high] = std::minmax({layers[0]->height_m, layers[1]->height_m, layers[2]->height_m, layers[3]->height_m});
                if (high - low > kHighestStep_m) continue;
                const vec2 middle = place(x, z);
                const float far = eye_m(vec3(middle.x, layers[0]->height_m, middle.y));
                if (far < from_m || far > to_m) continue;
                // Over what lies at its middle.
                const Sheet::Layer& anchor = *layers[0];
                std::array<std::uint32_t, 4> points{};
                float fade = 1.0f;
                for (std::size_t c = 0; c < 4; ++c) {
                    points[c] = point_of(quad[c].x, quad[c].y, *layers[c]);
                    fade = std::min(fade, laid[points[c]].fade);
                }
                if (fade >= 1.0f) continue;
                BankPart& part = parts[anchor.primitive];
                part.primitive = anchor.primitive;
                std::array<std::uint32_t, 4> corner{};
                for (std::size_t c = 0; c < 4; ++c) {
                    const std::uint32_t point = points[c];
                    const auto [found, fresh] =
                        corners.try_emplace({anchor.primitive, point}, static_cast<std::uint32_t>(part.points.size()));
                    corner[c] = found->second;
                    if (!fresh) continue;
                    const std::uint32_t own = layers[c]->primitive == anchor.primitive ? layers[c]->first_index : anchor.first_index;
                    const vec3 at = laid[point].base_m;
                    const Carried carried = carried_at(mesh.primitives[anchor.primitive], own, at);
                    part.points.push_back(point);
                    part.source.positions.push_back(at);
                    part.source.normals.emplace_back(0.0f, 1.0f, 0.0f);
                    part.source.tangents.push_back(carried.tangent);
                    part.source.uv0.push_back(carried.uv0);
                    part.source.uv1.push_back(carried.uv1);
                    part.source.colors.push_back(carried.color);
                    part.source.weather.push_back(carried.weather);
                }
                part.source.indices.insert(part.source.indices.end(), {corner[0], corner[1], corner[2], corner[0], corner[2], corner[3]});
            }
        }
    }
    for (std::size_t i = 0; i < caps_alone; ++i) {
        SnowCaps::Point& point = caps.points[i];
        const ivec2 cell = sheet.cell_of(vec2(point.base_m.x, point.base_m.z));
        if (!ground.inside(cell.x, cell.y) || eye_m(point.base_m) > kFarthest_m - kOverlap_m) continue;
        const Sheet::Layer* top = below(cell.x, cell.y);
        // Of that ground, not of what stands on it.
        bool of_ground = false;
        for (int n = 0; n < 9 && !of_ground; ++n) {
            const ivec2 at = cell + ivec2(n % 3 - 1, n / 3 - 1);
            of_ground = ground.inside(at.x, at.y) && ground.found(at.x, at.y) && std::abs(ground.height_m(at.x, at.y) - point.base_m.y) < kOfGround_m;
        }
        // Nor of what lies below another ground.
        if (top == nullptr || !of_ground || std::abs(top->height_m - point.base_m.y) > kHighestStep_m) continue;
        const std::size_t k = ground.index(cell.x, cell.y);
        const float sheet_lies = (1.0f - shared::smooth_edge(kReach_m - kFade_m, kReach_m, away[k])) *
                                 shared::smooth_edge(kEdge_m, 2.0f * kEdge_m, from_edge[k]);
        if (!(sheet_lies > 0.0f)) continue;
        point.fade = sheet_lies;
        point.bank_m = std::max(step[k], 1.0e-3f);
        for (std::size_t f = 0; f < SnowCaps::kFills; ++f)
            point.bank_fill_m[f] = ground.smoothed(cell.x, cell.y, SnowCaps::kFillDepths_m[f], top->height_m, vec2(point.base_m.x, point.base_m.z)).height_m - point.base_m.y;
    }
    // Points of no triangle are left out.
    std::vector<std::uint32_t> number(laid.size(), SnowCaps::kNone);
    std::vector<BankPart> list;
    for (auto& [primitive, part] : parts) {
        if (part.points.empty()) continue;
        for (std::uint32_t& point : part.points) {
            if (number[point] == SnowCaps::kNone) {
                number[point] = static_cast<std::uint32_t>(caps.points.size());
                caps.points.push_back(laid[point]);
            }
            point = number[point];
        }
        list.push_back(std::move(part));
    }
    return list;
}

}  // namespace petrichor::scene::detail
