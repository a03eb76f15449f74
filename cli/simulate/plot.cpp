#include "cli/simulate/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace petrichor::cli {
namespace {

constexpr double kWidth = 960.0;
constexpr double kLeft = 62.0;
constexpr double kRight = 22.0;
constexpr double kTop = 58.0;
constexpr double kPanelGap = 44.0;
constexpr double kForcingHeight = 110.0;
constexpr double kStateHeight = 180.0;
constexpr double kBottom = 46.0;
constexpr std::size_t kMostPoints = 3000;
constexpr std::size_t kMostEvents = 40;

std::string number(double value, int decimals = 2)
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

constexpr const char* kInk = "#1b2430";
constexpr const char* kSoft = "#51606f";
constexpr const char* kGrid = "#e3e8ee";
constexpr const char* kMark = "#8b98a7";

void add_line(Drawing& drawing, DrawnPoint a, DrawnPoint b, const char* color, bool dashed = false)
{
    drawing.shapes.push_back(DrawnLine{{a, b}, color, 1.0, dashed});
}

void add_label(Drawing& drawing, DrawnPoint at, Anchor anchor, const std::string& text)
{
    drawing.shapes.push_back(DrawnText{at, text, kSoft, 12.0, anchor, false});
}

struct TimeAxis {
    double first_s = 0.0;
    double last_s = 1.0;
    double x(double time_s) const
    {
        const double span = last_s > first_s ? last_s - first_s : 1.0;
        return kLeft + (kWidth - kLeft - kRight) * (time_s - first_s) / span;
    }
};

void add_panel(Drawing& drawing, const SimulationTable& table, const PlotPanel& panel,
               const TimeAxis& time, const std::vector<double>& time_ticks, double top, double height)
{
    const auto [low, high] = axis_range(table, panel);
    const auto y = [&, low = low, high = high](double value) {
        return top + height * (1.0 - (std::clamp(value, low, high) - low) / (high - low));
    };
    const double right = kWidth - kRight;
    drawing.shapes.push_back(
        DrawnText{{kLeft, top - 10}, panel.title, kInk, 13.0, Anchor::Start, true});
    double legend_x = right;
    for (auto series = panel.series.rbegin(); series != panel.series.rend(); ++series) {
        add_label(drawing, {legend_x, top - 10}, Anchor::End, series->label);
        legend_x -= 7.5 * static_cast<double>(series->label.size()) + 6.0;
        drawing.shapes.push_back(
            DrawnLine{{{legend_x - 16, top - 14}, {legend_x, top - 14}}, series->color, 3.0, false});
        legend_x -= 30.0;
    }
    for (double tick : axis_ticks(low, high, panel.forcing ? 4 : 5, false)) {
        add_line(drawing, {kLeft, y(tick)}, {right, y(tick)}, kGrid);
        add_label(drawing, {kLeft - 8, y(tick) + 4}, Anchor::End, number(tick));
    }
    for (double tick : time_ticks) {
        add_line(drawing, {time.x(tick), top}, {time.x(tick), top + height}, kGrid);
    }
    if (low < 0.0 && high > 0.0) add_line(drawing, {kLeft, y(0)}, {right, y(0)}, kMark);
    for (const PlotSeries& series : panel.series) {
        const std::size_t column = column_index(table, series.column);
        if (column == table.columns.size() || table.rows.empty()) continue;
        DrawnLine curve{{}, series.color, 2.0, false};
        for (std::size_t r : rows_to_draw(table, kMostPoints)) {
            curve.points.push_back({time.x(table.rows[r][0]), y(table.rows[r][column])});
        }
        if (series.filled) {
            DrawnArea area{curve.points, series.color, 0.22};
            area.points.insert(area.points.begin(), {curve.points.front().x, y(low)});
            area.points.push_back({curve.points.back().x, y(low)});
            drawing.shapes.push_back(std::move(area));
        }
        drawing.shapes.push_back(std::move(curve));
    }
}

}  // namespace

std::size_t column_index(const SimulationTable& table, const std::string& name)
{
    return static_cast<std::size_t>(
        std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin());
}

