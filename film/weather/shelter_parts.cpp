#include "film/weather/shelter_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "formulas/light/patch_cells.h"
#include "formulas/noise/noise.h"
#include "weather/patches/visibility.h"

namespace petrichor::film {
namespace {

constexpr int kAcross = gpu::kPartCells, kCells = kAcross * kAcross;
constexpr int kUpAxis = 2;
constexpr double kUp = 0.5;
constexpr float kNarrow_m = 0.1f, kWide_m = 3.0f;  // narrower patches are fine enough, wider ones are landscape
constexpr double kOverhead = 0.7;                  // cosine: both sky and shelter within 45 degrees of the zenith
constexpr int kLeastCells = 3;      // of a part
constexpr int kMostBorder = 24;     // sides between cells of both parts: two straight edges, and no leaves
constexpr std::uint32_t kMostNumbers = 65535;  // of patches and parts in the words of a tree
constexpr std::uint8_t kNowhere = 0xff;

struct Asked {
    std::uint8_t part = kNowhere;  // 0 below the sky, 1 below something; kNowhere: no surface of the patch there
    glm::vec3 at{0.0f};
};
using Cells = std::array<Asked, kCells>;

// A patch's own cell, world: the corner with the lowest numbers, and its edge.
struct Box {
    glm::vec3 corner_m;
    float edge_m;
};
Box box_of(const scene::Patches& patches, std::uint32_t patch)
{
    const shared::PatchKey key = patches.key[patch];
    const int level = scene::level_of(key);
    const glm::ivec3 cell(static_cast<int>(key.low & 0x7ffffu),
                          static_cast<int>(key.low >> 19 | (key.high & 63u) << 13),
                          static_cast<int>(key.high >> 6 & 0x7ffffu));
    const float edge_m = patches.level_cell_m(level);
    const glm::vec3 counted(cell - glm::ivec3(shared::kPatchCellBias >> level));
    return {counted * edge_m - shared::kPatchGridShift * patches.cell_m, edge_m};
}

// Both are seen overhead, by the bits of the patch.
bool both_overhead(const weather::VisibleBits& bits)
{
    bool sky = false, shelter = false;
    for (int k = 0; k < weather::kVisibleBits; ++k) {
        if (weather::visible_direction(k).y < kOverhead) continue;
        (weather::sees(bits, k) ? sky : shelter) = true;
    }
    return sky && shelter;
}

class Looks {
public:
    Looks(const scene::Patches& patches, const scene::Tracer& tracer) : patches_(patches), tracer_(tracer) {}

    // The surface of the patch in a cell, u along z and v along x.
    Asked ask(const Box& box, int u, int v) const
    {
        const float step_m = box.edge_m / static_cast<float>(kAcross);
        const glm::vec3 from = box.corner_m + glm::vec3((static_cast<float>(v) + 0.5f) * step_m, box.edge_m,
                                                        (static_cast<float>(u) + 0.5f) * step_m);
        Asked asked;
        const scene::RayHit hit = tracer_.nearest({from, {0.0f, -1.0f, 0.0f}, box.edge_m});
        if (!hit.hit()) return asked;
        const glm::vec3 n = tracer_.triangles().normal(hit.triangle);
        if (shared::patch_axis(hit.back ? -n : n) != kUpAxis) return asked;
        if (hit.back && !tracer_.triangles().double_sided(hit.triangle)) return asked;
        asked.at = from - glm::vec3(0.0f, hit.distance_m, 0.0f);
        asked.at += (hit.back ? -n : n) * lift_m(asked.at);
        const scene::RayHit above = tracer_.nearest({asked.at, {0.0f, 1.0f, 0.0f}});
        // Ground goes on below walls: nobody sees it there.
        const bool within = above.hit() && above.back && !tracer_.triangles().double_sided(above.triangle);
        if (!within) asked.part = above.hit() ? 1u : 0u;
        return asked;
    }
    // What points of a part see: each direction from one of them, as patches do; what is overhead, by which a
    // shelter's edge runs, from the one in its middle, so that parts along the edge are alike.
    weather::VisibleBits visible_from(const std::vector<glm::vec3>& points, const glm::vec3& middle,
                                      const weather::Direction& normal) const
    {
        weather::VisibleBits bits{};
        scene::Tracer::Blocker last;
        const auto from_middle = [&](const glm::vec3& a) { return glm::dot(a - middle, a - middle); };
        const glm::vec3& central = *std::min_element(points.begin(), points.end(), [&](const glm::vec3& a, const glm::vec3& b) {
            return from_middle(a) < from_middle(b);
        });
        for (int k = 0; k < weather::kVisibleBits; ++k) {
            const weather::Direction d = weather::visible_direction(k);
            if (!(weather::dot(d, normal) > 0.0)) continue;
            const glm::vec3& from = d.y > kOverhead ? central
                                                    : points[shared::hash_u(static_cast<std::uint32_t>(k) + 1u) % points.size()];
            if (tracer_.blocked({from, glm::vec3(glm::dvec3(d.x, d.y, d.z))}, &last)) continue;
            bits[static_cast<std::size_t>(k >> 5)] |= 1u << (k & 31);
        }
        return bits;
    }

private:
    const scene::Patches& patches_;
    const scene::Tracer& tracer_;

