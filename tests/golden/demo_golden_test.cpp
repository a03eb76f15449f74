// Two frames of the demo street through the program, as a user gets them: files in, files out.
#include <gtest/gtest.h>

#include "tests/golden/judge.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/program.h"

namespace petrichor::golden {
namespace {

using namespace testing_program;

class GoldenDemo : public gpu::GpuTest {};

// Five frames over the 48 s of the scenario: the second stands in heavy rain (9.6 s), the fourth in
// snowfall (28.8 s). One run for both: making the street's textures is most of the time.
TEST_F(GoldenDemo, StreetInRainAndSnow)
{
    const Workplace place("golden_demo");
    const Outcome outcome = run_petrichor(
        {.arguments = {"render", "demo", "-o", "out", "--count", "5", "--frames", "1:3", "--size",
                       "160x90", "--samples", "2", "--no-film", "--validate"}},
        place.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("error validation"), std::string::npos) << outcome.err;
    const std::string frames[] = {"out/frame_0001", "out/frame_0003"};
    for (std::size_t i = 0; i < 2; ++i) {
        judge(demo_names().at(i),
              read_frame(place / (frames[i] + ".exr"), place / (frames[i] + ".png")));
    }
}

}  // namespace
}  // namespace petrichor::golden
