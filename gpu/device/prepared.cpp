#include "gpu/device/prepared.h"

#ifdef PETRICHOR_SPIRV_TOOLS
#include "gpu/device/by_value.h"
#include "gpu/device/droppable.h"
#include "gpu/device/small_functions.h"
#include "gpu/device/spirv_passes.h"
#endif

namespace petrichor::gpu {

#ifdef PETRICHOR_SPIRV_TOOLS

namespace {

// Variables of each function become values where no other function sees them (with by_value() that is most of
// them). It is the same for all constants, so it is done once: half of the time of what follows.
class Prepare : public Passes {
public:
    Prepare()
    {
        optimizer_.RegisterPass(spvtools::CreateInlineExhaustivePass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass(0))
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateSSARewritePass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }
};

}  // namespace

std::vector<std::uint32_t> prepared(std::span<const std::uint32_t> code)
{
    return with_inlining(Prepare().run(with_large_apart(with_droppable_shuffles(by_value(code)))));
}

#else

std::vector<std::uint32_t> prepared(std::span<const std::uint32_t>)
{
    return {};
}

#endif

}  // namespace petrichor::gpu
