// Which polygons close to a patch are kept for it.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_CHOICE_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_CHOICE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "scene/patches/detail/four.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/near_four.h"
#include "scene/patches/detail/near_sources.h"
#include "scene/patches/near_light.h"

namespace petrichor::scene {

/// A part of a face that may be kept.
struct NearCandidate {
    std::uint32_t face;
    bool back;
    float square;               ///< mean of form factors squared
    NearSourceKey source;       ///< what of the face is nearest to those who see it
    std::uint32_t guess = 0;    ///< number of its NearGuess
};

struct NearChoice {
    std::uint32_t face;
    bool back;
    std::array<glm::vec3, 4> corners;
    float seen;  ///< share of it, from the patch (shared::near_seen)
    NearSourceKey source;  ///< as it is shown
};

/// Points of all surfaces by the leaf that a lookup there asks: a pane behind its frame is asked of the frame's where
/// that counts more.
/// Of bevels that samples leave out there is a point in each cell along them.
std::vector<std::vector<SamplePoint>> near_receivers(const Patches& patches, const Tracer& tracer,
                                                     const NearFaces& faces, int threads);

class NearChooser {
public:
    /// All must outlive it.
    NearChooser(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const NearSources& sources,
                std::span<const NearHint> hints);
    /// What the receivers see the most of, by its form factor.
    std::vector<NearCandidate> candidates(std::uint32_t patch, std::span<const SamplePoint> receivers) const;
    /// Those that are seen and count, first the ones that count most; at most NearLinks::kMostAPatch.
    std::vector<NearChoice> chosen(std::uint32_t patch, std::span<const SamplePoint> receivers,
                                   std::span<const NearCandidate> candidates,
                                   std::span<const NearGuess> guesses) const;

    /// The points of a patch that are asked, and the box around that what is close lies in.
    struct Surroundings {
        std::vector<SamplePoint> points;
        FourPoints four;  // the same ones
        glm::vec3 middle, half;  // of the points' own box
        glm::vec3 low, high;
        float spacing, area;
    };
    Surroundings surroundings(std::uint32_t patch, std::span<const SamplePoint> receivers) const;
    /// At least the square of its candidate, for a fraction of the work; 0: it has none.
    float most_square(std::uint32_t face, bool back, const Surroundings& around) const;
    /// Nothing where its square is below least_square.
    std::optional<NearCandidate> candidate(std::uint32_t face, bool back, const Surroundings& around,
                                           float least_square) const;

private:
    NearPolygon part_of(std::uint32_t face, bool back, const Surroundings& around) const;
    std::vector<float> merits(std::uint32_t patch, std::span<const NearCandidate> candidates,
                              std::span<const NearGuess> guesses) const;
    struct Look;
    std::vector<Look> looks(const SamplePoint& p, const NearPolygon& polygon, glm::vec3 n, std::size_t rays,
                            std::uint64_t hash) const;
    struct Seen {
        float mean;
        float packed;
    };
    Seen seen_share(const NearCandidate& candidate, const NearPolygon& polygon, const Surroundings& around,
                    std::uint64_t hash) const;

    const Patches& patches_;
    const Tracer& tracer_;
    const Triangles& triangles_;
    const NearFaces& faces_;
    const NearSources& sources_;
    std::span<const NearHint> hints_;
    float reach_ = 0.0f;
    std::vector<Four3> directions_;  // even, about z
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
