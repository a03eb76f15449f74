#include "scene/patches/detail/near_choice.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "formulas/light/near_light.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/near_rays.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lookup.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kKept = NearLinks::kMostAPatch;
constexpr std::size_t kJudged = 24;     // candidates whose light is guessed
constexpr std::size_t kTried = 16;      // and whose sight is traced
constexpr std::size_t kSightPoints = 8;
constexpr std::size_t kSightRays = 24;  // of all of them
constexpr int kHintRays = 8;            // of each, for the light that it may send
constexpr float kHintAlbedo = 0.5f;     // whatever it is made of
constexpr std::size_t kFewReceivers = 4;
constexpr float kStripWidth = 0.05f;    // over its length
constexpr float kFarFactor = 0.02f;     // area over distance squared
constexpr float kLeastSquare = 1e-4f;   // of form factors, over the patch
constexpr float kLeastMerit = 2e-3f;    // square of light, over that which arrives
constexpr std::size_t kReceivers = 48;  // points of a patch that are asked, at most
// Integral of a square of form factors over the plane on which a long strip stands, over the strip's area: of
// (1 - h / sqrt(h^2 + 1))^2 / 4 over h, (1 - pi / 4) / 2.
constexpr float kStripSquare = 0.1073f;
constexpr float kSmallest_m2 = 1e-8f;

float form_factor(const std::array<glm::vec3, 4>& c, glm::vec3 x, glm::vec3 n)
{
    return shared::near_form_factor(c[0] - x, c[1] - x, c[2] - x, c[3] - x, n);
}

}  // namespace

std::vector<std::vector<SamplePoint>> near_receivers(const Patches& patches, const Triangles& triangles, int threads)
{
    const LeafFinder finder(patches);
    std::vector<SamplePoint> points(patches.samples.size());
    std::vector<std::uint32_t> leaf(points.size());
    for_patches(patches, threads, [&](std::uint32_t i) {
        for (std::size_t s = std::size_t{i} * kPatchSamples; s < std::size_t{i + 1} * kPatchSamples; ++s) {
            points[s] = sample_point(triangles, patches.samples[s]);
            leaf[s] = finder.leaf_at(points[s].position_m, points[s].normal);
        }
    });
    std::vector<std::vector<SamplePoint>> receivers(patches.count);
    for (std::size_t s = 0; s < points.size(); ++s) {
        if (leaf[s] < patches.count) receivers[leaf[s]].push_back(points[s]);
    }
    // Between points whose leaf is another there may be some that ask this one.
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        if (receivers[i].size() >= kFewReceivers) continue;
        const auto own = points.begin() + static_cast<std::ptrdiff_t>(std::size_t{i} * kPatchSamples);
        receivers[i].insert(receivers[i].end(), own, own + kPatchSamples);
    }
    return receivers;
}

NearChooser::NearChooser(const Patches& patches, const Tracer& tracer, const NearFaces& faces,
                         std::span<const NearHint> hints)
    : patches_(patches), tracer_(tracer), triangles_(tracer.triangles()), faces_(faces), hints_(hints)
{
    const glm::vec3 d = triangles_.high() - triangles_.low();
    // No further than what counts as closed (Patches::open).
    reach_ = std::min({patches.level_cell_m(1), 0.03f * std::sqrt(glm::dot(d, d)), 0.5f});
}

NearChooser::Surroundings NearChooser::surroundings(std::uint32_t patch, std::span<const SamplePoint> receivers) const
{
    const shared::PatchKey key = patches_.key[patch];
    const int level = level_of(key);
    const float edge = patches_.level_cell_m(level);
    const float reach = std::min(edge, reach_);
    Surroundings around;
    around.area = patches_.area_m2[patch];
    around.spacing = 0.25f * std::sqrt(around.area);
    around.low = (glm::vec3(cell_in(key) - glm::ivec3(shared::kPatchCellBias >> level))) * edge -
                 shared::kPatchGridShift * patches_.cell_m;
    around.high = around.low + edge;
    const std::size_t step = (receivers.size() + kReceivers - 1) / kReceivers;
    for (std::size_t k = 0; k < receivers.size(); k += step) {
        around.points.push_back(receivers[k]);
        around.low = glm::min(around.low, receivers[k].position_m);
        around.high = glm::max(around.high, receivers[k].position_m);
    }
    around.low -= reach;
    around.high += reach;
    return around;
}

