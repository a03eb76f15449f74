#include "scene/snow/detail/bank.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/detail/one_ground.h"

namespace petrichor::scene::detail {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kSteepStep = 0.7f;      // steps from cell to cell that are no steeper are slopes
constexpr float kReach_m = 0.22f;       // so far from a step the sheet reaches
constexpr float kFade_m = 0.07f;        // .. and goes under the caps along the last of it
constexpr float kCorner_m = 0.18f;      // so far from a step a bank is heaped up
constexpr float kSteepest = 0.87f;      // y of the normal of the smoothed ground: steeper is no place for a bank
constexpr float kEdge_m = 0.1f;         // from a deep edge: none within this, a whole one from twice as far on
constexpr std::array<float, 3> kReaches_m{3.0f, 11.0f, 22.0f};  // up to here from an eye a level of cells, each half as fine
constexpr float kFarthest_m = kReaches_m.back();
constexpr float kOverlap_m = 0.4f;
constexpr float kOfGround_m = 0.04f;
constexpr float kHolds = 0.02f;         // share of the depth: less is no ground that snow lies on

// How high a step is that a cell lies at; 0 at none.
float step_at(const OneGround& ground, int x, int z, float cell_m)
{
    if (!ground.found(x, z)) return 0.0f;
    float step = 0.0f;
    for (const ivec2 way : {ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1)}) {
        int apart = 1;
        while (!ground.found(x + apart * way.x, z + apart * way.y) && apart < OneGround::kJoint) ++apart;
        if (!ground.found(x + apart * way.x, z + apart * way.y)) continue;
        const float rise = std::abs(ground.height_m(x + apart * way.x, z + apart * way.y) - ground.height_m(x, z));
        if (rise > kHighestStep_m) continue;
        if (rise > OneGround::kStep_m && rise > kSteepStep * cell_m * static_cast<float>(apart)) step = std::max(step, rise);
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

// What holds of snow over steps, as the points of the caps near a place know it: banks lie over them and have no edges.
class SheetHold {
public:
    explicit SheetHold(const SnowCaps& caps) : caps_(&caps)
    {
        for (std::uint32_t i = 0; i < caps.points.size(); ++i) {
            const SnowCaps::Point& point = caps.points[i];
            const auto limited = [](float most_m) { return most_m < SnowCaps::kAnyDepth_m; };
            if (std::any_of(point.sheet_most_m.begin(), point.sheet_most_m.end(), limited)) cells_[cell_of(point.base_m)].push_back(i);
        }
    }
    std::array<float, SnowCaps::kFills> at(const vec3& place) const
    {
        std::array<float, SnowCaps::kFills> most = SnowCaps::Point{}.sheet_most_m;
        float best = kNear_m;
        const auto [x, z] = cell_of(place);
        for (int k = 0; k < 9; ++k) {
            const auto cell = cells_.find({x + k % 3 - 1, z + k / 3 - 1});
            if (cell == cells_.end()) continue;
            for (const std::uint32_t i : cell->second) {
                const float apart = glm::distance(caps_->points[i].base_m, place);
                if (!(apart < best)) continue;
                best = apart;
                most = caps_->points[i].sheet_most_m;
            }
        }
        return most;
    }

private:
    static constexpr float kNear_m = 0.35f;
    static std::pair<int, int> cell_of(const vec3& place)
    {
        return {static_cast<int>(std::floor(place.x / kNear_m)), static_cast<int>(std::floor(place.z / kNear_m))};
    }
    const SnowCaps* caps_;
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> cells_;
};

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
    const SheetHold hold(caps);
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
    for (std::size_t level = 0; level < kReaches_m.size(); ++level) {
        const int stride = 1 << level;
        const float from_m = level == 0 ? 0.0f : kReaches_m[level - 1] - kOverlap_m, to_m = kReaches_m[level];
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
            point.slope = point.broad_slope = snow_on_slope(up);
            point.share = point.broad = seen * point.slope;
            point.uneven = uneven_at(point.base_m, cell_m * static_cast<float>(stride));
            const std::size_t cell = ground.index(x, z);
            point.bank = 1.0f;
            point.sheet_most_m = hold.at(point.base_m);
            point.bank_m = std::max(step[cell], 1.0e-3f);
            point.corner = 1.0f - shared::smooth_edge(0.0f, kCorner_m, away[cell]);
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
