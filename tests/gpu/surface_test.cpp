// What the surface pass writes: the dry material, and the weather where it lies.
#include <cmath>
#include <functional>

#include "formulas/weather/surface_weather.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;

class Surface : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame,
                      const std::vector<Texture>& textures = {})
    {
        renderer->load(scene, textures);
        return renderer->render(frame);
    }
};

// Straight from above onto the ground, 2 m of it.
Frame from_above(std::vector<std::string> aovs)
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = kSize;
    frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = std::move(aovs);
    return frame;
}

Primitive ground()
{
    return quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
}

void flood(Frame& frame)
{
    frame.weather.flood_cracks = 2.0f;
    frame.weather.flood_puddles = 2.0f;
    frame.weather.film_albedo = 1.0f;
    frame.weather.film_smoothness = 1.0f;
}

Texture texture_of(int width, int height, const std::function<glm::ivec4(int, int)>& texel)
{
    Texture texture;
    texture.name = "made up";
    texture.width = width;
    texture.height = height;
    texture.nearest = true;
    texture.mips.emplace_back();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c) {
                texture.mips[0].push_back(static_cast<std::byte>(texel(x, y)[c]));
            }
        }
    }
    return texture;
}

const std::vector<float>& pixels_of(const RenderResult& r, const std::string& name)
{
    for (const AovImage& image : r.aovs) {
        if (image.name == name) return image.pixels;
    }
    throw Error("no AOV " + name, "Ask for it.");
}

// Murk, darkening, dimmed emission and closed occlusion belong to the weather: nothing of them is
// in the dry material, even metres under snow.
TEST_F(Surface, TheMaterialIsWrittenDry)
{
    const std::vector<std::string> dry_aovs{"base_color", "normal",   "metallic", "roughness",
                                            "occlusion",  "emission", "porosity"};
    Material m = plain_material({0.5f, 0.4f, 0.3f}, 0.6f, 0.25f);
    m.emissive = glm::vec3(0.5f);
    m.weather.water_color = {0.1f, 0.9f, 0.1f, 0.9f};
    const Scene scene = scene_of({ground()}, {m});
    Frame frame = from_above(dry_aovs);
    const RenderResult dry = shot(scene, frame);
    flood(frame);
    const RenderResult wet = shot(scene, frame);
    frame.weather.snow_amount = 1.0f;
    frame.weather.frost = 1.0f;
    const RenderResult snowy = shot(scene, frame);
    for (const std::string& name : dry_aovs) {
        EXPECT_EQ(pixels_of(wet, name), pixels_of(dry, name)) << name << " under water";
        EXPECT_EQ(pixels_of(snowy, name), pixels_of(dry, name)) << name << " under snow";
    }
    EXPECT_NE(wet.beauty, dry.beauty);
    EXPECT_NE(snowy.beauty, wet.beauty);
}

// Murky water has the colour it was given, whatever lies below.
TEST_F(Surface, OpaqueWaterHidesTheGround)
{
    Frame frame = from_above({});
    frame.sky.sun_illuminance = 0.0f;
    flood(frame);
    std::vector<glm::vec3> seen;
    for (const float grey : {0.05f, 0.8f}) {
        Material m = plain_material(glm::vec3(grey), 0.9f);
        m.weather.water_color = {0.3f, 0.2f, 0.1f, 1.0f};
        seen.push_back(pixel(shot(scene_of({ground()}, {m}), frame), kSize / 2, kSize / 2));
    }
    EXPECT_NEAR(glm::length(seen[0] - seen[1]) / glm::length(seen[1]), 0.0f, 0.01f);
    EXPECT_GT(seen[0].r, seen[0].b);
}

// A wall under running water, one repeat of the flow map high.
struct Wall {
    Scene scene;
    Frame frame;
};
Wall running_wall()
{
    Wall wall;
    Material m = plain_material(glm::vec3(0.5f));
    m.weather.water_slope_damp = 0.0f;
    m.weather.default_height = 0.0f;
    m.weather.flow_tiling = 2.0f;
    m.weather.flow_speed = 2.0f;
    m.weather.flow_interval_s = 0.01f;
    wall.scene = scene_of({quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0})}, {m});
    wall.frame = from_above({"cover_normal"});
    wall.frame.camera = look({0, 0, 2}, {0, 0, 0});
    wall.frame.camera.orthographic_height_m = 0.5f;
    wall.frame.settings.shelter = false;
    wall.frame.settings.time_s = 0.0;
    flood(wall.frame);
    return wall;
}

