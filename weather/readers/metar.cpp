// METAR and TAF bulletins: finds the reports in the lines (wrapped, with or without METAR and =),
// takes one station, turns its reports into rows.
#include "weather/readers/metar.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/station_regions.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Bulletin {
    std::vector<MetarReport> reports;
    std::vector<TafForecast> forecasts;
};

bool is_code(std::string_view w)
{
    if (w.size() != 4 || w[0] < 'A' || w[0] > 'Z') return false;
    return std::all_of(w.begin(), w.end(),
                       [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}
bool is_digits(std::string_view w)
{
    return !w.empty() &&
           std::all_of(w.begin(), w.end(), [](char c) { return c >= '0' && c <= '9'; });
}
bool is_day_time(std::string_view w)
{
    return w.size() == 7 && w[6] == 'Z' && is_digits(w.substr(0, 6));
}

// Collects tokens into reports; a report ends at = or where the next begins.
class Assembler {
public:
    Assembler(Bulletin& bulletin, RowCollector& rows) : bulletin_(bulletin), rows_(rows) {}

    void line(std::string_view text, std::size_t number)
    {
        const auto w = words(text, 400);
        for (std::size_t i = 0; i < w.size(); ++i) {
            const auto t = w[i];
            if (t == "METAR" || t == "SPECI" || t == "TAF") {
                flush();
                open(t == "TAF", number);
                continue;
            }
            if (t.size() == 12 && is_digits(t)) {  // YYYYMMDDhhmm before the report
                flush();
                stamp_ = std::string(t);
                continue;
            }
            const bool starts = is_code(t) && i + 1 < w.size() &&
                                (is_day_time(w[i + 1]) || w[i + 1].substr(0, 3) == "NIL");
            if (starts && !text_.empty() && !(taf_ && only_marks())) flush();
            if (starts && !open_) open(false, number);
            if (!open_) {
                if (!is_heading(w)) continue;
                break;
            }
            if (text_.size() > 4000) flush();
            if (!text_.empty()) text_ += ' ';
            text_ += t;
            if (t.back() == '=') flush();
        }
    }
    void flush()
    {
        if (open_ && !text_.empty()) finish();
        text_.clear();
        open_ = false;
        taf_ = false;
    }

private:
    bool only_marks() const { return text_ == "AMD" || text_ == "COR"; }
    static bool is_heading(const std::vector<std::string_view>& w)
    {
        return w.size() == 3 && w[0].size() == 6;
    }
    void open(bool taf, std::size_t number)
    {
        open_ = true;
        taf_ = taf;
        line_ = number;
        text_.clear();
    }
    void finish()
    {
        std::string_view text = text_;
        if (text.substr(0, 4) == "COR ") text.remove_prefix(4);
        if (taf_) {
            if (auto taf = parse_taf(text)) {
                taf->line = line_;
                bulletin_.forecasts.push_back(std::move(*taf));
                return;
            }
        } else if (auto report = parse_metar(text)) {
            report->line = line_;
            if (stamp_.size() == 12) {
                report->year = *to_integer(std::string_view(stamp_).substr(0, 4));
                report->month =
                    static_cast<int>(*to_integer(std::string_view(stamp_).substr(4, 2)));
                stamp_.clear();
            }
            bulletin_.reports.push_back(std::move(*report));
            return;
        }
        rows_.bad_row(line_, "", "'" + shown(text) + "' is not a report");
    }

    Bulletin& bulletin_;
    RowCollector& rows_;
    std::string text_, stamp_;
    std::size_t line_ = 0;
    bool open_ = false, taf_ = false;
};

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
    std::int64_t month_begin() const { return days_from_civil(year_, month_, 1) * 86400000000LL; }

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
    if (std::isnan(r.qnh_pa)) {
        rows.missing(Field::Pressure);
    } else {
        // The altimeter setting is reduced with the standard atmosphere, so that is how it comes
        // back.
        rows.set(Field::Pressure, r.qnh_pa * std::pow(1.0 - 2.25577e-5 * elevation_m, 5.25588));
    }
}

// Reports do not say where the station is; its letters tell day from night.
void place_in_region(const std::string& station, RowCollector& rows)
{
    const auto region = region_of_station(station);
    if (!region) return;
    rows.site().latitude_deg = region->latitude_deg;
    rows.site().longitude_deg = region->longitude_deg;
    rows.note(ReadNote::Kind::Warning, 0, "place",
              "reports do not say where " + station + " is: taken as the middle of " +
                  std::string(region->name) + "; give latitude and longitude");
}

}  // namespace

