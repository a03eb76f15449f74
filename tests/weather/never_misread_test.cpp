// Weather files are never misread without a word: what is doubtful is an error or a note.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "tests/support/assets.h"
#include "tests/weather/archive_samples.h"
#include "weather/readers/tables.h"
#include "weather/text/utf16.h"

namespace petrichor::weather {
namespace {

using namespace archive_samples;
using testing::HasSubstr;
using testing::Not;

std::string refusal(const std::string& text, const ReadOptions& options = {})
{
    try {
        read_weather(text, options);
    } catch (const Error& error) {
        return std::string(error.what()) + " | " + error.fix();
    }
    return "read";
}

// Found by fuzzing: the mark was left out after the file was found not to be empty.
TEST(ReadWeather, AFileOfAByteOrderMarkAloneIsEmpty)
{
    for (const char* text : {"\xef\xbb\xbf", "\xef\xbb\xbf\n \n", ""}) {
        try {
            read_weather(text);
            FAIL() << "read";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("is empty"), std::string::npos)
                << error.what();
        }
    }
}

// Where the zone is taken from the longitude, no number of a damaged file becomes a time.
TEST(ReadWeather, ALongitudeBeyondTheGlobeIsRefused)
{
    for (const auto& [name, place] :
         {std::pair{"environment_canada.csv", "-75.67"}, std::pair{"lcd.csv", "-73.88"}}) {
        std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name);
        ASSERT_NE(text.find(place), std::string::npos) << name;
        for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += 8)
            text.replace(at, std::string(place).size(), "1.74e+200");
        EXPECT_THAT(refusal(text), HasSubstr("longitude 1.74e+200 is outside -180..360")) << name;
    }
}

TEST(NeverMisread, AColumnThatSpeaksOfWeatherIsUnderstoodOrAnError)
{
    const std::string text = "time,air_temp_c,snow_melt_rate\n2024-01-01T00:00,-1,3\n";
    EXPECT_THAT(refusal(text), testing::AllOf(HasSubstr("snow_melt_rate"), HasSubstr("--ignore")));
    ReadOptions options;
    options.ignore = {"snow_melt_rate"};
    EXPECT_EQ(refusal(text, options), "read");
    options.ignore = {"all"};
    EXPECT_EQ(refusal(text, options), "read");
    EXPECT_EQ(refusal("time,air_temp_c,battery_v\n2024-01-01T00:00,-1,12\n"), "read");
}

TEST(NeverMisread, UnitsThatNoNameSaysAreTold)
{
    const auto report = raw("time,temp,rh,wind_m_s,precip,solar_w_m2\n2024-01-01T00:00,1,80,3,0,0\n"
                            "2024-01-01T01:00,1,80,3,0,0\n")
                            .report;
    EXPECT_THAT(notes(report),
                HasSubstr("columns: their names say no unit: temp taken as C, precip taken as mm\n"));
    EXPECT_THAT(refusal("time,air_temp_c,solar\n2024-01-01T00:00,1,3\n"),
                HasSubstr("not understood: solar"));
}

TEST(NeverMisread, ABareSnowColumnIsAmbiguous)
{
    EXPECT_THAT(refusal("time,air_temp_c,snow\n2024-01-01T00:00,-1,30\n"),
                HasSubstr("snow_depth_cm"));
}

TEST(NeverMisread, APlaceThatDoesNotExistIsAnError)
{
    EXPECT_THAT(refusal("# latitude: 95\ntime,air_temp_c\n2024-01-01T00:00,-1\n"),
                testing::AllOf(HasSubstr("95"), HasSubstr("--latitude")));
}

// What a person gave is not blamed on the file.
TEST(NeverMisread, APlaceThatWasGivenAndDoesNotExistIsSaidToBe)
{
    ReadOptions options;
    options.site.latitude_deg = 95.0;
    EXPECT_THAT(refusal("time,air_temp_c\n2024-01-01T00:00,-1\n", options),
                testing::AllOf(HasSubstr("the latitude that was given, 95, is outside -90..90"),
                               HasSubstr("Mend --latitude."), Not(HasSubstr("file"))));
}

