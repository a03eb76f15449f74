#include "film/scenario/tracks.h"

#include <algorithm>

namespace petrichor::film {

std::vector<ScenarioTrack> read_tracks(const TomlValue& value)
{
    std::vector<ScenarioTrack> tracks;
    for (const TomlValue& one : value.elements()) {
        ScenarioTrack track;
        track.place = one.place();
        for (const auto& [name, entry] :
             one.entries({"kind", "points_m", "node", "width_m", "gauge_m", "depth"})) {
            if (name == "kind") {
                track.tyre = entry.choice({"tyre", "feet"}) == 0;
            } else if (name == "points_m") {
                for (const TomlValue& point : entry.elements())
                    track.points_m.push_back(point.point());
            } else if (name == "node") {
                track.nodes = entry.is_array() ? entry.texts() : std::vector<std::string>{entry.text()};
            } else if (name == "width_m") {
                track.width_m = entry.number(0.02, 5.0);
            } else if (name == "gauge_m") {
                track.gauge_m = entry.number(0.0, 20.0);
            } else {
                track.depth = entry.number(0.0, 1.0);
            }
        }
        const auto first = track.points_m.begin();
        const bool listed = !std::all_of(first, track.points_m.end(), [&](const auto& p) { return p == *first; });
        if (track.nodes.empty() ? !listed : !track.points_m.empty())
            one.refuse("a table with kind, and either points_m of two different points or more or the node that goes");
        tracks.push_back(std::move(track));
    }
    return tracks;
}

}  // namespace petrichor::film
