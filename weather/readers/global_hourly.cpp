// NOAA global hourly: the Integrated Surface Data as CSV, a column a group with its parts between
// commas ("+0020,1"), the report as it was sent in REM. UTC. Rows of sums of days and months are no
// weather of their time and are left out.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "weather/readers/formats.h"
#include "weather/readers/isd_groups.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

// A report a line; a quoted cell may hold commas. `part` finds pieces of a group.
class Parts {
public:
    const std::vector<std::string_view>& of(std::string_view cell)
    {
        split(cell, ',', parts_, 16);
        return parts_;
    }

private:
    std::vector<std::string_view> parts_;
};

bool is_used_group(std::string_view name)
{
    if (name.size() != 3 || name[2] < '1' || name[2] > '9') return false;
    for (const char* kind : {"aa", "aj", "au", "aw", "mw", "ga", "gd", "gf", "gh", "ma"}) {
        if (name.substr(0, 2) == kind) return true;
    }
    return false;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    struct Group {
        std::size_t at;
        std::string id;
    };
    std::vector<Group> groups;
    for (std::size_t i = 0; i < header.size(); ++i) {
        std::string id = header.names()[i];
        if (!is_used_group(id)) continue;
        static_cast<void>(header.at(id));
        for (char& c : id) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
        groups.push_back({i, id});
    }
    // Total cloud before its layers.
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return (a.id.substr(0, 2) == "GF") > (b.id.substr(0, 2) == "GF");
    });
    const std::size_t date = header.at("date"), type = header.at("report_type"),
                      wind = header.at("wnd"), sight = header.at("vis"), air = header.at("tmp"),
                      dew = header.at("dew"), sea = header.at("slp"), remark = header.at("rem");
    Site& site = rows.site();
    {
        Lines below = lines;
        const auto f = split(below.next().value_or(""), ',', 512);
        site.latitude_deg = to_number(cell_of(f, header.at("latitude"))).value_or(kMissing);
        site.longitude_deg = to_number(cell_of(f, header.at("longitude"))).value_or(kMissing);
        site.elevation_m = to_number(cell_of(f, header.at("elevation"))).value_or(kMissing);
        site.name = shown(cell_of(f, header.at("name")));
        if (site.latitude_deg == 0.0 && site.longitude_deg == 0.0) {
            const Site& given = options.site;
            std::string lacks;
            for (const auto& [value, name] :
                 {std::pair{given.latitude_deg, "latitude"}, {given.longitude_deg, "longitude"},
                  {given.elevation_m, "elevation"}})
                if (std::isnan(value)) lacks.append(lacks.empty() ? "" : ", ").append(name);
            rows.note(lacks.empty() ? ReadNote::Kind::Info : ReadNote::Kind::Warning, 2, "place",
                      "0 N 0 E at " + shown(cell_of(f, header.at("elevation"))) +
                          " m is no place of a station: " +
                          (lacks.empty() ? "that which is given is taken" : "give " + lacks));
            site.latitude_deg = site.longitude_deg = site.elevation_m = kMissing;
        }
    }
    rows.unread_columns(header.unread());
    const double elevation =
        std::isnan(options.site.elevation_m) ? site.elevation_m : options.site.elevation_m;
    rows.join_same_times();
    rows.means_of_past(Field::Shortwave);
    IsdReport report(rows, elevation);
    Parts parts;
    std::size_t sums = 0;
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, ',', f, 512);
        const auto kind = cell_of(f, type).substr(0, 3);
        if (kind == "SOD" || kind == "SOM") {
            ++sums;
            continue;
        }
        const auto us = us_from_iso(cell_of(f, date));
        if (!us) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(cell_of(f, date)) + "' is not a date and time");
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        report.begin();
        const auto& w = parts.of(cell_of(f, wind));
        report.wind(cell_of(w, 0), cell_of(w, 2), cell_of(w, 3), cell_of(w, 4));
        const auto& v = parts.of(cell_of(f, sight));
        report.visibility(cell_of(v, 0), cell_of(v, 1));
        const auto& t = parts.of(cell_of(f, air));
        report.air(cell_of(t, 0), cell_of(t, 1));
        const auto& d = parts.of(cell_of(f, dew));
        report.dew(cell_of(d, 0), cell_of(d, 1));
        const auto& s = parts.of(cell_of(f, sea));
        report.sea_level_pressure(cell_of(s, 0), cell_of(s, 1));
        for (const Group& group : groups) {
            const auto cell = cell_of(f, group.at);
            if (!cell.empty()) report.group(group.id, parts.of(cell));
        }
        if (report.lacks_sky_or_air()) report.metar(cell_of(f, remark));
        report.end();
    }
    if (sums)
        rows.note(ReadNote::Kind::Info, 0, "rows",
                  std::to_string(sums) + " sums of days or months left out");
    if (report.dropped())
        rows.note(
            ReadNote::Kind::Info, 0, "quality",
            std::to_string(report.dropped()) + " values that failed a check, taken as missing");
    rows.use_seen_precipitation(!report.has_amounts());
}

bool recognise(const FileHead& head)
{
    return head.has_columns({"station", "date", "report_type", "wnd", "tmp"}) ||
           head.has_columns({"station", "date", "wnd", "tmp", "dew"});
}

}  // namespace

extern const Reader global_hourly_reader;
const Reader global_hourly_reader{"NOAA global hourly", "Integrated Surface Data as CSV", recognise,
                                  read};

}  // namespace petrichor::weather
