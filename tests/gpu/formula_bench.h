// Formulas asked on the device, as parity tests do.
#ifndef PETRICHOR_TESTS_GPU_FORMULA_BENCH_H
#define PETRICHOR_TESTS_GPU_FORMULA_BENCH_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formulas/formula_probe.h"
#include "gpu/device/graph.h"

namespace petrichor::gpu {

inline constexpr int kBenchCases = 4096;

/// Three of four numbers of 0..1 for each case, from a counter.
inline std::vector<glm::vec4> bench_arguments()
{
    const auto number = [](std::uint32_t i) {
        std::uint32_t x = i * 0x9e3779b9u + 0x7f4a7c15u;
        x ^= x >> 16;
        x *= 0x7feb352du;
        x ^= x >> 15;
        x *= 0x846ca68bu;
        x ^= x >> 16;
        return static_cast<float>(x >> 8) / 16777216.0f;
    };
    std::vector<glm::vec4> numbers(3 * kBenchCases);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) {
        for (std::uint32_t c = 0; c < 4; ++c) numbers[i][static_cast<int>(c)] = number(4 * i + c);
    }
    return numbers;
}

/// Runs a compute shader over the arguments. What validation says fails the test at its end.
class FormulaBench {
public:
    FormulaBench() : device_(RendererOptions{.device = "", .validation = true}), pipelines_(device_), descriptors_(device_), arena_(device_)
    {
        const std::vector<glm::vec4> numbers = bench_arguments();
        input_ = arena_.buffer({.name = "numbers",
                                .size = numbers.size() * sizeof(glm::vec4),
                                .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
        upload_buffer(device_, *input_, std::as_bytes(std::span(numbers)));
        output_ = arena_.buffer({.name = "results", .size = kBenchCases * sizeof(glm::vec4), .host = true});
    }
    ~FormulaBench() { expect_no_messages(); }
    /// Of the test that is running: what validation has said since this was asked last fails it.
    void expect_no_messages()
    {
        const std::vector<std::string> messages = device_.validation_messages();
        for (; told_ < messages.size(); ++told_) ADD_FAILURE() << messages[told_];
    }
    void load(const std::string& name, std::vector<unsigned int> words) { pipelines_.add_shader(name, std::move(words)); }
    std::vector<glm::vec4> run(const std::string& name, int kind)
    {
        FrameGraph graph;
        graph.add(ComputePass{.name = "probe",
                              .shader = name,
                              .constants = {},
                              .bindings = {{0, texels(*input_)}, {1, storage_buffer(*output_)}},
                              .push = PushBlock(kind),
                              .groups = {kBenchCases / 64, 1, 1}});
        graph.read_back({output_.get()});
        graph.execute(device_, pipelines_, descriptors_);
        std::vector<glm::vec4> results(kBenchCases);
        std::memcpy(results.data(), output_->mapped, kBenchCases * sizeof(glm::vec4));
        return results;
    }

private:
    Device device_;
    PipelineCache pipelines_;
    DescriptorArena descriptors_;
    MemoryArena arena_;
    std::shared_ptr<GpuBuffer> input_;
    std::shared_ptr<GpuBuffer> output_;
    std::size_t told_ = 0;
};

/// The device's exp, pow and sin are good to about 1e-6 relative; formulas chain several of them and subtract near-equal
/// numbers, so 3e-4 relative plus 3e-5 absolute is allowed.
inline bool near_enough(float got, float expected)
{
    return std::abs(got - expected) <= 3e-5f + 3e-4f * std::abs(expected);
}

/// Where a formula jumps (a phase that wraps), a difference of one period is accepted.
inline void expect_as_on_cpu(int kind, const std::vector<glm::vec4>& results)
{
    const std::vector<glm::vec4> numbers = bench_arguments();
    int different = 0;
    float largest = 0.0f;
    for (std::size_t i = 0; i < kBenchCases; ++i) {
        const glm::vec4 got = results[i];
        const glm::vec4 expected = shared::probe(kind, numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
        for (int c = 0; c < 4; ++c) {
            const float error = std::abs(got[c] - expected[c]);
            const bool wraps = (kind == 6 && c == 3) || (kind == 8 && c < 2);
            if (wraps && error > 0.999f) continue;
            largest = std::max(largest, error / (1.0f + std::abs(expected[c])));
            if (near_enough(got[c], expected[c])) continue;
            if (++different <= 3) {
                ADD_FAILURE() << "formula " << kind << " case " << i << " part " << c << ": device " << got[c] << ", CPU "
                              << expected[c];
            }
        }
    }
    EXPECT_EQ(different, 0) << "of " << kBenchCases << ", formula " << kind << "; largest difference " << largest;
}

}  // namespace petrichor::gpu

#endif
