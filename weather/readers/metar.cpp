// METAR and TAF bulletins: takes one station, dates its reports and forecasts, turns them into
// rows.
#include "weather/readers/metar.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/bulletin.h"
#include "weather/readers/formats.h"
#include "weather/readers/report_lines.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

// Days of the month become dates: a day much smaller than the one before is in the next month.
class Dates {
public:
    Dates(int year, int month) : year_(year), month_(month) {}
    std::optional<std::int64_t> of(const MetarReport& r)
    {
        if (r.year) {
            year_ = r.year;
            month_ = r.month;
        } else if (last_day_ && r.day < last_day_ - 15) {
            month_ = month_ % 12 + 1;
            year_ += month_ == 1;
        } else if (last_day_ && r.day > last_day_ + 15) {
            // Newest first: one month back.
            month_ = (month_ + 10) % 12 + 1;
            year_ -= month_ == 12;
        }
        last_day_ = r.day;
        return us_from_civil({year_, month_, r.day, r.hour, r.minute, 0.0});
    }

private:
    long long year_;
    int month_;
    int last_day_ = 0;
};

void put_report(RowCollector& rows, const MetarReport& r, double elevation_m)
{
    const auto put = [&](Field field, double value) {
        if (std::isnan(value))
            rows.missing(field);
        else
            rows.set(field, value);
    };
    put(Field::AirTemp, r.temp_c + kZeroCelsiusK);
    put(Field::DewPoint, r.dew_c + kZeroCelsiusK);
    put(Field::Wind, r.wind_m_s);
    put(Field::WindFrom, r.wind_from_deg);
    put(Field::Visibility, r.visibility_m);
    put(Field::Cloud, r.cloud);
    if (!std::isnan(r.snow_depth_m)) rows.set(Field::SnowDepth, r.snow_depth_m);
    // The first runway that says something about most of itself; 99 repeats an older report.
    const auto seen = [&](Field field, const auto& value_of) {
        for (const RunwayState& runway : r.runways) {
            const double value = runway.runway == 99 ? kMissing : value_of(runway);
            if (std::isnan(value)) continue;
            rows.set(field, value);
            return;
        }
    };
    seen(Field::Condition, [](const RunwayState& runway) {
        const auto condition = condition_of(runway);
        return condition ? static_cast<double>(*condition) : kMissing;
    });
    seen(Field::Friction, [](const RunwayState& runway) { return runway.friction; });
    if (std::isnan(r.qnh_pa)) {
        rows.missing(Field::Pressure);
    } else {
        // The altimeter setting is reduced with the standard atmosphere, so that is how it comes
        // back.
        rows.set(Field::Pressure, r.qnh_pa * std::pow(1.0 - 2.25577e-5 * elevation_m, 5.25588));
    }
}

// The station asked for, else the one that reports most (the first of equals).
std::string chosen_station(const Bulletin& bulletin, const std::string& asked, RowCollector& rows)
{
    std::map<std::string, std::size_t> counts;
    for (const auto& r : bulletin.reports) counts[r.station] += r.nil ? 0 : 1;
    for (const auto& f : bulletin.forecasts) counts.emplace(f.station, 0);
    std::string names;
    std::size_t listed = 0;
    for (const auto& [name, n] : counts) {
        if (listed++ < 40) names.append(names.empty() ? "" : ", ").append(name);
    }
    std::string station = asked;
    for (char& c : station) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (!station.empty()) {
        if (counts.count(station)) return station;
        throw Error("weather: METAR: no report of station '" + shown(station) + "'",
                    "Choose one of: " + names + ".");
    }
    std::size_t most = 0;
    for (const auto& r : bulletin.reports) {
        if (!r.nil && counts[r.station] > most) {
            most = counts[r.station];
            station = r.station;
        }
    }
    if (station.empty() && !bulletin.forecasts.empty())
        station = bulletin.forecasts.front().station;
    if (counts.size() > 1)
        rows.note(ReadNote::Kind::Info, 0, "station",
                  "several stations, " + station + " is used; the file has " + names);
    return station;
}

struct Timed {
    std::int64_t us;
    const MetarReport* report;
};

void note_details(RowCollector& rows, const MetarReport& r)
{
    for (const std::string& odd : r.not_understood)
        rows.note(ReadNote::Kind::Info, r.line, "group", "'" + odd + "' is not understood");
    for (const RunwayState& runway : r.runways) {
        std::string said = runway.runway == 88 ? "all runways: "
                                               : "runway " + std::to_string(runway.runway) + ": ";
        said += runway.cleared ? "cleared" : deposit_name(runway.deposit);
        if (!std::isnan(runway.depth_mm))
            said += ", " + std::to_string(static_cast<int>(runway.depth_mm)) + " mm";
        rows.note(ReadNote::Kind::Info, r.line, "runway", said);
    }
}

