#include "gpu/outputs/aov.h"

#include "gpu/outputs/aov_io.h"

namespace petrichor::gpu {

std::vector<AovGroup> group_aovs(const std::vector<std::size_t>& rows, std::size_t pixels,
                                 std::uint64_t most_bytes)
{
    std::uint64_t asked = 0;
    for (const std::size_t row : rows) {
        if (row < gbuffer_aov_count()) asked |= std::uint64_t{1} << row;
    }
    std::vector<AovGroup> groups;
    const std::uint64_t most_numbers = most_bytes / sizeof(float) / pixels;
    for (std::size_t row = 0; row < gbuffer_aov_count(); ++row) {
        if ((asked >> row & 1u) == 0) continue;
        const std::size_t numbers = aov_table()[row].channels.size();
        if (groups.empty() || groups.back().numbers + numbers > most_numbers) groups.push_back({});
        groups.back().rows |= std::uint64_t{1} << row;
        groups.back().numbers += numbers;
    }
    return groups;
}

void add_aovs(FrameGraph& graph, FrameTargets& targets, GpuPlace& place,
              const ConstantsRange& constants, const AovGroup& group, std::size_t buffer,
              const GBufferParts& parts, const LightingModels& models, bool prepass, bool materials_only)
{
    shared::AovPush push{static_cast<std::uint32_t>(built_in_lighting_models().size()), {}};
    for (std::uint32_t model = 0; prepass && model < models.count(); ++model)
        if (models.gathers(model)) push.gather[model / 32] |= 1u << model % 32;
    ComputePass pass{
        .name = "aov",
        .shader = "aov.comp",
        .constants = {{AOV_SPEC_ROWS_LOW, static_cast<std::uint32_t>(group.rows)},
                      {AOV_SPEC_ROWS_HIGH, static_cast<std::uint32_t>(group.rows >> 32)},
                      {AOV_SPEC_WEATHER, parts.weather ? targets.weather_kept() : WEATHER_DRY},
                      {AOV_SPEC_HAS_EMISSION, parts.emission},
                      {AOV_SPEC_HAS_BAKED, parts.baked},
                      {AOV_SPEC_PLACE, place.present()},
                      {AOV_SPEC_MATERIALS, materials_only}},
        .bindings = {{AOV_FRAME, frame_binding(constants)},
                     {AOV_OUTPUT, storage_buffer(*targets.aovs[buffer])}},
        .push = PushBlock(push),
        .groups = groups_over(targets.width, targets.height, AOV_TILE)};
    bind_place(pass.bindings, AOV_PLACE_TABLE, place);
    bind_gbuffer(pass.bindings, AOV_GBUFFER, targets);
    graph.add(std::move(pass));
    graph.read_back({targets.aovs[buffer].get()});
}

std::vector<float> read_aov(const FrameTargets& targets, const std::vector<AovGroup>& groups,
                            std::size_t row)
{
    const auto pixels =
        static_cast<std::size_t>(targets.width) * static_cast<std::size_t>(targets.height);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if ((groups[i].rows >> row & 1u) == 0) continue;
        std::size_t before = 0;
        for (std::size_t r = 0; r < row; ++r) {
            if ((groups[i].rows >> r & 1u) != 0) before += aov_table()[r].channels.size();
        }
        std::vector<float> values(pixels * aov_table()[row].channels.size());
        std::memcpy(values.data(), targets.aovs[i]->mapped + before * pixels * sizeof(float),
                    values.size() * sizeof(float));
        return values;
    }
    return {};
}

}  // namespace petrichor::gpu
