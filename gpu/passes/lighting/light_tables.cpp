#include "gpu/passes/lighting/light_tables.h"

#include <cstring>
#include <iterator>

#include "formulas/light/ltc.h"
#include "formulas/light/skin.h"

namespace petrichor::gpu {

namespace {

constexpr double kMatrices[] = {
#include "gpu/lighting/ltc_table.inc"
};
static_assert(std::size(kMatrices) == 4 * LTC_TABLE_SIDE * LTC_TABLE_SIDE);

std::unique_ptr<GpuBuffer> table(MemoryArena& arena, const char* name, std::size_t count)
{
    return arena.buffer({.name = name,
                         .size = count * sizeof(glm::vec4),
                         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                         .host = true});
}

void fill(const GpuBuffer& buffer, std::span<const glm::vec4> texels)
{
    std::memcpy(buffer.mapped, texels.data(), texels.size_bytes());
}

}  // namespace

std::span<const glm::vec4> ltc_table()
{
    static const std::vector<glm::vec4> matrices = [] {
        std::vector<glm::vec4> all;
        for (std::size_t i = 0; i < std::size(kMatrices); i += 4)
            all.emplace_back(glm::dvec4(kMatrices[i], kMatrices[i + 1], kMatrices[i + 2], kMatrices[i + 3]));
        return all;
    }();
    return matrices;
}

LightTables::LightTables(const Device& device) : device_(&device), arena_(device)
{
    ltc_ = table(arena_, "ltc", LTC_TABLE_SIDE * LTC_TABLE_SIDE);
    fill(*ltc_, ltc_table());
    skin_ = table(arena_, "skin", SKIN_TABLE_SIDE * SKIN_TABLE_SIDE);
    no_shares_ = arena_.image({.name = "no_shares",
                               .format = VK_FORMAT_R32G32B32A32_UINT,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
    load({});
}

void LightTables::load(const std::vector<LightProfile>& profiles)
{
    profiles_ = nullptr;
    profile_arena_ = std::make_unique<MemoryArena>(*device_);
    std::vector<glm::vec4> texels;
    for (const LightProfile& profile : profiles) {
        // Alpha tells pictures from distributions.
        for (const glm::vec3& texel : profile.texels)
            texels.emplace_back(texel, profile.picture ? 1.0f : 0.0f);
    }
    if (texels.empty()) texels.emplace_back(0.0f);
    profiles_ = table(*profile_arena_, "light_profiles", texels.size());
    fill(*profiles_, texels);
}

void LightTables::need_skin()
{
    if (has_skin_) return;
    has_skin_ = true;
    std::vector<glm::vec4> texels;
    for (int y = 0; y < SKIN_TABLE_SIDE; ++y) {
        for (int x = 0; x < SKIN_TABLE_SIDE; ++x)
            texels.emplace_back(shared::skin_table_texel(x, y), 0.0f);
    }
    fill(*skin_, texels);
}

}  // namespace petrichor::gpu
