#include "film/jobs/film_tracks.h"

#include <utility>
#include <vector>

#include "film/scenes/snow_tracks.h"

namespace petrichor::film {
namespace {

const SequenceVariant& variant_of(const Sequence& sequence, const std::string& name)
{
    for (const SequenceVariant& variant : sequence.variants)
        if (variant.name == name) return variant;
    return sequence.variants.front();
}

// Those that nodes have left by a second of the film.
std::vector<TrackWay> left_by(const std::vector<NodeWay>& nodes, const SnowHistory& snow, double film_s)
{
    std::vector<TrackWay> ways;
    for (const NodeWay& one : nodes) {
        NodeWay gone = gone_by(one, film_s);
        if (gone.way.points.size() < 2) continue;
        for (const double s : gone.at_s) gone.way.left.push_back(snow.left(s, film_s));
        ways.push_back(std::move(gone.way));
    }
    return ways;
}

gpu::TrackMap area_of(const Sequence& sequence)
{
    std::vector<TrackWay> nodes;
    for (const NodeWay& one : sequence.node_ways) nodes.push_back(one.way);
    gpu::TrackMap area = track_area(sequence.scenario.ground.tracks, nodes);
    area.over_time = !nodes.empty();
    return area;
}

std::vector<TrackWay> listed_ways(const Sequence& sequence)
{
    std::vector<TrackWay> ways;
    for (const ScenarioTrack& track : sequence.scenario.ground.tracks)
        if (track.nodes.empty()) ways.push_back(listed_way(track));
    return ways;
}

}  // namespace

gpu::TrackMap all_tracks(const Sequence& sequence)
{
    std::vector<TrackWay> ways = listed_ways(sequence);
    for (const NodeWay& one : sequence.node_ways) ways.push_back(one.way);
    return draw_ways(area_of(sequence), ways);
}

std::shared_ptr<const gpu::TrackSource> track_source(const Sequence& sequence, const std::string& variant)
{
    if (sequence.node_ways.empty()) return nullptr;
    return std::make_shared<const gpu::TrackSource>(
        [area = area_of(sequence), listed = listed_ways(sequence), nodes = sequence.node_ways,
         snow = variant_of(sequence, variant).snow](double film_s) {
            std::vector<TrackWay> ways = listed;
            for (TrackWay& way : left_by(nodes, snow, film_s)) ways.push_back(std::move(way));
            return draw_ways(area, ways);
        });
}

std::string tracks_at(const Sequence& sequence, const std::string& variant, double film_s)
{
    if (sequence.node_ways.empty()) return "";
    return ways_fingerprint(left_by(sequence.node_ways, variant_of(sequence, variant).snow, film_s));
}

}  // namespace petrichor::film
