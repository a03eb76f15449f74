#ifndef PETRICHOR_FILM_TILES_GLARE_PYRAMID_H
#define PETRICHOR_FILM_TILES_GLARE_PYRAMID_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "film/tiles/exposed_light.h"

namespace petrichor::film {

/// What the lens scatters of a whole picture, as gpu/passes/glare makes it, of a picture that the renderer sees in parts only.
/// Takes two bytes a pixel of the picture.
class GlarePyramid {
public:
    GlarePyramid(const ExposedLight& light, int threads);

    /// At a pixel of the picture.
    glm::vec3 at(int x, int y) const { return between(levels_.front(), x, y); }

private:
    struct Level {
        int width = 0, height = 0;
        std::vector<std::uint16_t> halves;  // three a texel

        glm::vec3 texel(int x, int y) const;
        void set(int x, int y, const glm::vec3& light);
    };
    static glm::vec3 between(const Level& level, int x, int y);
    static Level below(const ExposedLight& light, int threads);
    static Level below(const Level& level, int threads);

    std::vector<Level> levels_;
};

}  // namespace petrichor::film

#endif
