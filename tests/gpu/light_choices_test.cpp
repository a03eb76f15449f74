// Light maps, occlusion of direct light, colours as codes: their laws, on plates that reflect alike
// in all directions.
#include "formulas/color/srgb.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr float kPi = 3.14159265f;

class LightChoices : public GpuTest {};

Texture map_of(TexelFormat format, std::vector<std::vector<std::uint8_t>> texels)
{
    Texture texture;
    texture.name = "map";
    texture.format = format;
    texture.width = static_cast<int>(texels.size());
    texture.height = 1;
    texture.nearest = true;
    texture.mips.emplace_back();
    for (const auto& texel : texels) {
        for (const std::uint8_t byte : texel) texture.mips[0].push_back(std::byte{byte});
    }
    return texture;
}

Material diffuser(float albedo)
{
    Material m = plain_material(glm::vec3(albedo), 1.0f);
    m.lighting_model = "lambert";
    return m;
}

// Seen from above, without any light.
Frame dark()
{
    Frame frame;
    frame.camera = look({0, 4, 0.1f}, {0, 0, 0}, 0.3f);
    frame.settings.width = frame.settings.height = 16;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.settings.exposure = 1e-3f;
    frame.sky.sun_illuminance = 0.0f;
    return frame;
}

Frame lamp_lit()
{
    Frame frame = dark();
    Light lamp;
    lamp.intensity = 1600.0f;
    lamp.position_m = {0.0f, 4.0f, 0.0f};
    frame.extra_lights = {lamp};
    return frame;
}

float grey(const RenderResult& result)
{
    return pixel(result, 8, 8).g;
}

Primitive plate()
{
    return quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
}

// A texel of 51 / 255 at 1000 lux a unit: 200 lux on a diffuser of 0.5.
TEST_F(LightChoices, ALightMapIsIrradiance)
{
    Material m = diffuser(0.5f);
    m.light_map.texture = 0;
    m.light_map_scale = 1000.0f;
    renderer->load(scene_of({plate()}, {m}),
                   {map_of(TexelFormat::Rgba8Unorm, {{51, 51, 51, 255}})});
    Frame frame = dark();
    frame.settings.aovs = {"baked_light"};
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        frame.settings.surface_path = path;
        const RenderResult result = renderer->render(frame);
        EXPECT_NEAR(grey(result), 200.0f * 0.5f / kPi, 0.2f);  // colours have 8 bits
        EXPECT_NEAR(aov(result, "baked_light", 8, 8), 200.0f, 0.3f);
    }
}

TEST_F(LightChoices, ALightMapLiesOnTheSecondCoordinates)
{
    Primitive p = plate();
    p.uv0.assign(4, {0.25f, 0.5f});
    Material m = diffuser(0.5f);
    m.light_map.texture = 0;
    m.light_map_scale = 1000.0f;
    const auto two = map_of(TexelFormat::Rgba8Unorm, {{51, 51, 51, 255}, {102, 102, 102, 255}});
    renderer->load(scene_of({p}, {m}), {two});
    const float first = grey(renderer->render(dark()));
    p.uv1.assign(4, {0.75f, 0.5f});
    renderer->load(scene_of({p}, {m}), {two});
    EXPECT_NEAR(grey(renderer->render(dark())) / first, 2.0f, 0.01f);
}

// Wet ground darkens under baked light as it does under a lamp.
TEST_F(LightChoices, WeatherDarkensBakedLightAsAnyOther)
{
    Material m = diffuser(0.4f);
    m.weather.porosity = 1.0f;
    const auto ratio = [&](Frame frame, const Material& material, const std::vector<Texture>& maps) {
        renderer->load(scene_of({plate()}, {material}), maps);
        const float dry = grey(renderer->render(frame));
        frame.weather.film_albedo = 0.85f;
        const float wet = grey(renderer->render(frame));
        return wet / dry;
    };
    const float under_lamp = ratio(lamp_lit(), m, {});
    m.light_map.texture = 0;
    m.light_map_scale = 1000.0f;
    const float under_map =
        ratio(dark(), m, {map_of(TexelFormat::Rgba8Unorm, {{51, 51, 51, 255}})});
    EXPECT_LT(under_lamp, 0.8f);
    EXPECT_NEAR(under_map, under_lamp, 0.01f);
}

