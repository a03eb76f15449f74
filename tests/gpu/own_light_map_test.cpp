// Light maps that a surface of a user's own decodes: dual ones, directional ones, the standard beside.
#include <algorithm>
#include <cmath>

#include "formulas/light/light_map.h"
#include "tests/gpu/own_text_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr float kScale_lux = 1000.0f;

class OwnLightMap : public OwnTextTest {
protected:
    static std::string example(const std::string& name)
    {
        return std::string(PETRICHOR_SOURCE_DIR) + "/data/shaders/" + name;
    }
    static Texture map_of(const std::vector<glm::u8vec4>& texels)
    {
        Texture texture;
        texture.name = "map";
        texture.format = TexelFormat::Rgba8Unorm;
        texture.width = static_cast<int>(texels.size());
        texture.height = 1;
        texture.nearest = true;
        texture.mips.emplace_back();
        for (const glm::u8vec4& t : texels) {
            for (int c = 0; c < 4; ++c) texture.mips[0].push_back(std::byte{t[c]});
        }
        return texture;
    }
    static Material material(const std::string& surface)
    {
        Material m = plain_material(glm::vec3(0.5f), 1.0f);
        m.surface = surface;
        m.light_map.texture = 0;
        m.light_map_scale = kScale_lux;
        return m;
    }
    // Straight from above, without any other light.
    RenderResult seen(const Material& m, const std::vector<Texture>& maps, float height_m,
                      glm::vec3 aside = glm::vec3(0.0f))
    {
        renderer->load(scene_of({quad({-40, 0, 40}, {80, 0, 0}, {0, 0, -80})}, {m}), maps);
        Frame frame;
        frame.camera = look(glm::vec3(0, height_m, 0.01f) + aside, {0, 0, 0}, 0.1f);
        frame.settings.width = frame.settings.height = 16;
        frame.settings.samples = 1;
        frame.settings.image_based_light = false;
        frame.settings.shadows = false;
        frame.settings.aovs = {"baked_light"};
        frame.sky.sun_illuminance = 0.0f;
        return renderer->render(frame);
    }
    static float lux(const RenderResult& r, int channel = 0)
    {
        return aov(r, "baked_light", 8, 8, channel);
    }
};

constexpr glm::u8vec4 kNear{51, 51, 51, 255}, kFar{204, 204, 204, 255};

TEST_F(OwnLightMap, ADualOneFadesFromNearToFar)
{
    const Material m = material(example("dual_light_map.glsl"));
    const auto map = map_of({kNear, kFar});
    EXPECT_NEAR(lux(seen(m, {map}, 10.0f)), 200.0f, 1.0f);
    EXPECT_NEAR(lux(seen(m, {map}, 30.0f)), 500.0f, 3.0f);
    EXPECT_NEAR(lux(seen(m, {map}, 80.0f)), 800.0f, 1.0f);
    // Without a text of its own a map is one picture.
    const Material plain = material("");
    EXPECT_NEAR(lux(seen(plain, {map_of({kNear, kNear})}, 80.0f)), 200.0f, 1.0f);
}

TEST_F(OwnLightMap, ADirectionalOneFollowsTheNormalMap)
{
    const auto map = map_of({{204, 102, 51, 255}, {204, 102, 51, 255}});
    const glm::vec3 color{0.8f, 0.4f, 0.2f}, sides = color;
    for (const glm::u8vec4 code : {glm::u8vec4(128, 128, 255, 255), glm::u8vec4(196, 128, 236, 255),
                                   glm::u8vec4(100, 210, 221, 255)}) {
        Material m = material(example("directional_light_map.glsl"));
        m.normal_texture.texture = 1;
        const RenderResult r = seen(m, {map, map_of({code})}, 10.0f);
        const glm::vec3 bent = glm::normalize(glm::vec3(code) / 255.0f * 2.0f - 1.0f);
        const glm::vec3 wanted =
            shared::directional_light_map(color, sides, bent) * kScale_lux;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(lux(r, c), wanted[c], 0.02f * wanted[c]) << int{code.x} << " " << c;
    }
}

TEST_F(OwnLightMap, ADirectionalOneIsMirroredWhereItsLightComesFrom)
{
    // All of it from the side +x of the plate, 35 degrees above it.
    const auto map = map_of({{204, 204, 204, 255}, {255, 0, 0, 255}});
    Material m = material(example("directional_light_map.glsl"));
    m.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    m.roughness = 0.3f;
    const glm::vec3 side = shared::light_map_side(0);
    // From the other side everything is the same but the highlight.
    const auto from = [&](float x) {
        return pixel(seen(m, {map}, 0.0f, 10.0f * glm::vec3(x, side.z, 0.0f)), 8, 8).g;
    };
    const float alpha = m.roughness * m.roughness;
    const float power = 2.0f / (alpha * alpha) - 2.0f;
    const float wanted = 0.8f * kScale_lux / 3.14159265f * 0.04f *
                         (power + 8.0f) / 8.0f * side.z;
    EXPECT_NEAR(from(-side.x) - from(side.x), wanted, 0.05f * wanted);
}