void read_metar(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Bulletin bulletin;
    {
        Assembler assembler(bulletin, rows);
        Lines lines(text);
        while (const auto line = lines.next()) {
            std::string clean(*line);
            for (char& c : clean) {
                if (static_cast<unsigned char>(c) < 0x20) c = ' ';
            }
            assembler.line(clean, lines.number());
        }
        assembler.flush();
    }
    // Which station: the one asked for, else the one that reports most (the first of equals).
    std::map<std::string, std::size_t> counts;
    for (const auto& r : bulletin.reports) counts[r.station] += r.nil ? 0 : 1;
    for (const auto& f : bulletin.forecasts) counts.emplace(f.station, 0);
    std::string station = options.station;
    for (char& c : station) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::string names;
    std::size_t listed = 0;
    for (const auto& [name, n] : counts) {
        if (listed++ < 40) names.append(names.empty() ? "" : ", ").append(name);
    }
    if (station.empty()) {
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
    } else if (!counts.count(station)) {
        throw Error("weather: METAR: no report of station '" + shown(station) + "'",
                    "Choose one of: " + names + ".");
    }
    rows.site().name = station;
    if (std::isnan(options.site.latitude_deg) || std::isnan(options.site.longitude_deg)) {
        place_in_region(station, rows);
    }
    int year = options.year, month = options.month;
    const bool dated = std::any_of(bulletin.reports.begin(), bulletin.reports.end(),
                                   [](const MetarReport& r) { return r.year != 0; });
    if (year == 0 || month < 1 || month > 12) {
        year = 2020;
        month = 1;
        if (!dated)
            rows.note(ReadNote::Kind::Time, 0, "time",
                      "reports name only the day; placed in January 2020, give year and month to "
                      "change that");
    }
    const double elevation = std::isnan(options.site.elevation_m) ? 0.0 : options.site.elevation_m;

    struct Timed {
        std::int64_t us;
        const MetarReport* report;
    };
    std::vector<Timed> timed;
    Dates dates(year, month);
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
        for (const std::string& odd : r.not_understood)
            rows.note(ReadNote::Kind::Info, r.line, "group", "'" + odd + "' is not understood");
        for (const RunwayState& runway : r.runways) {
            std::string said = runway.runway == 88
                                   ? "all runways: "
                                   : "runway " + std::to_string(runway.runway) + ": ";
            said += runway.cleared ? "cleared" : deposit_name(runway.deposit);
            if (!std::isnan(runway.depth_mm))
                said += ", " + std::to_string(static_cast<int>(runway.depth_mm)) + " mm";
            rows.note(ReadNote::Kind::Info, r.line, "runway", said);
        }
    }
    std::stable_sort(timed.begin(), timed.end(),
                     [](const Timed& a, const Timed& b) { return a.us < b.us; });
    // Corrections repeat a time: the last one holds.
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
    const bool amounts = std::any_of(kept.begin(), kept.end(), [](const Timed& t) {
        return !std::isnan(t.report->hour_precip_mm);
    });
    bool from_weather = false;
    for (const Timed& t : kept) {
        if (!rows.begin_row(t.us, t.report->line)) continue;
        const MetarReport& r = *t.report;
        put_report(rows, r, elevation);
        if (!std::isnan(r.hour_precip_mm))
            rows.fell_before(Field::Precip, r.hour_precip_mm, 1.0);
        else if (amounts && rows.rows() > 1)
            rows.fell_before(Field::Precip, 0.0, 1.0);  // such stations report only what fell
        if (!std::isnan(r.six_hour_precip_mm))
            rows.fell_before(Field::Precip, r.six_hour_precip_mm, 6.0);
        if (!amounts) {
            // No measured amounts at this station: rates from present weather, until the next
            // report.
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

    // A forecast goes on after the last report, hour by hour.
    const TafForecast* taf = nullptr;
    for (const auto& f : bulletin.forecasts) {
        if (f.station == station) taf = &f;
    }
    if (!taf) return;
    Dates taf_dates = dates;
    MetarReport first_day;
    first_day.day = static_cast<int>(taf->begin_hours / 24);
    if (!taf_dates.of(first_day) || taf->end_hours - taf->begin_hours > 72) {
        rows.bad_row(taf->line, "time", "the validity of the forecast is not possible");
        return;
    }
    rows.note(ReadNote::Kind::Info, taf->line, "forecast",
              std::to_string(taf->periods.size())
                  .append(" prevailing periods used, ")
                  .append(std::to_string(taf->passing))
                  .append(" passing ones (TEMPO, PROB) not"));
    const std::int64_t month_begin = taf_dates.month_begin();
    const auto at = [&](std::int64_t hours) { return month_begin + (hours - 24) * 3600000000LL; };
    for (std::int64_t h = taf->begin_hours; h < taf->end_hours; ++h) {
        if (!kept.empty() && at(h) <= kept.back().us) continue;
        const TafPeriod* now = &taf->periods.front();
        for (const TafPeriod& p : taf->periods) {
            if (p.from_hours <= h) now = &p;
        }
        if (!rows.begin_row(at(h), taf->line)) continue;
        MetarReport r = now->weather;
        for (const auto& [hour, t] : taf->temperatures_c) {
            if (hour == h) r.temp_c = t;
        }
        put_report(rows, r, elevation);
        if (amounts) {
            rows.set(Field::Precip, (r.rain_mm_h + r.snow_mm_h) / 3600.0);
        } else {
            rows.set(Field::Rain, r.rain_mm_h / 3600.0);
            rows.set(Field::Snow, r.snow_mm_h / 3600.0);
        }
    }
}

}  // namespace petrichor::weather
