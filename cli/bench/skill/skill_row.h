#ifndef PETRICHOR_CLI_BENCH_SKILL_SKILL_ROW_H
#define PETRICHOR_CLI_BENCH_SKILL_SKILL_ROW_H

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace petrichor::cli {

inline constexpr double kNoScore = std::numeric_limits<double>::quiet_NaN();

/// How far a model is from what was seen of one quantity in one data set.
struct SkillRow {
    std::string set;       ///< "col_de_porte_1994_95", "metro case002"
    std::string quantity;  ///< "snow depth"
    std::string unit;
    std::size_t count = 0;    ///< values compared
    double score = kNoScore;  ///< root mean square error, unless `measure` says otherwise
    double bias = kNoScore;   ///< model less observation
    std::string measure = "RMSE";
};

/// Gathers errors into a score.
class ErrorSum {
public:
    void add(double error)
    {
        if (!std::isfinite(error)) return;
        ++count_;
        sum_ += error;
        squares_ += error * error;
        sizes_ += std::abs(error);
    }
    std::size_t count() const { return count_; }
    double rmse() const { return count_ ? std::sqrt(squares_ / number()) : kNoScore; }
    double mae() const { return count_ ? sizes_ / number() : kNoScore; }
    double bias() const { return count_ ? sum_ / number() : kNoScore; }

private:
    double number() const { return static_cast<double>(count_); }
    std::size_t count_ = 0;
    double sum_ = 0.0, squares_ = 0.0, sizes_ = 0.0;
};

}  // namespace petrichor::cli

#endif