TEST(NeverMisread, AYearWithoutADropWasNotMeasured)
{
    std::string text = "time,air_temp_c,precip_mm,wind_m_s\n";
    for (int day = 0; day < 70; ++day) {
        const std::int64_t us = us_from_iso("2024-01-01").value() + day * 86400000000LL;
        text += iso_from_us(us) + ",5,0," + (day == 9 ? "3" : "2") + "\n";
    }
    const auto [table, report] = raw(text);
    EXPECT_FALSE(table.has(Field::Precip));
    EXPECT_TRUE(table.has(Field::Wind));
    EXPECT_THAT(notes(report), HasSubstr("nothing but 0 in 70 rows"));
}

TEST(NeverMisread, ThreeDaysOfNothingButZeroDegreesAreTold)
{
    const auto notes_of = [](const char* name, const char* second) {
        std::string text = "time," + std::string(name) + ",wind_m_s\n";
        for (int hour = 0; hour < 72; ++hour) {
            const std::int64_t us = us_from_iso("2024-01-01").value() + hour * 3600000000LL;
            text += iso_from_us(us) + "," + (hour == 1 ? second : "0") + ",2\n";
        }
        return notes(raw(text).report);
    };
    EXPECT_THAT(notes_of("air_temp_c", "0"), HasSubstr("nothing but 0 degrees in 72 rows"));
    EXPECT_THAT(notes_of("air_temp_f", "0"), HasSubstr("nothing but 0 degrees in 72 rows"));
    EXPECT_THAT(notes_of("air_temp_c", "0.1"), Not(HasSubstr("nothing but 0")));
}

TEST(NeverMisread, NoiseOfASensorIsOneLine)
{
    std::string text = "time,air_temp_c,snow_depth_m\n";
    for (int hour = 0; hour < 200; ++hour) {
        const std::int64_t us = us_from_iso("2024-01-01").value() + hour * 3600000000LL;
        text += iso_from_us(us) + ",5,-0.01\n";
    }
    const auto [table, report] = raw(text);
    EXPECT_EQ(table[Field::SnowDepth].front(), 0.0);
    EXPECT_EQ(report.notes.size(), 1u);
    EXPECT_THAT(notes(report), HasSubstr("200 values"));
}

TEST(NeverMisread, ARisingDepthTellsThatItSnowed)
{
    ReadOptions options;
    const auto read = read_weather(
        "time,air_temp_c,precip_mm,snow_depth_m\n2024-01-01T00:00,2.5,2,0.30\n"
        "2024-01-01T01:00,2.5,2,0.33\n2024-01-01T02:00,2.5,2,0.33\n2024-01-01T03:00,2.5,0,0.32\n",
        options);
    EXPECT_EQ(read.table[Field::SnowShare][0], 1.0);
    EXPECT_TRUE(std::isnan(read.table[Field::SnowShare][1]));
    EXPECT_TRUE(std::isnan(read.table[Field::SnowShare][2]));
}

TEST(NeverMisread, SmetObservationsAreKeptApart)
{
    const auto table =
        raw("SMET 1.1 ASCII\n[HEADER]\nstation_id = a\nlatitude = 46\nlongitude = 9\naltitude = "
            "1500\nnodata = -999\ntz = 1\nfields = timestamp TA TSS RSWR HS\n[DATA]\n"
            "2024-01-01T00:00 270 268 12 1.5\n")
            .table;
    EXPECT_EQ(table[Field::SurfaceTemp].front(), 268.0);
    EXPECT_EQ(table[Field::Reflected].front(), 12.0);
    EXPECT_EQ(table[Field::SnowDepth].front(), 1.5);
    EXPECT_EQ(table.site.utc_offset_h, 1.0);
}

