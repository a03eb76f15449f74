#include "weather/readers/collector.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/readers/number_text.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostProblems = 20;
constexpr std::size_t kMostTold = 5;  // rows of a file that is read all the same

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

std::string number_text(double value)
{
    char out[32];
    std::snprintf(out, sizeof out, "%.6g", value);
    return out;
}

std::int64_t usual_step_us(const std::vector<std::int64_t>& time_us)
{
    constexpr std::int64_t kHour_us = 3600000000LL;
    std::vector<std::int64_t> steps;
    for (std::size_t i = 1; i < time_us.size(); ++i) steps.push_back(time_us[i] - time_us[i - 1]);
    if (steps.empty()) return kHour_us;
    // Reports come when something changes, too: a gap is longer than nearly all steps.
    const std::size_t nearly_all = steps.size() * 19 / 20;
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(nearly_all),
                     steps.end());
    const std::int64_t long_step = steps[nearly_all];
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                     steps.end());
    const std::int64_t usual = steps[steps.size() / 2];
    return long_step <= 2 * kHour_us ? std::max(usual, long_step) : usual;
}

std::int64_t step_of_row_us(const std::vector<std::int64_t>& time_us, std::size_t row,
                            std::int64_t usual_us)
{
    if (row + 1 >= time_us.size()) return usual_us;
    const std::int64_t step = time_us[row + 1] - time_us[row];
    return step > usual_us + usual_us / 2 ? usual_us : step;
}

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
    last_bad_line_ = line;
    if (report_.bad_rows <= kMostTold) note(ReadNote::Kind::BadRow, line, field, why);
    if (problems_.size() < kMostProblems) {
        std::string text = "line ";
        text.append(std::to_string(line));
        if (!field.empty()) text.append(" ").append(field);
        problems_.push_back(text.append(": ").append(why));
    }
}

void RowCollector::wrong_columns(std::size_t line, std::size_t has, std::size_t wants)
{
    bad_row(line, "",
            "has " + std::to_string(has) + " columns, the header has " + std::to_string(wants));
}

void RowCollector::leap_day_left_out(std::size_t line)
{
    note(ReadNote::Kind::Time, line, "time", "29 February of a typical year left out");
}

bool RowCollector::begin_row(std::int64_t time_us, std::size_t line)
{
    line_ = line;
    joining_ = join_same_times_ && !times_.empty() && time_us == times_.back();
    if (joining_) {
        ++joined_;
        in_row_ = true;
        return true;
    }
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
    const auto i = static_cast<std::size_t>(field);
    if (value < info.low && value >= info.low - info.noise) {
        noise_[i].add(value, line_);
        value = info.low;
    }
    if (!(value >= info.low && value <= info.high)) {
        ++f.out_of_range;
        refused_[i].add(value, line_);
        return;
    }
    auto& column = values_[i];
    if (column.empty()) column.assign(times_.size(), kMissing);
    if (joining_ && !std::isnan(column.back())) return;
    column.back() = value;
    ++f.present;
}

void RowCollector::precipitation_seen(double kg_m2_s)
{
    if (!in_row_) return;
    seen_.resize(times_.size(), 0.0);
    seen_.back() = std::max(seen_.back(), kg_m2_s);
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
    const auto i = static_cast<std::size_t>(field);
    if (unreadable_[i].count == 0) unreadable_text_[i] = shown(text);
    unreadable_[i].add(0.0, line_);
}

void RowCollector::fell_before(Field field, double amount, double hours)
{
    if (!in_row_) return;
    FieldReport& f = report_.fields[report_index(field)];
    if (!(amount >= 0.0 && amount <= 500.0 * std::max(hours, 1.0) && hours > 0.0 &&
          hours <= 744.0)) {
        ++f.out_of_range;
        impossible_[static_cast<std::size_t>(field)].add(amount, line_);
        return;
    }
    fallen_.push_back({times_.size() - 1, field, amount, hours});
    ++f.present;
}

void RowCollector::Odd::add(double value, std::size_t line)
{
    if (count++ == 0) {
        first_line = line;
        low = high = value;
    }
    low = std::min(low, value);
    high = std::max(high, value);
}

