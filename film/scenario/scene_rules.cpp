#include "film/scenario/rule_tables.h"

#include "texproc/prefilter/rules.h"

namespace petrichor::film {

std::vector<Rule> scene_rules()
{
    return {
        {{"scene", "file", "\"scene.glb\"",
          "glTF scene (.glb, .gltf), relative to this file; \"demo:street\" is the generated demo, "
          "\"demo:stage\" a stage for materials and lamps",
          false, true},
         [](Scenario& s, const TomlValue& v) { s.scene.file = v.text(); }},
        {{"scene", "demo_seed", "1", "which street the demo generator builds"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.demo_seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"scene", "max_texture", "4096",
          "larger textures are reduced to this many texels a side, 16 to 16384"},
         [](Scenario& s, const TomlValue& v) { s.scene.max_texture = v.integer(16, 16384); }},
        {{"scene", "texture_rule", "\"picture\"",
          "how small levels of normals and roughness are made together, as `texture build --rule`: "
          "picture, median, lean, .., or none, plain mips; textures with levels of their own keep "
          "them"},
         [](Scenario& s, const TomlValue& v) {
             std::vector<std::string> words;
             for (const texproc::Rule& rule : texproc::rules()) words.push_back(rule.name);
             s.scene.texture_rule = words[static_cast<std::size_t>(v.choice(words))];
         }},
        {{"scene", "ground", "\"auto\"",
          "what the scene stands on: plane, level ground out to the horizon (material \"default "
          "ground\"); none; or auto, a plane where the scene brings no ground of a hundred metres and more"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.ground = static_cast<StandsOn>(v.choice({"auto", "plane", "none"}));
         }},
        {{"scene", "north_degrees", "0.0",
          "where north lies in the scene: clockwise from -z towards +x; turns sun and wind"},
         [](Scenario& s, const TomlValue& v) { s.scene.north_degrees = v.number(-360.0, 360.0); }},
        {{"scene", "variant", "\"\"",
          "a variant of the scene's materials (KHR_materials_variants); \"\": as the file has "
          "them"},
         [](Scenario& s, const TomlValue& v) { s.scene.variant = v.text(); }},
        {{"scene", "animation", "\"all\"",
          "which of the scene's animations play over the film: all, none, or the name of one"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.animation = v.text();
             if (s.scene.animation.empty()) v.refuse("all, none, or the name of an animation");
         }},
        {{"scene", "animation_speed", "1.0",
          "seconds of the animation for a second of the film, -1000 to 1000; 0: it stands still"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.animation_speed = v.number(-1000.0, 1000.0);
         }},
        {{"scene", "animation_start_s", "0.0", "moment of the animation that frame 0 shows"},
         [](Scenario& s, const TomlValue& v) { s.scene.animation_start_s = v.number(-1e6, 1e6); }},
        {{"scene", "animation_loop", "true",
          "each begins again when it ends; false: it stays as it ended"},
         [](Scenario& s, const TomlValue& v) { s.scene.animation_loop = v.boolean(); }},
    };
}

}  // namespace petrichor::film
