#include "demo/street.h"

#include <fstream>
#include <string>

#include "base/error.h"
#include "base/output_file.h"
#include "demo/street_materials.h"
#include "demo/street_parts.h"
#include "scene/gltf/glb_writer.h"

namespace petrichor::demo {

namespace {

scene::Camera look(const std::string& name, const glm::vec3& from, const glm::vec3& at,
                   float fov_rad, const glm::vec3& up = glm::vec3(0.0f, 1.0f, 0.0f))
{
    const glm::vec3 back = glm::normalize(from - at);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    scene::Camera camera;
    camera.name = name;
    camera.to_world = glm::mat4(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                                glm::vec4(back, 0.0f), glm::vec4(from, 1.0f));
    camera.vertical_fov_rad = fov_rad;
    return camera;
}

}  // namespace

scene::Scene make_demo_street(const DemoOptions& options)
{
    if (!(options.texture_size >= 16 && options.texture_size <= 4096)) {
        throw Error("demo: the texture size must be 16 to 4096, got " +
                        std::to_string(options.texture_size),
                    "Choose a size in that range, for example 1024.");
    }
    scene::Scene scene;
    scene.name = "street";
    Kit kit;
    kit.seed = options.seed;
    add_street_materials(options, scene, kit);
    add_ground(kit);
    add_houses(kit);
    add_gate(kit);
    add_awning(kit);
    add_lamp(kit, kLampFoot);
    add_furniture(kit);
    add_plants(kit);

    // One mesh a material: whoever reads the file draws the street with as many calls.
    for (std::size_t slot = 0; slot < kSlots; ++slot) {
        if (kit.builders[slot].triangle_count() == 0) continue;
        const std::string name = scene.materials[slot].name;
        scene::Mesh mesh;
        mesh.name = name;
        mesh.primitives.push_back(kit.builders[slot].take(static_cast<std::uint32_t>(slot)));
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back(
            {.name = name, .mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1)});
    }
    scene::Light lamp;
    lamp.name = "lamp";
    lamp.kind = scene::LightKind::Point;
    lamp.color = glm::vec3(1.0f, 0.68f, 0.36f);
    lamp.intensity = 800.0f;
    lamp.range_m = 30.0f;
    lamp.position_m = kLampFoot + glm::vec3(0.0f, kLampLight, 0.0f);
    scene.lights.push_back(lamp);

    scene.cameras.push_back(look("main", {0.90f, 1.50f, 6.0f}, {0.16f, 1.40f, -1.0f}, 0.75f));
    scene.cameras.push_back(look("low", {0.75f, 0.40f, 3.75f}, {-0.05f, 0.62f, -1.0f}, 0.85f));
    scene.cameras.push_back(
        look("top", {0.0f, 17.0f, -0.5f}, {0.0f, 0.0f, -0.6f}, 0.80f, {0.0f, 0.0f, -1.0f}));
    return scene;
}

std::filesystem::path write_demo(const std::filesystem::path& folder, const DemoOptions& options)
{
    const std::vector<std::byte> glb = write_glb(make_demo_street(options));
    const std::filesystem::path path = folder / "street.glb";
    write_text_file(path, {reinterpret_cast<const char*>(glb.data()), glb.size()});
    return path;
}

}  // namespace petrichor::demo
