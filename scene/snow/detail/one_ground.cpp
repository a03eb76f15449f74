#include "scene/snow/detail/one_ground.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/snow/detail/circle_plane.h"

namespace petrichor::scene::detail {
namespace {

using glm::ivec2;
using glm::vec2;

constexpr float kWideGround_m2 = 0.6f;    // ground that hangs together and is no larger keeps its shape
constexpr float kWidePlateau_m2 = 0.25f;  // what stands higher than all around it and is no larger is a thing
constexpr float kHeadroom_m = 1.0f;
constexpr int kThing = 3;                 // cells: what is no wider than twice this is no ground
constexpr float kNoHeight_m = 1.0e9f;
constexpr int kCloses = 3;                // cells: joints no wider than twice this are as high as their stones
constexpr float kWidth = 1.6f;            // radius of the circle, over the depth, as that of the caps

class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t i) const
    {
        while (parent_[i] != i) i = parent_[i];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = shortened(a);
        b = shortened(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }
    /// Members of each group, at its root. Afterwards each member's parent is its root.
    std::vector<std::uint32_t> sizes()
    {
        std::vector<std::uint32_t> count(parent_.size(), 0);
        for (std::uint32_t i = 0; i < parent_.size(); ++i) ++count[parent_[i] = root(i)];
        return count;
    }

private:
    std::vector<std::uint32_t> parent_;

    std::uint32_t shortened(std::uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
};

}  // namespace

OneGround::OneGround(const Sheet& sheet) : sheet_(&sheet), width_(sheet.width()), height_(sheet.height())
{
    const auto& layers = sheet.layers();
    // Over a joint or a bevel too.
    const auto beside = [&](const auto& visit) {
        for (int z = 0; z < height_; ++z)
            for (int x = 0; x < width_; ++x)
                for (int k = 1; k <= kJoint; ++k)
                    for (const ivec2 to : {ivec2(x + k, z), ivec2(x, z + k)}) {
                        if (to.x >= width_ || to.y >= height_) continue;
                        for (std::uint32_t a = sheet.first(x, z); a != Sheet::kNoLayer; a = layers[a].next)
                            for (std::uint32_t b = sheet.first(to.x, to.y); b != Sheet::kNoLayer; b = layers[b].next)
                                if (std::abs(layers[a].height_m - layers[b].height_m) < kHighestStep_m) visit(a, b);
                    }
    };
    Groups grounds(layers.size()), plateaus(layers.size());
    beside([&](std::uint32_t a, std::uint32_t b) {
        grounds.join(a, b);
        if (std::abs(layers[a].height_m - layers[b].height_m) < kStep_m) plateaus.join(a, b);
    });
    const float cell_m2 = sheet.cell_m() * sheet.cell_m();
    const std::vector<std::uint32_t> cells = grounds.sizes(), level = plateaus.sizes();
    const auto wide_plateau = [&](std::uint32_t i) {
        return static_cast<float>(level[plateaus.root(i)]) * cell_m2 >= kWidePlateau_m2;
    };
    // A bevel or a slot lies by what is higher and wide; what does not is the top of a thing.
    std::vector<bool> beneath(layers.size(), false);
    beside([&](std::uint32_t a, std::uint32_t b) {
        if (layers[b].height_m < layers[a].height_m) std::swap(a, b);
        if (wide_plateau(b)) beneath[plateaus.root(a)] = true;
    });
    const auto is_ground = [&](std::uint32_t i) {
        return static_cast<float>(cells[grounds.root(i)]) * cell_m2 >= kWideGround_m2 &&
               (wide_plateau(i) || beneath[plateaus.root(i)]);
    };
    top_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Sheet::kNoLayer);
    for (int z = 0; z < height_; ++z) {
        for (int x = 0; x < width_; ++x) {
            std::uint32_t& top = top_[index(x, z)];
            float lowest_m = 1.0e9f;
            for (std::uint32_t k = sheet.first(x, z); k != Sheet::kNoLayer; k = layers[k].next)
                if (is_ground(k)) lowest_m = std::min(lowest_m, layers[k].height_m);
            for (std::uint32_t k = sheet.first(x, z); k != Sheet::kNoLayer; k = layers[k].next) {
                // What lies so far over other ground is a roof or an awning.
                if (!is_ground(k) || layers[k].height_m > lowest_m + kHeadroom_m) continue;
                if (top == Sheet::kNoLayer || layers[k].height_m > layers[top].height_m) top = k;
            }
        }
    }
    leave_out_things(is_ground);
    close_joints();
}