// What of a face the points see, and the mean of its form factor squared over the patch: by the points themselves, and
// because they lie apart, for what stands on the patch or near it by area: a long strip lights a strip of the patch as
// wide as itself, whatever the patch's size; from h away A / (pi h^2) of that.
std::optional<NearChoice> NearChooser::candidate(std::uint32_t number, bool back, const Surroundings& around) const
{
    const NearFace& face = faces_.faces[number];
    const glm::vec3 n = back ? -face.normal : face.normal;
    bool faces = false;
    for (const SamplePoint& p : around.points) faces = faces || glm::dot(p.position_m - face.polygon.corner[0], n) > 0.0f;
    if (!faces) return std::nullopt;
    NearChoice found{number, back, face.polygon, 0.0f, 0};
    if (back) std::reverse(found.polygon.corner.begin(), found.polygon.corner.begin() + found.polygon.count);
    for (int k = 0; k < 3 && found.polygon.count >= 3; ++k) {
        glm::vec3 axis(0.0f);
        axis[k] = 1.0f;
        found.polygon = cut_above(found.polygon, axis, around.low[k]);
        found.polygon = cut_above(found.polygon, -axis, -around.high[k]);
    }
    simplify(found.polygon);
    if (found.polygon.count < 3) return std::nullopt;
    const float area = area_m2(found.polygon);
    if (!(area > kSmallest_m2)) return std::nullopt;
    const auto corners = corners_of(found.polygon);
    float nearest2 = std::numeric_limits<float>::max();
    for (const SamplePoint& p : around.points) {
        if (!(glm::dot(p.position_m - found.polygon.corner[0], n) > 0.0f)) continue;
        float lowest = std::numeric_limits<float>::max(), highest = std::numeric_limits<float>::lowest();
        for (int k = 0; k < found.polygon.count; ++k) {
            const float h = glm::dot(found.polygon.corner[static_cast<std::size_t>(k)] - p.position_m, p.normal);
            lowest = std::min(lowest, h);
            highest = std::max(highest, h);
        }
        // Level with the point: rounding.
        if (!(highest > 1e-5f)) continue;
        const float height = std::max(lowest, 0.0f);
        const float whole = distance_m(found.polygon, n, p.position_m);
        // Between its samples the patch goes on.
        const float beside =
            std::max(std::sqrt(std::max(whole * whole - height * height, 0.0f)) - around.spacing, 0.0f);
        nearest2 = std::min(nearest2, height * height + beside * beside);
        if (area < kFarFactor * whole * whole) continue;  // too small from here
        const float factor = form_factor(corners, p.position_m, p.normal);
        found.square += factor * factor / static_cast<float>(around.points.size());
    }
    if (nearest2 == std::numeric_limits<float>::max()) return std::nullopt;
    const float far = std::max(std::numbers::pi_v<float> * nearest2, area);
    found.square = std::max(found.square, kStripSquare * area * (area / far) / std::max(around.area, area));
    if (found.square < kLeastSquare) return std::nullopt;
    const auto own = patch_at(patches_, point_in(corners, 0.5f, 0.5f), n);
    if (!own) return std::nullopt;
    found.sender = *own;
    return found;
}

// What a candidate sends under a hint: what the patch there sends, which is a mean of many surfaces, and what its own
// rays bring. What glows is judged by materials: a strip beside a lit pane has half of the pane's light, where the patch
// of both is the mean of a pane and its frame.
void NearChooser::judge(std::vector<NearChoice>& found, std::uint32_t patch) const
{
    for (NearChoice& c : found) c.merit = c.square;
    std::vector<std::array<NearMeets, kHintRays>> met(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::uint64_t hash = mixed(cell_hash(patches_.seed, patches_.key[patch]), found[i].face);
        for (int r = 0; r < kHintRays; ++r)
            met[i][static_cast<std::size_t>(r)] =
                near_meets(patches_, tracer_, corners_of(found[i].polygon), r, kHintRays, hash);
    }
    std::vector<float> sent2(found.size());
    float glows = 0.0f;
    for (std::size_t i = 0; i < found.size(); ++i) {
        float arrives = 0.0f;
        for (const NearMeets& m : met[i]) {
            const bool near = m.triangle != RayHit::kNothing && m.distance_m < kGlowNear_m;
            arrives += near ? glow_of(triangles_, m.triangle) : 0.0f;
        }
        const float sent = glow_of(triangles_, faces_.faces[found[i].face].triangles[0]) +
                           kHintAlbedo * arrives / static_cast<float>(kHintRays);
        sent2[i] = found[i].square * sent * sent;
        glows += sent2[i];
    }
    for (std::size_t i = 0; i < found.size() && glows > 0.0f; ++i) found[i].merit += sent2[i] / glows;
    for (const NearHint& hint : hints_) {
        float all = hint.irradiance[patch] * hint.irradiance[patch];
        for (std::size_t i = 0; i < found.size(); ++i) {
            float arrives = 0.0f;
            for (const NearMeets& m : met[i]) arrives += m.id < patches_.count ? hint.radiosity[m.id] : 0.0f;
            const float sent =
                hint.radiosity[found[i].sender] + kHintAlbedo * arrives / static_cast<float>(kHintRays);
            sent2[i] = found[i].square * sent * sent;
            all += sent2[i];
        }
        for (std::size_t i = 0; i < found.size() && all > 0.0f; ++i) found[i].merit += sent2[i] / all;
    }
}

