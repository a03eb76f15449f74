#include "film/weather/patch_weather.h"

#include <algorithm>
#include <cmath>

#include "base/words.h"
#include "scene/basins/water.h"
#include "scene/patches/lookup.h"
#include "weather/models/physical/mapping.h"
#include "weather/patches/pond_ice.h"
#include "weather/physics/constants.h"

namespace petrichor::film {
namespace {

constexpr double kHoarScale_kg_m2 = 0.03;  // scene-weather 7: cover 1 - exp(-m / 0.03)

bool any_matches(const std::vector<std::string>& globs, const std::string& name)
{
    return std::any_of(globs.begin(), globs.end(),
                       [&](const std::string& glob) { return glob_matches(glob, name); });
}

void note_globs(const std::vector<std::string>& globs, const scene::Scene& scene, const char* key,
                std::vector<std::string>& notes)
{
    for (const std::string& glob : globs) {
        const bool meets =
            std::any_of(scene.materials.begin(), scene.materials.end(),
                        [&](const scene::Material& m) { return glob_matches(glob, m.name); });
        if (!meets)
            notes.push_back("[ground] " + std::string(key) + ": no material is called \"" + glob +
                            "\"");
    }
}

// Cells of a drain: all whose centre is within its radius, at least the one it lies in.
void add_drain(const scene::HeightField& field, const glm::dvec3& drain,
               std::vector<std::size_t>& cells, std::vector<std::string>& notes)
{
    const std::size_t middle = scene::cell_at(field, drain.x, drain.y);
    if (middle >= field.cells()) {
        notes.push_back("[ground] drains: the one at x " + std::to_string(drain.x) + ", z " +
                        std::to_string(drain.y) + " lies outside of the ground");
        return;
    }
    cells.push_back(middle);
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(drain.z / field.cell_m));
    const auto x0 = static_cast<std::ptrdiff_t>(middle % field.width);
    const auto z0 = static_cast<std::ptrdiff_t>(middle / field.width);
    for (std::ptrdiff_t z = z0 - reach; z <= z0 + reach; ++z) {
        for (std::ptrdiff_t x = x0 - reach; x <= x0 + reach; ++x) {
            if (x < 0 || z < 0 || x >= static_cast<std::ptrdiff_t>(field.width) ||
                z >= static_cast<std::ptrdiff_t>(field.depth))
                continue;
            const double dx = field.corner_m.x + (static_cast<double>(x) + 0.5) * field.cell_m;
            const double dz = field.corner_m.y + (static_cast<double>(z) + 0.5) * field.cell_m;
            if (std::hypot(dx - drain.x, dz - drain.y) <= drain.z)
                cells.push_back(
                    field.cell_of(static_cast<std::size_t>(x), static_cast<std::size_t>(z)));
        }
    }
}

// Water runs over all parts of a patch.
void add_parts_of(const ShelterParts& shelter, std::vector<std::uint32_t>& way)
{
    std::vector<std::uint32_t> all;
    for (const std::uint32_t patch : way) {
        all.push_back(patch);
        const auto cut = std::find_if(shelter.cuts.begin(), shelter.cuts.end(), [&](const ShelterParts::Cut& c) { return c.parts.patch == patch; });
        if (cut == shelter.cuts.end()) continue;
        for (std::uint32_t part = 1; part < cut->parts.count; ++part) all.push_back(cut->weather_patch(part));
    }
    way = std::move(all);
}

float narrow(double v)
{
    return static_cast<float>(v);
}

// So much ice hides the water below it.
constexpr double kWhiteIce_kg_m2 = 5.0;

// The water of a hollow over the middle of a patch, kg/m2, and how much of it is ice.
struct PondOver {
    double water_kg_m2 = 0.0, ice_kg_m2 = 0.0;
    double frozen() const
    {
        return water_kg_m2 > 0.0
                   ? std::min(1.0, ice_kg_m2 / std::min(kWhiteIce_kg_m2, water_kg_m2))
                   : 0.0;
    }
};

// The texels of gpu/frame/place_io.h. What stands in a hollow is in the ice and the liquid share.
void put_state(const weather::PatchState& s, const weather::Surface& surface,
               const WaterRelief& relief, std::uint32_t material, const PondOver& pond,
               glm::vec4* out)
{
    const weather::CellState& c = s.cell;
    const weather::CellDiagnostics d = weather::diagnostics(c);
    const weather::WeatherMasks masks = weather::weather_masks({}, surface, c, 3600.0);
    const double frost = 1.0 - std::exp(-s.hoar_kg_m2 / kHoarScale_kg_m2);
    const double standing_mm = (c.crack + c.crack_ice) + (c.puddle + c.puddle_ice);
    const float level = relief_level(relief, standing_mm);
    out[0] = {narrow(masks.wetness), drowned_share(relief, level), narrow(masks.puddles),
              narrow(masks.snow)};
    const double of_water = pond.water_kg_m2 > 0.0 ? pond.frozen() : masks.water_to_snow;
    out[1] = {narrow(frost), narrow(of_water), narrow(s.rain_share), 2.0f + level};
    const double ice = d.surface_ice_kg_m2 + pond.ice_kg_m2;
    const double frozen = d.swe_kg_m2 - d.snow_liquid_kg_m2 + ice;
    const double all =
        d.swe_kg_m2 + d.surface_water_kg_m2 + d.surface_ice_kg_m2 + pond.water_kg_m2;
    out[2] = {narrow(c.film),
              narrow(1e-3 * standing_mm),
              narrow(d.snow_depth_m), narrow(ice)};
    out[3] = {narrow(all > 0.0 ? std::clamp(1.0 - frozen / all, 0.0, 1.0) : 1.0),
              narrow(c.surface_temp_c + weather::kZeroCelsiusK),
              // Hoar is in the film's ice too.
              narrow(std::max(c.film_ice - s.hoar_kg_m2, 0.0) * (1000.0 / weather::kIceDensity)),
              static_cast<float>(material)};
}

}  // namespace

