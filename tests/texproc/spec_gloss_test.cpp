#include "texproc/material/spec_gloss.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace petrichor::texproc {
namespace {

Image pixel(float r, float g, float b)
{
    Image image(1, 1, 3, ColorSpace::Linear);
    image.pixels = {r, g, b};
    return image;
}

// Metal and dielectric of any colour, and every mix of grey, come back.
TEST(SpecGloss, ThereAndBackIsTheSameSurface)
{
    const float colors[][3] = {{0.9f, 0.2f, 0.1f}, {0.05f, 0.3f, 0.7f}, {0.5f, 0.5f, 0.5f}};
    for (const auto& c : colors) {
        for (const float share : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            const bool grey = c[0] == c[1];
            if (!grey && share > 0.0f && share < 1.0f) continue;
            const Image metallic(1, 1, 1, ColorSpace::Data, share);
            const SpecularColor there = to_specular(pixel(c[0], c[1], c[2]), metallic);
            const MetallicColor back = to_metallic(there.diffuse, there.specular);
            EXPECT_NEAR(back.metallic.pixels[0], share, 2e-3f) << c[0];
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(back.base.pixels[k], c[k], 2e-3f) << c[0] << " metallic " << share;
        }
    }
}

// By hand: a dielectric keeps its diffuse colour, gold has none.
TEST(SpecGloss, KnownSurfaces)
{
    const MetallicColor paint = to_metallic(pixel(0.6f, 0.3f, 0.1f), pixel(0.04f, 0.04f, 0.04f));
    EXPECT_NEAR(paint.metallic.pixels[0], 0.0f, 1e-5f);
    EXPECT_NEAR(paint.base.pixels[0], 0.6f, 1e-5f);
    const SpecularColor gold =
        to_specular(pixel(1.0f, 0.77f, 0.34f), Image(1, 1, 1, ColorSpace::Data, 1.0f));
    EXPECT_EQ(gold.diffuse.pixels[1], 0.0f);
    EXPECT_NEAR(gold.specular.pixels[1], 0.77f, 1e-6f);
}

TEST(SpecGloss, SizesThatDoNotFitAreNamed)
{
    EXPECT_THROW(to_metallic(pixel(1, 1, 1), Image(2, 1, 3, ColorSpace::Linear)), Error);
    EXPECT_THROW(to_specular(pixel(1, 1, 1), Image(1, 1, 3, ColorSpace::Linear)), Error);
}

}  // namespace
}  // namespace petrichor::texproc