// Rows by which the normals of `later` lie lower in the picture than those of `before`.
int rows_down(const RenderResult& before, const RenderResult& later)
{
    int best = 0;
    float least = 1e30f;
    for (int shift = -12; shift <= 12; ++shift) {
        float sum = 0.0f;
        for (int y = 12; y < kSize - 12; ++y) {
            for (int x = 0; x < kSize; ++x) {
                for (int c = 0; c < 2; ++c) {
                    sum += std::abs(aov(later, "cover_normal", x, y + shift, c) -
                                    aov(before, "cover_normal", x, y, c));
                }
            }
        }
        if (sum < least) {
            least = sum;
            best = shift;
        }
    }
    return best;
}

// In a twentieth of the interval a phase runs 0.05 * 2 repeats of half a metre each: 5 cm, 4.8
// rows.
TEST_F(Surface, FlowRunsDownAWall)
{
    Wall wall = running_wall();
    const RenderResult before = shot(wall.scene, wall.frame);
    float varies = 0.0f;
    for (int y = 1; y < kSize; ++y) {
        varies = std::max(varies, std::abs(aov(before, "cover_normal", 20, y, 1) -
                                           aov(before, "cover_normal", 20, 0, 1)));
    }
    EXPECT_GT(varies, 0.02f) << "with height";
    wall.frame.settings.time_s = 0.0005;
    EXPECT_NEAR(rows_down(before, shot(wall.scene, wall.frame)), 5, 1);
}

TEST_F(Surface, FrozenWaterStandsStill)
{
    Wall wall = running_wall();
    wall.frame.weather.freeze_exp = 1.0f;
    const RenderResult before = shot(wall.scene, wall.frame);
    wall.frame.settings.time_s = 0.0005;
    EXPECT_EQ(before.beauty, shot(wall.scene, wall.frame).beauty) << "ice is level: no wave of it moves";
}

// What a material's wetness lets water do.
TEST_F(Surface, WetnessChoosesWhatWaterDoes)
{
    Frame frame = from_above({"water", "cover_normal"});
    flood(frame);
    frame.weather.rain = 1.0f;
    frame.weather.wind_m_s = {6.0f, 0.0f};
    frame.settings.time_s = 0.4;
    frame.look.ripple_tiling *= 0.25f;  // near: the small levels of the map have steps of 8 bits
    const auto roughest = [](const RenderResult& r) {
        float least = 1.0f;
        for (int i = 0; i < kSize; ++i) least = std::min(least, aov(r, "cover_normal", i, i, 1));
        return 1.0f - least;
    };
    std::vector<float> rough;
    std::vector<float> water;
    for (const auto wetness : {scene::Wetness::None, scene::Wetness::Simple,
                               scene::Wetness::Ripples, scene::Wetness::Flow}) {
        Material m = plain_material(glm::vec3(0.5f));
        m.weather.wetness = wetness;
        const RenderResult r = shot(scene_of({ground()}, {m}), frame);
        rough.push_back(roughest(r));
        water.push_back(aov(r, "water", 24, 24));
    }
    EXPECT_EQ(water[0], 0.0f);
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(water[static_cast<std::size_t>(i)], 1.0f, 1e-2f);
    EXPECT_LT(rough[1], 1e-6f) << "simple: flat";
    EXPECT_GT(rough[2], 3e-5f) << "ripples";
    EXPECT_GT(rough[3], 3e-5f) << "flow: wind on flat ground";
}

