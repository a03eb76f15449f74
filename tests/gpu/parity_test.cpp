// Every shared formula gives on the device what it gives on the CPU.
//
// Tolerance: the device's exp, pow and sin are good to about 1e-6 relative; formulas chain several
// of them and subtract near-equal numbers, so 3e-4 relative plus 3e-5 absolute is allowed. Where a
// formula jumps (a phase that wraps), a difference of one period is accepted.
#include <cstring>

#include "formulas/formula_probe.h"
#include "gpu/device/graph.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kCount = 4096;

// Numbers of 0..1 from a counter.
float number(std::uint32_t i)
{
    std::uint32_t x = i * 0x9e3779b9u + 0x7f4a7c15u;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return static_cast<float>(x >> 8) / 16777216.0f;
}

class Parity : public GpuTest, public testing::WithParamInterface<int> {};

TEST_P(Parity, DeviceAndCpuAgree)
{
    const int kind = GetParam();
    const Device device(RendererOptions{.device = "", .validation = true});
    PipelineCache pipelines(device);
    DescriptorArena descriptors(device);
    MemoryArena arena(device);
    std::vector<glm::vec4> arguments(3 * kCount);
    for (std::uint32_t i = 0; i < arguments.size(); ++i) {
        for (std::uint32_t c = 0; c < 4; ++c) arguments[i][static_cast<int>(c)] = number(4 * i + c);
    }
    auto input = arena.buffer(
        {.name = "arguments",
         .size = arguments.size() * sizeof(glm::vec4),
         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
         .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
    upload_buffer(device, *input, std::as_bytes(std::span(arguments)));
    auto output =
        arena.buffer({.name = "results", .size = kCount * sizeof(glm::vec4), .host = true});
    FrameGraph graph;
    graph.add(ComputePass{.name = "probe",
                          .shader = "formula_probe.comp",
                          .constants = {},
                          .bindings = {{0, texels(*input)}, {1, storage_buffer(*output)}},
                          .push = PushBlock(kind),
                          .groups = {kCount / 64, 1, 1}});
    graph.read_back({output.get()});
    graph.execute(device, pipelines, descriptors);

    int different = 0;
    float largest = 0.0f;
    for (std::size_t i = 0; i < kCount; ++i) {
        glm::vec4 got;
        std::memcpy(&got, output->mapped + i * sizeof(got), sizeof(got));
        const glm::vec4 expected =
            shared::probe(kind, arguments[3 * i], arguments[3 * i + 1], arguments[3 * i + 2]);
        for (int c = 0; c < 4; ++c) {
            const float error = std::abs(got[c] - expected[c]);
            const bool wraps = (kind == 6 && c == 3) || (kind == 8 && c < 2);
            if (wraps && error > 0.999f) continue;
            largest = std::max(largest, error / (1.0f + std::abs(expected[c])));
            if (error > 3e-5f + 3e-4f * std::abs(expected[c])) {
                if (++different <= 3) {
                    ADD_FAILURE() << "formula " << kind << " case " << i << " part " << c
                                  << ": device " << got[c] << ", CPU " << expected[c];
                }
            }
        }
    }
    EXPECT_EQ(different, 0) << "of " << kCount << "; largest difference " << largest;
    for (const std::string& message : device.validation_messages()) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(Formulas, Parity, testing::Range(0, shared::kProbeKinds));

}  // namespace
}  // namespace petrichor::gpu
