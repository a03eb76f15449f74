#include "film/scenario/rule_tables.h"

#include "film/scenario/probe_keys.h"

namespace petrichor::film {

std::vector<Rule> render_rules()
{
    return {
        {{"render", "transparent_layers", "4",
          "so many surfaces behind each other that let light through are blended, 0 to 8; what "
          "lies "
          "deeper, with 0 all of it, is seen or not by chance, a sample at a time"},
         [](Scenario& s, const TomlValue& v) { s.render.transparent_layers = v.integer(0, 8); }},
        {{"render", "falling_budget", "20000",
          "about so many drops and flakes are drawn one by one, those that hide most, 0 to "
          "1000000; "
          "the others dim what lies behind them"},
         [](Scenario& s, const TomlValue& v) { s.render.falling_budget = v.integer(0, 1000000); }},
        {{"render", "falling_density", "1.0",
          "multiplies how many there are in the air, 0 to 10; 1: as the weather says"},
         [](Scenario& s, const TomlValue& v) { s.render.falling_density = v.number(0.0, 10.0); }},
        {{"render", "tone_map", "\"filmic\"",
          "of the PNG: filmic, agx, aces, neutral (Khronos), linear (plain sRGB); true is filmic, "
          "false linear. The EXR is never tone mapped"},
         [](Scenario& s, const TomlValue& v) {
             s.render.tone_map = v.is_text()
                                     ? static_cast<gpu::ToneMap>(v.choice(
                                           {"linear", "filmic", "agx", "aces", "neutral"}))
                                 : v.boolean() ? gpu::ToneMap::Filmic
                                               : gpu::ToneMap::Linear;
         }},
        {{"render", "ocio_config", "\"config.ocio\"",
          "the PNG and the film by a view of this OpenColorIO config, relative to this file, in place of "
          "tone_map; the EXR stays linear"},
         [](Scenario& s, const TomlValue& v) { s.render.color.config = v.text(); }},
        {{"render", "ocio_display", "\"sRGB\"", "of the config; without it the config's default"},
         [](Scenario& s, const TomlValue& v) { s.render.color.display = v.text(); }},
        {{"render", "ocio_view", "\"Film\"", "of that display; without it the display's default"},
         [](Scenario& s, const TomlValue& v) { s.render.color.view = v.text(); }},
        {{"render", "ocio_scene_space", "\"scene_linear\"",
          "the space or role of the config that our light is in, linear Rec. 709; without it one that is known by its "
          "name, else scene_linear"},
         [](Scenario& s, const TomlValue& v) { s.render.color.scene_space = v.text(); }},
        {{"render", "ocio_look", "\"Golden Hour\"", "of the config, in place of the view's own looks"},
         [](Scenario& s, const TomlValue& v) { s.render.color.look = v.text(); }},
        {{"render", "ripple_texture_size", "512",
          "texels a side of the map of rings that rain draws: 64, 128 .. 4096"},
         [](Scenario& s, const TomlValue& v) {
             s.render.ripple_texture_size = v.integer(64, 4096);
             if ((s.render.ripple_texture_size & (s.render.ripple_texture_size - 1)) != 0)
                 v.refuse("a power of two from 64 to 4096");
         }},
        {{"render", "ripple_texture", "\"ripple.png\"",
          "drops of rain to use instead of drawn ones, laid out as `texture generate ripple`"},
         [](Scenario& s, const TomlValue& v) { s.render.weather_textures.ripple = v.text(); }},
        {{"render", "snow_mask_texture", "\"snow_mask.png\"",
          "where snow lies first: its blue, or a grey picture (`texture generate snow_mask`)"},
         [](Scenario& s, const TomlValue& v) { s.render.weather_textures.snow_mask = v.text(); }},
        {{"render", "snow_water_bump_texture", "\"snow_water_bump.png\"",
          "relief of snow and waves of moving water: alpha and green a normal, blue the smoothness "
          "of snow (`texture generate snow_water_bump`)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.weather_textures.snow_water_bump = v.text();
         }},
        {{"render", "occlusion_direct", "0.0",
          "how much occlusion maps darken sun and lamps too, 0 to 1; they always darken the sky"},
         [](Scenario& s, const TomlValue& v) { s.render.occlusion_direct = v.number(0.0, 1.0); }},
        {{"render", "ambient_fit", "\"table\"",
          "how strongly surroundings are mirrored: table (GGX, integrated) or lazarov (the fit of "
          "Lux "
          "2.02)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.lazarov = v.choice({"table", "lazarov"}) == 1;
         }},
        {{"render", "horizon_fade", "0.0",
          "mirrors darken where their ray would enter the mesh below a normal map, so fast: 0 off, "
          "1.3 "
          "as Lux 2.02, to 8"},
         [](Scenario& s, const TomlValue& v) { s.render.horizon_fade = v.number(0.0, 8.0); }},
        {{"render", "specular_aa", "1.0",
          "times the variance of normals inside a pixel, which widens highlights: 0 off to 4"},
         [](Scenario& s, const TomlValue& v) { s.render.specular_aa = v.number(0.0, 4.0); }},
        {{"render", "specular_aa_limit", "0.18", "and at most so much of it, 0 to 1"},
         [](Scenario& s, const TomlValue& v) { s.render.specular_aa_limit = v.number(0.0, 1.0); }},
        {{"render", "anisotropic_dither", "0.0",
          "anisotropic materials mirror their surroundings drawn out along their grain, each "
          "sample "
          "another part of it: 0 not (one bent normal) to 1 as far as their highlights; grainy at "
          "few "
          "samples"},
         [](Scenario& s, const TomlValue& v) { s.render.anisotropic_dither = v.number(0.0, 1.0); }},
        {{"render", "anisotropic_dither_distance_m", "50.0", "up to so far from the camera"},
         [](Scenario& s, const TomlValue& v) {
             s.render.anisotropic_dither_distance_m = v.number(0.0, 10000.0);
         }},
        {{"render", "anisotropic_dither_fade_m", "15.0", "over the last of which it fades"},
         [](Scenario& s, const TomlValue& v) {
             s.render.anisotropic_dither_fade_m = v.number(0.0, 10000.0);
         }},
        {{"render", "adaptive", "0.02",
          "pixels whose first two samples differ by less, of the display's range, take no further "
          "ones: "
          "0 (all samples everywhere) to 1"},
         [](Scenario& s, const TomlValue& v) { s.render.adaptive = v.number(0.0, 1.0); }},
        {{"render", "tile", "2048",
          "pixels a side of the tiles that a picture is rendered in, 32 to 4096, in steps of 32: they take less memory; "
          "without it pictures of more than 16 Mpixels are rendered in tiles of 2048"},
         [](Scenario& s, const TomlValue& v) {
             s.render.tile = v.integer(32, 4096);
             if (s.render.tile % 32 != 0) v.refuse("a multiple of 32");
         }},
        {{"render", "lod_scale", "1.0",
          "levels of detail (glTF MSFT_lod) are chosen as if things were so much larger, 0.01 to "
          "100"},
         [](Scenario& s, const TomlValue& v) { s.render.lod_scale = v.number(0.01, 100.0); }},
        {{"render", "color_space", "\"linear\"",
          "gamma: lights colours as the sRGB codes that they are stored as and shows the sums as "
          "codes, without tone mapping; to compare with engines that work so. The EXR holds codes"},
         [](Scenario& s, const TomlValue& v) {
             s.render.gamma = v.choice({"linear", "gamma"}) == 1;
         }},
        {{"render", "indirect", "\"auto\"",
          "light from other surfaces: patches (traced once, solved each frame), ambient (skylight "
          "and "
          "a constant), or auto: patches for scenes of up to a million triangles"},
         [](Scenario& s, const TomlValue& v) {
             s.render.indirect =
                 static_cast<IndirectLight>(v.choice({"auto", "patches", "ambient"}));
         }},
        {{"render", "probes", "\"auto\"",
          "what smooth surfaces mirror of the scene beyond the picture, with light of patches: "
          "auto (up "
          "to 4 reflection probes, placed over the ground), off (the sky), or up to 8 of your own: "
          "[{ position_m = [0.0, 1.6, 0.0], low_m = [-4.0, 0.0, -3.0], high_m = [4.0, 3.0, 3.0], "
          "blend_m = 1.0, importance = 0.0, intensity = 1.0 }]; low_m and high_m are the walls "
          "around; "
          "picture = \"room.hdr\" (lat-long, cd/m2; decode as of [sky] environment_decode) stands "
          "for "
          "what would be traced"},
         [](Scenario& s, const TomlValue& v) { s.render.probes = read_probes(v); }},
        {{"render", "surface_path", "\"auto\"",
          "how surfaces are shaded: fragment, visibility (a buffer of triangle numbers, resolved), "
          "or auto, the faster on this device"},
         [](Scenario& s, const TomlValue& v) {
             s.render.surface_path =
                 static_cast<gpu::SurfacePath>(v.choice({"auto", "fragment", "visibility"}));
         }},
        {{"render", "lighting_path", "\"prepass\"",
          "of lighting models of your own: prepass (light is gathered first and composed with the material "
          "once, by models that have NAME_gather and NAME_compose; others answer light by light), or "
          "forward (all answer light by light)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.light_prepass = v.choice({"prepass", "forward"}) == 0;
         }},
    };
}

}  // namespace petrichor::film
