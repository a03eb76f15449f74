#include "scene/patches/detail/near_choice.h"

#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "formulas/light/near_light.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/near_rays.h"
#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kKept = NearLinks::kMostAPatch;
constexpr std::size_t kJudged = 24;     // candidates whose light is guessed
constexpr std::size_t kTried = 16;      // and whose sight is traced
constexpr std::size_t kSightPoints = 8;
constexpr std::size_t kSightRays = 24;  // of all of them
constexpr float kHeightsAlike = 0.01f;  // variance of heights that tells as much as nothing
constexpr float kFaintest = 0.25f;      // of the most that a point sees, for it to count
constexpr std::size_t kNoRay = std::numeric_limits<std::size_t>::max();
constexpr int kSightDirections = 64;
constexpr float kStripWidth = 0.05f;    // over its length
constexpr int kSourceLevel = 1;          // of cells that pieces of faces are as long as
constexpr int kGlowLevel = 0;
constexpr float kAgainst = -0.7f, kSheet = 0.05f, kHardly = 0.1f;  // cosine; of a cell; of a distance
constexpr float kTowardsMiddle = 0.1f;  // of a polygon, from what is nearest to its receivers
constexpr float kFarFactor = 0.02f;     // area over distance squared
constexpr float kLeastSquare = 1e-4f;   // of form factors, over the patch
constexpr float kLeastMerit = 2e-3f;    // square of light, over that which arrives
constexpr std::size_t kReceivers = 48;  // points of a patch that are asked, at most
// Integral of a square of form factors over the plane on which a long strip stands, over the strip's area: of
// (1 - h / sqrt(h^2 + 1))^2 / 4 over h, (1 - pi / 4) / 2.
constexpr float kStripSquare = 0.1073f;
constexpr float kSmallest_m2 = 1e-8f;

struct Sphere {
    glm::vec3 middle;
    float radius;
};
Sphere sphere_around(const NearPolygon& polygon)
{
    glm::vec3 low = polygon.corner[0], high = low;
    for (int k = 1; k < polygon.count; ++k) {
        low = glm::min(low, polygon.corner[static_cast<std::size_t>(k)]);
        high = glm::max(high, polygon.corner[static_cast<std::size_t>(k)]);
    }
    return {0.5f * (low + high), 0.5f * std::sqrt(glm::dot(high - low, high - low))};
}

}  // namespace

NearChooser::NearChooser(const Patches& patches, const Tracer& tracer, const NearFaces& faces,
                         const NearSources& sources, std::span<const NearHint> hints)
    : patches_(patches),
      tracer_(tracer),
      triangles_(tracer.triangles()),
      faces_(faces),
      sources_(sources),
      hints_(hints)
{
    const glm::vec3 d = triangles_.high() - triangles_.low();
    // No further than what counts as closed (Patches::open).
    reach_ = std::min({patches.level_cell_m(1), 0.03f * std::sqrt(glm::dot(d, d)), 0.5f});
    for (int r = 0; r < kSightDirections; r += 4) {
        float lanes[3][4];
        for (int lane = 0; lane < 4; ++lane) {
            const glm::vec3 local = row_direction({0.0f, 0.0f, 1.0f}, r + lane, kSightDirections, patches.seed);
            for (int k = 0; k < 3; ++k) lanes[k][lane] = local[k];
        }
        directions_.push_back(four3(lanes));
    }
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
    glm::vec3 least = receivers[0].position_m, most = least;
    for (std::size_t k = 0; k < receivers.size(); k += step) {
        around.points.push_back(receivers[k]);
        least = glm::min(least, receivers[k].position_m);
        most = glm::max(most, receivers[k].position_m);
    }
    around.middle = 0.5f * (least + most);
    around.half = 0.5f * (most - least);
    around.low = glm::min(around.low, least);
    around.high = glm::max(around.high, most);
    around.low -= reach;
    around.high += reach;
    around.four = FourPoints(around.points);
    return around;
}

NearPolygon NearChooser::part_of(std::uint32_t number, bool back, const Surroundings& around) const
{
    NearPolygon polygon = faces_.faces[number].polygon;
    if (back) std::reverse(polygon.corner.begin(), polygon.corner.begin() + polygon.count);
    polygon = cut_to(polygon, around.low, around.high);
    simplify(polygon);
    return polygon;
}