// Half of a blended surface is there, before a black one: half of what it sends where it is solid, decoded in the
// standard way or in one's own, bent by a normal map, mirrored to the eye or handed over from a near map to a far one.
TEST_F(OwnLightMap, BlendedSurfacesDecodeAsSolidOnesDo)
{
    const auto two = map_of({{204, 102, 51, 255}, {255, 51, 26, 255}});
    const auto bumps = map_of({{196, 128, 236, 255}});
    for (const std::string& surface : {std::string(), example("directional_light_map.glsl"), example("dual_light_map.glsl")}) {
        Material m = material(surface);
        m.roughness = 0.35f;
        m.normal_texture.texture = 1;
        Material black = plain_material(glm::vec3(0.0f), 1.0f);
        const auto lit = [&](bool blended, glm::vec3 eye, bool mapped) {
            Material plate = m;
            if (blended) {
                plate.alpha_mode = AlphaMode::Blend;
                plate.base_color.a = 0.5f;
            }
            if (!mapped) plate.light_map.texture = kNoTexture;
            renderer->load(scene_of({quad({-40, 0, 40}, {80, 0, 0}, {0, 0, -80}, 0),
                                     quad({-40, -1, 40}, {80, 0, 0}, {0, 0, -80}, 1)},
                                    {plate, black}),
                           {two, bumps});
            Frame frame;
            frame.camera = look(eye, {0, 0, 0}, 0.01f);
            frame.settings.width = frame.settings.height = 16;
            frame.settings.samples = 1;
            frame.settings.shadows = false;
            frame.settings.image_based_light = false;
            frame.sky.sun_illuminance = 0.0f;
            return pixel(renderer->render(frame), 8, 8);
        };
        const glm::vec3 side = shared::light_map_side(0);
        for (const glm::vec3 eye : {10.0f * glm::vec3(-side.x, side.z, 0.02f), 10.0f * glm::vec3(side.x, side.z, 0.02f),
                                    glm::vec3(0.0f, 30.0f, 0.01f)}) {
            const auto solid = lit(false, eye, true), blended = lit(true, eye, true);
            ASSERT_GT(solid.r, 20.0f);
            EXPECT_NEAR(blended.r, 0.5f * solid.r, 0.004f * solid.r) << surface << " " << eye.x;
            EXPECT_NEAR(blended.g, 0.5f * solid.g, 0.004f * solid.g) << surface << " " << eye.x;
            EXPECT_NEAR(blended.b, 0.5f * solid.b, 0.004f * solid.b) << surface << " " << eye.x;
            EXPECT_EQ(lit(true, eye, false).r, 0.0f) << "all of it comes from the map";
        }
        if (surface == example("directional_light_map.glsl")) {
            const float one = lit(true, 10.0f * glm::vec3(-side.x, side.z, 0.02f), true).g;
            const float other = lit(true, 10.0f * glm::vec3(side.x, side.z, 0.02f), true).g;
            EXPECT_GT(std::abs(one - other), 0.05f * std::min(one, other)) << "it knows the eye: " << one << " " << other;
        }
    }
}

// What a white plate under sun and a lamp sends up, without what its map sends.
class MappedShadow : public OwnLightMap {
protected:
    int lamp_shadows = 0;
    int lamp_channel = 0;
    float strength = 1.0f;
    float lit(const Material& m, const Texture& map, float height_m, bool sun, bool lamp)
    {
        renderer->load(scene_of({quad({-40, 0, 40}, {80, 0, 0}, {0, 0, -80})}, {m}), {map});
        Frame frame;
        frame.camera = look(glm::vec3(0, height_m, 0.01f), {0, 0, 0}, 0.002f);
        frame.settings.width = frame.settings.height = 16;
        frame.settings.samples = 1;
        frame.settings.image_based_light = false;
        frame.settings.lamp_shadows = lamp_shadows;
        frame.sky.sun_elevation_rad = 1.2f;
        if (!sun) frame.sky.sun_illuminance = 0.0f;
        frame.sky.sun_shadow_strength = strength;
        if (lamp) {
            Light bulb;
            bulb.kind = LightKind::Point;
            bulb.position_m = {1.0f, 4.0f, 0.0f};
            bulb.intensity = 4.0e5f;
            bulb.mask_channel = lamp_channel;
            bulb.shadow_strength = strength;
            frame.extra_lights = {bulb};
        }
        return pixel(renderer->render(frame), 8, 8).g;
    }
};

TEST_F(MappedShadow, SunAndLampsFadeOutWhereADualMapHoldsThem)
{
    const Material m = material(example("dual_light_map.glsl"));
    const Texture dark = map_of({{0, 0, 0, 255}, {0, 0, 0, 255}});
    for (const bool sun : {true, false}) {
        const float near = lit(m, dark, 10.0f, sun, !sun);
        ASSERT_GT(near, 1000.0f);
        EXPECT_NEAR(lit(m, dark, 30.0f, sun, !sun), 0.5f * near, 0.01f * near);
        EXPECT_EQ(lit(m, dark, 80.0f, sun, !sun), 0.0f);
        // Where nobody says that the map holds them, they stay.
        EXPECT_NEAR(lit(material(""), dark, 80.0f, sun, !sun), near, 0.01f * near);
    }
}

