// How near the light of patches comes to a path tracer's: the demo street, points that its cameras
// see, light without direct sun and lamps. The table is printed; for the whole of it:
//
//   PETRICHOR_QUALITY_POINTS=600 PETRICHOR_QUALITY_PATHS=2048 transport_quality_test
//
// PETRICHOR_QUALITY_SET=1 takes other points, PETRICHOR_QUALITY_SEED=2 other rays of the patches.
//
// And pictures of Lambert surfaces, made with that light and with the path tracer's, compared as a
// screen shows them; kept as PNG where PETRICHOR_QUALITY_KEEP names a folder:
//
//   PETRICHOR_QUALITY_WIDTH=400 PETRICHOR_QUALITY_PATHS=256 transport_quality_test
//   --gtest_filter='*Pictures*'
//
// RMSE over the mean holds the noise of the reference too: a lamp at night has much of it in the
// short run, and a tenth of a metre from the lantern decides.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "film/scenes/demo_scene.h"
#include "film/scenes/transport.h"
#include "formulas/color/srgb.h"
#include "formulas/light/brdf.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/lookup.h"
#include "scene/patches/tracer.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

struct Conditions {
    const char* name;
    glm::vec3 sun{0.0f};  // lux; none
    glm::vec3 towards_sun{0.0f, 1.0f, 0.0f};
    float zenith = 0.0f, horizon = 0.0f;  // radiance of the sky
    float ground = 0.0f;                  // below the horizon
    bool snow = false;
    bool lamp = false;
    bool windows = false;
    double most_rmse = 1.0;  // of the short run
};

// `windows` comes last: the others are as they were without it. Its limit was set after seeing 1.6, most of
// it noise of paths that seldom meet a pane.
std::vector<Conditions> all_conditions()
{
    const glm::vec3 noon = glm::normalize(glm::vec3(0.35f, 0.8f, 0.45f));
    return {
        {"dry noon", glm::vec3(90000.0f), noon, 3000.0f, 6000.0f, 1500.0f, false, false, false,
         0.18},
        {"snow .9", glm::vec3(90000.0f), noon, 3000.0f, 6000.0f, 8000.0f, true, false, false, 0.22},
        {"overcast", {}, noon, 4000.0f, 1500.0f, 300.0f, false, false, false, 0.125},
        {"lamp at night", {}, noon, 0.02f, 0.02f, 0.01f, false, true, false, 1.10},
        {"and windows", {}, noon, 0.02f, 0.02f, 0.01f, false, true, true, 1.80},
    };
}

int number_of(const char* name, int otherwise)
{
    const char* text = std::getenv(name);
    return text && *text ? std::atoi(text) : otherwise;
}

struct Street {
    Street()
        : scene(load_demo_street({}, user_cache()).scene),
          triangles(scene, alpha_images(scene, notes)),
          tracer(triangles),
          images(color_images(scene, 0, notes))
    {
        TransportOptions options;
        options.cache = user_cache();
        options.patches.seed = static_cast<std::uint32_t>(number_of("PETRICHOR_QUALITY_SEED", 1));
        options.patches.cell_m = 1e-3f * static_cast<float>(number_of("PETRICHOR_QUALITY_CELL_MM", 0));
        patches = prepare_patch_scene(scene, options, notes);
        for (const std::string& note : notes) std::printf("  %s\n", note.c_str());
    }
    std::vector<std::string> notes;
    scene::Scene scene;
    scene::Triangles triangles;
    scene::Tracer tracer;
    std::vector<scene::ColorImage> images;
    std::shared_ptr<const gpu::PatchScene> patches;
};

struct Point {
    glm::vec3 x, n;
};

