#include "weather/patches/detail/patch_tables.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "weather/patches/detail/patch_snow.h"
#include "weather/patches/driving_rain.h"
#include "weather/patches/moving_snow.h"

namespace petrichor::weather::detail {

CellState cell_in(const CellBlock& block, std::size_t lane)
{
    double numbers[kCellNumbers];
    for (std::size_t i = 0; i < kCellNumbers; ++i) numbers[i] = block.numbers[i][lane];
    CellState cell;
    std::memcpy(&cell, numbers, sizeof cell);
    return cell;
}

void put_cell(CellBlock& block, std::size_t lane, const CellState& cell)
{
    double numbers[kCellNumbers];
    std::memcpy(numbers, &cell, sizeof cell);
    for (std::size_t i = 0; i < kCellNumbers; ++i) block.numbers[i][lane] = numbers[i];
}

namespace {

PatchSlot slot_of(const WeatherPatch& patch, const PatchKind& kind)
{
    PatchSlot s{};
    s.normal = patch.normal;
    s.visible = patch.visible;
    s.blocked = wind_blocking(patch.visible);
    const SkyShares shares = sky_shares(patch.visible, patch.normal);
    s.sky_share = patch.sky_share < 0.0 ? shares.sky : patch.sky_share;
    s.patch_share = std::min(patch.patch_share, 1.0 - s.sky_share);
    s.out_share = std::max(0.0, 1.0 - s.sky_share - s.patch_share);
    s.horizon = shares.horizon;
    s.zenith = shares.zenith;
    s.log_secant = shares.log_secant;
    const double up = std::clamp(patch.normal.y, -1.0, 1.0);
    s.sine_tilt = std::sqrt(1.0 - up * up);
    s.snow_holds = kind.holds_by_tilt ? snow_holds(arc_cosine(up)) : 1.0;
    s.slide_pull = 0.0;
    if (up > 0.0 && kind.slides_above_deg < 90.0)
        s.slide_pull = slide_pull(arc_cosine(up) * 180.0 / kPi, kind.slides_above_deg);
    s.wall_factor = patch.wall_factor;
    return s;
}

// The kind that most of the flat ground is made of.
std::uint32_t ground_kind(const PatchSet& set)
{
    std::vector<double> area(set.kinds.size(), 0.0);
    for (const WeatherPatch& p : set.patches)
        if (p.normal.y > 0.9 && !set.kinds[p.kind].like_air) area[p.kind] += p.area_m2;
    return static_cast<std::uint32_t>(std::max_element(area.begin(), area.end()) - area.begin());
}

// Every patch after those that run to it. Where ways make a circle it is cut at the patch that
// comes first by height and number: that one runs out.
std::vector<std::uint32_t> order_downhill(PatchSet& set)
{
    const std::size_t count = set.patches.size();
    std::vector<std::uint32_t> waiting_for(count, 0), order, by_height(count);
    for (const WeatherPatch& p : set.patches)
        if (p.runs_to < count) ++waiting_for[p.runs_to];
    std::iota(by_height.begin(), by_height.end(), 0u);
    std::stable_sort(by_height.begin(), by_height.end(), [&](std::uint32_t a, std::uint32_t b) {
        return set.patches[a].height_m > set.patches[b].height_m;
    });
    std::vector<std::uint8_t> done(count, 0);
    order.reserve(count);
    const auto follow = [&](std::uint32_t at) {
        while (at < count && !done[at] && waiting_for[at] == 0) {
            done[at] = 1;
            order.push_back(at);
            const std::uint32_t next = set.patches[at].runs_to;
            if (next >= count) return;
            --waiting_for[next];
            at = next;
        }
    };
    for (const std::uint32_t patch : by_height) follow(patch);
    for (const std::uint32_t patch : by_height) {
        if (done[patch]) continue;
        // Part of a circle: what runs to it from within is let out.
        std::uint32_t before = patch;
        while (set.patches[before].runs_to != patch) before = set.patches[before].runs_to;
        set.patches[before].runs_to = kRunsOut;
        --waiting_for[patch];
        follow(patch);
    }
    return order;
}

}  // namespace

PatchTables make_patch_tables(PatchSet set, const PatchParams& params, const Site& site,
                              double deep_temp_k)
{
    PatchTables t;
    WeatherPatch twin;
    twin.kind = ground_kind(set);
    twin.area_m2 = 0.0;
    twin.visible = open_sky(twin.normal);
    twin.sky_share = 1.0;
    t.twin = static_cast<std::uint32_t>(set.patches.size());
    set.patches.push_back(twin);
    if (!set.upwind.empty()) set.upwind.emplace_back();
    set.link_begin.resize(set.patches.size(), set.link_begin.empty() ? 0u : set.link_begin.back());
    set.link_begin.push_back(set.link_begin.back());

    t.downhill = order_downhill(set);
    t.downhill.erase(std::remove(t.downhill.begin(), t.downhill.end(), t.twin), t.downhill.end());
    const std::size_t count = set.patches.size();
    t.slot_of_patch.resize(count);
    for (std::uint32_t k = 0; k < set.kinds.size(); ++k) {
        std::vector<std::uint32_t> members;
        for (std::uint32_t i = 0; i < count; ++i)
            if (set.patches[i].kind == k) members.push_back(i);
        if (members.empty()) continue;
        PhysicalParams model = params.model;
        const bool room = set.kinds[k].room_behind;
        model.surface = set.kinds[k].surface;
        if (room) model.surface.open_below = false;
        model.sky_view = 1.0;
        model.canopy_vai = 0.0;
        check_params(model);
        PatchGroup group;
        group.kind = k;
        group.constants = make_cell_constants(model, site, room ? params.room_temp_k : deep_temp_k);
        if (room) group.constants.back_resistance = behind_wall_m2_k_w(group.constants);
        const std::size_t blocks = (members.size() + kPatchLanes - 1) / kPatchLanes;
        for (std::size_t lane = 0; lane < blocks * kPatchLanes; ++lane) {
            // Spare lanes repeat the last patch.
            const std::uint32_t patch = members[std::min(lane, members.size() - 1)];
            if (lane < members.size())
                t.slot_of_patch[patch] = static_cast<std::uint32_t>(t.patch_of_slot.size());
            t.patch_of_slot.push_back(patch);
            t.slot.push_back(slot_of(set.patches[patch], set.kinds[k]));
        }
        t.group_of_block.insert(t.group_of_block.end(), blocks,
                                static_cast<std::uint32_t>(t.groups.size()));
        t.groups.push_back(std::move(group));
    }
    t.link_begin.push_back(0);
    for (const std::uint32_t patch : t.patch_of_slot) {
        for (std::uint32_t k = set.link_begin[patch]; k < set.link_begin[patch + 1]; ++k)
            t.links.push_back(t.slot_of_patch[set.links[k]]);
        t.link_begin.push_back(static_cast<std::uint32_t>(t.links.size()));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const WeatherPatch& p = set.patches[i];
        if (p.foot != kNoPatch) t.splashed.push_back(i);
    }
    for (const std::uint32_t i : t.downhill)
        if (t.slot[t.slot_of_patch[i]].slide_pull > 0.0) t.shedding.push_back(i);
    t.slide_patience = slide_patience(t, set);
    t.set = std::move(set);
    return t;
}

}  // namespace petrichor::weather::detail
