#ifndef PETRICHOR_FILM_TILES_LENS_PICTURE_H
#define PETRICHOR_FILM_TILES_LENS_PICTURE_H

#include <cstddef>
#include <optional>
#include <vector>

#include "film/color/display_transform.h"
#include "film/tiles/exposed_light.h"
#include "film/tiles/glare_pyramid.h"
#include "gpu/frame/frame.h"

namespace petrichor::film {

/// The frame that is rendered for a tile in place of `frame`: it hands over exposed light that no lens has touched, since drops
/// and glare reach across all of the picture.
gpu::Frame without_lens(const gpu::Frame& frame);

/// What the display shows of a picture's exposed light: drops on the lens, glare, white balance, tone curve, dither, as the
/// renderer's resolve pass does them, over all of the picture.
class LensPicture {
public:
    /// frame: of the whole picture, as it was asked for. transform: in place of the tone curves of our own, or null. Both and the
    /// light outlive this.
    LensPicture(const gpu::Frame& frame, const ExposedLight& light, const DisplayTransform* transform, int threads);

    /// Rows first .. end - 1, RGB bytes; may be asked by several threads.
    std::vector<std::byte> rows(std::size_t first, std::size_t end) const;

private:
    glm::vec3 seen(int x, int y, const std::uint16_t* pixel) const;

    const gpu::Frame* frame_;
    const ExposedLight* light_;
    const DisplayTransform* transform_;
    std::optional<GlarePyramid> glare_;
    float wet_;
    bool balanced_;
    glm::vec3 gains_;
};

}  // namespace petrichor::film

#endif
