#include "weather/readers/collector.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostProblems = 20;

std::string number_text(double value)
{
    char out[32];
    std::snprintf(out, sizeof out, "%.6g", value);
    return out;
}

// Values known `after_s` after each time become values at the times, along lines between them.
void move_in_time(const std::vector<std::int64_t>& time_us, std::vector<double>& column,
                  double after_s)
{
    const std::vector<double> was = column;
    const double after_us = after_s * 1e6;
    for (std::size_t i = 0; i < column.size(); ++i) {
        const std::size_t other = after_s > 0.0 ? i - 1 : i + 1;
        if (other >= column.size()) continue;  // the first or last row keeps its value
        const double apart = static_cast<double>(time_us[i] - time_us[other]);
        const double share = after_us / apart;
        if (std::isnan(was[i]) || std::isnan(was[other]) || !(share > 0.0 && share <= 1.0))
            continue;
        column[i] = was[i] + (was[other] - was[i]) * share;
    }
}

}  // namespace

RowCollector::RowCollector(std::string format)
{
    report_.format = std::move(format);
}

void RowCollector::note(ReadNote::Kind kind, std::size_t line, std::string field, std::string text)
{
    report_.add({kind, line, std::move(field), std::move(text)});
}

void RowCollector::bad_row(std::size_t line, const std::string& field, const std::string& why)
{
    ++report_.bad_rows;
    in_row_ = false;
    note(ReadNote::Kind::BadRow, line, field, why);
    if (problems_.size() < kMostProblems) {
        std::string text = "line ";
        text.append(std::to_string(line));
        if (!field.empty()) text.append(" ").append(field);
        problems_.push_back(text.append(": ").append(why));
    }
}

bool RowCollector::begin_row(std::int64_t time_us, std::size_t line)
{
    line_ = line;
    if (!times_.empty() && time_us <= times_.back()) {
        bad_row(line, "time",
                std::string(time_us == times_.back() ? "duplicate of "
                                                     : "earlier than the row before, ")
                    .append(iso_from_us(time_us)));
        return false;
    }
    times_.push_back(time_us);
    for (auto& column : values_) {
        if (!column.empty()) column.push_back(kMissing);
    }
    in_row_ = true;
    return true;
}

std::size_t RowCollector::report_index(Field field)
{
    const auto i = static_cast<std::size_t>(field);
    if (report_of_[i] == 0) {
        report_.fields.push_back({});
        report_.fields.back().name = field_info(field).name;
        report_of_[i] = report_.fields.size();
    }
    return report_of_[i] - 1;
}

void RowCollector::set(Field field, double value)
{
    if (!in_row_) return;
    FieldReport& f = report_.fields[report_index(field)];
    const FieldInfo& info = field_info(field);
    if (!(value >= info.low && value <= info.high)) {
        ++f.out_of_range;
        note(ReadNote::Kind::OutOfRange, line_, info.name,
             number_text(value)
                 .append(" ")
                 .append(info.unit)
                 .append(" is outside ")
                 .append(number_text(info.low))
                 .append("..")
                 .append(number_text(info.high))
                 .append(", taken as missing"));
        return;
    }
    auto& column = values_[static_cast<std::size_t>(field)];
    if (column.empty()) column.assign(times_.size(), kMissing);
    column.back() = value;
    ++f.present;
}

void RowCollector::missing(Field field)
{
    if (!in_row_) return;
    FieldReport& f = report_.fields[report_index(field)];
    if (f.first_missing_line == 0) f.first_missing_line = line_;
}

void RowCollector::unreadable(Field field, std::string_view text)
{
    if (!in_row_) return;
    FieldReport& f = report_.fields[report_index(field)];
    ++f.out_of_range;
    note(ReadNote::Kind::OutOfRange, line_, field_info(field).name,
         std::string("'").append(shown(text)).append("' is not a number, taken as missing"));
}

void RowCollector::fell_before(Field field, double amount, double hours)
{
    if (!in_row_) return;
    FieldReport& f = report_.fields[report_index(field)];
    if (!(amount >= 0.0 && amount <= 500.0 * std::max(hours, 1.0) && hours > 0.0 &&
          hours <= 744.0)) {
        ++f.out_of_range;
        note(ReadNote::Kind::OutOfRange, line_, field_info(field).name,
             number_text(amount)
                 .append(" kg/m2 in ")
                 .append(number_text(hours))
                 .append(" h is not possible, taken as missing"));
        return;
    }
    fallen_.push_back({times_.size() - 1, field, amount, hours});
    ++f.present;
}

