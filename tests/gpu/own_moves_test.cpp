// Surfaces of users' own that move the vertices of their meshes: against meshes that have that shape themselves.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/gpu/own_text_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 64;

// A level sheet of cells x cells squares about the origin.
Primitive sheet(float side_m, int cells, std::uint32_t material = 0)
{
    Primitive p;
    const float step = side_m / static_cast<float>(cells);
    for (int z = 0; z <= cells; ++z) {
        for (int x = 0; x <= cells; ++x) {
            p.positions.emplace_back(step * static_cast<float>(x) - 0.5f * side_m, 0.0f,
                                     step * static_cast<float>(z) - 0.5f * side_m);
            p.normals.emplace_back(0.0f, 1.0f, 0.0f);
            p.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            p.uv0.emplace_back(static_cast<float>(x), static_cast<float>(z));
        }
    }
    const auto at = [&](int x, int z) { return static_cast<std::uint32_t>(z * (cells + 1) + x); };
    for (int z = 0; z < cells; ++z) {
        for (int x = 0; x < cells; ++x) {
            for (const std::uint32_t i : {at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x, z), at(x + 1, z + 1), at(x + 1, z)})
                p.indices.push_back(i);
        }
    }
    p.material = material;
    return p;
}

class OwnMove : public OwnTextTest {
protected:
    // A surface that changes nothing but, if told, where vertices go.
    std::string surface(const std::string& name, const std::string& move) const
    {
        std::string text = "#include \"gpu/passes/surface/own_surface.glsl\"\nvoid " + name +
                           "_input(inout SurfaceInput at) {}\nvoid " + name +
                           "_surface(SurfaceInput at, inout SurfaceData data) {}\n";
        if (!move.empty()) text += "vec3 " + name + "_move(MoveInput at)\n{\n" + move + "\n}\n";
        return write(name + ".glsl", text);
    }
    static Frame frame()
    {
        Frame f;
        f.camera = look({5, 5, 9}, {0, 0.3f, 0});
        f.settings.width = f.settings.height = kSize;
        f.settings.samples = 1;
        f.settings.seed = 3;
        f.settings.aovs = {"position", "normal", "depth"};
        f.sky.sun_elevation_rad = 0.5f;
        f.sky.sun_azimuth_rad = 2.0f;
        return f;
    }
    static float mean(const RenderResult& r)
    {
        float sum = 0.0f;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) sum += pixel(r, x, y).g;
        }
        return sum / (kSize * kSize);
    }
};

const char* const kSwell = "return vec3(0.0, 0.35 * sin(1.7 * at.position.x + frame.time_s) * cos(1.1 * at.position.z), 0.0);";

glm::vec3 swell(glm::vec3 p, float time_s, glm::vec3& normal)
{
    const float phase = 1.7f * p.x + time_s;
    const float dx = 0.35f * 1.7f * std::cos(phase) * std::cos(1.1f * p.z);
    const float dz = -0.35f * 1.1f * std::sin(phase) * std::sin(1.1f * p.z);
    normal = glm::normalize(glm::vec3(-dx, 1.0f, -dz));
    return p + glm::vec3(0.0f, 0.35f * std::sin(phase) * std::cos(1.1f * p.z), 0.0f);
}

