#ifndef PETRICHOR_CLI_SCENE_LAMP_LINES_H
#define PETRICHOR_CLI_SCENE_LAMP_LINES_H

#include "cli/report/drawing.h"
#include "scene/scene.h"

namespace petrichor::cli {

/// Draws the shapes of a scene's lamps (scene/light_lines.h) over the upper `height` rows of its picture
/// from a camera; surfaces do not hide them.
void draw_lamps(Pixels& pixels, int height, const scene::Scene& scene, const scene::Camera& camera);

}  // namespace petrichor::cli

#endif
