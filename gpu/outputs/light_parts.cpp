#include "gpu/outputs/light_parts.h"

#include <cstring>

#include "gpu/outputs/aov_table.h"
#include "gpu/outputs/light_parts_io.h"

namespace petrichor::gpu {

namespace {

constexpr int kLayers[] = {
#define ROW(layer, name, meaning) layer,
    LIGHT_PARTS_TABLE(ROW)
#undef ROW
};
constexpr bool layers_count_up()
{
    for (int i = 0; i < static_cast<int>(std::size(kLayers)); ++i) {
        if (kLayers[i] != i) return false;
    }
    return std::size(kLayers) == LIGHT_PARTS;
}
static_assert(layers_count_up() && LIGHT_PARTS_LAYERS == LIGHT_PARTS + 1);

std::size_t layer_of(std::size_t row)
{
    return row - gbuffer_aov_count();
}

}  // namespace

bool is_light_part(std::size_t row)
{
    return row >= gbuffer_aov_count();
}

bool takes_light_apart(std::size_t row)
{
    return is_light_part(row) && layer_of(row) != REFLECTION_LABEL_LAYER;
}

bool needs_materials(std::size_t row)
{
    static const std::size_t material = aov_row("material");
    return row == material || (is_light_part(row) && layer_of(row) == REFLECTION_LABEL_LAYER);
}

void prepare_light_parts(LightParts& parts, MemoryArena& arena, const std::vector<std::size_t>& rows,
                         int width, int height, bool layered, bool adaptive)
{
    parts.split = parts.label = false;
    for (const std::size_t row : rows) {
        if (!is_light_part(row)) continue;
        (takes_light_apart(row) ? parts.split : parts.label) = true;
    }
    const auto image = [&](const char* name, int w, int h, int layers) {
        return arena.image({.name = name,
                            .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                            .width = w,
                            .height = h,
                            .layers = layers,
                            .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                     VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    };
    // Bound as an array, so one of two.
    if (!parts.none) parts.none = image("no_light_parts", 1, 1, 2);
    if (!parts.split && !parts.label) return;
    if (!parts.sum) {
        parts.sum = image("light_parts", width, height, LIGHT_PARTS_LAYERS);
        parts.air = image("light_parts_air", width, height, 1);
    }
    if (parts.split && layered && !parts.solid) {
        parts.solid = image("light_parts_solid", width, height, LIGHT_PARTS);
        parts.layer = image("light_parts_layer", width, height, LIGHT_PARTS);
        parts.front = image("light_parts_front", width, height, LIGHT_PARTS);
    }
    if (parts.split && adaptive && !parts.mean) {
        parts.mean = image("light_parts_mean", width, height, LIGHT_PARTS);
    }
    parts.values.resize(LIGHT_PARTS_LAYERS);
    for (const std::size_t row : rows) {
        if (!is_light_part(row) || parts.values[layer_of(row)]) continue;
        const auto numbers = static_cast<VkDeviceSize>(aov_table()[row].channels.size());
        parts.values[layer_of(row)] =
            arena.buffer({.name = "light_part_values",
                          .size = numbers * static_cast<VkDeviceSize>(width) *
                                  static_cast<VkDeviceSize>(height) * sizeof(float),
                          .host = true});
    }
}

void clear_light_parts(FrameGraph& graph, GpuImage& image)
{
    graph.add(TransferPass{
        .name = "light_parts",
        .transfers = {{&image, nullptr, Use::TransferTarget}},
        .record = [&image](VkCommandBuffer commands) {
            const VkClearColorValue dark{};
            const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0,
                                              static_cast<std::uint32_t>(image.layers)};
            vkCmdClearColorImage(commands, image.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                 &dark, 1, &all);
        }});
}

void add_parts_mean(FrameGraph& graph, const FrameTargets& targets, LightParts& parts, GpuImage& lit,
                    int what, GpuBuffer* asked, const ConstantsRange& constants)
{
    // Without a list it is bound and not read.
    GpuBuffer& bits = asked ? *asked : *targets.pixel_list;
    graph.add(ComputePass{
        .name = "light_parts",
        .shader = "light_parts_mean.comp",
        .constants = {{PARTS_MEAN_SPEC_WHAT, static_cast<std::uint32_t>(what)}},
        .bindings = {{PARTS_MEAN_FRAME, frame_binding(constants)},
                     {PARTS_MEAN_LIT, storage(lit)},
                     {PARTS_MEAN_MEAN, storage(*parts.mean)},
                     {PARTS_MEAN_ASKED, storage_buffer(bits)}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, LIGHT_PARTS_TILE)});
}

void add_light_parts(FrameGraph& graph, const FrameTargets& targets, LightParts& parts,
                     const ConstantsRange& constants, bool mirrors)
{
    for (std::size_t layer = 0; layer < parts.values.size(); ++layer) {
        if (!parts.values[layer]) continue;
        const bool label = layer == REFLECTION_LABEL_LAYER;
        if (label ? !parts.label : !parts.split) continue;  // of another frame
        graph.add(ComputePass{
            .name = "light_parts",
            .shader = "light_parts.comp",
            .constants = {},
            .bindings = {{LIGHT_PARTS_FRAME, frame_binding(constants)},
                         {LIGHT_PARTS_SUM, storage_read(*parts.sum)},
                         {LIGHT_PARTS_AIR, sampled(*parts.air, targets.nearest)},
                         {LIGHT_PARTS_VALUES, storage_buffer(*parts.values[layer])}},
            .push = PushBlock(shared::LightPartsPush{static_cast<int>(layer), mirrors}),
            .groups = groups_over(targets.width, targets.height, LIGHT_PARTS_TILE)});
        graph.read_back({parts.values[layer].get()});
    }
}

std::vector<float> read_light_part(const LightParts& parts, std::size_t row, std::size_t pixels)
{
    std::vector<float> values(pixels * aov_table()[row].channels.size());
    std::memcpy(values.data(), parts.values[layer_of(row)]->mapped, values.size() * sizeof(float));
    return values;
}

}  // namespace petrichor::gpu