TEST(NeverMisread, MetarPlacesAreNotGuessed)
{
    const auto read = raw("METAR EDDF 311850Z 24015KT 9999 BKN012 M01/M03 Q1013=\n");
    EXPECT_TRUE(std::isnan(read.table.site.latitude_deg));
    EXPECT_THAT(notes(read.report), HasSubstr("give latitude and longitude"));
}

TEST(NeverMisread, LocalTimesWithoutAZoneAreNoticed)
{
    std::string text = "# latitude: 43.2\n# longitude: -116.8\ntime,air_temp_c,sw_down_w_m2\n";
    for (int hour = 0; hour < 240; ++hour) {
        const std::int64_t us = us_from_iso("2024-06-01").value() + hour * 3600000000LL;
        const double sun = std::max(0.0, std::sin((hour % 24 - 6) * 3.14159 / 12.0));
        text += iso_from_us(us).substr(0, 16) + ",15," + std::to_string(900.0 * sun) + "\n";
    }
    EXPECT_THAT(notes(raw(text).report), HasSubstr("--file-zone -8"));
    ReadOptions options;
    options.utc_offset_h = -8.0;
    const auto moved = raw(text, options);
    EXPECT_EQ(iso_from_us(moved.table.time_us.front()), "2024-06-01T08:00:00Z");
    EXPECT_THAT(notes(moved.report), testing::Not(HasSubstr("--file-zone")));
    options.utc_offset_h = 4.0;
    EXPECT_THAT(notes(raw(text, options).report), HasSubstr("--file-zone -8"));
}

TEST(NeverMisread, FreshSnowOfADayTellsThePhase)
{
    const auto table =
        raw("STATION,DATE,LATITUDE,LONGITUDE,ELEVATION,NAME,PRCP,SNOW,SNWD,TMAX,TMIN\n"
            "US1,2024-01-01,45,-110,1000,X,100,100,120,20,-60\n"
            "US1,2024-01-02,45,-110,1000,X,100,0,90,80,10\n"
            "US1,2024-01-03,45,-110,1000,X,0,0,80,80,10\n")
            .table;
    EXPECT_EQ(table[Field::SnowShare].front(), 1.0);
    EXPECT_EQ(table[Field::SnowShare][8], 0.0);
    EXPECT_TRUE(std::isnan(table[Field::SnowShare][16]));
    EXPECT_NEAR(table[Field::SnowDepth].front(), 0.12, 1e-12);
}

namespace {

// Denver's typical year with one column of its rows, and its longitude, changed.
std::string denver_with(const std::filesystem::path& assets, std::size_t column, const char* value,
                        const char* longitude = "-104.65")
{
    std::istringstream in(text_of(assets / "weather/USA_CO_Denver.Intl.AP.725650_TMY3.epw"));
    std::string text, line;
    for (int n = 0; std::getline(in, line); ++n) {
        const auto columns = split(line, ',');
        if (n == 0 || (n >= 8 && columns.size() > 34)) {
            const std::size_t at = n == 0 ? 7 : column;
            std::string changed;
            for (std::size_t i = 0; i < columns.size(); ++i)
                changed.append(i ? "," : "").append(i != at  ? std::string(columns[i])
                                                    : n == 0 ? longitude
                                                             : value);
            line = changed;
        }
        text += line + "\n";
    }
    return text;
}

}  // namespace

TEST(NeverMisread, AnEpwWithoutPrecipitationSaysSoAndItCanBeEstimated)
{
    NEED_ASSETS(assets);
    const std::string text = denver_with(assets, 33, "0");
    ReadOptions options;
    const auto dry = read_weather(text, options);
    EXPECT_THAT(notes(dry.report), testing::AllOf(HasSubstr("taken as not measured"),
                                                  HasSubstr("no precipitation in the file")));
    options.filling.missing_precip = MissingPrecip::Estimate;
    EXPECT_GT(total(read_weather(text, options).table, Field::Precip), 50.0);
}

