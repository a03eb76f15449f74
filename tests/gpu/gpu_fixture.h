// A renderer with the validation layer on, which the tests of a suite share; any message fails the test. Scenes made of a
// few quads.
#ifndef PETRICHOR_TESTS_GPU_GPU_FIXTURE_H
#define PETRICHOR_TESTS_GPU_GPU_FIXTURE_H

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>

#include "base/error.h"
#include "gpu/renderer.h"
#include "tests/support/device.h"

namespace petrichor::gpu {

// One renderer for a suite: a frame is a function of its scene, so what a test leaves behind must not show in the next, and
// sky, weather's maps and pipelines are not made for each. It is made anew behind a test that failed or took it.
class GpuTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (!kept_ && !testing_device::device_is_there()) return;
        renderer = kept_ ? std::move(kept_)
                         : std::make_unique<Renderer>(RendererOptions{.device = "", .validation = true});
    }
    void TearDown() override
    {
        if (!renderer) return;
        for (const std::string& message : renderer->validation_messages()) ADD_FAILURE() << message;
        renderer->set_environment({});
        if (!HasFailure()) kept_ = std::move(renderer);
    }
    static void TearDownTestSuite() { kept_.reset(); }

    std::unique_ptr<Renderer> renderer;

private:
    static inline std::unique_ptr<Renderer> kept_;
};

/// A flat rectangle: corner, two edges (front side along cross(u, v)).
inline Primitive quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                      std::uint32_t material = 0)
{
    Primitive p;
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 at :
         {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        p.positions.push_back(corner + u * at.x + v * at.y);
        p.normals.push_back(normal);
        p.tangents.emplace_back(glm::normalize(u), 1.0f);
        p.uv0.push_back(at);
    }
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

inline Material plain_material(const glm::vec3& color, float roughness = 0.8f,
                               float metallic = 0.0f)
{
    Material m;
    m.base_color = glm::vec4(color, 1.0f);
    m.roughness = roughness;
    m.metallic = metallic;
    return m;
}

inline Scene scene_of(std::vector<Primitive> primitives, std::vector<Material> materials)
{
    Scene scene;
    scene.materials = std::move(materials);
    scene.meshes.push_back({"mesh", std::move(primitives)});
    scene.instances.push_back({"instance", 0, glm::mat4(1.0f)});
    return scene;
}

inline Camera look(const glm::vec3& eye, const glm::vec3& target, float fov_rad = 0.8f)
{
    Camera camera;
    const glm::vec3 up =
        std::abs(glm::normalize(target - eye).y) > 0.99f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    camera.to_world = glm::inverse(glm::lookAt(eye, target, up));
    camera.vertical_fov_rad = fov_rad;
    return camera;
}

float half_to_float(std::uint16_t bits);

inline glm::vec3 pixel(const RenderResult& r, int x, int y)
{
    const std::size_t i = (static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) +
                           static_cast<std::size_t>(x)) *
                          4;
    return {half_to_float(r.beauty[i]), half_to_float(r.beauty[i + 1]),
            half_to_float(r.beauty[i + 2])};
}

inline float aov(const RenderResult& r, const std::string& name, int x, int y, int channel = 0)
{
    for (const AovImage& image : r.aovs) {
        if (image.name != name) continue;
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) +
                              static_cast<std::size_t>(x);
        return image.pixels[i * static_cast<std::size_t>(image.channels) +
                            static_cast<std::size_t>(channel)];
    }
    ADD_FAILURE() << "no AOV " << name;
    return 0.0f;
}

inline float luminance(const glm::vec3& c)
{
    return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

inline float half_to_float(std::uint16_t bits)
{
    const int exponent = (bits >> 10) & 31;
    const int mantissa = bits & 1023;
    const float sign = bits & 0x8000 ? -1.0f : 1.0f;
    if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
    if (exponent == 31) return mantissa ? NAN : sign * INFINITY;
    return sign * std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
}

/// A map of one radiance in all directions.
inline EnvironmentMap constant_environment(float radiance)
{
    EnvironmentMap map;
    map.width = 16;
    map.height = 8;
    map.rgb.assign(16 * 8 * 3, radiance);
    return map;
}

}  // namespace petrichor::gpu

#endif
