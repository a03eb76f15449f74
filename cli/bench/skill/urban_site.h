#ifndef PETRICHOR_CLI_BENCH_SKILL_URBAN_SITE_H
#define PETRICHOR_CLI_BENCH_SKILL_URBAN_SITE_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "weather/forcing/forcing.h"

namespace petrichor::cli {

/// The six ways a radiation station looks.
enum UrbanFace : std::size_t { kFaceDown, kFaceUp, kFaceNorth, kFaceEast, kFaceSouth, kFaceWest };
inline constexpr std::size_t kUrbanFaces = 6;
/// Light from above is measured by the sensor that looks up; its name says where light goes.
inline constexpr std::array<const char*, kUrbanFaces> kUrbanColumns{"down", "up", "n",
                                                                    "e",    "s",  "w"};

/// Means of an hour that were measured, W/m2; NaN: not.
struct UrbanHour {
    std::int64_t begin_us = 0;  ///< UTC
    std::array<double, kUrbanFaces> shortwave{}, longwave{};
};
struct UrbanDay {
    std::string name;
    weather::ForcingTable table;  ///< of the open, filled; the days before are the day itself
    std::int64_t begin_us = 0;    ///< UTC, of the day itself
    std::vector<UrbanHour> measured;
};

/// A place in a town: rasters of heights and cover, a station in it, and what that measured (layout
/// of the validation data of SOLWEIG, Lindberg et al. 2008).
struct UrbanSite {
    std::string name;
    std::size_t width = 0, depth = 0;  ///< cells, from the north-west, row by row
    float cell_m = 1.0f;
    std::vector<float> ground_m, top_m;  ///< of ground, of ground and buildings
    std::vector<float> tree_m;           ///< height of trees over the ground
    std::vector<float> cover;            ///< 1 paved, 2 buildings, 5 grass, 6 soil, 7 water
    std::size_t station = 0;             ///< its cell
    glm::vec3 station_m{0.0f};           ///< x east, y up, z south of the north-west corner
    std::vector<UrbanDay> days;
};

/// Whether a folder holds such a place that we know: its rasters do not say where on Earth it is.
bool is_urban_site(const std::filesystem::path& folder);
/// Throws Error for files that are missing, damaged or do not fit each other.
UrbanSite read_urban_site(const std::filesystem::path& folder);

/// What stands within `reach_m` of the station, for patches: ground, buildings as columns, crowns of
/// trees as bodies that let no light through. Albedos are those that come with the data.
scene::Scene urban_scene(const UrbanSite& site, float reach_m);

}  // namespace petrichor::cli

#endif
