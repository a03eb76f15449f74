// petrichor-weather: the helper program that opens packed weather files: gzip and zip archives,
// NetCDF, GRIB. It gets the bytes on standard input and answers with texts, each behind a line
// "file LENGTH NAME". Damaged files crash libraries; this program may crash.
//
//   --latitude=N --longitude=E --nearest   where to read a grid, and not between its points
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/confine.h"
#include "base/error.h"
#include "weather/packed/archive.h"
#include "weather/packed/point_series.h"
#include "weather/readers/text.h"
#ifdef PETRICHOR_NETCDF
#include "weather/packed/netcdf.h"
#endif
#ifdef PETRICHOR_GRIB
#include "weather/packed/grib.h"
#endif

namespace {

using namespace petrichor;
using namespace petrichor::weather::packed;

constexpr std::size_t kMostBytes = std::size_t{768} << 20;

Point point_of(const std::vector<std::string>& arguments)
{
    Point point{std::nan(""), std::nan(""), true};
    for (const std::string& word : arguments) {
        const auto value = [&](const char* name) -> double {
            const std::string start = std::string(name) + "=";
            if (word.rfind(start, 0) != 0) return std::nan("");
            return weather::to_number(word.substr(start.size())).value_or(std::nan(""));
        };
        if (word.rfind("--latitude=", 0) == 0) point.latitude_deg = value("--latitude");
        if (word.rfind("--longitude=", 0) == 0) point.longitude_deg = value("--longitude");
        if (word == "--nearest") point.bilinear = false;
    }
    return point;
}

bool begins(std::span<const std::byte> bytes, const char* magic, std::size_t n)
{
    return bytes.size() >= n && std::memcmp(bytes.data(), magic, n) == 0;
}

void append(std::vector<std::byte>& out, std::span<const std::byte> more)
{
    out.insert(out.end(), more.begin(), more.end());
}
void answer(std::vector<std::byte>& out, std::string name, std::span<const std::byte> text)
{
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    const std::string line = "file " + std::to_string(text.size()) + " " + name + "\n";
    append(out, std::as_bytes(std::span(line)));
    append(out, text);
}

void open(const std::string& name, std::span<const std::byte> bytes, const Point& point, int depth,
          std::vector<std::byte>& out)
{
    if (depth > 3) throw Error("weather: archives inside archives, too deep", "Unpack them first.");
    if (is_gzip(bytes)) {
        const auto inside = gunzipped(bytes, kMostBytes);
        return open(name, inside, point, depth + 1, out);
    }
    if (is_zip(bytes)) {
        for (const Entry& entry : unzipped(bytes, kMostBytes))
            open(entry.name, entry.bytes, point, depth + 1, out);
        return;
    }
    const bool netcdf = begins(bytes, "CDF", 3) || begins(bytes, "\x89HDF", 4);
    if (netcdf) {
#ifdef PETRICHOR_NETCDF
        const std::string text = csv_of(read_netcdf(bytes, point));
        return answer(out, name, std::as_bytes(std::span(text)));
#else
        throw Error("weather: this is a NetCDF file, and petrichor was built without NetCDF",
                    "Install libnetcdf-dev and build again.");
#endif
    }
    if (begins(bytes, "GRIB", 4)) {
#ifdef PETRICHOR_GRIB
        const std::string text = csv_of(read_grib(bytes, point));
        return answer(out, name, std::as_bytes(std::span(text)));
#else
        throw Error("weather: this is a GRIB file, and petrichor was built without GRIB",
                    "Install libeccodes-dev and build again.");
#endif
    }
    answer(out, name, bytes);
}

}  // namespace

int main(int argc, char** argv)
{
    bool grib = false;
    for (int i = 1; i < argc; ++i) grib = grib || std::strcmp(argv[i], "--grib") == 0;
    return run_helper(
        argc, argv,
        [](const HelperInput& input) {
            std::vector<std::byte> out;
            open("", input.bytes, point_of(input.arguments), 0, out);
            return out;
        },
        [grib] {
#ifdef PETRICHOR_GRIB
            if (grib) load_grib_tables();
#else
            static_cast<void>(grib);
#endif
        });
}
