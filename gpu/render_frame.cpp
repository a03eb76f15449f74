// From a frame to its picture: what moves and lies, the sky, lamps, then the passes of all samples.
#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "gpu/renderer_impl.h"

namespace petrichor::gpu {

namespace {

// Of how many pictures, the small ones that are metered too, pipelines are kept. A film through weather asks for others all
// the time, and a CPU's driver takes 4 MiB for each.
constexpr std::uint64_t kPicturesKept = 8;

// A range for each moment at which the scene is another.
std::vector<SampleRange> sample_ranges(const Frame& frame, const GpuScene& scene)
{
    const auto count = static_cast<std::uint32_t>(frame.settings.samples);
    std::vector<SampleRange> ranges{{0, count}};
    if (!scene.moves() || frame.shutter.empty()) return ranges;
    ranges.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool same = i > 0 && frame.shutter[i].off_s == frame.shutter[i - 1].off_s;
        if (same) {
            ranges.back().end = i + 1;
        } else {
            ranges.push_back({i, i + 1});
        }
    }
    return ranges;
}

}  // namespace

void Renderer::Impl::lay_over(const Frame& frame)
{
    const bool white = snow && snow->lay(frame, tracks);
    const bool ice = icicles && icicles->lay(frame);
    if (!white && !ice) return;
    if (icicles) {
        const Overlay none;
        const JoinedOverlay both(snow ? snow->overlay() : none, snow ? snow->laid() : LaidOverlay{}, icicles->overlay(), icicles->laid());
        scene->lay(device, both.laid());
        tips.clear();
        if (drips && !icicles->laid().vertices.empty()) tips = icicles->tips(*drips);
    } else {
        scene->lay(device, snow->laid());
    }
    depth_maps.shadow_valid.fill(false);
}

bool Renderer::Impl::move_own(const Frame& frame, double time_s, bool posed)
{
    if (!own_moves) return false;
    shared::FrameConstants now{};
    now.time_s = static_cast<float>(time_s);
    now.weather = frame.weather;
    now.look = frame.look;
    return own_moves->move(device, pipelines, descriptors, *scene, now, posed);
}

