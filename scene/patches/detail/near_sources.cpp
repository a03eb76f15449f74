#include "scene/patches/detail/near_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/near_rays.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {
namespace {

constexpr int kRays = static_cast<int>(NearLinks::kLinks);
constexpr int kGuessEvery = 4;         // of its rays, for the light that it may send
constexpr float kGuessAlbedo = 0.5f;   // whatever it is made of
constexpr float kSmallest_m2 = 1e-8f;
constexpr int kPartBits = 20;
constexpr float kMostParts = 1000000.0f;

// Of visibility bits, unit.
const std::array<glm::vec3, 256>& sky_directions()
{
    static const std::array<glm::vec3, 256> directions = [] {
        std::array<glm::vec3, 256> made;
        for (std::size_t bit = 0; bit < made.size(); ++bit) {
            const glm::vec3 raw = shared::visibility_raw_direction(static_cast<int>(bit));
            made[bit] = raw / std::sqrt(glm::dot(raw, raw));
        }
        return made;
    }();
    return directions;
}

}  // namespace

NearSources::NearSources(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const GlowLinks* glow,
                         std::span<const NearHint> hints)
    : patches_(patches), tracer_(tracer), triangles_(tracer.triangles()), faces_(faces), glow_(glow), hints_(hints)
{
}

NearSources::Box NearSources::around(std::uint32_t face) const
{
    const NearPolygon& polygon = faces_.faces[face].polygon;
    Box box{polygon.corner[0], polygon.corner[0]};
    for (int k = 1; k < polygon.count; ++k) {
        box.low = glm::min(box.low, polygon.corner[static_cast<std::size_t>(k)]);
        box.high = glm::max(box.high, polygon.corner[static_cast<std::size_t>(k)]);
    }
    return box;
}

glm::ivec3 NearSources::parts(const Box& box, int level) const
{
    return glm::ivec3(glm::clamp((box.high - box.low) / patches_.level_cell_m(level) + 0.5f, 1.0f, kMostParts));
}

NearSourceKey NearSources::key_at(std::uint32_t face, bool back, glm::vec3 x, int level) const
{
    const Box box = around(face);
    const glm::ivec3 count = parts(box, level);
    const glm::vec3 at = (x - box.low) / glm::max(box.high - box.low, 1e-12f);
    const glm::ivec3 part = glm::clamp(glm::ivec3(at * glm::vec3(count)), glm::ivec3(0), count - 1);
    std::uint64_t bits = static_cast<std::uint64_t>(level);
    for (int k = 0; k < 3; ++k) bits = bits << kPartBits | static_cast<std::uint64_t>(part[k]);
    return {2 * face + (back ? 1u : 0u), bits};
}

NearSources::Box NearSources::part_of(NearSourceKey key) const
{
    const Box box = around(key.face());
    const glm::vec3 step = (box.high - box.low) / glm::vec3(parts(box, static_cast<int>(key.part >> 3 * kPartBits)));
    glm::vec3 part;
    for (int k = 0; k < 3; ++k)
        part[k] = static_cast<float>(key.part >> (2 - k) * kPartBits & ((std::uint64_t{1} << kPartBits) - 1));
    return {box.low + step * part, box.low + step * (part + 1.0f)};
}

std::array<glm::vec3, 4> NearSources::corners_at(NearSourceKey key) const
{
    NearPolygon polygon = faces_.faces[key.face()].polygon;
    if (key.back()) std::reverse(polygon.corner.begin(), polygon.corner.begin() + polygon.count);
    if (key.part == NearSourceKey::kWhole) return corners_of(polygon);
    Box box = part_of(key);
    // Thin ones are whole: rounding.
    const glm::vec3 margin = 1e-4f * (box.high - box.low) + 1e-6f * glm::max(glm::abs(box.low), glm::abs(box.high));
    NearPolygon piece = cut_to(polygon, box.low - margin, box.high + margin);
    simplify(piece);
    return corners_of(piece.count >= 3 && area_m2(piece) > kSmallest_m2 ? piece : polygon);
}