// Empty cells of an EPW are missing, as its nines are.
TEST(NeverMisread, EmptyCellsOfAnEpwAreMissing)
{
    NEED_ASSETS(assets);
    for (const auto& [column, nines] : {std::pair{33, "999"}, {22, "99"}}) {
        const auto at = static_cast<std::size_t>(column);
        const auto empty = raw(denver_with(assets, at, ""));
        const auto coded = raw(denver_with(assets, at, nines));
        EXPECT_EQ(notes(empty.report), notes(coded.report));
        for (std::size_t f = 0; f < kFieldCount; ++f) {
            const auto& a = empty.table.columns[f];
            EXPECT_TRUE(std::ranges::equal(a, coded.table.columns[f], [](double x, double y) {
                return x == y || (std::isnan(x) && std::isnan(y));
            })) << f;
        }
    }
}

// No snow in a winter with frost is a column that nobody filled in; none in a summer was measured.
TEST(NeverMisread, AWinterWithoutAnyDepthWasNotMeasured)
{
    const auto read = [](const char* air_c, const char* last_depth) {
        std::string text = "time,air_temp_c,snow_depth_m\n";
        for (int day = 0; day < 70; ++day) {
            const std::int64_t us = us_from_iso("2024-01-01").value() + day * 86400000000LL;
            text += iso_from_us(us) + "," + (day < 20 ? air_c : "3") + "," +
                    (day == 69 ? last_depth : "0") + "\n";
        }
        return raw(text);
    };
    const auto frost = read("-5", "0");
    EXPECT_FALSE(frost.table.has(Field::SnowDepth));
    EXPECT_THAT(notes(frost.report), HasSubstr("nothing but 0 in 70 rows with 20 days of frost"));
    EXPECT_TRUE(read("5", "0").table.has(Field::SnowDepth));
    EXPECT_TRUE(read("-5", "0.01").table.has(Field::SnowDepth));

    NEED_ASSETS(assets);
    const auto denver = raw(denver_with(assets, 30, "0"));
    EXPECT_FALSE(denver.table.has(Field::SnowDepth));
    EXPECT_THAT(notes(denver.report), HasSubstr("snow_depth: nothing but 0 in 8760 rows"));
}

// The sun of a typical year stands over its place, too.
TEST(NeverMisread, ATypicalYearOfAnotherLongitudeIsNoticed)
{
    NEED_ASSETS(assets);
    EXPECT_THAT(notes(raw(denver_with(assets, 34, "1")).report), Not(HasSubstr("the sun of the file")));
    EXPECT_THAT(notes(raw(denver_with(assets, 34, "1", "0")).report),
                HasSubstr("the zone that its times say, or its place, is wrong"));
}

