#include "scene/basins/water.h"

#include <algorithm>

namespace petrichor::scene {

namespace {

bool is_pit(const Hollow& h)
{
    return h.child[0] == 0;
}

class Pouring {
public:
    Pouring(const Basins& basins, BasinWater& water) : hollow_(basins.hollow), v_(water.volume_m3)
    {
    }
    // Returns what left the scene.
    double pour(std::uint32_t pit, double amount_m3)
    {
        std::uint32_t at = pit;
        while (amount_m3 > 0.0) {
            if (at == kOutside) return amount_m3;
            while (merged(hollow_[at].parent)) at = hollow_[at].parent;
            const double room = hollow_[at].capacity_m3 - v_[at];
            if (amount_m3 < room) {
                v_[at] += amount_m3;
                return 0.0;
            }
            amount_m3 -= std::max(room, 0.0);
            v_[at] = hollow_[at].capacity_m3;
            std::uint32_t parent = hollow_[at].parent;
            if (parent == 0 || !both_full(parent)) {
                at = hollow_[at].spills_to;
                continue;
            }
            // The two are one water from here on. A parent that spills as low as they do is full
            // at once, and may complete the next pair.
            for (; parent != 0 && both_full(parent); parent = hollow_[parent].parent)
                v_[parent] = v_[hollow_[parent].child[0]] + v_[hollow_[parent].child[1]];
        }
        return 0.0;
    }

private:
    const std::vector<Hollow>& hollow_;
    std::vector<double>& v_;

