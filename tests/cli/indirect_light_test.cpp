// Light between surfaces in whole renders: patches are the default, and odd scenes are defined.
#include <gmock/gmock.h>

#include "tests/support/tiny_render.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;

class IndirectLight : public TinyRender {
protected:
    IndirectLight() : TinyRender("indirect-light-cli", "") {}
};

TEST_F(IndirectLight, PatchesAreTheDefaultAndAmbientAChoice)
{
    const Outcome by_itself = render("", "itself");
    ASSERT_EQ(by_itself.exit_code, 0) << by_itself.err;
    EXPECT_THAT(by_itself.err, HasSubstr(" patches, "));
    const std::string picture_by_itself = read_file(place_ / "itself/frame_0000.png");
    EXPECT_EQ(picture("[render]\nindirect = \"patches\"\n", "patches"), picture_by_itself);
    const Outcome ambient = render("[render]\nindirect = \"ambient\"\n", "ambient");
    ASSERT_EQ(ambient.exit_code, 0) << ambient.err;
    EXPECT_THAT(ambient.err, HasSubstr("light between surfaces: ambient"));
    EXPECT_NE(read_file(place_ / "ambient/frame_0000.png"), picture_by_itself);
}

TEST_F(IndirectLight, ASunBelowTheHorizonIsDefined)
{
    const Outcome night = render("[sun]\nelevation_degrees = -40\n", "night");
    EXPECT_EQ(night.exit_code, 0) << night.err;
    EXPECT_THAT(night.err, HasSubstr(" patches, "));
}

}  // namespace
}  // namespace petrichor::cli
