#include "scene/snow/detail/cap_parts.h"

#include <array>
#include <cstddef>
#include <utility>

namespace petrichor::scene::detail {

namespace {

// Where nothing is kept of a triangle's depth, it is left out.
bool lies(const SnowCaps& caps, const std::array<std::uint32_t, 3>& t)
{
    return caps.points[t[0]].share > 0.02f || caps.points[t[1]].share > 0.02f ||
           caps.points[t[2]].share > 0.02f;
}

}  // namespace

void add_parts(SnowCaps& caps, CutMesh& mesh, Ground& ground, const std::vector<std::vector<std::uint32_t>>& first_cut)
{
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        Primitive& p = mesh.primitives[i];
        SnowCaps::Part part;
        part.material = p.material;
        part.instance = ground.instances[i];
        part.primitive = ground.numbers[i];
        part.first_index = static_cast<std::uint32_t>(caps.indices.size());
        part.first_corner = static_cast<std::uint32_t>(caps.corner_points.size());
        std::vector<std::uint32_t> origins;
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const std::array<std::uint32_t, 3> t{mesh.points[i][p.indices[k]],
                                                 mesh.points[i][p.indices[k + 1]],
                                                 mesh.points[i][p.indices[k + 2]]};
            const std::uint32_t origin = first_cut[i][mesh.origins[i][k / 3]];
            if (!lies(caps, t)) {
                ground.below[i][origin] = SnowCaps::kUncovered;
                continue;
            }
            origins.push_back(origin);
            for (std::size_t c = 0; c < 3; ++c)
                caps.indices.push_back(part.first_corner + p.indices[k + c]);
        }
        for (const std::uint32_t origin : origins) part.below.push_back(ground.below[i][origin]);
        part.index_count = static_cast<std::uint32_t>(caps.indices.size()) - part.first_index;
        if (part.index_count == 0) continue;
        caps.corner_points.insert(caps.corner_points.end(), mesh.points[i].begin(), mesh.points[i].end());
        p.indices.clear();
        part.source = std::move(p);
        caps.parts.push_back(std::move(part));
    }
}

void add_banks(SnowCaps& caps, const CutMesh& mesh, const Ground& ground, std::vector<BankPart>& banks)
{
    for (BankPart& bank : banks) {
        SnowCaps::Part part;
        part.material = mesh.primitives[bank.primitive].material;
        part.instance = ground.instances[bank.primitive];
        part.primitive = ground.numbers[bank.primitive];
        part.first_index = static_cast<std::uint32_t>(caps.indices.size());
        part.first_corner = static_cast<std::uint32_t>(caps.corner_points.size());
        part.index_count = static_cast<std::uint32_t>(bank.source.indices.size());
        part.below.assign(bank.source.indices.size() / 3, SnowCaps::kUncovered);
        for (const std::uint32_t corner : bank.source.indices) caps.indices.push_back(part.first_corner + corner);
        caps.corner_points.insert(caps.corner_points.end(), bank.points.begin(), bank.points.end());
        bank.source.indices.clear();
        bank.source.material = part.material;
        part.source = std::move(bank.source);
        caps.parts.push_back(std::move(part));
    }
}

void leave_out_unused(SnowCaps& caps)
{
    std::vector<std::uint8_t> used(caps.corner_points.size(), 0);
    for (const std::uint32_t corner : caps.indices) used[corner] = 1;
    std::vector<std::uint32_t> corners(used.size(), SnowCaps::kNone), corner_points;
    std::vector<std::uint8_t> asked(caps.points.size(), 0);
    for (SnowCaps::Part& part : caps.parts) {
        const std::uint32_t first = part.first_corner, count = static_cast<std::uint32_t>(part.source.positions.size());
        part.first_corner = static_cast<std::uint32_t>(corner_points.size());
        for (std::uint32_t i = first; i < first + count; ++i) {
            if (used[i] == 0) continue;
            corners[i] = static_cast<std::uint32_t>(corner_points.size());
            corner_points.push_back(caps.corner_points[i]);
            asked[caps.corner_points[i]] = 1;
        }
        const auto keep = [&](auto& list) {
            std::size_t to = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                if (used[first + i] != 0) list[to++] = list[i];
            list.resize(to);
        };
        Primitive& p = part.source;
        keep(p.positions);
        keep(p.normals);
        keep(p.tangents);
        keep(p.uv0);
        keep(p.uv1);
        keep(p.colors);
        keep(p.weather);
    }
    for (std::uint32_t& corner : caps.indices) corner = corners[corner];
    std::vector<std::uint32_t> numbers(caps.points.size(), SnowCaps::kNone);
    for (const std::uint32_t i : corner_points) {
        for (const std::uint32_t other : {caps.points[i].beyond, caps.points[i].below})
            if (other != SnowCaps::kNone) asked[other] = 1;
    }
    std::uint32_t left = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (asked[i] == 0) continue;
        numbers[i] = left;
        caps.points[left++] = caps.points[i];
    }
    caps.points.resize(left);
    for (SnowCaps::Point& point : caps.points) {
        for (std::uint32_t* other : {&point.beyond, &point.below})
            if (*other != SnowCaps::kNone) *other = numbers[*other];
    }
    for (std::uint32_t& i : corner_points) i = numbers[i];
    caps.corner_points = std::move(corner_points);
}

}  // namespace petrichor::scene::detail
