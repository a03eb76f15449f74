#include "cli/simulate_plot.h"

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

std::string text_at(double x, double y, const std::string& anchor, const std::string& style,
                    const std::string& text)
{
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" " +
           style + ">" + escaped(text) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style)
{
    return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
           "\" y2=\"" + number(y1) + "\" " + style + "/>\n";
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

std::string panel_svg(const SimulationTable& table, const PlotPanel& panel, const TimeAxis& time,
                      const std::vector<double>& time_ticks, double top, double height)
{
    const auto [low, high] = axis_range(table, panel);
    const auto y = [&, low = low, high = high](double value) {
        return top + height * (1.0 - (std::clamp(value, low, high) - low) / (high - low));
    };
    std::string svg = text_at(kLeft, top - 10, "start", "class=\"title\"", panel.title);
    double legend_x = kWidth - kRight;
    for (auto series = panel.series.rbegin(); series != panel.series.rend(); ++series) {
        svg += text_at(legend_x, top - 10, "end", "class=\"label\"", series->label);
        legend_x -= 7.0 * static_cast<double>(series->label.size()) + 6.0;
        svg += line(legend_x - 16, top - 14, legend_x, top - 14,
                    "stroke=\"" + series->color + "\" stroke-width=\"3\"");
        legend_x -= 30.0;
    }
    for (double tick : axis_ticks(low, high, panel.forcing ? 4 : 5, false)) {
        svg += line(kLeft, y(tick), kWidth - kRight, y(tick), "class=\"grid\"");
        svg += text_at(kLeft - 8, y(tick) + 4, "end", "class=\"label\"", number(tick));
    }
    for (double tick : time_ticks) {
        svg += line(time.x(tick), top, time.x(tick), top + height, "class=\"grid\"");
    }
    if (low < 0.0 && high > 0.0) svg += line(kLeft, y(0), kWidth - kRight, y(0), "class=\"zero\"");
    for (const PlotSeries& series : panel.series) {
        const std::size_t column = column_index(table, series.column);
        if (column == table.columns.size() || table.rows.empty()) continue;
        std::string points;
        double first_x = 0.0;
        double last_x = 0.0;
        for (std::size_t r : rows_to_draw(table, kMostPoints)) {
            last_x = time.x(table.rows[r][0]);
            if (points.empty()) first_x = last_x;
            points += (points.empty() ? "" : " ") + number(last_x) + "," +
                      number(y(table.rows[r][column]));
        }
        if (series.filled) {
            svg += "<polygon points=\"" + number(first_x) + "," + number(y(low)) + " " + points +
                   " " + number(last_x) + "," + number(y(low)) + "\" fill=\"" + series.color +
                   "\" fill-opacity=\"0.22\"/>\n";
        }
        svg += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + series.color +
               "\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\n";
    }
    return svg;
}

}  // namespace

std::string escaped(const std::string& text)
{
    std::string result;
    for (char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

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

std::string svg_plot(const SimulationTable& table)
{
    double height = kTop + kBottom - kPanelGap + 22.0;
    for (const PlotPanel& panel : table.panels) {
        height += (panel.forcing ? kForcingHeight : kStateHeight) + kPanelGap;
    }
    const double list_top = height;
    if (!table.events.empty()) height += 14.0 + 18.0 * static_cast<double>((table.events.size() + 1) / 2);

    TimeAxis time;
    if (!table.rows.empty()) {
        time.first_s = table.rows.front()[0];
        time.last_s = table.rows.back()[0];
    }
    const auto ticks = axis_ticks(time.first_s, time.last_s, 12, true);
    const double spacing = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;

    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(kWidth) +
                      " " + number(height) + "\" width=\"" + number(kWidth) + "\" height=\"" +
                      number(height) +
                      "\" font-family=\"system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif\">\n"
                      "<style>.head{font-size:17px;font-weight:600;fill:#1b2430}"
                      ".title{font-size:13px;font-weight:600;fill:#1b2430}"
                      ".label{font-size:12px;fill:#51606f}"
                      ".grid{stroke:#e3e8ee;stroke-width:1}.zero{stroke:#8b98a7;stroke-width:1}"
                      ".event{stroke:#8b98a7;stroke-width:1;stroke-dasharray:3 4}</style>\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    svg += text_at(kLeft, 26, "start", "class=\"head\"",
                   table.title + "  (" + table.model + " model, " + table.mode + ")");
    double top = kTop + 18.0;
    const double first_top = top;
    for (const PlotPanel& panel : table.panels) {
        const double panel_height = panel.forcing ? kForcingHeight : kStateHeight;
        svg += panel_svg(table, panel, time, ticks, top, panel_height);
        top += panel_height + kPanelGap;
    }
    const double bottom = top - kPanelGap;
    double label_x = -1e9;
    for (std::size_t i = 0; i < table.events.size(); ++i) {
        const double x = time.x(table.events[i].time_s);
        svg += line(x, first_top, x, bottom, "class=\"event\"");
        if (x - label_x < 14.0) continue;  // the list below has them all
        label_x = x;
        svg += text_at(x, bottom + 14, "middle", "class=\"label\"", std::to_string(i + 1));
    }
    for (double tick : ticks) {
        svg += text_at(time.x(tick), bottom + 34, "middle", "class=\"label\"",
                       time_label(tick, spacing));
    }
    for (std::size_t i = 0; i < table.events.size(); ++i) {
        const bool second = i >= (table.events.size() + 1) / 2;
        const double row = static_cast<double>(second ? i - (table.events.size() + 1) / 2 : i);
        const double x = second ? kLeft + 440.0 : kLeft;
        const double y = list_top + 10.0 + 18.0 * row;
        svg += text_at(x + 14, y, "end", "class=\"label\"", std::to_string(i + 1));
        svg += text_at(x + 84, y, "end", "class=\"label\"",
                       number(table.events[i].time_s, 3) + " s");
        svg += text_at(x + 98, y, "start", "class=\"label\"", table.events[i].text);
    }
    return svg + "</svg>\n";
}

}  // namespace petrichor::cli
