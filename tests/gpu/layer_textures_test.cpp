// Textures of coats, sheen and other layers: where one is 1 the factor counts, where it is 0 none does.
#include <array>
#include <cmath>
#include <functional>

#include "formulas/light/iridescence.h"
#include "formulas/light/layers.h"
#include "formulas/light/other_lobes.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;

// Left half `low`, right half `high`.
Texture halves(std::array<int, 4> low, std::array<int, 4> high,
               TexelFormat format = TexelFormat::Rgba8Unorm)
{
    Texture texture;
    texture.name = "halves";
    texture.format = format;
    texture.width = texture.height = 16;
    texture.nearest = true;
    texture.mips.emplace_back();
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            for (const int byte : x < 8 ? low : high)
                texture.mips[0].push_back(static_cast<std::byte>(byte));
        }
    }
    return texture;
}

Texture zeros_and_ones(TexelFormat format = TexelFormat::Rgba8Unorm)
{
    return halves({0, 0, 0, 0}, {255, 255, 255, 255}, format);
}

scene::TextureUse first_texture()
{
    scene::TextureUse use;
    use.texture = 0;
    return use;
}

// A plate from above at a slant, in the sun and under the sky.
Frame over_a_plate()
{
    Frame frame;
    frame.camera = look({0, 1.4f, 1.4f}, {0, 0, 0}, 0.7f);
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.exposure = 1e-4f;
    frame.settings.ambient_occlusion = false;
    frame.sky.sun_elevation_rad = 0.9f;
    frame.sky.sun_azimuth_rad = 0.2f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

Scene plate(const Material& material)
{
    return scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {material});
}

class LayerTextures : public GpuTest {
protected:
    RenderResult shot(const Material& material, const std::vector<Texture>& textures = {})
    {
        renderer->load(plate(material), textures);
        return renderer->render(frame);
    }
    Frame frame = over_a_plate();
};

float difference(const glm::vec3& a, const glm::vec3& b)
{
    return glm::length(a - b) / std::max(glm::length(a) + glm::length(b), 1e-6f);
}

struct Share {
    const char* name;
    scene::TextureUse scene::LayerTextures::*texture;
    std::function<void(Material&, float)> factor;
    TexelFormat format = TexelFormat::Rgba8Unorm;
};

TEST_F(LayerTextures, AreSharesOfTheirFactors)
{
    using L = scene::LayerTextures;
    const Share shares[] = {
        {"clearcoat", &L::clearcoat, [](Material& m, float f) { m.clearcoat = f; }},
        {"sheen_color", &L::sheen_color,
         [](Material& m, float f) {
             m.sheen_color = glm::vec3(0.9f, 0.7f, 0.5f) * f;
             m.sheen_roughness = 0.4f;
         },
         TexelFormat::Rgba8Srgb},
        {"diffuse_transmission", &L::diffuse_transmission,
         [](Material& m, float f) { m.diffuse_transmission = 0.8f * f; }},
        {"diffuse_transmission_color", &L::diffuse_transmission_color,
         [](Material& m, float f) {
             m.diffuse_transmission = 0.8f;
             m.diffuse_transmission_color = glm::vec3(0.3f, 0.6f, 0.9f) * f;
         },
         TexelFormat::Rgba8Srgb},
        {"specular", &L::specular, [](Material& m, float f) { m.specular = f; }},
        {"specular_color", &L::specular_color,
         [](Material& m, float f) {
             m.ior = 2.5f;
             m.specular_color = glm::vec3(1.0f, 0.6f, 0.3f) * f;
         },
         TexelFormat::Rgba8Srgb},
        {"iridescence", &L::iridescence,
         [](Material& m, float f) {
             m.metallic = 1.0f;
             m.iridescence = f;
             m.iridescence_thickness_max_nm = 350.0f;
         }},
        {"transmission", &L::transmission, [](Material& m, float f) { m.transmission = 0.9f * f; }},
        {"translucency", &L::translucency,
         [](Material& m, float f) {
             m.translucency = f;
             m.translucency_power = 0.5f;
         }},
        {"skin_curvature", &L::skin_curvature,
         [](Material& m, float f) {
             m.lighting_model = "skin";
             m.skin_curvature = f;
         }},
    };
    for (const Share& share : shares) {
        Material material = plain_material({0.6f, 0.4f, 0.3f}, 0.45f);
        share.factor(material, 0.0f);
        const RenderResult none = shot(material);
        share.factor(material, 1.0f);
        const RenderResult all = shot(material);
        material.maps.*share.texture = first_texture();
        const RenderResult mixed = shot(material, {zeros_and_ones(share.format)});
        float seen = 0.0f;
        for (int y = 8; y < kSize - 8; ++y) {
            for (int x = 8; x < kSize - 8; ++x) {
                if (std::abs(x - kSize / 2) < 2) continue;
                const RenderResult& wanted = x < kSize / 2 ? none : all;
                EXPECT_LT(difference(pixel(mixed, x, y), pixel(wanted, x, y)), 0.004f)
                    << share.name << " at " << x << " " << y;
                seen = std::max(seen, difference(pixel(none, x, y), pixel(all, x, y)));
            }
        }
        EXPECT_GT(seen, 0.01f) << share.name << " shows nothing";
    }
}

