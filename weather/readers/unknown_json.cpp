#include "weather/readers/unknown_json.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

constexpr std::size_t kNamed = 6;

std::string members_of(const Json& object)
{
    if (object.members.empty()) return "an empty object";
    std::string out = "an object with ";
    for (std::size_t i = 0; i < std::min(object.members.size(), kNamed); ++i)
        out += (i > 0 ? ", '" : "'") + shown(object.members[i].name) + "'";
    if (object.members.size() > kNamed)
        out += " and " + std::to_string(object.members.size() - kNamed) + " more";
    return out;
}

std::string what_it_is(const Json& value)
{
    switch (value.kind) {
    case Json::Kind::Object: return members_of(value);
    case Json::Kind::Array:
        if (value.items.empty()) return "an empty list";
        return "a list of " + std::to_string(value.items.size()) + ", the first " +
               (value.items[0].kind == Json::Kind::Array ? "a list" : what_it_is(value.items[0]));
    case Json::Kind::Number: return "a number";
    case Json::Kind::String: return "a text";
    default: return "no more than a word";
    }
}

// The kinds of JSON among all readers: 'A JSON', 'B JSON' are 'A, B'.
std::string kinds_that_are_read()
{
    std::string out;
    for (const Reader* reader : weather_readers()) {
        const std::string name = reader->name;
        const std::size_t end = name.rfind(" JSON");
        if (end != std::string::npos) out += (out.empty() ? "" : ", ") + name.substr(0, end);
    }
    return out;
}

}  // namespace

void refuse_unknown_json(const Json& whole)
{
    const Json& root = whole.kind == Json::Kind::Array && !whole.items.empty() ? whole.items[0] : whole;
    const auto has = [&](const char* name) { return root.find(name) != nullptr; };
    // Open-Meteo's own answers without hours: a refusal, or other blocks than those asked for.
    const Json* reason = root.find("reason");
    if (has("error") && reason && reason->kind == Json::Kind::String)
        throw Error("weather: this JSON is a service's refusal: '" + shown(reason->text) + "'",
                    "Ask the service again; nothing was downloaded.");
    if (has("generationtime_ms") || has("utc_offset_seconds"))
        throw Error("weather: an Open-Meteo response without an object 'hourly': " +
                        what_it_is(root),
                    "Ask for hourly values (&hourly=temperature_2m,precipitation,..).");
    throw Error("weather: this JSON is of no kind that is known: it is " + what_it_is(whole),
                "JSON of " + kinds_that_are_read() +
                    " is read, as hours; of other services take CSV, or write one: "
                    "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm.");
}

}  // namespace petrichor::weather
