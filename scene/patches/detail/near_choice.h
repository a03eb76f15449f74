// Which polygons close to a patch are kept for it.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_CHOICE_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_CHOICE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/near_light.h"

namespace petrichor::scene {

struct NearChoice {
    std::uint32_t face;
    bool back;
    NearPolygon polygon;
    float square;  ///< mean of form factors squared
    std::uint32_t sender;
    float merit = 0.0f;
    float seen = 0.0f;  ///< share of it, from the patch
};

/// Points of all surfaces by the leaf that a lookup there asks: a pane behind its frame is asked of the frame's where
/// that counts more.
std::vector<std::vector<SamplePoint>> near_receivers(const Patches& patches, const Triangles& triangles, int threads);

class NearChooser {
public:
    /// All must outlive it.
    NearChooser(const Patches& patches, const Tracer& tracer, const NearFaces& faces, std::span<const NearHint> hints);
    /// Those that are seen and count, first the ones that count most; at most NearLinks::kMostAPatch.
    std::vector<NearChoice> chosen(std::uint32_t patch, std::span<const SamplePoint> receivers) const;

private:
    struct Surroundings {
        std::vector<SamplePoint> points;
        glm::vec3 low, high;
        float spacing, area;
    };
    Surroundings surroundings(std::uint32_t patch, std::span<const SamplePoint> receivers) const;
    std::optional<NearChoice> candidate(std::uint32_t face, bool back, const Surroundings& around) const;
    void judge(std::vector<NearChoice>& found, std::uint32_t patch) const;
    float seen_share(const NearChoice& candidate, const Surroundings& around, std::uint64_t hash) const;

    const Patches& patches_;
    const Tracer& tracer_;
    const Triangles& triangles_;
    const NearFaces& faces_;
    std::span<const NearHint> hints_;
    float reach_ = 0.0f;
};

inline constexpr std::size_t kNearPatchesAJob = 64;
/// body(patch) for all patches, in jobs.
template <class Body>
void for_patches(const Patches& patches, int threads, const Body& body)
{
    const std::size_t jobs = (patches.count + kNearPatchesAJob - 1) / kNearPatchesAJob;
    parallel_for(jobs, threads, [&](std::size_t job) {
        const auto first = static_cast<std::uint32_t>(job * kNearPatchesAJob);
        const std::uint32_t last = std::min(first + static_cast<std::uint32_t>(kNearPatchesAJob), patches.count);
        for (std::uint32_t i = first; i < last; ++i) body(i);
    });
}

}  // namespace petrichor::scene

#endif