// Glossy metal said in either workflow.
TEST_F(LayerTextures, ASpecularWorkflowIsTheSameMaterialToldOtherwise)
{
    const glm::vec3 gold(0.9f, 0.7f, 0.3f);
    const RenderResult metal = shot(plain_material(gold, 0.4f, 1.0f));
    Material told = plain_material(glm::vec3(0.0f), 1.0f, 1.0f);
    told.specular_workflow = true;
    told.workflow_specular = gold;
    told.glossiness = 0.6f;
    const RenderResult workflow = shot(told);
    told.workflow_specular = glm::vec3(1.0f);
    told.glossiness = 1.0f;
    told.maps.specular_glossiness = first_texture();
    const auto code = [](float linear) {
        return static_cast<int>(std::lround(255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055)));
    };
    const std::array<int, 4> texel{code(gold.r), code(gold.g), code(gold.b), 153};
    const RenderResult textured = shot(told, {halves(texel, texel, TexelFormat::Rgba8Srgb)});
    for (int y = 8; y < kSize - 8; y += 3) {
        for (int x = 8; x < kSize - 8; x += 3) {
            EXPECT_LT(difference(pixel(metal, x, y), pixel(workflow, x, y)), 0.01f);
            EXPECT_LT(difference(pixel(metal, x, y), pixel(textured, x, y)), 0.01f);
        }
    }
}

// Lux's combined map: translucency in blue, occlusion in green, of one file.
TEST_F(LayerTextures, OneFileHoldsOcclusionAndTranslucency)
{
    Material leaf = plain_material({0.5f, 0.6f, 0.3f}, 0.7f);
    leaf.translucency = 0.8f;
    leaf.translucency_power = 0.0f;
    leaf.occlusion_texture = first_texture();
    leaf.maps.translucency = first_texture();
    const Texture occlusion = halves({90, 90, 90, 255}, {230, 230, 230, 255});
    const Texture translucency = halves({255, 255, 255, 255}, {40, 40, 40, 255});
    leaf.maps.translucency.texture = 1;
    renderer->load(
        [&] {
            Scene two = plate(leaf);
            two.textures.resize(2);
            return two;
        }(),
        {occlusion, translucency});
    const RenderResult apart = renderer->render(frame);
    leaf.maps.translucency.texture = 0;
    leaf.occlusion_texture.channel = scene::Channel::G;
    leaf.maps.translucency.channel = scene::Channel::B;
    EXPECT_EQ(shot(leaf, {halves({7, 90, 255, 3}, {200, 230, 40, 99})}).beauty, apart.beauty);
    leaf.occlusion_texture.channel = scene::Channel::R;
    EXPECT_NE(shot(leaf, {halves({7, 90, 255, 3}, {200, 230, 40, 99})}).beauty, apart.beauty);
}