std::vector<NearChoice> NearChooser::chosen(std::uint32_t patch, std::span<const SamplePoint> receivers) const
{
    if (receivers.empty()) return {};
    const Surroundings around = surroundings(patch, receivers);
    std::vector<std::uint32_t> near = tracer_.within(around.low, around.high);
    for (std::uint32_t& t : near) t = faces_.of_triangle[t];
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<NearChoice> found;
    for (const std::uint32_t face : near) {
        const bool both = triangles_.double_sided(faces_.faces[face].triangles[0]);
        for (const bool back : {false, true}) {
            if (back && !both) continue;
            if (const auto one = candidate(face, back, around)) found.push_back(*one);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const NearChoice& a, const NearChoice& b) { return a.square > b.square; });
    if (found.size() > kJudged) found.resize(kJudged);
    judge(found, patch);
    const auto by_merit = [](const NearChoice& a, const NearChoice& b) { return a.merit > b.merit; };
    std::stable_sort(found.begin(), found.end(), by_merit);
    if (found.size() > kTried) found.resize(kTried);
    const std::uint64_t hash = cell_hash(patches_.seed, patches_.key[patch]);
    for (NearChoice& c : found) {
        if (c.merit < kLeastMerit) continue;
        c.seen = seen_share(c, around, mixed(hash, 2 * std::uint64_t{c.face} + (c.back ? 1 : 0)));
        c.merit *= c.seen * c.seen;
    }
    std::stable_sort(found.begin(), found.end(), by_merit);
    while (!found.empty() && (found.size() > kKept || found.back().seen == 0.0f || found.back().merit < kLeastMerit))
        found.pop_back();
    return found;
}

// From those points that see most of it rays to places of it, by what each brings (cos cos' / r^2); of a long strip the
// nearest place tells most, of a pane it may be what shows between its frame and the wall.
// The share whose product with the form factor errs least, by its square, over the points.
float NearChooser::seen_share(const NearChoice& candidate, const Surroundings& around, std::uint64_t hash) const
{
    const auto corners = corners_of(candidate.polygon);
    const glm::vec3 n = front_of(corners), middle = point_in(corners, 0.5f, 0.5f);
    const float regular = patches_.level_cell_m(1);
    // A place stands for a share of the polygon: nearer than that is wide it counts no more.
    const float area = area_m2(candidate.polygon), least2 = area / std::numbers::pi_v<float>;
    const glm::vec3 across = corners[2] - corners[0];
    const bool strip = area < kStripWidth * glm::dot(across, across);
    std::vector<std::pair<float, std::size_t>> order;
    for (std::size_t k = 0; k < around.points.size(); ++k) {
        const SamplePoint& p = around.points[k];
        const float factor = form_factor(corners, p.position_m, p.normal);
        if (factor > 0.0f) order.push_back({factor, k});
    }
    std::stable_sort(order.begin(), order.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
    if (order.size() > kSightPoints) order.resize(kSightPoints);
    float all = 0.0f, seen = 0.0f;
    for (const auto& [factor, k] : order) {
        const SamplePoint& p = around.points[k];
        const glm::vec3 from = p.position_m + p.normal * ray_lift_m(p.position_m, regular);
        const std::size_t rays = kSightRays / order.size();
        float brought = 0.0f, arrived = 0.0f;
        for (std::size_t r = 0; r < rays; ++r) {
            const std::uint64_t at = mixed(hash, k * kSightRays + r);
            // Off the edge, where two bodies touch.
            const glm::vec3 to = r == 0 && strip ? glm::mix(nearest_in(candidate.polygon, n, p.position_m), middle, 0.1f)
                                        : point_in(corners, unit_float(at), unit_float(mixed(at, 3)));
            const glm::vec3 way = to - p.position_m;
            const float far2 = glm::dot(way, way);
            const float cosines = glm::dot(way, p.normal) * -glm::dot(way, n);
            if (!(glm::dot(way, p.normal) > 0.0f) || !(cosines > 0.0f)) continue;
            const float weight = cosines / (far2 * (far2 + least2));
            brought += weight;
            const PatchSample place = place_on(triangles_, faces_.faces[candidate.face], candidate.back, to);
            if ((triangles_.flags(place.triangle) & kTriangleMasked) && triangles_.is_hole(place.triangle, place.at))
                continue;
            if (!tracer_.blocked_between(from, to + n * std::min(ray_lift_m(to, regular), 0.2f * std::sqrt(far2))))
                arrived += weight;
        }
        if (!(brought > 0.0f)) continue;
        all += factor * factor;
        seen += factor * factor * (arrived / brought);
    }
    return all > 0.0f ? seen / all : 0.0f;
}

}  // namespace petrichor::scene