// A turned and scaled instance that is moved, over a floor that it shades, against a mesh of that shape: place, normal
// and depth of each pixel, and the light with its shadows. Solid and blended.
TEST_F(OwnMove, AMovedMeshIsTheMeshOfThatShape)
{
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), {0.2f, 1.0f, -0.1f}) *
                            glm::rotate(glm::mat4(1.0f), 0.7f, {0, 1, 0}) * glm::scale(glm::mat4(1.0f), {2.0f, 1.5f, 2.0f});
    for (const bool blended : {false, true}) {
        Material own = plain_material({0.6f, 0.5f, 0.4f}, 0.4f);
        own.double_sided = true;
        if (blended) {
            own.alpha_mode = AlphaMode::Blend;
            own.base_color.a = 0.7f;
        }
        const Material floor = plain_material(glm::vec3(0.5f));
        const Primitive ground = quad({-8, -0.5f, 8}, {16, 0, 0}, {0, 0, -16}, 1);
        Frame f = frame();
        f.settings.time_s = 0.8;

        Material moved = own;
        moved.surface = surface("swell", kSwell);
        Scene scene = scene_of({sheet(2.5f, 60)}, {moved, floor});
        scene.instances[0].to_world = place;
        scene.meshes.push_back({"floor", {ground}});
        scene.instances.push_back({"floor", 1, glm::mat4(1.0f)});
        renderer->load(scene, {});
        const RenderResult by_text = renderer->render(f);

        Material still = own;
        still.surface = surface("plain", "");
        Primitive shape = sheet(2.5f, 60);
        for (std::size_t i = 0; i < shape.positions.size(); ++i)
            shape.positions[i] = swell(glm::vec3(place * glm::vec4(shape.positions[i], 1.0f)), 0.8f, shape.normals[i]);
        renderer->load(scene_of({shape, ground}, {still, floor}), {});
        const RenderResult by_mesh = renderer->render(f);

        int seen = 0, far = 0, bright = 0;
        double light = 0.0, off = 0.0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const glm::vec3 a = pixel(by_text, x, y), b = pixel(by_mesh, x, y);
                light += static_cast<double>(b.g);
                off += static_cast<double>(std::abs(a.g - b.g));
                bright += std::abs(a.g - b.g) > 0.02f * b.g + 1.0f;
                if (blended || aov(by_mesh, "position", x, y, 1) < 0.0f) continue;
                ++seen;
                float apart = std::abs(aov(by_text, "depth", x, y) - aov(by_mesh, "depth", x, y));
                for (int c = 0; c < 3; ++c) {
                    apart = std::max(apart, std::abs(aov(by_text, "position", x, y, c) - aov(by_mesh, "position", x, y, c)));
                    apart = std::max(apart, std::abs(aov(by_text, "normal", x, y, c) - aov(by_mesh, "normal", x, y, c)));
                }
                far += apart > 4.0e-3f;
            }
        }
        if (!blended) {
            EXPECT_GT(seen, 500);
            EXPECT_LE(far, seen / 200) << "where rounding decides who is in front";
        }
        EXPECT_LT(off, 0.003 * light) << blended;
        EXPECT_LE(bright, kSize * kSize / 100) << blended;
    }
}

TEST_F(OwnMove, AMomentIsTheSameHoweverItWasReached)
{
    Material moved = plain_material(glm::vec3(0.5f));
    moved.surface = surface("swell", kSwell);
    renderer->load(scene_of({sheet(5.0f, 40), quad({-8, -0.5f, 8}, {16, 0, 0}, {0, 0, -16}, 1)},
                            {moved, plain_material(glm::vec3(0.5f))}),
                   {});
    Frame f = frame();
    f.settings.time_s = 3.0;
    const RenderResult first = renderer->render(f);
    const RenderResult again = renderer->render(f);
    f.settings.time_s = 4.5;
    const RenderResult later = renderer->render(f);
    f.settings.time_s = 3.0;
    const RenderResult back = renderer->render(f);
    EXPECT_EQ(first.beauty, again.beauty);
    EXPECT_EQ(first.beauty, back.beauty);
    EXPECT_NE(first.beauty, later.beauty);
}

