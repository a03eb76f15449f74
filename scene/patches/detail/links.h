// What is traced once the cells are there: links, connections, visibility.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H

#include <array>
#include <span>
#include <vector>
#include <cstddef>
#include <cstdint>

#include "scene/patches/patches.h"

namespace petrichor::scene {

/// The rays of a patch's row. Each may be drawn up to kDraws times: the first that does not start inside a body counts.
class RowRays {
public:
    static constexpr std::size_t kDraws = 4;
    RowRays(const Patches& patches, const Triangles& triangles, std::uint32_t patch);
    /// About the normal of where ray r starts.
    glm::vec3 local(int r) const;
    /// local: of r.
    Ray ray(int r, glm::vec3 local, std::size_t draw) const;

private:
    struct Start {
        glm::vec3 position_m, normal, t, b;
    };
    std::uint64_t hash_;
    int count_;
    std::array<Start, kPatchSamples> starts_;
};

struct LinkRay {
    Ray ray;
    RayHit hit;
    bool inside = false;  ///< it starts inside a body, whatever was drawn
    std::size_t draws = 0;
};
/// Rays of a row by their numbers, together.
std::vector<LinkRay> trace_row(const Tracer& tracer, const RowRays& row, std::span<const int> which);

/// Where the light of a hit comes from; black where no patch is near.
std::uint32_t patch_of_hit(const Patches& patches, const Triangles& triangles, const Ray& ray, const RayHit& hit);

/// Fills links, sky_view and open.
void trace_links(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills connected.
void connect(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills visible.
void trace_visibility(Patches& patches, const Tracer& tracer, const PatchOptions& options);

}  // namespace petrichor::scene

#endif