// The station's reports in order of time. Corrections repeat a time: the last one holds.
std::vector<Timed> dated_reports(const Bulletin& bulletin, const std::string& station, Dates dates,
                                 RowCollector& rows)
{
    std::vector<Timed> timed;
    for (const MetarReport& r : bulletin.reports) {
        if (r.station != station) continue;
        if (r.nil) {
            rows.note(ReadNote::Kind::Info, r.line, "", "NIL report");
            continue;
        }
        const auto us = dates.of(r);
        if (!us) {
            rows.bad_row(r.line, "time",
                         "day " + std::to_string(r.day) + " does not exist in that month");
            continue;
        }
        timed.push_back({*us, &r});
        note_details(rows, r);
    }
    std::stable_sort(timed.begin(), timed.end(),
                     [](const Timed& a, const Timed& b) { return a.us < b.us; });
    std::vector<Timed> kept;
    for (const Timed& t : timed) {
        if (!kept.empty() && kept.back().us == t.us) {
            rows.note(ReadNote::Kind::Time, t.report->line, "time",
                      "second report for the same time, the last one holds");
            kept.back() = t;
        } else {
            kept.push_back(t);
        }
    }
    return kept;
}

// Remark 6nnnn covers 6 h at 00, 06, 12 and 18 UTC and 3 h at the hours between.
double hours_of_six(const MetarReport& r)
{
    const int hour = (r.hour * 60 + r.minute + 30) / 60;
    return hour % 6 == 3 ? 3.0 : 6.0;
}

// `amounts`: the station measures precipitation; else rates come from present weather and hold
// until the next report.
void put_observed(RowCollector& rows, const std::vector<Timed>& kept, bool amounts,
                  double elevation_m)
{
    bool from_weather = false;
    for (const Timed& t : kept) {
        if (!rows.begin_row(t.us, t.report->line)) continue;
        const MetarReport& r = *t.report;
        put_report(rows, r, elevation_m);
        if (!std::isnan(r.hour_precip_mm))
            rows.fell_before(Field::Precip, r.hour_precip_mm, 1.0);
        else if (amounts && rows.rows() > 1)
            rows.fell_before(Field::Precip, 0.0, 1.0);  // such stations report only what fell
        if (!std::isnan(r.six_hour_precip_mm))
            rows.fell_before(Field::Precip, r.six_hour_precip_mm, hours_of_six(r));
        if (!amounts) {
            rows.set(Field::Rain, r.rain_mm_h / 3600.0);
            rows.set(Field::Snow, r.snow_mm_h / 3600.0);
            from_weather = from_weather || r.weather_seen;
        }
    }
    if (from_weather) {
        rows.note(ReadNote::Kind::Info, 0, "precip",
                  "rates from present weather: drizzle 0.1/0.3/0.8, rain 1/4.5/12, snow 0.5/1.5/3 "
                  "mm/h for light/moderate/heavy");
    }
}

// Forecasts of the station that can be dated; later issues last, as they replace earlier ones.
std::vector<TafForecast> placed_forecasts(const Bulletin& bulletin, const std::string& station,
                                          const std::vector<Timed>& reports, Dates dates,
                                          RowCollector& rows)
{
    std::vector<TafForecast> placed;
    for (TafForecast taf : bulletin.forecasts) {
        if (taf.station != station) continue;
        if (taf.nil) {
            rows.note(ReadNote::Kind::Info, taf.line, "forecast", "NIL forecast");
            continue;
        }
        // Near the last report; without one, in the month that was given.
        MetarReport day;
        day.day = taf.issued.day ? taf.issued.day : taf.begin.day;
        day.year = taf.year;
        day.month = taf.month;
        const auto own = dates.of(day);
        const bool follows = !reports.empty() && !taf.year;
        if (!(follows || own) || !place_taf(taf, follows ? reports.back().us : *own)) {
            rows.bad_row(taf.line, "time", "the validity of the forecast is not possible");
            continue;
        }
        placed.push_back(std::move(taf));
    }
    std::stable_sort(placed.begin(), placed.end(), [](const TafForecast& a, const TafForecast& b) {
        return a.issued_us < b.issued_us;
    });
    return placed;
}

void note_forecast(RowCollector& rows, const TafForecast& taf, TafUse use)
{
    std::size_t counts[3] = {};
    for (const TafGroup& group : taf.groups) ++counts[static_cast<std::size_t>(group.kind)];
    std::string text = taf.cancelled ? "cancelled"
                                     : "from " + iso_from_us(taf.begin_us) + " to " +
                                           iso_from_us(taf.end_us) + ": ";
    if (!taf.cancelled) {
        text += std::to_string(counts[0] - 1) + " FM, " + std::to_string(counts[1]) + " BECMG, " +
                std::to_string(counts[2]) + " TEMPO or PROB groups";
        if (counts[2] && use == TafUse::Expected)
            text += ", these by their share (TEMPO 0.5, PROB30 0.3, PROB40 0.4, PROB30 TEMPO 0.15)";
        if (counts[2] && use == TafUse::Worst) text += ", the worst of all taken";
        if (counts[2] && use == TafUse::Prevailing) text += ", these not used";
    }
    rows.note(ReadNote::Kind::Info, taf.line, "forecast", text);
}

