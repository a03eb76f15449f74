#ifndef PETRICHOR_FILM_FILM_H
#define PETRICHOR_FILM_FILM_H

// The front door of the film: from a scenario to frames on disk.
//
//   using namespace petrichor;
//   film::Scenario scenario = film::read_scenario("street.toml");
//   scenario.output.frames = 24;
//   film::Sequence sequence = film::make_sequence(scenario);  // weather of every variant
//   film::load_sequence_scene(sequence, 0);                   // with all threads
//   const film::RenderReport report = film::render_sequence(
//       sequence, {.folder = "street", .range = {0, 23}, .shard = {1, 2}});
//
// One picture is a Job (frame, variant, view). frame_at gives everything that the renderer is told
// about it, weather in 0..1 and SI, clock, place and sun, without rendering:
//
//   const film::SequenceFrame noon = film::frame_at(sequence, {12, "snow", "left"});
//   noon.frame.weather.snow_depth_m;  noon.moment.utc_us;
//
// Where [render] names an OpenColorIO config, such a frame is rendered into exposed light, and show()
// (film/color/shown_picture.h) makes the display's codes of it with Sequence::display.
//
// Nothing is printed: notes of what was read, guessed and filled are in SequenceVariant::weather
// and RenderReport. Errors are Error (base/error.h).

#include "film/color/shown_picture.h"
#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "film/jobs/sequence.h"
#include "film/scenario/material_keys.h"
#include "film/scenario/scenario.h"

#endif