// A map that holds the sky already takes its share of skylight away.
TEST_F(LightChoices, ALightMapMayHoldTheSky)
{
    renderer->set_environment(constant_environment(100.0f));
    Frame frame = dark();
    frame.settings.image_based_light = true;
    frame.settings.ambient_occlusion = false;
    Material m = diffuser(0.5f);
    m.light_map.texture = 0;
    m.light_map_scale = 0.0f;
    float seen[3];
    const float shares[] = {1.0f, 0.5f, 0.0f};
    for (int i = 0; i < 3; ++i) {
        m.light_map_sky = shares[i];
        renderer->load(scene_of({plate()}, {m}),
                       {map_of(TexelFormat::Rgba8Unorm, {{51, 51, 51, 255}})});
        seen[i] = grey(renderer->render(frame));
    }
    EXPECT_NEAR(seen[0], 50.0f, 1.0f);
    EXPECT_NEAR(seen[1], 25.0f, 0.5f);
    EXPECT_NEAR(seen[2], 0.0f, 0.1f);
}

// 102 / 255: 0.4 of the light comes through; 0.7 at half the strength.
TEST_F(LightChoices, OcclusionDarkensDirectLightOnlyByChoice)
{
    Material m = diffuser(0.5f);
    renderer->load(scene_of({plate()}, {m}), {});
    const float open = grey(renderer->render(lamp_lit()));
    m.occlusion_texture.texture = 0;
    const auto map = map_of(TexelFormat::R8Unorm, {{102}});
    const auto seen = [&](float strength, float direct) {
        m.occlusion_strength = strength;
        renderer->load(scene_of({plate()}, {m}), {map});
        Frame frame = lamp_lit();
        frame.settings.occlusion_direct = direct;
        return grey(renderer->render(frame)) / open;
    };
    EXPECT_NEAR(seen(1.0f, 0.0f), 1.0f, 1e-3f);
    EXPECT_NEAR(seen(1.0f, 1.0f), 0.4f, 1e-2f);
    EXPECT_NEAR(seen(1.0f, 0.5f), 0.7f, 1e-2f);
    EXPECT_NEAR(seen(0.5f, 1.0f), 0.7f, 1e-2f);
    EXPECT_NEAR(seen(0.0f, 1.0f), 1.0f, 1e-2f);
    // Of the sky it always takes its share.
    renderer->set_environment(constant_environment(100.0f));
    Frame frame = dark();
    frame.settings.image_based_light = true;
    frame.settings.ambient_occlusion = false;
    m.occlusion_strength = 1.0f;
    renderer->load(scene_of({plate()}, {m}), {map});
    EXPECT_LT(grey(renderer->render(frame)), 0.75f * 50.0f);
}

// In gamma space an albedo of 0.5 counts as its code, and what comes out is shown as it is.
TEST_F(LightChoices, GammaLightsCodesAndShowsThem)
{
    renderer->load(scene_of({plate()}, {diffuser(0.5f)}), {});
    Frame frame = lamp_lit();
    frame.settings.exposure = 0.01f;
    const RenderResult linear = renderer->render(frame);
    frame.settings.gamma = true;
    const RenderResult gamma = renderer->render(frame);
    const float code = shared::srgb_from_linear(0.5f);
    EXPECT_NEAR(grey(gamma) / grey(linear), code / 0.5f, 5e-3f);
    const int shown = gamma.display[(8 * 16 + 8) * 4 + 1];
    EXPECT_NEAR(shown, 255.0f * 0.01f * grey(gamma), 1.5f);
}

}  // namespace
}  // namespace petrichor::gpu
