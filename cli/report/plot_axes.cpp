#include "cli/report/plot_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace petrichor::cli {

std::size_t column_index(const SimulationTable& table, const std::string& name)
{
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
}

std::vector<double> series_values(const SimulationTable& table, const PlotSeries& series,
                                  const std::string& name)
{
    std::vector<double> values;
    const std::size_t column = column_index(table, name);
    if (column == table.columns.size()) return values;
    const std::size_t where = column_index(table, series.only_where);
    values.reserve(table.rows.size());
    for (const auto& row : table.rows) {
        const bool shown = where == table.columns.size() || row[where] > series.only_above;
        values.push_back(shown ? series.scale * row[column]
                               : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
}

std::vector<std::size_t> rows_to_draw(const SimulationTable& table, std::size_t most)
{
    const std::size_t count = table.rows.size();
    std::vector<std::size_t> rows(count);
    for (std::size_t r = 0; r < count; ++r) rows[r] = r;
    if (count <= most) return rows;
    // Every curve keeps its lowest and highest row of each bucket.
    std::vector<std::size_t> columns;
    for (const PlotPanel& panel : table.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const std::string& name : {series.column, series.band_low, series.band_high}) {
                const std::size_t c = column_index(table, name);
                if (c < table.columns.size()) columns.push_back(c);
            }
        }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const std::size_t buckets =
        std::max<std::size_t>(1, most / (2 * std::max<std::size_t>(1, columns.size()) + 1));
    const std::size_t width = (count + buckets - 1) / buckets;
    std::vector<bool> kept(count, false);
    for (std::size_t begin = 0; begin < count; begin += width) {
        const std::size_t end = std::min(begin + width, count);
        kept[begin] = true;
        for (const std::size_t c : columns) {
            std::size_t low = begin, high = begin;
            for (std::size_t r = begin; r < end; ++r) {
                if (table.rows[r][c] < table.rows[low][c]) low = r;
                if (table.rows[r][c] > table.rows[high][c]) high = r;
            }
            kept[low] = kept[high] = true;
        }
    }
    kept[count - 1] = true;
    std::erase_if(rows, [&](std::size_t r) { return !kept[r]; });
    return rows;
}

std::string number_text(double value, int decimals)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string trimmed = text;
    if (trimmed.find('.') != trimmed.npos) {
        while (trimmed.back() == '0') trimmed.pop_back();
        if (trimmed.back() == '.') trimmed.pop_back();
    }
    return trimmed == "-0" ? "0" : trimmed;
}

std::vector<double> axis_ticks(double low, double high, int most, bool time)
{
    const double span = high - low;
    if (!(span > 0.0) || most < 1) return {low};
    std::vector<double> steps;
    for (int power = -6; power <= 12; ++power) {
        for (double digit : {1.0, 2.0, 5.0}) steps.push_back(digit * std::pow(10.0, power));
    }
    if (time) {
        std::erase_if(steps, [](double step) { return step >= 50.0; });
        for (double step :
             {60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0, 7200.0, 10800.0, 21600.0, 43200.0}) {
            steps.push_back(step);
        }
        for (double days : {1., 2., 5., 10., 20., 50., 100., 200., 500., 1000., 5000., 20000.}) {
            steps.push_back(86400.0 * days);
        }
    }
    double step = steps.back();
    for (double candidate : steps) {
        if (span / candidate <= most) {
            step = candidate;
            break;
        }
    }
    std::vector<double> ticks;
    const double slack = 1e-9 * span;
    for (double k = std::ceil((low - slack) / step); k * step <= high + slack; k += 1.0) {
        ticks.push_back(k * step);
    }
    return ticks;
}

std::string time_label(double time_s, double spacing_s)
{
    if (time_s == 0.0) return "0";
    if (spacing_s >= 86400.0) return number_text(time_s / 86400.0, 2) + " d";
    if (spacing_s >= 3600.0) return number_text(time_s / 3600.0, 2) + " h";
    if (spacing_s >= 60.0) return number_text(time_s / 60.0, 2) + " min";
    return number_text(time_s, 6) + " s";
}

std::pair<double, double> axis_range(const SimulationTable& table, const PlotPanel& panel)
{
    if (panel.low != panel.high) return {panel.low, panel.high};
    double low = 0.0;
    double high = 0.0;
    const auto widen = [&](double value) {
        low = std::fmin(low, value);  // a gap widens nothing
        high = std::fmax(high, value);
    };
    for (const PlotSeries& series : panel.series) {
        for (const std::string& name : {series.column, series.band_low, series.band_high}) {
            for (const double value : series_values(table, series, name)) widen(value);
        }
    }
    for (const PlotDots& dots : panel.dots) {
        for (double value : dots.values) widen(value);
    }
    if (low == high) return {0.0, 1.0};
    const auto ticks = axis_ticks(low, high, panel.forcing ? 4 : 5, false);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : high - low;
    return {step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9)};
}

int decimals_of(const std::vector<double>& ticks)
{
    if (ticks.size() < 2) return 2;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(ticks[1] - ticks[0]) - 1e-9)), 0, 9);
}

std::string unit_text(const Score& score)
{
    if (score.unit.empty()) return "";
    std::string unit = " " + score.unit;
    if (unit.ends_with("m2")) unit.replace(unit.size() - 1, 1, "\u00b2");
    return unit;
}

}  // namespace petrichor::cli
