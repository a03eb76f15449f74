#ifndef PETRICHOR_CLI_BENCH_SKILL_LONGWAVE_H
#define PETRICHOR_CLI_BENCH_SKILL_LONGWAVE_H

#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "weather/forcing/forcing.h"

namespace petrichor::cli {

/// The table as it would be filled if its longwave had not been measured.
weather::ForcingTable without_longwave(const weather::ForcingTable& raw);

/// Made longwave beside measured longwave: root mean square error over all hours, and under cloud
/// (a filled cloud of 0.9 or more) the size of the bias. Empty without measured longwave.
///
/// Longwave and sunlight made from temperature and humidity alone, as in a file without clouds, sun
/// and sky, are scored beside them.
///
/// Two rows beside them tell what the instrument does to these, where it measured 50 damp hours (95
/// % and more) of rain or snow (0.5 mm/h and more): its longwave then over that of a black sky as
/// warm as the air, which such a sky nearly is; and the bias under cloud if the measured longwave
/// is divided by that. Where that share changes by 0.03 and more from a day on, the day and the
/// change are told, with the bias under cloud before it and from it on.
std::vector<SkillRow> longwave_rows(const std::string& set, const weather::ForcingTable& raw);

/// What longwave_rows found in a set, and where that was measured.
struct PlacedRows {
    weather::Site site;
    std::vector<SkillRow> rows;
};
/// The bias under cloud over all hours of all sets of a place: of a station, not of one of its
/// winters.
std::vector<SkillRow> longwave_of_places(const std::vector<PlacedRows>& sets);

}  // namespace petrichor::cli

#endif
