#include "film/frames/kept.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/hash.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;
using testing_program::Workplace;
using testing_program::write_file;

// A picture on the disk and its record: 4 x 2, half floats, with a channel of floats beside it.
class Kept : public testing::TestWithParam<bool> {
protected:
    Kept() : place_("kept")
    {
        std::vector<texproc::ExrChannel> channels;
        for (int c = 0; c < 4; ++c) {
            texproc::ExrChannel channel{std::string(1, "RGBA"[c]), {}, {}};
            for (int i = 0; i < 8; ++i)
                channel.half_bits.push_back(static_cast<std::uint16_t>(0x3800 + 8 * c + i));
            channels.push_back(channel);
        }
        std::vector<std::uint16_t> beauty;
        for (std::size_t i = 0; i < 8; ++i) {
            for (const auto& channel : channels) beauty.push_back(channel.half_bits[i]);
        }
        if (GetParam()) channels.push_back({"depth.Z", {}, std::vector<float>(8, 1.25f)});
        texproc::write_exr(place_ / name_, 4, 2, channels, {});
        Hasher hasher;
        hasher.add_numbers(std::span<const std::uint16_t>(beauty));
        record_.beauty_hash = hasher.text();
        record_.made_from = parts_;
        record_.files = {{name_, file_mark(place_ / name_)}};
    }
    std::string why(bool verify = false, const WrittenKinds& kinds = {.png = false}) const
    {
        return why_again({{Job{}, record_}}, Job{}, parts_, kinds, place_.path(), verify);
    }

    const std::string name_ = "frame_0000.exr";
    Workplace place_;
    FrameParts parts_ = {{"camera", "1"}, {"weather", "2"}};
    FrameRecord record_;
};

TEST_P(Kept, StaysAsLongAsNothingChanges)
{
    EXPECT_EQ(why(), "");
    EXPECT_EQ(why(true), "");
    parts_["camera"] = "3";
    EXPECT_EQ(why(), "camera changed");
    parts_["weather"] = "3";
    EXPECT_EQ(why(), "camera, weather changed");
    parts_ = record_.made_from;
    parts_["lighting models"] = "4";
    EXPECT_EQ(why(), "lighting models changed");
    parts_ = record_.made_from;
    record_.made_from["sky picture"] = "5";
    EXPECT_EQ(why(), "sky picture changed");
}

TEST_P(Kept, FilesCount)
{
    EXPECT_THAT(why(false, {.exr = true, .png = true}), HasSubstr("frame_0000.png was not asked"));
    record_.files[name_].hash[0] = record_.files[name_].hash[0] == 'a' ? 'b' : 'a';
    EXPECT_THAT(why(), HasSubstr("not the file that was written"));
    EXPECT_EQ(why_again({}, Job{}, parts_, {}, place_.path(), false), "it is not there");
}

// Files whose hashes are as recorded, and whose pixels are not what was rendered.
TEST_P(Kept, VerifyReadsPixels)
{
    record_.beauty_hash[0] = record_.beauty_hash[0] == 'a' ? 'b' : 'a';
    EXPECT_EQ(why(), "");
    EXPECT_THAT(why(true), HasSubstr("holds other pixels"));
    write_file(place_ / name_, "no picture");
    record_.files = {{name_, file_mark(place_ / name_)}};
    EXPECT_EQ(why(), "");
    EXPECT_THAT(why(true), HasSubstr(name_));
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutFloats, Kept, testing::Bool());

}  // namespace
}  // namespace petrichor::film
