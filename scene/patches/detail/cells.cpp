#include "scene/patches/detail/cells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/detail/sight_groups.h"
#include "scene/patches/lamps.h"

namespace petrichor::scene {

float ray_lift_m(glm::vec3 position, float regular_cell_m)
{
    const float far =
        std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    return std::min(0.002f, 0.0057f * regular_cell_m) + 1e-6f * far;
}

std::optional<Ray> ray_between(glm::vec3 from, glm::vec3 to, float margin_m)
{
    const glm::vec3 way = to - from;
    const float length = std::sqrt(glm::dot(way, way));
    if (!(length > 2.0f * margin_m)) return std::nullopt;
    const glm::vec3 direction = way / length;
    return Ray{from + direction * margin_m, direction, length - 2.0f * margin_m};
}

std::uint32_t CellMap::find(shared::PatchKey key) const
{
    if (slots_.empty()) return kNone;
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = shared::patch_key_hash(key) & mask;; i = (i + 1) & mask) {
        const Slot& slot = slots_[i];
        if (slot.value == kNone) return kNone;
        if (slot.key.low == key.low && slot.key.high == key.high) return slot.value;
    }
}

std::uint32_t CellMap::find_or_add(shared::PatchKey key, std::uint32_t fresh)
{
    if (used_ * 2 >= slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = shared::patch_key_hash(key) & mask;; i = (i + 1) & mask) {
        Slot& slot = slots_[i];
        if (slot.value == kNone) {
            slot = {key, fresh};
            ++used_;
            return fresh;
        }
        if (slot.key.low == key.low && slot.key.high == key.high) return slot.value;
    }
}

void CellMap::grow()
{
    std::vector<Slot> old(slots_.empty() ? 1024 : slots_.size() * 2);
    old.swap(slots_);
    used_ = 0;
    for (const Slot& slot : old) {
        if (slot.value != kNone) find_or_add(slot.key, slot.value);
    }
}

namespace {

// Samples of a face: one every cell^2 / 48, as the reference has it.
constexpr float kSamplesACell = 48.0f;
// 1 less the length of the mean of unit normals: where they lie about 8 degrees about their mean.
constexpr float kBends = 0.01f;
// More than this are never held at once, 28 bytes each.
constexpr std::size_t kMostRawSamples = 6'000'000;
constexpr std::size_t kTrianglesAJob = 2048;
// A triangle larger than so many cells is quartered, so that what lies in finished cells is skipped.
constexpr float kCellsAPiece = 16.0f;
constexpr int kDeepestQuartering = 24;
// The longest cell beside a lamp, over its distance.
constexpr float kLampShare = 1.0f;

struct RawSample {
    shared::PatchKey key;
    PatchSample point;
    float area_m2;
};

// A part of a triangle, in barycentric coordinates of the whole.
struct Piece {
    Barycentric a, b, c;
    std::uint64_t hash;
    int depth;
};

Barycentric middle(Barycentric p, Barycentric q)
{
    return {0.5f * (p.b1 + q.b1), 0.5f * (p.b2 + q.b2)};
}

// What is known of a cell and those above it.
enum class Known { Nothing, Split, Done };

class Grower {
public:
    Grower(const Tracer& tracer, const CellPlan& plan, const PatchOptions& options)
        : tracer_(tracer),
          triangles_(tracer.triangles()),
          plan_(plan),
          options_(options),
          lamps_m_(lamps_that_cut(triangles_.scene()))
    {
    }

    bool grow()
    {
        for (level_ = plan_.levels - 1; level_ >= 0; --level_) {
            if (level_ == 0 && !options_.split_by_sight) break;
            if (options_.stop && options_.stop())
                throw Interrupted("interrupted while the scene was cut into patches");
            if (options_.progress) {
                options_.progress("patches", static_cast<float>(plan_.levels - 1 - level_) /
                                                 static_cast<float>(plan_.levels));
            }
            if (!grow_level()) return false;
        }
        settle();
        return true;
    }