// One note a field and kind of trouble: a sensor that is a little off says so in every row.
void RowCollector::note_odd()
{
    const auto range = [](const Odd& odd) {
        std::string text = number_text(odd.low);
        if (odd.high != odd.low) text.append(" to ").append(number_text(odd.high));
        return text;
    };
    const auto values = [](const Odd& odd, const char* what) {
        return odd.count == 1 ? std::string() : std::to_string(odd.count).append(what);
    };
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        const FieldInfo& info = field_info(static_cast<Field>(f));
        if (const Odd& odd = refused_[f]; odd.count) {
            note(ReadNote::Kind::OutOfRange, odd.first_line, info.name,
                 values(odd, " values, ")
                     .append(range(odd))
                     .append(" ")
                     .append(info.unit)
                     .append(odd.count == 1 ? " is outside " : ", are outside ")
                     .append(number_text(info.low))
                     .append("..")
                     .append(number_text(info.high))
                     .append(", taken as missing"));
        }
        if (const Odd& odd = noise_[f]; odd.count) {
            note(ReadNote::Kind::Info, odd.first_line, info.name,
                 values(odd, " values, ")
                     .append(range(odd))
                     .append(" ")
                     .append(info.unit)
                     .append(": noise of the sensor, taken as ")
                     .append(number_text(info.low)));
        }
        if (const Odd& odd = impossible_[f]; odd.count) {
            note(ReadNote::Kind::OutOfRange, odd.first_line, info.name,
                 values(odd, " amounts, ")
                     .append(range(odd))
                     .append(" kg/m2 in their hours ")
                     .append(odd.count == 1 ? "is" : "are")
                     .append(" not possible, taken as missing"));
        }
        if (const Odd& odd = unreadable_[f]; odd.count) {
            note(ReadNote::Kind::OutOfRange, odd.first_line, info.name,
                 std::string("'")
                     .append(unreadable_text_[f])
                     .append(odd.count == 1
                                 ? "'"
                                 : "' and " + std::to_string(odd.count - 1) + " more cells that")
                     .append(odd.count == 1 ? " is not a number" : " are not numbers")
                     .append(", taken as missing"));
        }
    }
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
        if (report_.bad_rows == 0)
            throw Error("weather: " + report_.format + ": no row follows what names the columns",
                        "Give a file that has rows of weather.");
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

    if (report_.bad_rows > kMostTold)
        note(ReadNote::Kind::BadRow, 0, "",
             std::to_string(report_.bad_rows - kMostTold) + " more, the last in line " +
                 std::to_string(last_bad_line_));
    if (joined_)
        note(ReadNote::Kind::Time, 0, "time",
             std::to_string(joined_) + " rows with the time of the row before, joined with it");
    auto& precip = values_[static_cast<std::size_t>(Field::Precip)];
    const bool any_seen =
        std::any_of(seen_.begin(), seen_.end(), [](double rate) { return rate > 0.0; });
    if (use_seen_ && precip.empty() && any_seen) {
        seen_.resize(good, 0.0);
        precip = seen_;
        report_.fields[report_index(Field::Precip)].present = good;
        note(ReadNote::Kind::Info, 0, "precip",
             "no amounts in the file: rates from present weather, drizzle 0.1/0.3/0.8, rain "
             "1/4.5/12, snow 0.5/1.5/3 mm/h for light/moderate/heavy");
    }
    refuse_misnamed();
    refuse_warm_dew();
    refuse_impossible_damp();
    drop_lone_zeros();
    note_odd();
    drop_empty_columns();

    const std::int64_t usual = usual_step_us(times_);

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
    std::size_t gaps = 0, longest = 0;
    for (std::size_t i = 0; i < good; ++i) {
        if (i > 0 && times_[i] - times_[i - 1] != step_of_row_us(times_, i - 1, usual)) {
            table.time_us.push_back(times_[i - 1] + usual);
            from.push_back(kNone);
            report_.gaps.push_back({times_[i - 1] + usual, times_[i]});
            if (++gaps == 1 || times_[i] - times_[i - 1] > times_[longest] - times_[longest - 1])
                longest = i;
        }
        moved[i] = table.time_us.size();
        table.time_us.push_back(times_[i]);
        from.push_back(i);
    }
    if (gaps) {
        note(
            ReadNote::Kind::Time, 0, "time",
            std::string(gaps == 1 ? "gap from " : std::to_string(gaps) + " gaps, the longest from ")
                .append(iso_from_us(times_[longest - 1]))
                .append(" to ")
                .append(iso_from_us(times_[longest])));
    }
    for (Fallen& f : fallen_) f.row = moved[f.row];

    const bool past_amounts = std::any_of(fallen_.begin(), fallen_.end(),
                                          [](const Fallen& f) { return f.field == Field::Precip; });
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
        // What fell in the time before a row was of the kind that the row names.
        if (f == static_cast<std::size_t>(Field::SnowShare) && past_amounts) {
            column.erase(column.begin());
            column.push_back(kMissing);
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
