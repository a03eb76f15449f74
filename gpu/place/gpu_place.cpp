#include "gpu/place/gpu_place.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "formulas/weather/falls_here.h"
#include "gpu/frame/place_falls_io.h"
#include "gpu/place/place_parts.h"

namespace petrichor::gpu {
namespace {

std::unique_ptr<GpuBuffer> texel_buffer(MemoryArena& arena, const char* name, std::size_t bytes,
                                        VkFormat format)
{
    return arena.buffer({.name = name,
                         .size = bytes,
                         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         .texel_format = format,
                         .host = true});
}

// Behind `first` bytes; what is left of the buffer is 0.
template <class T>
void fill(GpuBuffer& buffer, const std::vector<T>& values, std::size_t first = 0)
{
    std::memset(buffer.mapped + first, 0, buffer.size - first);
    const std::size_t bytes = std::min<std::size_t>(buffer.size - first, values.size() * sizeof(T));
    if (bytes > 0) std::memcpy(buffer.mapped + first, values.data(), bytes);
}

// Where the states begin, behind the texels by which patches are found.
std::size_t before_states(const shared::PlaceConstants& constants)
{
    return std::size_t{constants.grid.patches} * shared::kPlaceTexels * sizeof(glm::vec4);
}

void check(const PlaceWeather& place)
{
    const PlaceShape& s = *place.shape;
    const bool whole = s.table.size() > s.grid.table_mask;
    const std::vector<PlaceParts> parts = whole ? parts_of(s.table, s.grid) : std::vector<PlaceParts>{};
    const std::size_t states = std::size_t{s.grid.patches} + count_of_parts(parts);
    const bool fit = std::all_of(parts.begin(), parts.end(), [&](const PlaceParts& p) {
        return p.patch < s.grid.patches && p.count <= kMostParts &&
               std::all_of(p.of_cell.begin(), p.of_cell.end(), [&](std::uint8_t part) { return part < p.count; });
    });
    const bool tables = whole && fit && place.states.size() == states * PLACE_STATE_TEXELS &&
                        (place.open.empty() || place.open.size() == PLACE_STATE_TEXELS);
    const bool hollows =
        s.labels.size() == std::size_t{s.basin_width} * s.basin_depth && !place.levels_m.empty() &&
        std::all_of(s.labels.begin(), s.labels.end(),
                    [&](std::uint32_t l) { return l < place.levels_m.size() || l == 0xffffffffu; });
    if (tables && hollows) return;
    throw Error("render: the weather of the patches does not belong to the patches",
                "Give as many states as there are patches, and a level for every hollow.");
}

// One number for all of them: the lighting does not know of what patch a pixel is.
float glazed_share(const std::vector<glm::vec4>& states)
{
    double ice = 0.0, all = 0.0;
    for (std::size_t i = 0; i < states.size(); i += PLACE_STATE_TEXELS) {
        const float glaze = shared::wetness_of_film(states[i + 3].z);
        ice += static_cast<double>(glaze);
        all += static_cast<double>(std::max(states[i].x, glaze));
    }
    return all > 0.0 ? static_cast<float>(ice / all) : 0.0f;
}

std::vector<std::uint32_t> materials_of(const PlaceWeather& place)
{
    std::vector<std::uint32_t> materials;
    materials.reserve(place.states.size() / PLACE_STATE_TEXELS);
    for (std::size_t i = 3; i < place.states.size(); i += PLACE_STATE_TEXELS)
        materials.push_back(static_cast<std::uint32_t>(place.states[i].w));
    return materials;
}

}  // namespace

GpuPlace::GpuPlace(const Device& device)
{
    make(device, {}, 1, place_tree({}, {}, {}));
}

void GpuPlace::make(const Device& device, const PlaceShape& shape, std::size_t levels, const PlaceTree& tree)
{
    const std::size_t places = tree.grid.patches;  // patches and parts
    table_.reset();
    states_.reset();
    labels_.reset();
    levels_.reset();
    arena_ = std::make_unique<MemoryArena>(device);
    const auto at_least = [](std::size_t count) { return std::max<std::size_t>(count, 1); };
    table_ = texel_buffer(*arena_, "place_table", tree.words.size() * 4, VK_FORMAT_R32_UINT);
    states_ = texel_buffer(
        *arena_, "place_states",
        (tree.texels.size() + (places + 1) * PLACE_STATE_TEXELS + SKY_DIRECTIONS * PLACE_FALL_TEXELS) * sizeof(glm::vec4),
        VK_FORMAT_R32G32B32A32_UINT);
    labels_ = texel_buffer(*arena_, "place_labels", at_least(shape.labels.size()) * 4,
                           VK_FORMAT_R32_UINT);
    levels_ = texel_buffer(*arena_, "place_levels", at_least(levels) * 4, VK_FORMAT_R32_SFLOAT);
    fill(*table_, tree.words);
    fill(*states_, tree.texels);
    fill(*labels_, shape.labels);
    constants_ = {tree.grid, shape.basin_corner_m, shape.basin_cell_m, shape.basin_width,
                  shape.basin_depth, shared::kNoPatch, 0.0f};
    level_count_ = levels;
}

void GpuPlace::update(const Device& device, const PlaceWeather* place)
{
    if (place == nullptr) {
        if (shape_) make(device, {}, 1, place_tree({}, {}, {}));
        shape_.reset();
        return;
    }
    std::vector<std::uint32_t> materials = materials_of(*place);
    if (place->shape != shape_ || place->levels_m.size() != level_count_ || materials != materials_) {
        check(*place);
        make(device, *place->shape, place->levels_m.size(), place_tree(place->shape->grid, place->shape->table, materials));
        shape_ = place->shape;
        materials_ = std::move(materials);
    }
    const std::size_t first = before_states(constants_);
    fill(*states_, place->states, first);
    // Behind those of the patches.
    if (!place->open.empty())
        std::memcpy(states_->mapped + first + place->states.size() * sizeof(glm::vec4), place->open.data(),
                    place->open.size() * sizeof(glm::vec4));
    constants_.glazed = glazed_share(place->states);
    constants_.open_patch = place->open.empty() ? shared::kNoPatch : constants_.grid.patches;
    fill(*levels_, place->levels_m);
}

void GpuPlace::set_falls(std::span<const shared::FallConstants> falls)
{
    std::vector<glm::vec4> texels;
    for (const shared::FallConstants& fall : falls) {
        texels.insert(texels.end(), {fall.column, fall.row, fall.depth, glm::vec4(fall.level, fall.rain),
                                     glm::vec4(fall.snow, static_cast<float>(fall.layer), 0.0f, 0.0f)});
    }
    const std::size_t behind = before_states(constants_) + (std::size_t{constants_.grid.patches} + 1) * PLACE_STATE_TEXELS * sizeof(glm::vec4);
    std::memcpy(states_->mapped + behind, texels.data(), texels.size() * sizeof(glm::vec4));
}

void bind_place(Bindings& bindings, std::uint32_t first, GpuPlace& place)
{
    bindings.push_back({first, texels(place.table())});
    bindings.push_back({first + 1, texels(place.states())});
    bindings.push_back({first + 2, texels(place.labels())});
    bindings.push_back({first + 3, texels(place.levels())});
}

}  // namespace petrichor::gpu
