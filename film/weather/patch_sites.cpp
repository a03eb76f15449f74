#include "film/weather/patch_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "film/weather/surface_by_name.h"
#include "scene/basins/water.h"
#include "weather/patches/driving_rain.h"

namespace petrichor::film {
namespace {

constexpr std::size_t kMostLinks = 16;  // of the patches that a patch sees
constexpr float kWallUp = 0.3f;         // a wall's normal is flatter than this
constexpr float kGroundUp = 0.5f;       // ground's is steeper
constexpr float kFlatUp = 0.999f;       // no way is down
constexpr float kGutterDrop_m = 2.0f;
constexpr double kGutterShare = 0.9;
constexpr float kSplashReach_m = 0.6f;
constexpr int kWallSteps = 64;
constexpr double kNoHollow_mm = 0.01;  // none, for a model that wants some
// Walls of houses by what they are made of, and half of what stands free.
constexpr double kBoard_w_m_k = 0.3, kBoard_m = 0.1, kMasonry_m = 0.3, kSlab_m = 0.1;
constexpr double kLeaves_m = 0.02;  // of leaves and blades, and the water in them
constexpr double kLeafWidth_m = 0.05;
constexpr float kIntoHouse_m = 0.5f, kAcrossHouse_m = 60.0f, kSlabMost_m = 1.2f;
constexpr float kRoomLeast_m = 1.5f, kDoor_m = 2.0f;
constexpr float kBlade_m = 0.03f;      // what is narrower stands free among its like
constexpr int kSamplesAsked = 5;       // of a patch, evenly among its kPatchSamples
constexpr double kGroundNear_m = 0.3;  // of the height field: higher up it is no ground

double luminance(const glm::vec3& rgb)
{
    return static_cast<double>(0.2126f * rgb.r + 0.7152f * rgb.g + 0.0722f * rgb.b);
}

enum class GroundForm : std::uint32_t { Level, Hollow, Steep, House, Slab };

// Kinds of a material, by form; their albedo is what its patches have.
std::vector<weather::PatchKind> kinds_of(const scene::Patches& patches, const scene::Scene& scene,
                                         std::span<const scene::PatchSurface> surfaces,
                                         const weather::Surface& otherwise,
                                         const WaterReliefs& reliefs)
{
    std::vector<double> area(scene.materials.size(), 0.0), albedo(scene.materials.size(), 0.0);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const std::uint32_t m = patches.material[i];
        const auto a = static_cast<double>(patches.area_m2[i]);
        area[m] += a;
        albedo[m] += a * luminance(surfaces[i].base_color);
    }
    std::vector<weather::PatchKind> kinds;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const scene::Material& material = scene.materials[m];
        weather::PatchKind kind;
        kind.surface = surface_of_material(material, otherwise);
        const bool metal =
            material.metallic > 0.5f && !material.metallic_roughness_texture.present();
        if (area[m] > 0.0 && !metal) {
            const double darker = kind.surface.albedo_wet / kind.surface.albedo_dry;
            kind.surface.albedo_dry = std::clamp(albedo[m] / area[m], 0.03, 0.9);
            kind.surface.albedo_wet = kind.surface.albedo_dry * darker;
        }
        kind.like_air = is_leaves(material);
        // Blades hold snow on a bank where stones shed it.
        kind.holds_by_tilt = !is_leaves(material) && kind.surface.name != "lawn";
        kind.slides_above_deg = slides_above_deg(material, kind.surface);
        kind.splash = kind.surface.name == "lawn" ? 0.3 : 1.0;
        kinds.push_back(std::move(kind));
    }
    // Each as what it is where it is level, in a hollow, where water runs off, as a wall of a house
    // and as a thing with air behind it.
    const std::vector<weather::PatchKind> dry = std::move(kinds);
    kinds.clear();
    for (const GroundForm form : {GroundForm::Level, GroundForm::Hollow, GroundForm::Steep,
                                  GroundForm::House, GroundForm::Slab}) {
        for (std::size_t m = 0; m < dry.size(); ++m) {
            weather::PatchKind kind = dry[m];
            kind.surface.cracks = kind.surface.puddles = weather::uniform_hypsometry(kNoHollow_mm);
            if (form < GroundForm::Steep && reliefs.of_material[m].unit_mm > 0.0)
                kind.surface.puddles =
                    store_of_relief(reliefs.of_material[m], form == GroundForm::Hollow);
            const bool solid = kind.surface.conductivity_w_m_k > kBoard_w_m_k;
            if (form >= GroundForm::House)
                kind.surface.layers = {
                    {is_foliage(scene.materials[m]) || kind.surface.name == "lawn" ? kLeaves_m
                     : form == GroundForm::Slab                                    ? kSlab_m
                     : solid                                                       ? kMasonry_m
                                                                                   : kBoard_m,
                     kind.surface.conductivity_w_m_k, kind.surface.heat_capacity_j_m3_k}};
            if (is_foliage(scene.materials[m])) kind.surface.leaf_width_m = kLeafWidth_m;
            kind.room_behind = form == GroundForm::House;
            kind.surface.open_below = form == GroundForm::Slab;
            kinds.push_back(std::move(kind));
        }
    }
    return kinds;
}