namespace {

// Of what stands on a patch or near it, by area: a long strip lights a strip of the patch as wide as itself, whatever the
// patch's size; from h away A / (pi h^2) of that.
float strip_square(float area, float nearest2, float patch_area)
{
    const float far = std::max(std::numbers::pi_v<float> * nearest2, area);
    return kStripSquare * area * (area / far) / std::max(patch_area, area);
}

}  // namespace

// A form factor is at most the area over pi times the distance squared, times both cosines. The face is taken as the box
// around what the surroundings hold of it.
float NearChooser::most_square(std::uint32_t number, bool back, const Surroundings& around) const
{
    constexpr float kRounding = 1e-6f, kMore = 1.001f, kMoreFactor = 1e-3f, kLeast_m = 1e-6f;
    const NearFace& face = faces_.faces[number];
    const NearPolygon& polygon = face.polygon;
    const glm::vec3 n = back ? -face.normal : face.normal;
    glm::vec3 low = polygon.corner[0], high = low;
    for (int k = 1; k < polygon.count; ++k) {
        low = glm::min(low, polygon.corner[static_cast<std::size_t>(k)]);
        high = glm::max(high, polygon.corner[static_cast<std::size_t>(k)]);
    }
    low = glm::max(low, around.low);
    high = glm::min(high, around.high);
    // Of coordinates, as products of them are rounded.
    const glm::vec3 largest = glm::max(glm::abs(around.low), glm::abs(around.high));
    const float margin = kRounding * (1.0f + largest.x + largest.y + largest.z);
    // Not one of them is in front where their box is not.
    if (glm::dot(around.middle - polygon.corner[0], n) + glm::dot(around.half, glm::abs(n)) + margin <= 0.0f) return 0.0f;
    const glm::vec3 size = glm::max(high - low, 0.0f);
    float area = area_m2(polygon);
    for (int k = 0; k < 3; ++k) {
        const float face_on = std::abs(n[k]);
        if (face_on > 0.1f) area = std::min(area, size[(k + 1) % 3] * size[(k + 2) % 3] / face_on);
    }
    area *= kMore;
    const float radius = 0.5f * std::sqrt(glm::dot(size, size)) * kMore + margin;
    const Four3 middle = all3(0.5f * (low + high)), front = all3(n), corner = all3(polygon.corner[0]);
    const Four zero = all(0.0f), one = all(1.0f), over_pi = all(area / std::numbers::pi_v<float>);
    Four nearest2 = all(std::numeric_limits<float>::max()), sum = zero;
    const auto groups = around.four.position_m.size();
    for (std::size_t group = 0; group < groups; ++group) {
        const Four3 &at = around.four.position_m[group], &up = around.four.normal[group];
        const Four before = dot(at - corner, front) + all(margin);
        Four highest = all(std::numeric_limits<float>::lowest());
        for (int k = 0; k < polygon.count; ++k)
            highest = larger(dot(all3(polygon.corner[static_cast<std::size_t>(k)]) - at, up), highest);
        highest += all(margin);
        const Signs sees = (before > zero) & (highest > zero);
        if (none(sees)) continue;
        const Four3 way = middle - at;
        const Four least = larger(square_root(dot(way, way)) - all(radius), all(kLeast_m));
        const Four beside = larger(least - all(around.spacing), zero);
        nearest2 = sees ? smaller(beside * beside, nearest2) : nearest2;
        const Four square = least * least;
        const Signs counts = sees & (all(area) >= all(0.99f * kFarFactor) * square);
        if (none(counts)) continue;
        const Four cosines = smaller(before / least, one) * smaller(highest / least, one);
        const Four factor = smaller(over_pi / square * cosines + all(kMoreFactor), one);
        sum += counts ? factor * factor : zero;
    }
    float least2 = std::numeric_limits<float>::max(), all_points = 0.0f;
    for (int lane = 0; lane < 4; ++lane) {
        least2 = std::min(least2, nearest2[lane]);
        all_points += sum[lane];
    }
    if (least2 == std::numeric_limits<float>::max()) return 0.0f;
    return kMore * std::max(all_points / static_cast<float>(around.points.size()), strip_square(area, least2, around.area));
}