    bool full(std::uint32_t i) const { return v_[i] >= hollow_[i].capacity_m3; }
    bool both_full(std::uint32_t parent) const
    {
        return full(hollow_[parent].child[0]) && full(hollow_[parent].child[1]);
    }
    bool merged(std::uint32_t i) const { return i != 0 && both_full(i); }
};

class Levels {
public:
    Levels(const Basins& basins, const BasinWater& water) : basins_(basins), v_(water.volume_m3) {}
    bool merged(std::uint32_t i) const
    {
        const Hollow& h = basins_.hollow[i];
        return !is_pit(h) && full(h.child[0]) && full(h.child[1]);
    }
    // Whether a hollow is the uppermost of one water (or of none).
    bool is_top(std::uint32_t i) const
    {
        const Hollow& h = basins_.hollow[i];
        if (!is_pit(h) && !merged(i)) return false;
        return h.parent == 0 || !merged(h.parent);
    }
    bool full(std::uint32_t i) const { return v_[i] >= basins_.hollow[i].capacity_m3; }

private:
    const Basins& basins_;
    const std::vector<double>& v_;
};

// Sets the water below a hollow to one level, parting it where saddles come to light.
void set_level(const Basins& basins, std::vector<double>& v, std::uint32_t i, double level_m)
{
    const Hollow& h = basins.hollow[i];
    const double saddle = is_pit(h) ? static_cast<double>(h.pit_m)
                                    : static_cast<double>(basins.hollow[h.child[0]].spill_m);
    if (level_m >= saddle || is_pit(h)) {
        v[i] = level_m > saddle || !is_pit(h) ? volume_at_m3(basins, i, level_m) : 0.0;
        return;
    }
    bool both_full = true;
    for (const std::uint32_t c : h.child) {
        set_level(basins, v, c, level_m);
        both_full = both_full && v[c] >= basins.hollow[c].capacity_m3;
    }
    // A level a rounding below the saddle still is one water.
    v[i] = both_full ? v[h.child[0]] + v[h.child[1]] : 0.0;
}

}  // namespace

double pour(const Basins& basins, BasinWater& water, std::span<const double> into_pit_m3)
{
    double left = into_pit_m3.empty() ? 0.0 : into_pit_m3[kOutside];
    Pouring pouring(basins, water);
    for (std::uint32_t pit = 1; pit <= basins.pits && pit < into_pit_m3.size(); ++pit)
        left += pouring.pour(pit, into_pit_m3[pit]);
    return left;
}

double evaporate(const Basins& basins, BasinWater& water, std::span<const double> loss_m)
{
    const std::size_t count = basins.hollow.size();
    // Of each hollow: cells of its pits, and what they lose together.
    std::vector<double> cells(count, 0.0), sum(count, 0.0);
    for (std::uint32_t i = 1; i < count; ++i) {
        const Hollow& h = basins.hollow[i];
        if (is_pit(h)) {
            cells[i] = basins.pit_cells[i];
            sum[i] = i < loss_m.size() ? loss_m[i] * cells[i] : 0.0;
        }
        if (h.parent != 0) {
            cells[h.parent] += cells[i];
            sum[h.parent] += sum[i];
        }
    }
    const double before = stored_m3(basins, water);
    const Levels levels(basins, water);
    std::vector<std::uint32_t> tops;
    for (std::uint32_t i = 1; i < count; ++i)
        if (levels.is_top(i) && water.volume_m3[i] > 0.0) tops.push_back(i);
    for (const std::uint32_t i : tops) {
        const double loss = sum[i] / cells[i];
        if (!(loss > 0.0)) continue;
        const double level = level_at_m(basins, i, water.volume_m3[i]);
        set_level(basins, water.volume_m3, i, level - loss);
    }
    return before - stored_m3(basins, water);
}

double stored_m3(const Basins& basins, const BasinWater& water)
{
    const Levels levels(basins, water);
    double sum = 0.0;
    for (std::uint32_t i = 1; i < basins.hollow.size(); ++i)
        if (levels.is_top(i)) sum += water.volume_m3[i];
    return sum;
}

std::vector<WaterShape> water_shapes(const Basins& basins, const BasinWater& water)
{
    const Levels levels(basins, water);
    const std::size_t count = basins.hollow.size();
    std::vector<double> cells(count, 0.0);
    for (std::uint32_t i = 1; i < count; ++i) {
        if (is_pit(basins.hollow[i])) cells[i] = basins.pit_cells[i];
        if (basins.hollow[i].parent != 0) cells[basins.hollow[i].parent] += cells[i];
    }
    // Of a water as a whole, then of its pits: parents come after their children.
    std::vector<WaterShape> whole(count);
    std::vector<double> per_cell(count, 0.0);
    for (std::uint32_t i = static_cast<std::uint32_t>(count); i-- > 1;) {
        const std::uint32_t parent = basins.hollow[i].parent;
        if (parent != 0 && levels.merged(parent)) {
            whole[i] = whole[parent];
            per_cell[i] = per_cell[parent];
        } else if (levels.is_top(i) && water.volume_m3[i] > 0.0) {
            const double area =
                wet_area_m2(basins, i, level_at_m(basins, i, water.volume_m3[i]));
            if (!(area > 0.0)) continue;
            whole[i] = {water.volume_m3[i] / area, area};
            per_cell[i] = area / cells[i];
        }
    }
    std::vector<WaterShape> shapes(basins.pits + 1);
    for (std::uint32_t i = 1; i <= basins.pits; ++i)
        shapes[i] = {whole[i].depth_m, per_cell[i] * cells[i]};
    return shapes;
}

std::vector<float> levels_m(const Basins& basins, const BasinWater& water)
{
    const Levels levels(basins, water);
    std::vector<float> out(basins.hollow.size(), 0.0f);
    // Parents come after their children: from above, a merged parent's level holds for both.
    for (std::uint32_t i = static_cast<std::uint32_t>(basins.hollow.size()); i-- > 1;) {
        const std::uint32_t parent = basins.hollow[i].parent;
        if (parent != 0 && levels.merged(parent))
            out[i] = out[parent];
        else
            out[i] = static_cast<float>(level_at_m(basins, i, water.volume_m3[i]));
    }
    out.resize(basins.pits + 1);
    return out;
}

std::vector<float> drawn_levels_m(const Basins& basins, const BasinWater& water)
{
    std::vector<float> levels = levels_m(basins, water);
    for (std::uint32_t pit = 1; pit < levels.size(); ++pit) {
        if (!(levels[pit] > static_cast<float>(basins.hollow[pit].pit_m))) levels[pit] = kDry_m;
    }
    return levels;
}

}  // namespace petrichor::scene
