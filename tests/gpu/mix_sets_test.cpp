// Two sets of textures on a material: which of them is seen where, and what is only the first one's.
#include <cmath>
#include <functional>

#include "formulas/weather/mix_sets.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;
constexpr float kFirst = 0.2f;
constexpr float kSecond = 0.8f;

Texture texture_of(const std::function<glm::ivec4(int, int)>& texel, int size = 8)
{
    Texture texture;
    texture.name = "made up";
    texture.width = texture.height = size;
    texture.nearest = true;
    texture.mips.emplace_back();
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (int c = 0; c < 4; ++c)
                texture.mips[0].push_back(static_cast<std::byte>(texel(x, y)[c]));
        }
    }
    return texture;
}

Texture even(int code)
{
    return texture_of([=](int, int) { return glm::ivec4(code, code, code, 255); });
}

class MixSets : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame, const std::vector<Texture>& textures = {})
    {
        renderer->load(scene, textures);
        return renderer->render(frame);
    }
};

// 2 m of ground straight from above.
Frame from_above(std::vector<std::string> aovs)
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = std::move(aovs);
    return frame;
}

// Red of _WEATHER runs from `left` at x = -1 to `right` at x = 1.
Primitive ground(float left = 1.0f, float right = 1.0f)
{
    Primitive p = quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    p.weather = {{left, 1, 1, 1}, {right, 1, 1, 1}, {right, 1, 1, 1}, {left, 1, 1, 1}};
    return p;
}

Material mixed()
{
    Material m = plain_material(glm::vec3(kFirst), 0.3f);
    m.second.use = scene::SecondSetUse::Mix;
    m.second.color = glm::vec3(kSecond);
    m.second.roughness = 0.9f;
    m.second.metallic = 0.0f;
    return m;
}

float mean(const RenderResult& r, const std::string& name, int channel = 0)
{
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) sum += static_cast<double>(aov(r, name, x, y, channel));
    }
    return static_cast<float>(sum / (kSize * kSize));
}

TEST_F(MixSets, RedOfTheVerticesChooses)
{
    const RenderResult r =
        shot(scene_of({ground(0.0f, 1.0f)}, {mixed()}), from_above({"base_color", "roughness"}));
    for (const int x : {0, 12, 24, 36, 47}) {
        const float first = (static_cast<float>(x) + 0.5f) / kSize;
        EXPECT_NEAR(aov(r, "base_color", x, 20), first * kFirst + (1 - first) * kSecond, 0.01f);
        EXPECT_NEAR(aov(r, "roughness", x, 20), first * 0.3f + (1 - first) * 0.9f, 0.01f);
    }
}

TEST_F(MixSets, ASetThatIsUnusedOrOfNoShareChangesNothing)
{
    const Frame frame = from_above({});
    const auto plain = shot(scene_of({ground()}, {plain_material(glm::vec3(kFirst), 0.3f)}), frame);
    Material unused = mixed();
    unused.second.use = scene::SecondSetUse::None;
    EXPECT_EQ(shot(scene_of({ground()}, {unused}), frame).beauty, plain.beauty);
    EXPECT_EQ(shot(scene_of({ground()}, {mixed()}), frame).beauty, plain.beauty);
}

// The mask and what it is multiplied with; heights sharpen it as the formula says.
TEST_F(MixSets, MasksAndHeightsShareAsTheFormulaDoes)
{
    for (const glm::ivec3 codes : {glm::ivec3(128, 255, 0), glm::ivec3(128, 128, 160),
                                   glm::ivec3(150, 60, 100), glm::ivec3(255, 0, 255)}) {
        Material m = mixed();
        m.second.mix_factor = 0.9f;
        m.second.mix_mask.texture = 0;
        m.weather.height.texture = 1;
        m.second.height.texture = 2;
        const auto r = shot(scene_of({ground()}, {m}), from_above({"base_color"}),
                            {even(codes.x), even(codes.y), even(codes.z)});
        const glm::vec3 v = glm::vec3(codes) / 255.0f;
        const glm::vec2 shares = shared::mix_by_height(0.9f * v.x, {v.y, v.z});
        EXPECT_NEAR(mean(r, "base_color"), shares.x * kFirst + shares.y * kSecond, 0.01f)
            << codes.x << ' ' << codes.y << ' ' << codes.z;
    }
    EXPECT_GT(shared::mix_by_height(0.5f, {0.8f, 0.4f}).x, 0.9f) << "sharper than the mask";
    EXPECT_FLOAT_EQ(shared::mix_by_height(0.5f, {0.0f, 0.0f}).x, 0.5f);
    EXPECT_GT(shared::mix_by_height(1.0f, {0.0f, 1.0f}).x, 0.99f) << "nothing of what has no share";
}

