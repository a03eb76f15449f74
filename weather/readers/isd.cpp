// NOAA Integrated Surface Data as it is archived: a report a line, 105 fixed columns, then ADD and
// groups that begin with two letters and a digit, then REM. UTC.
#include <algorithm>
#include <array>
#include <cmath>

#include "weather/readers/formats.h"
#include "weather/readers/isd_groups.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

// Widths of the parts of the groups that are used, and the lengths of the others, so that data is
// never taken for the name of a group.
struct GroupShape {
    std::string_view kind;
    std::array<int, 8> widths;  // parts, 0 ends
};
constexpr GroupShape kUsed[] = {
    {"AA", {2, 4, 1, 1}},
    {"AJ", {4, 1, 1, 6, 1, 1}},
    {"AU", {1, 1, 2, 1, 1, 1, 1}},
    {"AW", {2, 1}},
    {"MW", {2, 1}},
    {"GA", {2, 1, 6, 1, 2, 1}},
    {"GD", {1, 2, 1, 6, 1, 1}},
    {"GF", {2, 2, 1, 2, 1, 2, 1, 5}},
    {"MA", {5, 1, 5, 1}},
    {"GH", {5, 1, 1, 5, 1, 1, 5, 1}},
};
struct GroupLength {
    std::string_view kind;
    std::size_t length;
};
constexpr GroupLength kLengths[] = {
    {"AA", 8},  {"AB", 7},  {"AC", 3},  {"AD", 19}, {"AE", 12}, {"AG", 4},  {"AH", 15}, {"AI", 15},
    {"AJ", 14}, {"AK", 12}, {"AL", 7},  {"AM", 18}, {"AN", 9},  {"AO", 8},  {"AP", 6},  {"AT", 9},
    {"AU", 8},  {"AW", 3},  {"AX", 6},  {"AY", 5},  {"AZ", 5},  {"CB", 10}, {"CF", 6},  {"CG", 8},
    {"CH", 15}, {"CI", 28}, {"CN", 18}, {"CO", 5},  {"CR", 7},  {"CT", 7},  {"CU", 13}, {"CV", 26},
    {"CW", 14}, {"CX", 26}, {"ED", 8},  {"GA", 13}, {"GD", 12}, {"GE", 19}, {"GF", 23}, {"GG", 15},
    {"GH", 28}, {"GJ", 5},  {"GK", 4},  {"GL", 6},  {"GM", 30}, {"GN", 28}, {"GO", 19}, {"GP", 31},
    {"GQ", 14}, {"GR", 14}, {"HL", 4},  {"IA", 3},  {"IB", 27}, {"IC", 25}, {"KA", 10}, {"KB", 10},
    {"KC", 14}, {"KD", 9},  {"KE", 12}, {"KF", 6},  {"KG", 11}, {"MA", 12}, {"MD", 11}, {"ME", 6},
    {"MF", 12}, {"MG", 12}, {"MH", 12}, {"MK", 24}, {"MV", 3},  {"MW", 3},  {"OA", 8},  {"OB", 28},
    {"OC", 5},  {"OD", 11}, {"OE", 16}, {"RH", 9},  {"SA", 5},  {"ST", 17}, {"UA", 10}, {"UG", 9},
    {"WA", 6},  {"WD", 20}, {"WG", 11}, {"WJ", 19},
};

// Puts the groups behind ADD into the report; stops at what has no known length.
void read_groups(std::string_view data, IsdReport& report, std::vector<std::string_view>& parts)
{
    while (data.size() >= 3) {
        const auto id = data.substr(0, 3);
        const auto known = std::find_if(std::begin(kLengths), std::end(kLengths),
                                        [&](auto& g) { return id.substr(0, 2) == g.kind; });
        if (known == std::end(kLengths) || id[2] < '0' || id[2] > '9') return;
        // AH to AI and others count on in the second letter only by their own entries.
        const auto body = data.substr(3, known->length);
        if (body.size() < known->length) return;
        for (const GroupShape& shape : kUsed) {
            if (shape.kind != id.substr(0, 2)) continue;
            parts.clear();
            std::size_t at = 0;
            for (const int width : shape.widths) {
                if (width == 0 || at >= body.size()) break;
                parts.push_back(body.substr(at, static_cast<std::size_t>(width)));
                at += static_cast<std::size_t>(width);
            }
            report.group(id, parts);
        }
        data.remove_prefix(3 + known->length);
    }
}

