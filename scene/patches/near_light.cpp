#include "scene/patches/near_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "formulas/light/near_light.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/lookup.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kPatchesAJob = 64;
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
constexpr int kRedraws = 3;            // of a ray that starts inside something
constexpr float kGlowNear_m = 1.0f;    // so near an entry what glows is met by its own rays

struct Entry {
    std::array<glm::vec3, 4> corners;
    float seen = 1.0f;
    std::uint32_t face = 0;
    bool back = false;
    std::uint32_t sender = 0;
    std::array<PatchSample, NearLinks::kSamples> samples{};
    std::array<std::uint32_t, 8> visible{};
    std::array<std::uint16_t, NearLinks::kLinks> links{};
    std::array<std::uint32_t, NearLinks::kLinks> met{};  // triangles
    std::vector<std::pair<std::uint32_t, float>> glow;
};

struct Row {
    std::vector<Entry> entries;
    std::vector<std::uint16_t> rays;
    std::vector<std::uint8_t> glow_taken;
};

float form_factor(const std::array<glm::vec3, 4>& c, glm::vec3 x, glm::vec3 n)
{
    return shared::near_form_factor(c[0] - x, c[1] - x, c[2] - x, c[3] - x, n);
}

// Of four corners or three, the last one twice.
std::array<glm::vec3, 4> corners_of(const NearPolygon& polygon)
{
    std::array<glm::vec3, 4> corners;
    for (int k = 0; k < 4; ++k)
        corners[static_cast<std::size_t>(k)] =
            polygon.corner[static_cast<std::size_t>(std::min(k, polygon.count - 1))];
    return corners;
}

NearPolygon polygon_of(const std::array<glm::vec3, 4>& c)
{
    NearPolygon polygon;
    polygon.count = 4;
    std::copy(c.begin(), c.end(), polygon.corner.begin());
    return polygon;
}

// The place of a point of a face on that of its triangles that is nearest to hold it.
PatchSample sample_on(const Triangles& triangles, const NearFace& face, bool back, glm::vec3 x)
{
    PatchSample best;
    float least = -std::numeric_limits<float>::max();
    for (const std::uint32_t t : face.triangles) {
        const glm::vec3 e1 = triangles.edge1(t), e2 = triangles.edge2(t), d = x - triangles.corner(t);
        const glm::vec3 n = glm::cross(e1, e2);
        const float over = 1.0f / glm::dot(n, n);
        const float b1 = glm::dot(glm::cross(d, e2), n) * over, b2 = glm::dot(glm::cross(e1, d), n) * over;
        const float inside = std::min({b1, b2, 1.0f - b1 - b2});
        if (inside <= least) continue;
        least = inside;
        const float c1 = std::clamp(b1, 0.0f, 1.0f);
        best = {t, {c1, std::clamp(b2, 0.0f, 1.0f - c1)}, back};
    }
    return best;
}

template <class Body>
void over_patches(const Patches& patches, int threads, const Body& body)
{
    const std::size_t jobs = (patches.count + kPatchesAJob - 1) / kPatchesAJob;
    parallel_for(jobs, threads, [&](std::size_t job) {
        const auto first = static_cast<std::uint32_t>(job * kPatchesAJob);
        const std::uint32_t last = std::min(first + static_cast<std::uint32_t>(kPatchesAJob), patches.count);
        for (std::uint32_t i = first; i < last; ++i) body(i);
    });
}