SceneGround scene_ground(const scene::Scene& scene, const ScenarioGround& keys,
                         std::vector<std::string>& notes)
{
    scene::GroundOptions options;
    for (const scene::Material& material : scene.materials) {
        scene::GroundUse use = scene::GroundUse::Auto;
        if (any_matches(keys.ground, material.name)) use = scene::GroundUse::Ground;
        if (any_matches(keys.not_ground, material.name)) use = scene::GroundUse::Never;
        options.use.push_back(use);
    }
    note_globs(keys.ground, scene, "materials", notes);
    note_globs(keys.not_ground, scene, "not_materials", notes);
    SceneGround ground;
    ground.field = scene::ground_height_field(scene, options);
    notes.insert(notes.end(), ground.field.notes.begin(), ground.field.notes.end());
    for (const glm::dvec3& drain : keys.drains)
        add_drain(ground.field, drain, ground.drains, notes);
    ground.basins = scene::find_basins(ground.field, ground.drains);
    return ground;
}

SceneSites scene_sites(const scene::Scene& scene, const scene::Patches& patches,
                       const scene::Tracer& tracer, std::span<const scene::PatchSurface> surfaces,
                       const ScenarioGround& keys, const weather::Surface& otherwise)
{
    SceneSites sites;
    sites.ground = scene_ground(scene, keys, sites.notes);
    const WaterReliefs reliefs = water_reliefs(patches, tracer.triangles(), sites.notes);
    sites.set = patch_sites(patches, tracer, surfaces, sites.ground, otherwise, reliefs);
    sites.relief = reliefs.of_material;
    sites.shelter = cut_at_shelters(sites.set, patches, tracer);
    for (const std::uint32_t patch : sites.shelter.of) sites.material.push_back(patches.material[patch]);
    sites.taps = tap_sites(keys.taps, sites.ground, patches);
    for (TapSite& site : sites.taps)
        for (weather::TapStretch& stretch : site.tap.stretches) add_parts_of(sites.shelter, stretch.way);
    if (!keys.gutters)
        for (weather::WeatherPatch& p : sites.set.patches) p.gutter_share = 0.0;
    const auto shape = std::make_shared<gpu::PlaceShape>();
    shape->grid = scene::table_grid(patches);
    shape->table = patches.table;
    for (const ShelterParts::Cut& cut : sites.shelter.cuts) gpu::append_parts(shape->table, cut.parts);
    const scene::HeightField& field = sites.ground.field;
    shape->basin_corner_m = glm::vec2(field.corner_m);
    shape->basin_cell_m = narrow(field.cell_m);
    shape->basin_width = static_cast<std::uint32_t>(field.width);
    shape->basin_depth = static_cast<std::uint32_t>(field.depth);
    shape->labels = sites.ground.basins.label;
    sites.shape = shape;
    return sites;
}

struct PlaceWeatherOfFile::Impl {
    std::shared_ptr<const gpu::PlaceShape> shape;
    std::shared_ptr<const scene::Basins> basins;
    std::vector<weather::Surface> surfaces;  // by kind
    std::vector<std::uint32_t> kind;         // of a patch
    std::vector<WaterRelief> relief;         // by material
    std::vector<std::uint32_t> material;     // of a patch
    std::vector<double> area_m2;
    ShelterParts shelter;
    // Of a patch of the ground: its pond (kRunsOut: none) and the height of its middle.
    std::vector<std::uint32_t> pond;
    std::vector<double> height_m;
    weather::PatchWeather run;
    std::int64_t first_us;
};

