#include "cli/bench/skill/board.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/bench/skill/find_sets.h"
#include "cli/bench/skill/longwave.h"
#include "cli/bench/skill/meadow.h"
#include "cli/bench/skill/road_hindcast.h"
#include "cli/bench/skill/urban.h"
#include "cli/simulate/physical_table.h"
#include "cli/simulate/physics_keys.h"
#include "weather/physics/constants.h"

namespace petrichor::cli {
namespace {

constexpr std::size_t kMostRivalBytes = 64u << 20;

weather::PhysicalParams params_of(const SkillOptions& options, const char* surface)
{
    weather::PhysicalParams params;
    params.surface = weather::surface_preset(surface);
    const bool paved = std::string_view(surface) != "grass";
    for (const std::string& setting : options.settings) {
        // road.X is surface.X of the roads alone.
        const bool for_roads = setting.rfind("road.", 0) == 0;
        if (for_roads && paved) apply_physics_setting("surface." + setting.substr(5), params);
        if (!for_roads) apply_physics_setting(setting, params);
    }
    return params;
}

// A rival reads the files named in its environment and prints depth and SWE day by day.
SnowHours rival_hours(const SkillRival& rival, const WinterSet& set)
{
    ::setenv("MET", set.weather_file.c_str(), 1);
    ::setenv("OBS", set.observed_file.c_str(), 1);
    ::setenv("WINTER", set.winter.name.c_str(), 1);
    const auto close = [](std::FILE* pipe) { ::pclose(pipe); };
    std::unique_ptr<std::FILE, decltype(close)> pipe(::popen(rival.command.c_str(), "r"), close);
    std::string text;
    char piece[4096];
    while (pipe && text.size() < kMostRivalBytes) {
        const std::size_t n = std::fread(piece, 1, sizeof piece, pipe.get());
        if (n == 0) break;
        text.append(piece, n);
    }
    const Observations printed =
        read_observations(text, "what rival " + rival.name + " printed", physical_columns());
    SnowHours out;
    out.begin_us = set.winter.table.time_us.front();
    const std::int64_t hour_us = 3600LL * weather::kMicrosPerSecond;
    const auto count = (set.winter.table.time_us.back() - out.begin_us) / hour_us + 1;
    out.hours.assign(static_cast<std::size_t>(count),
                     {kNoScore, kNoScore, kNoScore, kNoScore, 0.0});
    for (const ObservedColumn& column : printed.columns) {
        double SnowHour::*value = column.column == "snow_depth_m"     ? &SnowHour::depth_m
                                  : column.column == "swe_kg_m2"      ? &SnowHour::swe_kg_m2
                                  : column.column == "snow_albedo"    ? &SnowHour::albedo
                                  : column.column == "surface_temp_c" ? &SnowHour::surface_c
                                                                      : nullptr;
        for (std::size_t i = 0; value && i < column.values.size(); ++i) {
            // A day's value holds all day.
            for (int h = 0; h < (printed.daily ? 24 : 1); ++h) {
                const std::int64_t at = (column.time_us[i] - out.begin_us) / hour_us + h;
                if (at >= 0 && at < count)
                    out.hours[static_cast<std::size_t>(at)].*value = column.values[i];
            }
        }
    }
    return out;
}

double score_in(const std::vector<SkillRow>& rows, const std::string& quantity)
{
    for (const SkillRow& row : rows)
        if (row.quantity == quantity) return row.score;
    return kNoScore;
}

void add_winter(const WinterSet& set, const SkillOptions& options, Board& board)
{
    const weather::PhysicalParams meadow = params_of(options, "grass");
    const auto ours = winter_rows(set.winter, model_hours(set.winter, meadow));
    const auto plain = winter_rows(set.winter, degree_day_hours(set.winter));
    std::vector<std::vector<SkillRow>> rivals;
    for (const SkillRival& rival : options.rivals)
        rivals.push_back(winter_rows(set.winter, rival_hours(rival, set)));
    const auto put = [&](const SkillRow& row, double degree_day) {
        BoardRow line{row, degree_day, {}, stated_score(row.set, row.quantity)};
        for (const auto& rows : rivals) line.rivals.push_back(score_in(rows, row.quantity));
        board.rows.push_back(std::move(line));
    };
    for (const SkillRow& row : ours) put(row, score_in(plain, row.quantity));
    if (!set.raw.has(weather::Field::Longwave)) return;
    Winter dark = set.winter;
    dark.table = without_longwave(set.raw);
    for (SkillRow row : winter_rows(dark, model_hours(dark, meadow))) {
        if (row.quantity != "snow depth") continue;
        row.quantity = "snow depth without longwave";
        put(row, kNoScore);
    }
}

void add_rows(const std::vector<SkillRow>& rows, Board& board)
{
    for (const SkillRow& row : rows)
        board.rows.push_back({row, kNoScore, std::vector<double>(board.rivals.size(), kNoScore),
                              stated_score(row.set, row.quantity)});
}

// Means over all sets that have the quantity.
void add_means(Board& board)
{
    std::map<std::string, std::vector<BoardRow>> by_quantity;
    for (const BoardRow& row : board.rows) by_quantity[row.ours.quantity].push_back(row);
    for (const auto& named : by_quantity) {
        const std::vector<BoardRow>& rows = named.second;
        if (rows.size() < 2) continue;
        BoardRow mean = rows.front();
        const auto over = [&](auto&& value) {
            ErrorSum sum;
            for (const BoardRow& row : rows) sum.add(value(row));
            return sum.bias();  // the plain mean
        };
        mean.ours.set = "mean of " + std::to_string(rows.size());
        mean.ours.count = 0;
        for (const BoardRow& row : rows) mean.ours.count += row.ours.count;
        mean.ours.score = over([](const BoardRow& r) { return r.ours.score; });
        mean.ours.bias = over([](const BoardRow& r) { return r.ours.bias; });
        mean.degree_day = over([](const BoardRow& r) { return r.degree_day; });
        for (std::size_t i = 0; i < mean.rivals.size(); ++i)
            mean.rivals[i] = over([i](const BoardRow& r) { return r.rivals[i]; });
        StatedScore stated{"", "", 0.0, 0.0, 0.0};
        stated.previous =
            over([](const BoardRow& r) { return r.stated ? r.stated->previous : kNoScore; });
        mean.stated.reset();
        if (!std::isnan(stated.previous)) {
            stated.stated =
                over([](const BoardRow& r) { return r.stated ? r.stated->stated : kNoScore; });
            stated.margin =
                over([](const BoardRow& r) { return r.stated ? r.stated->margin : kNoScore; });
            mean.stated = stated;
        }
        board.rows.push_back(std::move(mean));
    }
}

std::string number(double value, const char* format = "%.3g")
{
    if (std::isnan(value)) return "";
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}
std::string stated_text(const BoardRow& row)
{
    return row.stated ? number(row.stated->stated) + " + " + number(row.stated->margin) : "";
}
double previous_of(const BoardRow& row)
{
    return row.stated ? row.stated->previous : kNoScore;
}

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

}  // namespace

Board skill_board(const SkillOptions& options)
{
    const SkillSets sets = find_skill_sets(options.data);
    Board board;
    board.notes = sets.notes;
    for (const SkillRival& rival : options.rivals) board.rivals.push_back(rival.name);
    for (const WinterSet& set : sets.winters) add_winter(set, options, board);
    std::vector<PlacedRows> skies;
    for (const WinterSet& set : sets.winters)
        skies.push_back({set.raw.site, longwave_rows(set.winter.name, set.raw)});
    for (const LongwaveStation& station : sets.stations)
        skies.push_back({station.raw.site, longwave_rows(station.name, station.raw)});
    for (const PlacedRows& sky : skies) add_rows(sky.rows, board);
    add_rows(longwave_of_places(skies), board);
    for (const LongwaveStation& station : sets.stations)
        add_rows(meadow_rows(station, params_of(options, "lawn")), board);
    for (const RoadCase& road : sets.roads) {
        try {
            const weather::PhysicalParams params =
                params_of(options, road.station.bridge ? "bridge" : "road");
            add_rows(road_rows(road, params), board);
            add_rows(road_hindcast_rows(road, params), board);
        } catch (const Error& e) {
            board.notes.push_back(road.name + ": " + e.what());
        }
    }
    for (const UrbanSite& town : sets.towns) add_rows(urban_rows(town), board);
    for (const SnowMapSet& landscape : sets.landscapes) {
        try {
            add_rows(snow_map_rows(landscape, options.settings), board);
        } catch (const Error& e) {
            board.notes.push_back(landscape.name + ": " + e.what());
        }
    }
    add_means(board);
    return board;
}

std::string board_text(const Board& board)
{
    std::string out;
    char line[400];
    const auto put = [&](const auto&... words) {
        std::snprintf(line, sizeof line, "  %-24.24s %-28.28s %7s %9s %10s %9s %9s %-14s",
                      words...);
        out += line;
    };
    put("data", "quantity", "values", "score", "bias", "deg-day", "previous", "stated + margin");
    for (const std::string& rival : board.rivals) out += " " + rival;
    out += "\n";
    for (const BoardRow& row : board.rows) {
        const SkillRow& r = row.ours;
        put(r.set.c_str(), r.quantity.c_str(), std::to_string(r.count).c_str(),
            number(r.score).c_str(), number(r.bias, "%+.3g").c_str(),
            number(row.degree_day).c_str(), number(previous_of(row)).c_str(),
            stated_text(row).c_str());
        for (const double rival : row.rivals) out += " " + number(rival);
        if (!r.unit.empty()) out += " " + r.unit;
        if (r.measure != "RMSE") out += " " + r.measure;
        if (row.worse()) out += "  WORSE THAN STATED";
        out += "\n";
    }
    for (const std::string& note : board.notes) out += "  not scored: " + note + "\n";
    return out;
}

std::string board_json(const Board& board)
{
    nlohmann::ordered_json json;
    json["rows"] = nlohmann::ordered_json::array();
    const auto maybe = [](nlohmann::ordered_json& to, const std::string& key, double value) {
        if (!std::isnan(value)) to[key] = value;
    };
    for (const BoardRow& row : board.rows) {
        nlohmann::ordered_json one{{"set", row.ours.set},
                                   {"quantity", row.ours.quantity},
                                   {"unit", row.ours.unit},
                                   {"measure", row.ours.measure},
                                   {"values", row.ours.count}};
        maybe(one, "score", row.ours.score);
        maybe(one, "bias", row.ours.bias);
        maybe(one, "degree_day", row.degree_day);
        maybe(one, "previous", previous_of(row));
        for (std::size_t i = 0; i < row.rivals.size(); ++i)
            maybe(one["rivals"], board.rivals[i], row.rivals[i]);
        if (row.stated) {
            one["stated"] = row.stated->stated;
            one["margin"] = row.stated->margin;
            one["worse"] = row.worse();
        }
        json["rows"].push_back(std::move(one));
    }
    json["notes"] = board.notes;
    return json.dump(2);
}

std::string board_html(const Board& board)
{
    std::string out =
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>petrichor: skill</title>"
        "<style>body{font:14px sans-serif;margin:2em}table{border-collapse:collapse}"
        "td,th{padding:2px 10px;border-bottom:1px solid #ddd;text-align:right}td{white-space:nowrap}"
        "td:first-child,td:nth-child(2),th:first-child,th:nth-child(2){text-align:left}.worse{"
        "background:#fbd5d5}"
        ".best{font-weight:bold}</style><h1>Skill of the weather models</h1>"
        "<p>Errors against what was measured, the smaller the better; the best of a line is bold. "
        "Degree days know snow depth at 300 kg/m&sup3; only.</p><table><tr><th>data<th>quantity"
        "<th>values<th>petrichor<th>bias<th>degree days<th>previous release<th>stated + margin";
    for (const std::string& rival : board.rivals) out += "<th>" + escaped(rival);
    out += "<th>unit</tr>\n";
    for (const BoardRow& row : board.rows) {
        // What tells of the data or of a rival alone has nothing beside it to be better than.
        std::vector<double> scores{row.ours.score, row.degree_day, previous_of(row)};
        scores.insert(scores.end(), row.rivals.begin(), row.rivals.end());
        double best = std::numeric_limits<double>::infinity();
        const auto known =
            std::count_if(scores.begin(), scores.end(), [](double s) { return !std::isnan(s); });
        for (const double s : scores)
            if (!std::isnan(s) && known > 1) best = std::min(best, s);
        const auto cell = [&](double score) {
            return std::string(known > 1 && score <= best ? "<td class=\"best\">" : "<td>") +
                   number(score);
        };
        out += row.worse() ? "<tr class=\"worse\">" : "<tr>";
        out += "<td>" + escaped(row.ours.set) + "<td>" + escaped(row.ours.quantity) + "<td>" +
               std::to_string(row.ours.count) + cell(scores[0]) + "<td>" +
               number(row.ours.bias, "%+.3g") + cell(scores[1]) + cell(scores[2]) + "<td>" +
               stated_text(row);
        for (const double rival : row.rivals) out += cell(rival);
        out += "<td>" + escaped(row.ours.unit + " " + row.ours.measure) + "</tr>\n";
    }
    out += "</table>";
    for (const std::string& note : board.notes) out += "<p>Not scored: " + escaped(note) + "</p>";
    return out + "</html>\n";
}

bool run_skill_bench(const SkillOptions& options)
{
    const Board board = skill_board(options);
    std::cout << (options.json ? board_json(board) + "\n" : board_text(board));
    if (!options.html.empty()) write_text_file(options.html, board_html(board));
    return std::none_of(board.rows.begin(), board.rows.end(),
                        [](const BoardRow& row) { return row.worse(); });
}

}  // namespace petrichor::cli
