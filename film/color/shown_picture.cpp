#include "film/color/shown_picture.h"

namespace petrichor::film {

void show(gpu::RenderResult& result, const DisplayTransform* transform, bool dither)
{
    if (!transform) return;
    result.display = transform->picture(result.exposed, result.width, dither);
    result.exposed = {};
}

}  // namespace petrichor::film