std::vector<Point> seen_points(const Street& street, int count)
{
    std::vector<Point> points;
    const std::size_t cameras = std::min<std::size_t>(street.scene.cameras.size(), 2);
    const std::uint64_t first = 1000000 * static_cast<std::uint64_t>(number_of("PETRICHOR_QUALITY_SET", 0));
    for (std::uint64_t i = first; static_cast<int>(points.size()) < count && i < first + 100000; ++i) {
        const scene::Camera& camera = street.scene.cameras[i % cameras];
        const glm::vec2 half = scene::half_extent_m(camera, 16, 9);
        const float u = 2.0f * scene::unit_float(scene::mixed(i, 1)) - 1.0f;
        const float v = 2.0f * scene::unit_float(scene::mixed(i, 2)) - 1.0f;
        const glm::mat4& m = camera.to_world;
        const glm::vec3 d = glm::normalize(-glm::vec3(m[2]) + glm::vec3(m[0]) * (u * half.x) +
                                           glm::vec3(m[1]) * (v * half.y));
        const scene::RayHit hit = street.tracer.nearest({glm::vec3(m[3]), d});
        if (!hit.hit() || (hit.back && !street.triangles.double_sided(hit.triangle))) continue;
        glm::vec3 n = street.triangles.normal(hit.triangle);
        if (hit.back) n = -n;
        points.push_back({street.triangles.point(hit.triangle, hit.at), n});
    }
    return points;
}

struct World {
    const Street& street;
    const Conditions& c;

    float sky(glm::vec3 d) const
    {
        if (d.y < 0.0f) return c.ground;
        return c.horizon + (c.zenith - c.horizon) * std::sqrt(d.y);
    }
    glm::vec3 albedo(std::uint32_t t, scene::Barycentric at, glm::vec3 n) const
    {
        if (c.snow && n.y > 0.5f) return glm::vec3(0.9f);
        return glm::min(scene::surface_color(street.triangles, t, at, street.images),
                        glm::vec3(0.98f));
    }
    glm::vec3 direct(glm::vec3 x, glm::vec3 n) const
    {
        glm::vec3 sum(0.0f);
        const glm::vec3 from = x + n * scene_lift;
        const float cosine = glm::dot(n, c.towards_sun);
        if (cosine > 0.0f && c.sun.y > 0.0f && !street.tracer.blocked({from, c.towards_sun}))
            sum += c.sun * cosine;
        if (!c.lamp) return sum;
        for (const scene::Light& light : street.scene.lights) {
            const glm::vec3 way = light.position_m - from;
            const float r = glm::length(way);
            const float facing = glm::dot(n, way) / r;
            if (facing <= 0.0f) continue;
            const bool hidden = r > scene::kLanternRadius_m &&
                                street.tracer.blocked({from, way / r, r - scene::kLanternRadius_m});
            if (!hidden)
                sum += light.color *
                       (light.intensity * facing * shared::light_attenuation(r, light.range_m));
        }
        return sum;
    }
    // Of a window; a lantern's glass and the lamp in it are the same light.
    glm::vec3 glow(std::uint32_t t, scene::Barycentric at, glm::vec3 x) const
    {
        if (!c.windows) return glm::vec3(0.0f);
        for (const scene::Light& light : street.scene.lights)
            if (glm::distance(light.position_m, x) < 0.5f) return glm::vec3(0.0f);
        return scene::surface_emission(street.triangles, t, at, street.images);
    }
    // Irradiance of a point without direct sun and lamps, by paths.
    glm::vec3 irradiance(const Point& p, std::uint64_t seed, int paths) const
    {
        glm::vec3 sum(0.0f);
        for (int k = 0; k < paths; ++k) {
            std::uint64_t h = scene::mixed(seed, static_cast<std::uint64_t>(k));
            glm::vec3 x = p.x, n = p.n, through(1.0f);
            for (int depth = 0; depth < 8; ++depth) {
                h = scene::mixed(h, static_cast<std::uint64_t>(depth));
                const float u = depth == 0 ? (static_cast<float>(k) + scene::unit_float(h)) /
                                                 static_cast<float>(paths)
                                           : scene::unit_float(h);
                const glm::vec3 d =
                    scene::cosine_direction(n, u, scene::unit_float(scene::mixed(h, 3)));
                const scene::RayHit hit = street.tracer.nearest({x + n * scene_lift, d});
                if (!hit.hit()) {
                    sum += through * (kPi * sky(d));
                    break;
                }
                if (hit.back && !street.triangles.double_sided(hit.triangle)) break;
                x = street.triangles.point(hit.triangle, hit.at);
                n = street.triangles.normal(hit.triangle);
                if (hit.back) n = -n;
                sum += through * (kPi * glow(hit.triangle, hit.at, x));
                through *= albedo(hit.triangle, hit.at, n);
                sum += through * direct(x, n);
            }
        }
        return sum / static_cast<float>(paths);
    }
    float open(const Point& p, float radius, int rays) const
    {
        int far = 0;
        for (int r = 0; r < rays; ++r) {
            const glm::vec3 d = scene::row_direction(p.n, r, rays, 77);
            far += street.tracer.blocked({p.x + p.n * scene_lift, d, radius}) ? 0 : 1;
        }
        return static_cast<float>(far) / static_cast<float>(rays);
    }
    static constexpr float scene_lift = 0.002f;
};

