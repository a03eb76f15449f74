// Every shared formula gives on the device what it gives on the CPU.
#include <memory>

#include "tests/gpu/formula_bench.h"
#include "tests/support/device.h"

namespace petrichor::gpu {
namespace {

// One pipeline has all formulas, and making it takes a second: they share it.
class Parity : public testing::TestWithParam<int> {
protected:
    static void TearDownTestSuite() { bench_ = nullptr; }
    void SetUp() override
    {
        if (testing_device::device_is_there() && !bench_) bench_ = std::make_unique<FormulaBench>();
    }
    void TearDown() override
    {
        if (bench_) bench_->expect_no_messages();
    }

    static inline std::unique_ptr<FormulaBench> bench_;
};

TEST_P(Parity, DeviceAndCpuAgree)
{
    expect_as_on_cpu(GetParam(), bench_->run("formula_probe.comp", GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Formulas, Parity, testing::Range(0, shared::kProbeKinds));

}  // namespace
}  // namespace petrichor::gpu