NearSourceKey NearSources::wider(NearSourceKey key) const
{
    const int level = static_cast<int>(key.part >> 3 * kPartBits) + 1;
    const Box box = part_of(key);
    if (level >= patches_.levels) return {key.face_side, NearSourceKey::kWhole};
    return key_at(key.face(), key.back(), 0.5f * (box.low + box.high), level);
}

std::uint64_t NearSources::hash_of(NearSourceKey key) const
{
    return mixed(mixed(patches_.seed, key.part), key.face_side);
}

std::optional<std::uint32_t> NearSources::sender_at(const std::array<glm::vec3, 4>& corners) const
{
    return patch_at(patches_, point_in(corners, 0.5f, 0.5f), front_of(corners));
}

NearGuess NearSources::guess(NearSourceKey key) const
{
    NearGuess guess{key, {}};
    std::array<NearMeets, static_cast<std::size_t>(kRays / kGuessEvery)> met{};
    std::size_t lost = 0;
    std::optional<std::uint32_t> sender;
    for (;;) {
        const auto corners = corners_at(guess.shown);
        sender = sender_at(corners);
        lost = 0;
        near_meets(patches_, tracer_, corners, kGuessEvery, kRays, hash_of(guess.shown), met);
        for (const NearMeets& m : met) lost += m.inside ? 1 : 0;
        if ((sender && lost < met.size()) || guess.shown.part == NearSourceKey::kWhole) break;
        guess.shown = wider(guess.shown);
    }
    if (!sender) return guess;
    // What glows is judged by materials: a strip beside a lit pane has half of the pane's light, where the patch of both is
    // the mean of a pane and its frame.
    const float share = lost < met.size() ? kGuessAlbedo / static_cast<float>(met.size() - lost) : 0.0f;
    float arrives = 0.0f;
    for (const NearMeets& m : met) {
        const bool near = m.triangle != RayHit::kNothing && m.distance_m < kGlowNear_m;
        arrives += near ? glow_of(triangles_, m.triangle) : 0.0f;
    }
    guess.sent.push_back(glow_of(triangles_, faces_.faces[key.face()].triangles[0]) + share * arrives);
    for (const NearHint& hint : hints_) {
        float falls = 0.0f;
        for (const NearMeets& m : met) falls += m.id < patches_.count ? hint.radiosity[m.id] : 0.0f;
        guess.sent.push_back(hint.radiosity[*sender] + share * falls);
    }
    return guess;
}

// As trace_visibility has it; a fourth of the directions is tried first, and where none of them and no ray of its row
// (`up`) leaves, or all do, the others are alike.
void NearSources::trace_sky(NearSource& source, std::span<const glm::vec3> points, std::uint64_t hash, bool up) const
{
    const glm::vec3 n = front_of(source.corners);
    const auto show = [&](std::size_t bit) { source.visible[bit >> 5] |= 1u << (bit & 31); };
    std::array<Ray, 256> rays;
    std::array<std::size_t, 256> bit_of;
    std::array<bool, 256> blocked;
    // Every other one of every other row of 16.
    const auto first = [](std::size_t bit) { return (bit & 1u) == 0 && (bit >> 4 & 1u) == 0; };
    // How many of those in front leave, of how many.
    const auto look = [&](bool at_first) {
        std::size_t count = 0, left = 0;
        for (std::size_t bit = 0; bit < rays.size(); ++bit) {
            const glm::vec3& d = sky_directions()[bit];
            if (first(bit) != at_first || !(glm::dot(n, d) > 0.0f)) continue;
            const glm::vec3 x = points[mixed(hash, bit) % points.size()];
            rays[count] = {x + n * ray_lift_m(x, patches_.level_cell_m(1)), d};
            bit_of[count++] = bit;
        }
        tracer_.blocked({rays.data(), count}, blocked);
        for (std::size_t k = 0; k < count; ++k) {
            if (blocked[k]) continue;
            show(bit_of[k]);
            ++left;
        }
        return std::pair{left, count};
    };
    const auto [left, asked] = look(true);
    if (left == 0 && !up) return;
    if (left < asked) {
        look(false);
        return;
    }
    for (std::size_t bit = 0; bit < rays.size(); ++bit)
        if (!first(bit) && glm::dot(n, sky_directions()[bit]) > 0.0f) show(bit);
}