float luminance(glm::vec3 v)
{
    return 0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z;
}

float bounced(float albedo, float open)
{
    // The curve of the lighting pass (Jimenez et al. 2016).
    const float a = 2.0404f * albedo - 0.3324f, b = -4.7951f * albedo + 0.6417f,
                c = 2.7552f * albedo + 0.6903f;
    return std::max(open, ((open * a + b) * open + c) * open);
}

// What lighting multiplies the light of patches with, for an occlusion without error.
float occlusion_factor(const World& world, const Point& at, const shared::PatchLight& light)
{
    const float rho = world.c.snow && at.n.y > 0.5f ? 0.9f : 0.2f;
    const float own = bounced(rho, shared::open_beyond(world.open(at, 0.5f, 128), light.close));
    const float mean = bounced(rho, shared::open_beyond(light.open, light.close));
    return shared::with_close_light(std::min(own / std::max(mean, 0.05f), 2.0f), light.close_light);
}

// What the path tracer found is kept where PETRICHOR_QUALITY_REFERENCE names a folder: it takes nearly all
// of a run, and what is changed is the other side.
std::string reference_file(const Street& street, const Conditions& c, int paths, std::size_t points)
{
    const char* folder = std::getenv("PETRICHOR_QUALITY_REFERENCE");
    if (!folder || !*folder) return {};
    return std::string(folder) + "/" + street.triangles.fingerprint() + " " + c.name + " " +
           std::to_string(number_of("PETRICHOR_QUALITY_SET", 0)) + " " + std::to_string(points) + " " + std::to_string(paths);
}

bool kept_reference(const Street& street, const Conditions& c, int paths, std::vector<double>& wanted)
{
    const std::string name = reference_file(street, c, paths, wanted.size());
    if (name.empty()) return false;
    std::ifstream file(name, std::ios::binary);
    file.read(reinterpret_cast<char*>(wanted.data()), static_cast<std::streamsize>(wanted.size() * sizeof(double)));
    return file.good();
}

void keep_reference(const Street& street, const Conditions& c, int paths, const std::vector<double>& wanted)
{
    const std::string name = reference_file(street, c, paths, wanted.size());
    if (name.empty()) return;
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(wanted.data()),
               static_cast<std::streamsize>(wanted.size() * sizeof(double)));
}

struct Errors {
    double rmse, bias, median, log2;
};
Errors errors_of(const std::vector<double>& got, const std::vector<double>& wanted)
{
    double mean = 0.0, square = 0.0, bias = 0.0, stops = 0.0;
    std::vector<double> relative;
    for (std::size_t i = 0; i < got.size(); ++i) {
        mean += wanted[i];
        bias += got[i] - wanted[i];
        square += (got[i] - wanted[i]) * (got[i] - wanted[i]);
        relative.push_back(std::abs(got[i] / std::max(wanted[i], 1e-9) - 1.0));
        const double l = std::log2(std::max(got[i], 1e-6) / std::max(wanted[i], 1e-6));
        stops += l * l;
    }
    const auto n = static_cast<double>(got.size());
    std::sort(relative.begin(), relative.end());
    return {std::sqrt(square / n) / (mean / n), bias / mean, relative[relative.size() / 2],
            std::sqrt(stops / n)};
}

