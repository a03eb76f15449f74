// Renders every case of the table and compares it with the picture that was accepted.
//
//   PETRICHOR_GOLDEN=accept   keep what is rendered as the new expected picture
//   PETRICHOR_GOLDEN=exact    one bit of difference fails
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/golden/judge.h"
#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const auto& part : {surface_cases(), weather_cases(), falling_cases(), light_cases(),
                             sky_cases()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

gpu::RenderResult render(gpu::Renderer& renderer, const Shot& shot)
{
    renderer.load(shot.scene, shot.textures);
    renderer.set_environment(shot.environment);
    return renderer.render(shot.frame);
}

class Golden : public gpu::GpuTest, public testing::WithParamInterface<Case> {};

TEST_P(Golden, LooksAsAccepted)
{
    Shot shot = GetParam().make();
    shot.frame.settings.surface_path = gpu::SurfacePath::Fragment;  // the other: below
    const gpu::RenderResult result = render(*renderer, shot);
    judge(GetParam().name, picture_of(result));
}

// Fragments and the resolve of a visibility buffer evaluate the same text: the picture is the same
// but for derivatives, which fragments take between neighbours and the resolve on the triangle.
TEST_P(Golden, BothSurfacePathsAgree)
{
    Shot shot = GetParam().make();
    shot.frame.settings.surface_path = gpu::SurfacePath::Fragment;
    const Picture fragments = picture_of(render(*renderer, shot));
    shot.frame.settings.surface_path = gpu::SurfacePath::Visibility;
    const Picture resolved = picture_of(render(*renderer, shot));
    const Tolerance tolerance{.fail = 0.02f, .percent = 2.0f, .hard_fail = 4.0f};
    const Comparison comparison = compare(resolved, fragments, tolerance);
    EXPECT_TRUE(passes(comparison, tolerance)) << summary(comparison);
}

INSTANTIATE_TEST_SUITE_P(, Golden, testing::ValuesIn(cases()),
                         [](const auto& param) { return param.param.name; });

// The net catches: a scene that is a little different is refused.
TEST_F(Golden, AChangedPictureFails)
{
    for (const Case& c : cases()) {
        if (c.name != "rain_film") continue;
        Shot shot = c.make();
        const Picture accepted = read_picture(accepted_file(c.name));
        shot.frame.weather.film_albedo -= 0.1f;
        const Picture changed = picture_of(render(*renderer, shot));
        EXPECT_FALSE(passes(compare(changed, accepted, Tolerance{}), Tolerance{}));
        return;
    }
    FAIL() << "no case rain_film";
}

TEST(GoldenFiles, EachBelongsToACase)
{
    std::set<std::string> known(demo_names().begin(), demo_names().end());
    for (const Case& c : cases()) {
        EXPECT_TRUE(known.insert(c.name).second) << c.name << " stands twice in the table";
    }
    std::uintmax_t bytes = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(accepted_file("x").parent_path())) {
        if (entry.path().extension() != ".exr") continue;
        EXPECT_TRUE(known.contains(entry.path().stem()))
            << entry.path() << " has no case: remove it";
        EXPECT_LE(entry.file_size(), 200u << 10) << entry.path();
        bytes += entry.file_size();
    }
    EXPECT_LE(bytes, 3u << 20);
}

}  // namespace
}  // namespace petrichor::golden