// Lux has shaders apart for metal, specular colours and what lets light through; here one material may be all.
TEST_F(LayerTextures, OneMaterialIsSpecularAndTranslucentAtOnce)
{
    frame.sky.sun_azimuth_rad = 3.2f;  // before the eye: it comes through
    Material metal = plain_material({0.6f, 0.5f, 0.3f}, 0.4f);
    metal.double_sided = true;
    const RenderResult opaque = shot(metal);
    metal.translucency = 0.9f;
    metal.translucency_power = 1.0f;
    metal.maps.translucency = first_texture();
    const Texture map = halves({60, 60, 60, 255}, {255, 255, 255, 255});
    const RenderResult wanted = shot(metal, {map});
    Material told = metal;
    told.metallic = 1.0f;  // which this workflow does not ask
    told.roughness = 1.0f;
    told.specular_workflow = true;
    told.workflow_specular = glm::vec3(0.04f);
    told.glossiness = 0.6f;
    const RenderResult got = shot(told, {map});
    float glow = 0.0f;
    for (int y = 8; y < kSize - 8; y += 3) {
        for (int x = 8; x < kSize - 8; x += 3) {
            EXPECT_LT(difference(pixel(got, x, y), pixel(wanted, x, y)), 0.01f);
            glow = std::max(glow, difference(pixel(opaque, x, y), pixel(wanted, x, y)));
        }
    }
    EXPECT_GT(glow, 0.02f);
}

// A coat lies smooth over a bumpy base: its highlight is that of the mesh, or of its own normal map.
TEST_F(LayerTextures, ACoatHasItsOwnNormals)
{
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    Material material = plain_material(glm::vec3(0.0f), 1.0f);
    material.specular = 0.0f;
    material.clearcoat = 1.0f;
    material.clearcoat_roughness = 0.3f;
    const RenderResult plain = shot(material);
    material.normal_texture = first_texture();
    const Texture tilted = halves({200, 128, 230, 255}, {60, 128, 230, 255});
    const RenderResult bumpy_base = shot(material, {tilted});
    material.maps.clearcoat_normal = first_texture();
    const RenderResult bumpy_coat = shot(material, {tilted});
    float same = 0.0f, other = 0.0f;
    for (int y = 8; y < kSize - 8; ++y) {
        for (int x = 8; x < kSize - 8; ++x) {
            same = std::max(same, glm::length(pixel(plain, x, y) - pixel(bumpy_base, x, y)));
            other = std::max(other, glm::length(pixel(plain, x, y) - pixel(bumpy_coat, x, y)));
        }
    }
    const float bright = luminance(pixel(plain, kSize / 2, kSize / 2));
    EXPECT_GT(bright, 0.0f);
    EXPECT_LT(same, 0.02f * bright);
    EXPECT_GT(other, 0.2f * bright);
}

// The direction is the texture's: turned by a quarter, as anisotropy_rotation would.
TEST_F(LayerTextures, AnAnisotropyTextureTurnsTheHighlight)
{
    frame.settings.image_based_light = false;
    Material material = plain_material(glm::vec3(0.9f), 0.3f, 1.0f);
    material.anisotropy = 0.9f;
    const RenderResult along = shot(material);
    material.anisotropy_rotation_rad = 1.5707963f;
    const RenderResult across = shot(material);
    material.anisotropy_rotation_rad = 0.0f;
    material.maps.anisotropy = first_texture();
    // Left along the tangent, right along the bitangent, both at full strength.
    const RenderResult both = shot(material, {halves({255, 128, 255, 255}, {128, 255, 255, 255})});
    float apart = 0.0f;
    for (int y = 8; y < kSize - 8; ++y) {
        for (int x = 8; x < kSize - 8; ++x) {
            if (std::abs(x - kSize / 2) < 2) continue;
            const RenderResult& wanted = x < kSize / 2 ? along : across;
            EXPECT_LT(difference(pixel(both, x, y), pixel(wanted, x, y)), 0.03f) << x << " " << y;
            apart = std::max(apart, difference(pixel(along, x, y), pixel(across, x, y)));
        }
    }
    EXPECT_GT(apart, 0.2f);
}