// A misspelt column is never dropped without a word: in every sample with a header, each name with
// a letter too many is an error, is named in the report, or changes nothing that is read.
TEST(Archives, NoMisspeltColumnIsDroppedInSilence)
{
    int changed = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_SAMPLES)) {
        const std::string file = entry.path().filename().string();
        const std::string text = text_of(entry.path());
        std::size_t begin = 0, end = 0;
        char separator = 0;
        // The header: the first line of at least four names.
        for (int line = 0; line < 40 && end != text.npos && !separator; ++line) {
            begin = line == 0 ? 0 : end + 1;
            end = text.find('\n', begin);
            const std::string one = text.substr(begin, end - begin);
            for (const char c : {',', ';', '|', '\t'}) {
                const auto fields = split(one, c);
                const auto names =
                    std::count_if(fields.begin(), fields.end(), [](std::string_view f) {
                        return !to_number(f) &&
                               std::count_if(f.begin(), f.end(), [](char x) {
                                   return std::isalpha(static_cast<unsigned char>(x)) != 0;
                               }) >= 2;
                    });
                if (names >= 4 && fields.size() >= 4) separator = c;
            }
        }
        if (!separator || file.ends_with(".epw") || file.ends_with(".json")) continue;
        ReadResult plain;
        ReadOptions options;
        options.fill = false;
        try {
            plain = read_weather(text, options);
        } catch (const Error&) {
            continue;  // no weather by itself
        }
        const std::string header = text.substr(begin, end - begin);
        std::size_t at = 0;
        while (at < header.size()) {
            std::size_t stop = std::min(header.find(separator, at), header.size());
            std::size_t letters = at;
            while (letters < stop && (std::isalnum(static_cast<unsigned char>(header[letters])) ||
                                      header[letters] == '_' || header[letters] == '"'))
                ++letters;
            const std::string name = header.substr(at, letters - at);
            if (letters - at >= 3 && name.find('"') == name.npos) {
                std::string other = text;
                other.insert(begin + letters, "q");
                try {
                    const ReadResult read = read_weather(other, options);
                    bool same = read.table.time_us == plain.table.time_us;
                    for (std::size_t c = 0; c < kFieldCount && same; ++c) {
                        const auto &a = read.table.columns[c], &b = plain.table.columns[c];
                        same = a.size() == b.size() &&
                               std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
                                   return x == y || (std::isnan(x) && std::isnan(y));
                               });
                    }
                    if (!same) {
                        ++changed;
                        // By its new name, by that of the column whose unit it told, or as the
                        // clock's zone that nobody tells any more.
                        const std::string said = lower(to_text(read.report));
                        const std::size_t unread = said.find("not read:");
                        EXPECT_TRUE(
                            said.find(lower(name) + "q") != said.npos ||
                            said.find("zone") != said.npos ||
                            (unread != said.npos && said.find(lower(name), unread) != said.npos))
                            << file << ": " << name;
                    }
                } catch (const Error&) {
                }
            }
            at = stop + 1;
        }
    }
    EXPECT_GT(changed, 20);
}

// Flags belong to their column by its name, wherever they stand.
TEST(GhcnTables, FlagsAreFoundByName)
{
    const std::string usual =
        "\"STATION\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\",\"TMAX\","
        "\"TMAX_ATTRIBUTES\",\"TMIN\"\n"
        "\"ZZ1\",\"2021-01-14\",\"46.8\",\"9.8\",\"1560\",\"  400\",\",X,E\",\" -105\"\n"
        "\"ZZ1\",\"2021-01-15\",\"46.8\",\"9.8\",\"1560\",\" -31\",\"T,,E\",\" -142\"\n";
    const std::string moved =
        "\"TMAX\",\"STATION\",\"TMIN\",\"DATE\",\"LATITUDE\",\"LONGITUDE\",\"ELEVATION\","
        "\"TMAX_ATTRIBUTES\"\n"
        "\"  400\",\"ZZ1\",\" -105\",\"2021-01-14\",\"46.8\",\"9.8\",\"1560\",\",X,E\"\n"
        "\" -31\",\"ZZ1\",\" -142\",\"2021-01-15\",\"46.8\",\"9.8\",\"1560\",\"T,,E\"\n";
    const ForcingTable a = raw(usual).table, b = raw(moved).table;
    ASSERT_EQ(a.time_us, b.time_us);
    for (std::size_t i = 0; i < a.rows(); ++i) {
        const double was = a[Field::AirTemp][i], is = b[Field::AirTemp][i];
        EXPECT_TRUE(was == is || (std::isnan(was) && std::isnan(is))) << i;
        EXPECT_FALSE(is > 300.0) << "40 C failed its check";
    }
}