    std::vector<Cell> take() { return std::move(cells_); }
    int level() const { return level_; }

private:
    bool grow_level();
    void sample_triangle(std::uint32_t t, std::vector<RawSample>& out) const;
    void sample_side(std::uint32_t t, const Piece& piece, float area, bool back,
                     std::vector<RawSample>& out) const;
    Known known(glm::ivec3 cell0, int axis, int level) const;
    bool finished(const glm::vec3& low, const glm::vec3& high, int axis) const;
    bool unwanted(const glm::vec3& low, const glm::vec3& high, int axis, float samples) const;
    bool wants(glm::ivec3 cell0, int axis) const;
    std::uint32_t add_cell(shared::PatchKey key);
    void examine(Cell& cell, const RawSample* const* raw, std::size_t count) const;
    // What the first rays of a sample say.
    struct Outlook {
        bool buried = false;
        bool outer = false;  ///< most of them are longer than a twig's distance
        int sky = 0;         ///< rays that reach it
        float inverse_distances = 0.0f;
        int rays = 0;
    };
    void look_out(std::span<const SamplePoint> points, std::span<const std::uint64_t> hashes,
                  std::span<Outlook> outlooks) const;
    Outlook look_out(const SamplePoint& point, std::uint64_t hash) const;
    bool holds_content(const Cell& cell) const;
    bool near_a_lamp(const Cell& cell) const;
    std::vector<PatchSample> outsiders(const Cell& cell, const RawSample* const* raw, std::size_t count, std::uint64_t hash) const;
    void settle();

    float cell_edge_m(int level) const
    {
        return plan_.cell_m * static_cast<float>(std::uint32_t{1} << level);
    }