    float lift_m(const glm::vec3& at) const
    {
        const float far = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        return std::min(0.002f, 0.0057f * patches_.level_cell_m(1)) + 1e-6f * far;
    }
};

std::size_t index_of(int u, int v)
{
    return static_cast<std::size_t>(u + v * kAcross);
}

// Below the sky and below a shelter; nothing where nearly all is one of them, or in too many pieces. Cells
// without surface join the part beside them.
std::optional<gpu::PlaceParts> parts_in(const Cells& cells)
{
    gpu::PlaceParts parts;
    parts.count = 2;
    std::array<int, 2> many{};
    for (std::size_t k = 0; k < cells.size(); ++k) {
        parts.of_cell[k] = cells[k].part;
        if (cells[k].part != kNowhere) ++many[cells[k].part];
    }
    if (std::min(many[0], many[1]) < kLeastCells) return std::nullopt;
    const auto borders = [&](std::size_t a, std::size_t b) {
        return parts.of_cell[a] != parts.of_cell[b] && parts.of_cell[a] != kNowhere && parts.of_cell[b] != kNowhere;
    };
    int border = 0;
    for (int k = 0; k < kCells; ++k) {
        const int u = k % kAcross, v = k / kAcross;
        if (u + 1 < kAcross && borders(index_of(u, v), index_of(u + 1, v))) ++border;
        if (v + 1 < kAcross && borders(index_of(u, v), index_of(u, v + 1))) ++border;
    }
    if (border > kMostBorder) return std::nullopt;
    for (bool left = true; left;) {
        left = false;
        const auto before = parts.of_cell;
        for (int v = 0; v < kAcross; ++v) {
            for (int u = 0; u < kAcross; ++u) {
                if (before[index_of(u, v)] != kNowhere) continue;
                left = true;
                for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    if (u + du < 0 || u + du >= kAcross || v + dv < 0 || v + dv >= kAcross) continue;
                    if (const std::uint8_t there = before[index_of(u + du, v + dv)]; there != kNowhere)
                        parts.of_cell[index_of(u, v)] = there;
                }
            }
        }
    }
    return parts;
}

// The first cells that are asked: where these all see the same nothing is cut.
bool may_differ(const Looks& looks, const Box& box)
{
    std::uint8_t first = kNowhere;
    for (int k = 0; k < 16; ++k) {
        const std::uint8_t part = looks.ask(box, k % 4 * 2 + (k / 4 & 1), k / 4 * 2 + (k & 1)).part;
        if (part == kNowhere) continue;
        if (first != kNowhere && part != first) return true;
        first = part;
    }
    return false;
}

// A row of lists for each part, as the patch has it.
template <class Begin, class Lists>
void repeat_rows(Begin& begin, std::uint32_t patch, std::uint32_t times, const Lists& copy)
{
    for (std::uint32_t k = 0; k < times; ++k) {
        copy(begin[patch], begin[patch + 1]);
        begin.push_back(begin.back() + begin[patch + 1] - begin[patch]);
    }
}
template <class T>
void append_again(std::vector<T>& list, std::uint32_t from, std::uint32_t to)
{
    for (std::uint32_t k = from; k < to; ++k) list.push_back(T(list[k]));
}

}  // namespace