// What an editor or a mail program does to a text changes nothing that is read from it.
TEST(EverySample, ReadsTheSameWithOtherEndsOfLinesAndEmptyOnesAround)
{
    const auto answer = [](const std::string& text) {
        ReadOptions options;
        options.ignore = {"all"};
        options.fill = false;
        std::string out;
        try {
            const ReadResult r = read_weather(text, options);
            for (std::size_t i = 0; i < r.table.rows(); ++i) {
                out += iso_from_us(r.table.time_us[i]);
                for (const auto& column : r.table.columns)
                    out += column.empty() ? "," : "," + std::to_string(column[i]);
                out += "\n";
            }
            const Site& at = r.table.site;
            for (const double v : {at.latitude_deg, at.longitude_deg, at.elevation_m,
                                   at.temp_height_m, at.wind_height_m, at.utc_offset_h})
                out += " " + std::to_string(v);
        } catch (const Error&) {
            return std::string();
        }
        return out;
    };
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_SAMPLES)) {
        const std::string bytes = text_of(entry.path());
        const bool wide = is_utf16(bytes) && bytes.size() % 2 == 0;
        const std::string text = wide ? utf8_of_utf16(bytes) : bytes;
        const std::string as_it_is = answer(bytes);
        if (as_it_is.empty()) continue;  // seeds of the fuzzer that are no weather
        ++read;
        std::string crlf;
        for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
        const std::string mark = "\xEF\xBB\xBF";
        const bool marked = text.rfind(mark, 0) == 0;
        for (const std::string& other :
             {text, marked ? text : mark + text, text.find('\r') == std::string::npos ? crlf : text,
              "\n\n" + (marked ? text.substr(3) : text), "\r\n" + (marked ? text.substr(3) : text),
              text + "\n\n"})
            EXPECT_EQ(answer(other), as_it_is) << entry.path().filename();
    }
    EXPECT_GE(read, 40);
}

// Saved by a spreadsheet of a country with decimal commas, or with tabs: the same.
TEST(EverySample, OfCommasReadsTheSameWithASpreadsheetsSeparators)
{
    int read = 0;
    for (const char* name : {"typical_year.epw", "typical_year_tmy3.csv", "nsrdb.csv", "pvgis.csv",
                             "midc.csv", "open_meteo.csv", "noaa_global_hourly.csv", "lcd.csv",
                             "environment_canada.csv", "meteostat.csv", "openweather.csv",
                             "nasa_power.csv", "fluxnet_hh.csv", "gsod.csv"}) {
        const std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name);
        ReadOptions options;
        options.ignore = {"all"};
        const ReadResult want = raw(text, options);
        for (const char separator : {';', '\t'}) {
            std::string other;
            Lines lines(text);
            while (const auto line = lines.next()) {
                std::size_t cells = 0;
                for (const std::string_view cell : split(*line, ',', 4096)) {
                    if (cells++) other += separator;
                    const bool number =
                        separator == ';' && to_number(cell) && cell.find('.') != cell.npos;
                    std::string put(cell);
                    if (number) std::replace(put.begin(), put.end(), '.', ',');
                    other += put;
                }
                other += '\n';
            }
            const ReadResult got = raw(other, options);
            EXPECT_EQ(got.report.format, want.report.format) << name;
            EXPECT_EQ(got.table.time_us, want.table.time_us) << name;
            EXPECT_THAT(to_text(got.report), HasSubstr("as a spreadsheet saves them")) << name;
            for (std::size_t f = 0; f < kFieldCount; ++f) {
                const auto &a = got.table.columns[f], &b = want.table.columns[f];
                EXPECT_TRUE(a.size() == b.size() &&
                            std::equal(a.begin(), a.end(), b.begin(),
                                       [](double x, double y) {
                                           return x == y || (std::isnan(x) && std::isnan(y));
                                       }))
                    << name << " " << field_info(static_cast<Field>(f)).name;
            }
            ++read;
        }
    }
    EXPECT_EQ(read, 28);
    EXPECT_EQ(sample("dwd_temperature.txt").report.format, "DWD") << "whose cells are apart so";
}

TEST(Pvgis, AStrayLineDoesNotEndTheTable)
{
    std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "pvgis.csv");
    const std::size_t rows = raw(text).table.rows();
    const std::size_t third = text.find("20", text.find("time(UTC)"));
    text.insert(text.find('\n', text.find('\n', third) + 1) + 1, "hello world\n\n");
    const auto r = raw(text);
    EXPECT_EQ(r.table.rows(), rows);
    EXPECT_EQ(r.report.bad_rows, 1u);
}