// Colours behind a body of glass come apart at an edge, red bent least.
TEST_F(LayerTextures, DispersionBendsColoursApart)
{
    Material pane = plain_material(glm::vec3(1.0f), 0.0f);
    pane.transmission = 1.0f;
    pane.thickness = 0.6f;
    pane.ior = 1.6f;
    Material ground = plain_material(glm::vec3(0.0f));
    ground.emissive = glm::vec3(1.0f);
    ground.specular = 0.0f;
    ground.emissive_texture = first_texture();
    frame.settings.exposure = 1.0f;
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.camera = look({0.8f, 1.6f, 0.0f}, {0, 0, 0}, 0.7f);
    const auto fringes = [&](float dispersion) {
        pane.dispersion = dispersion;
        renderer->load(scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0),
                                 quad({-1, 0.5f, 1}, {2, 0, 0}, {0, 0, -2}, 1)},
                                {ground, pane}),
                       {zeros_and_ones(TexelFormat::Rgba8Srgb)});
        const RenderResult r = renderer->render(frame);
        glm::vec3 sum(0.0f);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) sum += pixel(r, x, y);
        }
        return sum;
    };
    const glm::vec3 white = fringes(0.0f);
    const glm::vec3 apart = fringes(20.0f);
    ASSERT_GT(white.r, 1.0f);
    EXPECT_NEAR(white.r, white.b, 0.01f * white.r);
    EXPECT_NEAR(apart.g, white.g, 0.001f * white.g);
    EXPECT_GT(std::abs(apart.r - apart.b), 0.02f * white.r);
    EXPECT_GT((apart.r - apart.g) * (apart.g - apart.b), 0.0f) << "green is between";
}

TEST_F(LayerTextures, AThicknessTextureIsTheBodysDepth)
{
    Material pane = plain_material(glm::vec3(1.0f), 0.0f);
    pane.transmission = 1.0f;
    pane.attenuation_distance_m = 0.5f;
    pane.attenuation_color = {0.2f, 0.5f, 0.9f};
    pane.ior = 1.0f;
    Material ground = plain_material(glm::vec3(0.0f));
    ground.emissive = glm::vec3(1.0f);
    frame.settings.exposure = 1.0f;
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.emissive_lights = false;
    const auto seen = [&](float thickness, bool textured) {
        pane.thickness = thickness;
        pane.maps.thickness = textured ? first_texture() : scene::TextureUse{};
        pane.maps.thickness.channel = scene::Channel::G;
        renderer->load(scene_of({quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0),
                                 quad({-1, 0.1f, 1}, {2, 0, 0}, {0, 0, -2}, 1)},
                                {ground, pane}),
                       {halves({0, 0, 0, 0}, {0, 128, 0, 0})});
        return renderer->render(frame);
    };
    const RenderResult textured = seen(1.0f, true);
    const RenderResult none = seen(0.0f, false);
    const RenderResult half = seen(128.0f / 255.0f, false);
    for (const int y : {16, 24, 32}) {
        EXPECT_LT(difference(pixel(textured, 14, y), pixel(none, 14, y)), 0.01f);
        EXPECT_LT(difference(pixel(textured, 34, y), pixel(half, 34, y)), 0.01f);
    }
    EXPECT_GT(difference(pixel(none, 34, 24), pixel(half, 34, 24)), 0.2f);
}

// Skin's diffuse light sees blurred bumps, its highlight all of them.
TEST_F(LayerTextures, SkinIsSofterThanItsBumps)
{
    frame.settings.image_based_light = false;
    Material skin = plain_material({0.8f, 0.5f, 0.4f}, 1.0f);
    skin.specular = 0.0f;
    skin.lighting_model = "skin";
    skin.skin_curvature = 0.3f;
    skin.normal_texture = first_texture();
    skin.normal_texture.scale = {6.0f, 6.0f};
    Texture bumps = halves({200, 128, 230, 255}, {56, 128, 230, 255});
    bumps.nearest = false;
    // Levels of their own: the mean is flat.
    for (int side = 8; side >= 1; side /= 2) {
        bumps.mips.emplace_back();
        for (int i = 0; i < side * side; ++i) {
            const bool left = side > 1 && i % side < side / 2;
            const int lean = side > 4 ? 72 : side > 2 ? 30 : 0;
            for (const int byte : {128 + (left ? lean : -lean), 128, 250, 255})
                bumps.mips.back().push_back(static_cast<std::byte>(byte));
        }
    }
    const auto contrast = [&](float blur) {
        skin.skin_blur = blur;
        const RenderResult r = shot(skin, {bumps});
        float low = 1e9f, high = 0.0f;
        for (int x = 10; x < kSize - 10; ++x) {
            const float l = luminance(pixel(r, x, kSize / 2));
            low = std::min(low, l);
            high = std::max(high, l);
        }
        return (high - low) / (high + low);
    };
    const float sharp = contrast(0.0f);
    const float soft = contrast(1.0f);
    EXPECT_GT(sharp, 0.02f);
    EXPECT_LT(soft, 0.6f * sharp);
}