// What of a face the points see, and the mean of its form factor squared over the patch: by the points themselves, and
// because they lie apart, for what stands on the patch or near it by area.
std::optional<NearCandidate> NearChooser::candidate(std::uint32_t number, bool back, const Surroundings& around,
                                                    float least_square) const
{
    const NearFace& face = faces_.faces[number];
    const glm::vec3 n = back ? -face.normal : face.normal;
    // Of what is too small for the patch's size the points alone tell, those from which it is not.
    const float whole_area = area_m2(face.polygon);
    const Sphere whole = sphere_around(face.polygon);
    const bool small = strip_square(whole_area, 0.0f, around.area) < least_square;
    const auto seen_small = [](const Sphere& sphere, float area, const SamplePoint& p) {
        const glm::vec3 way = sphere.middle - p.position_m;
        const float least = std::max(std::sqrt(glm::dot(way, way)) - sphere.radius, 0.0f);
        return area < kFarFactor * least * least;
    };
    bool faces = false;
    for (const SamplePoint& p : around.points) {
        faces = glm::dot(p.position_m - face.polygon.corner[0], n) > 0.0f && !(small && seen_small(whole, whole_area, p));
        if (faces) break;
    }
    if (!faces) return std::nullopt;
    const NearPolygon polygon = part_of(number, back, around);
    if (polygon.count < 3) return std::nullopt;
    const float area = area_m2(polygon);
    if (!(area > kSmallest_m2)) return std::nullopt;
    const bool by_area = !(strip_square(area, 0.0f, around.area) < least_square);
    const auto corners = corners_of(polygon);
    const glm::vec3 middle = point_in(corners, 0.5f, 0.5f);
    float radius2 = 0.0f;
    for (const glm::vec3& c : corners) radius2 = std::max(radius2, glm::dot(c - middle, c - middle));
    const float radius = std::sqrt(radius2);
    float nearest2 = std::numeric_limits<float>::max(), square = 0.0f, factors = 0.0f;
    glm::vec3 heart(0.0f);
    const Four zero = all(0.0f);
    for (std::size_t first = 0; first < around.points.size(); first += 4) {
        const Four3 &at = around.four.position_m[first / 4], &up = around.four.normal[first / 4];
        const Four3 way = all3(middle) - at;
        // Neither seen by more than can be left out nor nearer than another's.
        const Four least = larger(square_root(dot(way, way)) - all(radius), zero);
        const Four least_beside = larger(least - all(around.spacing), zero);
        const Signs seen_much = all(area) >= all(kFarFactor) * least * least;
        Signs counts = dot(way, all3(n)) < zero;
        counts &= by_area ? seen_much | (least_beside * least_beside < all(nearest2)) : seen_much;
        if (none(counts)) continue;
        Four lowest = all(std::numeric_limits<float>::max()), highest = all(std::numeric_limits<float>::lowest());
        for (int k = 0; k < polygon.count; ++k) {
            const Four h = dot(all3(polygon.corner[static_cast<std::size_t>(k)]) - at, up);
            lowest = smaller(h, lowest);
            highest = larger(h, highest);
        }
        // Level with the point: rounding.
        counts &= highest > all(1e-5f);
        if (none(counts)) continue;
        const Four height = larger(lowest, zero);
        const Four3 nearest = nearest_in(polygon, n, at);
        const Four3 to_nearest = nearest - at;
        const Four whole2 = dot(to_nearest, to_nearest);
        // What faces the point, from hardly above its plane, is the back of its own sheet, over a fold of which it hangs.
        counts &= ~((dot(all3(n), up) < all(kAgainst)) &
                    (highest < all(kSheet * patches_.cell_m) + all(kHardly) * square_root(whole2)));
        if (none(counts)) continue;
        // Between its samples the patch goes on.
        const Four beside = larger(square_root(larger(whole2 - height * height, zero)) - all(around.spacing), zero);
        const Four distance2 = height * height + beside * beside;
        const Signs too_small = all(area) < all(kFarFactor) * whole2;  // from here
        const Four factor = none(counts & ~too_small) ? zero : near_form_factors(corners, at, up);
        for (int lane = 0; lane < 4 && first + static_cast<std::size_t>(lane) < around.points.size(); ++lane) {
            if (counts[lane] == 0) continue;
            nearest2 = std::min(nearest2, distance2[lane]);
            if (too_small[lane] != 0) continue;
            square += factor[lane] * factor[lane] / static_cast<float>(around.points.size());
            heart += glm::vec3(nearest.x[lane], nearest.y[lane], nearest.z[lane]) * factor[lane];
            factors += factor[lane];
        }
    }
    if (nearest2 == std::numeric_limits<float>::max()) return std::nullopt;
    square = std::max(square, strip_square(area, nearest2, around.area));
    if (square < least_square) return std::nullopt;
    heart = factors > 0.0f ? glm::mix(heart / factors, middle, kTowardsMiddle) : middle;
    // What glows has edges and pictures.
    const bool glows = glow_of(triangles_, face.triangles[0]) > 0.0f;
    return NearCandidate{number, back, square, sources_.key_at(number, back, heart, glows ? kGlowLevel : kSourceLevel)};
}

