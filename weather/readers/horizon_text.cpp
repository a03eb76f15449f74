#include "weather/readers/horizon_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostDirections = 3600;
constexpr double kDegree = kPi / 180.0;

}  // namespace

Horizon read_horizon(std::string_view text, const std::string& name)
{
    std::map<double, double> given;
    Lines lines(text);
    std::size_t number = 0;
    while (const auto line = lines.next()) {
        ++number;
        std::string plain(trimmed(line->substr(0, line->find('#'))));
        std::replace_if(
            plain.begin(), plain.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
        const auto fields = words(plain, 8);
        if (fields.empty()) continue;
        const auto azimuth = to_number(fields[0]);
        const auto elevation = fields.size() > 1 ? to_number(fields[1]) : std::nullopt;
        if (!azimuth && given.empty()) continue;  // a heading
        const std::string where = "horizon: " + name + " line " + std::to_string(number) + ": ";
        if (!azimuth || !elevation || fields.size() != 2 || !(std::abs(*azimuth) <= 360.0) ||
            !(*elevation >= -90.0 && *elevation <= 90.0)) {
            throw Error(where + "'" + shown(*line) + "' is not an azimuth and an elevation",
                        "Write two numbers a line, degrees: the azimuth from north over east in "
                        "-360..360 and the elevation in -90..90.");
        }
        double turn = *azimuth < 0.0 ? *azimuth + 360.0 : *azimuth;
        if (turn >= 360.0) {
            // 360 closes the circle that 0 began.
            turn -= 360.0;
            if (given.count(turn)) continue;
        }
        if (!given.emplace(turn, std::max(*elevation, 0.0) * kDegree).second)
            throw Error(where + "azimuth " + std::string(fields[0]) + " stands there twice",
                        "Give each azimuth once.");
        if (given.size() > kMostDirections)
            throw Error("horizon: " + name + " has more than 3600 azimuths",
                        "A tenth of a degree is fine enough.");
    }
    if (given.size() < 2)
        throw Error("horizon: " + name + " has " + std::to_string(given.size()) + " azimuths",
                    "Give at least two lines of azimuth and elevation in degrees.");
    Horizon out(360);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double azimuth = static_cast<double>(i);
        auto after = given.lower_bound(azimuth);
        const auto last = std::prev(given.end());
        const bool wraps = after == given.end();
        if (wraps) after = given.begin();
        const auto before = after == given.begin() ? last : std::prev(after);
        const double to = after->first + (wraps ? 360.0 : 0.0);
        const double from =
            before->first - (!wraps && after == given.begin() && before->first >= to ? 360.0 : 0.0);
        const double x = to > from ? (azimuth - from) / (to - from) : 1.0;
        out[i] = before->second + (after->second - before->second) * x;
    }
    return out;
}

}  // namespace petrichor::weather