    const Tracer& tracer_;
    const Triangles& triangles_;
    CellPlan plan_;
    const PatchOptions& options_;
    int level_ = 0;
    CellMap map_;
    std::vector<Cell> cells_;
    std::vector<glm::vec3> lamps_m_;
};

Known Grower::known(glm::ivec3 cell0, int axis, int level) const
{
    for (; level < plan_.levels; ++level) {
        const std::uint32_t found = map_.find(key_of(cell0, axis, level));
        if (found == CellMap::kNone) continue;
        return cells_[found].state == CellState::Split ? Known::Split : Known::Done;
    }
    return Known::Nothing;
}

// Whether a sample of this level is wanted there: no cell above is done.
bool Grower::wants(glm::ivec3 cell0, int axis) const
{
    if (level_ == 0) {  // only cuts cells that a wall parts: those exist
        const std::uint32_t found = map_.find(key_of(cell0, axis, 1));
        return found != CellMap::kNone && cells_[found].state == CellState::Split;
    }
    return known(cell0, axis, level_ + 1) != Known::Done;
}

// Whether all that a box touches is done. Asked at the finest level at which that takes few
// questions, so that a plain of 10 km ends at its first piece.
bool Grower::finished(const glm::vec3& low, const glm::vec3& high, int axis) const
{
    const glm::ivec3 first = cell_of(low, plan_.cell_m), last = cell_of(high, plan_.cell_m);
    for (int level = level_ + 1; level < plan_.levels; ++level) {
        const glm::ivec3 a{first.x >> level, first.y >> level, first.z >> level};
        const glm::ivec3 b{last.x >> level, last.y >> level, last.z >> level};
        const std::int64_t many =
            std::int64_t{b.x - a.x + 1} * (b.y - a.y + 1) * std::int64_t{b.z - a.z + 1};
        if (many > 64) continue;
        // Cells that nothing was found in hold air, or slivers that no sample met.
        bool any = false;
        for (int z = a.z; z <= b.z; ++z) {
            for (int y = a.y; y <= b.y; ++y) {
                for (int x = a.x; x <= b.x; ++x) {
                    const Known there = known({x << level, y << level, z << level}, axis, level);
                    if (there == Known::Split) return false;
                    any = any || there == Known::Done;
                }
            }
        }
        return any;
    }
    return false;
}

// Whether no sample in a box is wanted, asked where that takes less than asking for each of so many: small triangles lie
// in finished cells in their millions.
bool Grower::unwanted(const glm::vec3& low, const glm::vec3& high, int axis, float samples) const
{
    const glm::ivec3 first = cell_of(low, plan_.cell_m), last = cell_of(high, plan_.cell_m);
    for (int level = level_ + 1; level < (level_ == 0 ? 2 : plan_.levels); ++level) {
        const glm::ivec3 a{first.x >> level, first.y >> level, first.z >> level};
        const glm::ivec3 b{last.x >> level, last.y >> level, last.z >> level};
        const std::int64_t many =
            std::int64_t{b.x - a.x + 1} * (b.y - a.y + 1) * std::int64_t{b.z - a.z + 1};
        if (2.0f * static_cast<float>(many) > samples) continue;
        for (int z = a.z; z <= b.z; ++z) {
            for (int y = a.y; y <= b.y; ++y) {
                for (int x = a.x; x <= b.x; ++x) {
                    const glm::ivec3 cell0{x << level, y << level, z << level};
                    if (level_ == 0 ? wants(cell0, axis) : known(cell0, axis, level) != Known::Done) return false;
                }
            }
        }
        return true;
    }
    return false;
}

void Grower::sample_side(std::uint32_t t, const Piece& whole, float whole_area, bool back,
                         std::vector<RawSample>& out) const
{
    const float edge = cell_edge_m(level_);
    const float spacing = edge * edge / kSamplesACell;
    glm::vec3 n = triangles_.normal(t);
    if (back) n = -n;
    const int axis = shared::patch_axis(n);
    std::vector<Piece> stack{whole};
    while (!stack.empty()) {
        const Piece piece = stack.back();
        stack.pop_back();
        const float area = whole_area / static_cast<float>(std::uint64_t{1} << (2 * piece.depth));
        if (area > kCellsAPiece * edge * edge && piece.depth < kDeepestQuartering) {
            const glm::vec3 a = triangles_.point(t, piece.a), b = triangles_.point(t, piece.b),
                            c = triangles_.point(t, piece.c);
            if (finished(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), axis)) continue;
            const Barycentric ab = middle(piece.a, piece.b), bc = middle(piece.b, piece.c),
                              ca = middle(piece.c, piece.a);
            const int depth = piece.depth + 1;
            stack.push_back({piece.a, ab, ca, mixed(piece.hash, 1), depth});
            stack.push_back({ab, piece.b, bc, mixed(piece.hash, 2), depth});
            stack.push_back({ca, bc, piece.c, mixed(piece.hash, 3), depth});
            stack.push_back({bc, ca, ab, mixed(piece.hash, 4), depth});
            continue;
        }
        const float expected = area / spacing;
        const auto count = static_cast<int>(expected + unit_float(mixed(piece.hash, 11)));
        if (count == 0) continue;
        if (expected >= 2.0f) {
            const glm::vec3 a = triangles_.point(t, piece.a), b = triangles_.point(t, piece.b),
                            c = triangles_.point(t, piece.c);
            if (unwanted(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), axis, expected)) continue;
        }
        // Small triangles are drawn with their chance and stand for a whole share then.
        const float weight = expected >= 1.0f ? area / static_cast<float>(count) : spacing;
        const float shift_u = unit_float(mixed(piece.hash, 12));
        const float shift_v = unit_float(mixed(piece.hash, 13));
        if (out.size() > kMostRawSamples) return;
        for (int k = 0; k < count; ++k) {
            // R2 sequence (Roberts 2018), folded into the triangle.
            float u = fraction(shift_u + 0.75487767f * static_cast<float>(k + 1));
            float v = fraction(shift_v + 0.56984029f * static_cast<float>(k + 1));
            if (u + v > 1.0f) {
                u = 1.0f - u;
                v = 1.0f - v;
            }
            const Barycentric at{
                piece.a.b1 + u * (piece.b.b1 - piece.a.b1) + v * (piece.c.b1 - piece.a.b1),
                piece.a.b2 + u * (piece.b.b2 - piece.a.b2) + v * (piece.c.b2 - piece.a.b2)};
            const glm::ivec3 cell0 = cell_of(triangles_.point(t, at), plan_.cell_m);
            if (!wants(cell0, axis) || triangles_.is_hole(t, at)) continue;
            out.push_back({key_of(cell0, axis, level_), {t, at, back}, weight});
        }
    }
}

