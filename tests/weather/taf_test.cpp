#include "weather/readers/taf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

// The texts below are made up after the rules of WMO-No. 49 (Annex 3, appendix 5), NWSI 10-813 and
// the form of before November 2008.
namespace petrichor::weather {
namespace {

std::int64_t at(const char* iso)
{
    return us_from_iso(iso).value();
}

TafForecast placed(const std::string& text, const char* near)
{
    auto taf = parse_taf(text);
    EXPECT_TRUE(taf) << text;
    EXPECT_TRUE(place_taf(*taf, at(near))) << text;
    return *taf;
}

// The weather of an hour.
MetarReport hour(const TafForecast& taf, const char* iso, TafUse use = TafUse::Expected)
{
    return taf_weather(taf, at(iso), at(iso) + 3600000000LL, use);
}

TEST(Taf, FromReplacesEverything)
{
    const auto taf = placed(
        "EDDF 312300Z 0100/0206 24010KT 3000 RA BKN010 FM010330 30020KT 9999 SCT040 "
        "FM011200 28005KT CAVOK",
        "2023-12-31T23:20Z");
    EXPECT_EQ(iso_from_us(taf.begin_us), "2024-01-01T00:00:00Z");
    EXPECT_EQ(iso_from_us(taf.end_us), "2024-01-02T06:00:00Z");
    EXPECT_NEAR(hour(taf, "2024-01-01T02:00Z").rain_mm_h, 4.5, 1e-12);
    EXPECT_NEAR(hour(taf, "2024-01-01T03:00Z").rain_mm_h, 4.5, 1e-12);
    const auto dry = hour(taf, "2024-01-01T03:30Z");
    EXPECT_EQ(dry.rain_mm_h, 0.0);
    EXPECT_NEAR(dry.wind_m_s, 20 * 1852.0 / 3600.0, 1e-9);
    EXPECT_NEAR(dry.cloud, 0.44, 1e-12);
    EXPECT_EQ(hour(taf, "2024-01-01T12:00Z").cloud, 0.0);
    // Rows at whole hours, and where 03:30 begins.
    const auto times = taf_times(taf);
    EXPECT_EQ(times.size(), 30u + 1u + 1u);
    EXPECT_EQ(times[4], at("2024-01-01T03:30Z"));
}

TEST(Taf, BecomingChangesWhatItNamesEvenly)
{
    const auto taf = placed(
        "LSZH 101100Z 1012/1118 24010KT 2000 -SN OVC010 BECMG 1016/1020 30020KT 9999 "
        "BECMG 1100/1102 NSW",
        "2024-02-10T11:00Z");
    const auto before = hour(taf, "2024-02-10T15:00Z");
    const auto half =
        taf_weather(taf, at("2024-02-10T18:00Z"), at("2024-02-10T18:00Z"), TafUse::Expected);
    const auto after = hour(taf, "2024-02-10T20:00Z");
    EXPECT_NEAR(half.wind_m_s, 0.5 * (before.wind_m_s + after.wind_m_s), 1e-9);
    EXPECT_NEAR(half.visibility_m, 6000.0, 1e-9);
    // Snow and cloud are not named: they stay. NSW ends the snow only.
    EXPECT_NEAR(after.snow_mm_h, 0.5, 1e-12);
    EXPECT_NEAR(after.cloud, 1.0, 1e-12);
    EXPECT_EQ(hour(taf, "2024-02-11T02:00Z").snow_mm_h, 0.0);
    EXPECT_NEAR(hour(taf, "2024-02-11T02:00Z").cloud, 1.0, 1e-12);
}

struct PassingCase {
    const char* name;
    const char* group;
    double share;
};
void PrintTo(const PassingCase& c, std::ostream* out)
{
    *out << c.name;
}
class TafPassing : public testing::TestWithParam<PassingCase> {};

TEST_P(TafPassing, EachUse)
{
    const auto taf = placed(std::string("EDDF 010500Z 0106/0212 24010KT 9999 -RA BKN030 ") +
                                GetParam().group + " 0110/0114 25025G40KT 1500 +RA OVC005",
                            "2024-03-01T05:00Z");
    const double share = GetParam().share;
    const auto expected = hour(taf, "2024-03-01T10:00Z");
    EXPECT_NEAR(expected.rain_mm_h, 1.0 + share * 11.0, 1e-12);
    EXPECT_NEAR(expected.visibility_m, 10000.0 - share * 8500.0, 1e-9);
    EXPECT_NEAR(expected.cloud, 0.75 + share * 0.25, 1e-12);
    EXPECT_NEAR(hour(taf, "2024-03-01T10:00Z", TafUse::Prevailing).rain_mm_h, 1.0, 1e-12);
    const auto worst = hour(taf, "2024-03-01T10:00Z", TafUse::Worst);
    EXPECT_NEAR(worst.rain_mm_h, 12.0, 1e-12);
    EXPECT_NEAR(worst.wind_m_s, 25 * 1852.0 / 3600.0, 1e-9);
    EXPECT_NEAR(worst.visibility_m, 1500.0, 1e-9);
    for (const char* outside : {"2024-03-01T09:00Z", "2024-03-01T14:00Z"}) {
        for (const TafUse use : {TafUse::Expected, TafUse::Prevailing, TafUse::Worst})
            EXPECT_NEAR(hour(taf, outside, use).rain_mm_h, 1.0, 1e-12) << outside;
    }
}

INSTANTIATE_TEST_SUITE_P(Groups, TafPassing,
                         testing::Values(PassingCase{"tempo", "TEMPO", 0.5},
                                         PassingCase{"inter", "INTER", 0.25},
                                         PassingCase{"prob30", "PROB30", 0.3},
                                         PassingCase{"prob40", "PROB40", 0.4},
                                         PassingCase{"prob30_tempo", "PROB30 TEMPO", 0.15},
                                         PassingCase{"prob40_tempo", "PROB40 TEMPO", 0.2}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Taf, MilesAltimetersAndMarksOfAmericanForecasts)
{
    const auto taf = placed(
        "AMD KDEN 291720Z 2918/0124 VRB05KT 1 1/2SM -SN BR OVC008 WS020/24045KT QNH2992INS "
        "FM292200 36015G25KT P6SM SKC",
        "2024-02-29T17:20Z");
    EXPECT_EQ(iso_from_us(taf.end_us), "2024-03-02T00:00:00Z");
    const auto snow = hour(taf, "2024-02-29T18:00Z");
    EXPECT_NEAR(snow.visibility_m, 1.5 * 1609.344, 1e-6);
    EXPECT_NEAR(snow.snow_mm_h, 0.5, 1e-12);
    EXPECT_NEAR(snow.qnh_pa, 101320.7, 0.5);
    EXPECT_NEAR(snow.wind_m_s, 5 * 1852.0 / 3600.0, 1e-9);  // not the shear's 45 knots
    EXPECT_EQ(hour(taf, "2024-03-01T00:00Z").cloud, 0.0);
}

TEST(Taf, TheFormBefore2008)
{
    const auto taf = placed(
        "EGLL 311100Z 311212 24010KT 9999 BKN020 FM1800 30015KT 4000 RA TEMPO 2102 +RA "
        "BECMG 0406 NSW 9999",
        "2007-12-31T11:00Z");
    EXPECT_EQ(iso_from_us(taf.begin_us), "2007-12-31T12:00:00Z");
    EXPECT_EQ(iso_from_us(taf.end_us), "2008-01-01T12:00:00Z");
    EXPECT_EQ(hour(taf, "2007-12-31T17:00Z").rain_mm_h, 0.0);
    EXPECT_NEAR(hour(taf, "2007-12-31T18:00Z").rain_mm_h, 4.5, 1e-12);
    EXPECT_NEAR(hour(taf, "2008-01-01T01:00Z").rain_mm_h, 4.5 + 0.5 * 7.5, 1e-12);
    EXPECT_NEAR(hour(taf, "2008-01-01T02:00Z").rain_mm_h, 4.5, 1e-12);
    EXPECT_EQ(hour(taf, "2008-01-01T06:00Z").rain_mm_h, 0.0);
    EXPECT_NEAR(hour(taf, "2008-01-01T06:00Z").visibility_m, 10000.0, 1e-9);
}

TEST(Taf, DaysThatDoNotExistAndValiditiesThatCannotBe)
{
    for (const char* text : {"EDDF 300500Z 3006/3112 24010KT", "EDDF 010500Z 0106/0112 24010KT"})
        EXPECT_TRUE(parse_taf(text));
    auto far = *parse_taf("EDDF 010500Z 0106/0712 24010KT");
    EXPECT_FALSE(place_taf(far, at("2024-03-01T05:00Z")));
    auto backwards = *parse_taf("EDDF 010500Z 0106/0103 24010KT");
    EXPECT_FALSE(place_taf(backwards, at("2024-03-01T05:00Z")));
    EXPECT_FALSE(parse_taf("EDDF 010500Z 0106/0299 24010KT"));
    EXPECT_FALSE(parse_taf("EDDF 010500Z"));
    EXPECT_TRUE(parse_taf("EDDF 010500Z NIL")->nil);
}

// ---- through the reader ----

double rain_at(const ForcingTable& table, const char* iso)
{
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (table.time_us[i] == at(iso)) return table[Field::Rain][i] * 3600.0;
    }
    ADD_FAILURE() << "no row at " << iso;
    return kMissing;
}

TEST(TafFile, WrappedLinesAfterReports)
{
    const std::string text =
        "FTDL31 EDZF 312300\n"
        "METAR EDDF 312320Z 24010KT 9999 BKN030 04/03 Q1010=\n"
        "TAF EDDF 312300Z 0100/0106 24010KT 9999 BKN020\n"
        "      TX05/0105Z TN03/0101Z\n"
        "      PROB40\n"
        "      TEMPO 0102/0104 +RA\n"
        "      BKN008=\n";
    const auto r = read_weather(text, {.year = 2023, .month = 12});
    EXPECT_EQ(iso_from_us(r.table.time_us.back()), "2024-01-01T06:00:00Z");
    EXPECT_NEAR(rain_at(r.table, "2024-01-01T02:00Z"), 0.2 * 12.0, 1e-9);
    EXPECT_NEAR(rain_at(r.table, "2024-01-01T04:00Z"), 0.0, 1e-12);
    EXPECT_NEAR(value_at(r.table, Field::AirTemp, at("2024-01-01T05:00Z")), 278.15, 1e-9);
    EXPECT_NE(to_text(r.report).find("0 FM, 0 BECMG, 1 TEMPO or PROB groups, these by their share"),
              std::string::npos)
        << to_text(r.report);
    const auto worst = read_weather(text, {.year = 2023, .month = 12, .taf = TafUse::Worst});
    EXPECT_NEAR(rain_at(worst.table, "2024-01-01T02:00Z"), 12.0, 1e-9);
}

TEST(TafFile, LaterIssuesReplaceEarlierOnesWhereTheyHold)
{
    const std::string text =
        "TAF AMD KXYZ 010900Z 0109/0118 24010KT P6SM -RA OVC020 TX05/0114Z=\n"
        "TAF KXYZ 010500Z 0106/0206 24010KT P6SM RA OVC010 TX09/0114Z TN01/0206Z=\n";
    const auto r = read_weather(text, {.year = 2024, .month = 6});
    EXPECT_NEAR(rain_at(r.table, "2024-06-01T08:00Z"), 4.5, 1e-9);
    EXPECT_NEAR(rain_at(r.table, "2024-06-01T09:00Z"), 1.0, 1e-9);
    EXPECT_NEAR(rain_at(r.table, "2024-06-01T17:00Z"), 1.0, 1e-9);
    EXPECT_NEAR(rain_at(r.table, "2024-06-01T18:00Z"), 4.5, 1e-9);
    EXPECT_NEAR(value_at(r.table, Field::AirTemp, at("2024-06-01T14:00Z")), 278.15, 1e-9);
}

TEST(TafFile, ACancelledForecastEndsTheOneItCancels)
{
    const std::string text =
        "TAF EDDF 010500Z 0106/0212 24010KT 9999 RA BKN030 TX09/0108Z=\n"
        "TAF AMD EDDF 010900Z 0109/0212 CNL=\n";
    const auto r = read_weather(text, {.year = 2024, .month = 6});
    EXPECT_LE(r.table.time_us.back(), at("2024-06-01T09:00Z"));
    EXPECT_NE(to_text(r.report).find("cancelled"), std::string::npos);
}

}  // namespace
}  // namespace petrichor::weather
