#include "film/scenario/rule_tables.h"

namespace petrichor::film {

std::vector<Rule> output_rules()
{
    return {
        {{"output", "width", "640", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.width = v.integer(1, 16384); }},
        {{"output", "height", "360", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.height = v.integer(1, 16384); }},
        {{"output", "samples", "8", "a pixel, for smooth edges, 1 to 256", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.samples = v.integer(1, 256); }},
        {{"output", "seed", "1", "of the sample pattern"},
         [](Scenario& s, const TomlValue& v) {
             s.output.seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"output", "frames", "48", "number of frames, 1 to 1000000", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.frames = v.integer(1, 1000000); }},
        {{"output", "fps", "12.0", "frames a second of the film; also the clock of ripples", false,
          true},
         [](Scenario& s, const TomlValue& v) { s.output.fps = v.number(0.01, 1000.0); }},
        {{"output", "start_s", "0.0", "time of frame 0 on the clock of weather, sun and camera"},
         [](Scenario& s, const TomlValue& v) { s.output.start_s = v.number(-1e9, 1e9); }},
        {{"output", "duration_s", "48.0",
          "from frame 0 to one frame after the last on that clock; without it as long as the "
          "weather"},
         [](Scenario& s, const TomlValue& v) { s.output.duration_s = v.number(0.0, 1e9); }},
        {{"output", "exr", "true", "write frame_0000.exr: linear light, half float, all AOVs"},
         [](Scenario& s, const TomlValue& v) { s.output.exr = v.boolean(); }},
        {{"output", "png", "true", "write frame_0000.png: as seen, 8 bits"},
         [](Scenario& s, const TomlValue& v) { s.output.png = v.boolean(); }},
        {{"output", "film", "true", "write film.mp4 where ffmpeg is installed (needs the PNGs)"},
         [](Scenario& s, const TomlValue& v) { s.output.film = v.boolean(); }},
        {{"output", "aovs", "[]",
          "images beside the picture in the EXR; `petrichor render --list-aovs` names them"},
         [](Scenario& s, const TomlValue& v) { s.output.aovs = v.texts(); }},
    };
}

}  // namespace petrichor::film