// Lux keeps the second set's occlusion in the alpha of its colours.
TEST_F(MixSets, OcclusionOfTheSecondSetMayLieInItsAlpha)
{
    Material m = mixed();
    m.second.base_color_texture.texture = 0;
    m.second.metallic_roughness_texture.texture = 1;
    const std::vector<Texture> textures = {
        texture_of([](int x, int) { return glm::ivec4(255, 255, 255, x < 4 ? 51 : 204); }),
        texture_of([](int, int) { return glm::ivec4(128, 255, 255, 255); })};
    const Scene scene = scene_of({ground(0.25f, 0.25f)}, {m});
    const auto packed = shot(scene, from_above({"occlusion", "base_color"}), textures);
    EXPECT_NEAR(aov(packed, "occlusion", 6, 20), 0.25f + 0.75f * 128.0f / 255.0f, 0.01f);
    m.second.occlusion_in_alpha = true;
    const auto alpha = shot(scene_of({ground(0.25f, 0.25f)}, {m}), from_above({"occlusion", "base_color"}), textures);
    EXPECT_NEAR(aov(alpha, "occlusion", 6, 20), 0.25f + 0.75f * 0.2f, 0.01f);
    EXPECT_NEAR(aov(alpha, "occlusion", 40, 20), 0.25f + 0.75f * 0.8f, 0.01f);
    EXPECT_NEAR(aov(alpha, "base_color", 6, 20), aov(packed, "base_color", 6, 20), 0.001f);
}

// Fibres of either set: where it is alone they are as those of a material of one set, between they are mixed.
TEST_F(MixSets, EachSetHasItsOwnFibres)
{
    Frame frame = from_above({});
    frame.camera = look({0, 0.6f, 2}, {0, 0, 0});
    frame.camera.orthographic_height_m = 0.4f;
    frame.weather.visibility_m = 1e9f;
    frame.settings.exposure = 1e-4f;
    Material velvet = mixed();
    velvet.second.color = glm::vec3(kFirst);
    velvet.second.roughness = velvet.roughness;
    velvet.scatter_color = {0.5f, 0.1f, 0.1f};
    velvet.scatter_power = 3.0f;
    velvet.second.scatter_color = {0.05f, 0.1f, 0.6f};
    velvet.second.scatter_bias = 0.3f;
    velvet.second.scatter_power = 9.0f;
    const auto seen = [&](const Material& m, float share) {
        return pixel(shot(scene_of({ground(share, share)}, {m}), frame), kSize / 2, kSize / 2);
    };
    Material one = velvet;
    one.second.use = scene::SecondSetUse::None;
    Material other = one;
    other.scatter_color = velvet.second.scatter_color;
    other.scatter_bias = velvet.second.scatter_bias;
    other.scatter_power = velvet.second.scatter_power;
    const glm::vec3 first = seen(one, 1.0f), second = seen(other, 1.0f);
    EXPECT_GT(first.r, 1.2f * second.r);
    EXPECT_GT(second.b, 1.2f * first.b);
    const glm::vec3 half = seen(velvet, 0.5f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen(velvet, 1.0f)[c], first[c], 0.005f * first[c]);
        EXPECT_NEAR(seen(velvet, 0.0f)[c], second[c], 0.005f * second[c]);
    }
    EXPECT_LT(half.r, first.r);
    EXPECT_GT(half.r, second.r);
    EXPECT_LT(half.b, second.b);
    EXPECT_GT(half.b, first.b);
    // Black fibres of the first set leave those of the second.
    velvet.scatter_color = glm::vec3(0.0f);
    EXPECT_GT(seen(velvet, 0.0f).b, 1.2f * seen(velvet, 1.0f).b);
}

