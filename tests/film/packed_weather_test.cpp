// Packed weather files, made here with the libraries that read them: archives, NetCDF as the
// services and models write it, GRIB.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "base/error.h"
#include "film/weather/inputs.h"
#include "film/weather/weather_input.h"
#include "tests/support/assets.h"
#include "weather/readers/text.h"
#ifdef PETRICHOR_NETCDF
#include <netcdf.h>
#endif
#ifdef PETRICHOR_GRIB
#include <eccodes.h>
#endif

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using weather::Field;

class Folder {
public:
    Folder()
    {
        path_ = fs::temp_directory_path() / ("petrichor-packed-" + std::to_string(::getpid()));
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    std::string file(const char* name) const { return (path_ / name).string(); }

private:
    fs::path path_;
};

const std::string kCsv =
    "# latitude: 45\n# longitude: 5\ntime,air_temp_c,precip_mm\n2024-01-01T00:00,-1,0.5\n"
    "2024-01-01T01:00,-2,0.5\n2024-01-01T02:00,-3,0\n";

void write(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}
std::string gzipped(const std::string& text, int wrapping = 15 + 16)
{
    z_stream s{};
    EXPECT_EQ(deflateInit2(&s, 1, Z_DEFLATED, wrapping, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(text.size() + 1000, '\0');
    s.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    s.avail_in = static_cast<uInt>(text.size());
    s.next_out = reinterpret_cast<Bytef*>(out.data());
    s.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&s, Z_FINISH), Z_STREAM_END);
    out.resize(s.total_out);
    deflateEnd(&s);
    return out;
}
std::string little(std::size_t value, int bytes)
{
    std::string out;
    for (int i = 0; i < bytes; ++i, value >>= 8) out += static_cast<char>(value & 255u);
    return out;
}
std::string zipped(const std::vector<std::pair<std::string, std::string>>& files)
{
    std::string out, directory;
    for (const auto& [name, text] : files) {
        const std::string body = gzipped(text, -15);
        const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size());
        const std::string common = little(20, 2) + little(0, 2) + little(8, 2) + little(0, 4) +
                                   little(sum, 4) + little(body.size(), 4) +
                                   little(text.size(), 4) + little(name.size(), 2) + little(0, 2);
        directory += "PK\x01\x02" + little(20, 2) + common + little(0, 2) + little(0, 2) +
                     little(0, 2) + little(0, 4) + little(out.size(), 4) + name;
        out += "PK\x03\x04" + common + name + body;
    }
    const std::size_t at = out.size();
    return out + directory + std::string("PK\x05\x06", 4) + little(0, 4) + little(files.size(), 2) +
           little(files.size(), 2) + little(directory.size(), 4) + little(at, 4) + little(0, 2);
}

weather::ReadResult read(const std::string& path, const GridPlace& place = {})
{
    SiteOptions site;
    site.latitude_deg = place.latitude_deg;
    site.longitude_deg = place.longitude_deg;
    return read_forcing(read_inputs({path}, place), site);
}
std::string refusal(const std::string& path, const GridPlace& place = {})
{
    try {
        read(path, place);
    } catch (const Error& error) {
        return std::string(error.what()) + " | " + error.fix();
    }
    return "read";
}
TEST(Packed, GzipAndZipOfText)
{
    const Folder folder;
    write(folder.file("a.csv.gz"), gzipped(kCsv));
    EXPECT_NEAR(read(folder.file("a.csv.gz")).table[Field::AirTemp].front(), 272.15, 1e-9);
    write(folder.file("a.zip"), zipped({{"a.csv", kCsv}}));
    EXPECT_NEAR(read(folder.file("a.zip")).table[Field::AirTemp].front(), 272.15, 1e-9);
    write(folder.file("b.zip"), zipped({{"about.html", "<html>"}, {"a.csv", kCsv}}));
    std::vector<std::string> notes;
    const auto inputs = read_inputs({folder.file("b.zip")}, {}, &notes);
    ASSERT_EQ(inputs.size(), 1u);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_THAT(notes.front(), HasSubstr("about.html"));
    write(folder.file("c.zip"), zipped({{"a.csv.gz", gzipped(kCsv)}}));
    EXPECT_NEAR(read(folder.file("c.zip")).table[Field::AirTemp].front(), 272.15, 1e-9);
}

