#ifndef PETRICHOR_FILM_WEATHER_SNOW_HISTORY_H
#define PETRICHOR_FILM_WEATHER_SNOW_HISTORY_H

#include <functional>
#include <memory>

namespace petrichor::film {

/// How old tracks are, in snow: what has fallen on them since, and what is left of the snow that they were made in.
///
/// The depth is asked on a fixed grid over the film and is linear between its points, so an answer depends on the
/// two times alone. Copies share the grid, which is made with the first question.
class SnowHistory {
public:
    /// No snow changes: all of a track is left for ever.
    SnowHistory() = default;
    ///   depth_m   of snow at a second of the film, >= 0
    ///   film_s    seconds of the film, from 0
    ///   steps     of the grid
    SnowHistory(std::function<double(double film_s)> depth_m, double film_s, int steps);

    /// Share of a track's depth, as that of all snow now, that is left of one made at `made_s`: o / d exp(-n / o) with
    /// the old snow o, the new snow n and the depth d = o + n. What settles or melts takes its share of both.
    /// Before the film there was the snow of its first moment.
    double left(double made_s, double now_s) const;

private:
    struct Grid;
    std::shared_ptr<Grid> grid_;
};

}  // namespace petrichor::film

#endif
