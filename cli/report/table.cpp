#include "cli/report/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/report/plot_axes.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

using nlohmann::ordered_json;

void append_shortest(std::string& text, double value)
{
    char digits[40];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// Computed states are not known to more than six digits, and shown with no more. The artist model
// is exact, and so are times.
double shown_value(const SimulationTable& table, std::size_t column, double value)
{
    if (column == 0 || table.model != "physical" || !std::isfinite(value)) return value;
    char digits[40];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6);
    double rounded = value;
    std::from_chars(digits, end.ptr, rounded);
    return rounded;
}

// "2005-12-01T06:00:00Z", by another clock "2005-12-01T06:00:00-07:00".
std::string stamp(const SimulationTable& table, double time_s)
{
    return weather::iso_from_us(table.utc_start_us + static_cast<std::int64_t>(std::llround(time_s * 1e6)),
                                table.utc_offset_s);
}

ordered_json head_of(const SimulationTable& table)
{
    ordered_json events = ordered_json::array();
    for (const SimulationEvent& event : table.events) {
        events.push_back({{"time_s", event.time_s}, {"event", event.text}});
    }
    ordered_json json{{"title", table.title},
                      {"model", table.model},
                      {"mode", table.mode},
                      {"rows_written", table.rows.size()},
                      {"state_hash", hash_text(table.state_hash)},
                      {"table_hash", hash_text(table.table_hash)},
                      {"warnings", table.warnings},
                      {"notes", table.notes}};
    if (table.dated) json["clock"] = clock_name(table);
    if (table.typical_year) json["typical_year"] = true;
    if (table.dated) json["utc_start"] = weather::iso_from_us(table.utc_start_us);
    for (const auto& [key, text] : table.json_parts) json[key] = ordered_json::parse(text);
    if (!table.scores.empty()) {
        ordered_json scores = ordered_json::object();
        for (const Score& s : table.scores) {
            ordered_json one = s.agreement ? ordered_json{{"agreement", *s.agreement}}
                                           : ordered_json{{"rmse", s.rmse},
                                                          {"bias", s.bias},
                                                          {"unit", s.unit}};
            one["count"] = s.count;
            one["how"] = s.how;
            scores[s.column] = one;
        }
        json["scores"] = scores;
    }
    json["events"] = events;
    return json;
}

}  // namespace

std::string hash_text(std::uint64_t hash)
{
    std::string digits(16, '0');
    for (int i = 15; i >= 0; --i, hash >>= 4) {
        digits[static_cast<std::size_t>(i)] = "0123456789abcdef"[hash & 15u];
    }
    return digits;
}

std::string clock_name(const SimulationTable& table)
{
    const int minutes = static_cast<int>(std::lround(table.utc_offset_s / 60.0));
    if (minutes == 0) return "UTC";
    std::string text = minutes < 0 ? "UTC-" : "UTC+";
    text += std::to_string(std::abs(minutes) / 60);
    if (minutes % 60) text += ":" + std::to_string(std::abs(minutes) % 60);
    return text;
}

std::string time_text(const SimulationTable& table, double time_s)
{
    if (!table.dated) return number_text(time_s, 3) + " s";
    const auto us = table.utc_start_us +
                    static_cast<std::int64_t>(std::llround((time_s + table.utc_offset_s) * 1e6));
    std::string text = weather::iso_from_us(us).substr(0, 16);
    text[10] = ' ';
    return text;
}

std::string gaps_text(const SimulationTable& table)
{
    if (table.gaps_s.empty()) return "";
    double sum_s = 0.0;
    for (const auto& [from_s, to_s] : table.gaps_s) sum_s += to_s - from_s;
    char text[160];
    std::snprintf(text, sizeof text,
                  "grey: %.1f days in %zu gap%s of which the file has no rows; what is drawn there was made up",
                  sum_s / 86400.0, table.gaps_s.size(), table.gaps_s.size() == 1 ? "" : "s");
    return text;
}

std::string csv_text(const SimulationTable& table, bool with_hash)
{
    std::string text;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        if (c > 0) text += ',';
        text += table.columns[c];
        if (c == 0 && table.utc) text += table.utc_offset_s == 0.0 ? ",time_utc" : ",time_local";
    }
    text += '\n';
    for (const auto& row : table.rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (c > 0) text += ',';
            append_shortest(text, shown_value(table, c, row[c]));
            if (c == 0 && table.utc) {
                text += ',';
                text += stamp(table, row[0]);
            }
        }
        text += '\n';
    }
    if (with_hash) {
        text += "# hash state=" + hash_text(table.state_hash) +
                " table=" + hash_text(table.table_hash) + '\n';
    }
    return text;
}

namespace {

// The library's numbers may have digits too many.
void append_json_number(std::string& text, double value)
{
    if (std::isfinite(value))
        append_shortest(text, value);
    else
        text += "null";
}

// A JSON object with one more member at its end.
std::string with_member(const std::string& object, const std::string& indent,
                        const std::string& name, const std::string& value)
{
    std::string text = object.substr(0, object.rfind('}'));
    while (text.back() == '\n') text.pop_back();
    return text + "," + indent + "\"" + name + "\":" + (indent.empty() ? "" : " ") + value +
           (indent.empty() ? "}" : "\n}") + "\n";
}

}  // namespace

std::string json_text(const SimulationTable& table)
{
    ordered_json json = head_of(table);
    json["columns"] = table.columns;
    std::string rows = "[";
    for (const auto& row : table.rows) {
        rows += rows.size() > 1 ? ",[" : "[";
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (c > 0) rows += ',';
            append_json_number(rows, shown_value(table, c, row[c]));
        }
        rows += ']';
    }
    rows += ']';
    return with_member(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "",
                       "rows", rows);
}

std::string json_summary(const SimulationTable& table)
{
    std::string columns = "{";
    for (std::size_t c = 0; c < table.columns.size() && !table.rows.empty(); ++c) {
        double low = table.rows[0][c];
        double high = low;
        for (const auto& row : table.rows) {
            low = std::min(low, row[c]);
            high = std::max(high, row[c]);
        }
        columns += (c > 0 ? ",\n    " : "\n    ") + ordered_json(table.columns[c]).dump() + ": {";
        const std::pair<const char*, double> numbers[] = {
            {"min", low}, {"max", high}, {"last", table.rows.back()[c]}};
        for (const auto& [name, value] : numbers) {
            columns +=
                std::string(name == numbers[0].first ? "" : ",") + "\n      \"" + name + "\": ";
            append_json_number(columns, shown_value(table, c, value));
        }
        columns += "\n    }";
    }
    columns += columns.size() > 1 ? "\n  }" : "}";
    return with_member(head_of(table).dump(2, ' ', false, nlohmann::json::error_handler_t::replace),
                       "\n  ", "columns", columns);
}

}  // namespace petrichor::cli