void Grower::sample_triangle(std::uint32_t t, std::vector<RawSample>& out) const
{
    // From the triangle itself, so that others may come and go.
    std::uint64_t hash = mixed(options_.seed, static_cast<std::uint64_t>(level_));
    for (const glm::vec3& p : {triangles_.corner(t), triangles_.edge1(t), triangles_.edge2(t)}) {
        for (int k = 0; k < 3; ++k) hash = mixed(hash, std::bit_cast<std::uint32_t>(p[k]));
    }
    const float area = triangles_.area_m2(t);
    const Piece whole{{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, hash, 0};
    sample_side(t, whole, area, false, out);
    if (triangles_.double_sided(t)) {
        Piece other = whole;
        other.hash = mixed(hash, 21);
        sample_side(t, other, area, true, out);
    }
}

std::uint32_t Grower::add_cell(shared::PatchKey key)
{
    const auto fresh = static_cast<std::uint32_t>(cells_.size());
    const std::uint32_t found = map_.find_or_add(key, fresh);
    if (found == fresh) {
        cells_.push_back({});
        cells_.back().key = key;
    }
    return found;
}

// Three rays of each; where one meets the back of a single-sided face, five more. 1 / distance of the rays is
// added up, each at least a regular cell long.
void Grower::look_out(std::span<const SamplePoint> points, std::span<const std::uint64_t> hashes,
                      std::span<Outlook> outlooks) const
{
    constexpr int kFirst = 3, kRays = 8;
    const float regular = cell_edge_m(1);
    struct Of {
        std::size_t point;
        int r;
    };
    std::array<Ray, kPatchSamples * kRays> rays;
    std::array<Of, kPatchSamples * kRays> of;
    std::array<RayHit, kPatchSamples * kRays> hits;
    std::array<int, kPatchSamples> backs{}, near{};
    const auto ask = [&](int first, int last) {
        std::size_t count = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (first > 0 && backs[p] == 0) continue;
            const SamplePoint& point = points[p];
            const std::uint64_t hash = hashes[p];
            const glm::vec3 origin = point.position_m + point.normal * ray_lift_m(point.position_m, regular);
            for (int r = first; r < last; ++r) {
                const float u = (static_cast<float>(r) + unit_float(hash)) / static_cast<float>(kRays);
                // 0, 3, 6, 1, ...: the first three cover all heights.
                const float height = fraction(u * 3.0f);
                const float turn = fraction(kGoldenRatio * static_cast<float>(r) + unit_float(mixed(hash, 5)));
                rays[count] = {origin, cosine_direction(point.normal, height, turn)};
                of[count++] = {p, r};
            }
        }
        tracer_.nearest({rays.data(), count}, hits);
        for (std::size_t k = 0; k < count; ++k) {
            const auto [p, r] = of[k];
            Outlook& outlook = outlooks[p];
            const RayHit& hit = hits[k];
            ++outlook.rays;
            if (!hit.hit()) {
                outlook.sky += rays[k].direction.y > 0.0f ? 1 : 0;
                continue;
            }
            if (r < kFirst && hit.distance_m < regular) ++near[p];
            if (hit.back && !triangles_.double_sided(hit.triangle)) ++backs[p];
            outlook.inverse_distances += 1.0f / std::max(hit.distance_m, regular);
        }
    };
    assert(points.size() <= std::size_t{kPatchSamples});
    std::fill_n(outlooks.begin(), points.size(), Outlook{});
    ask(0, kFirst);
    ask(kFirst, kRays);
    for (std::size_t p = 0; p < points.size(); ++p) {
        outlooks[p].buried = backs[p] >= 2;
        outlooks[p].outer = near[p] <= 1;
    }
}

Grower::Outlook Grower::look_out(const SamplePoint& point, std::uint64_t hash) const
{
    Outlook outlook;
    look_out({&point, 1}, {&hash, 1}, {&outlook, 1});
    return outlook;
}

bool Grower::holds_content(const Cell& cell) const
{
    return std::any_of(cell.samples.begin(), cell.samples.begin() + cell.points,
                       [&](const PatchSample& s) {
                           return (triangles_.flags(s.triangle) & kTriangleBackdrop) == 0;
                       });
}