TEST_F(MappedShadow, AMaskTakesTheSunOverWithTheDistanceAndLeavesLamps)
{
    const Material m = material(example("shadow_mask.glsl"));
    // A fifth of the sun is seen, by the map; in real time all of it.
    const Texture map = map_of({{0, 0, 0, 255}, {51, 51, 51, 255}});
    const float near = lit(m, map, 20.0f, true, false);
    ASSERT_GT(near, 1000.0f);
    EXPECT_NEAR(lit(m, map, 45.0f, true, false), 0.6f * near, 0.01f * near);
    EXPECT_NEAR(lit(m, map, 80.0f, true, false), 0.2f * near, 0.01f * near);
    const float lamp = lit(m, map, 20.0f, false, true);
    ASSERT_GT(lamp, 1000.0f);
    EXPECT_NEAR(lit(m, map, 80.0f, false, true), lamp, 0.01f * lamp);
}

TEST_F(MappedShadow, AMaskTakesLampsOverByTheirChannels)
{
    const Material m = material(example("shadow_mask.glsl"));
    for (int channel = 1; channel <= 3; ++channel) {
        lamp_channel = channel;
        glm::u8vec4 code(255);
        code[channel] = 51;
        const Texture map = map_of({{0, 0, 0, 255}, code});
        // A lamp with a shadow in real time: its word near by, the mask's far away.
        lamp_shadows = 1;
        const float all = lit(m, map, 20.0f, false, true);
        ASSERT_GT(all, 1000.0f);
        EXPECT_NEAR(lit(m, map, 45.0f, false, true), 0.6f * all, 0.01f * all) << channel;
        EXPECT_NEAR(lit(m, map, 80.0f, false, true), 0.2f * all, 0.01f * all) << channel;
        // Without one the mask's word counts everywhere.
        lamp_shadows = 0;
        EXPECT_NEAR(lit(m, map, 20.0f, false, true), 0.2f * all, 0.01f * all) << channel;
        // Another channel is not its own, and the sun goes by its own.
        lamp_channel = channel % 3 + 1;
        EXPECT_NEAR(lit(m, map, 80.0f, false, true), all, 0.01f * all) << channel;
        EXPECT_NEAR(lit(m, map, 80.0f, true, false), lit(m, map, 20.0f, true, false), 10.0f);
        // A texture of a material without the text is no mask.
        lamp_channel = channel;
        EXPECT_NEAR(lit(material(""), map_of({{0, 0, 0, 51}, {0, 0, 0, 51}}), 80.0f, false, true), all, 0.01f * all);
    }
    lamp_channel = 0;
    EXPECT_NEAR(lit(m, map_of({{0, 0, 0, 255}, {51, 51, 51, 51}}), 80.0f, false, true),
                lit(material(""), map_of({{0, 0, 0, 255}, {0, 0, 0, 255}}), 80.0f, false, true), 1.0f)
        << "a lamp without a channel";
}

// A fifth of them is seen, by the mask; shadows of half the strength leave six tenths.
TEST_F(MappedShadow, OfWeakShadowsAMaskTakesItsShare)
{
    const Texture map = map_of({{0, 0, 0, 255}, {51, 51, 51, 51}});
    Material m = material(example("shadow_mask.glsl"));
    lamp_channel = 2;
    for (const int maps : {0, 1}) {
        lamp_shadows = maps;
        for (const bool sun : {true, false}) {
            strength = 0.0f;
            const float all = lit(m, map, 80.0f, sun, !sun);
            ASSERT_GT(all, 1000.0f);
            strength = 0.5f;
            EXPECT_NEAR(lit(m, map, 80.0f, sun, !sun), 0.6f * all, 0.01f * all) << maps << sun;
            strength = 1.0f;
            EXPECT_NEAR(lit(m, map, 80.0f, sun, !sun), 0.2f * all, 0.01f * all) << maps << sun;
            m.receives_shadows = false;
            EXPECT_NEAR(lit(m, map, 80.0f, sun, !sun), all, 0.01f * all) << maps << sun;
            m.receives_shadows = true;
        }
    }
}

TEST(LightMapSides, AreSquareToEachOtherAndEvenLightIsLight)
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            EXPECT_NEAR(glm::dot(shared::light_map_side(i), shared::light_map_side(j)),
                        i == j ? 1.0f : 0.0f, 1e-6f);
        }
    }
    const glm::vec3 even(0.57735027f), up(0.0f, 0.0f, 1.0f);
    EXPECT_NEAR(shared::directional_light_map(glm::vec3(1.0f), even, up).x, 1.0f, 1e-6f);
    EXPECT_NEAR(shared::light_map_direction(even).z, 1.0f, 1e-6f);
    EXPECT_EQ(shared::light_map_fade(10.0f, 20.0f, 40.0f), 0.0f);
    EXPECT_EQ(shared::light_map_fade(50.0f, 20.0f, 40.0f), 1.0f);
}

}  // namespace
}  // namespace petrichor::gpu
