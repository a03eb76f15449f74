#ifndef PETRICHOR_FILM_JOBS_AIR_TRAVEL_H
#define PETRICHOR_FILM_JOBS_AIR_TRAVEL_H

#include <functional>
#include <glm/glm.hpp>
#include <memory>

namespace petrichor::film {

/// How far the air has gone since a sequence began: the integral of the wind over the film's own
/// seconds. What falls is carried by it; the product of wind and time would throw all of it about
/// whenever the wind changes.
///
/// The wind is asked on a fixed grid of the clock (a quarter of a second, at most 4096 steps over
/// the sequence) and is linear between its points, so the answer does not depend on the frame rate
/// or on which times were asked for before. Copies share the grid, which is made with the first
/// question.
class AirTravel {
public:
    /// At rest: always zero.
    AirTravel() = default;
    ///   wind_m_s     by the clock of the weather
    ///   begin_s      of the sequence on that clock
    ///   duration_s   > 0
    ///   film_s       seconds of the film that pass in it, > 0
    AirTravel(std::function<glm::dvec2(double clock_s)> wind_m_s, double begin_s, double duration_s,
              double film_s);

    /// At a time of the clock; before the sequence zero, after it as far as at its end.
    glm::dvec2 at(double clock_s) const;

private:
    struct Grid;
    std::shared_ptr<Grid> grid_;
};

}  // namespace petrichor::film

#endif