std::vector<NearCandidate> NearChooser::candidates(std::uint32_t patch, std::span<const SamplePoint> receivers) const
{
    if (receivers.empty()) return {};
    const Surroundings around = surroundings(patch, receivers);
    std::vector<std::uint32_t> near = tracer_.within(around.low, around.high);
    for (std::uint32_t& t : near) t = faces_.of_triangle[t];
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    // Those that may have the most first: what follows the largest kJudged is not looked at.
    struct Side {
        float most;
        std::uint32_t face;
        bool back;
    };
    std::vector<Side> sides;
    for (const std::uint32_t face : near) {
        const bool both = triangles_.double_sided(faces_.faces[face].triangles[0]);
        for (const bool back : {false, true}) {
            if (back && !both) continue;
            const float most = most_square(face, back, around);
            if (!(most < kLeastSquare)) sides.push_back({most, face, back});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.most != b.most ? a.most > b.most : a.face != b.face ? a.face < b.face : a.back < b.back;
    });
    std::vector<NearCandidate> found;
    // The largest kJudged so far, the least of them in front.
    std::vector<float> largest;
    float least_square = kLeastSquare;
    for (const Side& side : sides) {
        if (side.most < least_square) break;
        const auto one = candidate(side.face, side.back, around, least_square);
        if (!one) continue;
        found.push_back(*one);
        largest.push_back(one->square);
        std::push_heap(largest.begin(), largest.end(), std::greater<>());
        if (largest.size() <= kJudged) continue;
        std::pop_heap(largest.begin(), largest.end(), std::greater<>());
        largest.pop_back();
        least_square = std::max(kLeastSquare, largest.front());
    }
    std::sort(found.begin(), found.end(), [](const NearCandidate& a, const NearCandidate& b) {
        return a.square != b.square ? a.square > b.square : a.face != b.face ? a.face < b.face : a.back < b.back;
    });
    if (found.size() > kJudged) found.resize(kJudged);
    return found;
}

// The share of each in the square of the light under a hint: of all that arrives, or of all that glows and is near.
std::vector<float> NearChooser::merits(std::uint32_t patch, std::span<const NearCandidate> candidates,
                                       std::span<const NearGuess> guesses) const
{
    std::vector<float> merit;
    for (const NearCandidate& c : candidates) merit.push_back(c.square);
    for (std::size_t h = 0; h <= hints_.size(); ++h) {
        const auto square = [&](const NearCandidate& c) {
            if (guesses[c.guess].sent.empty()) return 0.0f;
            const float sent = guesses[c.guess].sent[h];
            return c.square * sent * sent;
        };
        float all = h == 0 ? 0.0f : hints_[h - 1].irradiance[patch] * hints_[h - 1].irradiance[patch];
        for (const NearCandidate& c : candidates) all += square(c);
        for (std::size_t i = 0; i < candidates.size() && all > 0.0f; ++i) merit[i] += square(candidates[i]) / all;
    }
    return merit;
}