// Two sheets of one material whose vertices differ in all but their places, and a box with edges: pushed out along
// their normals, bent by their spacing. Nothing of what is behind shows.
TEST_F(OwnMove, NoSeamOpens)
{
    Material skin = plain_material(glm::vec3(0.0f));
    skin.surface = surface("puff", "return at.normal * (0.2 + 0.1 * sin(9.0 * at.position.x) * cos(7.0 * at.position.y)) + vec3(0.0, at.spacing, 0.0);");
    Material glow = plain_material(glm::vec3(1.0f));
    glow.unlit = true;
    std::vector<Primitive> sides;
    const auto side = [&](glm::vec3 middle, glm::vec3 u, glm::vec3 v) {
        Primitive p = sheet(2.0f, 16);
        for (std::size_t i = 0; i < p.positions.size(); ++i) {
            p.positions[i] = middle + u * p.positions[i].x - v * p.positions[i].z;
            p.normals[i] = glm::cross(u, v);
        }
        sides.push_back(p);
    };
    side({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    side({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    side({0, 1, 0}, {1, 0, 0}, {0, 0, -1});
    Scene scene = scene_of(sides, {skin, glow});
    scene.meshes.push_back({"behind", {quad({-3, -1.5f, -2.0f}, {5, 0, -5}, {0, 5, 0}, 1)}});
    scene.instances.push_back({"behind", 1, glm::mat4(1.0f)});
    renderer->load(scene, {});
    Frame f = frame();
    f.camera = look({4, 4, 4}, {0.3f, 0.4f, 0.3f});
    f.camera.orthographic_height_m = 1.6f;
    f.settings.width = f.settings.height = 256;
    f.settings.exposure = 1.0f;
    f.settings.image_based_light = false;
    f.sky.analytic_sun = false;
    const RenderResult r = renderer->render(f);
    std::set<int> faces;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            ASSERT_LT(pixel(r, x, y).g, 0.01f) << x << " " << y;
            const glm::vec3 n{aov(r, "normal", x, y, 0), aov(r, "normal", x, y, 1), aov(r, "normal", x, y, 2)};
            faces.insert(n.x > 0.9f ? 0 : n.y > 0.9f ? 1 : n.z > 0.9f ? 2 : 3);
        }
    }
    EXPECT_GE(faces.size(), 4u) << "all three sides are in the picture";
}

// The sea of the example: level without wind, in waves with it; a mesh that is too coarse for them stays level.
TEST_F(OwnMove, ShoreWaterMovesAsFarAsItsMeshIsFine)
{
    const auto heights = [&](int cells, float wind_m_s, double time_s) {
        Material sea = plain_material(glm::vec3(0.5f));
        sea.surface = std::string(PETRICHOR_SOURCE_DIR) + "/data/shaders/shore_water.glsl";
        renderer->load(scene_of({sheet(12.0f, cells)}, {sea}), {});
        Frame f = frame();
        f.camera = look({0, 6, 0}, {0, 0, 0});
        f.camera.orthographic_height_m = 10.0f;
        f.weather.wind_m_s = {wind_m_s, 0.0f};
        f.settings.time_s = time_s;
        const RenderResult r = renderer->render(f);
        std::vector<float> y_m;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) y_m.push_back(aov(r, "position", x, y, 1));
        }
        return y_m;
    };
    const auto spread = [](const std::vector<float>& y_m) {
        double sum = 0.0, squares = 0.0;
        for (const float y : y_m) {
            sum += static_cast<double>(y);
            squares += static_cast<double>(y) * static_cast<double>(y);
        }
        const double n = static_cast<double>(y_m.size());
        return std::sqrt(squares / n - sum * sum / (n * n));
    };
    const auto windy = heights(120, 8.0f, 1.0);
    EXPECT_GT(spread(windy), 0.02) << "six waves of that slope";
    EXPECT_LT(spread(heights(120, 0.0f, 1.0)), 0.4 * spread(windy));
    EXPECT_LT(spread(heights(4, 8.0f, 1.0)), 1.0e-6);
    EXPECT_NE(windy, heights(120, 8.0f, 1.5));
}

TEST_F(OwnMove, WrongOnesAreNamed)
{
    Material m = plain_material(glm::vec3(0.5f));
    m.surface = surface("bad", "return at.nothing;");
    const std::string said = refusal_of(m);
    EXPECT_NE(said.find("bad.glsl"), std::string::npos) << said;
    EXPECT_NE(said.find("nothing"), std::string::npos) << said;
}

TEST_F(OwnMove, WhatIsNoNumberIsNamed)
{
    Material m = plain_material(glm::vec3(0.5f));
    m.surface = surface("lost", "return at.normal * (at.position.x > 0.0 ? 1.0 / (at.position.y - at.position.y) : 0.0);");
    renderer->load(scene_of({sheet(2.0f, 4)}, {m}), {});
    Frame f = frame();
    f.camera = look({0, 6, 0}, {0, 0, 0});
    try {
        renderer->render(f);
        FAIL() << "it was drawn";
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find("lost.glsl"), std::string::npos) << said;
        EXPECT_NE(said.find(" of 25 vertices"), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace petrichor::gpu