// .. and glows with the first set alone, as Lux's.
TEST_F(MixSets, TheGlowFromBehindIsOfTheFirstSet)
{
    Frame frame = from_above({});
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.sky.analytic_sun = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.settings.exposure = 1.0f;
    Light below;
    below.kind = LightKind::Directional;
    below.intensity = 1000.0f;
    below.direction = {0, 1, 0};
    frame.extra_lights = {below};
    Material leaf = mixed();
    leaf.second.color = glm::vec3(kFirst);
    leaf.translucency = 0.5f;
    leaf.translucency_distortion = 0.0f;
    const auto seen = [&](float share) {
        return pixel(shot(scene_of({ground(share, share)}, {leaf}), frame), kSize / 2, kSize / 2).g;
    };
    const float all = seen(1.0f);
    EXPECT_GT(all, 1.0f);
    EXPECT_NEAR(seen(0.5f), 0.5f * all, 0.02f * all);
    EXPECT_NEAR(seen(0.0f), 0.0f, 0.001f * all);
}

int edges(const RenderResult& r)
{
    int count = 0;
    for (int x = 1; x < kSize; ++x) {
        count += std::abs(aov(r, "base_color", x, 20) - aov(r, "base_color", x - 1, 20)) > 0.2f;
    }
    return count;
}

// Left half black, right half white: an edge in the middle of each repeat and one between two.
TEST_F(MixSets, TilingsAndCoordinatesAreTheirOwn)
{
    const Texture halves = texture_of([](int x, int) { return glm::ivec4(x < 4 ? 0 : 255); });
    Material m = mixed();
    m.second.mix_factor = 0.0f;
    m.second.base_color_texture.texture = 0;
    const Frame frame = from_above({"base_color"});
    EXPECT_EQ(edges(shot(scene_of({ground()}, {m}), frame, {halves})), 1);
    m.second.tiling = {3.0f, 1.0f};
    EXPECT_EQ(edges(shot(scene_of({ground()}, {m}), frame, {halves})), 5);
    m.second.tiling = {1.0f, 1.0f};
    m.second.base_color_texture.texcoord = 1;
    Primitive p = ground();
    for (const glm::vec2& uv : p.uv0) p.uv1.push_back(uv * 2.0f);
    EXPECT_EQ(edges(shot(scene_of({p}, {m}), frame, {halves})), 3);
    Material masked = mixed();
    masked.second.mix_mask.texture = 0;
    masked.second.mix_mask_tiling = {2.0f, 1.0f};
    EXPECT_EQ(edges(shot(scene_of({ground()}, {masked}), frame, {halves})), 3);
}

// A normal map over the second coordinates leans where those run, whatever the first do.
TEST_F(MixSets, NormalsFollowTheirCoordinates)
{
    Material m = mixed();
    m.second.mix_factor = 0.0f;
    m.second.normal_texture.texture = 0;
    m.second.normal_texture.texcoord = 1;
    // Leans along u.
    const Texture leaning = texture_of([](int, int) { return glm::ivec4(200, 128, 255, 255); });
    Primitive p = ground();
    for (const glm::vec2& uv : p.uv0) p.uv1.emplace_back(-uv.y, uv.x);  // u runs to the eye, +z
    const auto r = shot(scene_of({p}, {m}), from_above({"normal"}), {leaning});
    const float lean = 2.0f * 200.0f / 255.0f - 1.0f;
    EXPECT_NEAR(mean(r, "normal", 0), 0.0f, 0.02f);
    EXPECT_NEAR(mean(r, "normal", 2), lean, 0.02f);
    p.uv1 = p.uv0;
    EXPECT_NEAR(mean(shot(scene_of({p}, {m}), from_above({"normal"}), {leaning}), "normal", 0), lean,
                0.02f);
}

