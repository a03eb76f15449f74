// Twelve columns of numbers: year month day hour SW LW snowfall rainfall T RH wind pressure; SI,
// UTC.
#include <algorithm>

#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

static void read_fsm(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    constexpr Field kFields[] = {Field::Shortwave, Field::Longwave, Field::Snow,
                                 Field::Rain,      Field::AirTemp,  Field::RelHumidity,
                                 Field::Wind,      Field::Pressure};
    Lines lines(text);
    std::vector<std::string_view> w;
    while (const auto line = lines.next()) {
        words(*line, w, 64);
        if (w.empty()) continue;
        if (w.size() != 12) {
            rows.bad_row(lines.number(), "",
                         "has " + std::to_string(w.size()) + " columns, 12 are needed");
            continue;
        }
        const auto year = to_number(w[0]), month = to_number(w[1]), day = to_number(w[2]),
                   hour = to_number(w[3]);
        if (!year || !month || !day || !hour || *hour < 0.0 || *hour > 24.0 || *year < 1500 ||
            *year > 2600 || *month < 1 || *month > 12 || *day < 1 || *day > 31) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(*line) + "' does not begin with a date and an hour");
            continue;
        }
        // Hours may have decimals: 0.5 is half past midnight.
        const auto midnight =
            us_from_civil({static_cast<long long>(*year), static_cast<int>(*month),
                           static_cast<int>(*day), 0, 0, 0.0});
        if (!midnight) {
            rows.bad_row(lines.number(), "time", "'" + shown(*line) + "': there is no such day");
            continue;
        }
        if (!rows.begin_row(*midnight + static_cast<std::int64_t>(*hour * 3600e6 + 0.5),
                            lines.number()))
            continue;
        for (std::size_t i = 0; i < 8; ++i) {
            const auto value = to_number(w[4 + i]);
            if (!value)
                rows.unreadable(kFields[i], w[4 + i]);
            else if (*value <= -99.0)
                rows.missing(kFields[i]);
            else
                rows.set(kFields[i], *value);
        }
    }
}

namespace {

// Twelve numbers a row, as ISD-Lite, but not whole ones. The first rows may be the bad ones.
bool recognise(const FileHead& head)
{
    return std::any_of(head.lines.begin(), head.lines.end(), [](std::string_view line) {
        const auto columns = words(line, 64);
        return columns.size() == 12 && all_numbers(columns);
    });
}

}  // namespace

extern const Reader fsm_reader;
const Reader fsm_reader{"FSM 12 columns", "driving data of FSM and FSM2, no header", recognise,
                        read_fsm};

}  // namespace petrichor::weather