TEST(Packed, DamagedArchivesAreRefusedWithWords)
{
    const Folder folder;
    const std::string zip = zipped({{"a.csv", kCsv}}), gz = gzipped(kCsv);
    write(folder.file("none.zip"), zipped({}));
    EXPECT_THAT(refusal(folder.file("none.zip")), HasSubstr("zip archive is empty"));
    for (std::size_t cut = 5; cut < zip.size(); cut += 13) {
        write(folder.file("x"), zip.substr(0, cut));
        EXPECT_THAT(refusal(folder.file("x")), HasSubstr("zip")) << cut;
    }
    for (std::size_t cut = 11; cut + 8 < gz.size(); cut += 13) {
        write(folder.file("x"), gz.substr(0, cut));
        EXPECT_THAT(refusal(folder.file("x")), HasSubstr("gzip")) << cut;
    }
    // 300 MB of text in a file of 300 kB.
    write(folder.file("bomb.gz"), gzipped(std::string(300u << 20, 'a')));
    EXPECT_NE(refusal(folder.file("bomb.gz")), "read");
}

#ifdef PETRICHOR_NETCDF

// A file of ERA5: hours, two latitudes, two longitudes; a variable is a function of hour, row and
// column.
struct NetCdf {
    int id = -1, time = -1, lat = -1, lon = -1;
    std::size_t hours;