// Rings of drops lie in the world, seen from above: neither the mesh nor its texture coordinates move them; the
// camera does.
TEST_F(Surface, RingsLieInTheWorld)
{
    Frame frame = from_above({"cover_normal"});
    flood(frame);
    frame.weather.rain = 1.0f;
    frame.settings.time_s = 0.4;
    frame.look.ripple_tiling *= 0.25f;
    Material m = plain_material(glm::vec3(0.5f));
    m.weather.wetness = scene::Wetness::Ripples;
    const auto lean = [](const RenderResult& r, int x, int y) {
        return glm::vec2(aov(r, "cover_normal", x, y, 0), aov(r, "cover_normal", x, y, 2));
    };
    const RenderResult rings = shot(scene_of({ground()}, {m}), frame);
    // By how much leans differ of pixels that lie `right` apart, and how much they lean at all.
    const auto difference = [&](const RenderResult& a, const RenderResult& b, int right) {
        float most = 0.0f;
        for (int y = 0; y < kSize; ++y)
            for (int x = right; x < kSize; ++x)
                most = std::max(most, glm::length(lean(a, x, y) - lean(b, x - right, y)));
        return most;
    };
    float deepest = 0.0f;
    for (int i = 0; i < kSize * kSize; ++i)
        deepest = std::max(deepest, glm::length(lean(rings, i % kSize, i / kSize)));
    ASSERT_GT(deepest, 0.01f);
    const float same = 0.02f * deepest;
    Primitive other = quad({-3.7f, 0, 4.3f}, {9, 0, 0}, {0, 0, -9});
    for (glm::vec2& uv : other.uv0) uv = glm::vec2(3.0f * uv.y + 0.2f, -uv.x);
    EXPECT_LT(difference(shot(scene_of({other}, {m}), frame), rings, 0), same) << "another mesh";
    // 24 pixels a metre.
    frame.camera = look({0.5f, 2, 0}, {0.5f, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    EXPECT_LT(difference(rings, shot(scene_of({ground()}, {m}), frame), 12), same) << "the camera moves over them";
    EXPECT_GT(difference(rings, shot(scene_of({ground()}, {m}), frame), 0), 0.5f * deepest);
    // Each ring is another a moment later; without rain there are none.
    frame.settings.time_s = 0.6;
    EXPECT_GT(difference(rings, shot(scene_of({ground()}, {m}), frame), 12), 0.5f * deepest);
    frame.weather.rain = 0.0f;
    const RenderResult calm = shot(scene_of({ground()}, {m}), frame);
    EXPECT_LT(difference(calm, calm, 1), 1e-4f);
}

// A street's puddle, five metres from an eye: a pixel of 9 mm is an inch long on the ground, and rings of ten centimetres are seen.
// Nobody draws them where it does not rain.
TEST_F(Surface, RingsAreSeenAFewMetresAway)
{
    Frame frame = from_above({"cover_normal"});
    flood(frame);
    frame.settings.time_s = 0.4;
    frame.camera = look({0, 1.7f, 0}, {0, 0, -5}, 0.08f);
    Material m = plain_material(glm::vec3(0.5f));
    m.weather.wetness = scene::Wetness::Ripples;
    const auto deviation = [&](float rain) {
        frame.weather.rain = rain;
        const RenderResult r = shot(scene_of({quad({-2, 0, 0}, {4, 0, 0}, {0, 0, -10})}, {m}), frame);
        const bool drawn = std::any_of(r.passes.begin(), r.passes.end(), [](const PassTime& pass) { return pass.name == "ripple"; });
        EXPECT_EQ(drawn, rain > 0.0f);
        double sum = 0.0;
        for (int i = 0; i < kSize * kSize; ++i) {
            const float x = aov(r, "cover_normal", i % kSize, i / kSize, 0), z = aov(r, "cover_normal", i % kSize, i / kSize, 2);
            sum += static_cast<double>(x * x + z * z);
        }
        return std::sqrt(sum / (kSize * kSize));
    };
    EXPECT_LT(deviation(0.0f), 1e-3);
    const double rings = deviation(1.0f);
    RecordProperty("deviation", std::to_string(rings));
    EXPECT_GT(rings, 0.009);
}

// Of rings what a pixel shows and what it is rough by are one sum, wherever the eye is: those that are too small to be seen make the water rough.
TEST_F(Surface, RingsTooSmallToSeeAreRoughness)
{
    Frame frame = from_above({"cover_normal", "ring_roughness"});
    flood(frame);
    frame.settings.time_s = 0.4;
    Material m = plain_material(glm::vec3(0.5f));
    m.weather.wetness = scene::Wetness::Ripples;
    m.weather.default_height = -1.0f;  // nothing stands out of it: over 50 m the tops of the ground's relief would
    struct Seen {
        double leans = 0.0, rough = 0.0;
    };
    const auto seen = [&](float width_m, float rain, Material of) {
        frame.weather.rain = rain;
        frame.camera.orthographic_height_m = width_m;
        const RenderResult r = shot(scene_of({quad({-30, 0, 30}, {60, 0, 0}, {0, 0, -60})}, {of}), frame);
        Seen sum;
        for (int i = 0; i < kSize * kSize; ++i) {
            const float x = aov(r, "cover_normal", i % kSize, i / kSize, 0), z = aov(r, "cover_normal", i % kSize, i / kSize, 2);
            sum.leans += static_cast<double>(x * x + z * z) / (kSize * kSize);
            sum.rough += std::pow(static_cast<double>(aov(r, "ring_roughness", i % kSize, i / kSize)), 4.0) / (kSize * kSize);
        }
        return sum;
    };
    // A repeat of the map, and ever more of them: pixels of 2.6 mm to a metre.
    const Seen near = seen(1.25f * 0.1f, 1.0f, m), once = seen(1.25f, 1.0f, m);
    EXPECT_LT(near.rough, 0.05 * near.leans) << "close up they are seen";
    const double all = once.leans + once.rough;
    ASSERT_GT(all, 0.0005);
    double rough = 0.0;
    for (const float repeats : {1.0f, 2.0f, 5.0f, 12.0f, 40.0f}) {
        const Seen here = seen(1.25f * repeats, 1.0f, m);
        RecordProperty("at_" + std::to_string(static_cast<int>(repeats)), std::to_string(here.leans) + " " + std::to_string(here.rough));
        EXPECT_NEAR(here.leans + here.rough, all, 0.03 * all) << repeats;
        EXPECT_GE(here.rough, 0.97 * rough) << repeats;
        rough = here.rough;
    }
    RecordProperty("all", std::to_string(all));
    RecordProperty("rough", std::to_string(rough));
    EXPECT_GT(rough, 0.97 * all) << "from afar nothing of them is seen";
    // The harder the rain; none without it, and none of what has no rings.
    EXPECT_LT(seen(15.0f, 0.2f, m).rough, 0.5 * seen(15.0f, 0.6f, m).rough);
    EXPECT_LT(seen(15.0f, 0.6f, m).rough, seen(15.0f, 1.0f, m).rough);
    EXPECT_EQ(seen(15.0f, 0.0f, m).rough, 0.0);
    m.weather.wetness = scene::Wetness::Simple;
    EXPECT_EQ(seen(15.0f, 1.0f, m).rough, 0.0);
}

// Lux's packed map: the puddle mask in red, the height in green.
TEST_F(Surface, OneMapHoldsMaskAndHeight)
{
    const auto packed = texture_of(4, 4, [](int x, int) {
        return x < 2 ? glm::ivec4(255, 51, 7, 7) : glm::ivec4(0, 102, 7, 7);
    });
    Material m = plain_material(glm::vec3(0.5f));
    m.weather.height = {.texture = 0, .channel = scene::Channel::G};
    m.weather.puddle_mask = {.texture = 0, .channel = scene::Channel::R};
    Frame frame = from_above({"water"});
    frame.weather.flood_cracks = 0.5f;
    frame.weather.flood_puddles = 0.7f;
    Primitive floor = quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const RenderResult r = shot(scene_of({floor}, {m}), frame, {packed});
    const auto expected = [](float height, float mask) {
        return shared::water_cover({0.5f, 0.7f}, height, mask, 1.0f, 0.5f).anywhere;
    };
    EXPECT_NEAR(aov(r, "water", 10, 24), expected(0.2f, 1.0f), 0.01f);
    EXPECT_NEAR(aov(r, "water", 38, 24), expected(0.4f, 0.0f), 0.01f);
}

// Chequers with holes, and rings that bend the view of them.
struct Grid {
    Scene scene;
    Frame frame;
    std::vector<Texture> textures;
};
Grid rainy_grid()
{
    Grid grid;
    grid.textures.push_back(texture_of(16, 16, [](int x, int y) {
        return (x + y) % 2 == 0 ? glm::ivec4(200, 200, 200, 255) : glm::ivec4(20, 20, 20, 0);
    }));
    Material m = plain_material(glm::vec3(1.0f));
    m.base_color_texture.texture = 0;
    Primitive floor = quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    grid.scene = scene_of({floor}, {m});
    grid.frame = from_above({"base_color", "depth"});
    flood(grid.frame);
    grid.frame.weather.rain = 1.0f;
    grid.frame.settings.time_s = 0.4;
    grid.frame.look.ripple_refraction = 1.0f;
    grid.frame.look.ripple_tiling *= 0.25f;
    return grid;
}

TEST_F(Surface, RefractionCanBeSwitchedOff)
{
    Grid grid = rainy_grid();
    const RenderResult bent = shot(grid.scene, grid.frame, grid.textures);
    grid.scene.materials[0].weather.ripple_refraction = 0.0f;
    grid.scene.materials[0].weather.flow_refraction = 0.0f;
    const RenderResult straight = shot(grid.scene, grid.frame, grid.textures);
    grid.frame.weather = {};
    const RenderResult dry = shot(grid.scene, grid.frame, grid.textures);
    EXPECT_NE(pixels_of(bent, "base_color"), pixels_of(dry, "base_color"));
    EXPECT_EQ(pixels_of(straight, "base_color"), pixels_of(dry, "base_color"));
}

// The alpha test reads where the surface is, not where water shifts the view to.
TEST_F(Surface, HolesStayWhereTheyAre)
{
    Grid grid = rainy_grid();
    grid.scene.materials[0].alpha_mode = AlphaMode::Mask;
    const RenderResult wet = shot(grid.scene, grid.frame, grid.textures);
    grid.frame.weather = {};
    EXPECT_EQ(pixels_of(wet, "depth"),
              pixels_of(shot(grid.scene, grid.frame, grid.textures), "depth"));
}

TEST_F(Surface, DetailFadesWithDistance)
{
    Grid grid = rainy_grid();
    grid.frame.settings.aovs = {"cover_normal"};
    grid.frame.look.detail_distance_m = 1.0f;  // the camera is 2 m up
    const RenderResult r = shot(grid.scene, grid.frame, grid.textures);
    for (int i = 0; i < kSize; ++i) EXPECT_NEAR(aov(r, "cover_normal", i, i, 1), 1.0f, 1e-5f);
}

// Normals are turned by the inverse transpose: right under any scale, mirrored or not.
TEST_F(Surface, NormalsAreRightUnderNonUniformScale)
{
    const glm::vec3 u(1, 0, 0.3f);
    const glm::vec3 v(0.2f, 0.5f, -1);
    for (const glm::vec3 scale : {glm::vec3(2, 1, 0.4f), glm::vec3(-1.5f, 0.3f, 1)}) {
        Material m = plain_material(glm::vec3(0.5f));
        m.double_sided = true;
        Scene scene = scene_of({quad(-0.5f * (u + v), u, v)}, {m});
        scene.instances[0].to_world = glm::scale(glm::mat4(1.0f), scale);
        Frame frame = from_above({"normal"});
        const RenderResult r = shot(scene, frame);
        const glm::vec3 side = glm::cross(u * scale, v * scale);
        const glm::vec3 expected = glm::normalize(side.y > 0.0f ? side : -side);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(aov(r, "normal", kSize / 2, kSize / 2, c), expected[c], 2e-4f) << scale.x;
        }
    }
}

TEST_F(Surface, FrontFacesCanBeCulled)
{
    Material m = plain_material(glm::vec3(0.5f));
    m.cull_front = true;
    Frame frame = from_above({"depth", "normal"});
    EXPECT_TRUE(std::isinf(aov(shot(scene_of({ground()}, {m}), frame), "depth", 24, 24)));
    const Primitive ceiling = quad({-4, 0, -4}, {8, 0, 0}, {0, 0, 8});  // looks down
    const RenderResult r = shot(scene_of({ceiling}, {m}), frame);
    EXPECT_NEAR(aov(r, "depth", 24, 24), 2.0f, 1e-3f);
    EXPECT_NEAR(aov(r, "normal", 24, 24, 1), 1.0f, 1e-4f) << "towards the eye";
}

}  // namespace
}  // namespace petrichor::gpu