// Depth follows the mixed height: it looks like ground that lies as deep.
TEST_F(MixSets, TheReliefIsMixedWhereTheRayMeetsIt)
{
    const float scale_m = 0.4f;
    const auto seen = [&](float y, scene::Parallax parallax, int first, int second, int mask) {
        Material m = plain_material(glm::vec3(1.0f));
        m.base_color_texture.texture = 0;
        m.second.use = scene::SecondSetUse::Mix;
        m.second.base_color_texture.texture = 0;
        m.base_color_texture.scale = m.second.base_color_texture.scale = glm::vec2(8.0f);
        m.second.metallic = 0.0f;
        m.second.mix_mask.texture = 3;
        m.weather.height.texture = 1;
        m.second.height.texture = 2;
        m.weather.parallax = parallax;
        m.weather.height_scale_m = scale_m;
        Frame frame = from_above({"base_color"});
        frame.camera = look({0.9f, 2.6f, 0.0f}, {0, 0, 0}, 0.25f);
        Texture ramp =
            texture_of([](int x, int) { return glm::ivec4(2 * x, 2 * x, 2 * x, 255); }, 128);
        ramp.nearest = false;
        return shot(scene_of({quad({-2, y, 2}, {4, 0, 0}, {0, 0, -4})}, {m}), frame,
                    {ramp, even(first), even(second), even(mask)});
    };
    const auto alike = [](const RenderResult& a, const RenderResult& b) {
        int count = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                count += std::abs(aov(a, "base_color", x, y) - aov(b, "base_color", x, y)) < 0.03f;
            }
        }
        return static_cast<double>(count) / (kSize * kSize);
    };
    for (const glm::ivec3 codes :
         {glm::ivec3(255, 0, 0), glm::ivec3(60, 200, 255), glm::ivec3(120, 160, 128)}) {
        const glm::vec3 v = glm::vec3(codes) / 255.0f;
        const glm::vec2 shares = shared::mix_by_height(v.z, {v.x, v.y});
        const float height = shares.x * v.x + shares.y * v.y;
        const auto lowered = seen(-(1.0f - height) * scale_m, scene::Parallax::None, codes.x, codes.y,
                                  codes.z);
        for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion}) {
            const auto sunk = seen(0.0f, parallax, codes.x, codes.y, codes.z);
            EXPECT_GT(alike(sunk, lowered), 0.85) << codes.x << ' ' << codes.y << ' ' << codes.z;
        }
        EXPECT_LT(alike(seen(0.0f, scene::Parallax::None, codes.x, codes.y, codes.z), lowered), 0.6);
    }
}

// Alpha and emission are the first set's, whatever its share.
TEST_F(MixSets, AlphaAndEmissionAreOfTheFirstSet)
{
    Material m = mixed();
    m.base_color.a = 0.4f;
    m.alpha_mode = AlphaMode::Mask;
    m.emissive = glm::vec3(0.5f);
    m.second.mix_factor = 0.0f;
    m.second.base_color_texture.texture = 0;
    const Frame frame = from_above({"emission", "base_color"});
    EXPECT_EQ(mean(shot(scene_of({ground()}, {m}), frame, {even(255)}), "base_color"), 0.0f);
    m.base_color.a = 0.6f;
    const auto there = shot(scene_of({ground()}, {m}), frame, {even(0)});
    EXPECT_NEAR(mean(there, "emission"), 0.5f, 0.01f);
    EXPECT_NEAR(mean(there, "base_color"), 0.0f, 0.01f);
}

// Light that passes through is dimmed with the share of the first set.
TEST_F(MixSets, LightThatPassesIsOfTheFirstSet)
{
    Material leaf = mixed();
    leaf.second.color = glm::vec3(kFirst);
    leaf.second.roughness = leaf.roughness;
    leaf.diffuse_transmission = 0.8f;
    leaf.double_sided = true;
    Frame frame = from_above({});
    frame.sky.sun_elevation_rad = -0.6f;
    frame.sky.sun_illuminance = 0.0f;
    Scene scene = scene_of({ground()}, {leaf});
    scene::Light lamp;
    lamp.intensity = 100.0f;
    lamp.position_m = {0, -1, 0};
    scene.lights.push_back(lamp);
    frame.settings.exposure = 1.0f;
    const float all = luminance(pixel(shot(scene, frame), 24, 24));
    scene.materials[0].second.mix_factor = 0.5f;
    const float half = luminance(pixel(shot(scene, frame), 24, 24));
    EXPECT_GT(all, 0.5f);
    EXPECT_NEAR(half / all, 0.5f, 0.08f);
    // .. wet or dry: the share is kept beside the weather.
    frame.weather.film_albedo = 0.01f;
    EXPECT_NEAR(luminance(pixel(shot(scene, frame), 24, 24)), half, 0.05f * half);
}

