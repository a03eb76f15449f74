#include "weather/text/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace petrichor::weather {
namespace {

std::string_view trimmed(std::string_view text)
{
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

// Splits at commas outside quotes; "" inside quotes is one quote.
std::vector<std::string> cells_of(std::string_view line)
{
    std::vector<std::string> cells;
    std::string cell;
    bool quoted = false;
    bool was_quoted = false;
    const auto finish = [&] {
        cells.push_back(was_quoted ? cell : std::string(trimmed(cell)));
        cell.clear();
        was_quoted = false;
    };
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted) {
            if (c != '"') {
                cell += c;
            } else if (i + 1 < line.size() && line[i + 1] == '"') {
                cell += line[++i];
            } else {
                quoted = false;
            }
        } else if (c == '"' && trimmed(cell).empty()) {
            cell.clear();
            quoted = was_quoted = true;
        } else if (c == ',') {
            finish();
        } else if (!was_quoted) {
            cell += c;
        }
    }
    finish();
    return cells;
}

bool looks_binary(std::string_view text)
{
    const std::string_view head = text.substr(0, 4096);
    return std::any_of(head.begin(), head.end(), [](char c) {
        return static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\r' && c != '\t';
    });
}

}  // namespace

std::string list_problems(const std::vector<Problem>& problems, std::size_t most)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(most, problems.size()); ++i) {
        const Problem& p = problems[i];
        if (i > 0) text += '\n';
        if (p.line > 0) text += "line " + std::to_string(p.line);
        if (!p.field.empty()) text += (p.line > 0 ? ", " : "") + p.field;
        if (p.line > 0 || !p.field.empty()) text += ": ";
        text += p.message;
    }
    if (problems.size() > most) {
        text += "\n... and " + std::to_string(problems.size() - most) + " more";
    }
    return text;
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const
{
    const std::string wanted = lower_case(name);
    for (std::size_t i = 0; i < header.size(); ++i) {
        if (lower_case(header[i]) == wanted) return i;
    }
    return std::nullopt;
}

CsvTable parse_csv(std::string_view text)
{
    CsvTable table;
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    if (looks_binary(text)) {
        table.problems.push_back({0, "", "not a text file: it holds control characters"});
        return table;
    }
    std::size_t line_number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\n\r"), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        const bool crlf = text.substr(end, 2) == "\r\n";
        text.remove_prefix(std::min(text.size(), end + (crlf ? 2u : 1u)));
        ++line_number;
        if (line.empty() || line.front() == '#') continue;
        if (table.header.empty()) {
            table.header = cells_of(line);
            const std::size_t other = line.find_first_of(";\t|");
            if (table.header.size() == 1 && other != line.npos) {
                const std::string shown =
                    line[other] == '\t' ? "a tab" : std::string(1, line[other]);
                table.problems.push_back(
                    {line_number, "", "columns are separated by " + shown + ", expected a comma"});
                return table;
            }
            for (std::size_t i = 0; i < table.header.size(); ++i) {
                if (table.column(table.header[i]) != i) {
                    table.problems.push_back(
                        {line_number, table.header[i], "this column appears twice"});
                    return table;
                }
            }
            continue;
        }
        auto cells = cells_of(line);
        if (cells.size() != table.header.size()) {
            table.problems.push_back(
                {line_number, "",
                 std::to_string(cells.size()) + " cells, expected " +
                     std::to_string(table.header.size()) +
                     (cells.size() > table.header.size() ? " (decimal commas must be points)"
                                                         : "")});
            continue;
        }
        table.rows.push_back(std::move(cells));
        table.lines.push_back(line_number);
    }
    if (table.header.empty()) table.problems.push_back({0, "", "the file is empty"});
    table.usable = !table.header.empty();
    return table;
}

std::optional<double> parse_number(std::string_view text)
{
    text = trimmed(text);
    if (!text.empty() && text.front() == '+' && text.substr(0, 2) != "+-") text.remove_prefix(1);
    double value = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

std::string number_17(double value)
{
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                      std::chars_format::general, 17);
    return {buffer.data(), result.ptr};
}

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

}  // namespace petrichor::weather