std::vector<NearChoice> NearChooser::chosen(std::uint32_t patch, std::span<const SamplePoint> receivers,
                                            std::span<const NearCandidate> candidates,
                                            std::span<const NearGuess> guesses) const
{
    if (candidates.empty()) return {};
    const Surroundings around = surroundings(patch, receivers);
    const std::vector<float> merit = merits(patch, candidates, guesses);
    struct Tried {
        float merit;
        NearChoice choice;
    };
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return merit[a] > merit[b]; });
    if (order.size() > kTried) order.resize(kTried);
    const std::uint64_t hash = cell_hash(patches_.seed, patches_.key[patch]);
    std::vector<Tried> tried;
    // The largest kKept so far, the least of them in front: what is worth no more if all of it is seen changes nothing.
    std::vector<float> largest;
    for (const std::size_t i : order) {
        if (largest.size() == kKept && merit[i] <= largest.front()) break;
        const NearCandidate& c = candidates[i];
        if (merit[i] < kLeastMerit || guesses[c.guess].sent.empty()) continue;
        const NearPolygon polygon = part_of(c.face, c.back, around);
        const auto [seen, packed] =
            seen_share(c, polygon, around, mixed(hash, 2 * std::uint64_t{c.face} + (c.back ? 1 : 0)));
        const float left = merit[i] * seen * seen;
        if (seen == 0.0f || left < kLeastMerit) continue;
        tried.push_back({left, {c.face, c.back, corners_of(polygon), packed, guesses[c.guess].shown}});
        largest.push_back(left);
        std::push_heap(largest.begin(), largest.end(), std::greater<>());
        if (largest.size() <= kKept) continue;
        std::pop_heap(largest.begin(), largest.end(), std::greater<>());
        largest.pop_back();
    }
    std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.merit > b.merit; });
    if (tried.size() > kKept) tried.resize(kKept);
    std::vector<NearChoice> kept;
    for (const Tried& one : tried) kept.push_back(one.choice);
    return kept;
}

// Of the places of a polygon that a point looks at, and what each brings.
struct NearChooser::Look {
    glm::vec3 to;
    float weight;
};

// Places by what they bring, where the point sees so much of the polygon that even directions meet it; else by their
// weight (cos cos' / r^2). A place stands for a share of the polygon: nearer than that is wide it counts no more. Of a
// long strip the nearest place tells most.
std::vector<NearChooser::Look> NearChooser::looks(const SamplePoint& p, const NearPolygon& polygon, glm::vec3 n,
                                                  std::size_t rays, std::uint64_t hash) const
{
    std::vector<Look> looks;
    const float first = glm::dot(polygon.corner[0] - p.position_m, n);
    const Tangents frame = tangents_of(p.normal);
    const auto turn = portable_sin_cos(6.283185307179586 * static_cast<double>(unit_float(hash)));
    const auto cosine = static_cast<float>(turn.cosine), sine = static_cast<float>(turn.sine);
    const glm::vec3 t = frame.t * cosine + frame.b * sine, b = frame.b * cosine - frame.t * sine;
    std::array<glm::vec3, 4> inwards;
    const auto count = static_cast<std::size_t>(polygon.count);
    for (std::size_t k = 0; k < count; ++k)
        inwards[k] = glm::cross(n, polygon.corner[(k + 1) % count] - polygon.corner[k]);
    const Four3 from = all3(p.position_m), front = all3(n), up = all3(p.normal), along = all3(t), across = all3(b);
    for (const Four3& local : directions_) {
        const Four3 d = along * local.x + across * local.y + up * local.z;
        const Four falls = dot(d, front);
        Signs within = falls < all(0.0f);
        if (none(within)) continue;
        const Four3 x = from + d * (all(first) / falls);
        for (std::size_t k = 0; k < count; ++k)
            within &= dot(all3(inwards[k]), x - all3(polygon.corner[k])) >= all(0.0f);
        if (none(within)) continue;
        for (int lane = 0; lane < 4; ++lane)
            if (within[lane] != 0) looks.push_back({{x.x[lane], x.y[lane], x.z[lane]}, 1.0f});
    }
    if (looks.size() >= rays) {
        for (std::size_t r = 0; r < rays; ++r) looks[r] = looks[r * looks.size() / rays];
        looks.resize(rays);
        return looks;
    }
    looks.clear();
    const auto corners = corners_of(polygon);
    const glm::vec3 diagonal = corners[2] - corners[0], middle = point_in(corners, 0.5f, 0.5f);
    const float area = area_m2(polygon), least2 = area / std::numbers::pi_v<float>;
    const bool strip = area < kStripWidth * glm::dot(diagonal, diagonal);
    for (std::size_t r = 0; r < rays; ++r) {
        const std::uint64_t at = mixed(hash, r);
        // Off the edge, where two bodies touch.
        const glm::vec3 to = r == 0 && strip ? glm::mix(nearest_in(polygon, n, p.position_m), middle, 0.1f)
                                             : point_in(corners, unit_float(at), unit_float(mixed(at, 3)));
        const glm::vec3 way = to - p.position_m;
        const float far2 = glm::dot(way, way);
        const float cosines = glm::dot(way, p.normal) * -glm::dot(way, n);
        if (glm::dot(way, p.normal) > 0.0f && cosines > 0.0f) looks.push_back({to, cosines / (far2 * (far2 + least2))});
    }
    return looks;
}