ShelterParts cut_at_shelters(weather::PatchSet& set, const scene::Patches& patches, const scene::Tracer& tracer)
{
    ShelterParts all;
    all.patches = patches.count;
    all.position_m.assign(patches.position_m.begin(), patches.position_m.begin() + patches.count);
    for (std::uint32_t i = 0; i < patches.count; ++i) all.of.push_back(i);
    const Looks looks(patches, tracer);
    std::uint32_t numbers = patches.count;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const weather::WeatherPatch whole = set.patches[i];
        const Box box = box_of(patches, i);
        if (whole.normal.y < kUp || scene::axis_of(patches.key[i]) != kUpAxis || set.kinds[whole.kind].like_air ||
            box.edge_m < kNarrow_m || box.edge_m > kWide_m || !both_overhead(whole.visible) || !may_differ(looks, box))
            continue;
        Cells cells;
        for (int v = 0; v < kAcross; ++v)
            for (int u = 0; u < kAcross; ++u) cells[index_of(u, v)] = looks.ask(box, u, v);
        std::optional<gpu::PlaceParts> parts = parts_in(cells);
        if (!parts || numbers + parts->count > kMostNumbers) continue;
        parts->patch = i;
        parts->first = numbers - patches.count;
        numbers += parts->count;
        const auto extra = static_cast<std::uint32_t>(set.patches.size());
        std::array<std::vector<glm::vec3>, gpu::kMostParts> points;
        std::size_t found = 0;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k].part == kNowhere) continue;
            points[parts->of_cell[k]].push_back(cells[k].at);
            ++found;
        }
        for (std::uint32_t part = 0; part < parts->count; ++part) {
            weather::WeatherPatch p = whole;
            const std::vector<glm::vec3>& own = points[part];
            p.area_m2 = whole.area_m2 * static_cast<double>(own.size()) / static_cast<double>(found);
            glm::vec3 middle(0.0f);
            for (const glm::vec3& at : own) middle += at;
            middle = middle / static_cast<float>(own.size());
            p.visible = looks.visible_from(own, middle, p.normal);
            p.sky_share = std::min(1.0, weather::sky_shares(p.visible, p.normal).sky);
            p.patch_share = whole.sky_share < 1.0 ? std::min(1.0, whole.patch_share / (1.0 - whole.sky_share)) * (1.0 - p.sky_share) : 0.0;
            if (part == 0) {
                set.patches[i] = p;
                all.position_m[i] = middle;
            } else {
                set.patches.push_back(p);
                all.position_m.push_back(middle);
                all.of.push_back(i);
            }
        }
        const std::uint32_t more = parts->count - 1;
        repeat_rows(set.link_begin, i, more, [&](std::uint32_t from, std::uint32_t to) { append_again(set.links, from, to); });
        if (!set.beside_begin.empty()) {
            repeat_rows(set.beside_begin, i, more, [&](std::uint32_t from, std::uint32_t to) {
                append_again(set.beside, from, to);
                append_again(set.beside_m, from, to);
            });
        }
        for (std::uint32_t k = 0; !set.upwind.empty() && k < more; ++k) set.upwind.push_back(set.upwind[i]);
        all.cuts.push_back({*parts, extra});
    }
    return all;
}

std::vector<glm::vec4> states_with_parts(std::vector<glm::vec4> states, std::size_t texels, const ShelterParts& shelter,
                                         std::span<const double> area_m2)
{
    if (shelter.cuts.empty()) return states;
    std::vector<glm::vec4> parts;
    for (const ShelterParts::Cut& cut : shelter.cuts)
        for (std::uint32_t part = 0; part < cut.parts.count; ++part)
            for (std::size_t k = 0; k < texels; ++k) parts.push_back(states[cut.weather_patch(part) * texels + k]);
    states.resize(shelter.patches * texels);
    std::size_t at = 0;
    for (const ShelterParts::Cut& cut : shelter.cuts) {
        for (std::size_t k = 0; k < texels; ++k) {
            glm::dvec4 sum(0.0);
            double area = 0.0;
            for (std::uint32_t part = 0; part < cut.parts.count; ++part) {
                const double own = area_m2[cut.weather_patch(part)];
                sum += own * glm::dvec4(parts[at + part * texels + k]);
                area += own;
            }
            states[cut.parts.patch * texels + k] = glm::vec4(sum / area);
        }
        at += cut.parts.count * texels;
    }
    states.insert(states.end(), parts.begin(), parts.end());
    return states;
}

}  // namespace petrichor::film
