#include "cli/scene/scene_view.h"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/words.h"
#include "cli/progress.h"
#include "cli/rooms.h"
#include "film/scenes/demo_scene.h"
#include "film/scenes/scene_file.h"
#include "scene/material_table.h"

namespace petrichor::cli {
namespace {

using Json = nlohmann::ordered_json;

double cpu_seconds()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double thread_cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr std::uintmax_t kLargeFile = 32u << 20;  // takes a while to be read

LoadedScene load(const SceneViewOptions& options)
{
    if (options.file.rfind("demo:", 0) == 0)
        return load_demo(options.file, {.threads = options.threads}, user_cache(), "scene");
    return read_scene(options.file);
}

double bytes_of(const scene::Patches& p)
{
    const double nodes = p.nodes(), count = p.count;
    return nodes * (8 + 12 + 12 + 4 + 4 + 4) + count * (4 + 4 + 32) +
           static_cast<double>(p.links.size()) * 2 +
           static_cast<double>(p.samples.size()) * sizeof(scene::PatchSample) +
           static_cast<double>(p.table.size()) * 16;
}

// Shares of all links, means weighed by area, patches by level.
struct Totals {
    double area_m2 = 0.0;
    double sky_view = 0.0;
    double black = 0.0;
    double base_color = 0.0;
    std::map<int, std::uint32_t> levels;
    std::map<std::uint32_t, double> material_area_m2;
    std::uint32_t glowing = 0;
};

Totals totals_of(const SceneView& view)
{
    const scene::Patches& p = view.patches();
    Totals t;
    std::size_t black = 0;
    for (const std::uint16_t id : p.links) black += id == p.black() ? 1 : 0;
    for (std::uint32_t i = 0; i < p.count; ++i) {
        const auto area = static_cast<double>(p.area_m2[i]);
        t.area_m2 += area;
        t.sky_view += area * static_cast<double>(p.sky_view[i]);
        const glm::vec3 c = view.transport.surfaces[i].base_color;
        t.base_color += area * static_cast<double>(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z);
        t.material_area_m2[p.material[i]] += area;
        ++t.levels[scene::level_of(p.key[i])];
    }
    t.glowing = static_cast<std::uint32_t>(
        scene::glowing_patches(p, view.transport.surfaces).size());
    if (t.area_m2 > 0.0) {
        t.sky_view /= t.area_m2;
        t.base_color /= t.area_m2;
    }
    if (!p.links.empty()) t.black = static_cast<double>(black) / static_cast<double>(p.links.size());
    return t;
}

std::vector<std::string> warnings_of(const SceneView& view, const Ground& ground)
{
    std::vector<std::string> warnings = view.scene->warnings;
    for (const std::string& line : scene::unshaded_properties(*view.scene)) warnings.push_back(line);
    for (const std::string& note : view.transport.notes) warnings.push_back(note);
    const scene::Triangles& t = *view.triangles;
    if (t.left_out_degenerate() > 0) {
        warnings.push_back(std::to_string(t.left_out_degenerate()) +
                           " triangles have no area or corners that are no numbers; left out");
    }
    if (!ground.found) warnings.push_back("no surface faces up: rain and snow find nothing to lie on");
    const Totals totals = totals_of(view);
    if (totals.black > 0.05) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "%.0f %% of the rays meet backs of single-sided faces or nothing known: "
                      "faces may be turned inside out",
                      100.0 * totals.black);
        warnings.emplace_back(text);
    }
    return warnings;
}

std::string number(double value, int digits)
{
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::size_t scene_triangles(const scene::Scene& scene)
{
    std::size_t count = 0;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives)
            count += p.indices.size() / 3;
    }
    return count;
}

}  // namespace