// Water of its own: where it stands, and its colour. Without, that of the first set.
TEST_F(MixSets, TheSecondSetMayHaveItsOwnWater)
{
    Material m = mixed();
    m.weather.water_accumulation = glm::vec4(0.0f);
    m.second.water_accumulation = {2.0f, 0.0f, 2.0f, 0.0f};
    m.second.water_color = {0.6f, 0.1f, 0.1f, 1.0f};
    m.weather.water_color = {0.1f, 0.1f, 0.6f, 1.0f};
    const Scene same = scene_of({ground(0.0f, 1.0f)}, {m});
    EXPECT_EQ(mean(shot(same, from_above({"water"})), "water"), 0.0f);
    m.second.own_water = true;
    Scene own = scene_of({ground(0.0f, 1.0f)}, {m});
    const auto r = shot(own, from_above({"water"}));
    EXPECT_GT(aov(r, "water", 1, 20), 0.95f);
    EXPECT_LT(aov(r, "water", 46, 20), 0.1f);
    const glm::vec3 red = pixel(r, 1, 20);
    EXPECT_GT(red.r, 2.0f * red.b);
    own.materials[0].weather.water_accumulation = {2.0f, 0.0f, 2.0f, 0.0f};
    const glm::vec3 blue = pixel(shot(own, from_above({})), 46, 20);
    EXPECT_GT(blue.b, 2.0f * blue.r);
}

// sRGB 0.5 leaves a colour as it is, white is four and a half times as bright, and the mask says where.
TEST_F(MixSets, DetailDoublesCodesWhereItsMaskIs)
{
    Material m = plain_material(glm::vec3(kFirst), 0.3f);
    m.second.use = scene::SecondSetUse::Detail;
    m.second.base_color_texture.texture = 0;
    const auto color_texture = [](int code) {
        Texture t = even(code);
        t.format = TexelFormat::Rgba8Srgb;
        return t;
    };
    const Frame frame = from_above({"base_color"});
    EXPECT_NEAR(mean(shot(scene_of({ground()}, {m}), frame, {color_texture(128)}), "base_color"),
                kFirst, 0.006f);
    EXPECT_NEAR(mean(shot(scene_of({ground()}, {m}), frame, {color_texture(255)}), "base_color"),
                4.672f * kFirst, 0.01f);
    EXPECT_NEAR(mean(shot(scene_of({ground()}, {m}), frame, {color_texture(0)}), "base_color"), 0.0f,
                0.01f);
    m.second.mix_mask.texture = 1;
    m.second.mix_mask.channel = scene::Channel::A;
    const Texture half = texture_of([](int x, int) { return glm::ivec4(9, 9, 9, x < 4 ? 255 : 0); });
    const auto r = shot(scene_of({ground()}, {m}), frame, {color_texture(0), half});
    EXPECT_NEAR(aov(r, "base_color", 10, 20), 0.0f, 0.01f);
    EXPECT_NEAR(aov(r, "base_color", 40, 20), kFirst, 0.01f);
    Frame afar = frame;
    afar.look.detail_distance_m = 1.0f;
    EXPECT_NEAR(mean(shot(scene_of({ground()}, {m}), afar, {color_texture(0), half}), "base_color"),
                kFirst, 0.005f);
}

TEST_F(MixSets, DetailNormalsAddTheirSlopes)
{
    Material m = plain_material(glm::vec3(kFirst), 0.3f);
    m.second.use = scene::SecondSetUse::Detail;
    m.normal_texture.texture = 0;
    m.second.normal_texture.texture = 1;
    const auto lean = [](int r, int g) {
        return texture_of([=](int, int) { return glm::ivec4(r, g, 255, 255); });
    };
    const auto r =
        shot(scene_of({ground()}, {m}), from_above({"normal"}), {lean(180, 128), lean(128, 180)});
    const auto z = [](float x) { return std::sqrt(1.0f - x * x); };
    const float slope = 2.0f * 180.0f / 255.0f - 1.0f;
    const glm::vec3 n =
        shared::detail_normal({slope, 0.0f, z(slope)}, {0.0f, slope, z(slope)}, 1.0f);
    EXPECT_NEAR(mean(r, "normal", 0), n.x, 0.01f);
    EXPECT_NEAR(mean(r, "normal", 2), -n.y, 0.01f);
    EXPECT_GT(n.x, 0.3f);
}

}  // namespace
}  // namespace petrichor::gpu
