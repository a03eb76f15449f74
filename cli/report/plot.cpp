#include "cli/report/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "cli/report/plot_axes.h"
#include "cli/report/time_axis.h"

namespace petrichor::cli {
namespace {

constexpr double kWidth = 960.0;
constexpr double kLeft = 62.0;
constexpr double kRight = 22.0;
constexpr double kTop = 58.0;
constexpr double kPanelGap = 58.0;
constexpr double kForcingHeight = 110.0;
constexpr double kStateHeight = 180.0;
constexpr double kBottom = 46.0;
constexpr double kMostHeight = 1600.0;
constexpr std::size_t kMostPoints = 3000;  // more rows than this are thinned
constexpr std::size_t kMostEvents = 40;

constexpr const char* kInk = "#1b2430";
constexpr const char* kSoft = "#51606f";
constexpr const char* kGrid = "#e3e8ee";
constexpr const char* kMark = "#8b98a7";
constexpr const char* kWarning = "#a8480a";

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

// A piece of a curve as pixels can show it: of many rows in one place only the lowest and the
// highest.
std::vector<DrawnPoint> thinned(const std::vector<DrawnPoint>& piece, std::size_t bucket)
{
    std::vector<DrawnPoint> points;
    for (std::size_t begin = 0; begin < piece.size(); begin += bucket) {
        const auto at = piece.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto end =
            piece.begin() + static_cast<std::ptrdiff_t>(std::min(begin + bucket, piece.size()));
        auto [first, second] = std::minmax_element(
            at, end, [](const DrawnPoint& a, const DrawnPoint& b) { return a.y < b.y; });
        if (first > second) std::swap(first, second);
        points.push_back(*first);
        if (second != first) points.push_back(*second);
    }
    if (!piece.empty() && points.back().x < piece.back().x) points.push_back(piece.back());
    return points;
}

// The pieces of a curve: between them there is nothing to show.
std::vector<std::vector<DrawnPoint>> curve_pieces(const SimulationTable& table,
                                                  const TimeAxis& time,
                                                  const std::vector<double>& y, bool steps)
{
    std::vector<std::vector<DrawnPoint>> pieces;
    const std::size_t bucket =
        y.size() <= kMostPoints ? 1 : (2 * y.size() + kMostPoints - 1) / kMostPoints;  // two points
    std::vector<DrawnPoint> piece;
    const auto close = [&] {
        if (!piece.empty()) pieces.push_back(thinned(piece, bucket));
        piece.clear();
    };
    for (std::size_t r = 0; r < y.size(); ++r) {
        if (std::isnan(y[r])) {
            close();
            continue;
        }
        if (steps && bucket == 1 && !piece.empty()) piece.push_back({piece.back().x, y[r]});
        piece.push_back({time.x(table.rows[r][0]), y[r]});
    }
    close();
    return pieces;
}

// Title at the left with its score, legend at the right.
void add_heading(Drawing& drawing, const SimulationTable& table, const PlotPanel& panel, double top)
{
    drawing.shapes.push_back(
        DrawnText{{kLeft, top - 10}, panel.title, kInk, 13.0, Anchor::Start, true});
    double title_end = kLeft + 1.08 * text_width(panel.title, 13.0) + 18.0;
    for (const Score& score : table.scores) {
        const bool here =
            !panel.dots.empty() &&
            std::any_of(panel.series.begin(), panel.series.end(),
                        [&](const PlotSeries& s) { return s.column == score.column; });
        if (!here || score.agreement) continue;
        char text[120];
        std::snprintf(text, sizeof text, "RMSE %.3g%s, bias %+.2g%s", score.rmse,
                      unit_text(score).c_str(), score.bias, unit_text(score).c_str());
        add_label(drawing, {title_end, top - 10}, Anchor::Start, text);
    }
    double legend_x = kWidth - kRight;
    for (auto dots = panel.dots.rbegin(); dots != panel.dots.rend(); ++dots) {
        add_label(drawing, {legend_x, top - 10}, Anchor::End, dots->label);
        legend_x -= text_width(dots->label, 12.0) + 10.0;
        drawing.shapes.push_back(DrawnDots{{{legend_x, top - 14}}, dots->color, 3.0});
        legend_x -= 22.0;
    }
    for (auto series = panel.series.rbegin(); series != panel.series.rend(); ++series) {
        if (series->label.empty()) continue;
        add_label(drawing, {legend_x, top - 10}, Anchor::End, series->label);
        legend_x -= text_width(series->label, 12.0) + 8.0;
        drawing.shapes.push_back(DrawnLine{
            {{legend_x - 16, top - 14}, {legend_x, top - 14}}, series->color, 3.0, false});
        legend_x -= 34.0;
    }
}

// A long series of many rows a day: what a line would smear becomes the mean of each day between
// its lowest and highest hour. A day is that of the table's clock.
struct DailyBand {
    std::vector<DrawnPoint> mean, low, high;
};
bool wants_days(const SimulationTable& table)
{
    if (!table.dated || table.rows.size() < 1000) return false;
    const double span = table.rows.back()[0] - table.rows.front()[0];
    return span > 120.0 * 86400.0 && span / static_cast<double>(table.rows.size()) < 4.0 * 3600.0;
}
std::vector<DailyBand> daily_bands(const SimulationTable& table, const TimeAxis& time,
                                   const std::vector<double>& values,
                                   const std::function<double(double)>& y)
{
    std::vector<DailyBand> bands(1);
    double sum = 0.0, low = 0.0, high = 0.0;
    std::size_t count = 0;
    const double origin_s = static_cast<double>(table.utc_start_us) * 1e-6 + table.utc_offset_s;
    double day = 0.0;
    const auto close = [&] {
        if (count == 0) return;
        const double x =
            time.x(std::clamp((day + 0.5) * 86400.0 - origin_s, time.first_s, time.last_s));
        bands.back().mean.push_back({x, y(sum / static_cast<double>(count))});
        bands.back().low.push_back({x, y(low)});
        bands.back().high.push_back({x, y(high)});
        count = 0;
        sum = 0.0;
    };
    for (std::size_t r = 0; r < values.size(); ++r) {
        const double today = std::floor((table.rows[r][0] + origin_s) / 86400.0);
        if (today != day) {
            close();
            day = today;
        }
        if (std::isnan(values[r])) {
            close();
            if (!bands.back().mean.empty()) bands.emplace_back();
            continue;
        }
        low = count ? std::min(low, values[r]) : values[r];
        high = count ? std::max(high, values[r]) : values[r];
        sum += values[r];
        ++count;
    }
    close();
    return bands;
}

void add_series(Drawing& drawing, const SimulationTable& table, const PlotSeries& series,
                const TimeAxis& time, const std::function<double(double)>& y, double bottom)
{
    const auto pieces = [&](const std::string& name) {
        std::vector<double> values = series_values(table, series, name);
        for (double& v : values) v = std::isnan(v) ? v : y(v);
        return curve_pieces(table, time, values, series.steps);
    };
    if (!series.band_low.empty()) {
        const auto lower = pieces(series.band_low), upper = pieces(series.band_high);
        for (std::size_t i = 0; i < std::min(lower.size(), upper.size()); ++i) {
            DrawnArea band{lower[i], series.color, 0.25};
            band.points.insert(band.points.end(), upper[i].rbegin(), upper[i].rend());
            drawing.shapes.push_back(std::move(band));
        }
    }
    if (!series.filled && series.band_low.empty() && wants_days(table)) {
        for (const DailyBand& band :
             daily_bands(table, time, series_values(table, series, series.column), y)) {
            if (band.mean.empty()) continue;
            DrawnArea area{band.low, series.color, 0.28};
            area.points.insert(area.points.end(), band.high.rbegin(), band.high.rend());
            drawing.shapes.push_back(std::move(area));
            drawing.shapes.push_back(DrawnLine{band.mean, series.color, 1.4, false});
        }
        return;
    }
    for (const auto& points : pieces(series.column)) {
        if (series.filled) {
            DrawnArea area{points, series.color, 0.22};
            area.points.insert(area.points.begin(), {points.front().x, bottom});
            area.points.push_back({points.back().x, bottom});
            drawing.shapes.push_back(std::move(area));
        }
        drawing.shapes.push_back(
            DrawnLine{points, series.color, table.rows.size() > 1500 ? 1.3 : 2.0, false});
    }
}

void add_panel(Drawing& drawing, const SimulationTable& table,
               const std::vector<SimulationEvent>& events, const PlotPanel& panel,
               const TimeAxis& time, const std::vector<TimeTick>& time_ticks, double top,
               double height)
{
    const auto [low, high] = axis_range(table, panel);
    const auto y = [&, low = low, high = high](double value) {
        return top + height * (1.0 - (std::clamp(value, low, high) - low) / (high - low));
    };
    const double right = kWidth - kRight;
    add_heading(drawing, table, panel, top);
    for (const auto& [from_s, to_s] : table.gaps_s) {
        const double from = time.x(std::clamp(from_s, time.first_s, time.last_s));
        const double to = time.x(std::clamp(to_s, time.first_s, time.last_s));
        if (to <= from) continue;
        drawing.shapes.push_back(DrawnArea{
            {{from, top}, {to, top}, {to, top + height}, {from, top + height}}, kMark, 0.22});
    }
    const auto ticks = axis_ticks(low, high, panel.forcing ? 4 : 5, false);
    for (double tick : ticks) {
        add_line(drawing, {kLeft, y(tick)}, {right, y(tick)}, kGrid);
        add_label(drawing, {kLeft - 8, y(tick) + 4}, Anchor::End,
                  number_text(tick, decimals_of(ticks)));
    }
    for (const TimeTick& tick : time_ticks)
        add_line(drawing, {time.x(tick.time_s), top}, {time.x(tick.time_s), top + height}, kGrid);
    if (low < 0.0 && high > 0.0) add_line(drawing, {kLeft, y(0)}, {right, y(0)}, kMark);
    for (const SimulationEvent& event : events) {
        const double x = time.x(event.time_s);
        add_line(drawing, {x, top}, {x, top + height}, kMark, true);
    }
    for (const PlotSeries& series : panel.series)
        add_series(drawing, table, series, time, y, y(low));
    for (const PlotDots& dots : panel.dots) {
        DrawnDots drawn{{}, dots.color, dots.values.size() > 150 ? 1.7 : 2.4};
        for (std::size_t i = 0; i < dots.values.size(); ++i)
            drawn.points.push_back({time.x(dots.time_s[i]), y(dots.values[i])});
        drawing.shapes.push_back(std::move(drawn));
    }
}

std::string subtitle(const SimulationTable& table)
{
    if (!table.dated || table.rows.empty()) return "";
    return time_text(table, table.rows.front()[0]) + " to " +
           time_text(table, table.rows.back()[0]) + " " + clock_name(table) +
           (table.typical_year ? "; a typical year: months of different years" : "");
}

// The events that find room: those of a year, not of its first months. Whole kinds are left out,
// the most frequent first, and named.
struct PlottedEvents {
    std::vector<SimulationEvent> shown;
    std::string left_out;
};
PlottedEvents plotted_events(std::vector<SimulationEvent> events)
{
    PlottedEvents out;
    while (events.size() > kMostEvents) {
        std::map<std::string, std::size_t> counts;
        for (const SimulationEvent& e : events) ++counts[e.text];
        if (counts.size() == 1) {
            out.left_out += (out.left_out.empty() ? "" : ", ") +
                            std::to_string(events.size() - kMostEvents) + " more of " +
                            events.front().text;
            events.resize(kMostEvents);
            break;
        }
        const auto most =
            std::max_element(counts.begin(), counts.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        out.left_out += (out.left_out.empty() ? "" : ", ") + std::to_string(most->second) +
                        " times " + most->first;
        std::erase_if(events, [&](const SimulationEvent& e) { return e.text == most->first; });
    }
    if (!out.left_out.empty()) out.left_out = "events not marked: " + out.left_out;
    out.shown = std::move(events);
    return out;
}

// The numbered list of events below the panels, in two columns, and their numbers under the time
// axis.
void add_events(Drawing& drawing, const SimulationTable& table,
                const std::vector<SimulationEvent>& events, const TimeAxis& time, double numbers_y,
                double list_top)
{
    const std::size_t count = events.size();
    const std::size_t half = (count + 1) / 2;
    double label_x = -1e9;
    for (std::size_t i = 0; i < count; ++i) {
        const SimulationEvent& event = events[i];
        const double x = time.x(event.time_s);
        if (x - label_x >= 14.0) {  // the list below has them all
            label_x = x;
            add_label(drawing, {x, numbers_y}, Anchor::Middle, std::to_string(i + 1));
        }
        const double list_x = i < half ? kLeft : kLeft + 440.0;
        const double list_y = list_top + 10.0 + 18.0 * static_cast<double>(i < half ? i : i - half);
        add_label(drawing, {list_x + 14, list_y}, Anchor::End, std::to_string(i + 1));
        const bool dated = table.dated;  // dates are equally long, numbers are not
        add_label(drawing, {list_x + (dated ? 28 : 98), list_y},
                  dated ? Anchor::Start : Anchor::End, time_text(table, event.time_s));
        add_label(drawing, {list_x + (dated ? 152 : 112), list_y}, Anchor::Start, event.text);
    }
}

}  // namespace

Drawing plot_of(const SimulationTable& table)
{
    Drawing drawing;
    drawing.width = kWidth;
    const PlottedEvents events = plotted_events(table.events);
    const std::size_t half = (events.shown.size() + 1) / 2;
    const std::string under = subtitle(table);
    std::vector<std::string> warnings = table.warnings;
    if (!table.gaps_s.empty()) warnings.push_back(gaps_text(table));
    const double head =
        kTop + (under.empty() ? 0.0 : 8.0) + 17.0 * static_cast<double>(warnings.size());
    drawing.height = head + kBottom - kPanelGap + 22.0;
    // Many panels are made lower, so that the picture stays one that can be looked at.
    double panels = 0.0;
    for (const PlotPanel& panel : table.panels)
        panels += panel.forcing ? kForcingHeight : kStateHeight;
    const double gaps = kPanelGap * static_cast<double>(table.panels.size());
    const double room =
        kMostHeight - drawing.height - gaps - 40.0 - 18.0 * static_cast<double>(half + 1);
    const double shrink = std::clamp(room / std::max(panels, 1.0), 0.33, 1.0);
    drawing.height += shrink * panels + gaps;
    const double list_top = drawing.height;
    if (half > 0) drawing.height += 14.0 + 18.0 * static_cast<double>(half);
    if (!events.left_out.empty()) drawing.height += 18.0;

    TimeAxis time;
    if (!table.rows.empty()) {
        time.first_s = table.rows.front()[0];
        time.last_s = table.rows.back()[0];
    }
    const auto ticks = table.dated
                           ? calendar_ticks(table.utc_start_us +
                                                static_cast<std::int64_t>(table.utc_offset_s * 1e6),
                                            time.first_s, time.last_s, 13)
                           : elapsed_ticks(time.first_s, time.last_s, 12);
    drawing.shapes.push_back(
        DrawnText{{kLeft, 26},
                  table.title + " (" + table.model + " model, " + table.mode + ")",
                  kInk,
                  17.0,
                  Anchor::Start,
                  true});
    if (!under.empty()) add_label(drawing, {kLeft, 46}, Anchor::Start, under);
    double line_y = under.empty() ? 46.0 : 63.0;
    for (const std::string& warning : warnings) {
        drawing.shapes.push_back(
            DrawnText{{kLeft, line_y}, warning, kWarning, 12.0, Anchor::Start, false});
        line_y += 17.0;
    }
    double top = head + 18.0;
    for (const PlotPanel& panel : table.panels) {
        const double height = shrink * (panel.forcing ? kForcingHeight : kStateHeight);
        add_panel(drawing, table, events.shown, panel, time, ticks, top, height);
        for (const TimeTick& tick : ticks) {
            const double side = 0.5 * text_width(tick.label, 12.0);
            add_label(
                drawing,
                {std::clamp(time.x(tick.time_s), side, kWidth - side - 2.0), top + height + 16.0},
                Anchor::Middle, tick.label);
        }
        top += height + kPanelGap;
    }
    const double bottom = top - kPanelGap;
    add_events(drawing, table, events.shown, time, bottom + 34, list_top);
    if (!events.left_out.empty())
        add_label(drawing, {kLeft, list_top + 10.0 + 18.0 * static_cast<double>(half)},
                  Anchor::Start, events.left_out);
    return drawing;
}

std::string svg_plot(const SimulationTable& table)
{
    std::string svg = to_svg(plot_of(table));
    svg.insert(svg.find("\n") + 1, "<desc>" + escaped(table.title) + ", state " +
                                       hash_text(table.state_hash) + "</desc>\n");
    return svg;
}

}  // namespace petrichor::cli
