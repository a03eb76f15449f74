// What the golden scenes are made of: textures from formulas, simple shapes, a plain day.
#ifndef PETRICHOR_TESTS_GOLDEN_STAGE_H
#define PETRICHOR_TESTS_GOLDEN_STAGE_H

#include <functional>
#include <glm/glm.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::golden {

/// A texture with all its mips (box filter of the codes). `texel` gives codes 0..1 at u, v in 0..1,
/// row 0 at v = 0.
gpu::Texture make_texture(const std::string& name, gpu::TexelFormat format, int size,
                          const std::function<glm::vec4(float u, float v)>& texel);

gpu::Texture chequers(const glm::vec3& a, const glm::vec3& b, int squares = 8);
/// Rounded stones, `stones` to a side: height in R, and the normal map that belongs to it.
gpu::Texture stone_heights(int stones = 6);
gpu::Texture stone_normals(int stones = 6, float steepness = 0.35f);
/// R: 1 inside a round blot in the middle, 0 outside, soft between.
gpu::Texture blot();

/// Six faces, uv 0..1 each.
gpu::Primitive box(const glm::vec3& low, const glm::vec3& high, std::uint32_t material);
gpu::Primitive sphere(const glm::vec3& centre, float radius_m, std::uint32_t material);
/// A level square around the origin, `repeats` of the texture along each side.
gpu::Primitive ground(float half_m, std::uint32_t material, float repeats = 1.0f);
gpu::Primitive scaled_uv(gpu::Primitive primitive, float repeats);

/// Everything one golden picture is made from.
struct Shot {
    gpu::Scene scene;
    std::vector<gpu::Texture> textures;
    gpu::EnvironmentMap environment;  ///< empty: the analytic sky
    gpu::Frame frame;

    std::uint32_t add(const gpu::Material& material);
    gpu::TextureUse add(gpu::Texture texture);
    /// A mesh and one instance of it.
    void add(gpu::Primitive primitive, const glm::mat4& to_world = glm::mat4(1.0f));
    void add(const gpu::Light& light) { scene.lights.push_back(light); }
};

/// 128 x 72 pixels, 2 samples, clear sky, the sun high behind the right shoulder of a camera that
/// looks along -z.
Shot plain_day(const gpu::Camera& camera);

/// A case of the table.
struct Case {
    std::string name;   ///< of the file: NAME.exr
    std::string shows;  ///< what a reader sees in it
    Shot (*make)() = nullptr;
};

inline void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.name << ": " << c.shows;
}

std::vector<Case> surface_cases();
std::vector<Case> weather_cases();
std::vector<Case> falling_cases();
std::vector<Case> light_cases();
std::vector<Case> sky_cases();

}  // namespace petrichor::golden

#endif