SceneView open_scene(const SceneViewOptions& options)
{
    SceneView view;
    std::optional<Progress> progress;
    if (!options.quiet) {
        progress.emplace("scene", 100);
        std::error_code unknown;
        const auto bytes = std::filesystem::file_size(options.file, unknown);
        if (!unknown) progress->stage("reading " + std::to_string(bytes >> 20) + " MiB", bytes >= kLargeFile);
    }
    view.scene = std::make_unique<scene::Scene>(load(options).scene);
    TransportOptions transport;
    transport.patches.cell_m = static_cast<float>(options.cell_m);
    transport.patches.rays = options.rays;
    transport.patches.threads = options.threads;
    if (!options.quiet) {
        transport.patches.progress = [&](std::string_view what, float share) {
            progress->stage(std::string(what));
            progress->update(static_cast<int>(traced_share(what, share) * 100.0));
        };
    }
    if (!options.fresh) transport.cache = user_cache();
    const double before = cpu_seconds();
    // Beside patches, which from the cache keep one thread busy and no more.
    struct TimedGround {
        GroundView found;
        double cpu_seconds;
    };
    std::future<TimedGround> ground;
    if (options.ground) {
        ground = std::async(options.threads == 1 ? std::launch::deferred : std::launch::async, [&] {
            const double start = thread_cpu_seconds();
            GroundView found = find_scene_ground(*view.scene);
            return TimedGround{std::move(found), thread_cpu_seconds() - start};
        });
    }
    view.transport = prepare_transport(*view.scene, transport);
    view.cpu_seconds = cpu_seconds() - before;
    if (options.ground) {
        TimedGround timed = ground.get();
        view.ground = std::move(timed.found);
        view.cpu_seconds = cpu_seconds() - before - timed.cpu_seconds;
    }
    if (options.fresh) {
        const double start = cpu_seconds();
        if (progress) progress->stage("what is close, lamps and glow", true);
        std::vector<std::string> ignored;
        const auto lights = prepare_patch_scene(*view.scene, view.transport, transport, ignored);
        view.close = {lights->near.entries(), lights->near.sources(), cpu_seconds() - start};
    }
    std::vector<std::string> said;
    std::vector<scene::AlphaImage> holes;
    if (options.holes) holes = alpha_images(*view.scene, said);
    view.triangles = std::make_unique<scene::Triangles>(*view.scene, holes);
    return view;
}

Ground find_ground(const scene::Patches& patches)
{
    std::map<int, double> by_height;  // half metres
    double all = 0.0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        if (patches.normal[i].y < 0.8f) continue;
        const auto area = static_cast<double>(patches.area_m2[i]);
        by_height[static_cast<int>(std::floor(2.0f * patches.position_m[i].y))] += area;
        all += area;
    }
    Ground ground;
    if (all <= 0.0) return ground;
    int best = by_height.begin()->first;
    for (const auto& [step, area] : by_height) {
        if (area > by_height[best]) best = step;
    }
    double sum = 0.0, height = 0.0;
    const double middle = 0.5 * best + 0.25;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const auto y = static_cast<double>(patches.position_m[i].y);
        if (patches.normal[i].y < 0.8f || std::abs(y - middle) > 0.5) continue;
        const auto area = static_cast<double>(patches.area_m2[i]);
        sum += area;
        height += area * y;
    }
    ground.found = true;
    ground.area_m2 = sum;
    ground.height_m = height / sum;
    ground.share = sum / all;
    return ground;
}

std::string scene_report(const SceneView& view)
{
    const GroundView& hollows = view.ground;
    const scene::Patches& p = view.patches();
    const scene::Triangles& t = *view.triangles;
    const Totals totals = totals_of(view);
    const Ground ground = find_ground(p);
    const glm::vec3 size = t.high() - t.low();
    std::ostringstream out;
    out << view.scene->name << "\n";
    out << "  triangles    " << scene_triangles(*view.scene) << " in " << view.scene->instances.size()
        << " instances; " << t.size() << " stop light, " << t.left_out_blended()
        << " let it through, " << t.left_out_degenerate() << " without area\n";
    out << "  size         " << number(static_cast<double>(size.x), 2) << " x "
        << number(static_cast<double>(size.y), 2) << " x " << number(static_cast<double>(size.z), 2)
        << " m, surface " << number(t.total_area_m2(), 1) << " m2\n";
    out << "  materials    " << view.scene->materials.size() << ", lights "
        << view.scene->lights.size() << ", cameras " << view.scene->cameras.size() << "\n";
    out << "  patches      " << p.count;
    if (!p.empty()) {
        out << " of " << number(static_cast<double>(p.level_cell_m(0)), 3) << " to "
            << number(static_cast<double>(p.level_cell_m(p.levels - 1)), 2) << " m, "
            << number(totals.area_m2, 1) << " m2 seen; " << p.rays << " links each, "
            << number(100.0 * totals.black, 2) << " % black; " << totals.glowing << " glow; "
            << number(bytes_of(p) / 1048576.0, 1) << " MiB";
    }
    out << "\n";
    out << "  sky          mean view " << number(totals.sky_view, 3) << ", mean colour "
        << number(totals.base_color, 3) << "\n";
    out << "  ground       ";
    if (ground.found) {
        out << number(ground.area_m2, 1) << " m2 at " << number(ground.height_m, 2) << " m, "
            << number(100.0 * ground.share, 0) << " % of what faces up\n";
    } else {
        out << "none\n";
    }
    const HollowSums sums = hollow_sums(hollows.ground);
    out << "  hollows      " << sums.pits;
    if (!hollows.ground.field.empty()) {
        out << " on a grid of " << hollows.ground.field.width << " x "
            << hollows.ground.field.depth << " cells of "
            << number(hollows.ground.field.cell_m, 3) << " m; full they hold "
            << number(sums.capacity_m3, 3) << " m3 on " << number(sums.wet_m2, 1)
            << " m2, at most " << number(sums.deepest_m, 3) << " m deep";
    }
    out << "\n";
    for (const std::string& note : hollows.notes) out << "               " << note << "\n";
    out << "  made in      " << number(view.transport.seconds, 2) << " s, "
        << number(view.cpu_seconds, 2) << " CPU-s"
        << (view.transport.kept ? " (found in the cache)" : "") << "\n";
    if (view.close) {
        out << "  close        " << view.close->polygons << " polygons of " << view.close->sources
            << " sources, with lamps and glow " << number(view.close->cpu_seconds, 2) << " CPU-s\n";
    }
    std::vector<std::pair<double, std::uint32_t>> areas;
    for (const auto& [material, area] : totals.material_area_m2) areas.push_back({area, material});
    std::sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    for (std::size_t i = 0; i < std::min<std::size_t>(areas.size(), 12); ++i) {
        const std::string& name = view.scene->materials[areas[i].second].name;
        out << (i == 0 ? "  surface      " : "               ") << number(areas[i].first, 1)
            << " m2 " << (name.empty() ? "material " + std::to_string(areas[i].second) : name)
            << "\n";
    }
    for (const std::string& warning : warnings_of(view, ground)) out << "  warning      " << warning << "\n";
    return out.str();
}

