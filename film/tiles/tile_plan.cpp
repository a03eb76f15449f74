#include "film/tiles/tile_plan.h"

#include <algorithm>

namespace petrichor::film {
namespace {

// Of the longer side: what stands in a puddle is seen sharply so far from it.
constexpr int kBorderShare = 64;
constexpr int kLeastBorder = 96;  // so far the screen's occlusion looks

int in_steps(int pixels)
{
    return (pixels + gpu::kTileStep - 1) / gpu::kTileStep * gpu::kTileStep;
}

int window_side(int picture, int tile, int border)
{
    return std::min(picture, tile + 2 * border);
}

// Where a window begins that holds a tile from `at` on: in steps, and never more than one past the picture's end.
int window_begin(int at, int picture, int side, int border)
{
    return std::clamp(at - border, 0, in_steps(picture - side));
}

}  // namespace

int TilePlan::window_width() const
{
    return window_side(width, tile, border);
}

int TilePlan::window_height() const
{
    return window_side(height, tile, border);
}

bool is_tiled(int width, int height, int asked)
{
    const bool large = static_cast<std::int64_t>(width) * height > kMostWhole;
    const int tile = asked > 0 ? asked : kUsualTile;
    return (asked > 0 || large) && (width > tile || height > tile);
}

TilePlan plan_tiles(int width, int height, int asked)
{
    TilePlan plan{width, height, std::max(width, height), 0, 1, 1};
    if (!is_tiled(width, height, asked)) return plan;
    plan.tile = in_steps(asked > 0 ? asked : kUsualTile);
    plan.border = std::max(in_steps(std::max(width, height) / kBorderShare), kLeastBorder);
    plan.columns = (width + plan.tile - 1) / plan.tile;
    plan.rows = (height + plan.tile - 1) / plan.tile;
    return plan;
}

PlannedTile tile_at(const TilePlan& plan, int column, int row)
{
    PlannedTile planned;
    planned.kept.x = column * plan.tile;
    planned.kept.y = row * plan.tile;
    planned.kept.width = std::min(plan.tile, plan.width - planned.kept.x);
    planned.kept.height = std::min(plan.tile, plan.height - planned.kept.y);
    planned.window.width = plan.window_width();
    planned.window.height = plan.window_height();
    planned.window.x = window_begin(planned.kept.x, plan.width, planned.window.width, plan.border);
    planned.window.y = window_begin(planned.kept.y, plan.height, planned.window.height, plan.border);
    return planned;
}

}  // namespace petrichor::film