struct Below {
    std::uint32_t patch = 0;
    float drop_m = 0.0f;
};

class Ways {
public:
    // soft: by material, leaves and blades.
    Ways(const scene::Patches& patches, const scene::Tracer& tracer, std::vector<bool> soft)
        : patches_(patches), tracer_(tracer), soft_(std::move(soft))
    {
    }

    float cell_of(std::uint32_t i) const
    {
        return patches_.level_cell_m(scene::level_of(patches_.key[i]));
    }
    // What lies straight below a point that is in the air.
    std::optional<Below> below(const glm::vec3& from, float longest_m) const
    {
        const scene::RayHit hit = tracer_.nearest({from, {0.0f, -1.0f, 0.0f}, longest_m});
        if (!hit.hit()) return std::nullopt;
        glm::vec3 normal = tracer_.triangles().normal(hit.triangle);
        if (hit.back) normal = -normal;
        const auto patch =
            scene::patch_at(patches_, from - glm::vec3(0.0f, hit.distance_m, 0.0f), normal);
        if (!patch) return std::nullopt;
        return Below{*patch, hit.distance_m};
    }
    // Where water goes that runs down this patch.
    std::optional<Below> downhill(std::uint32_t i) const
    {
        const glm::vec3 n = patches_.normal[i], c = patches_.position_m[i];
        const float reach = 10000.0f;
        if (n.y <= kWallUp) return below(c + n * 0.1f, reach);
        if (n.y > kFlatUp) return std::nullopt;
        const glm::vec3 way =
            glm::normalize(glm::vec3(n.x * n.y, -(n.x * n.x + n.z * n.z), n.z * n.y));
        const float step = cell_of(i);
        auto found = below(c + way * step + glm::vec3(0.0f, 0.15f * step + 0.02f, 0.0f), reach);
        if (found) found->drop_m -= 0.15f * step + 0.02f;
        return found;
    }
    // How far up a wall a patch lies, and whether an end of the wall is near.
    double wall_factor(std::uint32_t i, float above_ground_m) const
    {
        const glm::vec3 n = patches_.normal[i];
        const float up = run_of_wall(i, {0.0f, 1.0f, 0.0f});
        const double height = static_cast<double>(above_ground_m + up);
        if (!(height > 0.0)) return weather::wall_rain_factor(1.0, false);
        const glm::vec3 side = glm::normalize(glm::vec3(-n.z, 0.0f, n.x));
        const double near = 0.1 * height;
        const bool edge = static_cast<double>(up) < near ||
                          static_cast<double>(run_of_wall(i, side)) < near ||
                          static_cast<double>(run_of_wall(i, -side)) < near;
        return weather::wall_rain_factor(static_cast<double>(above_ground_m) / height, edge);
    }

