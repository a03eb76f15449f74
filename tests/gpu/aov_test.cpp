// The table of outputs: groups by size, one dispatch for all.
#include "gpu/outputs/aov.h"

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

TEST(AovTable, NamesAreUniqueAndUnitsAreGiven)
{
    for (std::size_t i = 0; i < aov_table().size(); ++i) {
        const AovInfo& info = aov_table()[i];
        EXPECT_EQ(aov_row(info.name), i);
        EXPECT_FALSE(info.unit.empty()) << info.name;
        EXPECT_FALSE(info.meaning.empty()) << info.name;
    }
    EXPECT_EQ(aov_table()[aov_row("depth")].precision, AovPrecision::FLOAT);
    EXPECT_THROW(aov_row("weight"), Error);
}

TEST(AovGroups, AllThatFitShareOneDispatch)
{
    const std::vector<std::size_t> rows{aov_row("normal"), aov_row("depth"), aov_row("depth")};
    const auto groups = group_aovs(rows, 100, 1u << 20);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].numbers, 4u) << "asked twice is written once";
    EXPECT_EQ(group_aovs(rows, 100, 100 * 3 * sizeof(float)).size(), 2u);
    EXPECT_TRUE(group_aovs({}, 100, 1u << 20).empty());
}

class AovTest : public GpuTest {};

// Together they are what they are alone, in whatever order they are named.
TEST_F(AovTest, TogetherTheyAreWhatTheyAreAlone)
{
    Material glowing = plain_material({0.2f, 0.5f, 0.9f}, 0.4f, 0.3f);
    glowing.emissive = glm::vec3(3.0f);
    glowing.weather.porosity = 0.7f;
    renderer->load(scene_of({quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4})}, {glowing}), {});
    Frame frame;
    frame.camera = look({0, 2, 3}, {0, 0, 0});
    frame.settings.width = 40;
    frame.settings.height = 24;
    frame.settings.samples = 1;
    frame.weather.flood_puddles = 1.0f;
    frame.weather.snow_amount = 0.4f;
    for (const AovInfo& info : aov_table()) {
        frame.settings.aovs.insert(frame.settings.aovs.begin(), info.name);
    }
    const RenderResult all = renderer->render(frame);
    ASSERT_EQ(all.aovs.size(), aov_table().size());
    for (const AovImage& image : all.aovs) {
        frame.settings.aovs = {image.name};
        const RenderResult alone = renderer->render(frame);
        EXPECT_EQ(alone.aovs.at(0).name, image.name);
        EXPECT_EQ(alone.aovs.at(0).pixels, image.pixels) << image.name;
    }
    EXPECT_NEAR(aov(all, "porosity", 20, 14), 0.7f, 0.01f);
    EXPECT_NEAR(aov(all, "emission", 20, 14), 3.0f, 3.0f);
    EXPECT_EQ(aov(all, "lighting_model", 20, 14), 0.0f);
    EXPECT_EQ(aov(all, "lighting_model", 0, 0), -1.0f) << "sky";
    EXPECT_NEAR(aov(all, "specular", 20, 14, 2), 0.7f * 0.04f + 0.3f * 0.9f, 0.01f);
}

}  // namespace
}  // namespace petrichor::gpu
