// The program as it is built where OpenColorIO's library is not installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "film/color/display_transform.h"

namespace petrichor::film {
namespace {

TEST(NoDisplayTransform, AConfigIsRefusedWithThePackageToInstall)
{
    EXPECT_FALSE(has_color_management());
    EXPECT_EQ(color_management_version(), "");
    try {
        const DisplayTransform made({.config = "c.ocio"}, ".");
        FAIL() << "nothing was said";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("ocio_config"));
        EXPECT_THAT(error.fix(), testing::HasSubstr("libopencolorio-dev"));
    }
}

}  // namespace
}  // namespace petrichor::film