    // What is behind an upright patch: a house is as wide as a room at least, has a wall across that
    // is seen from behind, and a roof as high as a door, neither of leaves: a bush behind a garden wall
    // is no room. What is thin shows its own back.
    GroundForm behind(std::uint32_t i) const
    {
        const glm::vec3 n = patches_.normal[i], c = patches_.position_m[i];
        if (std::abs(n.y) >= kWallUp) return GroundForm::Steep;
        const glm::vec3 inside = c - n * kIntoHouse_m;
        const scene::RayHit across = tracer_.nearest({inside, -n, kAcrossHouse_m});
        if (across.back && across.distance_m >= kRoomLeast_m - kIntoHouse_m && !soft(across)) {
            const scene::RayHit up = tracer_.nearest({inside, {0.0f, 1.0f, 0.0f}, kAcrossHouse_m});
            const scene::RayHit down =
                tracer_.nearest({inside, {0.0f, -1.0f, 0.0f}, kAcrossHouse_m});
            if (up.hit() && !soft(up) && (!down.hit() || up.distance_m + down.distance_m >= kDoor_m))
                return GroundForm::House;
        }
        const bool thin = most_of(i, [&](const scene::PatchSample& s) { return is_thin(s, n); });
        return thin ? GroundForm::Slab : GroundForm::Steep;
    }

    // Whether most of what is seen of a patch is blades: triangles that no ground is made of.
    bool is_blades(std::uint32_t i) const
    {
        return most_of(i, [&](const scene::PatchSample& s) {
            const glm::vec3 a = tracer_.triangles().edge1(s.triangle),
                            b = tracer_.triangles().edge2(s.triangle);
            const float longest_m = std::max({glm::length(a), glm::length(b), glm::length(b - a)});
            return 2.0f * tracer_.triangles().area_m2(s.triangle) < kBlade_m * longest_m;
        });
    }

private:
    const scene::Patches& patches_;
    const scene::Tracer& tracer_;
    std::vector<bool> soft_;

    template <class Test>
    bool most_of(std::uint32_t i, const Test& test) const
    {
        int yes = 0;
        for (int k = 0; k < kSamplesAsked; ++k) {
            const auto number = static_cast<std::size_t>(k * scene::kPatchSamples / kSamplesAsked);
            if (test(patches_.samples[std::size_t{i} * scene::kPatchSamples + number])) ++yes;
        }
        return 2 * yes > kSamplesAsked;
    }
    // Whether air is reached from within: what goes into a second body, as a beam sunk into a wall,
    // has to come out of both.
    bool is_thin(const scene::PatchSample& sample, const glm::vec3& n) const
    {
        constexpr float kPast_m = 0.001f;
        glm::vec3 at = tracer_.triangles().point(sample.triangle, sample.at) - n * kPast_m;
        float left_m = kSlabMost_m;
        int bodies = 1;
        for (int k = 0; k < 8 && left_m > 0.0f; ++k) {
            const scene::RayHit hit = tracer_.nearest({at, -n, left_m});
            if (!hit.hit()) return false;
            bodies += hit.back ? -1 : 1;
            if (bodies == 0) return true;
            at -= n * (hit.distance_m + kPast_m);
            left_m -= hit.distance_m + kPast_m;
        }
        return false;
    }
    bool soft(const scene::RayHit& hit) const
    {
        return soft_[tracer_.triangles().material(hit.triangle)];
    }
    // How far the same wall goes on in a direction.
    float run_of_wall(std::uint32_t i, const glm::vec3& way) const
    {
        const glm::vec3 n = patches_.normal[i], c = patches_.position_m[i];
        const float step = cell_of(i);
        float run = 0.0f;
        for (int k = 1; k <= kWallSteps; ++k) {
            const glm::vec3 at = c + way * (step * static_cast<float>(k));
            const auto patch = scene::patch_at(patches_, at, n);
            if (!patch) break;
            const glm::vec3 there = patches_.position_m[*patch] - at;
            if (glm::dot(patches_.normal[*patch], n) < 0.9f || glm::dot(there, there) > step * step)
                break;
            run = step * static_cast<float>(k);
        }
        return run;
    }
};

void link(weather::PatchSet& set, const scene::Patches& patches)
{
    set.link_begin.assign(1, 0);
    std::vector<std::uint32_t> hits;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        hits.clear();
        for (int r = 0; r < patches.rays; ++r)
            if (const std::uint32_t id = patches.row(i)[r]; id < patches.count) hits.push_back(id);
        const std::size_t kept = std::min(hits.size(), kMostLinks);
        for (std::size_t k = 0; k < kept; ++k) set.links.push_back(hits[k * hits.size() / kept]);
        set.link_begin.push_back(static_cast<std::uint32_t>(set.links.size()));
        set.patches[i].patch_share =
            std::min(static_cast<double>(hits.size()) / patches.rays,
                     1.0 - std::min(1.0, static_cast<double>(patches.sky_view[i])));
    }
}

