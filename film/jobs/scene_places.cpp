#include "film/jobs/scene_places.h"

#include <algorithm>
#include <thread>

#include "film/data/folders.h"
#include "film/scenes/transport.h"
#include "film/weather/upwind.h"
#include "scene/patches/tracer.h"

namespace petrichor::film {
namespace {

// Keys have places where light is of patches, which are traced then anyway.
bool wants_places(const Sequence& sequence, const WeatherSource& weather)
{
    const std::optional<bool> asked = sequence.scenario.ground.patches;
    if (weather.table) return asked.value_or(true);
    return weather.script && asked.value_or(wants_patches(sequence));
}

bool wants_hollows(const Sequence& sequence)
{
    return sequence.scenario.ground.patches.value_or(true) &&
           leaves_water_to_geometry(sequence.scene) &&
           std::any_of(sequence.variants.begin(), sequence.variants.end(),
                       [](const SequenceVariant& v) { return v.weather.script != nullptr; });
}

// Pictures of what lies at each place, of a sequence whose weather is the same everywhere.
std::optional<std::string> note_of_pictures(const ScenarioOutput& output)
{
    std::string asked;
    for (const char* name : {"film_depth", "water_depth", "snow_depth", "ice", "rain_exposure"}) {
        if (std::find(output.aovs.begin(), output.aovs.end(), name) == output.aovs.end()) continue;
        asked += (asked.empty() ? "" : ", ") + std::string(name);
    }
    if (asked.empty()) return std::nullopt;
    return asked + ": the frame's, by how much of its film, water or snow the pixel shows, since the weather is the same everywhere; "
                   "[ground] patches = true gives each place its own";
}

const SequenceVariant& variant_of(const Sequence& sequence, const Job& job)
{
    return *std::find_if(sequence.variants.begin(), sequence.variants.end(),
                         [&](const SequenceVariant& v) { return v.name == job.variant; });
}

}  // namespace

ScenePlaces::ScenePlaces(const Sequence& sequence, int threads, const StopRequest& stop,
                         const scene::PatchProgress& progress, std::vector<std::string>& notes)
    : threads_(threads > 0 ? threads
                           : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())))
{
    const auto first = std::find_if(sequence.variants.begin(), sequence.variants.end(),
                                    [&](const SequenceVariant& v) {
                                        return wants_places(sequence, v.weather);
                                    });
    const bool taps = !sequence.scenario.ground.taps.empty();
    const char* const dry =
        "[ground] tap: no water runs, since the weather is the same everywhere; [ground] patches = true "
        "gives each place its own";
    if (taps && first == sequence.variants.end()) notes.emplace_back(dry);
    if (first == sequence.variants.end()) {
        if (auto note = note_of_pictures(sequence.scenario.output)) notes.push_back(std::move(*note));
        if (wants_hollows(sequence)) hollows_.emplace(sequence.scene, sequence.scenario.ground);
        if (hollows_ && hollows_->any()) {
            notes.push_back("no material says where water stands: it runs to " +
                            std::to_string(hollows_->count()) + " hollows of the ground");
        }
        return;
    }
    TransportOptions options;
    options.patches.threads = threads;
    options.patches.stop = stop;
    options.patches.progress = progress;
    options.cache = user_cache();
    const SceneTransport transport = prepare_transport(sequence.scene, options);
    if (transport.patches.empty()) {
        notes.emplace_back("no surface stops light: the weather is the same everywhere");
        if (taps) notes.emplace_back("[ground] tap: no water runs, since there is no ground to run over");
        return;
    }
    std::vector<std::string> alpha_notes;
    const scene::Triangles triangles(sequence.scene, alpha_images(sequence.scene, alpha_notes));
    const scene::Tracer tracer(triangles);
    sites_ = scene_sites(sequence.scene, transport.patches, tracer, transport.surfaces,
                         sequence.scenario.ground, first->weather.physical.surface);
    const bool drifts = std::any_of(sequence.variants.begin(), sequence.variants.end(), [&](const SequenceVariant& v) {
        return v.weather.table && wants_places(sequence, v.weather) && wind_may_carry_snow(*v.weather.table);
    });
    if (drifts) find_upwind(sites_->set, sites_->shelter.position_m, tracer);
    notes.insert(notes.end(), transport.notes.begin(), transport.notes.end());
    for (const std::string& note : sites_->notes) notes.push_back("ground: " + note);
    notes.push_back("weather on " + std::to_string(transport.patches.count) + " patches, " +
                    std::to_string(sites_->shelter.cuts.size()) + " of them cut where a shelter ends, " +
                    std::to_string(sites_->ground.basins.pits) + " hollows of the ground");
}

void ScenePlaces::place(const Sequence& sequence, const Job& job, SequenceFrame& frame,
                        FrameFacts& facts)
{
    if (hollows_) frame.frame.place = hollows_->at(frame.frame.weather.flood_puddles);
    if (!sites_) return;
    const SequenceVariant& variant = variant_of(sequence, job);
    if (!wants_places(sequence, variant.weather)) return;
    if (!variant.weather.table) {
        auto keyed = keyed_.find(job.variant);
        if (keyed == keyed_.end()) {
            const double offset_s = variant.weather.script_offset_s;
            const KeyedTaps clock{sequence.scenario.weather.hours_per_second, offset_s,
                                  sequence.scenario.output.start_s + sequence.duration_s + offset_s};
            keyed = keyed_
                        .emplace(job.variant, ArtistPlaces(*sites_, *variant.weather.script,
                                                           variant.conditions.sun.latitude_degrees,
                                                           sequence.scenario.scene.north_degrees, clock))
                        .first;
        }
        frame.frame.place =
            keyed->second.at(std::max(0.0, frame.time_s + variant.weather.script_offset_s));
        return;
    }
    auto run = runs_.find(job.variant);
    if (run == runs_.end()) {
        weather::PatchParams params;
        params.model = variant.weather.physical;
        params.north_deg = sequence.scenario.scene.north_degrees;
        params.taps = taps_of_run(sites_->taps, variant.weather.utc_us);
        params.threads = threads_;
        // From the sequence's own first frame, whichever are asked for: the same bits for all.
        const std::int64_t from_us = variant.weather.utc_us(frame_time_s(sequence, 0));
        run = runs_
                  .emplace(job.variant,
                           PlaceWeatherOfFile(*sites_, *variant.weather.table, params, from_us))
                  .first;
    }
    frame.frame.place = run->second.at(variant.weather.utc_us(frame.time_s));
    const PlaceSums sums = run->second.sums();
    facts.ground = {{"area_m2", sums.area_m2},
                    {"film_kg", sums.film_kg},
                    {"standing_water_kg", sums.standing_kg},
                    {"ice_kg", sums.ice_kg},
                    {"snow_kg", sums.snow_kg},
                    {"ponds_m3", sums.ponds_m3},
                    {"pond_ice_kg", sums.pond_ice_kg},
                    {"fallen_kg", sums.books.fallen},
                    {"let_in_kg", sums.books.let_in},
                    {"evaporated_kg", sums.books.evaporated + sums.books.lost_from_ponds},
                    {"sublimated_kg", sums.books.sublimated},
                    {"soaked_kg", sums.books.soaked},
                    {"left_kg", sums.books.out},
                    {"not_accounted_kg", sums.books.residual()}};
}

}  // namespace petrichor::film
