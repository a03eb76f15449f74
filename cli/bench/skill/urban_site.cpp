#include "cli/bench/skill/urban_site.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/input_file.h"
#include "cli/simulate/terrain.h"
#include "texproc/codecs/files/io.h"
#include "weather/physics/constants.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using weather::Field;

constexpr std::int64_t kHour_us = 3600LL * weather::kMicrosPerSecond;
constexpr std::uintmax_t kMostBytes = 64u << 20;
constexpr int kDaysBefore = 6;
constexpr float kBuilding_m = 2.0f;  // over the ground: higher than what is no building
constexpr float kTree_m = 1.0f;
constexpr float kTrunkShare = 0.25f;  // of a tree's height, that comes with the data
constexpr double kWind_m_s = 2.0;     // where the file has none: that of the other site

struct Known {
    const char* folder;
    const char* ends;  // of its rasters
    std::size_t column, row;
    float cell_m, height_m;  // of the station over the ground
    double latitude_deg, longitude_deg;
};
// Where the stations stand: the page that comes with the data.
constexpr Known kKnown[] = {{"kronenhuset", "_KR", 117, 51, 1.0f, 1.0f, 57.707, 11.962},
                            {"gustav_adolfs", "_GA", 77, 33, 2.0f, 2.0f, 57.707, 11.967}};

const Known* known(const fs::path& folder)
{
    const std::string name = folder.filename().string();
    const auto* found = std::find_if(std::begin(kKnown), std::end(kKnown),
                                     [&](const Known& k) { return name == k.folder; });
    return found == std::end(kKnown) ? nullptr : found;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why)
{
    throw Error("bench: " + file.string() + " " + why,
                "Take the folder as it came with the validation data of SOLWEIG.");
}

std::vector<float> raster(const fs::path& folder, const std::string& stem, UrbanSite& site)
{
    std::size_t width = 0, depth = 0;
    std::vector<float> values;
    const fs::path tif = folder / (stem + ".tif"), asc = folder / (stem + ".asc");
    if (fs::exists(tif)) {
        const Image image = texproc::read_image(tif);
        width = static_cast<std::size_t>(image.width);
        depth = static_cast<std::size_t>(image.height);
        for (std::size_t i = 0; i < width * depth; ++i)
            values.push_back(image.pixels[i * static_cast<std::size_t>(image.channels)]);
    } else {
        const Terrain grid = parse_ascii_grid(read_file(asc, "bench:", kMostBytes), asc.string());
        width = grid.width;
        depth = grid.height;
        values = grid.heights_m;
    }
    if (site.width == 0) {
        site.width = width;
        site.depth = depth;
    }
    if (width != site.width || depth != site.depth || width < 2 || depth < 2)
        refuse(tif, "has another size than the rasters beside it");
    for (float& v : values)
        if (!std::isfinite(v) || v < -1000.0f || v > 9000.0f) v = 0.0f;
    return values;
}

// Rows of numbers below a line of names; commas or blanks.
struct Numbers {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;

    std::size_t column(const fs::path& file, const std::string& name) const
    {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (weather::lower(names[i]) == weather::lower(name)) return i;
        refuse(file, "has no column " + name);
    }
};
Numbers numbers_of(const fs::path& file)
{
    std::string text = read_file(file, "bench:", kMostBytes);
    std::replace(text.begin(), text.end(), '%', ' ');
    // An empty field between commas is a value that is missing.
    for (std::size_t at = text.find(",,"); at != std::string::npos; at = text.find(",,", at + 1))
        text.insert(at + 1, "-999");
    std::replace(text.begin(), text.end(), ',', ' ');
    Numbers out;
    weather::Lines lines(text);
    while (const auto line = lines.next()) {
        const auto words = weather::words(*line, 64);
        if (words.empty()) continue;
        if (out.names.empty()) {
            for (const auto word : words) out.names.emplace_back(word);
            continue;
        }
        if (words.size() != out.names.size())
            refuse(file, "line " + std::to_string(lines.number()) + " has another number of values");
        std::vector<double> row;
        for (const auto word : words) {
            const double v = weather::to_number(word).value_or(weather::kMissing);
            row.push_back(v <= -999.0 ? weather::kMissing : v);
        }
        out.rows.push_back(std::move(row));
    }
    return out;
}