TEST_F(LayerTextures, GreenOfTheVerticesIsOcclusionAsFarAsTold)
{
    frame.sky.sun_elevation_rad = -0.02f;  // skylight alone
    frame.settings.exposure = 1e-2f;
    const auto seen = [&](float strength) {
        Material material = plain_material(glm::vec3(0.5f), 1.0f);
        material.vertex_occlusion = strength;
        Scene scene = plate(material);
        scene.meshes[0].primitives[0].colors.assign(4, {1.0f, 0.4f, 1.0f, 1.0f});
        renderer->load(scene, {});
        return pixel(renderer->render(frame), kSize / 2, kSize / 2).r;
    };
    const float open = seen(0.0f);
    EXPECT_LT(seen(1.0f), 0.75f * open);
    EXPECT_LT(seen(0.5f), 0.95f * open);
    EXPECT_GT(seen(0.5f), 0.75f * open);
}

// The same eye, lamps from all sides: each is mirrored in the colour that goes with its own half vector.
TEST_F(LayerTextures, AThinFilmIsColouredByEachLamp)
{
    frame.sky.sun_elevation_rad = -1.0f;
    frame.settings.image_based_light = false;
    frame.settings.width = frame.settings.height = 47;
    const glm::vec3 base(0.6f, 0.55f, 0.5f);
    Material metal = plain_material(base, 0.5f);
    metal.metallic = 1.0f;
    Material filmed = metal;
    filmed.iridescence = 0.8f;
    filmed.iridescence_ior = 1.5f;
    filmed.iridescence_thickness_max_nm = 420.0f;
    const glm::vec3 to_eye = glm::normalize(glm::vec3(0, 1, 1));
    const shared::ThinFilm film{0.8f, 1.5f, 420.0f, base};
    float most = 0.0f, least = 10.0f;
    for (const glm::vec3& way : {glm::vec3(0, 1, -1), glm::vec3(0, 0.3f, -1), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0.7f), glm::vec3(1.5f, 1, 0.5f), glm::vec3(-2, 1, -1)}) {
        const glm::vec3 to_lamp = glm::normalize(way);
        Light lamp;
        lamp.kind = LightKind::Point;
        lamp.position_m = 20.0f * to_lamp;
        lamp.intensity = 1e7f;
        frame.extra_lights = {lamp};
        const float cosine = glm::dot(to_eye, glm::normalize(to_eye + to_lamp));
        const auto lobe = [&](const glm::vec3& f0) {
            return shared::with_all_light(shared::make_lobe({0, 1, 0}, to_eye, glm::vec3(0.0f), f0, 0.25f), 0.5f, shared::lost_along_lobe(0.5f));
        };
        shared::Lobe coloured = lobe(shared::filmed_mean_f0(film));
        coloured.f0 = shared::filmed_f0(film, cosine);
        const glm::vec3 wanted = shared::shade_lobe(coloured, to_lamp) / shared::shade_lobe(lobe(base), to_lamp);
        const glm::vec3 plain(pixel(shot(metal), 23, 23)), seen(pixel(shot(filmed), 23, 23));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / plain[c], wanted[c], 0.03f * wanted[c]) << way.x << " " << way.z << " " << c;
        most = std::max(most, wanted.r / wanted.b);
        least = std::min(least, wanted.r / wanted.b);
    }
    EXPECT_GT(most, 1.5f * least);
}

