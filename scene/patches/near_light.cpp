#include "scene/patches/near_light.h"

#include <algorithm>
#include <cmath>

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/near_choice.h"
#include "scene/patches/detail/near_rays.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {
namespace {

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

class Lighter {
public:
    Lighter(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const GlowLinks* glow)
        : patches_(patches), tracer_(tracer), triangles_(tracer.triangles()), faces_(faces), glow_(glow)
    {
    }
    Row row_of(std::uint32_t patch, std::span<const NearChoice> choices) const;

private:
    void light(Entry& entry, std::uint64_t hash) const;
    void near_glow(Entry& entry) const;
    std::array<std::uint32_t, 8> sky_seen(const Entry& entry, std::uint64_t hash, bool up) const;
    std::vector<std::uint8_t> glow_taken(std::uint32_t patch, const std::vector<Entry>& entries) const;

    const Patches& patches_;
    const Tracer& tracer_;
    const Triangles& triangles_;
    const NearFaces& faces_;
    const GlowLinks* glow_;
};

// As trace_visibility has it; a fourth of the directions is tried first, and where none of them and no ray of its row
// (`up`) leaves, or all do, the others are alike.
std::array<std::uint32_t, 8> Lighter::sky_seen(const Entry& entry, std::uint64_t hash, bool up) const
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

// What it is made of, and where its light comes from.
void Lighter::light(Entry& entry, std::uint64_t hash) const
{
    for (std::size_t k = 0; k < entry.samples.size(); ++k)
        entry.samples[k] =
            place_on(triangles_, faces_.faces[entry.face], entry.back, lamp_point(entry.corners, k));
    constexpr auto kRays = static_cast<int>(NearLinks::kLinks);
    std::size_t lost = 0;
    bool up = false;
    for (int r = 0; r < kRays; ++r) {
        const NearMeets meets = near_meets(patches_, tracer_, entry.corners, r, kRays, hash);
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

void Lighter::near_glow(Entry& entry) const
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
            glowing += glow_of(triangles_, patches_.samples[std::size_t{id} * kPatchSamples + k].triangle) > 0.0f ? 1 : 0;
        if (glowing == 0 || entry.met[r] == RayHit::kNothing || !(glow_of(triangles_, entry.met[r]) > 0.0f)) continue;
        add(id, static_cast<float>(kPatchSamples) / static_cast<float>(glowing) / static_cast<float>(NearLinks::kLinks));
    }
}

// Which share of the glowing patches around is among the entries, by their samples.
std::vector<std::uint8_t> Lighter::glow_taken(std::uint32_t patch, const std::vector<Entry>& entries) const
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

Row Lighter::row_of(std::uint32_t patch, std::span<const NearChoice> choices) const
{
    Row row;
    const bool glows = glow_ != nullptr && !glow_->empty();
    const std::uint64_t hash = cell_hash(patches_.seed, patches_.key[patch]);
    for (const NearChoice& c : choices) {
        Entry entry;
        entry.corners = corners_of(c.polygon);
        entry.face = c.face;
        entry.back = c.back;
        entry.seen = c.seen;
        entry.sender = c.sender;
        light(entry, mixed(hash, 2 * std::uint64_t{c.face} + (c.back ? 1 : 0)));
        if (glows) near_glow(entry);
        row.entries.push_back(std::move(entry));
    }
    if (glows) row.glow_taken = glow_taken(patch, row.entries);
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
    const NearChooser chooser(patches, tracer, faces, hints);
    const Lighter lighter(patches, tracer, faces, glow);
    const auto receivers = near_receivers(patches, tracer.triangles(), threads);
    std::vector<Row> rows(patches.count);
    for_patches(patches, threads,
                [&](std::uint32_t i) { rows[i] = lighter.row_of(i, chooser.chosen(i, receivers[i])); });
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