// The material whose direct light a point sees most of, how far that is, and its share of the
// light.
std::string what_lights(const World& world, const Point& p)
{
    constexpr int kRays = 512;
    std::map<std::uint32_t, std::pair<float, float>>
        light;  // by material: light, and times distance
    float all = 0.0f;
    for (int r = 0; r < kRays; ++r) {
        const glm::vec3 d = scene::row_direction(p.n, r, kRays, 3);
        const scene::RayHit hit = world.street.tracer.nearest({p.x + p.n * World::scene_lift, d});
        if (!hit.hit()) {
            all += kPi * world.sky(d);
            continue;
        }
        glm::vec3 n = world.street.triangles.normal(hit.triangle);
        if (hit.back) n = -n;
        const glm::vec3 x = world.street.triangles.point(hit.triangle, hit.at);
        const float sent = luminance(world.albedo(hit.triangle, hit.at, n) * world.direct(x, n));
        auto& entry = light[world.street.triangles.material(hit.triangle)];
        entry.first += sent;
        entry.second += sent * hit.distance_m;
        all += sent;
    }
    const auto most = std::max_element(
        light.begin(), light.end(),
        [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
    if (most == light.end() || !(most->second.first > 0.0f)) return "the sky";
    char text[120];
    std::snprintf(text, sizeof text, "%.0f %% of %s at %.2f m",
                  static_cast<double>(100.0f * most->second.first / all),
                  world.street.scene.materials[most->first].name.c_str(),
                  static_cast<double>(most->second.second / most->second.first));
    return text;
}

// Where the squares of the error lie: PETRICHOR_QUALITY_WORST points of each light.
void print_worst(const World& world, const std::vector<Point>& points,
                 const std::vector<double>& wanted, const std::vector<double>& got)
{
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto square = [&](std::size_t i) { return std::pow(got[i] - wanted[i], 2.0); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return square(a) > square(b); });
    double all = 0.0, sum = 0.0;
    for (const std::size_t i : order) all += square(i);
    const auto most = static_cast<std::size_t>(number_of("PETRICHOR_QUALITY_WORST", 0));
    for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
        const std::size_t i = order[k];
        sum += square(i);
        std::printf(
            "    at %7.3f %7.3f %7.3f  facing %5.2f %5.2f %5.2f  %9.4g for %9.4g  %5.1f %%  %s\n",
            static_cast<double>(points[i].x.x), static_cast<double>(points[i].x.y),
            static_cast<double>(points[i].x.z), static_cast<double>(points[i].n.x),
            static_cast<double>(points[i].n.y), static_cast<double>(points[i].n.z), got[i],
            wanted[i], 100.0 * sum / all, what_lights(world, points[i]).c_str());
    }
}

// The same world on patches, and its light as pixels look it up.
struct PatchWorld {
    explicit PatchWorld(const World& world);
    PatchWorld(const PatchWorld&) = delete;  // `lit` looks at the rest
    PatchWorld& operator=(const PatchWorld&) = delete;

    scene::PatchIrradiance light;
    std::vector<glm::vec4> planes;
    scene::LookupWays ways;
    scene::LitPatches lit;
};