PlaceWeatherOfFile::PlaceWeatherOfFile(const SceneSites& sites, const weather::ForcingTable& table,
                                       const weather::PatchParams& params, std::int64_t from_us)
{
    std::vector<weather::Surface> surfaces;
    for (const weather::PatchKind& k : sites.set.kinds) surfaces.push_back(k.surface);
    std::vector<std::uint32_t> kind;
    std::vector<double> area_m2, height_m;
    std::vector<std::uint32_t> pond;
    for (const weather::WeatherPatch& p : sites.set.patches) {
        kind.push_back(p.kind);
        area_m2.push_back(p.area_m2);
        height_m.push_back(p.height_m);
        const bool drains = p.runs_to != weather::kRunsOut && (p.runs_to & weather::kToPond) != 0;
        pond.push_back(drains ? p.runs_to & ~weather::kToPond : weather::kRunsOut);
    }
    impl_ = std::make_shared<Impl>(Impl{
        sites.shape, std::make_shared<const scene::Basins>(sites.ground.basins),
        std::move(surfaces), std::move(kind), sites.relief, sites.material, std::move(area_m2),
        sites.shelter, std::move(pond), std::move(height_m),
        weather::PatchWeather(table, sites.set, params, from_us, ponds_of(sites.ground)), from_us});
}

std::int64_t PlaceWeatherOfFile::begin_us() const
{
    return impl_->run.begin_us();
}

std::shared_ptr<const gpu::PlaceWeather> PlaceWeatherOfFile::at(std::int64_t utc_us)
{
    Impl& m = *impl_;
    m.run.go_to(utc_us);
    const auto place = std::make_shared<gpu::PlaceWeather>();
    place->shape = m.shape;
    place->states.resize(m.run.patches() * PLACE_STATE_TEXELS);
    scene::BasinWater water(*m.basins);
    const auto volumes = m.run.pond_volumes_m3();
    std::copy(volumes.begin(), volumes.end(), water.volume_m3.begin());
    place->levels_m = scene::drawn_levels_m(*m.basins, water);
    const auto shapes = scene::water_shapes(*m.basins, water);
    const auto heat = m.run.pond_heat_j_kg();
    for (std::size_t i = 0; i < m.run.patches(); ++i) {
        PondOver pond;
        if (const std::uint32_t p = m.pond[i]; p < heat.size()) {
            const double over_m = static_cast<double>(place->levels_m[p + 1]) - m.height_m[i];
            if (over_m > 0.0) {
                pond.water_kg_m2 = over_m * weather::kWaterDensity;
                // Ice is as thick everywhere, as far as there is water for it.
                pond.ice_kg_m2 = std::min(pond.water_kg_m2,
                                          weather::pond_ice_share(heat[p]) *
                                              shapes[p + 1].depth_m * weather::kWaterDensity);
            }
        }
        put_state(m.run.state(i), m.surfaces[m.kind[i]], m.relief[m.material[i]], m.material[i],
                  pond, &place->states[i * PLACE_STATE_TEXELS]);
    }
    place->states = states_with_parts(std::move(place->states), PLACE_STATE_TEXELS, m.shelter, m.area_m2);
    const std::uint32_t kind = m.run.open_kind();
    const auto material = static_cast<std::uint32_t>(kind % m.relief.size());
    place->open.resize(PLACE_STATE_TEXELS);
    put_state(m.run.open(), m.surfaces[kind], m.relief[material], material, {}, place->open.data());
    return place;
}

PlaceSums PlaceWeatherOfFile::sums() const
{
    const Impl& m = *impl_;
    PlaceSums sums;
    for (std::size_t i = 0; i < m.run.patches(); ++i) {
        const weather::CellState c = m.run.state(i).cell;
        const weather::CellDiagnostics d = weather::diagnostics(c);
        sums.area_m2 += m.area_m2[i];
        sums.film_kg += m.area_m2[i] * c.film;
        sums.standing_kg += m.area_m2[i] * (c.crack + c.puddle);
        sums.ice_kg += m.area_m2[i] * d.surface_ice_kg_m2;
        sums.snow_kg += m.area_m2[i] * d.swe_kg_m2;
    }
    sums.books = m.run.ledger();
    scene::BasinWater water(*m.basins);
    const auto volumes = m.run.pond_volumes_m3();
    std::copy(volumes.begin(), volumes.end(), water.volume_m3.begin());
    const auto shapes = scene::water_shapes(*m.basins, water);
    const auto heat = m.run.pond_heat_j_kg();
    for (std::size_t p = 0; p < heat.size(); ++p)
        sums.pond_ice_kg += weather::pond_ice_share(heat[p]) * shapes[p + 1].depth_m *
                            shapes[p + 1].area_m2 * weather::kWaterDensity;
    sums.ponds_m3 = sums.books.in_ponds * 1e-3;
    return sums;
}

}  // namespace petrichor::film
