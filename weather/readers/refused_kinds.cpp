#include "weather/readers/refused_kinds.h"

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

void refuse_known_kinds(const FileHead& head)
{
    // MeteoSwiss' older orders: hours whose stamps were their ends in some years, not in others.
    if (head.first.rfind("stn;time;", 0) == 0 && head.first.find("tre200") != head.first.npos)
        throw Error("weather: this is an order of MeteoSwiss' IDAweb, which does not say whether its "
                    "times are the beginnings or the ends of hours",
                    "Take the station's file of hours or ten minutes from MeteoSwiss' open data "
                    "(station_abbr;reference_timestamp;..).");
    // The text export of Davis' older program: two lines of names over one another.
    if (head.lines.size() < 3) return;
    const std::string above = lower(head.lines[0]), below = lower(head.lines[1]);
    const auto w = words(below, 64);
    if (w.size() > 8 && w[0] == "date" && w[1] == "time" && w[2] == "out" &&
        above.find("temp") != above.npos && above.find("rain") != above.npos)
        throw Error("weather: this is a text file of Davis' WeatherLink program, which names no units",
                    "Export the same days as CSV from weatherlink.com, or put names with units "
                    "above them: date,time,air_temp_f,rel_humidity_pct,wind_mph,rain_in.");
}

}  // namespace petrichor::weather