// An hour of these files is the mean from its label on, on the clock of winter (UTC+1): so the sun of
// the open stands highest where the almanac has it.
UrbanDay day_of(const fs::path& file, const weather::Site& where)
{
    const Numbers n = numbers_of(file);
    const auto of = [&](const char* name) { return n.column(file, name); };
    const std::size_t year = of("iy"), day = of("id"), hour = of("it");
    if (n.rows.size() != 24) refuse(file, "does not hold 24 hours");
    UrbanDay out;
    out.begin_us = (weather::days_from_civil(static_cast<int>(n.rows[0][year]), 1, 1) +
                    static_cast<std::int64_t>(n.rows[0][day]) - 1) *
                       24 * kHour_us -
                   kHour_us;
    weather::ForcingTable& t = out.table;
    t.site = where;
    // Values stand in the middle of their hours, so that an hour has its own mean; the first row makes
    // steps begin with hours.
    for (int d = -kDaysBefore; d <= 0; ++d) {
        for (std::size_t i = 0; i < 24; ++i) {
            const std::vector<double>& row = n.rows[i];
            if (row[hour] != static_cast<double>(i)) refuse(file, "leaves out an hour");
            const std::int64_t at = out.begin_us + (d * 24 + static_cast<std::int64_t>(i)) * kHour_us;
            const bool first = t.time_us.empty();
            for (const std::int64_t us : {at, at + kHour_us / 2}) {
                if (us == at && !first) continue;
                t.time_us.push_back(us);
                t[Field::AirTemp].push_back(row[of("Td")] + weather::kZeroCelsiusK);
                t[Field::RelHumidity].push_back(row[of("RH")]);
                const double wind = row[of("Wind")];
                t[Field::Wind].push_back(std::isnan(wind) ? kWind_m_s : wind);
                t[Field::Shortwave].push_back(row[of("Kdn")]);
                t[Field::Diffuse].push_back(row[of("Kdiff")]);
                t[Field::Precip].push_back(0.0);
            }
        }
    }
    weather::ReadReport report;
    weather::fill_forcing(t, report);
    return out;
}

// The stations' clock is that of summer (UTC+2): their sun is an hour after the other files'.
std::vector<UrbanHour> measured_on(const fs::path& file, const Numbers& n, std::int64_t begin_us,
                                   const std::string& date)
{
    const bool dated = weather::lower(n.names[0]) == "day";
    const std::size_t hour = n.column(file, "hour");
    std::vector<UrbanHour> out;
    for (const std::vector<double>& row : n.rows) {
        if (dated && std::to_string(static_cast<std::int64_t>(row[0])) != date) continue;
        UrbanHour h;
        h.begin_us = begin_us + (static_cast<std::int64_t>(row[hour]) - 1) * kHour_us;
        for (std::size_t f = 0; f < kUrbanFaces; ++f) {
            h.shortwave[f] = row[n.column(file, std::string("K") + kUrbanColumns[f])];
            h.longwave[f] = row[n.column(file, std::string("L") + kUrbanColumns[f])];
        }
        out.push_back(h);
    }
    return out;
}

struct Maker {
    scene::Primitive* primitive = nullptr;
    // Seen from where corner, corner + u, corner + u + v turn left.
    void face(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) const
    {
        const auto first = static_cast<std::uint32_t>(primitive->positions.size());
        const glm::vec3 n = glm::normalize(glm::cross(b - a, d - a));
        for (const glm::vec3& x : {a, b, c, d}) {
            primitive->positions.push_back(x);
            primitive->normals.push_back(n);
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
            primitive->indices.push_back(first + i);
    }
};

enum Stuff : std::uint32_t { kPaved, kRoof, kWall, kGrass, kSoil, kWater, kLeaves, kStuffs };

scene::Material material(const char* name, float albedo)
{
    scene::Material m;
    m.name = name;
    m.base_color = glm::vec4(albedo, albedo, albedo, 1.0f);
    m.metallic = 0.0f;
    return m;
}

}  // namespace

