#ifndef PETRICHOR_GPU_DEVICE_SPIRV_PASSES_H
#define PETRICHOR_GPU_DEVICE_SPIRV_PASSES_H

#include <cstdint>
#include <span>
#include <spirv-tools/optimizer.hpp>
#include <vector>

namespace petrichor::gpu {

/// Steps of SPIRV-Tools that a shader is taken through.
class Passes {
public:
    Passes() : optimizer_(SPV_ENV_VULKAN_1_3)
    {
        optimizer_.SetMessageConsumer(
            [](spv_message_level_t, const char*, const spv_position_t&, const char*) {});
    }

    /// Their names in order.
    std::vector<const char*> names() const { return optimizer_.GetPassNames(); }

    /// Empty for one that does not hold. Passes take for granted that it does; what passes made is not asked again.
    std::vector<std::uint32_t> run(std::span<const std::uint32_t> code, bool made_by_passes = false) const
    {
        spvtools::OptimizerOptions options;
        spvtools::ValidatorOptions rules;
        rules.SetScalarBlockLayout(true);
        options.set_validator_options(rules);
        options.set_run_validator(!made_by_passes);
        std::vector<std::uint32_t> words;
        if (!optimizer_.Run(code.data(), code.size(), &words, options)) return {};
        return words;
    }

protected:
    spvtools::Optimizer optimizer_;
};

}  // namespace petrichor::gpu

#endif
