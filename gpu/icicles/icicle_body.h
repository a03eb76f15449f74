#ifndef PETRICHOR_GPU_ICICLES_ICICLE_BODY_H
#define PETRICHOR_GPU_ICICLES_ICICLE_BODY_H

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/frame/frame.h"
#include "gpu/upload/gpu_scene.h"
#include "scene/icicles/icicles.h"

namespace petrichor::gpu {

/// Icicles of a scene as geometry of a frame. Without any none of their triangles are drawn and nothing is worked out.
class IcicleBody {
public:
    explicit IcicleBody(std::shared_ptr<const scene::Icicles> icicles);

    /// What the scene is made with: room for all of them.
    const Overlay& overlay() const { return overlay_; }

    std::uint32_t material() const { return icicles_->material; }

    /// Shapes those of a frame, by their lengths alone; true when they are others than before.
    bool lay(const Frame& frame);
    /// Empty: there are none.
    LaidOverlay laid() const;

    /// Points that drip, in the order of a scene, where water leaves them in this frame: at the tips.
    std::vector<scene::DripPoint> tips(std::span<const scene::DripPoint> points) const;

private:
    std::shared_ptr<const scene::Icicles> icicles_;
    Overlay overlay_;
    std::vector<std::uint32_t> counts_;
    std::vector<std::uint8_t> hidden_;
    std::optional<scene::IcicleLengths> laid_;
    bool hang_ = false;
};

/// Two overlays of one scene, one behind the other.
Overlay joined(const Overlay& first, const Overlay& second);

/// Both as they lie in a frame; where one is empty its parts are not drawn.
class JoinedOverlay {
public:
    JoinedOverlay(const Overlay& first, const LaidOverlay& first_laid, const Overlay& second, const LaidOverlay& second_laid);
    LaidOverlay laid() const;

private:
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_, counts_;
    std::vector<std::uint8_t> hidden_;
    std::span<const Covered> covered_;
    bool snow_ = false;
};

}  // namespace petrichor::gpu

#endif