bool is_urban_site(const fs::path& folder)
{
    const Known* k = known(folder);
    return k != nullptr && fs::exists(folder / (std::string("DSM") + k->ends + ".tif"));
}

UrbanSite read_urban_site(const fs::path& folder)
{
    const Known* k = known(folder);
    if (k == nullptr) refuse(folder, "is no site that we know");
    UrbanSite site;
    site.name = k->folder;
    site.cell_m = k->cell_m;
    const std::string ends = k->ends;
    site.top_m = raster(folder, "DSM" + ends, site);
    site.ground_m = raster(folder, "DEM" + ends, site);
    site.tree_m = raster(folder, "CDSM" + ends, site);
    const bool other_name = fs::exists(folder / ("landcover" + ends + ".tif"));
    site.cover = raster(folder, (other_name ? "landcover" : "LC") + ends, site);
    if (k->column >= site.width || k->row >= site.depth)
        refuse(folder, "has rasters that the station is not in");
    site.station = k->row * site.width + k->column;
    site.station_m = {(static_cast<float>(k->column) + 0.5f) * site.cell_m,
                      site.ground_m[site.station] + k->height_m,
                      (static_cast<float>(k->row) + 0.5f) * site.cell_m};
    const weather::Site where{.latitude_deg = k->latitude_deg,
                              .longitude_deg = k->longitude_deg,
                              .elevation_m = static_cast<double>(site.ground_m[site.station])};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    fs::path seen;
    for (const fs::path& file : files)
        if (file.filename().string().rfind("measurements", 0) == 0) seen = file;
    const Numbers numbers = numbers_of(seen);
    for (const fs::path& file : files) {
        const std::string stem = file.stem().string();
        if (stem.rfind("MetFile", 0) != 0) continue;
        UrbanDay day = day_of(file, where);
        day.name = stem.substr(stem.find('_') + 1);
        day.measured = measured_on(seen, numbers, day.begin_us, day.name);
        site.days.push_back(std::move(day));
    }
    return site;
}