std::string scene_json(const SceneView& view)
{
    const GroundView& hollows = view.ground;
    const scene::Patches& p = view.patches();
    const scene::Triangles& t = *view.triangles;
    const Totals totals = totals_of(view);
    const Ground ground = find_ground(p);
    const auto point = [](glm::vec3 v) { return Json::array({v.x, v.y, v.z}); };
    Json json;
    json["scene"] = view.scene->name;
    json["triangles"] = scene_triangles(*view.scene);
    json["stop_light"] = t.size();
    json["left_out"] = {{"blended", t.left_out_blended()}, {"degenerate", t.left_out_degenerate()}};
    json["instances"] = view.scene->instances.size();
    json["lights"] = view.scene->lights.size();
    json["cameras"] = view.scene->cameras.size();
    json["low_m"] = point(t.low());
    json["high_m"] = point(t.high());
    json["surface_m2"] = t.total_area_m2();
    json["patches"] = {{"count", p.count},
                       {"interior", p.interior},
                       {"finest_cell_m", p.cell_m},
                       {"levels", p.levels},
                       {"links", p.rays},
                       {"black_share", totals.black},
                       {"glowing", totals.glowing},
                       {"area_m2", totals.area_m2},
                       {"mean_sky_view", totals.sky_view},
                       {"mib", bytes_of(p) / 1048576.0}};
    Json levels = Json::array();
    for (const auto& [level, count] : totals.levels)
        levels.push_back({{"cell_m", p.level_cell_m(level)}, {"patches", count}});
    json["patches"]["by_level"] = std::move(levels);
    json["ground"] = ground.found ? Json{{"height_m", ground.height_m},
                                         {"area_m2", ground.area_m2},
                                         {"share_of_upward", ground.share}}
                                  : Json(nullptr);
    const HollowSums sums = hollow_sums(hollows.ground);
    json["hollows"] = {{"pits", sums.pits},
                       {"capacity_m3", sums.capacity_m3},
                       {"wet_m2", sums.wet_m2},
                       {"deepest_m", sums.deepest_m},
                       {"cell_m", hollows.ground.field.cell_m},
                       {"cells", {hollows.ground.field.width, hollows.ground.field.depth}},
                       {"notes", hollows.notes}};
    Json materials = Json::array();
    for (const auto& [material, area] : totals.material_area_m2)
        materials.push_back({{"index", material},
                             {"name", view.scene->materials[material].name},
                             {"area_m2", area}});
    json["materials"] = std::move(materials);
    json["warnings"] = warnings_of(view, ground);
    json["kept"] = view.transport.kept;
    json["seconds"] = view.transport.seconds;
    json["cpu_seconds"] = view.cpu_seconds;
    if (view.close) {
        json["close"] = {{"polygons", view.close->polygons},
                         {"sources", view.close->sources},
                         {"cpu_seconds", view.close->cpu_seconds}};
    }
    return json.dump(2);
}

}  // namespace petrichor::cli