// Neighbours on the ground, that heaps of snow slide to.
void set_beside(weather::PatchSet& set, const scene::Patches& patches, const Ways& ways)
{
    set.beside_begin.assign(1, 0);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const auto first = set.beside.size();
        if (patches.normal[i].y > kGroundUp) {
            const float step = ways.cell_of(i);
            for (const glm::vec3 way : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1),
                                        glm::vec3(0, 0, -1)}) {
                const auto other =
                    scene::patch_at(patches, patches.position_m[i] + way * step, patches.normal[i]);
                if (!other || *other == i) continue;
                const bool known =
                    std::find(set.beside.begin() + static_cast<std::ptrdiff_t>(first),
                              set.beside.end(), *other) != set.beside.end();
                const glm::vec3 to = patches.position_m[*other] - patches.position_m[i];
                const float distance = std::sqrt(to.x * to.x + to.z * to.z);
                if (known || distance < 0.2f * step) continue;
                set.beside.push_back(*other);
                set.beside_m.push_back(distance);
            }
        }
        set.beside_begin.push_back(static_cast<std::uint32_t>(set.beside.size()));
    }
}

// The pond that ground drains to, or out.
std::uint32_t drain_of(const SceneGround& ground, const glm::vec3& at, bool& is_ground)
{
    is_ground = false;
    const std::size_t cell =
        scene::cell_at(ground.field, static_cast<double>(at.x), static_cast<double>(at.z));
    if (cell >= ground.field.cells()) return weather::kRunsOut;
    const float height = ground.field.height_m[cell];
    if (!std::isfinite(height) ||
        std::abs(static_cast<double>(at.y) - static_cast<double>(height)) > kGroundNear_m)
        return weather::kRunsOut;
    is_ground = true;
    const std::uint32_t label = ground.basins.label[cell];
    if (label == scene::kOutside || label == scene::kNoLabel) return weather::kRunsOut;
    return weather::kToPond | (label - 1);
}

}  // namespace