NearSource NearSources::traced(NearSourceKey shown) const
{
    NearSource source;
    const std::uint64_t hash = hash_of(shown);
    source.corners = corners_at(shown);
    source.sender = sender_at(source.corners).value();
    std::array<std::uint32_t, NearLinks::kLinks> met{};
    std::array<NearMeets, NearLinks::kLinks> row{};
    near_meets(patches_, tracer_, source.corners, 1, kRays, hash, row);
    std::vector<glm::vec3> points;  // where it shows
    std::vector<std::size_t> inside;
    bool up = false, whole = true;
    for (std::size_t r = 0; r < met.size(); ++r) {
        const NearMeets& meets = row[r];
        source.links[r] = static_cast<std::uint16_t>(meets.id);
        met[r] = meets.triangle;
        if (meets.inside) inside.push_back(r);
        else points.push_back(meets.from);
        whole = whole && meets.draws == 1;
        up = up || (meets.id >= patches_.count && meets.id != patches_.black());
    }
    // Parts of it that lie inside a body are not seen: the other rays stand in, one after the other.
    const auto lost = [&](std::size_t r) { return std::binary_search(inside.begin(), inside.end(), r); };
    std::size_t other = 0;
    for (const std::size_t r : inside) {
        if (points.empty()) break;
        do other = (other + 1) % met.size();
        while (lost(other));
        source.links[r] = source.links[other];
        met[r] = met[other];
    }
    for (std::size_t k = 0; k < source.points.size(); ++k) {
        const glm::vec3 middle = lamp_point(source.corners, k);
        glm::vec3 nearest = middle;
        float least = std::numeric_limits<float>::max();
        for (const glm::vec3& x : points) {
            if (whole) break;
            const float far2 = glm::dot(x - middle, x - middle);
            if (far2 < least) {
                least = far2;
                nearest = x;
            }
        }
        source.points[k] = nearest;
        source.samples[k] = place_on(triangles_, faces_.faces[shown.face()], shown.back(), nearest);
    }
    if (!points.empty()) trace_sky(source, points, mixed(hash, 1), up);
    if (glow_ != nullptr && !glow_->empty()) near_glow(source, met);
    return source;
}

void NearSources::near_glow(NearSource& source, const std::array<std::uint32_t, NearLinks::kLinks>& met) const
{
    const glm::vec3 middle = point_in(source.corners, 0.5f, 0.5f);
    const auto is_near = [&](std::uint32_t glowing) {
        const glm::vec3 d = patches_.position_m[glowing] - middle;
        const float far = kGlowNear_m + std::sqrt(patches_.area_m2[glowing]);
        return glm::dot(d, d) < far * far;
    };
    const auto add = [&](std::uint32_t glowing, float more) {
        for (auto& [patch, sum] : source.glow) {
            if (patch != glowing) continue;
            sum += more;
            return;
        }
        source.glow.push_back({glowing, more});
    };
    for (std::uint32_t g = glow_->first[source.sender]; g < glow_->first[source.sender + 1]; ++g) {
        const std::uint32_t glowing = glow_->senders[glow_->sender[g]];
        if (is_near(glowing)) add(glowing, -glow_->factor[g]);
    }
    // The light of a patch is the mean of what glows of it and what does not: a ray that meets the pane has all of it,
    // one that meets its frame nothing.
    for (std::size_t r = 0; r < source.links.size(); ++r) {
        const std::uint32_t id = source.links[r];
        if (!std::binary_search(glow_->senders.begin(), glow_->senders.end(), id) || !is_near(id)) continue;
        int glowing = 0;
        for (std::size_t k = 0; k < kPatchSamples; ++k)
            glowing += glow_of(triangles_, patches_.samples[std::size_t{id} * kPatchSamples + k].triangle) > 0.0f ? 1 : 0;
        if (glowing == 0 || met[r] == RayHit::kNothing || !(glow_of(triangles_, met[r]) > 0.0f)) continue;
        add(id, static_cast<float>(kPatchSamples) / static_cast<float>(glowing) / static_cast<float>(NearLinks::kLinks));
    }
}

}  // namespace petrichor::scene
