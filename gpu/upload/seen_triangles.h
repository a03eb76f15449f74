#ifndef PETRICHOR_GPU_UPLOAD_SEEN_TRIANGLES_H
#define PETRICHOR_GPU_UPLOAD_SEEN_TRIANGLES_H

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gpu/upload/asked_part.h"
#include "gpu/upload/gpu_scene.h"
#include "gpu/upload/instance_places.h"
#include "gpu/upload/occluders.h"
#include "gpu/upload/triangle_blocks.h"

namespace petrichor::gpu {

/// Where the points lie that a view samples, and from where it looks.
struct SampledView {
    glm::mat4 clip_from_world{1.0f};
    int width = 0;
    int height = 0;
    std::vector<glm::vec2> offsets{glm::vec2(0.0f)};  ///< of the samples, pixels from the middle of one
    std::uint8_t hidden = 0;  ///< from where the overlay hides what lies below it: Covered::kFrom..
    AskedPart asked;  ///< of a view without perspective: what of it counts
    std::uint8_t steep = 0;  ///< SteepTriangles: what is marked in the numbers
};

/// Indices of those of a draw's triangles that some sample may meet, in the order of the draw.
struct SeenRange {
    static constexpr std::uint32_t kWhole = UINT32_MAX;  ///< not sorted out: all of the scene's
    std::uint32_t first_index = 0;
    std::uint32_t index_count = kWhole;
    bool whole() const { return index_count == kWhole; }
};

/// A vertex on the screen.
struct Corner {
    float x = 0.0f, y = 0.0f;   ///< pixels
    float nearer = 0.0f;        ///< 1 / w; 0: not before the eye
    std::uint32_t outside = 0;  ///< of which lines of what is asked; the highest bit: farther than all that asks
};

/// What of a scene a view may see: a range for each draw of the scene's list.
struct SeenDraws {
    std::vector<SeenRange> ranges;
    const GpuBuffer* indices = nullptr;
    GpuBuffer* numbers = nullptr;  ///< R32UI: which triangle of its draw the n-th of `indices` is; ID_STEEP of those that are
};

/// A CPU driver shades and sorts every triangle on one thread, before it knows whether a pixel shows it. Here
/// those are left out that lie outside of the view, turn their back and are not shown from there, lie
/// between the samples, or behind something large in a map that has no perspective. What rounding may decide stays, so that no picture changes.
class SeenTriangles {
public:
    explicit SeenTriangles(const Device& device) : device_(&device), places_(device) {}

    /// Of a scene that goes away.
    void forget()
    {
        scene_ = nullptr;
        places_.forget();
    }
    /// Forgets what was listed before: no device may be drawing it.
    void reset(const GpuScene& scene);
    /// Of what is drawn at once in the maps of this frame.
    InstancePlaces& places() { return places_; }

    /// `back_faces`: those are shown whatever the materials say. Draws that are `wanted` alone are
    /// looked at. Null: this device needs no such help, or there is no room for more.
    template <class Wanted>
    std::shared_ptr<const SeenDraws> list(const GpuScene& scene, const SampledView& view,
                                          bool back_faces, const Wanted& wanted)
    {
        if (!indices_) return nullptr;
        std::vector<const Draw*> all, draws;
        for (const Draw& draw : scene.draws()) {
            if (draw.index_count == 0 || !wanted(draw)) continue;
            all.push_back(&draw);
            if (draw.index_count >= kLeastIndices) draws.push_back(&draw);
        }
        if (draws.empty()) return nullptr;
        return list_of(scene, view, back_faces, draws, all);
    }

private:
    static constexpr std::uint32_t kLeastIndices = 3 * 256;

    std::shared_ptr<const SeenDraws> list_of(const GpuScene& scene, const SampledView& view,
                                             bool back_faces, std::span<const Draw* const> draws,
                                             std::span<const Draw* const> all);
    Occluders occluders(const GpuScene& scene, const SampledView& view, std::span<const Draw* const> draws);

    const Device* device_;
    InstancePlaces places_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> indices_;
    std::unique_ptr<GpuBuffer> numbers_;
    std::size_t capacity_ = 0;  // triangles
    std::size_t used_ = 0;
    const GpuScene* scene_ = nullptr;  // that the buffers are made for
    struct Blocks {
        std::uint64_t version = 0;
        std::uint32_t index_count = 0;
        std::vector<TriangleBlock> made;
    };
    const std::vector<TriangleBlock>& blocks(const GpuScene& scene, const Draw& draw, const glm::vec3* own, const std::uint32_t* indices);
    void list_draw(const GpuScene& scene, const SampledView& view, bool back_faces, const Draw& draw,
                   const Occluders* occluders);
    using Place = std::pair<std::uint32_t, std::int32_t>;  // the first index and vertex
    std::map<Place, Blocks> blocks_;
    std::map<Place, std::vector<LargeFace>> large_;
    std::vector<Corner> corners_;          // of the draw that is listed
    std::vector<std::uint8_t> projected_;  // which groups of them are known
};

/// Draws what `seen` (null: all) has left of a draw, and binds the indices that it needs. The scene's are
/// bound before.
class SeenBinder {
public:
    SeenBinder(VkCommandBuffer commands, const GpuScene& scene, const SeenDraws* seen)
        : commands_(commands), scene_(&scene), seen_(seen)
    {
    }
    /// The part of the draw that is left; nothing of it: index_count is 0.
    SeenRange range_of(const Draw& draw) const;
    ///   instance  that its vertices are told
    void draw(const Draw& draw, const SeenRange& range, std::uint32_t instance = 0);
    /// `count` instances, numbered from `first`; always whole.
    void draw_run(const Draw& draw, std::uint32_t count, std::uint32_t first);

private:
    void bind(bool listed);

    VkCommandBuffer commands_;
    const GpuScene* scene_;
    const SeenDraws* seen_;
    bool listed_bound_ = false;
};

}  // namespace petrichor::gpu

#endif
