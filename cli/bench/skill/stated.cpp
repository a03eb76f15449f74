// What the scores on the shared data are stated to be: the one table. A change that makes a score
// worse than its stated value and margin fails; one that makes it better lowers the value here.
#include <algorithm>
#include <iterator>

#include "cli/bench/skill/board.h"

namespace petrichor::cli {
namespace {

constexpr StatedScore kStated[] = {
    {"col_de_porte_2001_02", "snow depth", 0.108, 0.005, 0.088},
    {"col_de_porte_2001_02", "SWE", 64.6, 2.0, 71.35},
    {"col_de_porte_2001_02", "snow off", 8.0, 2, 10.0},
    {"col_de_porte_2001_02", "snow depth without longwave", 0.049, 0.005, 0.104},
    {"1994_95", "snow depth", 0.16, 0.005, 0.334},
    {"1994_95", "SWE of pits", 48.9, 2.0, 39.619},
    {"1994_95", "snow albedo", 0.086, 0.005, 0.086},
    {"1994_95", "snow off", 0.0, 2, 0.0},
    {"1994_95", "snow depth without longwave", 0.364, 0.005, kNoScore},
    {"1996_97", "snow depth", 0.104, 0.005, 0.174},
    {"1996_97", "SWE of pits", 45.7, 2.0, 36.106},
    {"1996_97", "snow albedo", 0.098, 0.005, 0.098},
    {"1996_97", "snow off", 8.0, 2, 5.0},
    {"1996_97", "snow depth without longwave", 0.198, 0.005, kNoScore},
    {"1998_99", "snow depth", 0.141, 0.005, 0.089},
    {"1998_99", "SWE of pits", 81.4, 2.0, 84.469},
    {"1998_99", "snow albedo", 0.066, 0.005, 0.073},
    {"1998_99", "snow off", 1.0, 2, 2.0},
    {"1998_99", "snow depth without longwave", 0.126, 0.005, kNoScore},
    {"2000_01", "snow depth", 0.084, 0.005, 0.079},
    {"2000_01", "SWE of pits", 23.7, 2.0, 18.344},
    {"2000_01", "snow albedo", 0.077, 0.005, 0.08},
    {"2000_01", "snow off", 2.0, 2, 3.0},
    {"2000_01", "snow depth without longwave", 0.113, 0.005, kNoScore},
    {"2003_04", "snow depth", 0.108, 0.005, 0.091},
    {"2003_04", "SWE", 49.3, 2.0, 64.333},
    {"2003_04", "SWE of pits", 53.2, 2.0, 63.66},
    {"2003_04", "snow albedo", 0.08, 0.005, 0.08},
    {"2003_04", "snow off", 0.0, 2, 2.0},
    {"2003_04", "snow depth without longwave", 0.114, 0.005, kNoScore},
    {"2006_07", "snow depth", 0.049, 0.005, 0.088},
    {"2006_07", "SWE", 49.2, 2.0, 67.311},
    {"2006_07", "SWE of pits", 46.9, 2.0, 80.75},
    {"2006_07", "snow albedo", 0.068, 0.005, 0.104},
    {"2006_07", "snow off", 51.0, 2, 51.0},
    {"2006_07", "snow depth without longwave", 0.053, 0.005, kNoScore},
    {"2008_09", "snow depth", 0.085, 0.005, 0.066},
    {"2008_09", "SWE", 21.0, 2.0, 28.586},
    {"2008_09", "SWE of pits", 26.5, 2.0, 33.252},
    {"2008_09", "snow albedo", 0.056, 0.005, 0.073},
    {"2008_09", "snow off", 0.0, 2, 2.0},
    {"2008_09", "snow depth without longwave", 0.052, 0.005, kNoScore},
    {"2010_11", "snow depth", 0.131, 0.005, 0.124},
    {"2010_11", "SWE", 29.3, 2.0, 20.431},
    {"2010_11", "SWE of pits", 58.9, 2.0, 37.392},
    {"2010_11", "snow albedo", 0.065, 0.005, 0.065},
    {"2010_11", "snow off", 9.0, 2, 6.0},
    {"2010_11", "snow depth without longwave", 0.091, 0.005, kNoScore},
    {"CdP_0506", "snow depth", 0.077, 0.005, 0.079},
    {"CdP_0506", "SWE", 24.8, 2.0, 19.481},
    {"CdP_0506", "snow surface", 1.09, 0.1, 1.127},
    {"CdP_0506", "snow albedo", 0.066, 0.005, 0.066},
    {"CdP_0506", "snow off", 7.0, 2, 6.0},
    {"CdP_0506", "snow depth without longwave", 0.106, 0.005, 0.239},
    {"col_de_porte_2001_02", "longwave", 31.6, 1.0, kNoScore},
    {"col_de_porte_2001_02", "longwave under cloud", 3.5, 1.0, kNoScore},
    {"1994_95", "longwave", 29.0, 1.0, kNoScore},
    {"1994_95", "longwave under cloud", 6.0, 1.0, kNoScore},
    {"1996_97", "longwave", 28.9, 1.0, kNoScore},
    {"1996_97", "longwave under cloud", 4.1, 1.0, kNoScore},
    {"1998_99", "longwave", 27.0, 1.0, kNoScore},
    {"1998_99", "longwave under cloud", 3.5, 1.0, kNoScore},
    {"2000_01", "longwave", 27.2, 1.0, kNoScore},
    {"2000_01", "longwave under cloud", 1.1, 1.0, kNoScore},
    {"2003_04", "longwave", 26.8, 1.0, kNoScore},
    {"2003_04", "longwave under cloud", 0.8, 1.0, kNoScore},
    {"2006_07", "longwave", 29.2, 1.0, kNoScore},
    {"2006_07", "longwave under cloud", 3.6, 1.0, kNoScore},
    {"2008_09", "longwave", 28.7, 1.0, kNoScore},
    {"2008_09", "longwave under cloud", 4.0, 1.0, kNoScore},
    {"2010_11", "longwave", 33.2, 1.0, kNoScore},
    {"2010_11", "longwave under cloud", 13.8, 1.0, kNoScore},
    {"CdP_0506", "longwave", 27.8, 1.0, kNoScore},
    {"CdP_0506", "longwave under cloud", 2.8, 1.0, kNoScore},
    {"champaign_1998_half_hourly", "longwave", 25.7, 1.0, kNoScore},
    {"champaign_1998_half_hourly", "longwave under cloud", 3.8, 1.0, kNoScore},
    {"case002", "road beside METRo", 0.98, 0.1, kNoScore},
    {"case004", "road beside METRo", 0.31, 0.1, kNoScore},
    {"case008", "road beside METRo", 0.7, 0.1, kNoScore},
    {"case010", "road beside METRo", 1.16, 0.1, kNoScore},
    {"case016", "road beside METRo", 1.11, 0.1, kNoScore},
    {"case018", "road beside METRo", 0.74, 0.1, kNoScore},
    {"case020", "road beside METRo", 0.93, 0.1, kNoScore},
    {"case022", "road beside METRo", 0.09, 0.1, kNoScore},
    {"case026", "road beside METRo", 1.63, 0.1, kNoScore},
    {"case028", "road beside METRo", 1.2, 0.1, kNoScore},
    {"case032", "road beside METRo", 1.2, 0.1, kNoScore},
    {"case034", "road beside METRo", 0.91, 0.1, kNoScore},
    {"case036", "road beside METRo", 0.57, 0.1, kNoScore},
    {"case038", "road beside METRo", 0.24, 0.1, kNoScore},
    {"case042", "road beside METRo", 1.21, 0.1, kNoScore},
    {"case048", "road beside METRo", 0.27, 0.1, kNoScore},
    {"selftest", "road beside METRo", 0.3, 0.1, kNoScore},
};

}  // namespace

std::optional<StatedScore> stated_score(const std::string& set, const std::string& quantity)
{
    const auto* found =
        std::find_if(std::begin(kStated), std::end(kStated),
                     [&](const StatedScore& s) { return set == s.set && quantity == s.quantity; });
    return found == std::end(kStated) ? std::nullopt : std::optional(*found);
}

}  // namespace petrichor::cli