    NetCdf(const std::string& path, std::size_t n, const char* clock = "valid_time",
           const char* units = "seconds since 1970-01-01", double first = 1704067200.0,
           double step = 3600.0, int format = NC_NETCDF4)
        : hours(n)
    {
        nc_create(path.c_str(), NC_CLOBBER | format, &id);
        nc_def_dim(id, clock, n, &time);
        nc_def_dim(id, "latitude", 2, &lat);
        nc_def_dim(id, "longitude", 2, &lon);
        const auto axis = [&](const char* name, int dim, const char* unit,
                              const std::vector<double>& values) {
            int v = -1;
            nc_redef(id);
            nc_def_var(id, name, NC_DOUBLE, 1, &dim, &v);
            nc_put_att_text(id, v, "units", std::strlen(unit), unit);
            nc_enddef(id);
            nc_put_var_double(id, v, values.data());
        };
        std::vector<double> times;
        for (std::size_t i = 0; i < n; ++i) times.push_back(first + step * static_cast<double>(i));
        nc_enddef(id);
        axis(clock, time, units, times);
        axis("latitude", lat, "degrees_north", {46.0, 45.0});
        axis("longitude", lon, "degrees_east", {5.0, 6.0});
    }
    void variable(const char* name, const char* units,
                  const std::function<double(std::size_t, int, int)>& f)
    {
        int v = -1;
        const int dims[] = {time, lat, lon};
        nc_redef(id);
        nc_def_var(id, name, NC_FLOAT, 3, dims, &v);
        nc_put_att_text(id, v, "units", std::strlen(units), units);
        const float fill = -32767.0f;
        nc_put_att_float(id, v, "_FillValue", NC_FLOAT, 1, &fill);
        nc_enddef(id);
        std::vector<double> values;
        for (std::size_t t = 0; t < hours; ++t) {
            for (int i = 0; i < 2; ++i) {
                for (int j = 0; j < 2; ++j) {
                    const double x = f(t, i, j);
                    values.push_back(std::isnan(x) ? -32767.0 : x);
                }
            }
        }
        nc_put_var_double(id, v, values.data());
    }
    ~NetCdf() { nc_close(id); }
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void era5_state(NetCdf& file)
{
    file.variable("t2m", "K", [](std::size_t t, int i, int j) {
        return 270.0 + 0.1 * static_cast<double>(t % 48) + i + 2.0 * j;
    });
    file.variable("d2m", "K", [](std::size_t, int, int) { return 268.0; });
    file.variable("u10", "m s**-1", [](std::size_t, int, int) { return 3.0; });
    file.variable("v10", "m s**-1", [](std::size_t, int, int) { return -4.0; });
    file.variable("sp", "Pa", [](std::size_t, int, int) { return 90000.0; });
}

TEST(NetCdfWeather, Era5AtAPoint)
{
    const Folder folder;
    const std::string path = folder.file("era5.nc");
    {
        NetCdf file(path, 48);
        era5_state(file);
        file.variable("ssrd", "J m**-2", [](std::size_t t, int, int) {
            return t % 24 == 12 ? 3.6e6 : t % 24 == 13 ? 1.8e6 : 0.0;
        });
        file.variable("tp", "m", [](std::size_t t, int, int) { return t == 5 ? 0.002 : 0.0; });
        file.variable("cape", "J kg**-1", [](std::size_t, int, int) { return 1.0; });
    }
    const GridPlace middle{45.5, 5.5, false};
    const auto [table, report] = read(path, middle);
    EXPECT_EQ(report.format, "NetCDF");
    EXPECT_EQ(report.rows, 48u);
    EXPECT_NEAR(table[Field::AirTemp][0], 271.5, 1e-4) << "the mean of the four points";
    EXPECT_NEAR(table[Field::Wind][0], 5.0, 1e-5);
    EXPECT_NEAR(table[Field::WindFrom][0], 323.13, 0.01) << "from the north-west";
    EXPECT_NEAR(table[Field::Precip][4] * 3600.0, 2.0, 1e-4) << "the hour that ends at 5";
    EXPECT_EQ(table[Field::Precip][5], 0.0);
    EXPECT_NEAR(table[Field::Shortwave][12], 750.0, 1e-3) << "between 1000 and 500 W/m2";
    EXPECT_THAT(weather::to_text(report), HasSubstr("not read: cape"));
    EXPECT_NEAR(read(path, {46.0, 6.0, false}).table[Field::AirTemp][0], 272.0, 1e-4);
    EXPECT_NEAR(read(path, {45.2, 5.3, true}).table[Field::AirTemp][0], 271.0, 1e-4) << "nearest";
    EXPECT_NEAR(read(path, {45.5, 365.5 - 360.0, false}).table[Field::AirTemp][0], 271.5, 1e-4);
}

TEST(NetCdfWeather, AGridWantsAPlaceInsideIt)
{
    const Folder folder;
    const std::string path = folder.file("era5.nc");
    {
        NetCdf file(path, 24);
        era5_state(file);
    }
    EXPECT_THAT(refusal(path), testing::AllOf(HasSubstr("--latitude"), HasSubstr("45 to 46 N")));
    EXPECT_THAT(refusal(path, {50.0, 5.5, false}), HasSubstr("outside"));
}

TEST(NetCdfWeather, Era5LandAddsUpThroughTheDay)
{
    const Folder folder;
    const std::string path = folder.file("land.nc");
    {
        NetCdf file(path, 49);
        era5_state(file);
        // 100 W/m2 all day: 3.6e5 J/m2 an hour since midnight; the value at 00 is the whole day.
        file.variable("strd", "J m**-2", [](std::size_t t, int, int) {
            return 3.6e5 * static_cast<double>(t % 24 == 0 ? 24 : t % 24);
        });
        file.variable("tp", "m", [](std::size_t t, int, int) {
            const auto hour = t % 24 == 0 && t > 0 ? 24 : t % 24;
            return hour >= 3 ? 0.001 : 0.0;  // 1 mm between 2 and 3 o'clock
        });
    }
    const auto [table, report] = read(path, {45.5, 5.5, false});
    for (const std::size_t i : {2u, 10u, 23u, 24u, 30u})
        EXPECT_NEAR(table[Field::Longwave][i], 100.0, 0.1) << i;
    EXPECT_NEAR(table[Field::Precip][2] * 3600.0, 1.0, 1e-3);
    EXPECT_NEAR(table[Field::Precip][3], 0.0, 1e-9);
    EXPECT_THAT(weather::to_text(report), HasSubstr("adds up through the day"));
}

TEST(NetCdfWeather, TwoExperimentsOfEra5)
{
    const Folder folder;
    const std::string path = folder.file("expver.nc");
    {
        int id, time, version, v, t;
        nc_create(path.c_str(), NC_CLOBBER, &id);
        nc_def_dim(id, "time", 3, &time);
        nc_def_dim(id, "expver", 2, &version);
        nc_def_var(id, "time", NC_INT, 1, &time, &t);
        nc_put_att_text(id, t, "units", 32, "hours since 1900-01-01 00:00:00.0");
        const int dims[] = {time, version};
        nc_def_var(id, "t2m", NC_SHORT, 2, dims, &v);
        const double scale = 0.01, offset = 270.0;
        const short fill = -32767;
        nc_put_att_double(id, v, "scale_factor", NC_DOUBLE, 1, &scale);
        nc_put_att_double(id, v, "add_offset", NC_DOUBLE, 1, &offset);
        nc_put_att_short(id, v, "_FillValue", NC_SHORT, 1, &fill);
        nc_put_att_text(id, v, "units", 1, "K");
        nc_enddef(id);
        const int times[] = {1086960, 1086961, 1086962};  // 2024-01-01
        const short values[] = {100, -32767, 200, -32767, -32767, 300};
        nc_put_var_int(id, t, times);
        nc_put_var_short(id, v, values);
        nc_close(id);
    }
    const auto table = read(path, {45.0, 5.0, false}).table;
    EXPECT_EQ(weather::iso_from_us(table.time_us.front()), "2024-01-01T00:00:00Z");
    EXPECT_NEAR(table[Field::AirTemp][0], 271.0, 1e-4);
    EXPECT_NEAR(table[Field::AirTemp][2], 273.0, 1e-4);
}

TEST(NetCdfWeather, WhatTheServiceSendsIsAZipOfTwoFiles)
{
    const Folder folder;
    const auto bytes_of = [](const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    {
        NetCdf state(folder.file("instant.nc"), 24);
        era5_state(state);
        NetCdf sums(folder.file("accum.nc"), 24);
        sums.variable("tp", "m", [](std::size_t t, int, int) { return t == 5 ? 0.002 : 0.0; });
    }
    write(folder.file("download.zip"),
          zipped({{"data_stream-oper_stepType-instant.nc", bytes_of(folder.file("instant.nc"))},
                  {"data_stream-oper_stepType-accum.nc", bytes_of(folder.file("accum.nc"))}}));
    const auto table = read(folder.file("download.zip"), {45.5, 5.5, false}).table;
    EXPECT_EQ(table.rows(), 24u);
    EXPECT_NEAR(table[Field::Precip][4] * 3600.0, 2.0, 1e-4);
    EXPECT_NEAR(table[Field::AirTemp][4], 271.9, 1e-4);
}

TEST(NetCdfWeather, WrfSurfaceFields)
{
    const Folder folder;
    const std::string path = folder.file("wrfout.nc");
    {
        int id, time, chars, y, x, times, lat, lon, t2, q2, rain, ps;
        nc_create(path.c_str(), NC_CLOBBER, &id);
        nc_def_dim(id, "Time", 3, &time);
        nc_def_dim(id, "DateStrLen", 19, &chars);
        nc_def_dim(id, "south_north", 2, &y);
        nc_def_dim(id, "west_east", 2, &x);
        const int when[] = {time, chars}, field[] = {time, y, x};
        nc_def_var(id, "Times", NC_CHAR, 2, when, &times);
        const auto def = [&](const char* name, const char* units) {
            int v;
            nc_def_var(id, name, NC_FLOAT, 3, field, &v);
            nc_put_att_text(id, v, "units", std::strlen(units), units);
            return v;
        };
        lat = def("XLAT", "degree_north");
        lon = def("XLONG", "degree_east");
        t2 = def("T2", "K");
        q2 = def("Q2", "kg kg-1");
        ps = def("PSFC", "Pa");
        rain = def("RAINNC", "mm");
        nc_enddef(id);
        nc_put_var_text(id, times, "2024-01-16_00:00:002024-01-16_01:00:002024-01-16_02:00:00");
        const auto put = [&](int v, const std::function<double(int, int)>& f) {
            std::vector<double> values;
            for (int t = 0; t < 3; ++t)
                for (int k = 0; k < 4; ++k) values.push_back(f(t, k));
            nc_put_var_double(id, v, values.data());
        };
        put(lat, [](int, int k) { return 45.0 + 0.1 * (k / 2); });
        put(lon, [](int, int k) { return 5.0 + 0.1 * (k % 2); });
        put(t2, [](int, int k) { return 280.0 + k; });
        put(q2, [](int, int) { return 0.004; });
        put(ps, [](int, int) { return 90000.0; });
        put(rain, [](int t, int) { return 1.5 * t; });
        nc_close(id);
    }
    const auto [table, report] = read(path, {45.09, 5.01, false});
    EXPECT_NEAR(table[Field::AirTemp][0], 282.0, 1e-4);
    EXPECT_NEAR(table[Field::RelHumidity][0], 51.0, 3.0);
    EXPECT_EQ(weather::iso_from_us(table.time_us[1]), "2024-01-16T01:00:00Z");
}

TEST(NetCdfWeather, AYearOfEra5AtAPointIsQuick)
{
    const Folder folder;
    const std::string path = folder.file("year.nc");
    {
        NetCdf file(path, 8760);
        era5_state(file);
        for (const char* name : {"ssrd", "strd"})
            file.variable(name, "J m**-2",
                          [](std::size_t t, int, int) { return t % 24 ? 1e6 : 0; });
        file.variable("tp", "m", [](std::size_t, int, int) { return 1e-4; });
    }
    const auto inputs = read_inputs({path}, {45.5, 5.5, false});
    const auto begin = std::chrono::steady_clock::now();
    SiteOptions site;
    site.latitude_deg = 45.5;
    site.longitude_deg = 5.5;
    const auto table = read_forcing(inputs, site).table;
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(table.rows(), 8760u);
    RecordProperty("milliseconds", std::to_string(ms));
}

TEST(NetCdfWeather, ARealFile)
{
    NEED_ASSETS(assets);
    const auto [table, report] =
        read(assets.string() + "/weather/real_files/summa_forcing_2005_06.nc");
    EXPECT_EQ(report.rows, 8784u);
    EXPECT_NEAR(table.site.latitude_deg, 43.2, 0.1);
    EXPECT_NEAR(table[Field::AirTemp].front(), 280.86, 0.01);
    EXPECT_NEAR(table[Field::RelHumidity].front(), 47.3, 0.1);
    double total = 0.0;
    for (const double rate : table[Field::Precip]) total += rate * 3600.0;
    EXPECT_GT(total, 300.0);
    EXPECT_LT(total, 1500.0);
}

TEST(NetCdfWeather, DamagedFilesAreRefused)
{
    const Folder folder;
    for (const int format : {0, int(NC_NETCDF4)}) {
        const std::string path = folder.file("whole.nc");
        {
            NetCdf file(path, 24, "time", "hours since 2024-01-01", 0.0, 1.0, format);
            era5_state(file);
        }
        std::ifstream in(path, std::ios::binary);
        const std::string whole(std::istreambuf_iterator<char>(in), {});
        for (std::size_t cut = 8; cut < whole.size(); cut += whole.size() / 7) {
            write(folder.file("cut.nc"), whole.substr(0, cut));
            EXPECT_NE(refusal(folder.file("cut.nc"), {45.5, 5.5, false}), "read") << cut;
        }
    }
}

#endif

#ifdef PETRICHOR_GRIB

// A message on a grid of 3 x 3 from 46 N 5 E, one degree apart, whose values are given.
std::string message(const char* sample, const std::vector<std::pair<const char*, long>>& keys,
                    const std::function<double(int)>& f)
{
    codes_handle* h = codes_grib_handle_new_from_samples(nullptr, sample);
    EXPECT_NE(h, nullptr);
    for (const auto& [key, value] : {std::pair<const char*, long>{"Ni", 3}, {"Nj", 3}})
        codes_set_long(h, key, value);
    codes_set_double(h, "latitudeOfFirstGridPointInDegrees", 46.0);
    codes_set_double(h, "longitudeOfFirstGridPointInDegrees", 5.0);
    codes_set_double(h, "latitudeOfLastGridPointInDegrees", 44.0);
    codes_set_double(h, "longitudeOfLastGridPointInDegrees", 7.0);
    codes_set_double(h, "iDirectionIncrementInDegrees", 1.0);
    codes_set_double(h, "jDirectionIncrementInDegrees", 1.0);
    for (const auto& [key, value] : keys) EXPECT_EQ(codes_set_long(h, key, value), 0) << key;
    std::vector<double> values;
    for (int k = 0; k < 9; ++k) values.push_back(f(k));
    EXPECT_EQ(codes_set_double_array(h, "values", values.data(), values.size()), 0);
    const void* bytes = nullptr;
    std::size_t size = 0;
    codes_get_message(h, &bytes, &size);
    std::string out(static_cast<const char*>(bytes), size);
    codes_handle_delete(h);
    return out;
}

TEST(GribWeather, Era5Edition1)
{
    const Folder folder;
    std::string file;
    for (long hour = 0; hour < 6; ++hour) {
        const std::vector<std::pair<const char*, long>> when{
            {"dataDate", 20240101}, {"dataTime", hour * 100}, {"table2Version", 128}};
        const auto with = [&](long number) {
            auto keys = when;
            keys.emplace_back("indicatorOfParameter", number);
            return keys;
        };
        file += message("regular_ll_sfc_grib1", with(167),
                        [&](int k) { return 270.0 + k + 0.5 * static_cast<double>(hour); });
        file += message("regular_ll_sfc_grib1", with(168), [](int) { return 268.0; });
        file += message("regular_ll_sfc_grib1", with(228),
                        [&](int) { return hour == 3 ? 0.002 : 0.0; });
    }
    write(folder.file("era5.grib"), file);
    const auto [table, report] = read(folder.file("era5.grib"), {45.5, 5.5, false});
    EXPECT_EQ(report.format, "GRIB");
    EXPECT_EQ(table.rows(), 6u);
    EXPECT_NEAR(table[Field::AirTemp][0], 272.0, 0.02) << "the mean of points 0, 1, 3 and 4";
    EXPECT_NEAR(table[Field::Precip][2] * 3600.0, 2.0, 1e-3);
    EXPECT_NEAR(read(folder.file("era5.grib"), {44.9, 6.1, true}).table[Field::AirTemp][0], 274.0,
                0.02);
    EXPECT_THAT(refusal(folder.file("era5.grib")), HasSubstr("--latitude"));
    write(folder.file("cut.grib"), file.substr(0, file.size() - 30));
    EXPECT_THAT(refusal(folder.file("cut.grib"), {45.5, 5.5, false}), HasSubstr("cut short"));
}

TEST(GribWeather, Edition2)
{
    const Folder folder;
    std::string file;
    for (long hour = 0; hour < 3; ++hour) {
        const auto with = [&](long category, long number, long surface, long height) {
            return std::vector<std::pair<const char*, long>>{
                {"dataDate", 20240101},
                {"dataTime", 0},
                {"forecastTime", hour},
                {"discipline", 0},
                {"parameterCategory", category},
                {"parameterNumber", number},
                {"typeOfFirstFixedSurface", surface},
                {"scaleFactorOfFirstFixedSurface", 0},
                {"scaledValueOfFirstFixedSurface", height}};
        };
        file += message("regular_ll_sfc_grib2", with(0, 0, 103, 2), [](int) { return 275.0; });
        file += message("regular_ll_sfc_grib2", with(2, 2, 103, 10), [](int) { return 3.0; });
        file += message("regular_ll_sfc_grib2", with(2, 3, 103, 10), [](int) { return 4.0; });
    }
    write(folder.file("hrrr.grib2"), file);
    const auto table = read(folder.file("hrrr.grib2"), {45.0, 6.0, false}).table;
    EXPECT_EQ(table.rows(), 3u);
    EXPECT_EQ(weather::iso_from_us(table.time_us[2]), "2024-01-01T02:00:00Z");
    EXPECT_NEAR(table[Field::AirTemp][0], 275.0, 0.01);
    EXPECT_NEAR(table[Field::Wind][1], 5.0, 0.01);
}

#endif

}  // namespace
}  // namespace petrichor::film
