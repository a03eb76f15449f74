#include "scene/detail/material_row.h"

namespace petrichor::scene::detail {

using L = WindLook;

void add_wind_rows(std::vector<Row>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    const auto fixed = [&t](Row row) {
        row.keyed = false;
        t.push_back(std::move(row));
    };
    fixed(number<&M::wind, &L::bend>(
        "wind_bend", 0, 1, place("windBend"),
        "how far its top leans in a storm, in heights; grass 0.8, bushes 0.2. Not of skinned meshes"));
    fixed(number<&M::wind, &L::flutter_m>("wind_flutter_m", 0, 1, place("windFlutter"),
                                          "metres by which leaves flutter in a storm"));
    fixed(number<&M::wind, &L::sway_hz>("wind_sway_hz", 0, 10, place("windSway"),
                                        "how often it sways in a second; leaves flutter five times as fast"));
    fixed(number<&M::wind, &L::height_m>(
        "wind_height_m", 0, 100, place("windHeight"),
        "metres from root to top; 0: the height of its mesh. A meadow in one mesh needs it"));
    t.push_back(choice<&M::wind, &L::weight>(
        "wind_weight", {"height", "uv", "mask"}, place("windWeight"),
        "how far a vertex is from the root: by its height, by v (1 root, 0 top), by alpha of _WEATHER"));
}

}  // namespace petrichor::scene::detail
