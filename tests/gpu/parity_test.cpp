// Every shared formula gives on the device what it gives on the CPU.
#include "tests/gpu/formula_bench.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class Parity : public GpuTest, public testing::WithParamInterface<int> {};

TEST_P(Parity, DeviceAndCpuAgree)
{
    FormulaBench bench;
    expect_as_on_cpu(GetParam(), bench.run("formula_probe.comp", GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Formulas, Parity, testing::Range(0, shared::kProbeKinds));

}  // namespace
}  // namespace petrichor::gpu
