// What pieces of faces send to the points that are close to them: traced once for all patches that keep a part of it.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_SOURCES_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_SOURCES_H

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scene/patches/detail/near_faces.h"
#include "scene/patches/near_light.h"

namespace petrichor::scene {

/// A side of a face, and the part of the box around it that cuts a piece of it: parts are alike, so that none is a sliver,
/// and about as long as cells of a level.
struct NearSourceKey {
    static constexpr std::uint64_t kWhole = ~std::uint64_t{0};
    std::uint32_t face_side = 0;  ///< 2 x face, + 1: its back
    std::uint64_t part = kWhole;  ///< 20 bits an axis, then the level; kWhole: all of the face

    std::uint32_t face() const { return face_side >> 1; }
    bool back() const { return (face_side & 1u) != 0; }
    auto operator<=>(const NearSourceKey&) const = default;
};

struct NearSource {
    std::array<glm::vec3, 4> corners;
    std::array<glm::vec3, NearLinks::kSamples> points;
    std::uint32_t sender = 0;
    std::array<PatchSample, NearLinks::kSamples> samples{};
    std::array<std::uint32_t, 8> visible{};
    std::array<std::uint16_t, NearLinks::kLinks> links{};
    std::vector<std::pair<std::uint32_t, float>> glow;
};

/// What a source may send, by a few rays: by what glows and is near, and under each hint.
struct NearGuess {
    NearSourceKey shown;  ///< the piece, or the least around it that is not all inside a body
    std::vector<float> sent;  ///< empty where no patch is near
};

class NearSources {
public:
    /// All must outlive it. glow: null: none.
    NearSources(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const GlowLinks* glow,
                std::span<const NearHint> hints);

    /// The piece of a face's side around a point of it.
    NearSourceKey key_at(std::uint32_t face, bool back, glm::vec3 x, int level) const;
    NearGuess guess(NearSourceKey key) const;
    /// What it is made of, and where its light comes from. shown: NearGuess::shown.
    NearSource traced(NearSourceKey shown) const;

private:
    struct Box {
        glm::vec3 low, high;
    };
    Box around(std::uint32_t face) const;
    Box part_of(NearSourceKey key) const;
    glm::ivec3 parts(const Box& box, int level) const;
    std::array<glm::vec3, 4> corners_at(NearSourceKey key) const;
    NearSourceKey wider(NearSourceKey key) const;
    std::uint64_t hash_of(NearSourceKey key) const;
    std::optional<std::uint32_t> sender_at(const std::array<glm::vec3, 4>& corners) const;
    void trace_sky(NearSource& source, std::span<const glm::vec3> points, std::uint64_t hash, bool up) const;
    void near_glow(NearSource& source, const std::array<std::uint32_t, NearLinks::kLinks>& met) const;

    const Patches& patches_;
    const Tracer& tracer_;
    const Triangles& triangles_;
    const NearFaces& faces_;
    const GlowLinks* glow_;
    std::span<const NearHint> hints_;
};

}  // namespace petrichor::scene

#endif
