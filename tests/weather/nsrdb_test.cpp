// NSRDB tables: rows made up after the layout of real ones.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

const std::string kAbout =
    "Source,Location ID,City,State,Country,Latitude,Longitude,Time Zone,Elevation,Local Time Zone,"
    "Dew Point Units,DHI Units,DNI Units,GHI Units,Temperature Units,Pressure Units,"
    "Relative Humidity Units,Wind Direction Units,Wind Speed Units,Cloud Type 0,Version\n"
    "NSRDB,155474,-,-,-,40.53,-108.54,-7,2133,-7,c,w/m2,w/m2,w/m2,c,mbar,%,Degrees,m/s,Clear,v3\n";
const std::string kNames =
    "Year,Month,Day,Hour,Minute,DHI,DNI,GHI,Dew Point,Fill Flag,Wind Speed,Wind Direction,"
    "Relative Humidity,Temperature,Pressure,,,\n";

TEST(Nsrdb, UnitsAndPlaceStandAboveTheTable)
{
    const auto r = read_weather(kAbout + kNames +
                                    "2017,1,1,11,30,98,720,408,-6,0,6.3,218.2,63.44,0,770,,,\n"
                                    "2017,1,1,12,0,205,230,308,-5,0,6.5,220.1,60.15,0.5,770,,,\n"
                                    "2017,1,1,12,30,76,941,496,-5,0,,220.1,60.11,0,770,,,\n",
                                {.fill = false});
    EXPECT_EQ(r.report.format, "NSRDB CSV");
    const ForcingTable& t = r.table;
    ASSERT_EQ(t.rows(), 3u);
    EXPECT_EQ(iso_from_us(t.time_us[0]), "2017-01-01T18:30:00Z");
    EXPECT_NEAR(t.site.latitude_deg, 40.53, 1e-9);
    EXPECT_NEAR(t.site.longitude_deg, -108.54, 1e-9);
    EXPECT_NEAR(t.site.elevation_m, 2133, 1e-9);
    EXPECT_EQ(t.site.wind_height_m, 2.0);
    EXPECT_NEAR(t[Field::Shortwave][1], 308, 1e-9);
    EXPECT_NEAR(t[Field::Direct][1], 230, 1e-9);
    EXPECT_NEAR(t[Field::Diffuse][1], 205, 1e-9);
    EXPECT_NEAR(t[Field::AirTemp][1], 273.65, 1e-9);
    EXPECT_NEAR(t[Field::DewPoint][1], 268.15, 1e-9);
    EXPECT_NEAR(t[Field::Pressure][1], 77000, 1e-6);
    EXPECT_NEAR(t[Field::RelHumidity][1], 60.15, 1e-9);
    EXPECT_NEAR(t[Field::WindFrom][1], 220.1, 1e-9);
    EXPECT_TRUE(std::isnan(t[Field::Wind][2]));
}

TEST(Nsrdb, TypicalYearsArePlacedInOneYear)
{
    std::string rows;
    for (const char* day : {"2004,2,28", "2004,2,29", "2011,3,1"}) {
        for (int hour = 0; hour < 24; ++hour)
            rows += std::string(day) + "," + std::to_string(hour) +
                    ",30,0,0,0,-5,0,2,180,60,1,770,,,\n";
    }
    const auto r = read_weather(kAbout + kNames + rows);
    EXPECT_EQ(r.table.rows(), 48u);
    EXPECT_EQ(r.table.time_us.back() - r.table.time_us.front(), 47 * 3600LL * 1000000);
    EXPECT_NE(to_text(r.report).find("typical year"), std::string::npos);
}

TEST(Nsrdb, WhatIsWrongIsNamed)
{
    try {
        read_weather(kAbout + "Month,Day,GHI\n1,1,0\n");
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("does not name Year"), std::string::npos) << e.what();
    }
    std::string rows;
    for (int hour = 0; hour < 24; ++hour)
        rows += "2017,1,1," + std::to_string(hour) + ",0,0,0,0,-5,0,2,180,60,1,770,,,\n";
    const auto r = read_weather(kAbout + kNames + rows +
                                "2017,2,30,0,0,0,0,0,-5,0,2,180,60,1,770\n" + "2017,1,2,0\n");
    EXPECT_EQ(r.report.bad_rows, 2u);
    EXPECT_EQ(r.table.rows(), 24u);
}

}  // namespace
}  // namespace petrichor::weather