TEST(Tmy3, APlaceWithoutItsZoneIsTold)
{
    std::string text = text_of(std::filesystem::path(PETRICHOR_SAMPLES) / "typical_year_tmy3.csv");
    const auto whole = raw(text);
    EXPECT_EQ(whole.table.site.utc_offset_h, -6.0);
    const std::size_t end = text.find_first_of("\r\n"), elevation = text.rfind(',', end);
    std::string cut = text;
    cut.erase(elevation, end - elevation);
    const auto without = raw(cut);
    EXPECT_EQ(without.table.time_us, whole.table.time_us) << "its zone is still there";
    EXPECT_TRUE(std::isnan(without.table.site.elevation_m));
    std::string none = text;
    none.replace(none.find(",-6.0,"), 6, ",,");
    EXPECT_THAT(to_text(raw(none).report),
                HasSubstr("warning line 1 time: the line of the place names no time zone"));
}

TEST(Metro, NumbersAreReadOrRefusedAndNoAmountIsLost)
{
    const auto forecast = [](const std::string& second) {
        return "<?xml version=\"1.0\"?><forecast><header/><prediction-list>"
               "<prediction><forecast-time>2005-02-24T21:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>0</ra><sn>0</sn>"
               "<ws>8</ws><ap>1014</ap><cc>0</cc></prediction>"
               "<prediction><forecast-time>2005-02-24T22:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>" +
               second +
               "</ra><sn>0</sn><ws>8</ws><ap>1014</ap><cc>0</cc></prediction>"
               "<prediction><forecast-time>2005-02-24T23:00Z</forecast-time><at>-5.5</at><td>-9</"
               "td><ra>2</ra><sn>0</sn>"
               "<ws>8</ws><ap>1014</ap><cc>0</cc></prediction></prediction-list></forecast>";
    };
    const auto point = raw(forecast("0.5")).table, comma = raw(forecast("0,5")).table;
    EXPECT_EQ(point[Field::Rain], comma[Field::Rain]);
    EXPECT_NEAR(point[Field::Rain][0] * 3600.0, 0.5, 1e-9);
    const auto none = raw(forecast("")).table;
    EXPECT_NEAR(none[Field::Rain][0] * 3600.0, 1.0, 1e-9) << "2 mm in two hours";
    EXPECT_NEAR(none[Field::Rain][1] * 3600.0, 1.0, 1e-9);
    EXPECT_THROW(raw(forecast("much")), Error);
}

// What people give in place of weather is known by its content, and said where it belongs.
TEST(NoWeather, SaysWhereItBelongs)
{
    const auto refusal = [](const std::string& text) {
        try {
            read_weather(text);
        } catch (const Error& e) {
            return std::string(e.what()) + " " + e.fix();
        }
        return std::string();
    };
    EXPECT_THAT(refusal("date,snow_depth_m\n1998-10-01,0.1\n"),
                testing::AllOf(HasSubstr("has observations alone"), HasSubstr("--observed")));
    EXPECT_EQ(raw("date,snow_depth_m\n1998-10-01,0.1\n").report.rows, 1u)
        << "to be joined with weather";
    EXPECT_THAT(refusal("date,snow_depth_m,swe_kg_m2,snow_albedo\n1998-10-01,0.1,20,0.8\n"),
                testing::AllOf(HasSubstr("has observations alone"), HasSubstr("--observed")));
    EXPECT_THAT(refusal("2005  10   1    0.17    1.20    0.00    0.00    8.01   10.10\n"),
                HasSubstr("--observed"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<station><header/></station>\n"),
                HasSubstr("--road"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<roadcast><header/></roadcast>\n"),
                HasSubstr("result of METRo"));
    EXPECT_THAT(refusal("<!DOCTYPE html><html>404</html>"), HasSubstr("a web page"));
    EXPECT_THAT(
        refusal("time,air_temp_c,snow_albedo\n1998-10-01,0.1,0.8\n"),
        testing::AllOf(HasSubstr("not understood: snow_albedo"), Not(HasSubstr("--observed"))));
}

}  // namespace
}  // namespace petrichor::weather