OneGround::Smoothed OneGround::smoothed(int x, int z, float depth_m, float own_m, const vec2& place) const
{
    const vec2 off = (place - sheet_->place(x, z)) / sheet_->cell_m();
    const float reach = std::max(kWidth * depth_m / sheet_->cell_m(), 1.5f);
    const int around = static_cast<int>(reach + 0.5f);
    const int stride = reach > 9.0f ? 2 : 1;
    CirclePlane plane;
    float open = 0.0f, opens = 0.0f, all = 0.0f;
    for (int j = -around; j <= around; j += stride) {
        for (int i = -around; i <= around; i += stride) {
            const vec2 way = (vec2(static_cast<float>(i), static_cast<float>(j)) - off) / reach;
            const float in = 1.0f - glm::dot(way, way);
            if (!(in > 0.0f)) continue;
            const float w = in * in;
            all += w;
            const Sheet::Layer* here = at(x + i, z + j);
            if (here == nullptr) continue;
            const float rise = heights_[index(x + i, z + j)] - own_m;
            if (std::abs(rise) > 2.0f * kHighestStep_m) continue;
            plane.add(w, way, rise);
            open += w * here->open;
            opens += w * here->open * here->open;
        }
    }
    if (!(plane.weight() > 0.0f)) return {own_m};
    const CirclePlane::Fit fit = plane.fit();
    return {own_m + fit.rise_m, fit.slope_m / (reach * sheet_->cell_m()), opens / std::max(open, 1.0e-6f), plane.weight() / all};
}

// What is narrower than a few cells and stands over the ground around is a thing on it: the ground goes on below.
void OneGround::leave_out_things(const std::function<bool(std::uint32_t)>& is_ground)
{
    const std::size_t count = top_.size();
    std::vector<float> own(count, 1.0e9f);
    for (std::size_t i = 0; i < count; ++i)
        if (top_[i] != Sheet::kNoLayer) own[i] = sheet_->layers()[top_[i]].height_m;
    // The lowest around, then the highest of those, along rows and columns; where there is no ground nothing counts.
    const auto filtered = [&](const std::vector<float>& from, bool lowest) {
        std::vector<float> rows(count), both(count);
        const auto pass = [&](const std::vector<float>& in, std::vector<float>& out, int dx, int dz) {
            for (int z = 0; z < height_; ++z) {
                for (int x = 0; x < width_; ++x) {
                    float best = 1.0e9f;
                    for (int k = -kThing; k <= kThing; ++k) {
                        if (!inside(x + k * dx, z + k * dz)) continue;
                        const float there = in[index(x + k * dx, z + k * dz)];
                        if (there > 1.0e8f) continue;
                        best = best > 1.0e8f ? there : lowest ? std::min(best, there) : std::max(best, there);
                    }
                    out[index(x, z)] = best;
                }
            }
        };
        pass(from, rows, 1, 0);
        pass(rows, both, 0, 1);
        return both;
    };
    const std::vector<float> opened = filtered(filtered(own, true), false);
    for (int z = 0; z < height_; ++z) {
        for (int x = 0; x < width_; ++x) {
            const std::size_t i = index(x, z);
            if (top_[i] == Sheet::kNoLayer || !(own[i] - opened[i] > kStep_m)) continue;
            for (std::uint32_t k = sheet_->first(x, z); k != Sheet::kNoLayer; k = sheet_->layers()[k].next) {
                const auto off = [&](std::uint32_t layer) { return std::abs(sheet_->layers()[layer].height_m - opened[i]); };
                if (is_ground(k) && off(k) < off(top_[i])) top_[i] = k;
            }
        }
    }
}

void OneGround::close_joints()
{
    heights_.assign(top_.size(), 0.0f);
    std::vector<float> own(top_.size(), -kNoHeight_m);
    for (std::size_t i = 0; i < own.size(); ++i)
        if (top_[i] != Sheet::kNoLayer) own[i] = sheet_->layers()[top_[i]].height_m;
    // The highest around, then the lowest of those, along rows and columns; where there is none nothing counts.
    std::vector<float> rows(own.size());
    const auto pass = [&](const std::vector<float>& in, std::vector<float>& out, int dx, int dz, bool highest) {
        for (int z = 0; z < height_; ++z) {
            for (int x = 0; x < width_; ++x) {
                float best = highest ? -kNoHeight_m : kNoHeight_m;
                for (int k = -kCloses; k <= kCloses; ++k) {
                    if (!inside(x + k * dx, z + k * dz)) continue;
                    const float there = in[index(x + k * dx, z + k * dz)];
                    if (highest || there > -kNoHeight_m) best = highest ? std::max(best, there) : std::min(best, there);
                }
                out[index(x, z)] = best;
            }
        }
    };
    std::vector<float> closed(own.size());
    pass(own, rows, 1, 0, true);
    pass(rows, closed, 0, 1, true);
    pass(closed, rows, 1, 0, false);
    pass(rows, closed, 0, 1, false);
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (top_[i] == Sheet::kNoLayer) continue;
        heights_[i] = closed[i] - own[i] < kHighestStep_m ? std::max(closed[i], own[i]) : own[i];
    }
}

}  // namespace petrichor::scene::detail