PatchWorld::PatchWorld(const World& world)
{
    const Street& street = world.street;
    const Conditions& c = world.c;
    const scene::Patches& p = street.patches->patches;
    std::vector<glm::vec3> albedo, direct(p.count, glm::vec3(0.0f)),
        sky(static_cast<std::size_t>(shared::kSkyBins));
    for (std::uint32_t i = 0; i < p.count; ++i) {
        glm::vec3 a = street.patches->surfaces[i].base_color;
        if (c.snow) {
            float white = 0.0f;
            for (std::size_t k = 0; k < scene::kPatchSamples; ++k) {
                const auto s =
                    scene::sample_point(street.triangles, p.samples[i * scene::kPatchSamples + k]);
                white += s.normal.y > 0.5f ? 1.0f / scene::kPatchSamples : 0.0f;
            }
            a = glm::mix(a, glm::vec3(0.9f), white);
        }
        albedo.push_back(a);
    }
    for (std::size_t b = 0; b < sky.size(); ++b) {
        // The mean of a bin, as the renderer takes it.
        glm::vec3 sum(0.0f);
        for (int k = 0; k < 16; ++k) {
            const auto bin = static_cast<int>(b);
            const glm::vec2 uv =
                (glm::vec2(bin % 32 * 4 + k % 4, bin / 32 * 4 + k / 4) + 0.5f) / 128.0f * 2.0f -
                1.0f;
            sum += glm::vec3(world.sky(shared::octahedral_decode(uv)) / 16.0f);
        }
        sky[b] = kPi * sum;
    }
    scene::add_sun(p, c.towards_sun, c.sun, direct);
    for (std::size_t l = 0; c.lamp && l < street.scene.lights.size(); ++l)
        scene::add_lamp(p, street.scene.lights[l], street.scene.light_profiles, street.patches->lamp_reach[l], direct);
    const scene::NearLinks& near = street.patches->near;
    std::vector<glm::vec3> near_direct(near.sources(), glm::vec3(0.0f)), near_albedo;
    for (std::size_t s = 0; s < near.sources(); ++s) {
        const bool white = c.snow && near.normal[s].y > 0.5f;
        near_albedo.push_back(white ? glm::vec3(0.9f) : street.patches->near_surfaces[s].base_color);
    }
    scene::add_sun(near, c.towards_sun, c.sun, near_direct);
    for (std::size_t l = 0; c.lamp && l < street.scene.lights.size(); ++l)
        scene::add_lamp(near, street.scene.lights[l], street.scene.light_profiles, street.patches->near_reach[l], near_direct);
    scene::Relight input;
    input.albedo = albedo;
    input.direct = direct;
    std::vector<glm::vec3> emission;
    if (c.windows) {
        for (const scene::PatchSurface& surface : street.patches->surfaces)
            emission.push_back(kPi * surface.emission);
        input.emission = emission;
        input.glow = &street.patches->glow;
    }
    input.near = &near;
    input.near_direct = near_direct;
    input.near_albedo = near_albedo;
    std::vector<glm::vec3> near_emission;
    if (c.windows) {
        for (const scene::PatchSurface& surface : street.patches->near_surfaces)
            near_emission.push_back(kPi * surface.emission);
        input.near_emission = near_emission;
    }
    input.sky = sky;
    input.bounces = c.snow ? 4 : 3;
    light = scene::relight(p, input);
    planes = scene::lookup_planes(p);
    ways = scene::lookup_ways(p, &near);
    lit = {ways.table, ways.ways, planes, light.irradiance, light.gradient, ways.grid, light.near};
}

