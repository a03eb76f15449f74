#include "cli/report/panel_choice.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/words.h"
#include "cli/report/plot_axes.h"

namespace petrichor::cli {
namespace {

bool shows_something(const SimulationTable& table, const PlotPanel& panel)
{
    if (!panel.dots.empty()) return true;
    for (const PlotSeries& series : panel.series) {
        for (const double value : series_values(table, series, series.column)) {
            if (std::abs(value) > 1e-6) return true;
        }
    }
    return false;
}

}  // namespace

std::vector<PlotPanel> chosen_panels(const SimulationTable& table, const std::string& wish)
{
    std::vector<PlotPanel> chosen;
    if (wish == "all") return table.panels;
    if (wish == "auto") {
        for (const PlotPanel& panel : table.panels) {
            if (shows_something(table, panel)) chosen.push_back(panel);
        }
        return chosen;
    }
    std::vector<std::string> groups, asked;
    for (const PlotPanel& panel : table.panels) {
        if (!panel.group.empty() &&
            std::find(groups.begin(), groups.end(), panel.group) == groups.end())
            groups.push_back(panel.group);
    }
    for (std::size_t at = 0; at <= wish.size();) {
        const std::size_t end = std::min(wish.find(',', at), wish.size());
        asked.push_back(wish.substr(at, end - at));
        at = end + 1;
        if (std::find(groups.begin(), groups.end(), asked.back()) == groups.end()) {
            throw Error("--plot: there is no \"" + asked.back() + "\"",
                        "Use auto, all, or some of: " + join_words(groups) + ".");
        }
    }
    for (const PlotPanel& panel : table.panels) {
        const bool named = std::find(asked.begin(), asked.end(), panel.group) != asked.end();
        if (named || panel.group == "weather") chosen.push_back(panel);
    }
    return chosen;
}

}  // namespace petrichor::cli