// Points of all surfaces by the leaf that a lookup there asks: a pane behind its frame is asked of the frame's where
// that counts more.
std::vector<std::vector<SamplePoint>> receivers_of(const Patches& patches, const Triangles& triangles, int threads)
{
    const LeafFinder finder(patches);
    std::vector<SamplePoint> points(patches.samples.size());
    std::vector<std::uint32_t> leaf(points.size());
    over_patches(patches, threads, [&](std::uint32_t i) {
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

class Finder {
public:
    Finder(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const GlowLinks* glow,
           std::span<const NearHint> hints)
        : patches_(patches),
          tracer_(tracer),
          triangles_(tracer.triangles()),
          faces_(faces),
          glow_(glow),
          hints_(hints)
    {
        const glm::vec3 d = triangles_.high() - triangles_.low();
        // No further than what counts as closed (Patches::open).
        reach_ = std::min({patches.level_cell_m(1), 0.03f * std::sqrt(glm::dot(d, d)), 0.5f});
    }
    Row row_of(std::uint32_t patch, std::span<const SamplePoint> receivers) const;

private:
    struct Candidate {
        std::uint32_t face;
        bool back;
        NearPolygon polygon;
        float square;  // mean of form factors squared
        std::uint32_t sender;
        float merit = 0.0f;
        float seen = 0.0f;
    };
    struct Surroundings {
        std::vector<SamplePoint> points;
        glm::vec3 low, high;
        float spacing, area;
    };
    std::vector<Candidate> candidates(std::uint32_t patch, const Surroundings& around) const;
    std::optional<Candidate> candidate(std::uint32_t face, bool back, const Surroundings& around) const;
    float seen_share(const Candidate& candidate, const Surroundings& around, std::uint64_t hash) const;
    void light(Entry& entry, std::uint64_t hash) const;
    struct Meets {
        std::uint32_t id;           // as Patches::links
        std::uint32_t triangle = RayHit::kNothing;
        float distance_m = 0.0f;
    };
    Meets met_by(const std::array<glm::vec3, 4>& corners, int r, int rays, std::uint64_t hash) const;
    float glow_of(std::uint32_t triangle) const;
    void judge(std::vector<Candidate>& found, std::uint32_t patch) const;
    void near_glow(Entry& entry) const;
    std::array<std::uint32_t, 8> sky_seen(const Entry& entry, std::uint64_t hash, bool up) const;
    std::vector<std::uint8_t> glow_taken(std::uint32_t patch, const std::vector<Entry>& entries) const;

    const Patches& patches_;
    const Tracer& tracer_;
    const Triangles& triangles_;
    const NearFaces& faces_;
    const GlowLinks* glow_;
    std::span<const NearHint> hints_;
    float reach_ = 0.0f;
};

// What of a face the points see, and the mean of its form factor squared over the patch: by the points themselves, and
// because they lie apart, for what stands on the patch or near it by area: a long strip lights a strip of the patch as
// wide as itself, whatever the patch's size; from h away A / (pi h^2) of that.
std::optional<Finder::Candidate> Finder::candidate(std::uint32_t number, bool back, const Surroundings& around) const
{
    const NearFace& face = faces_.faces[number];
    const glm::vec3 n = back ? -face.normal : face.normal;
    bool faces = false;
    for (const SamplePoint& p : around.points) faces = faces || glm::dot(p.position_m - face.polygon.corner[0], n) > 0.0f;
    if (!faces) return std::nullopt;
    Candidate found{number, back, face.polygon, 0.0f, 0};
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
void Finder::judge(std::vector<Candidate>& found, std::uint32_t patch) const
{
    for (Candidate& c : found) c.merit = c.square;
    std::vector<std::array<Meets, kHintRays>> met(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::uint64_t hash = mixed(cell_hash(patches_.seed, patches_.key[patch]), found[i].face);
        for (int r = 0; r < kHintRays; ++r)
            met[i][static_cast<std::size_t>(r)] = met_by(corners_of(found[i].polygon), r, kHintRays, hash);
    }
    std::vector<float> sent2(found.size());
    float glows = 0.0f;
    for (std::size_t i = 0; i < found.size(); ++i) {
        float arrives = 0.0f;
        for (const Meets& m : met[i]) {
            const bool near = m.triangle != RayHit::kNothing && m.distance_m < kGlowNear_m;
            arrives += near ? glow_of(m.triangle) : 0.0f;
        }
        const float sent = glow_of(faces_.faces[found[i].face].triangles[0]) +
                           kHintAlbedo * arrives / static_cast<float>(kHintRays);
        sent2[i] = found[i].square * sent * sent;
        glows += sent2[i];
    }
    for (std::size_t i = 0; i < found.size() && glows > 0.0f; ++i) found[i].merit += sent2[i] / glows;
    for (const NearHint& hint : hints_) {
        float all = hint.irradiance[patch] * hint.irradiance[patch];
        for (std::size_t i = 0; i < found.size(); ++i) {
            float arrives = 0.0f;
            for (const Meets& m : met[i]) arrives += m.id < patches_.count ? hint.radiosity[m.id] : 0.0f;
            const float sent =
                hint.radiosity[found[i].sender] + kHintAlbedo * arrives / static_cast<float>(kHintRays);
            sent2[i] = found[i].square * sent * sent;
            all += sent2[i];
        }
        for (std::size_t i = 0; i < found.size() && all > 0.0f; ++i) found[i].merit += sent2[i] / all;
    }
}

// Those that are seen and count, first the ones that count most.
std::vector<Finder::Candidate> Finder::candidates(std::uint32_t patch, const Surroundings& around) const
{
    std::vector<std::uint32_t> near = tracer_.within(around.low, around.high);
    for (std::uint32_t& t : near) t = faces_.of_triangle[t];
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<Candidate> found;
    for (const std::uint32_t face : near) {
        const bool both = triangles_.double_sided(faces_.faces[face].triangles[0]);
        for (const bool back : {false, true}) {
            if (back && !both) continue;
            if (const auto one = candidate(face, back, around)) found.push_back(*one);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.square > b.square; });
    if (found.size() > kJudged) found.resize(kJudged);
    judge(found, patch);
    const auto by_merit = [](const Candidate& a, const Candidate& b) { return a.merit > b.merit; };
    std::stable_sort(found.begin(), found.end(), by_merit);
    if (found.size() > kTried) found.resize(kTried);
    const std::uint64_t hash = cell_hash(patches_.seed, patches_.key[patch]);
    for (Candidate& c : found) {
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
float Finder::seen_share(const Candidate& candidate, const Surroundings& around, std::uint64_t hash) const
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
            const PatchSample place = sample_on(triangles_, faces_.faces[candidate.face], candidate.back, to);
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

// As trace_visibility has it; a fourth of the directions is tried first, and where none of them and no ray of its row
// (`up`) leaves, or all do, the others are alike.
std::array<std::uint32_t, 8> Finder::sky_seen(const Entry& entry, std::uint64_t hash, bool up) const
{
    std::array<std::uint32_t, 8> visible{};
    const glm::vec3 n = front_of(entry.corners);
    bool any = up, all = true;
    const auto look = [&](std::size_t bit, bool known) {
        const glm::vec3 raw = shared::visibility_raw_direction(static_cast<int>(bit));
        const glm::vec3 d = raw / std::sqrt(glm::dot(raw, raw));
        if (!(glm::dot(n, d) > 0.0f)) return;
        if (known) {
            visible[bit >> 5] |= 1u << (bit & 31);
            return;
        }
        const std::uint64_t at = mixed(hash, bit);
        const glm::vec3 x = point_in(entry.corners, unit_float(at), unit_float(mixed(at, 3)));
        if (tracer_.blocked({x + n * ray_lift_m(x, patches_.level_cell_m(1)), d})) {
            all = false;
            return;
        }
        visible[bit >> 5] |= 1u << (bit & 31);
        any = true;
    };
    // Every other one of every other row of 16.
    const auto first = [](std::size_t bit) { return (bit & 1u) == 0 && (bit >> 4 & 1u) == 0; };
    for (std::size_t bit = 0; bit < 256; ++bit)
        if (first(bit)) look(bit, false);
    const bool open = all;
    for (std::size_t bit = 0; bit < 256 && any; ++bit)
        if (!first(bit)) look(bit, open);
    return visible;
}

// Luminance of what a material sends out by itself, its texture apart.
float Finder::glow_of(std::uint32_t triangle) const
{
    const Material& m = triangles_.scene().materials[triangles_.material(triangle)];
    return m.emissive_strength * glm::dot(m.emissive, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

// What ray r of a polygon's meets; black where it starts inside a body, whatever is drawn.
Finder::Meets Finder::met_by(const std::array<glm::vec3, 4>& corners, int r, int rays, std::uint64_t hash) const
{
    const glm::vec3 n = front_of(corners);
    for (int draw = 0; draw <= kRedraws; ++draw) {
        const std::uint64_t at = mixed(hash, static_cast<std::uint64_t>(r * (kRedraws + 1) + draw));
        const glm::vec3 x = point_in(corners, unit_float(at), unit_float(mixed(at, 5)));
        const Ray ray{x + n * ray_lift_m(x, patches_.level_cell_m(1)), row_direction(n, r, rays, hash)};
        const RayHit hit = tracer_.nearest(ray);
        if (!hit.hit()) return {patches_.count + static_cast<std::uint32_t>(shared::sky_bin_left(ray.direction))};
        if (hit.back && !triangles_.double_sided(hit.triangle)) continue;
        return {patch_of_hit(patches_, triangles_, ray, hit), hit.triangle, hit.distance_m};
    }
    return {patches_.black()};
}

// What it is made of, and where its light comes from.
void Finder::light(Entry& entry, std::uint64_t hash) const
{
    for (std::size_t k = 0; k < entry.samples.size(); ++k)
        entry.samples[k] =
            sample_on(triangles_, faces_.faces[entry.face], entry.back, lamp_point(entry.corners, k));
    constexpr auto kRays = static_cast<int>(NearLinks::kLinks);
    std::size_t lost = 0;
    bool up = false;
    for (int r = 0; r < kRays; ++r) {
        const Meets meets = met_by(entry.corners, r, kRays, hash);
        const std::uint32_t id = meets.id;
        entry.links[static_cast<std::size_t>(r)] = static_cast<std::uint16_t>(id);
        entry.met[static_cast<std::size_t>(r)] = meets.triangle;
        lost += id == patches_.black() ? 1 : 0;
        up = up || (id >= patches_.count && id != patches_.black());
    }
    // Parts of it that lie inside a body are not seen: the other rays stand in, one after the other.
    const auto rows = entry.links;
    for (std::size_t r = 0, other = 0; r < rows.size() && lost > 0 && lost < rows.size(); ++r) {
        if (rows[r] != patches_.black()) continue;
        other = (other + 1) % rows.size();
        while (rows[other] == patches_.black()) other = (other + 1) % rows.size();
        entry.links[r] = rows[other];
        entry.met[r] = entry.met[other];
    }
    entry.visible = sky_seen(entry, mixed(hash, 1), up);
}

void Finder::near_glow(Entry& entry) const
{
    const glm::vec3 middle = point_in(entry.corners, 0.5f, 0.5f);
    const auto is_near = [&](std::uint32_t glowing) {
        const glm::vec3 d = patches_.position_m[glowing] - middle;
        const float far = kGlowNear_m + std::sqrt(patches_.area_m2[glowing]);
        return glm::dot(d, d) < far * far;
    };
    const auto add = [&](std::uint32_t glowing, float more) {
        for (auto& [patch, sum] : entry.glow) {
            if (patch != glowing) continue;
            sum += more;
            return;
        }
        entry.glow.push_back({glowing, more});
    };
    for (std::uint32_t g = glow_->first[entry.sender]; g < glow_->first[entry.sender + 1]; ++g) {
        const std::uint32_t glowing = glow_->senders[glow_->sender[g]];
        if (is_near(glowing)) add(glowing, -glow_->factor[g]);
    }
    // The light of a patch is the mean of what glows of it and what does not: a ray that meets the pane has all of it,
    // one that meets its frame nothing.
    for (std::size_t r = 0; r < entry.links.size(); ++r) {
        const std::uint32_t id = entry.links[r];
        if (!std::binary_search(glow_->senders.begin(), glow_->senders.end(), id) || !is_near(id)) continue;
        int glowing = 0;
        for (std::size_t k = 0; k < kPatchSamples; ++k)
            glowing += glow_of(patches_.samples[std::size_t{id} * kPatchSamples + k].triangle) > 0.0f ? 1 : 0;
        if (glowing == 0 || entry.met[r] == RayHit::kNothing || !(glow_of(entry.met[r]) > 0.0f)) continue;
        add(id, static_cast<float>(kPatchSamples) / static_cast<float>(glowing) / static_cast<float>(NearLinks::kLinks));
    }
}

// Which share of the glowing patches around is among the entries, by their samples.
std::vector<std::uint8_t> Finder::glow_taken(std::uint32_t patch, const std::vector<Entry>& entries) const
{
    std::vector<std::uint8_t> taken;
    for (std::uint32_t g = glow_->first[patch]; g < glow_->first[patch + 1]; ++g) {
        const std::uint32_t glowing = glow_->senders[glow_->sender[g]];
        std::size_t held = 0;
        for (std::size_t k = 0; k < kPatchSamples && !entries.empty(); ++k) {
            const PatchSample& sample = patches_.samples[std::size_t{glowing} * kPatchSamples + k];
            const std::uint32_t face = faces_.of_triangle[sample.triangle];
            for (const Entry& e : entries) {
                if (e.face != face || e.back != sample.back) continue;
                const glm::vec3 x = triangles_.point(sample.triangle, sample.at);
                if (!holds(polygon_of(e.corners), front_of(e.corners), x, 1e-3f)) continue;
                ++held;
                break;
            }
        }
        taken.push_back(static_cast<std::uint8_t>(held * 255 / kPatchSamples));
    }
    return taken;
}

Row Finder::row_of(std::uint32_t patch, std::span<const SamplePoint> receivers) const
{
    Row row;
    if (!receivers.empty()) {
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
        const std::uint64_t hash = cell_hash(patches_.seed, key);
        for (const Candidate& c : candidates(patch, around)) {
            Entry entry;
            entry.corners = corners_of(c.polygon);
            entry.face = c.face;
            entry.back = c.back;
            entry.seen = c.seen;
            entry.sender = c.sender;
            light(entry, mixed(hash, 2 * std::uint64_t{c.face} + (c.back ? 1 : 0)));
            if (glow_ != nullptr && !glow_->empty()) near_glow(entry);
            row.entries.push_back(std::move(entry));
        }
    }
    if (glow_ != nullptr && !glow_->empty()) row.glow_taken = glow_taken(patch, row.entries);
    if (row.entries.empty()) return row;
    // The rays of the row that meet what is kept.
    for (int r = 0; r < patches_.rays; ++r) {
        if (patches_.row(patch)[r] >= patches_.count) continue;
        const LinkRay link = trace_link(patches_, tracer_, patch, r);
        if (!link.hit.hit() || link.inside) continue;
        const std::uint32_t face = faces_.of_triangle[link.hit.triangle];
        const glm::vec3 x = triangles_.point(link.hit.triangle, link.hit.at);
        for (const Entry& e : row.entries) {
            if (e.face != face || e.back != link.hit.back || !holds(polygon_of(e.corners), front_of(e.corners), x, 1e-3f))
                continue;
            row.rays.push_back(static_cast<std::uint16_t>(r));
            break;
        }
    }
    return row;
}

}  // namespace

NearLinks trace_near(const Patches& patches, const Tracer& tracer, const GlowLinks* glow,
                     std::span<const NearHint> hints, int threads)
{
    const NearFaces faces = near_faces(tracer.triangles());
    const Finder finder(patches, tracer, faces, glow, hints);
    const auto receivers = receivers_of(patches, tracer.triangles(), threads);
    std::vector<Row> rows(patches.count);
    over_patches(patches, threads, [&](std::uint32_t i) { rows[i] = finder.row_of(i, receivers[i]); });
    NearLinks near;
    near.first.push_back(0);
    near.ray_first.push_back(0);
    const bool glows = glow != nullptr && !glow->empty();
    if (glows) near.glow_first.push_back(0);
    for (const Row& row : rows) {
        for (const Entry& entry : row.entries) {
            near.corners.push_back(entry.corners);
            near.seen.push_back(entry.seen);
            near.sender.push_back(entry.sender);
            near.material.push_back(tracer.triangles().material(entry.samples[0].triangle));
            near.samples.insert(near.samples.end(), entry.samples.begin(), entry.samples.end());
            near.visible.push_back(entry.visible);
            near.links.insert(near.links.end(), entry.links.begin(), entry.links.end());
            if (!glows) continue;
            for (const auto& [patch, more] : entry.glow) {
                near.glow_patch.push_back(patch);
                near.glow_more.push_back(more);
            }
            near.glow_first.push_back(static_cast<std::uint32_t>(near.glow_patch.size()));
        }
        near.glow_taken.insert(near.glow_taken.end(), row.glow_taken.begin(), row.glow_taken.end());
        near.rays.insert(near.rays.end(), row.rays.begin(), row.rays.end());
        near.first.push_back(static_cast<std::uint32_t>(near.sender.size()));
        near.ray_first.push_back(static_cast<std::uint32_t>(near.rays.size()));
    }
    return near;
}

}  // namespace petrichor::scene