TEST(TransportQuality, PatchesComeNearAPathTracer)
{
    const Street street;
    const int count = number_of("PETRICHOR_QUALITY_POINTS", 200);
    const int paths = number_of("PETRICHOR_QUALITY_PATHS", 192);
    const std::vector<Point> points = seen_points(street, count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    std::printf("  %-14s %8s %8s %8s %8s   (%d points, %d paths)\n", "", "rmse", "bias", "median",
                "log2", count, paths);
    for (const Conditions& c : all_conditions()) {
        const World world{street, c};
        std::vector<double> wanted(points.size()), plain(points.size()), ratio(points.size()),
            today(points.size());
        const bool known = kept_reference(street, c, paths, wanted);
        parallel_for(known ? 0 : points.size(), 0, [&](std::size_t i) {
            wanted[i] = static_cast<double>(
                luminance(world.irradiance(points[i], static_cast<std::uint64_t>(i), paths)));
        });
        if (!known) keep_reference(street, c, paths, wanted);
        const PatchWorld on_patches(world);
        const scene::LitPatches& lit = on_patches.lit;
        // What there was before: the sky's irradiance times 16 exact rays and a constant.
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point& at = points[i];
            const auto found = scene::light_at(lit, at.x, at.n);
            EXPECT_GT(found.weight, 0.0f);
            plain[i] = static_cast<double>(luminance(found.irradiance));
            const float rho = c.snow && at.n.y > 0.5f ? 0.9f : 0.2f;
            ratio[i] = plain[i] * static_cast<double>(occlusion_factor(world, at, found));
            float open_sky = 0.0f;
            int seen = 0, asked = 0;
            for (int r = 0; r < 256; ++r) {
                const glm::vec3 d = scene::row_direction(at.n, r, 256, 5);
                open_sky += kPi * world.sky(d) / 256.0f;
            }
            for (int r = 0; r < 64 && asked < 16; ++r) {
                const glm::vec3 d = scene::row_direction(at.n, (r * 37) % 64, 64, 9);
                if (d.y <= 0.0f) continue;
                ++asked;
                seen += street.tracer.blocked({at.x + at.n * 0.002f, d}) ? 0 : 1;
            }
            const float open =
                asked > 0 ? static_cast<float>(seen) / static_cast<float>(asked) : 1.0f;
            const float hidden = c.snow ? 0.47f : 0.22f;
            today[i] = static_cast<double>(open_sky * (open + (1.0f - open) * hidden) *
                                           bounced(rho, world.open(at, 0.7f, 128)));
        }
        for (const auto& [name, got] : {std::pair("before", &today), std::pair("patches", &plain),
                                        std::pair("with ratio", &ratio)}) {
            const Errors e = errors_of(*got, wanted);
            std::printf("  %-14s %8.3f %8.3f %8.3f %8.3f   %s\n", c.name, e.rmse, e.bias, e.median,
                        e.log2, name);
        }
        print_worst(world, points, wanted, ratio);
        // Other points and rays have other errors.
        if (count == 200 && number_of("PETRICHOR_QUALITY_SET", 0) == 0 && number_of("PETRICHOR_QUALITY_SEED", 1) == 1) {
            EXPECT_LT(errors_of(ratio, wanted).rmse, c.most_rmse) << c.name;
        }
        EXPECT_LT(errors_of(ratio, wanted).rmse, errors_of(today, wanted).rmse) << c.name;
    }
}

// What a screen shows of radiances whose mean luminance is `mean`: a grey of .18 for it, sRGB.
glm::vec3 shown(glm::vec3 radiance, float mean)
{
    glm::vec3 out;
    for (int k = 0; k < 3; ++k)
        out[k] = shared::srgb_encode(std::clamp(radiance[k] * 0.18f / mean, 0.0f, 1.0f));
    return out;
}

double decibels(const std::vector<glm::vec3>& got, const std::vector<glm::vec3>& wanted)
{
    double square = 0.0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        const glm::vec3 d = got[i] - wanted[i];
        square += static_cast<double>(glm::dot(d, d));
    }
    return -10.0 * std::log10(std::max(square / (3.0 * static_cast<double>(got.size())), 1e-12));
}