// Each amount goes to the rows whose interval lies in its hours; shorter accumulations first,
// longer ones then fill what the shorter left open.
void RowCollector::spread_amounts(ForcingTable& table)
{
    std::stable_sort(fallen_.begin(), fallen_.end(),
                     [](const Fallen& a, const Fallen& b) { return a.hours < b.hours; });
    std::size_t dropped = 0;
    for (const Fallen& f : fallen_) {
        auto& column = table[f.field];
        if (column.empty()) column.assign(table.rows(), kMissing);
        const std::int64_t end = table.time_us[f.row];
        const std::int64_t begin = end - static_cast<std::int64_t>(std::llround(f.hours * 3600e6));
        std::size_t first = f.row;
        while (first > 0 && table.time_us[first - 1] >= begin) --first;
        // An interval longer than the time since the row before: that row takes it.
        if (first == f.row && f.row > 0) first = f.row - 1;
        double known = 0.0;
        std::int64_t open = 0;
        for (std::size_t i = first; i < f.row; ++i) {
            const std::int64_t width = table.time_us[i + 1] - table.time_us[i];
            if (std::isnan(column[i]))
                open += width;
            else
                known += column[i] * static_cast<double>(width) * 1e-6;
        }
        if (open == 0) {
            if (f.amount > known + 1e-9) ++dropped;
            continue;
        }
        const double rate = std::max(f.amount - known, 0.0) / (static_cast<double>(open) * 1e-6);
        for (std::size_t i = first; i < f.row; ++i) {
            if (std::isnan(column[i])) column[i] = rate;
        }
    }
    if (dropped) {
        note(ReadNote::Kind::Info, 0, "precip",
             std::to_string(dropped).append(
                 " longer totals exceed the shorter ones inside them; the shorter are kept"));
    }
}

ForcingTable RowCollector::finish()
{
    const std::size_t good = times_.size();
    report_.rows = good;
    if (good == 0 || (report_.bad_rows > 2 && report_.bad_rows * 10 > good + report_.bad_rows)) {
        std::string list;
        for (const std::string& p : problems_) list.append("\n  ").append(p);
        if (report_.bad_rows > problems_.size()) {
            list.append("\n  and ")
                .append(std::to_string(report_.bad_rows - problems_.size()))
                .append(" more");
        }
        throw Error("weather: " + report_.format + ": " + std::to_string(good) + " good rows, " +
                        std::to_string(report_.bad_rows) + " bad" + list,
                    "Repair the lines listed, or give another file.");
    }

    // The usual step, for what has to be put before the first row and after a gap.
    std::vector<std::int64_t> steps;
    for (std::size_t i = 1; i < good; ++i) steps.push_back(times_[i] - times_[i - 1]);
    std::int64_t usual = 3600000000LL;
    if (!steps.empty()) {
        std::nth_element(steps.begin(),
                         steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                         steps.end());
        usual = steps[steps.size() / 2];
    }

    // A row before the first one holds what fell before it; a row after the last one before a gap
    // ends its rates.
    ForcingTable table;
    table.site = site_;
    std::vector<std::size_t> from;  // row of the file, or npos for an inserted one
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> moved(good);
    double before_h = 0.0;
    for (const Fallen& f : fallen_) {
        if (f.row == 0) before_h = std::max(before_h, f.hours);
    }
    if (before_h > 0.0) {
        table.time_us.push_back(times_[0] -
                                static_cast<std::int64_t>(std::llround(before_h * 3600e6)));
        from.push_back(kNone);
    }
    std::size_t gaps = 0;
    for (std::size_t i = 0; i < good; ++i) {
        if (i > 0 && times_[i] - times_[i - 1] > usual + usual / 2) {
            table.time_us.push_back(times_[i - 1] + usual);
            from.push_back(kNone);
            if (++gaps <= 20) {
                note(ReadNote::Kind::Time, 0, "time",
                     std::string("gap from ")
                         .append(iso_from_us(times_[i - 1]))
                         .append(" to ")
                         .append(iso_from_us(times_[i])));
            }
        }
        moved[i] = table.time_us.size();
        table.time_us.push_back(times_[i]);
        from.push_back(i);
    }
    if (gaps > 20)
        note(ReadNote::Kind::Time, 0, "time", std::to_string(gaps - 20).append(" more gaps"));
    for (Fallen& f : fallen_) f.row = moved[f.row];

    for (std::size_t f = 0; f < kFieldCount; ++f) {
        if (values_[f].empty()) continue;
        auto& column = table.columns[f];
        column.assign(table.rows(), kMissing);
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (from[i] != kNone) column[i] = values_[f][from[i]];
        }
        if (past_mean_[f]) {
            // Mean of the past interval -> value at the row: half of this mean, half of the next.
            for (std::size_t i = 0; i + 1 < column.size(); ++i) {
                if (!std::isnan(column[i]) && !std::isnan(column[i + 1]))
                    column[i] = 0.5 * (column[i] + column[i + 1]);
            }
        }
        if (held_after_s_[f] != 0.0) move_in_time(table.time_us, column, held_after_s_[f]);
    }
    spread_amounts(table);
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        if (report_of_[f] == 0) continue;
        FieldReport& r = report_.fields[report_of_[f] - 1];
        const std::size_t seen = r.present + r.out_of_range;
        r.missing = good > seen ? good - seen : 0;
    }
    values_ = {};
    fallen_.clear();
    return table;
}

}  // namespace petrichor::weather
