#include "gpu/passes/reflections/probe_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "formulas/codec/octahedral.h"
#include "formulas/light/reflection_probe.h"
#include "gpu/passes/reflections/reflections_io.h"

namespace petrichor::gpu {
namespace {

// Cosine-weighted share of sky above, of the roughest level, borders left out.
float sky_above(const std::vector<glm::vec4>& light)
{
    const int level = shared::kProbeLevels - 1;
    const int side = shared::reflection_probe_side(level);
    const auto first = static_cast<std::size_t>(shared::reflection_probe_offset(level));
    float sky = 0.0f, all = 0.0f;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) * (2.0f / static_cast<float>(side)) - 1.0f;
            const float up = std::max(shared::octahedral_decode(at).y, 0.0f);
            sky += up * light[first + static_cast<std::size_t>((y + 1) * (side + 2) + x + 1)].a;
            all += up;
        }
    }
    return sky / all;
}

using BandTexels = std::array<std::uint32_t, 4 * shared::kProbeBandTexels>;

BandTexels band_texels(const std::array<glm::vec4, shared::kHarmonics>& bands)
{
    float light = 0.0f, sky = 0.0f;
    for (const glm::vec4& band : bands) {
        for (int c = 0; c < 3; ++c) light = std::max(light, std::abs(band[c]));
        sky = std::max(sky, std::abs(band.a));
    }
    const float per_light = light > 1e-30f ? 1.0f / light : 0.0f, per_sky = sky > 1e-30f ? 1.0f / sky : 0.0f;
    BandTexels texels{};
    std::size_t word = 0;
    for (const glm::vec4& band : bands) {
        texels[word++] = shared::probe_band_word(glm::clamp(glm::vec2(band.r, band.g) * per_light, -1.0f, 1.0f));
        texels[word++] = shared::probe_band_word(
            glm::clamp(glm::vec2(band.b * per_light, band.a * per_sky), -1.0f, 1.0f));
    }
    texels[word++] = std::bit_cast<std::uint32_t>(light / shared::kProbeBandOne);
    texels[word++] = std::bit_cast<std::uint32_t>(sky / shared::kProbeBandOne);
    return texels;
}

}  // namespace

ProbeTable::ProbeTable(const Device& device) : device_(&device)
{
    make_buffers(0);
}

void ProbeTable::make_buffers(std::size_t probes)
{
    for (auto* buffer : {&rows_, &light_, &spread_, &bands_}) *buffer = nullptr;
    arena_ = std::make_unique<MemoryArena>(*device_);
    const auto texels = [&](const char* name, std::size_t count) {
        return arena_->buffer({.name = name,
                               .size = std::max<std::size_t>(count, 1) * sizeof(glm::vec4),
                               .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                               .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                               .host = true});
    };
    rows_ = texels("reflection_probes", probes * PROBE_ROWS);
    light_ = texels("reflection_probe_light",
                    probes * static_cast<std::size_t>(
                                 shared::reflection_probe_offset(shared::kProbeLevels)));
    spread_ = arena_->buffer({.name = "reflection_probe_spread",
                              .size = kMostProbes * sizeof(shared::ProbeSpread),
                              .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                              .host = true});
    bands_ = arena_->buffer({.name = "reflection_probe_bands",
                             .size = std::max<std::size_t>(probes, 1) * sizeof(BandTexels),
                             .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                             .texel_format = VK_FORMAT_R32G32B32A32_UINT,
                             .host = true});
    count_ = static_cast<std::uint32_t>(probes);
}

void ProbeTable::relight(const PatchLights& patches)
{
    relight_ms_ = 0.0;
    const PatchScene* scene = patches.scene();
    const std::size_t wanted = scene ? scene->probes.size() : 0;
    if (patches.loads() == loads_ && patches.lit_by() == lit_by_) return;
    const auto start = std::chrono::steady_clock::now();
    if (wanted != count_) make_buffers(wanted);
    loads_ = patches.loads();
    lit_by_ = patches.lit_by();
    parallel_for(wanted, 0, [&](std::size_t i) {
        const scene::TracedProbe& probe = scene->probes[i];
        const std::vector<glm::vec4> light = scene::lit_probe(probe, patches.radiosity(), patches.rough_radiosity());
        std::memcpy(light_->mapped + i * light.size() * sizeof(light[0]), light.data(),
                    light.size() * sizeof(light[0]));
        const scene::ProbePlace& p = probe.place;
        const glm::vec4 rows[PROBE_ROWS] = {
            glm::vec4(p.position_m, std::pow(1000.0f, p.importance)),
            glm::vec4(p.low_m, p.blend_m), glm::vec4(p.high_m, sky_above(light))};
        std::memcpy(rows_->mapped + i * sizeof rows, rows, sizeof rows);
        shared::ProbeSpread spread{rows[0], rows[1], rows[2], {}};
        const auto bands = scene::probe_bands(light);
        std::copy(bands.begin(), bands.end(), spread.bands);
        std::memcpy(spread_->mapped + i * sizeof spread, &spread, sizeof spread);
        const BandTexels words = band_texels(bands);
        std::memcpy(bands_->mapped + i * sizeof words, &words, sizeof words);
    });
    if (wanted > 0) {
        relight_ms_ = std::chrono::duration<double, std::milli>(
                          std::chrono::steady_clock::now() - start)
                          .count();
    }
}

}  // namespace petrichor::gpu