weather::PatchSet patch_sites(const scene::Patches& patches, const scene::Tracer& tracer,
                              std::span<const scene::PatchSurface> surfaces,
                              const SceneGround& ground, const weather::Surface& otherwise,
                              const WaterReliefs& reliefs)
{
    const scene::Scene& scene = tracer.triangles().scene();
    weather::PatchSet set;
    set.kinds = kinds_of(patches, scene, surfaces, otherwise, reliefs);
    std::vector<bool> soft;
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        soft.push_back(set.kinds[m].like_air || set.kinds[m].surface.name == "lawn");
    const Ways ways(patches, tracer, soft);
    set.ponds = ground.basins.pits;
    set.patches.resize(patches.count);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        weather::WeatherPatch& p = set.patches[i];
        const glm::dvec3 n = glm::normalize(glm::dvec3(patches.normal[i]));
        p.normal = {n.x, n.y, n.z};
        p.area_m2 = std::max(static_cast<double>(patches.area_m2[i]), 1e-6);
        p.height_m = static_cast<double>(patches.position_m[i].y);
        p.kind = patches.material[i];
        const bool stands = !soft[p.kind] && set.kinds[p.kind].surface.layers.empty();
        const bool lawn = set.kinds[p.kind].surface.name == "lawn";
        const GroundForm form = is_foliage(scene.materials[p.kind]) ? GroundForm::Slab
                                : !holds_water(scene.materials[p.kind], patches.normal[i])
                                    ? (stands                      ? ways.behind(i)
                                       : lawn && ways.is_blades(i) ? GroundForm::Slab
                                                                   : GroundForm::Steep)
                                : reliefs.hollow[i] ? GroundForm::Hollow
                                                    : GroundForm::Level;
        p.kind += static_cast<std::uint32_t>(form) *
                  static_cast<std::uint32_t>(scene.materials.size());
        p.visible = patches.visible[i];
        p.sky_share = std::clamp(static_cast<double>(patches.sky_view[i]), 0.0, 1.0);
        // Materials that weather leaves alone stay dry.
        if (scene.materials[patches.material[i]].weather.sheltered) p.visible = {};
        bool is_ground = false;
        if (n.y > static_cast<double>(kGroundUp))
            p.runs_to = drain_of(ground, patches.position_m[i], is_ground);
        if (is_ground) continue;
        const auto down = ways.downhill(i);
        if (down && down->patch != i) {
            p.runs_to = down->patch;
            const bool eaves = n.y > static_cast<double>(kWallUp) && down->drop_m > kGutterDrop_m;
            if (eaves) p.gutter_share = kGutterShare;
        }
        if (std::abs(n.y) < static_cast<double>(kWallUp)) {
            const float above = down ? down->drop_m : 0.0f;
            p.wall_factor = ways.wall_factor(i, above);
            const auto foot =
                ways.below(patches.position_m[i] + patches.normal[i] * 0.3f, kSplashReach_m);
            if (foot && foot->patch != i && patches.normal[foot->patch].y > kGroundUp) {
                p.foot = foot->patch;
                p.foot_height_m = static_cast<double>(foot->drop_m);
            }
        }
    }
    link(set, patches);
    set_beside(set, patches, ways);
    // The ground below a pond soaks as the patches that drain to it do.
    set.pond_soaks_mm_h.assign(set.ponds, 0.0);
    std::vector<double> area(set.ponds, 0.0);
    for (const weather::WeatherPatch& p : set.patches) {
        if (p.runs_to == weather::kRunsOut || (p.runs_to & weather::kToPond) == 0) continue;
        const std::uint32_t pond = p.runs_to & ~weather::kToPond;
        area[pond] += p.area_m2;
        set.pond_soaks_mm_h[pond] += p.area_m2 * set.kinds[p.kind].surface.infiltration.last_mm_h;
    }
    for (std::size_t i = 0; i < area.size(); ++i)
        if (area[i] > 0.0) set.pond_soaks_mm_h[i] /= area[i];
    return set;
}

weather::Ponds ponds_of(const SceneGround& ground)
{
    const auto basins = std::make_shared<const scene::Basins>(ground.basins);
    weather::Ponds ponds;
    ponds.volume_m3.assign(basins->hollow.size(), 0.0);
    // Numbers by hollow; pond i is pit i + 1.
    ponds.step = [basins](std::span<double> volume, std::span<const double> in,
                          std::span<const double> loss) {
        scene::BasinWater water(*basins);
        std::copy(volume.begin(), volume.end(), water.volume_m3.begin());
        std::vector<double> by_label(basins->pits + 1, 0.0), loss_m(basins->pits + 1, 0.0);
        std::copy(in.begin(), in.end(), by_label.begin() + 1);
        std::copy(loss.begin(), loss.end(), loss_m.begin() + 1);
        weather::PondStep done;
        done.out_m3 = scene::pour(*basins, water, by_label);
        done.lost_m3 = scene::evaporate(*basins, water, loss_m);
        std::copy(water.volume_m3.begin(), water.volume_m3.end(), volume.begin());
        return done;
    };
    ponds.stored_m3 = [basins](std::span<const double> volume) {
        scene::BasinWater water(*basins);
        std::copy(volume.begin(), volume.end(), water.volume_m3.begin());
        return scene::stored_m3(*basins, water);
    };
    ponds.shape = [basins](std::span<const double> volume) {
        scene::BasinWater water(*basins);
        std::copy(volume.begin(), volume.end(), water.volume_m3.begin());
        std::vector<weather::PondShape> shapes;
        for (const scene::WaterShape& shape : scene::water_shapes(*basins, water))
            shapes.push_back({shape.depth_m, shape.area_m2});
        shapes.erase(shapes.begin());  // that of the outside
        return shapes;
    };
    ponds.level_m = [basins](std::span<const double> volume) {
        scene::BasinWater water(*basins);
        std::copy(volume.begin(), volume.end(), water.volume_m3.begin());
        std::vector<float> levels = scene::levels_m(*basins, water);
        levels.erase(levels.begin());
        return levels;
    };
    return ponds;
}

}  // namespace petrichor::film