// Light of a lamp changes within its distance: cells are cut that are longer than a share of it.
bool Grower::near_a_lamp(const Cell& cell) const
{
    const float near_m = cell_edge_m(level_) / kLampShare;
    return std::any_of(lamps_m_.begin(), lamps_m_.end(), [&](const glm::vec3& lamp_m) {
        return std::any_of(cell.samples.begin(), cell.samples.begin() + cell.points, [&](const PatchSample& s) {
            const glm::vec3 way = triangles_.point(s.triangle, s.at) - lamp_m;
            return glm::dot(way, way) < near_m * near_m;
        });
    });
}

constexpr int kMoreAsked = 32;
constexpr int kLeastOuter = 3;

// Leaves, heaps, grass: what is seen of them, and what they send, is their outside. Where fewer than
// half of the samples look out, they alone stand for the cell.
void keep_outer(Cell& cell, const std::array<bool, kPatchSamples>& outer)
{
    const auto looking = static_cast<int>(
        std::count(outer.begin(), outer.begin() + cell.points, true));
    if (looking < 2 || 2 * looking > cell.points) return;
    int kept = 0;
    for (int k = 0; k < cell.points; ++k) {
        if (outer[static_cast<std::size_t>(k)])
            cell.samples[static_cast<std::size_t>(kept++)] =
                cell.samples[static_cast<std::size_t>(k)];
    }
    cell.points = kept;
}

// Samples that are shut in leave the cell, with their share of its area.
void keep_open(Cell& cell, std::uint32_t shut)
{
    const int before = cell.points;
    cell.points = 0;
    for (int k = 0; k < before; ++k) {
        if ((shut >> k & 1u) == 0)
            cell.samples[static_cast<std::size_t>(cell.points++)] = cell.samples[static_cast<std::size_t>(k)];
    }
    cell.area_m2 *= static_cast<float>(cell.points) / static_cast<float>(before);
}

// Samples that see none of the cell's but the sky; at most as many as a cell keeps, and of cells that are cut the first one alone.
std::vector<PatchSample> Grower::outsiders(const Cell& cell, const RawSample* const* raw, std::size_t count, std::uint64_t hash) const
{
    const float regular = cell_edge_m(1);
    const auto lifted = [&](const PatchSample& sample) {
        const SamplePoint point = sample_point(triangles_, sample);
        return point.position_m + point.normal * (kSightLift * regular);
    };
    std::array<glm::vec3, 3> inside;
    for (int k = 0; k < 3; ++k) inside[static_cast<std::size_t>(k)] = lifted(cell.samples[static_cast<std::size_t>(k * (cell.points - 1) / 2)]);
    std::vector<PatchSample> found;
    const std::size_t most = level_ == 0 ? std::size_t{kPatchSamples} : 1;
    for (std::size_t at = 0; at < count && found.size() < most; ++at) {
        const PatchSample& sample = raw[at]->point;
        const glm::vec3 from = lifted(sample);
        if (std::any_of(inside.begin(), inside.end(), [&](const glm::vec3& to) { return !tracer_.blocked_between(from, to); })) continue;
        const std::uint64_t own = mixed(hash, 1000 + at);
        if (look_out(sample_point(triangles_, sample), own).buried) continue;
        if (sky_rays(tracer_, {&sample, 1}, regular, own) >= kSeesTheSky) found.push_back(sample);
    }
    return found;
}