// Where a grain or strands lie along a tangent, too: of one thickness, and of one that a texture tells.
TEST_F(LayerTextures, AThinFilmIsColouredByEachLampAlongAGrainAndOnHair)
{
    frame.sky.sun_elevation_rad = -1.0f;
    frame.settings.image_based_light = false;
    frame.settings.width = frame.settings.height = 47;
    const glm::vec3 base(0.6f, 0.55f, 0.5f), to_eye = glm::normalize(glm::vec3(0, 1, 1)), up(0, 1, 0);
    const Texture even = halves({128, 128, 128, 255}, {128, 128, 128, 255});
    for (const bool hair : {false, true}) {
        for (const bool textured : {false, true}) {
            Material plain = plain_material(hair ? glm::vec3(0.0f) : base, 0.5f);
            plain.metallic = hair ? 0.0f : 1.0f;
            plain.anisotropy = hair ? 0.0f : 0.6f;
            plain.hair_shift = 0.0f;
            if (hair) plain.lighting_model = "hair";
            Material filmed = plain;
            filmed.iridescence = 0.8f;
            filmed.iridescence_ior = 1.8f;  // not that of hair
            filmed.iridescence_thickness_min_nm = textured ? 100.0f : 20.0f;
            filmed.iridescence_thickness_max_nm = textured ? 740.0f : 420.0f;
            if (textured) filmed.maps.iridescence_thickness = first_texture();
            const shared::ThinFilm film{0.8f, 1.8f, textured ? 100.0f + 640.0f * 128.0f / 255.0f : 420.0f, hair ? glm::vec3(0.04f) : base};
            float most = 0.0f, least = 10.0f;
            for (const glm::vec3& way : {glm::vec3(0, 1, -1), glm::vec3(0, 1, 0), glm::vec3(0.4f, 1, 0.7f), glm::vec3(-0.6f, 1, -1)}) {
                const glm::vec3 to_lamp = glm::normalize(way);
                Light lamp;
                lamp.kind = LightKind::Point;
                lamp.position_m = 20.0f * to_lamp;
                lamp.intensity = 1e7f;
                frame.extra_lights = {lamp};
                const float cosine = glm::dot(to_eye, glm::normalize(to_eye + to_lamp));
                const glm::vec3 at_half = shared::filmed_f0(film, cosine);
                glm::vec3 wanted;
                if (hair) {
                    const glm::vec3 strand(shared::kHairReflectance);
                    wanted = shared::schlick_fresnel(strand + at_half - film.f0, cosine) / shared::schlick_fresnel(strand, cosine);
                } else {
                    shared::Layers layers{};
                    layers.anisotropy = 0.6f;
                    layers.tangent = glm::vec3(1, 0, 0);
                    const auto seen = [&](const glm::vec3& sent_on, const glm::vec3& f0) {
                        shared::Lobe lobe = shared::with_light_along_grain(shared::make_lobe(up, to_eye, glm::vec3(0.0f), sent_on, 0.25f), 0.5f, layers.tangent, 0.6f);
                        lobe.f0 = f0;
                        return shared::shade_layered_lobe(lobe, to_lamp, 0.5f, layers);
                    };
                    wanted = seen(shared::filmed_mean_f0(film), at_half) / seen(base, base);
                }
                const glm::vec3 bare(pixel(shot(plain, {even}), 23, 23)), seen(pixel(shot(filmed, {even}), 23, 23));
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / bare[c], wanted[c], 0.04f * wanted[c]) << hair << textured << " " << way.x << " " << way.z << " " << c;
                most = std::max(most, wanted.r / wanted.b);
                least = std::min(least, wanted.r / wanted.b);
            }
            EXPECT_GT(most, (hair ? 1.04f : 1.3f) * least) << hair << textured;
        }
    }
}

