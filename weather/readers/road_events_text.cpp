#include "weather/readers/road_events_text.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostEvents = 100000;

std::optional<RoadEvent::Kind> kind_named(std::string_view word)
{
    const std::string plain = lower(trimmed(word));
    if (plain == "salt") return RoadEvent::Kind::Salt;
    if (plain == "brine") return RoadEvent::Kind::Brine;
    if (plain == "plough" || plain == "plow") return RoadEvent::Kind::Plough;
    return std::nullopt;
}

}  // namespace

std::vector<RoadEvent> read_road_events(std::string_view text, const std::string& name,
                                        double utc_offset_s)
{
    std::vector<RoadEvent> events;
    Lines lines(text);
    bool first = true;
    while (const auto line = lines.next()) {
        const std::string_view plain = trimmed(*line);
        if (plain.empty() || plain.front() == '#') continue;
        const auto fields = split(plain, ',', 8);
        const bool heading = first && lower(trimmed(fields[0])).rfind("time", 0) == 0;
        first = false;
        if (heading) continue;
        const std::string where =
            "road events: " + name + " line " + std::to_string(lines.number()) + ": ";
        if (fields.size() != 3)
            throw Error(where + std::to_string(fields.size()) + " fields, not 3",
                        "Write time,salt|brine|plough,amount, as 2004-01-30T14:00,salt,20.");
        const auto us = us_from_iso(trimmed(fields[0]), utc_offset_s);
        if (!us)
            throw Error(where + "'" + shown(fields[0]) + "' is not a time",
                        "Write times as 2004-01-30T14:00 or 2004-01-30T14:00Z.");
        const auto kind = kind_named(fields[1]);
        if (!kind)
            throw Error(where + "there is no event '" + shown(fields[1]) + "'",
                        "Use salt (g/m2), brine (g/m2 of 23 %) or plough (share of the snow).");
        const auto amount = to_number(trimmed(fields[2]));
        if (!amount)
            throw Error(where + "'" + shown(fields[2]) + "' is not a number",
                        "Give salt and brine in g/m2, and a plough the share of the snow.");
        const RoadEvent event{*us, *kind, *amount};
        try {
            check_events({&event, 1});
        } catch (const Error& e) {
            throw Error(where + "'" + shown(fields[2]) + "': " + e.what(), e.fix());
        }
        if (events.size() >= kMostEvents)
            throw Error("road events: " + name + " has more than 100000 events",
                        "Give those of the run alone.");
        events.push_back(event);
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const RoadEvent& a, const RoadEvent& b) { return a.time_us < b.time_us; });
    return events;
}

}  // namespace petrichor::weather
