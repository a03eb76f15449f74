#include "weather/physics/surfaces.h"

#include <cmath>

#include "base/error.h"

namespace petrichor::weather {

namespace {

// One row a surface; depths of cracks and puddles in mm, infiltration in mm/h. Setts of a street, their
// joints closed by traffic, let a quarter of a rain of 15 l/(s ha) through (ATV-DVWK-M 153, 2000: paving
// with tight joints runs off by 0.75). A film of 1 mm covers stony ground, as on roads and roofs of TEB (Masson
// 2000); what is smooth, drinks or has leaves is covered by what it holds.
struct Row {
    const char* name;
    double albedo_dry, albedo_wet, emissivity, roughness_m, film, film_full, cracks_mm, puddles_mm;
    double infiltration_first, infiltration_last, conductivity, heat_capacity;
};

constexpr Row kRows[] = {
    {"asphalt", 0.12, 0.08, 0.95, 0.005, 0.4, 1.0, 1.5, 15.0, 0.0, 0.0, 0.75, 1.94e6},
    {"concrete", 0.30, 0.20, 0.94, 0.003, 0.5, 1.0, 0.8, 10.0, 0.0, 0.0, 1.5, 2.1e6},
    {"paving_stones", 0.25, 0.17, 0.94, 0.005, 0.5, 1.0, 4.0, 10.0, 50.0, 10.0, 1.2, 2.0e6},
    {"cobblestone", 0.20, 0.13, 0.94, 0.01, 0.6, 1.0, 8.0, 15.0, 10.0, 1.4, 1.5, 2.1e6},
    {"brick", 0.28, 0.17, 0.93, 0.005, 0.8, 1.0, 4.0, 8.0, 20.0, 5.0, 0.8, 1.7e6},
    {"soil", 0.20, 0.11, 0.95, 0.01, 1.0, 1.0, 5.0, 20.0, 50.0, 5.0, 1.0, 2.0e6},
    {"sand", 0.35, 0.20, 0.94, 0.003, 1.0, 1.0, 3.0, 15.0, 200.0, 60.0, 0.6, 1.6e6},
    {"gravel", 0.22, 0.14, 0.93, 0.01, 1.0, 1.0, 10.0, 15.0, 250.0, 100.0, 0.8, 1.7e6},
    {"grass", 0.22, 0.20, 0.97, 0.03, 1.0, 1.0, 10.0, 20.0, 80.0, 10.0, 1.0, 2.0e6},
    {"roof_metal", 0.35, 0.33, 0.80, 0.002, 0.2, 0.2, 0.3, 2.0, 0.0, 0.0, 0.2, 0.8e6},
    {"roof_tile", 0.22, 0.14, 0.92, 0.01, 0.8, 1.0, 2.0, 3.0, 0.0, 0.0, 0.7, 1.5e6},
    {"wood", 0.30, 0.18, 0.92, 0.003, 0.6, 0.6, 1.5, 5.0, 0.0, 0.0, 0.15, 1.0e6},
    {"rock", 0.25, 0.17, 0.94, 0.01, 0.4, 1.0, 3.0, 20.0, 0.0, 0.0, 2.5, 2.2e6},
};

// Crowned, swept by traffic and ploughed. Albedo, emissivity, heat from traffic and below, and how
// fast snow goes are METRo's (Crevier & Delage 2001); roughness is that of the exchange METRo has.
// Vehicles stir the air as 1.5 m/s of wind do by day and 0.4 by night, which METRo leaves out.
Surface road_in_use()
{
    Surface s;
    s.name = "road";
    s.albedo_dry = 0.10;
    s.albedo_wet = 0.08;
    s.emissivity = 0.92;
    s.roughness_m = 0.001;
    s.heat_roughness_share = 0.5;
    s.film_capacity_kg_m2 = 0.2;
    s.film_full_kg_m2 = 0.2;  // wheels spread what lies between the stones
    s.cracks = uniform_hypsometry(0.2);
    s.puddles = uniform_hypsometry(0.2);
    s.layers = {{0.2, 0.8, 2.1e6}, {0.3, 0.95, 2.1e6}};  // asphalt on crushed rock
    s.conductivity_w_m_k = 0.95;
    s.heat_capacity_j_m3_k = 2.1e6;
    s.traffic_heat_w_m2 = 10.0;
    s.traffic_wind_m_s = 1.5;
    s.snow_clearing_1_h = 1.08;
    return s;
}

// Grass whose blades are a skin of their own: they hold little water, and little heat reaches them
// from the soil, so that dew falls on them (scene-weather 1: 7 to 15 W m-2 K-1; 7 here).
// Film and skin were chosen on the wetness sensor of Champaign 1998: kappa 0.49 against 0.24 of
// "grass", wet in 64 % of the hours 0 to 6 of April to October (measured: 62 %, "grass": 34 %).
Surface lawn(const Surface& grass)
{
    Surface s = grass;
    s.name = "lawn";
    s.film_capacity_kg_m2 = 0.2;
    s.film_full_kg_m2 = 0.2;
    s.layers = {{0.01, 0.07, 2.0e5}};
    return s;
}

std::vector<Surface> make_presets()
{
    std::vector<Surface> all;
    for (const Row& row : kRows) {
        Surface s;
        s.name = row.name;
        s.albedo_dry = row.albedo_dry;
        s.albedo_wet = row.albedo_wet;
        s.emissivity = row.emissivity;
        s.roughness_m = row.roughness_m;
        s.film_capacity_kg_m2 = row.film;
        s.film_full_kg_m2 = row.film_full;
        s.cracks = uniform_hypsometry(row.cracks_mm);
        s.puddles = uniform_hypsometry(row.puddles_mm);
        s.infiltration.first_mm_h = row.infiltration_first;
        s.infiltration.last_mm_h = row.infiltration_last;
        s.conductivity_w_m_k = row.conductivity;
        s.heat_capacity_j_m3_k = row.heat_capacity;
        all.push_back(std::move(s));
        if (all.back().name == "grass") all.push_back(lawn(all.back()));
    }
    all.push_back(road_in_use());
    all.push_back(all.back());
    all.back().name = "bridge";
    all.back().open_below = true;
    return all;
}

std::string plain(std::string_view name)
{
    std::string out;
    for (const char c : name) {
        if (c >= 'A' && c <= 'Z')
            out += static_cast<char>(c - 'A' + 'a');
        else if (c == ' ' || c == '-')
            out += '_';
        else
            out += c;
    }
    return out;
}

void require(bool good, const Surface& s, const char* field, double found, const char* accepted)
{
    if (good) return;
    throw Error("surface " + s.name + ": " + field + " must be " + accepted + ", got " +
                    std::to_string(found),
                std::string("Set ") + field + " to a value in the accepted range.");
}

}  // namespace

const std::vector<Surface>& surface_presets()
{
    static const std::vector<Surface> presets = make_presets();
    return presets;
}

Surface surface_preset(std::string_view name)
{
    const std::string wanted = plain(name);
    std::string names;
    for (const Surface& surface : surface_presets()) {
        if (surface.name == wanted) return surface;
        names += (names.empty() ? "" : ", ") + surface.name;
    }
    throw Error("surface: there is no preset named '" + std::string(name) + "'",
                "Use one of: " + names + ".");
}

void check_surface(const Surface& s)
{
    const auto unit = [](double v) { return v >= 0.0 && v <= 1.0; };
    require(unit(s.albedo_dry), s, "albedo_dry", s.albedo_dry, "in 0..1");
    require(unit(s.albedo_wet), s, "albedo_wet", s.albedo_wet, "in 0..1");
    require(s.emissivity > 0.0 && s.emissivity <= 1.0, s, "emissivity", s.emissivity, "in (0, 1]");
    require(s.roughness_m >= 1e-6 && s.roughness_m <= 0.5, s, "roughness_m", s.roughness_m,
            "in 1e-6..0.5");
    require(s.film_capacity_kg_m2 >= 0.01 && s.film_capacity_kg_m2 <= 100.0, s,
            "film_capacity_kg_m2", s.film_capacity_kg_m2, "in 0.01..100");
    require(s.film_full_kg_m2 >= 0.01 && s.film_full_kg_m2 <= 100.0, s, "film_full_kg_m2",
            s.film_full_kg_m2, "in 0.01..100");
    require(s.film_rate_1_s > 0.0 && s.film_rate_1_s <= 10.0, s, "film_rate_1_s", s.film_rate_1_s,
            "in (0, 10]");
    require(s.slush_rate_1_s > 0.0 && s.slush_rate_1_s <= 10.0, s, "slush_rate_1_s",
            s.slush_rate_1_s, "in (0, 10]");
    require(s.cracks.depth_mm > 0.0 && std::isfinite(s.cracks.depth_mm), s, "cracks.depth_mm",
            s.cracks.depth_mm, "above 0");
    require(s.puddles.depth_mm > 0.0 && std::isfinite(s.puddles.depth_mm), s, "puddles.depth_mm",
            s.puddles.depth_mm, "above 0");
    const HortonParams& h = s.infiltration;
    require(h.last_mm_h >= 0.0, s, "infiltration.last_mm_h", h.last_mm_h, "0 or more");
    require(h.first_mm_h >= h.last_mm_h && h.first_mm_h <= 1e5, s, "infiltration.first_mm_h",
            h.first_mm_h, "last_mm_h or more");
    require(h.decay_1_h > 0.0 && h.decay_1_h <= 1e4, s, "infiltration.decay_1_h", h.decay_1_h,
            "above 0");
    require(h.recovery_1_h >= 0.0 && h.recovery_1_h <= 1e4, s, "infiltration.recovery_1_h",
            h.recovery_1_h, "0 or more");
    require(s.conductivity_w_m_k > 0.0 && s.conductivity_w_m_k < 1e3, s, "conductivity_w_m_k",
            s.conductivity_w_m_k, "above 0");
    require(s.heat_capacity_j_m3_k >= 1e4 && s.heat_capacity_j_m3_k < 1e8, s,
            "heat_capacity_j_m3_k", s.heat_capacity_j_m3_k, "in 1e4..1e8");
    require(s.traffic_loss_1_h >= 0.0 && s.traffic_loss_1_h < 1e3, s, "traffic_loss_1_h",
            s.traffic_loss_1_h, "0 or more");
    for (const GroundLayer& layer : s.layers) {
        require(layer.thickness_m > 0.0 && layer.thickness_m <= 100.0, s, "layers.thickness_m",
                layer.thickness_m, "in (0, 100]");
        require(layer.conductivity_w_m_k > 0.0 && layer.conductivity_w_m_k < 1e3, s,
                "layers.conductivity_w_m_k", layer.conductivity_w_m_k, "above 0");
        require(layer.heat_capacity_j_m3_k >= 1e4 && layer.heat_capacity_j_m3_k < 1e8, s,
                "layers.heat_capacity_j_m3_k", layer.heat_capacity_j_m3_k, "in 1e4..1e8");
    }
    require(s.snow_clearing_1_h >= 0.0 && s.snow_clearing_1_h < 1e3, s, "snow_clearing_1_h",
            s.snow_clearing_1_h, "0 or more");
    require(s.heat_roughness_share >= 1e-4 && s.heat_roughness_share <= 10.0, s,
            "heat_roughness_share", s.heat_roughness_share, "in 1e-4..10");
    require(s.salt_loss_1_h >= 0.0 && s.salt_loss_1_h < 1e3, s, "salt_loss_1_h", s.salt_loss_1_h,
            "0 or more");
    require(s.leaf_width_m == 0.0 || (s.leaf_width_m >= 1e-4 && s.leaf_width_m <= 1.0), s, "leaf_width_m", s.leaf_width_m,
            "0 or in 1e-4..1");
    require(s.traffic_heat_w_m2 >= 0.0 && s.traffic_heat_w_m2 <= 1e3, s, "traffic_heat_w_m2",
            s.traffic_heat_w_m2, "in 0..1000");
    require(s.traffic_wind_m_s >= 0.0 && s.traffic_wind_m_s < 50.0, s, "traffic_wind_m_s",
            s.traffic_wind_m_s, "0 or more");
}

}  // namespace petrichor::weather