// Where a texture says where it lies, too: on glass, and beside a second lobe (which is as the first here).
TEST_F(LayerTextures, AThinFilmThatATexturePlacesIsColouredByEachLamp)
{
    frame.sky.sun_elevation_rad = -1.0f;
    frame.settings.image_based_light = false;
    frame.settings.width = frame.settings.height = 47;
    const glm::vec3 base(0.6f, 0.55f, 0.5f), to_eye = glm::normalize(glm::vec3(0, 1, 1));
    const std::vector<Texture> textures{halves({160, 64, 0, 255}, {160, 64, 0, 255}), halves({128, 128, 255, 128}, {128, 128, 255, 128})};
    for (const bool glass : {true, false}) {
        Material plain = plain_material(base, 0.5f, 1.0f);
        if (glass) {
            plain.alpha_mode = AlphaMode::Blend;
            plain.base_color.a = 0.7f;
        } else {
            plain.maps.second_lobe.texture = static_cast<scene::TextureIndex>(1);
        }
        Material filmed = plain;
        filmed.iridescence = 0.8f;
        filmed.iridescence_ior = 1.5f;
        filmed.iridescence_thickness_max_nm = 740.0f;
        filmed.maps.iridescence = filmed.maps.iridescence_thickness = first_texture();
        filmed.maps.iridescence_thickness.channel = scene::Channel::G;
        const shared::ThinFilm film{0.8f * 160.0f / 255.0f, 1.5f, 100.0f + 640.0f * 64.0f / 255.0f, base};
        float most = 0.0f, least = 10.0f;
        for (const glm::vec3& way : {glm::vec3(0, 1, -1), glm::vec3(0, 0.3f, -1), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0.7f), glm::vec3(-2, 1, -1)}) {
            const glm::vec3 to_lamp = glm::normalize(way);
            Light lamp;
            lamp.kind = LightKind::Point;
            lamp.position_m = 20.0f * to_lamp;
            lamp.intensity = 1e7f;
            frame.extra_lights = {lamp};
            const auto lobe = [&](const glm::vec3& f0) {
                return shared::with_all_light(shared::make_lobe({0, 1, 0}, to_eye, glm::vec3(0.0f), f0, 0.25f), 0.5f, shared::lost_along_lobe(0.5f));
            };
            shared::Lobe coloured = lobe(shared::filmed_mean_f0(film));
            coloured.f0 = shared::filmed_f0(film, glm::dot(to_eye, glm::normalize(to_eye + to_lamp)));
            const glm::vec3 wanted = shared::shade_lobe(coloured, to_lamp) / shared::shade_lobe(lobe(base), to_lamp);
            const glm::vec3 bare(pixel(shot(plain, textures), 23, 23)), seen(pixel(shot(filmed, textures), 23, 23));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / bare[c], wanted[c], 0.03f * wanted[c]) << glass << " " << way.x << " " << way.z << " " << c;
            most = std::max(most, wanted.r / wanted.b);
            least = std::min(least, wanted.r / wanted.b);
        }
        EXPECT_GT(most, 1.2f * least) << glass;
    }
}

// A panel is mirrored in the colour of where the lobe meets it, which is not its middle: beside as many points as stand for it.
TEST_F(LayerTextures, AThinFilmIsColouredByThePartOfALampThatItMirrors)
{
    frame.sky.sun_elevation_rad = -1.0f;
    frame.settings.image_based_light = false;
    frame.settings.width = frame.settings.height = 47;
    Material filmed = plain_material(glm::vec3(0.6f, 0.55f, 0.5f), 0.4f);
    filmed.metallic = 1.0f;
    filmed.iridescence = 0.9f;
    filmed.iridescence_ior = 1.4f;
    filmed.iridescence_thickness_max_nm = 420.0f;
    Light panel;
    panel.kind = LightKind::Rectangle;
    panel.position_m = glm::vec3(0, 2, 2.0f);
    panel.direction = glm::vec3(0, -1, 0);
    panel.half_u_m = glm::vec3(1.5f, 0, 0);
    panel.half_v_m = glm::vec3(0, 0, 4.0f);
    panel.intensity = 1e5f;
    frame.extra_lights = {panel};
    const glm::vec3 whole(pixel(shot(filmed), 23, 23));
    frame.extra_lights.clear();
    const int across = 8, along = 24;
    for (int i = 0; i < across; ++i) {
        for (int k = 0; k < along; ++k) {
            Light point;
            point.kind = LightKind::Point;
            point.position_m = panel.position_m + panel.half_u_m * (2.0f * (static_cast<float>(i) + 0.5f) / across - 1.0f) +
                               panel.half_v_m * (2.0f * (static_cast<float>(k) + 0.5f) / along - 1.0f);
            point.intensity = panel.intensity * (12.0f * 2.0f / (across * along)) * glm::normalize(point.position_m).y;
            frame.extra_lights.push_back(point);
        }
    }
    const glm::vec3 points(pixel(shot(filmed), 23, 23));
    const glm::vec3 one = whole / luminance(whole), other = points / luminance(points);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[c], other[c], 0.06f) << c << " " << one[0] << " " << one[1] << " " << one[2];
}

}  // namespace
}  // namespace petrichor::gpu