double scaled(std::string_view text, double scale)
{
    const auto number = to_integer(text);
    return number ? static_cast<double>(*number) * scale : kMissing;
}

std::optional<std::int64_t> time_of(std::string_view line)
{
    std::string iso(line.substr(15, 4));
    iso.append("-").append(line.substr(19, 2)).append("-").append(line.substr(21, 2));
    iso.append("T").append(line.substr(23, 2)).append(":").append(line.substr(25, 2));
    return us_from_iso(iso);
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    rows.join_same_times();
    rows.means_of_past(Field::Shortwave);
    Site& site = rows.site();
    bool placed = false;
    std::optional<IsdReport> report;
    std::vector<std::string_view> parts;
    std::size_t sums = 0;
    while (const auto next = lines.next()) {
        const auto line = *next;
        if (trimmed(line).empty()) continue;
        if (line.size() < 105) {
            rows.bad_row(lines.number(), "",
                         "has " + std::to_string(line.size()) + " characters, 105 are needed");
            continue;
        }
        if (line.substr(41, 3) == "SOD" || line.substr(41, 3) == "SOM") {
            ++sums;
            continue;
        }
        const auto us = time_of(line);
        if (!us) {
            rows.bad_row(lines.number(), "time",
                         "'" + shown(line.substr(15, 12)) + "' is not YYYYMMDDhhmm");
            continue;
        }
        if (!placed) {
            placed = true;
            const double latitude = scaled(line.substr(28, 6), 0.001),
                         longitude = scaled(line.substr(34, 7), 0.001),
                         elevation = scaled(line.substr(46, 5), 1.0);
            if (std::abs(latitude) <= 90.0 && std::abs(longitude) <= 180.0) {
                site.latitude_deg = latitude;
                site.longitude_deg = longitude;
            }
            if (elevation < 9000.0) site.elevation_m = elevation;
            site.name = std::string(trimmed(line.substr(4, 11)));
            report.emplace(rows, std::isnan(options.site.elevation_m) ? site.elevation_m
                                                                      : options.site.elevation_m);
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        report->begin();
        report->wind(line.substr(60, 3), line.substr(64, 1), line.substr(65, 4),
                     line.substr(69, 1));
        report->visibility(line.substr(78, 6), line.substr(84, 1));
        report->air(line.substr(87, 5), line.substr(92, 1));
        report->dew(line.substr(93, 5), line.substr(98, 1));
        report->sea_level_pressure(line.substr(99, 5), line.substr(104, 1));
        const auto rest = line.substr(105);
        if (rest.substr(0, 3) == "ADD") read_groups(rest.substr(3), *report, parts);
        const auto remark = rest.find("REM");
        if (report->lacks_sky_or_air() && remark != rest.npos)
            report->metar(rest.substr(remark + 3));
        report->end();
    }
    if (sums)
        rows.note(ReadNote::Kind::Info, 0, "rows",
                  std::to_string(sums) + " sums of days or months left out");
    if (report && report->dropped())
        rows.note(
            ReadNote::Kind::Info, 0, "quality",
            std::to_string(report->dropped()) + " values that failed a check, taken as missing");
    rows.use_seen_precipitation(!report || !report->has_amounts());
}

bool recognise(const FileHead& head)
{
    const auto line = head.lines.front();
    return line.size() >= 105 && to_integer(line.substr(0, 4)) && to_integer(line.substr(15, 12)) &&
           (line[28] == '+' || line[28] == '-') && (line[34] == '+' || line[34] == '-') &&
           (line[87] == '+' || line[87] == '-') && (line[93] == '+' || line[93] == '-');
}

}  // namespace

extern const Reader isd_reader;
const Reader isd_reader{"ISD", "NOAA Integrated Surface Data, fixed columns", recognise, read};

}  // namespace petrichor::weather