// Forecasts go on after the last report. Each time belongs to the last issue that covers it.
void put_forecasts(RowCollector& rows, const std::vector<TafForecast>& placed, TafUse use,
                   const std::vector<Timed>& reports, bool amounts, double elevation_m)
{
    std::map<std::int64_t, const TafForecast*> times;
    for (const TafForecast& taf : placed) {
        note_forecast(rows, taf, use);
        const auto begin = times.lower_bound(taf.begin_us);
        if (taf.cancelled) {
            times.erase(begin, times.upper_bound(taf.end_us));
            continue;
        }
        times.erase(begin, times.lower_bound(taf.end_us));
        for (const std::int64_t us : taf_times(taf)) {
            // The end of this one may be inside an earlier forecast, which then goes on.
            if (us < taf.end_us || !times.count(us)) times[us] = &taf;
        }
    }
    for (auto at = times.begin(); at != times.end(); ++at) {
        const TafForecast& taf = *at->second;
        if (!reports.empty() && at->first <= reports.back().us) continue;
        if (!rows.begin_row(at->first, taf.line)) continue;
        const auto next = std::next(at);
        const bool last = at->first >= taf.end_us;
        MetarReport r = taf_weather(taf, last ? taf.end_us - 1 : at->first,
                                    next == times.end() ? taf.end_us : next->first, use);
        for (const auto& [us, celsius] : taf.temperatures_at_us_c) {
            if (us == at->first) r.temp_c = celsius;
        }
        if (last) r.rain_mm_h = r.snow_mm_h = 0.0;  // nothing is known from here on
        put_report(rows, r, elevation_m);
        if (amounts) {
            rows.set(Field::Precip, (r.rain_mm_h + r.snow_mm_h) / 3600.0);
        } else {
            rows.set(Field::Rain, r.rain_mm_h / 3600.0);
            rows.set(Field::Snow, r.snow_mm_h / 3600.0);
        }
    }
}

}  // namespace

static void read_metar(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const Bulletin bulletin = read_bulletin(text, rows);
    const std::string station = chosen_station(bulletin, options.station, rows);
    rows.site().name = station;
    if (std::isnan(options.site.latitude_deg) || std::isnan(options.site.longitude_deg)) {
        rows.note(ReadNote::Kind::Warning, 0, "place",
                  "reports do not say where " + station + " is: give latitude and longitude");
    }
    int year = options.year, month = options.month;
    const auto has_year = [](const auto& r) { return r.year != 0; };
    const bool dated = std::any_of(bulletin.reports.begin(), bulletin.reports.end(), has_year) ||
                       std::any_of(bulletin.forecasts.begin(), bulletin.forecasts.end(), has_year);
    if (year == 0 || month < 1 || month > 12) {
        year = 2020;
        month = 1;
        if (!dated)
            rows.note(ReadNote::Kind::Warning, 0, "time",
                      "reports name only the day: placed in January 2020; give year and month");
    }
    const double elevation = std::isnan(options.site.elevation_m) ? 0.0 : options.site.elevation_m;
    const Dates dates(year, month);
    const std::vector<Timed> kept = dated_reports(bulletin, station, dates, rows);
    const bool amounts = std::any_of(kept.begin(), kept.end(), [](const Timed& t) {
        return !std::isnan(t.report->hour_precip_mm);
    });
    put_observed(rows, kept, amounts, elevation);
    put_forecasts(rows, placed_forecasts(bulletin, station, kept, dates, rows), options.taf, kept,
                  amounts, elevation);
}

namespace {

bool is_station_code(std::string_view w)
{
    if (w.size() != 4 || w[0] < 'A' || w[0] > 'Z') return false;
    return std::all_of(w.begin(), w.end(),
                       [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

bool looks_like_report(std::string_view line)
{
    const auto is_day_time = [](std::string_view w) {
        return w.size() == 7 && w.back() == 'Z' && to_integer(w.substr(0, 6)).has_value();
    };
    const auto w = words(line, 8);
    for (std::size_t i = 0; i + 1 < w.size(); ++i) {
        if (is_station_code(w[i]) &&
            (is_day_time(w[i + 1]) || w[i + 1] == "NIL=" || w[i + 1] == "NIL"))
            return true;
    }
    return false;
}

bool recognise(const FileHead& head)
{
    return std::any_of(head.lines.begin(), head.lines.end(), looks_like_report) ||
           std::any_of(head.lines.begin(), head.lines.end(), is_ogimet_row) ||
           ReportLines(head.text).is_table();
}

}  // namespace

extern const Reader metar_reader;
const Reader metar_reader{"METAR",
                          "reports and forecasts of airports, bare or as tables of archives",
                          recognise, read_metar};

}  // namespace petrichor::weather
