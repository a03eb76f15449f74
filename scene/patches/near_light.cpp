#include "scene/patches/near_light.h"

#include <algorithm>

#include "scene/patches/detail/links.h"
#include "scene/patches/detail/near_choice.h"
#include "scene/patches/detail/near_sources.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kSourcesAJob = 64;

struct Row {
    std::vector<std::uint16_t> rays;
    std::vector<std::uint8_t> glow_taken;
};

void sort_unique(std::vector<NearSourceKey>& keys)
{
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

std::uint32_t number_of(const std::vector<NearSourceKey>& keys, const NearSourceKey& key)
{
    return static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
}

template <class Made, class Body>
std::vector<Made> for_sources(const std::vector<NearSourceKey>& keys, int threads, const Body& body)
{
    std::vector<Made> made(keys.size());
    parallel_for((keys.size() + kSourcesAJob - 1) / kSourcesAJob, threads, [&](std::size_t job) {
        const std::size_t last = std::min(keys.size(), (job + 1) * kSourcesAJob);
        for (std::size_t s = job * kSourcesAJob; s < last; ++s) made[s] = body(keys[s]);
    });
    return made;
}

bool holds(const NearChoice& choice, std::uint32_t face, bool back, glm::vec3 x)
{
    return choice.face == face && choice.back == back &&
           holds(polygon_of(choice.corners), front_of(choice.corners), x, 1e-3f);
}

// Which share of the glowing patches around is among what was chosen, by their samples.
std::vector<std::uint8_t> glow_taken(const Patches& patches, const Triangles& triangles, const NearFaces& faces,
                                     const GlowLinks& glow, std::uint32_t patch, std::span<const NearChoice> choices)
{
    std::vector<std::uint8_t> taken;
    for (std::uint32_t g = glow.first[patch]; g < glow.first[patch + 1]; ++g) {
        const std::uint32_t glowing = glow.senders[glow.sender[g]];
        std::size_t held = 0;
        for (std::size_t k = 0; k < kPatchSamples && !choices.empty(); ++k) {
            const PatchSample& sample = patches.samples[std::size_t{glowing} * kPatchSamples + k];
            const std::uint32_t face = faces.of_triangle[sample.triangle];
            const glm::vec3 x = triangles.point(sample.triangle, sample.at);
            held += std::any_of(choices.begin(), choices.end(),
                                [&](const NearChoice& c) { return holds(c, face, sample.back, x); })
                        ? 1
                        : 0;
        }
        taken.push_back(static_cast<std::uint8_t>(held * 255 / kPatchSamples));
    }
    return taken;
}

// A choice's polygon, for what meets it.
struct Shown {
    NearPolygon polygon;
    glm::vec3 front;
};

// Whether a ray may meet what was chosen, whatever stands before it and however often it was drawn: its plane from the front,
// within a margin for rounding.
bool may_meet(std::span<const Shown> shown, const RowRays& row, int r, std::size_t draws)
{
    constexpr float kMargin_m = 4e-3f, kGrazing = 1e-3f;
    const glm::vec3 local = row.local(r);
    for (std::size_t draw = 0; draw < draws; ++draw) {
        const Ray ray = row.ray(r, local, draw);
        for (const Shown& s : shown) {
            const float falls = glm::dot(ray.direction, s.front);
            if (falls > kGrazing) continue;
            const float height = glm::dot(ray.origin - s.polygon.corner[0], s.front);
            if (height < -kMargin_m) continue;
            if (falls > -kGrazing ||
                holds(s.polygon, s.front, ray.origin - ray.direction * (height / falls), kMargin_m))
                return true;
        }
    }
    return false;
}

// The rays of the patch's row that meet what was chosen.
std::vector<std::uint16_t> rays_taken(const Patches& patches, const Tracer& tracer, const NearFaces& faces,
                                      std::uint32_t patch, std::span<const NearChoice> choices)
{
    std::vector<std::uint16_t> rays;
    if (choices.empty()) return rays;
    std::vector<Shown> shown;
    for (const NearChoice& c : choices) shown.push_back({polygon_of(c.corners), front_of(c.corners)});
    const RowRays row(patches, tracer.triangles(), patch);
    std::vector<int> which;
    for (int r = 0; r < patches.rays; ++r) {
        const std::size_t draws = patches.may_be_redrawn(patch, r) ? RowRays::kDraws : 1;
        if (patches.row(patch)[r] < patches.count && may_meet(shown, row, r, draws)) which.push_back(r);
    }
    const std::vector<LinkRay> links = trace_row(tracer, row, which);
    for (std::size_t k = 0; k < which.size(); ++k) {
        const LinkRay& link = links[k];
        if (!link.hit.hit() || link.inside) continue;
        const std::uint32_t face = faces.of_triangle[link.hit.triangle];
        const glm::vec3 x = tracer.triangles().point(link.hit.triangle, link.hit.at);
        if (std::any_of(choices.begin(), choices.end(),
                        [&](const NearChoice& c) { return holds(c, face, link.hit.back, x); }))
            rays.push_back(static_cast<std::uint16_t>(which[k]));
    }
    return rays;
}

void append(NearLinks& near, const Triangles& triangles, const NearSource& source, bool glows)
{
    near.normal.push_back(front_of(source.corners));
    near.points.insert(near.points.end(), source.points.begin(), source.points.end());
    near.sender.push_back(source.sender);
    near.material.push_back(triangles.material(source.samples[0].triangle));
    near.samples.insert(near.samples.end(), source.samples.begin(), source.samples.end());
    near.visible.push_back(source.visible);
    near.links.insert(near.links.end(), source.links.begin(), source.links.end());
    if (!glows) return;
    for (const auto& [patch, more] : source.glow) {
        near.glow_patch.push_back(patch);
        near.glow_more.push_back(more);
    }
    near.glow_first.push_back(static_cast<std::uint32_t>(near.glow_patch.size()));
}

}  // namespace