RenderResult Renderer::Impl::render(const Frame& frame, const Frame& whole, TargetSet& set, PictureAround* around,
                                    PictureAround* kept)
{
    std::vector<std::size_t> aov_rows;
    for (const std::string& name : frame.settings.aovs) aov_rows.push_back(aov_row(name));
    const std::vector<AovGroup> aov_groups =
        group_aovs(aov_rows,
                   static_cast<std::size_t>(frame.settings.width) *
                       static_cast<std::size_t>(frame.settings.height),
                   device.limits().maxStorageBufferRange);

    const bool moved = scene->pose(
        device, frame.animation_s,
        {frame.weather.wind_m_s, frame.falling.air_m, frame.settings.time_s});
    const bool switched = scene->choose_levels(whole.camera, frame.settings.lod_scale);
    const bool reshaped = scene->set_shapes(frame.shapes);
    const bool changed = scene->set_materials(frame.materials);
    const bool washed = move_own(frame, frame.settings.time_s, moved || changed);
    if (changed || moved || switched || reshaped || washed) {
        depth_maps.forget();
        lamp_shadows.forget();
    }
    if (tracks.tread(frame.settings.time_s)) surface_maps.set_tracks(device, *tracks.map());
    lay_over(frame);
    const Light* scene_sun = nullptr;
    if (!frame.sky.analytic_sun) {
        for (const Light& light : scene->lights()) {
            if (light.kind == LightKind::Directional) {
                scene_sun = &light;
                break;
            }
        }
    }
    const Sun sun = sun_of(frame.sky, scene_sun, environment != nullptr);
    place.update(device, frame.place.get());
    descriptors.reset();

    FrameResources resources;
    resources.device = &device;
    resources.whole = &whole;
    resources.around = around;
    resources.kept = kept;
    resources.scene = scene.get();
    resources.targets = &set.targets;
    resources.surface_maps = &surface_maps;
    resources.depth_maps = &depth_maps;
    resources.light_tables = &light_tables;
    resources.lamp_shadows = &lamp_shadows;
    resources.sky = &sky;
    resources.lights = &light_table;
    resources.vertex_light = &vertex_light;
    resources.lamp_glow = &lamp_glow;
    resources.triangles = &triangles;
    resources.falling = &falling;
    resources.splashes = &splashes;
    if (drips) resources.drips = tips.empty() ? std::span<const scene::DripPoint>(*drips) : tips;
    resources.patches = &patches;
    resources.probes = &probes;
    resources.place = &place;
    resources.snow_lift_m = snow ? snow->lift_m() : 0.0f;
    resources.over_snow = snow && snow->lies_below(glm::vec3(frame.camera.to_world[3]));
    resources.environment = environment.get();
    // The sky first: how far lamps reach, and what patches send each other, depend on it.
    FrameGraph before = build_sky(frame, sun, resources);
    RenderResult result;
    result.passes = before.execute(device, pipelines, descriptors);
    graph_text = before.describe();
    if (uses_patches(frame, resources)) {
        Sun through = sun;  // what a cookie lets through of it
        if (frame.sun_cookie.first_texel >= 0) through.illuminance *= frame.sun_cookie.mean;
        patches.relight(frame, through, scene_sun, scene->lights());
        result.passes.push_back({"patch_light", patches.relight_ms()});
        result.patch_light_cpu_ms = patches.relight_cpu_ms();
        probes.relight(patches);
        if (probes.count() > 0) result.passes.push_back({"probes", probes.relight_ms()});
    }
    const float exposure = exposure_of(frame);
    result.light = prepare_lights(frame, whole, sun, scene_sun, exposure);
    prepare_targets(set, frame.settings, aov_groups);
    if (prepare_resolve(set, frame, whole.settings)) resources.resolve = &set.resolve;
    if (resources.resolve && prepare_adaptive(set, frame)) resources.adaptive = &set.adaptive;
    if (prepare_transparent(set, frame.settings)) resources.transparent = &set.transparent;
    if (prepare_decals(set, frame.settings)) resources.decals = &set.decals;
    prepare_parts(set, frame.settings, aov_rows, resources.transparent != nullptr,
                  resources.adaptive != nullptr);
    resources.parts = &set.parts;
    resources.materials = std::any_of(aov_rows.begin(), aov_rows.end(), needs_materials);
    if (icicles && !icicles->laid().vertices.empty()) {
        resources.ice_model = scene->layered_model(icicles->material());
        make_ice_list(set.targets, *set.arena);
    }
    resources.constants = constants.get();
    resources.constants_stride = constants_stride;
    resources.falls_before = &falls_before;
    resources.own_lighting = own_lighting;
    for (const SampleRange& range : sample_ranges(frame, *scene)) {
        if (range.first > 0) {  // what moves is elsewhere
            descriptors.reset();
            const ShutterMoment& now = frame.shutter[range.first];
            const glm::vec2 wind = frame.weather.wind_m_s;
            scene->pose(device, now.animation_s,
                        {wind, frame.falling.air_m + glm::dvec2(wind) * now.off_s,
                         frame.settings.time_s + now.off_s});
            move_own(frame, frame.settings.time_s + now.off_s, true);
            depth_maps.forget();
            lamp_shadows.forget();
            prepare_lights(frame, whole, sun, scene_sun, exposure);
            prepare_resolve(set, frame, whole.settings);
        }
        triangles.reset(*scene);
        scene->update_draw_rows(device);
        FrameGraph graph = build_frame(frame, sun, resources, aov_groups, range, result.falling);
        graph_text += graph.describe();
        if (std::exchange(metering_ended, false)) {
            pipelines.keep_only(graph.pipelines());
            give_back_free_memory();  // the picture need not make many of its own
        }
        for (const PassTime& pass : graph.execute(device, pipelines, descriptors))
            result.passes.push_back(pass);
    }
    pipelines.end_picture(kPicturesKept);
    result.width = frame.settings.width;
    result.height = frame.settings.height;
    const auto pixels =
        static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    const auto* beauty = reinterpret_cast<const std::uint16_t*>(set.targets.beauty->mapped);
    result.beauty.assign(beauty, beauty + pixels * 4);
    if (frame.settings.exposed_light) {
        const auto* exposed = reinterpret_cast<const std::uint16_t*>(set.targets.display->mapped);
        result.exposed.assign(exposed, exposed + pixels * 4);
    } else {
        const auto* display = reinterpret_cast<const std::uint8_t*>(set.targets.display->mapped);
        result.display.assign(display, display + pixels * 4);
    }
    shared::SkyLight light{};
    std::memcpy(&light, sky.light->mapped, sizeof(light));
    result.exposure = light.exposure;
    for (const std::size_t row : aov_rows) {
        const AovInfo& info = aov_table()[row];
        result.aovs.push_back({info.name, static_cast<int>(info.channels.size()),
                               is_light_part(row) ? read_light_part(set.parts, row, pixels)
                                                  : read_aov(set.targets, aov_groups, row)});
    }
    return result;
}

}  // namespace petrichor::gpu
