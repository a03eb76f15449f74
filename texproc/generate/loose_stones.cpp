#include "texproc/generate/detail/loose_stones.h"

#include "base/portable_math.h"

namespace petrichor::texproc::detail {

StoneLayer::StoneLayer(const MaterialSurface& surface, const LooseStones& rule)
    : rule_(rule), cells_(surface.cells(rule.size_m)), tile_m_(surface.tile_m)
{
    cell_m_ = tile_m_ / static_cast<float>(cells_);
    for (int k = 0; k < kSides; ++k) {
        const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(kSides);
        normals_[static_cast<std::size_t>(k)] = {portable_cos(angle), portable_sin(angle)};
    }
    if (cell_m_ < 3.0f * surface.texel_m()) return;  // too fine to be seen, and too many
    const std::uint32_t seed = hash_u32(surface.seed + 977u * rule.salt + 13u);
    stones_.reserve(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
    for (int j = 0; j < cells_; ++j) {
        for (int i = 0; i < cells_; ++i) {
            const std::uint32_t h = hash_cell(i, j, seed);
            Stone s{};
            s.id = h;
            s.there = hash_unit(h, 1) < rule.share;
            s.x = (static_cast<float>(i) + 0.5f + 0.4f * hash_signed(h, 2)) * cell_m_;
            s.y = (static_cast<float>(j) + 0.5f + 0.4f * hash_signed(h, 3)) * cell_m_;
            const float chance = hash_unit(h, 4);
            s.radius = cell_m_ * (0.38f + 0.34f * chance * chance);
            s.level = rule.spread_m * hash_signed(h, 5) - rule.sunk_m;
            const float turn = 6.2831853f * hash_unit(h, 6);
            s.cosine = portable_cos(turn);
            s.sine = portable_sin(turn);
            s.stretch = 1.0f / mix(0.62f, 1.0f, hash_unit(h, 7));
            const float lean = mix(0.55f, 0.22f, rule.roundness);
            s.tilt_x = lean * hash_signed(h, 8);
            s.tilt_y = lean * hash_signed(h, 9);
            for (int k = 0; k < kSides; ++k)
                s.side[static_cast<std::size_t>(k)] = 0.68f + 0.30f * hash_unit(h, 20u + static_cast<std::uint32_t>(k));
            stones_.push_back(s);
        }
    }
}

StoneAt StoneLayer::at(float x_m, float y_m) const
{
    StoneAt best;
    if (stones_.empty()) return best;
    const int cx = static_cast<int>(std::floor(x_m / cell_m_));
    const int cy = static_cast<int>(std::floor(y_m / cell_m_));
    for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
            const int i = cx + di, j = cy + dj;
            const int wi = wrap_index(i, cells_), wj = wrap_index(j, cells_);
            const Stone& s = stones_[static_cast<std::size_t>(wj) * static_cast<std::size_t>(cells_) +
                                     static_cast<std::size_t>(wi)];
            if (!s.there) continue;
            const float px = x_m - s.x - static_cast<float>(i - wi) * cell_m_;
            const float py = y_m - s.y - static_cast<float>(j - wj) * cell_m_;
            const float u = (s.cosine * px + s.sine * py) / s.radius;
            const float v = (s.cosine * py - s.sine * px) * s.stretch / s.radius;
            const float r2 = u * u + v * v;
            if (r2 >= 1.0f) continue;
            float planes = 1.0f;
            for (int k = 0; k < kSides; ++k) {
                const auto n = static_cast<std::size_t>(k);
                planes = std::min(planes, s.side[n] - (u * normals_[n].x + v * normals_[n].y));
            }
            const float rolled = 0.5f * (1.0f - r2);
            const float d = mix(planes, rolled, rule_.roundness);
            if (d <= 0.0f) continue;
            // Broken faces fall steeply from a flat, leaning top; rolled ones are domes.
            const float broken = std::min(1.9f * d, 0.62f + 0.28f * d + s.tilt_x * u + s.tilt_y * v);
            const float t = std::min(2.0f * d, 1.0f);
            const float dome = std::sqrt(t * (2.0f - t)) + 0.25f * (s.tilt_x * u + s.tilt_y * v);
            const float rise = mix(std::max(broken, 0.0f), dome, rule_.roundness);
            const float height = s.level + s.radius * rule_.flatness * rise;
            if (height <= best.height_m) continue;
            best.height_m = height;
            best.inside = t;
            best.id = s.id;
        }
    }
    return best;
}

}  // namespace petrichor::texproc::detail