std::vector<std::size_t> rows_to_draw(const SimulationTable& table, std::size_t most)
{
    std::vector<std::size_t> rows;
    const std::size_t count = table.rows.size();
    const std::size_t stride = std::max<std::size_t>(1, (count + most - 1) / most);
    for (std::size_t r = 0; r < count; r += stride) rows.push_back(r);
    if (count > 0 && rows.back() != count - 1) rows.push_back(count - 1);
    return rows;
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
        for (double step : {60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0, 7200.0, 10800.0, 21600.0,
                            43200.0}) {
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
    if (spacing_s >= 86400.0) return number(time_s / 86400.0) + " d";
    if (spacing_s >= 3600.0) return number(time_s / 3600.0) + " h";
    if (spacing_s >= 60.0) return number(time_s / 60.0) + " min";
    return number(time_s, 6) + " s";
}

std::pair<double, double> axis_range(const SimulationTable& table, const PlotPanel& panel)
{
    if (panel.low != panel.high) return {panel.low, panel.high};
    double low = 0.0;
    double high = 0.0;
    for (const PlotSeries& series : panel.series) {
        const std::size_t column = column_index(table, series.column);
        if (column == table.columns.size()) continue;
        for (const auto& row : table.rows) {
            low = std::min(low, row[column]);
            high = std::max(high, row[column]);
        }
    }
    if (low == high) return {low - 1.0, high + 1.0};
    const auto ticks = axis_ticks(low, high, 4, false);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : high - low;
    return {step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9)};
}

Drawing plot_of(const SimulationTable& table)
{
    Drawing drawing;
    drawing.width = kWidth;
    drawing.height = kTop + kBottom - kPanelGap + 22.0;
    for (const PlotPanel& panel : table.panels) {
        drawing.height += (panel.forcing ? kForcingHeight : kStateHeight) + kPanelGap;
    }
    const double list_top = drawing.height;
    const std::size_t half = (std::min(table.events.size(), kMostEvents) + 1) / 2;
    if (half > 0) drawing.height += 14.0 + 18.0 * static_cast<double>(half);

    TimeAxis time;
    if (!table.rows.empty()) {
        time.first_s = table.rows.front()[0];
        time.last_s = table.rows.back()[0];
    }
    const auto ticks = axis_ticks(time.first_s, time.last_s, 12, true);
    const double spacing = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;

    drawing.shapes.push_back(
        DrawnText{{kLeft, 26}, table.title + " (" + table.model + " model, " + table.mode + ")",
                  kInk, 17.0, Anchor::Start, true});
    double top = kTop + 18.0;
    const double first_top = top;
    for (const PlotPanel& panel : table.panels) {
        const double height = panel.forcing ? kForcingHeight : kStateHeight;
        add_panel(drawing, table, panel, time, ticks, top, height);
        top += height + kPanelGap;
    }
    const double bottom = top - kPanelGap;
    double label_x = -1e9;
    for (std::size_t i = 0; i < 2 * half && i < table.events.size(); ++i) {
        const SimulationEvent& event = table.events[i];
        const double x = time.x(event.time_s);
        add_line(drawing, {x, first_top}, {x, bottom}, kMark, true);
        if (x - label_x >= 14.0) {  // the list below has them all
            label_x = x;
            add_label(drawing, {x, bottom + 14}, Anchor::Middle, std::to_string(i + 1));
        }
        const double list_x = i < half ? kLeft : kLeft + 440.0;
        const double list_y = list_top + 10.0 + 18.0 * static_cast<double>(i < half ? i : i - half);
        add_label(drawing, {list_x + 14, list_y}, Anchor::End, std::to_string(i + 1));
        add_label(drawing, {list_x + 96, list_y}, Anchor::End, number(event.time_s, 3) + " s");
        add_label(drawing, {list_x + 110, list_y}, Anchor::Start, event.text);
    }
    for (double tick : ticks) {
        add_label(drawing, {time.x(tick), bottom + 34}, Anchor::Middle, time_label(tick, spacing));
    }
    return drawing;
}

std::string svg_plot(const SimulationTable& table)
{
    return to_svg(plot_of(table));
}

}  // namespace petrichor::cli
