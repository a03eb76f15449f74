#include "scene/basins/hierarchy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace petrichor::scene {

namespace {

struct Neighbours {
    std::array<std::size_t, 8> cell;
    std::size_t count = 0;
    bool at_border = false;
};
Neighbours neighbours_of(const HeightField& field, std::size_t cell)
{
    Neighbours out;
    const std::size_t x = cell % field.width, z = cell / field.width;
    out.at_border = x == 0 || z == 0 || x + 1 == field.width || z + 1 == field.depth;
    const std::size_t z0 = z == 0 ? 0 : z - 1, z1 = std::min(z + 1, field.depth - 1);
    const std::size_t x0 = x == 0 ? 0 : x - 1, x1 = std::min(x + 1, field.width - 1);
    for (std::size_t nz = z0; nz <= z1; ++nz)
        for (std::size_t nx = x0; nx <= x1; ++nx)
            if (nx != x || nz != z) out.cell[out.count++] = field.cell_of(nx, nz);
    return out;
}

bool is_ground(float height)
{
    return std::isfinite(height);
}

// Cells from which water leaves: at the border, beside a void, and drains.
std::vector<std::uint8_t> outlets_of(const HeightField& field, std::span<const std::size_t> drains)
{
    std::vector<std::uint8_t> out(field.cells(), 0);
    for (std::size_t cell = 0; cell < field.cells(); ++cell) {
        if (!is_ground(field.height_m[cell])) continue;
        const Neighbours n = neighbours_of(field, cell);
        bool leads_out = n.at_border;
        for (std::size_t i = 0; i < n.count; ++i)
            leads_out = leads_out || std::isnan(field.height_m[n.cell[i]]);
        out[cell] = static_cast<std::uint8_t>(leads_out);
    }
    for (const std::size_t drain : drains)
        if (drain < field.cells() && is_ground(field.height_m[drain])) out[drain] = 1;
    return out;
}

// The lowest cell at which two labels meet.
struct Saddle {
    float height_m;
    std::size_t cell;
    std::uint32_t a, b;  // a < b
    bool operator<(const Saddle& o) const
    {
        return std::tie(height_m, cell, a, b) < std::tie(o.height_m, o.cell, o.a, o.b);
    }
};

struct Labels {
    std::vector<std::uint32_t> of;
    std::uint32_t pits = 0;
    std::vector<float> pit_m{0.0f};
    std::vector<Saddle> saddles;  // one a pair of labels, sorted
};

// Cells with ground by height, outlets first among equals (a flat that touches one is no pit), then by number.
std::vector<std::uint32_t> cells_by_height(const HeightField& field, const std::vector<std::uint8_t>& leads_out)
{
    struct Keyed {
        std::uint64_t key;
        std::uint32_t cell;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(field.cells());
    for (std::size_t i = 0; i < field.cells(); ++i) {
        if (!is_ground(field.height_m[i])) continue;
        // Bits of floats that count as floats do; + 0 for -0, which equals 0.
        const auto bits = std::bit_cast<std::uint32_t>(field.height_m[i] + 0.0f);
        const std::uint32_t rising = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
        keyed.push_back({std::uint64_t{rising} << 1 | (leads_out[i] != 0 ? 0u : 1u), static_cast<std::uint32_t>(i)});
    }
    // By eleven of the 33 bits at a time, the lowest first; each pass keeps the order of equals.
    constexpr int kBits = 11;
    std::vector<Keyed> sorted(keyed.size());
    for (int pass = 0; pass < 3; ++pass) {
        std::array<std::size_t, 1u << kBits> place{};
        const auto digit = [&](const Keyed& k) {
            return static_cast<std::size_t>(k.key >> (pass * kBits)) & ((1u << kBits) - 1u);
        };
        for (const Keyed& k : keyed) ++place[digit(k)];
        std::size_t begin = 0;
        for (std::size_t& p : place) begin += std::exchange(p, begin);
        for (const Keyed& k : keyed) sorted[place[digit(k)]++] = k;
        keyed.swap(sorted);
    }
    std::vector<std::uint32_t> cells(keyed.size());
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = keyed[i].cell;
    return cells;
}

// Cells that a labelled neighbour has reached, first come first served among those of one height. A cell is reached
// when all lower ones are settled, so it waits at its own height, and who reached it first gives its label.
class Reached {
public:
    explicit Reached(std::size_t cells) : label_(cells, kNoLabel), next_(cells) {}
    bool holds(std::size_t cell) const { return label_[cell] != kNoLabel; }
    std::uint32_t label(std::size_t cell) const { return label_[cell]; }

    /// A list of cells of one height; empty: both ends kNoLabel.
    struct List {
        std::uint32_t first = kNoLabel, last = kNoLabel;
    };
    void add(List& list, std::size_t cell, std::uint32_t label)
    {
        const auto number = static_cast<std::uint32_t>(cell);
        label_[cell] = label;
        next_[cell] = kNoLabel;
        if (list.first == kNoLabel) list.first = number;
        else next_[list.last] = number;
        list.last = number;
    }
    std::size_t take(List& list)
    {
        const std::uint32_t cell = list.first;
        list.first = next_[cell];
        return cell;
    }

private:
    std::vector<std::uint32_t> label_, next_;
};

// Floods from below: a cell that no labelled neighbour has reached when its height comes up is a
// pit. What is reached goes first among equal heights, so that flat ground beside a pit belongs to
// it and makes none of its own.
Labels label_cells(const HeightField& field, std::span<const std::size_t> drains)
{
    Labels out;
    out.of.assign(field.cells(), kNoLabel);
    const std::vector<std::uint8_t> leads_out = outlets_of(field, drains);
    const std::vector<std::uint32_t> rising = cells_by_height(field, leads_out);
    // Of each cell the list of its height.
    std::vector<std::uint32_t> level(field.cells(), 0);
    std::uint32_t levels = 0;
    for (std::size_t i = 0; i < rising.size(); ++i) {
        if (i > 0 && field.height_m[rising[i]] != field.height_m[rising[i - 1]]) ++levels;
        level[rising[i]] = levels;
    }
    std::vector<Reached::List> lists(std::size_t{levels} + 1);
    Reached reached(field.cells());
    std::unordered_map<std::uint64_t, Saddle> saddle_of;
    const auto settle = [&](std::size_t cell, std::uint32_t label) {
        out.of[cell] = label;
        const float height = field.height_m[cell];
        const Neighbours n = neighbours_of(field, cell);
        for (std::size_t i = 0; i < n.count; ++i) {
            const std::size_t next = n.cell[i];
            if (!is_ground(field.height_m[next])) continue;
            const std::uint32_t other = out.of[next];
            if (other == kNoLabel) {
                if (!reached.holds(next)) reached.add(lists[level[next]], next, label);
            } else if (other != label) {
                const std::uint32_t a = std::min(label, other), b = std::max(label, other);
                const Saddle here{std::max(height, field.height_m[next]), std::max(cell, next), a,
                                  b};
                const auto [place, is_new] =
                    saddle_of.try_emplace((static_cast<std::uint64_t>(a) << 32) | b, here);
                if (!is_new && here < place->second) place->second = here;
            }
        }
    };
    for (std::size_t next = 0; next < rising.size();) {
        const std::uint32_t now = level[rising[next]];
        Reached::List& waiting = lists[now];
        for (;;) {
            while (next < rising.size() && out.of[rising[next]] != kNoLabel) ++next;
            const bool any = next < rising.size() && level[rising[next]] == now;
            // Outlets come first of all at their height: flat ground between one and a pit is shared.
            if (any && leads_out[rising[next]]) {
                settle(rising[next], kOutside);
            } else if (waiting.first != kNoLabel) {
                const std::size_t cell = reached.take(waiting);
                if (out.of[cell] == kNoLabel) settle(cell, reached.label(cell));
            } else if (any) {
                out.pit_m.push_back(field.height_m[rising[next]]);
                settle(rising[next], ++out.pits);
            } else {
                break;
            }
        }
    }
    for (const auto& [pair, saddle] : saddle_of) out.saddles.push_back(saddle);
    std::sort(out.saddles.begin(), out.saddles.end());
    return out;
}

// The hollow that a label now belongs to; 0 when that one is open to the outside.
std::uint32_t top_of(std::vector<std::uint32_t>& above, std::uint32_t at)
{
    std::uint32_t top = at;
    while (above[top] != top) top = above[top];
    while (above[at] != top) {
        const std::uint32_t next = above[at];
        above[at] = top;
        at = next;
    }
    return top;
}

void make_forest(Basins& basins, const Labels& labels)
{
    basins.pits = labels.pits;
    basins.hollow.assign(labels.pits + 1, {});
    for (std::uint32_t i = 1; i <= labels.pits; ++i) {
        basins.hollow[i].pit_m = labels.pit_m[i];
        basins.hollow[i].spill_m = std::numeric_limits<float>::infinity();
    }
    std::vector<std::uint32_t> above(labels.pits + 1);
    std::iota(above.begin(), above.end(), 0u);
    for (const Saddle& s : labels.saddles) {
        const std::uint32_t a = top_of(above, s.a), b = top_of(above, s.b);
        if (a == b) continue;
        if (a == kOutside || b == kOutside) {
            // The other side already leads out: this tree spills over to it.
            const bool a_stays = b == kOutside;
            Hollow& root = basins.hollow[a_stays ? a : b];
            root.spill_m = s.height_m;
            root.spills_to = a_stays ? s.b : s.a;
            above[a_stays ? a : b] = kOutside;
            continue;
        }
        const auto parent = static_cast<std::uint32_t>(basins.hollow.size());
        Hollow made;
        made.child[0] = a;
        made.child[1] = b;
        made.pit_m = std::min(basins.hollow[a].pit_m, basins.hollow[b].pit_m);
        made.spill_m = std::numeric_limits<float>::infinity();
        basins.hollow[a].parent = basins.hollow[b].parent = parent;
        basins.hollow[a].spill_m = basins.hollow[b].spill_m = s.height_m;
        basins.hollow[a].spills_to = s.b;
        basins.hollow[b].spills_to = s.a;
        basins.hollow.push_back(made);
        above.push_back(parent);
        above[a] = above[b] = parent;
    }
}

// Ground that nothing connects to the outside (walled in on all sides) fills to the brim of its
// highest cell; what comes then leaves.
void close_walled_in(Basins& basins, const HeightField& field)
{
    std::vector<float> highest(basins.hollow.size(), -std::numeric_limits<float>::infinity());
    for (std::size_t cell = 0; cell < field.cells(); ++cell) {
        const std::uint32_t label = basins.label[cell];
        if (label == kNoLabel || label == kOutside) continue;
        highest[label] = std::max(highest[label], field.height_m[cell]);
    }
    for (std::uint32_t i = 1; i < basins.hollow.size(); ++i) {
        Hollow& h = basins.hollow[i];
        if (h.parent != 0) highest[h.parent] = std::max(highest[h.parent], highest[i]);
        if (h.parent == 0 && !std::isfinite(h.spill_m)) h.spill_m = highest[i];
    }
}

void measure(Basins& basins, const HeightField& field)
{
    basins.pit_cells.assign(basins.pits + 1, 0.0);
    // The hollow that drowns a cell: the first above its pit that spills higher than it lies.
    std::vector<std::uint32_t> drowns(field.cells(), 0);
    for (std::size_t cell = 0; cell < field.cells(); ++cell) {
        const std::uint32_t label = basins.label[cell];
        if (label == kNoLabel) continue;
        basins.pit_cells[label] += 1.0;
        std::uint32_t at = label;
        while (at != 0 && !(field.height_m[cell] < basins.hollow[at].spill_m))
            at = basins.hollow[at].parent;
        drowns[cell] = at;
        if (at != 0) ++basins.hollow[at].band_end;  // a count, for now
    }
    std::size_t begin = 0;
    for (Hollow& h : basins.hollow) {
        const std::size_t count = h.band_end;
        h.band_begin = h.band_end = begin;
        begin += count;
    }
    basins.band_m.resize(begin);
    for (std::size_t cell = 0; cell < field.cells(); ++cell)
        if (drowns[cell] != 0)
            basins.band_m[basins.hollow[drowns[cell]].band_end++] = field.height_m[cell];
    for (std::uint32_t i = 1; i < basins.hollow.size(); ++i) {
        Hollow& h = basins.hollow[i];
        std::sort(basins.band_m.begin() + static_cast<std::ptrdiff_t>(h.band_begin),
                  basins.band_m.begin() + static_cast<std::ptrdiff_t>(h.band_end));
        for (const std::uint32_t c : h.child) {
            if (c == 0) continue;
            const Hollow& child = basins.hollow[c];
            double sum = child.lower_sum_m;
            for (std::size_t k = child.band_begin; k < child.band_end; ++k)
                sum += static_cast<double>(basins.band_m[k]) - static_cast<double>(child.pit_m);
            const double cells =
                child.lower_cells + static_cast<double>(child.band_end - child.band_begin);
            h.lower_cells += cells;
            h.lower_sum_m +=
                sum + cells * (static_cast<double>(child.pit_m) - static_cast<double>(h.pit_m));
        }
        h.capacity_m3 = volume_at_m3(basins, i, static_cast<double>(h.spill_m));
    }
}

}  // namespace

Basins find_basins(const HeightField& field, std::span<const std::size_t> drains)
{
    Basins basins;
    basins.width = field.width;
    basins.depth = field.depth;
    basins.cell_area_m2 = field.cell_m * field.cell_m;
    basins.hollow.resize(1);
    basins.pit_cells.assign(1, 0.0);
    if (field.empty()) return basins;
    Labels labels = label_cells(field, drains);
    make_forest(basins, labels);
    basins.label = std::move(labels.of);
    close_walled_in(basins, field);
    measure(basins, field);
    return basins;
}

std::vector<float> filled_heights(const HeightField& field, std::span<const std::size_t> drains)
{
    std::vector<float> filled = field.height_m;
    if (field.empty()) return filled;
    struct Cell {
        float height_m;
        std::size_t cell;
        bool operator<(const Cell& o) const
        {
            return std::tie(height_m, cell) > std::tie(o.height_m, o.cell);
        }
    };
    const std::vector<std::uint8_t> leads_out = outlets_of(field, drains);
    std::vector<std::uint8_t> done(field.cells(), 0);
    std::priority_queue<Cell> rising;
    for (std::size_t cell = 0; cell < field.cells(); ++cell) {
        if (!leads_out[cell]) continue;
        rising.push({filled[cell], cell});
        done[cell] = 1;
    }
    while (!rising.empty()) {
        const Cell lowest = rising.top();
        rising.pop();
        const Neighbours n = neighbours_of(field, lowest.cell);
        for (std::size_t i = 0; i < n.count; ++i) {
            const std::size_t next = n.cell[i];
            if (done[next] || !is_ground(field.height_m[next])) continue;
            done[next] = 1;
            filled[next] = std::max(field.height_m[next], lowest.height_m);
            rising.push({filled[next], next});
        }
    }
    return filled;
}

double wet_area_m2(const Basins& basins, std::uint32_t hollow, double level_m)
{
    const Hollow& h = basins.hollow[hollow];
    const auto begin = basins.band_m.begin() + static_cast<std::ptrdiff_t>(h.band_begin);
    const auto end = basins.band_m.begin() + static_cast<std::ptrdiff_t>(h.band_end);
    const auto below = std::partition_point(
        begin, end, [&](float height) { return static_cast<double>(height) < level_m; });
    return (h.lower_cells + static_cast<double>(below - begin)) * basins.cell_area_m2;
}

double volume_at_m3(const Basins& basins, std::uint32_t hollow, double level_m)
{
    const Hollow& h = basins.hollow[hollow];
    const double pit = static_cast<double>(h.pit_m);
    const double level = level_m - pit;
    double cells = h.lower_cells, sum = h.lower_sum_m;
    for (std::size_t i = h.band_begin; i < h.band_end; ++i) {
        const double height = static_cast<double>(basins.band_m[i]) - pit;
        if (height >= level) break;
        cells += 1.0;
        sum += height;
    }
    return std::max(0.0, cells * level - sum) * basins.cell_area_m2;
}

double level_at_m(const Basins& basins, std::uint32_t hollow, double volume_m3)
{
    const Hollow& h = basins.hollow[hollow];
    const double pit = static_cast<double>(h.pit_m);
    if (volume_m3 >= h.capacity_m3) return static_cast<double>(h.spill_m);
    const double volume = std::max(volume_m3, 0.0) / basins.cell_area_m2;
    double cells = h.lower_cells, sum = h.lower_sum_m;
    for (std::size_t i = h.band_begin; i < h.band_end; ++i) {
        const double height = static_cast<double>(basins.band_m[i]) - pit;
        if (cells > 0.0 && volume + sum <= cells * height) break;
        cells += 1.0;
        sum += height;
    }
    if (!(cells > 0.0)) return pit;
    return std::min(pit + (volume + sum) / cells, static_cast<double>(h.spill_m));
}

}  // namespace petrichor::scene