void Grower::examine(Cell& cell, const RawSample* const* raw, std::size_t count) const
{
    const std::uint64_t hash = cell_hash(options_.seed, cell.key);
    float inverse_distances = 0.0f;
    int rays = 0, sky = 0;
    int tested = 0;
    std::array<bool, kPatchSamples> outer{};
    // A stride through all samples first, then the ones beside them.
    const std::size_t wanted = std::min<std::size_t>(count, kPatchSamples);
    const std::size_t rounds = std::min<std::size_t>((count + wanted - 1) / wanted, 3);
    for (std::size_t round = 0; round < rounds; ++round) {
        // As many as may be kept are asked together.
        for (std::size_t k = 0; k < wanted && cell.points < kPatchSamples;) {
            std::array<std::size_t, kPatchSamples> asked;
            std::array<SamplePoint, kPatchSamples> points;
            std::array<std::uint64_t, kPatchSamples> hashes;
            std::array<Outlook, kPatchSamples> outlooks;
            std::size_t many = 0;
            for (const auto most = static_cast<std::size_t>(kPatchSamples - cell.points); k < wanted && many < most; ++k) {
                const std::size_t first = k * count / wanted, last = (k + 1) * count / wanted;
                const std::size_t at = first + round * std::max<std::size_t>((last - first) / rounds, 1);
                if (at >= last) continue;
                asked[many] = at;
                points[many] = sample_point(triangles_, raw[at]->point);
                hashes[many++] = mixed(hash, at);
            }
            look_out({points.data(), many}, hashes, outlooks);
            for (std::size_t i = 0; i < many; ++i) {
                ++tested;
                const Outlook& outlook = outlooks[i];
                if (outlook.buried) continue;
                inverse_distances += outlook.inverse_distances;
                rays += outlook.rays;
                sky += outlook.sky;
                outer[static_cast<std::size_t>(cell.points)] = outlook.outer;
                cell.samples[static_cast<std::size_t>(cell.points++)] = raw[asked[i]]->point;
            }
        }
    }
    if (cell.points == 0) {
        cell.state = CellState::Buried;
        return;
    }
    // Of dense leaves few are outside: more are asked, and stand in for those within.
    auto looking = static_cast<int>(std::count(outer.begin(), outer.begin() + cell.points, true));
    for (int k = 0; k < kMoreAsked && looking < kLeastOuter && cell.points == kPatchSamples; ++k) {
        const float along = fraction(kGoldenRatio * static_cast<float>(k + 1));
        const auto at = std::min(static_cast<std::size_t>(along * static_cast<float>(count)), count - 1);
        const PatchSample& sample = raw[at]->point;
        const Outlook outlook = look_out(sample_point(triangles_, sample), mixed(hash, at));
        if (outlook.buried || !outlook.outer) continue;
        const auto within = std::find(outer.begin(), outer.end(), false);
        cell.samples[static_cast<std::size_t>(within - outer.begin())] = sample;
        *within = true;
        ++looking;
    }
    float area = 0.0f;
    for (std::size_t i = 0; i < count; ++i) area += raw[i]->area_m2;
    cell.area_m2 = area * static_cast<float>(cell.points) / static_cast<float>(tested);
    keep_outer(cell, outer);
    std::optional<SightGroups> groups;
    std::uint32_t shut = 0;
    if (level_ <= 1 && options_.split_by_sight) {
        groups = sight_groups(tracer_, cell, cell_edge_m(1));
        if (groups->parted()) shut = shut_in(tracer_, cell, *groups, cell_edge_m(1), hash);
        // Of cells that nothing cuts further.
        if (level_ == 0 && shut != 0) keep_open(cell, shut);
        // Of others a corner alone may stand outside, so small that none of the samples lies there.
        if (shut == 0 && sky == 0 && count > kPatchSamples) {
            const std::vector<PatchSample> outside = outsiders(cell, raw, count, hash);
            if (level_ == 1 && !outside.empty()) shut = 1;
            if (level_ == 0 && !outside.empty()) {
                cell.points = static_cast<int>(outside.size());
                std::copy(outside.begin(), outside.end(), cell.samples.begin());
                cell.area_m2 = area * static_cast<float>(cell.points) / static_cast<float>(count);
            }
        }
    }
    for (int k = 0; k < cell.points; ++k) {
        const SamplePoint point =
            sample_point(triangles_, cell.samples[static_cast<std::size_t>(k)]);
        cell.position_m += point.position_m;
        cell.normal += point.normal;
    }
    cell.position_m = cell.position_m / static_cast<float>(cell.points);
    const float length = std::sqrt(glm::dot(cell.normal, cell.normal));
    cell.normal = length > 1e-3f ? cell.normal / length
                                 : sample_point(triangles_, cell.samples[0]).normal;
    cell.state = CellState::Leaf;
    if (level_ > 1) {
        // Ward 1988: the harmonic mean distance of what is seen.
        const float mean = inverse_distances / static_cast<float>(std::max(rays, 1));
        const bool coarse = level_ >= plan_.content_levels && holds_content(cell);
        // Sun and snow tell the slopes of a hill apart, though all of them see nothing but the sky.
        const bool bends = cell_edge_m(level_) > plan_.slope_m &&
                           length < (1.0f - kBends) * static_cast<float>(cell.points);
        if (coarse || bends || cell_edge_m(level_) * mean > 0.25f || near_a_lamp(cell))
            cell.state = CellState::Split;
    } else if (level_ == 1 && groups && (groups->large() || shut != 0 || near_a_lamp(cell))) {
        cell.state = CellState::Split;
    }
}

