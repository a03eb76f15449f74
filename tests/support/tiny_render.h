#ifndef PETRICHOR_TESTS_SUPPORT_TINY_RENDER_H
#define PETRICHOR_TESTS_SUPPORT_TINY_RENDER_H

#include <gtest/gtest.h>

#include <string>

#include "tests/support/device.h"
#include "tests/support/program.h"

namespace petrichor::testing_program {

/// Whole renders of the tiny scene in rain, one frame of 48 x 27: what a test adds to the scenario
/// stands behind `tables`, whose last table may be left open.
class TinyRender : public testing::Test {
protected:
    TinyRender(const std::string& place, std::string tables)
        : place_(place), tables_(std::move(tables))
    {
    }
    void SetUp() override
    {
        write_file(place_ / "scene.glb", tiny_scene_glb());
        (void)testing_device::device_is_there();
    }
    Outcome render(const std::string& more, const std::string& folder)
    {
        write_file(place_ / "s.toml", R"(
[scene]
file = "scene.glb"
[weather]
keys = [{ time_s = 0, temperature_c = 5, rainfall = 0.8, script_controlled = 0, wetness = 0.5, cracks = 0.5, puddles = 0.7, snow = 0.4 }]
[output]
width = 48
height = 27
samples = 1
frames = 1
film = false
exr = false
[camera]
position_m = [0.0, 1.5, 4.0]
look_at_m = [0.0, 0.4, 0.0]
)" + tables_ + more);
        return run_petrichor({.arguments = {"render", "s.toml", "-o", folder}}, place_.path());
    }
    /// The bytes of its PNG.
    std::string picture(const std::string& more, const std::string& folder)
    {
        const Outcome outcome = render(more, folder);
        EXPECT_EQ(outcome.exit_code, 0) << more << outcome.err;
        return read_file(place_ / folder / "frame_0000.png");
    }

    Workplace place_;

private:
    std::string tables_;
};

}  // namespace petrichor::testing_program

#endif
