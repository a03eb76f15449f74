// Archives wrap METAR in tables and under dates: the years and months come from there.
#include "weather/readers/report_lines.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

const ReadOptions kUnfilled{.fill = false};

std::vector<std::string> times(const ReadResult& r)
{
    std::vector<std::string> out;
    for (const auto us : r.table.time_us) out.push_back(iso_from_us(us));
    return out;
}
using Times = std::vector<std::string>;

TEST(ReportLines, TablesWithAColumnOfReports)
{
    for (const char* header :
         {"station,valid,tmpf,metar", "#DEBUG: times in UTC\nstation,valid,tmpf,METAR"}) {
        const auto r = read_weather(
            std::string(header) +
                "\nDEN,2023-12-31 22:53,30.0,KDEN 312253Z 18005KT 10SM CLR M01/M07 A3010\n"
                "DEN,2023-12-31 23:53,M,KDEN 312353Z 18005KT 10SM CLR M02/M07 A3010\n"
                "DEN,2024-01-01 00:53,28.0,KDEN 010053Z 18005KT 2SM -SN OVC020 M02/M03 A3010\n",
            kUnfilled);
        EXPECT_EQ(r.report.format, "METAR");
        EXPECT_EQ(times(r),
                  (Times{"2023-12-31T22:53:00Z", "2023-12-31T23:53:00Z", "2024-01-01T00:53:00Z"}));
        EXPECT_NEAR(r.table[Field::AirTemp][1], 273.15 - 2.0, 1e-9);
    }
    const auto raw = read_weather(
        "raw_text,station_id,observation_time,latitude\n"
        "EDDF 290650Z 24008KT 9999 FEW020 12/09 Q1010,EDDF,2024-02-29T06:50:00Z,50.0\n",
        kUnfilled);
    EXPECT_EQ(times(raw), Times{"2024-02-29T06:50:00Z"});
}

// The column of times may be local: 18:53 of the 31st in Denver is the 1st in the report.
TEST(ReportLines, TheDayOfTheReportDecidesAtTheTurnOfAMonth)
{
    const auto r = read_weather(
        "station,valid,metar\n"
        "DEN,2023-12-31 17:53,KDEN 010053Z 18005KT 10SM CLR M01/M07 A3010\n"
        "PHTO,2024-03-01 00:10,KDEN 290153Z 18005KT 10SM CLR M01/M07 A3010\n",
        kUnfilled);
    EXPECT_EQ(times(r), (Times{"2024-01-01T00:53:00Z", "2024-02-29T01:53:00Z"}));
}

TEST(ReportLines, RowsWithTheDateInFrontAndLinesBelowADate)
{
    const auto rows = read_weather(
        "EDDF,2024,01,31,23,50,METAR EDDF 312350Z 24008KT 9999 FEW020 02/M01 Q1010=\n"
        "EDDF,2024,02,01,00,20,METAR EDDF 010020Z 24008KT 9999 FEW020 01/M01 Q1010=\n",
        kUnfilled);
    EXPECT_EQ(rows.report.format, "METAR");
    EXPECT_EQ(times(rows), (Times{"2024-01-31T23:50:00Z", "2024-02-01T00:20:00Z"}));
    const auto below = read_weather(
        "2024/01/31 23:50\nEDDF 312350Z 24008KT 9999 FEW020 02/M01 Q1010\n\n"
        "2024/02/01 00:20\nEDDF 010020Z 24008KT 9999 FEW020 01/M01 Q1010\n",
        kUnfilled);
    EXPECT_EQ(times(below), (Times{"2024-01-31T23:50:00Z", "2024-02-01T00:20:00Z"}));
}

TEST(ReportLines, RowsWithoutAReportAreLeftOut)
{
    const auto r = read_weather(
        "station,valid,metar\n"
        "DEN,2024-01-01 00:53,KDEN 010053Z 18005KT 10SM CLR M01/M07 A3010\n"
        "DEN,2024-01-01 01:53,M\n"
        "DEN,2024-01-01 02:53\n"
        "DEN,2024-01-01 03:53,KDEN 010353Z 18005KT 10SM CLR M03/M07 A3010\n",
        kUnfilled);
    EXPECT_EQ(times(r), (Times{"2024-01-01T00:53:00Z", "2024-01-01T03:53:00Z"}));
    EXPECT_EQ(r.report.bad_rows, 0u);
}

}  // namespace
}  // namespace petrichor::weather