// A picture of what a camera sees, direct light as it is: with the light of the path tracer, of
// patches, and with none between surfaces but a constant. Pixels of the sky are left out.
TEST(TransportQuality, PicturesComeNearAPathTracers)
{
    const Street street;
    const int width = number_of("PETRICHOR_QUALITY_WIDTH", 64), height = width * 9 / 16;
    const int paths = number_of("PETRICHOR_QUALITY_PATHS", 96);
    const char* keep = std::getenv("PETRICHOR_QUALITY_KEEP");
    const scene::Camera& camera = street.scene.cameras.at(0);
    const glm::vec2 half = scene::half_extent_m(camera, 16, 9);
    const glm::mat4& m = camera.to_world;
    std::printf("  %-14s %8s %8s   (%d x %d, %d paths)\n", "", "patches", "before", width, height,
                paths);
    for (const Conditions& c : all_conditions()) {
        const World world{street, c};
        const PatchWorld on_patches(world);
        const auto pixels = static_cast<std::size_t>(width * height);
        struct Pixel {
            bool surface = false;
            glm::vec3 wanted{0.0f}, patches{0.0f}, before{0.0f};
        };
        std::vector<Pixel> pixel(pixels);
        const float constant = c.snow ? 0.47f : 0.22f;
        parallel_for(pixels, 0, [&](std::size_t i) {
            const auto px = static_cast<int>(i) % width, py = static_cast<int>(i) / width;
            const float u =
                2.0f * (static_cast<float>(px) + 0.5f) / static_cast<float>(width) - 1.0f;
            const float v =
                1.0f - 2.0f * (static_cast<float>(py) + 0.5f) / static_cast<float>(height);
            const glm::vec3 d = glm::normalize(-glm::vec3(m[2]) + glm::vec3(m[0]) * (u * half.x) +
                                               glm::vec3(m[1]) * (v * half.y));
            const scene::RayHit hit = street.tracer.nearest({glm::vec3(m[3]), d});
            if (!hit.hit()) return;
            glm::vec3 n = street.triangles.normal(hit.triangle);
            if (hit.back) n = -n;
            const Point at{street.triangles.point(hit.triangle, hit.at), n};
            const glm::vec3 albedo = world.albedo(hit.triangle, hit.at, n);
            const glm::vec3 direct = world.direct(at.x, n);
            const glm::vec3 glow = world.glow(hit.triangle, hit.at, at.x);
            const auto found = scene::light_at(on_patches.lit, at.x, n);
            const glm::vec3 light = found.irradiance * occlusion_factor(world, at, found);
            glm::vec3 open_sky(0.0f);
            for (int r = 0; r < 64; ++r)
                open_sky += glm::vec3(kPi * world.sky(scene::row_direction(n, r, 64, 5)) / 64.0f);
            int seen = 0, asked = 0;
            for (int r = 0; r < 64 && asked < 16; ++r) {
                const glm::vec3 way = scene::row_direction(n, (r * 37) % 64, 64, 9);
                if (way.y <= 0.0f) continue;
                ++asked;
                seen += street.tracer.blocked({at.x + n * World::scene_lift, way}) ? 0 : 1;
            }
            const float open =
                asked > 0 ? static_cast<float>(seen) / static_cast<float>(asked) : 1.0f;
            const float rho = c.snow && n.y > 0.5f ? 0.9f : 0.2f;
            const glm::vec3 sky_alone = open_sky * ((open + (1.0f - open) * constant) *
                                                    bounced(rho, world.open(at, 0.7f, 128)));
            pixel[i].surface = true;
            pixel[i].wanted =
                glow + albedo / kPi *
                           (direct + world.irradiance(at, static_cast<std::uint64_t>(i), paths));
            pixel[i].patches = glow + albedo / kPi * (direct + light);
            pixel[i].before = glow + albedo / kPi * (direct + sky_alone);
        });
        float mean = 0.0f;
        int surfaces = 0;
        for (const Pixel& p : pixel) {
            if (!p.surface) continue;
            mean += luminance(p.wanted);
            ++surfaces;
        }
        mean = std::max(mean / static_cast<float>(surfaces), 1e-9f);
        std::vector<glm::vec3> wanted, patches, before;
        std::vector<std::uint8_t> both(2 * 3 * pixels);  // the path tracer's on the left
        for (std::size_t i = 0; i < pixels; ++i) {
            const Pixel& p = pixel[i];
            const auto px = static_cast<int>(i) % width, py = static_cast<int>(i) / width;
            const glm::vec3 left = shown(p.wanted, mean), right = shown(p.patches, mean);
            for (int k = 0; k < 3; ++k) {
                const auto to = static_cast<std::size_t>((py * 2 * width + px) * 3 + k);
                both[to] = static_cast<std::uint8_t>(left[k] * 255.0f + 0.5f);
                both[to + 3 * static_cast<std::size_t>(width)] =
                    static_cast<std::uint8_t>(right[k] * 255.0f + 0.5f);
            }
            if (!p.surface) continue;
            wanted.push_back(left);
            patches.push_back(right);
            before.push_back(shown(p.before, mean));
        }
        const double db = decibels(patches, wanted), db_before = decibels(before, wanted);
        std::printf("  %-14s %8.1f %8.1f dB\n", c.name, db, db_before);
        if (keep && *keep) {
            texproc::write_png8(std::string(keep) + "/" + c.name + ".png", 2 * width, height, 3,
                                both);
        }
        EXPECT_GT(db, db_before) << c.name;
    }
}

}  // namespace
}  // namespace petrichor::film
