#include "weather/models/physical/physical_checkpoint.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/weather/made_up.h"
#include "weather/models/physical/physical.h"

namespace petrichor::weather {
namespace {

using testing_weather::kHourUs;
using testing_weather::rough_year;

std::string refusal(const std::string& text, const RunIdentity& identity)
{
    try {
        load_checkpoint(text, identity);
    } catch (const Error& e) {
        return e.what();
    }
    return "accepted";
}
void expect_refused(const std::string& text, const RunIdentity& identity, const char* why)
{
    EXPECT_NE(refusal(text, identity).find(why), std::string::npos) << refusal(text, identity);
}

struct Case {
    ForcingTable table = rough_year(400);
    PhysicalParams params;

    RunIdentity identity() const { return cell_identity(table, params); }
    std::string checkpoint() const
    {
        const PhysicalTimeline run(table, params);
        const std::int64_t at = run.begin_us() + 200 * kHourUs;
        return save_checkpoint({at, run.state_at(at)}, identity());
    }
};

TEST(PhysicalCheckpoint, GoesOnWithIdenticalBits)
{
    const Case first;
    const auto from = load_checkpoint(first.checkpoint(), first.identity());
    const PhysicalTimeline whole(first.table, first.params);
    const PhysicalTimeline rest(first.table, first.params, from.state, from.at_us);
    EXPECT_EQ(from.at_us, whole.begin_us() + 200 * kHourUs);
    EXPECT_EQ(state_hash(rest.state_at(rest.end_us())), state_hash(whole.state_at(whole.end_us())));
}

TEST(PhysicalCheckpoint, BelongsToItsWeatherSurfaceAndModel)
{
    const Case first;
    const std::string text = first.checkpoint();
    const auto refused = [&](const char* why, auto&& change) {
        Case other;
        change(other);
        expect_refused(text, other.identity(), why);
    };
    refused("other weather", [](Case& r) { r.table[Field::Wind][3] += 1e-9; });
    refused("other weather", [](Case& r) { r.table.time_us.back() += 1; });
    refused("other weather", [](Case& r) { r.table.site.wind_height_m = 3; });
    refused("another surface", [](Case& r) { r.params.surface = surface_preset("rock"); });
    refused("another surface", [](Case& r) { r.params.surface.puddles.depth_mm = 9; });
    refused("another surface", [](Case& r) { r.params.surface.infiltration.decay_1_h = 5; });
    refused("other parameters", [](Case& r) { r.params.phase.law = PhaseLaw::WetBulb; });
    refused("other parameters", [](Case& r) { r.params.snow.max_layers = 1; });
    refused("other parameters", [](Case& r) { r.params.exchange.min_wind_m_s = 0.2; });
    refused("other parameters", [](Case& r) { r.params.step_s = 1800; });
    refused("other parameters", [](Case& r) { r.params.canopy_vai = 1; });

    Case named;
    named.params.surface.name = "my road";
    named.table.site.name = "here";
    EXPECT_EQ(refusal(text, named.identity()), "accepted");
}

TEST(PhysicalCheckpoint, RefusesWhatItDidNotWrite)
{
    const Case first;
    const std::string text = first.checkpoint();
    const RunIdentity identity = first.identity();
    expect_refused("nonsense", identity, "no checkpoint");
    expect_refused(text.substr(0, 40), identity, "cut short");
    expect_refused(text.substr(0, text.size() - 9), identity, "cut short");
    std::string damaged = text;
    damaged[20] = 'x';
    expect_refused(damaged, identity, "damaged");
    damaged = text;
    damaged[text.size() - 30] = damaged[text.size() - 30] == '0' ? '1' : '0';
    expect_refused(damaged, identity, "hash does not match");
}

}  // namespace
}  // namespace petrichor::weather
