#include "film/jobs/air_travel.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

namespace petrichor::film {
namespace {

constexpr double kStep_s = 0.25;
constexpr double kMostSteps = 4096.0;

}  // namespace

struct AirTravel::Grid {
    std::function<glm::dvec2(double)> wind_m_s;
    double begin_s = 0.0;
    double step_s = kStep_s;   // of the clock
    double film_per_clock = 1.0;
    std::size_t steps = 1;
    std::once_flag made;
    std::vector<glm::dvec2> wind, gone_m;  // at the points

    void make()
    {
        glm::dvec2 sum(0.0);
        for (std::size_t i = 0; i <= steps; ++i) {
            wind.push_back(wind_m_s(begin_s + static_cast<double>(i) * step_s));
            if (i > 0) sum += (wind[i - 1] + wind[i]) * (0.5 * step_s * film_per_clock);
            gone_m.push_back(sum);
        }
    }
};

AirTravel::AirTravel(std::function<glm::dvec2(double)> wind_m_s, double begin_s, double duration_s,
                     double film_s)
    : grid_(std::make_shared<Grid>())
{
    const double steps = std::clamp(std::ceil(duration_s / kStep_s), 1.0, kMostSteps);
    grid_->wind_m_s = std::move(wind_m_s);
    grid_->begin_s = begin_s;
    grid_->steps = static_cast<std::size_t>(steps);
    grid_->step_s = duration_s / steps;
    grid_->film_per_clock = film_s / duration_s;
}

glm::dvec2 AirTravel::at(double clock_s) const
{
    if (!grid_) return glm::dvec2(0.0);
    Grid& g = *grid_;
    std::call_once(g.made, [&g] { g.make(); });
    const double along =
        std::clamp((clock_s - g.begin_s) / g.step_s, 0.0, static_cast<double>(g.steps));
    const auto i = std::min(static_cast<std::size_t>(along), g.steps - 1);
    const double u = along - static_cast<double>(i);
    const glm::dvec2 mean = g.wind[i] + (g.wind[i + 1] - g.wind[i]) * (0.5 * u);
    return g.gone_m[i] + mean * (u * g.step_s * g.film_per_clock);
}

}  // namespace petrichor::film
