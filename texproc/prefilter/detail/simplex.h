#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_SIMPLEX_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_SIMPLEX_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace petrichor::texproc::detail {

/// Nelder and Mead's simplex in N dimensions, at most about `budget` evaluations: the best point
/// and its value. Starts from `start`, whose value is known, and one step along each axis; stops
/// when all corners agree within `tolerance`.
template <std::size_t N, class Function>
std::pair<std::array<float, N>, float> simplex(const std::array<float, N>& start, float start_value,
                                               const std::array<float, N>& steps, int budget,
                                               float tolerance, const Function& f)
{
    using Point = std::array<float, N>;
    std::array<std::pair<float, Point>, N + 1> s;
    s[0] = {start_value, start};
    for (std::size_t i = 0; i < N; ++i) {
        Point p = start;
        p[i] += steps[i];
        s[i + 1] = {f(p), p};
        --budget;
    }
    const auto by_value = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(s.begin(), s.end(), by_value);
    while (budget > 0 && s[N].first - s[0].first > tolerance) {
        Point centre{};
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t k = 0; k < N; ++k) centre[k] += s[i].second[k] / static_cast<float>(N);
        }
        const auto moved = [&](float factor) {
            Point p;
            for (std::size_t k = 0; k < N; ++k) {
                p[k] = centre[k] + factor * (s[N].second[k] - centre[k]);
            }
            return p;
        };
        const Point reflected = moved(-1.0f);
        const float value = f(reflected);
        --budget;
        if (value < s[0].first && budget > 0) {
            const Point further = moved(-2.0f);
            const float far_value = f(further);
            --budget;
            s[N] = far_value < value ? std::pair{far_value, further} : std::pair{value, reflected};
        } else if (value < s[N - 1].first) {
            s[N] = {value, reflected};
        } else {
            const Point inner = value < s[N].first ? moved(-0.5f) : moved(0.5f);
            const float inner_value = f(inner);
            --budget;
            if (inner_value < std::min(value, s[N].first)) {
                s[N] = {inner_value, inner};
            } else {
                for (std::size_t i = 1; i <= N; ++i) {
                    for (std::size_t k = 0; k < N; ++k) {
                        s[i].second[k] = 0.5f * (s[i].second[k] + s[0].second[k]);
                    }
                    s[i].first = f(s[i].second);
                    --budget;
                }
            }
        }
        std::sort(s.begin(), s.end(), by_value);
    }
    return {s[0].second, s[0].first};
}

}  // namespace petrichor::texproc::detail

#endif