bool Grower::grow_level()
{
    // Samples, in the order of the triangles.
    const std::size_t jobs = (triangles_.size() + kTrianglesAJob - 1) / kTrianglesAJob;
    std::vector<std::vector<RawSample>> found(jobs);
    std::atomic<std::size_t> total{0};
    parallel_for(jobs, options_.threads, [&](std::size_t job) {
        if (total >= kMostRawSamples) return;
        const auto first = static_cast<std::uint32_t>(job * kTrianglesAJob);
        const auto last = std::min(first + static_cast<std::uint32_t>(kTrianglesAJob),
                                   triangles_.size());
        for (std::uint32_t t = first; t < last && found[job].size() < kMostRawSamples; ++t)
            sample_triangle(t, found[job]);
        total += found[job].size();
    });
    // Whatever the threads did when they stopped early: the whole is too much either way.
    if (total >= kMostRawSamples) return false;

    // Group by cell.
    const std::size_t before = cells_.size();
    std::vector<std::uint32_t> cell_of_sample;
    cell_of_sample.reserve(total);
    for (const auto& list : found) {
        for (const RawSample& sample : list) {
            cell_of_sample.push_back(add_cell(sample.key));
            if (cells_.size() - before > std::size_t{plan_.most} * 2) return false;
        }
    }
    const std::size_t fresh = cells_.size() - before;
    std::vector<std::size_t> start(fresh + 1, 0);
    for (const std::uint32_t c : cell_of_sample) ++start[c - before + 1];
    for (std::size_t i = 0; i < fresh; ++i) start[i + 1] += start[i];
    std::vector<const RawSample*> grouped(cell_of_sample.size());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    std::size_t number = 0;
    for (const auto& list : found) {
        for (const RawSample& sample : list) grouped[next[cell_of_sample[number++] - before]++] = &sample;
    }

    parallel_for(fresh, options_.threads, [&](std::size_t i) {
        examine(cells_[before + i], grouped.data() + start[i], start[i + 1] - start[i]);
    });

    // Parents that got no sample of their own.
    for (std::size_t i = before; i < before + fresh; ++i) {
        for (shared::PatchKey key = cells_[i].key; level_of(key) + 1 < plan_.levels;) {
            key = parent_of(key);
            const std::size_t known = cells_.size();
            add_cell(key);
            if (cells_.size() == known) break;
        }
    }
    std::size_t leaves = 0;
    for (const Cell& cell : cells_) leaves += cell.state == CellState::Leaf ? 1 : 0;
    return leaves <= plan_.most;
}

// Split cells without a living child are leaves, or nothing.
void Grower::settle()
{
    std::vector<std::size_t> order(cells_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return level_of(cells_[a].key) < level_of(cells_[b].key);
    });
    std::vector<bool> has_child(cells_.size(), false);
    for (const std::size_t i : order) {
        Cell& cell = cells_[i];
        if (cell.state == CellState::Split && !has_child[i])
            cell.state = cell.points > 0 ? CellState::Leaf : CellState::Buried;
        if (cell.state == CellState::Buried || level_of(cell.key) + 1 >= plan_.levels) continue;
        const std::uint32_t parent = map_.find(parent_of(cell.key));
        if (parent != CellMap::kNone) has_child[parent] = true;
    }
}

}  // namespace

GrownCells grow_cells(const Tracer& tracer, const CellPlan& plan, const PatchOptions& options)
{
    Grower grower(tracer, plan, options);
    GrownCells grown;
    grown.fit = grower.grow();
    grown.level = grower.level();
    if (grown.fit) grown.cells = grower.take();
    return grown;
}

}  // namespace petrichor::scene