// From those points that see most of it rays to places of it: the share whose product with the form factor errs least, by
// its square, over the points.
NearChooser::Seen NearChooser::seen_share(const NearCandidate& candidate, const NearPolygon& polygon, const Surroundings& around,
                                          std::uint64_t hash) const
{
    const auto corners = corners_of(polygon);
    const glm::vec3 n = front_of(corners);
    const float regular = patches_.level_cell_m(1);
    std::vector<std::pair<float, std::size_t>> order;
    for (std::size_t k = 0; k < around.points.size(); k += 4) {
        const Four factors = near_form_factors(corners, around.four.position_m[k / 4], around.four.normal[k / 4]);
        for (std::size_t lane = 0; lane < 4 && k + lane < around.points.size(); ++lane) {
            const float factor = factors[static_cast<int>(lane)];
            if (factor > 0.0f) order.push_back({factor, k + lane});
        }
    }
    std::stable_sort(order.begin(), order.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
    // Those that see the most are all beside it: where a frame stands before a pane, others see less of it.
    const auto faint = std::find_if(order.begin(), order.end(), [&](const auto& one) { return one.first < kFaintest * order.front().first; });
    const auto many = static_cast<std::size_t>(faint - order.begin());
    if (many > kSightPoints) {
        for (std::size_t k = 0; k < kSightPoints; ++k) order[k] = order[k * many / kSightPoints];
        order.resize(kSightPoints);
    } else if (order.size() > kSightPoints) {
        order.resize(kSightPoints);
    }
    // Of a look: by which of the points, what it brings, and its way, where it may arrive.
    struct Asked {
        std::size_t point;
        float weight;
        std::size_t ray = kNoRay;
        bool open = false;
    };
    std::vector<Asked> asked;
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const SamplePoint& p = around.points[order[i].second];
        const glm::vec3 from = p.position_m + p.normal * ray_lift_m(p.position_m, regular);
        for (const Look& look : looks(p, polygon, n, kSightRays / order.size(), mixed(hash, order[i].second))) {
            Asked one{i, look.weight};
            const PatchSample place = place_on(triangles_, faces_.faces[candidate.face], candidate.back, look.to);
            if (!((triangles_.flags(place.triangle) & kTriangleMasked) && triangles_.is_hole(place.triangle, place.at))) {
                const glm::vec3 way = look.to - p.position_m;
                const float lift_m = std::min(ray_lift_m(look.to, regular), 0.2f * std::sqrt(glm::dot(way, way)));
                one.open = true;
                if (const auto ray = ray_between(from, look.to + n * lift_m)) {
                    one.ray = rays.size();
                    rays.push_back(*ray);
                }
            }
            asked.push_back(one);
        }
    }
    std::array<bool, kSightRays> blocked{};
    assert(rays.size() <= blocked.size());
    tracer_.blocked(rays, blocked);
    // Over the height before its plane as a line, as far as the points' heights differ.
    struct Sum {
        float weight = 0.0f, seen = 0.0f, height = 0.0f, product = 0.0f, square = 0.0f;
    } sum;
    for (std::size_t i = 0, a = 0; i < order.size(); ++i) {
        float brought = 0.0f, arrived = 0.0f;
        for (; a < asked.size() && asked[a].point == i; ++a) {
            brought += asked[a].weight;
            if (asked[a].open && (asked[a].ray == kNoRay || !blocked[asked[a].ray])) arrived += asked[a].weight;
        }
        if (!(brought > 0.0f)) continue;
        const float weight = order[i].first * order[i].first, share = arrived / brought;
        const float height = std::clamp(glm::dot(around.points[order[i].second].position_m - corners[0], n) / regular, 0.0f, 1.0f);
        sum.weight += weight;
        sum.seen += weight * share;
        sum.height += weight * height;
        sum.product += weight * height * share;
        sum.square += weight * height * height;
    }
    if (!(sum.weight > 0.0f)) return {0.0f, shared::near_seen_packed(0.0f, 0.0f)};
    const float mean = sum.seen / sum.weight, middle = sum.height / sum.weight;
    const float varies = std::max(sum.square / sum.weight - middle * middle, 0.0f);
    const float slope = (sum.product / sum.weight - middle * mean) / (varies + kHeightsAlike);
    return {mean, shared::near_seen_packed(mean - slope * middle, mean + slope * (1.0f - middle))};
}

}  // namespace petrichor::scene
