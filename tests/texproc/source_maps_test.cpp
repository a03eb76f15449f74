#include "texproc/material/source_maps.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/texproc/textures.h"
#include "texproc/codecs/files/io.h"
#include "texproc/filter/normal.h"
#include "texproc/filter/resample.h"

namespace petrichor::texproc {
namespace {

using testing::HasSubstr;

class GreenDirectionOfMaterials : public TextureFiles {
protected:
    void SetUp() override
    {
        TextureFiles::SetUp();
        Image height(64, 64, 1, ColorSpace::Data);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                height.at(x, y, 0) = 0.5f + 0.2f * std::sin(0.3926991f * static_cast<float>(y)) +
                                     0.1f * std::sin(0.1963495f * static_cast<float>(x + y));
            }
        }
        up = to_raw(normal_from_height(height), PixelType::U8);
        write_raw(folder / "up.png", up);
        RawImage down = up;
        for (std::size_t i = 1; i < down.bytes.size(); i += 3) down.bytes[i] ^= std::byte{255};
        write_raw(folder / "down.png", down);
        write_image(folder / "height.png", height, {.bits = 16});
        write_image(folder / "small.png", resized(height, 32, 32), {.bits = 16});
    }

    // A material of which only the normals are written out, as glTF does.
    SourceMaps maps(const std::string& normal, const std::string& height, Green named, Green told)
    {
        Recipe recipe;
        recipe.green = told;
        recipe.bake.clear();
        OutputRule rule;
        rule.channels = {"n", "", {"normal.r", "normal.g", "normal.b"}, {}};
        recipe.outputs = {rule};
        MaterialFiles files;
        files.name = "m";
        files.green = named;
        files.inputs["normal"] = {folder / normal, ""};
        if (!height.empty()) files.inputs["height"] = {folder / height, ""};
        return read_source_maps(plan_material(files, std::make_shared<Recipe>(recipe)), 1);
    }
    RawImage up;
};

// The height map decides, though no output asks for it, and over a name that it contradicts.
TEST_F(GreenDirectionOfMaterials, TheHeightMapDecidesForEveryEngine)
{
    for (const char* height : {"height.png", "small.png"}) {
        for (const Green named : {Green::Auto, Green::Up, Green::Down}) {
            for (const char* normal : {"up.png", "down.png"}) {
                const SourceMaps read = maps(normal, height, named, Green::Auto);
                EXPECT_TRUE(read.images.at("normal").bytes == up.bytes) << normal << " " << height;
                EXPECT_THAT(read.green, HasSubstr("the height map"));
            }
        }
    }
    EXPECT_THAT(maps("down.png", "height.png", Green::Up, Green::Auto).green,
                HasSubstr("its name says up"));
}

TEST_F(GreenDirectionOfMaterials, WhatIsToldWins)
{
    EXPECT_NE(maps("up.png", "height.png", Green::Auto, Green::Down).images.at("normal").bytes,
              up.bytes);
    EXPECT_EQ(maps("up.png", "height.png", Green::Down, Green::Up).images.at("normal").bytes,
              up.bytes);
}

TEST_F(GreenDirectionOfMaterials, WithoutAHeightMapTheNameDecides)
{
    EXPECT_NE(maps("up.png", "", Green::Down, Green::Auto).images.at("normal").bytes, up.bytes);
    EXPECT_EQ(maps("down.png", "", Green::Down, Green::Auto).images.at("normal").bytes, up.bytes);
    EXPECT_EQ(maps("up.png", "", Green::Up, Green::Auto).images.at("normal").bytes, up.bytes);
}

TEST(Resized, KeepsTheMeanAndTheRamp)
{
    Image ramp(8, 4, 1, ColorSpace::Data);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) ramp.at(x, y, 0) = static_cast<float>(x) / 7.0f;
    }
    const Image large = resized(ramp, 16, 4);
    for (int x = 1; x < 15; ++x) {
        EXPECT_NEAR(large.at(x, 2, 0), (static_cast<float>(x) - 0.5f) / 14.0f, 1e-5f) << x;
    }
    const Image small = resized(ramp, 2, 2);
    EXPECT_NEAR(small.at(0, 0, 0), 1.5f / 7.0f, 1e-5f);
    EXPECT_NEAR(small.at(1, 1, 0), 5.5f / 7.0f, 1e-5f);
    const Image mixed = resized(ramp, 4, 8);  // narrower and higher
    EXPECT_EQ(mixed.width, 4);
    EXPECT_NEAR(mixed.at(0, 7, 0), 0.5f / 7.0f, 1e-5f);
}

}  // namespace
}  // namespace petrichor::texproc
