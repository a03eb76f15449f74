// Texture slots as keys of a scenario, through whole renders: files, colour space, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <utility>

#include "film/frames/frames_jsonl.h"
#include "scene/material_table.h"
#include "tests/support/tiny_render.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace testing_program;

class MaterialTextures : public TinyRender {
protected:
    MaterialTextures() : TinyRender("material-textures-cli", R"([lights]
lamps = "on"
[materials."stone"]
emissive_factor = [1, 1, 1]
emissive_strength = 3000
)")
    {
    }
};

// Stripes in all four channels, neither white nor what the scene brings.
std::string striped_png()
{
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool band = x / 8 % 2 == 0;
            const std::array<int, 4> light{30, 90, 210, 255}, dark{200, 160, 225, 255};
            for (const int value : band ? light : dark)
                pixels.push_back(static_cast<std::uint8_t>(value));
        }
    }
    const auto bytes = texproc::encode_png8(32, 32, 4, pixels);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(MaterialTextures, EverySlotTakesAFileThatChangesThePicture)
{
    write_file(place_ / "stripes.png", striped_png());
    std::map<std::string, std::string> before;  // by what is asked for beside the slot
    const auto without = [&](const std::string& more) -> const std::string& {
        const auto [at, is_new] = before.try_emplace(more);
        if (is_new) at->second = picture(more, "without-" + std::to_string(before.size()));
        return at->second;
    };
    for (const scene::MaterialTexture& slot : scene::material_textures()) {
        const std::string name(slot.name);
        // Of a second set something must be seen, and of a trodden normal what is trodden.
        const bool mixes = name.starts_with("second_") || name.starts_with("mix_");
        const std::string more = mixes ? "second_set = \"mix\"\nmix_factor = 0.5\n"
                                 : name.starts_with("snow_mask_normal")
                                     ? "snow_mask_texture = \"stripes.png\"\n"
                                     : "";
        EXPECT_NE(picture(more + name + " = \"stripes.png\"\n", name), without(more)) << name;
    }
    EXPECT_NE(picture("base_color_texture = \"\"\n", "bare"), without(""));
}

TEST_F(MaterialTextures, AFileThatChangesIsRenderedAgain)
{
    write_file(place_ / "map.png", striped_png());
    const std::string key = "base_color_texture = \"map.png\"\n";
    const std::string before = picture(key, "out");
    const auto made_from = film::read_frame_records(place_ / "out").begin()->second.made_from;
    write_file(place_ / "map.png", [] {
        const std::vector<std::uint8_t> red(8 * 8 * 3, 120);
        const auto bytes = texproc::encode_png8(8, 8, 3, red);
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }());
    const Outcome again = run_petrichor(
        {.arguments = {"render", "s.toml", "-o", "out", "--resume"}}, place_.path());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(film::read_frame_records(place_ / "out").begin()->second.made_from, made_from);
    EXPECT_NE(read_file(place_ / "out" / "frame_0000.png"), before);
}

TEST_F(MaterialTextures, WhatCannotBeReadIsAnErrorAndLeavesNothing)
{
    write_file(place_ / "broken.png", striped_png().substr(0, 40));
    for (const std::string file : {"missing.png", "broken.png", "."}) {
        const Outcome outcome = render("height_texture = \"" + file + "\"\n", "none");
        EXPECT_EQ(outcome.exit_code, 2) << file << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(file == "." ? "s.toml" : file));
        EXPECT_FALSE(fs::exists(place_ / "none" / "frame_0000.png"));
    }
    const Outcome outcome = render("base_colour_texture = \"a.png\"\n", "none");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("base_color_texture"));
}

}  // namespace
}  // namespace petrichor::cli