NearLinks trace_near(const Patches& patches, const Tracer& tracer, const GlowLinks* glow,
                     std::span<const NearHint> hints, int threads)
{
    const Triangles& triangles = tracer.triangles();
    const NearFaces faces = near_faces(triangles);
    const NearSources sources(patches, tracer, faces, glow, hints);
    const NearChooser chooser(patches, tracer, faces, sources, hints);
    const auto receivers = near_receivers(patches, tracer, faces, threads);

    std::vector<std::vector<NearCandidate>> candidates(patches.count);
    for_patches(patches, threads, [&](std::uint32_t i) { candidates[i] = chooser.candidates(i, receivers[i]); });
    std::vector<NearSourceKey> keys;
    for (const auto& list : candidates)
        for (const NearCandidate& c : list) keys.push_back(c.source);
    sort_unique(keys);
    const auto guesses =
        for_sources<NearGuess>(keys, threads, [&](const NearSourceKey& key) { return sources.guess(key); });
    std::vector<std::vector<NearChoice>> chosen(patches.count);
    for_patches(patches, threads, [&](std::uint32_t i) {
        for (NearCandidate& c : candidates[i]) c.guess = number_of(keys, c.source);
        chosen[i] = chooser.chosen(i, receivers[i], candidates[i], guesses);
        candidates[i] = {};
    });
    keys.clear();
    for (const auto& list : chosen)
        for (const NearChoice& c : list) keys.push_back(c.source);
    sort_unique(keys);
    const auto traced =
        for_sources<NearSource>(keys, threads, [&](const NearSourceKey& key) { return sources.traced(key); });
    const bool glows = glow != nullptr && !glow->empty();
    std::vector<Row> rows(patches.count);
    for_patches(patches, threads, [&](std::uint32_t i) {
        rows[i].rays = rays_taken(patches, tracer, faces, i, chosen[i]);
        if (glows) rows[i].glow_taken = glow_taken(patches, triangles, faces, *glow, i, chosen[i]);
    });

    NearLinks near;
    near.first.push_back(0);
    near.ray_first.push_back(0);
    if (glows) near.glow_first.push_back(0);
    for (const NearSource& source : traced) append(near, triangles, source, glows);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        for (const NearChoice& choice : chosen[i]) {
            near.corners.push_back(choice.corners);
            near.seen.push_back(choice.seen);
            near.source.push_back(number_of(keys, choice.source));
        }
        const Row& row = rows[i];
        near.glow_taken.insert(near.glow_taken.end(), row.glow_taken.begin(), row.glow_taken.end());
        near.rays.insert(near.rays.end(), row.rays.begin(), row.rays.end());
        near.first.push_back(static_cast<std::uint32_t>(near.source.size()));
        near.ray_first.push_back(static_cast<std::uint32_t>(near.rays.size()));
    }
    return near;
}

}  // namespace petrichor::scene
