#ifndef PETRICHOR_DEMO_STREET_WALLS_H
#define PETRICHOR_DEMO_STREET_WALLS_H

#include <vector>

#include "demo/street_parts.h"

namespace petrichor::demo {

/// A hole in a wall, in the wall's own coordinates, metres.
struct Opening {
    float u0, u1, v0, v1;
};

struct WindowStyle {
    int panes_u = 2;
    int panes_v = 3;
    bool lit = false;    ///< light behind it at dusk
    bool lintel = true;  ///< a stone above
    bool shutters = false;
    bool flowers = false;   ///< a box of geraniums on the sill
    float depth_m = 0.11f;  ///< of the pane behind the wall's face
    glm::vec4 paint{0.80f, 0.78f, 0.70f, 1.0f};
};

/// A roof with its ridge along the wall, on a house that stands behind the wall's frame.
struct Roof {
    float width;  ///< along the wall
    float depth;  ///< of the house
    float eave_v;
    float rise;  ///< from the eaves to the ridge
    float overhang = 0.32f;
};

/// A bevelled box between two corners in a wall's coordinates; v of the texture along axis `grain`.
void add_box(Kit& kit, Slot slot, const Frame& frame, glm::vec3 low, glm::vec3 high, float bevel,
             int grain = 1);

/// A wall from (0, 0) to (width, height) with holes, darker at the foot and under the eaves.
void add_wall(Kit& kit, Slot slot, const Frame& frame, float width, float height,
              const std::vector<Opening>& openings, const glm::vec3& tint = glm::vec3(1.0f));

/// What fills a hole: reveals, pane, frame, sill; or reveals, leaf, light above, step.
void add_window(Kit& kit, Slot wall, const Frame& frame, const Opening& o,
                const WindowStyle& style);
void add_door(Kit& kit, Slot wall, const Frame& frame, const Opening& o, const glm::vec4& color);

/// Both slopes with ridge tiles, verges, eaves and a rain gutter along the front.
void add_roof(Kit& kit, const Frame& frame, const Roof& roof);
/// A pipe from the rain gutter down the wall.
void add_downpipe(Kit& kit, const Frame& frame, float u, float eave_v, float overhang,
                  float bottom_v);
void add_chimney(Kit& kit, const glm::vec3& foot, float height);

}  // namespace petrichor::demo

#endif