scene::Scene urban_scene(const UrbanSite& site, float reach_m)
{
    scene::Scene made;
    // parametersforsolweig_*.json of the data; leaves: Oke 1987, deciduous trees .15 to .20.
    made.materials = {material("asphalt", 0.18f), material("roof tile", 0.18f),
                      material("brick wall", 0.20f), material("lawn", 0.16f),
                      material("soil", 0.25f), material("water", 0.05f),
                      material("leaves", 0.18f)};
    made.materials[kLeaves].alpha_mode = scene::AlphaMode::Mask;
    made.meshes.emplace_back();
    made.meshes[0].primitives.resize(kStuffs);
    for (std::uint32_t m = 0; m < kStuffs; ++m) made.meshes[0].primitives[m].material = m;
    made.instances.push_back({"town", 0, glm::mat4(1.0f)});
    const auto to = [&](Stuff s) { return Maker{&made.meshes[0].primitives[s]}; };

    const auto reach = static_cast<std::ptrdiff_t>(reach_m / site.cell_m);
    const auto w = static_cast<std::ptrdiff_t>(site.width),
               h = static_cast<std::ptrdiff_t>(site.depth);
    const auto sx = static_cast<std::ptrdiff_t>(site.station % site.width),
               sz = static_cast<std::ptrdiff_t>(site.station / site.width);
    const std::ptrdiff_t x0 = std::max<std::ptrdiff_t>(sx - reach, 0), x1 = std::min(sx + reach, w - 1),
                         z0 = std::max<std::ptrdiff_t>(sz - reach, 0), z1 = std::min(sz + reach, h - 1);
    const auto inside = [&](std::ptrdiff_t x, std::ptrdiff_t z) {
        return x >= x0 && x <= x1 && z >= z0 && z <= z1;
    };
    const auto at = [&](std::ptrdiff_t x, std::ptrdiff_t z) {
        return static_cast<std::size_t>(z * w + x);
    };
    const auto built = [&](std::size_t i) {
        return site.top_m[i] - site.ground_m[i] > kBuilding_m;
    };
    // Ground runs through the means of the cells at a corner; houses stand on it.
    const auto corner_m = [&](std::ptrdiff_t x, std::ptrdiff_t z) {
        float sum = 0.0f, count = 0.0f;
        for (const std::ptrdiff_t dz : {-1, 0}) {
            for (const std::ptrdiff_t dx : {-1, 0}) {
                if (x + dx < 0 || z + dz < 0 || x + dx >= w || z + dz >= h) continue;
                sum += site.ground_m[at(x + dx, z + dz)];
                count += 1.0f;
            }
        }
        return sum / count;
    };
    const float c = site.cell_m;
    for (std::ptrdiff_t z = z0; z <= z1; ++z) {
        for (std::ptrdiff_t x = x0; x <= x1; ++x) {
            const std::size_t i = at(x, z);
            const float west = static_cast<float>(x) * c, north = static_cast<float>(z) * c;
            const float east = west + c, south = north + c;
            // A side of a column, seen from outside, between two heights.
            const auto side = [&](const Maker& maker, std::ptrdiff_t dx, std::ptrdiff_t dz, float low,
                                  float high) {
                const glm::vec3 a = dx > 0   ? glm::vec3(east, low, south)
                                    : dx < 0 ? glm::vec3(west, low, north)
                                    : dz > 0 ? glm::vec3(west, low, south)
                                             : glm::vec3(east, low, north);
                const glm::vec3 b = dx > 0   ? glm::vec3(east, low, north)
                                    : dx < 0 ? glm::vec3(west, low, south)
                                    : dz > 0 ? glm::vec3(east, low, south)
                                             : glm::vec3(west, low, north);
                const glm::vec3 up(0.0f, high - low, 0.0f);
                maker.face(a, b, b + up, a + up);
            };
            const auto lid = [&](const Maker& maker, float y) {
                maker.face({west, y, south}, {east, y, south}, {east, y, north}, {west, y, north});
            };
            constexpr std::ptrdiff_t kWays[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
            if (built(i)) {
                lid(to(kRoof), site.top_m[i]);
                for (const auto& way : kWays) {
                    if (!inside(x + way[0], z + way[1])) continue;
                    const std::size_t j = at(x + way[0], z + way[1]);
                    const float foot = built(j) ? site.top_m[j] : site.ground_m[j] - 0.5f;
                    if (site.top_m[i] > foot + 0.01f)
                        side(to(built(j) ? kRoof : kWall), way[0], way[1], foot, site.top_m[i]);
                }
                continue;
            }
            const int cover = static_cast<int>(site.cover[i]);
            const Stuff stuff = cover == 5   ? kGrass
                                : cover == 6 ? kSoil
                                : cover == 7 ? kWater
                                             : kPaved;
            to(stuff).face({west, corner_m(x, z + 1), south}, {east, corner_m(x + 1, z + 1), south},
                           {east, corner_m(x + 1, z), north}, {west, corner_m(x, z), north});
            if (site.tree_m[i] < kTree_m) continue;
            const float top = site.ground_m[i] + site.tree_m[i];
            const float foot = site.ground_m[i] + kTrunkShare * site.tree_m[i];
            lid(to(kLeaves), top);
            to(kLeaves).face({west, foot, north}, {east, foot, north}, {east, foot, south},
                             {west, foot, south});
            for (const auto& way : kWays) {
                if (!inside(x + way[0], z + way[1])) continue;
                const std::size_t j = at(x + way[0], z + way[1]);
                const bool crown = !built(j) && site.tree_m[j] >= kTree_m;
                const float low = crown ? site.ground_m[j] + site.tree_m[j] : foot;
                if (top > std::max(low, foot) + 0.01f)
                    side(to(kLeaves), way[0], way[1], std::max(low, foot), top);
            }
        }
    }
    // Materials that nothing is made of have no primitive.
    auto& primitives = made.meshes[0].primitives;
    std::erase_if(primitives, [](const scene::Primitive& p) { return p.indices.empty(); });
    return made;
}

}  // namespace petrichor::cli
