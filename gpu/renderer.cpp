#include "gpu/passes/own_moves/own_moves.h"
#include "gpu/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "gpu/build_frame.h"
#include "gpu/check_frame.h"
#include "gpu/frame/metering.h"
#include "gpu/icicles/icicle_body.h"
#include "gpu/lighting/models_io.h"
#include "gpu/snow/frame_tracks.h"
#include "gpu/snow/snow_body.h"
#include "gpu/surface_path.h"
#include "gpu/upload/draw.h"
#include "scene/light_shape.h"

namespace petrichor::gpu {

namespace {

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

// How often a pixel of the frame may go over its lights, whatever of the scene is in view.
std::size_t light_walks(const FrameSettings& settings, const GpuScene& scene)
{
    const bool split = std::any_of(settings.aovs.begin(), settings.aovs.end(), [](const std::string& name) { return takes_light_apart(aov_row(name)); });
    bool gathers = false, left_alone = false;
    for (const GpuMaterial& material : scene.materials()) {
        gathers = gathers || (settings.light_prepass && scene.lighting_models().gathers(material.lighting_model));
        left_alone = left_alone || material.lighting_model == LIGHTING_MODEL_UNLIT_SHADOWED;
    }
    return 1u + (split ? 1u : 0u) + (gathers ? 2u : 0u) + (left_alone ? 2u : 0u);
}

}  // namespace

// Of how many pictures, the small ones that are metered too, pipelines are kept. A film through weather asks for others all
// the time, and a CPU's driver takes 4 MiB for each.
constexpr std::uint64_t kPicturesKept = 8;

// Images of one frame size; they die before their memory.
struct TargetSet {
    explicit TargetSet(const Device& device) : arena(std::make_unique<MemoryArena>(device)) {}
    std::unique_ptr<MemoryArena> arena;
    FrameTargets targets;
    int words = 0;
    std::unique_ptr<MemoryArena> resolve_arena;
    ResolveTables resolve;
    std::unique_ptr<MemoryArena> transparent_arena;
    TransparentTargets transparent;
    int transparent_words = 0;
    std::unique_ptr<MemoryArena> decal_arena;
    DecalTargets decals;
    std::unique_ptr<MemoryArena> parts_arena;
    LightParts parts;
    int parts_width = 0, parts_height = 0;
    std::unique_ptr<MemoryArena> adaptive_arena;
    AdaptiveTargets adaptive;
};

struct Renderer::Impl {
    Impl(const RendererOptions& options, const WeatherMaps& weather_maps)
        : device(options),
          pipelines(device),
          descriptors(device),
          shared_arena(device),
          surface_maps(device, shared_arena, options.ripple_texture_size, weather_maps),
          depth_maps(device, shared_arena),
          light_tables(device),
          lamp_shadows(device),
          sky(device, shared_arena),
          lamp_glow(device),
          falling(device),
          splashes(device),
          patches(device),
          probes(device),
          pictures(device),
          metering(device),
          place(device),
          triangles(device),
          vertex_light(device),
          light_arena(std::make_unique<MemoryArena>(device)),
          environment_arena(std::make_unique<MemoryArena>(device))
    {
        const VkDeviceSize alignment = device.limits().minUniformBufferOffsetAlignment;
        constants_stride = (sizeof(shared::FrameConstants) + alignment - 1) / alignment * alignment;
        constants = shared_arena.buffer({.name = "frame_constants",
                                         .size = constants_stride * kMaxSamples,
                                         .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                         .host = true});
    }

    // exposure: as of least_lux().
    LightFacts prepare_lights(const Frame& frame, const Frame& whole, const Sun& by_day, const Light* sun, float exposure)
    {
        LightFacts facts{.direct = by_day.kind, .towards = by_day.direction, .lux = by_day.illuminance};
        std::vector<Light> lights;
        lights.reserve(scene->lights().size() + scene->glows().size() + frame.extra_lights.size());
        for (const Light& light : scene->lights()) {
            if (&light == sun || (light.kind == LightKind::Directional && frame.sky.analytic_sun)) {
                continue;
            }
            lights.push_back(light);
            if (light.kind != LightKind::Directional) {
                lights.back().intensity *= frame.scene_light_scale;
            }
            if (lights.back().intensity <= 0.0f) lights.pop_back();
        }
        for (const Light& glow : scene->glows()) {
            if (!frame.emissive_lights || frame.emissive_scale <= 0.0f) break;
            lights.push_back(glow);
            lights.back().intensity *= frame.emissive_scale;
            ++facts.glowing;
        }
        lights.insert(lights.end(), frame.extra_lights.begin(), frame.extra_lights.end());
        facts.lamps = lights.size();
        // Where vertices do not wait for them such lamps light pixels, and are mirrored as little.
        for (Light& light : lights) {
            if (!scene::lit_by_vertex(light) || scene->vertex_lamps()) continue;
            light.per_vertex = false;
            light.specular = 0.0f;
        }
        light_table = {};
        light_arena = std::make_unique<MemoryArena>(device);
        LightTableParams params{.shadows = frame.settings.shadows ? frame.settings.lamp_shadows : 0,
                                .eye_m = glm::vec3(frame.camera.to_world[3]),
                                .area = frame.settings.area_lights,
                                .least_lux = least_lux(frame.settings, exposure)};
        // Other eyes of a lens or a shutter see more.
        if (frame.lens.radius_m <= 0.0f && frame.shutter.empty()) {
            const shared::FrameConstants c = frame_constants(whole, by_day, scene->bounds(), 0);
            params.in_view = [frustum = Frustum(c.world_to_clip), eye_m = c.camera_m,
                              angle = c.pixel_angle](const glm::vec3& centre_m, float radius_m) {
                // Samples are moved by less than a pixel.
                const float pixel_m = angle * std::max(1.0f, glm::length(centre_m - eye_m));
                return frustum.touches(centre_m, radius_m + pixel_m);
            };
        }
        light_table = make_light_table(device, *light_arena, lights, params);
        vertex_light.prepare(scene->draws(), light_table, params.in_view);
        check_light_lists(device.limits(), light_table.count, frame.settings.width, frame.settings.height);
        const std::size_t walks = light_walks(frame.settings, *scene);
        if (light_table.count * walks > kLightsAnywhere) {
            std::vector<shared::FrameConstants> views;
            const bool one = params.in_view != nullptr;
            for (int i = 0; i < (one ? 1 : frame.settings.samples); ++i)
                views.push_back(frame_constants(frame, by_day, scene->bounds(), static_cast<std::uint32_t>(i)));
            check_light_crowd(light_table, frame.settings, views, walks);
        }
        return facts;
    }

    // The linear scale of the frame's display; behind the sky's passes, where it is by the light that falls in.
    float exposure_of(const Frame& frame) const
    {
        const FrameSettings& s = frame.settings;
        if (s.exposure > 0.0f) return s.exposure * std::exp2(s.exposure_bias_stops);
        shared::SkyLight light{};
        std::memcpy(&light, sky.light->mapped, sizeof(light));
        return light.exposure;
    }

    void prepare_targets(TargetSet& set, const FrameSettings& s,
                         const std::vector<AovGroup>& aov_groups)
    {
        FrameTargets& targets = set.targets;
        const int words = static_cast<int>(light_table.words());
        if (targets.width != s.width || targets.height != s.height || words > set.words) {
            targets = {};
            set.arena = std::make_unique<MemoryArena>(device);
            targets = make_frame_targets(device, *set.arena, s.width, s.height, words);
            set.words = words;
        }
        if (s.ambient_occlusion && s.bent_normals && !targets.keeps_bent) make_occlusion(targets, *set.arena, true);
        const auto pixels =
            static_cast<VkDeviceSize>(s.width) * static_cast<VkDeviceSize>(s.height);
        if (s.exposed_light && targets.display->size < pixels * 8)
            targets.display = set.arena->buffer({.name = "display",
                                                 .size = pixels * 8,
                                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                 .host = true});
        for (std::size_t i = 0; i < aov_groups.size(); ++i) {
            const VkDeviceSize size = aov_groups[i].numbers * pixels * sizeof(float);
            if (i >= targets.aovs.size()) targets.aovs.emplace_back();
            if (targets.aovs[i] && targets.aovs[i]->size >= size) continue;
            targets.aovs[i] = set.arena->buffer({.name = "aov", .size = size, .host = true});
        }
    }

    // Snow and icicles as they are in the frame.
    void lay_over(const Frame& frame)
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

    // True when surfaces of users' own have moved something.
    bool move_own(const Frame& frame, double time_s, bool posed)
    {
        if (!own_moves) return false;
        shared::FrameConstants now{};
        now.time_s = static_cast<float>(time_s);
        now.weather = frame.weather;
        now.look = frame.look;
        return own_moves->move(device, pipelines, descriptors, *scene, now, posed);
    }

    // True when this frame resolves a visibility buffer; its tables are then made for its size.
    bool prepare_resolve(TargetSet& set, const Frame& frame, const FrameSettings& whole)
    {
        const FrameSettings& s = frame.settings;
        ResolveTables& resolve = set.resolve;
        if (chosen_surface_path(s.surface_path, device, *scene, whole.width, whole.height,
                                is_adaptive(frame)) != SurfacePath::Visibility) {
            return false;
        }
        const bool shares = scene->layer_shares();
        if (!resolve.ids || resolve.ids->width != s.width || resolve.ids->height != s.height ||
            (shares && (resolve.shares->width != s.width || resolve.shares->height != s.height))) {
            resolve = {};
            set.resolve_arena = std::make_unique<MemoryArena>(device);
            resolve = make_resolve_tables(device, *set.resolve_arena, *scene, s.width, s.height);
        }
        update_draws(device, resolve, *scene);
        return true;
    }

    // True when this frame blends what lets light through in layers.
    bool prepare_transparent(TargetSet& set, const FrameSettings& s)
    {
        const auto& materials = scene->materials();
        const bool any = std::any_of(materials.begin(), materials.end(),
                                     [](const GpuMaterial& m) { return m.blended; });
        if (!any || s.transparent_layers == 0) return false;
        const int words = static_cast<int>(light_table.words());
        const FrameTargets& now = set.transparent.layer;
        const bool bends = std::any_of(materials.begin(), materials.end(), [](const GpuMaterial& m) { return m.bends; });
        if (now.width != s.width || now.height != s.height || words > set.transparent_words || (bends && !set.transparent.bends)) {
            set.transparent = {};
            set.transparent_arena = std::make_unique<MemoryArena>(device);
            set.transparent = make_transparent_targets(device, *set.transparent_arena, s.width,
                                                       s.height, words, bends);
            set.transparent_words = words;
        }
        return true;
    }

    // True when the scene has decals; their targets are then made for the frame's size.
    bool prepare_decals(TargetSet& set, const FrameSettings& s)
    {
        if (scene->decals().empty()) return false;
        const GpuImage* now = set.decals.color.get();
        if (!now || now->width != s.width || now->height != s.height) {
            set.decals = {};
            set.decal_arena = std::make_unique<MemoryArena>(device);
            set.decals = make_decal_targets(*set.decal_arena, s.width, s.height);
        }
        return true;
    }

    void prepare_parts(TargetSet& set, const FrameSettings& s, const std::vector<std::size_t>& rows,
                       bool layered, bool adaptive)
    {
        if (!set.parts_arena || set.parts_width != s.width || set.parts_height != s.height) {
            set.parts = {};
            set.parts_arena = std::make_unique<MemoryArena>(device);
            set.parts_width = s.width;
            set.parts_height = s.height;
        }
        prepare_light_parts(set.parts, *set.parts_arena, rows, s.width, s.height, layered,
                            adaptive);
    }

    // True when later samples go by what the first two saw; the targets are then made for the frame's size.
    bool prepare_adaptive(TargetSet& set, const Frame& frame)
    {
        if (!is_adaptive(frame)) return false;
        const FrameSettings& s = frame.settings;
        const GpuImage* now = set.adaptive.seen.get();
        if (!now || now->width != s.width || now->height != s.height) {
            set.adaptive = {};
            set.adaptive_arena = std::make_unique<MemoryArena>(device);
            set.adaptive = make_adaptive_targets(*set.adaptive_arena, s.width, s.height);
        }
        return true;
    }

    /// `whole`: of the picture that the frame is a window of; else the frame itself.
    /// around: beyond the window; kept: where this frame is kept as one.
    RenderResult render(const Frame& frame, const Frame& whole, TargetSet& set, PictureAround* around = nullptr,
                        PictureAround* kept = nullptr);

    Device device;
    PipelineCache pipelines;
    DescriptorArena descriptors;
    MemoryArena shared_arena;
    std::unique_ptr<GpuBuffer> constants;
    VkDeviceSize constants_stride = 0;
    SurfaceMaps surface_maps;
    DepthMaps depth_maps;
    LightTables light_tables;
    LampShadows lamp_shadows;
    SkyMaps sky;
    LampGlow lamp_glow;
    FallingTable falling;
    std::shared_ptr<const std::vector<scene::DripPoint>> drips;
    FallingTable splashes;
    PatchLights patches;
    ProbeTable probes;
    TargetSet pictures;  ///< of the frames that are asked for
    TargetSet metering;  ///< of the small ones that tell their exposure
    bool metering_ended = false;  ///< before the next picture
    GpuPlace place;
    SeenTriangles triangles;
    VertexLight vertex_light;
    std::unique_ptr<MemoryArena> light_arena;
    LightTable light_table;
    std::unique_ptr<MemoryArena> environment_arena;
    std::unique_ptr<GpuImage> environment;
    std::unique_ptr<GpuScene> scene;
    std::unique_ptr<OwnMoves> own_moves;  // null: nothing is moved by them
    std::unique_ptr<SnowBody> snow;
    std::unique_ptr<IcicleBody> icicles;
    std::vector<scene::DripPoint> tips;  // where icicles drip, in place of `drips`
    FrameTracks tracks;
    std::uint32_t falls_before = 0;
    bool own_lighting = false;
    std::string graph_text;
};

Renderer::Renderer(const RendererOptions& options, const WeatherMaps& weather_maps)
    : impl_(std::make_unique<Impl>(options, weather_maps))
{
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::load(const Scene& scene, const std::vector<Texture>& textures,
                    std::shared_ptr<const scene::SnowCaps> snow, std::shared_ptr<const scene::Icicles> icicles)
{
    for (TargetSet* set : {&impl_->pictures, &impl_->metering}) set->resolve = {};
    impl_->scene = nullptr;
    impl_->patches.load(nullptr);
    impl_->drips = nullptr;
    impl_->triangles.forget();
    impl_->depth_maps.forget();
    impl_->lamp_shadows.forget();
    impl_->light_tables.load(scene.light_profiles);
    impl_->snow = snow && !snow->empty() ? std::make_unique<SnowBody>(std::move(snow)) : nullptr;
    impl_->icicles = icicles && !icicles->empty() ? std::make_unique<IcicleBody>(std::move(icicles)) : nullptr;
    impl_->tips.clear();
    impl_->own_moves = nullptr;
    const Overlay none;
    const Overlay& white = impl_->snow ? impl_->snow->overlay() : none;
    impl_->scene = std::make_unique<GpuScene>(impl_->device, scene, textures,
                                              impl_->icicles ? joined(white, impl_->icicles->overlay()) : white);
    auto own_lighting = impl_->scene->lighting_models().compile_lighting();
    impl_->own_lighting = !own_lighting.empty();
    if (impl_->own_lighting)
        impl_->pipelines.add_shader(kOwnLightingShader, std::move(own_lighting));
    auto own_surfaces = impl_->scene->own_surfaces().compile_resolve();
    auto own_moves = impl_->scene->own_surfaces().compile_move();
    if (!impl_->scene->own_movers().empty()) {
        impl_->pipelines.add_shader(kOwnMoveShader, std::move(own_moves));
        impl_->own_moves = std::make_unique<OwnMoves>(impl_->device, *impl_->scene);
    }
    const bool shapes = !impl_->scene->shapes().empty();
    if ((!own_surfaces.empty() || shapes) &&
        chosen_surface_path(SurfacePath::Auto, impl_->device, *impl_->scene, 1, 1, false) != SurfacePath::Visibility) {
        throw Error("surface: this device cannot number triangles or fetch their corners, which " +
                        std::string(shapes ? "marched shapes" : "surfaces of one's own") + " need",
                    "Leave `surface` out of the materials and [shapes] out of the scenario, or choose another "
                    "--device.");
    }
    if (!own_surfaces.empty()) {
        impl_->pipelines.add_shader(kOwnResolveShader, std::move(own_surfaces));
        const auto& materials = impl_->scene->materials();
        if (std::any_of(materials.begin(), materials.end(),
                        [](const GpuMaterial& m) { return m.blended && m.own_surface != 0; })) {
            impl_->pipelines.add_shader(kOwnTransparentShader, impl_->scene->own_surfaces().compile_transparent(impl_->scene->baked()));
        }
    }
}

void Renderer::set_patches(std::shared_ptr<const PatchScene> patches)
{
    impl_->patches.load(std::move(patches));
}

void Renderer::set_drips(std::shared_ptr<const std::vector<scene::DripPoint>> drips)
{
    impl_->drips = std::move(drips);
}

void Renderer::set_tracks(std::shared_ptr<const TrackSource> source)
{
    impl_->tracks.set(std::move(source));
}

void Renderer::set_environment(const EnvironmentMap& map)
{
    if (map.rgb.empty() && !impl_->environment) return;
    impl_->environment = nullptr;
    impl_->sky.drawn_valid = false;
    impl_->environment_arena = std::make_unique<MemoryArena>(impl_->device);
    if (map.rgb.empty()) return;
    impl_->environment = impl_->environment_arena->image(
        {.name = "environment",
         .format = VK_FORMAT_R32G32B32A32_SFLOAT,
         .width = map.width,
         .height = map.height,
         .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    std::vector<std::byte> texels(map.rgb.size() / 3 * 16);
    for (std::size_t i = 0; i < map.rgb.size() / 3; ++i) {
        const float rgba[4] = {map.rgb[3 * i], map.rgb[3 * i + 1], map.rgb[3 * i + 2], 1.0f};
        std::memcpy(texels.data() + i * 16, rgba, 16);
    }
    upload_image(impl_->device, *impl_->environment, {texels});
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

RenderResult Renderer::render(const Frame& frame)
{
    check_frame(frame, impl_->device.limits());
    if (!impl_->scene) throw Error("render: no scene is loaded", "Call load() before render().");
    return impl_->render(frame, frame, impl_->pictures);
}

std::shared_ptr<PictureAround> Renderer::look_around(const Frame& frame)
{
    const FrameSettings& s = frame.settings;
    if (!s.reflections || !s.image_based_light || frame.camera.orthographic_height_m > 0.0f) return nullptr;
    const Frame small = around_frame(frame);
    check_frame(small, impl_->device.limits());
    if (!impl_->scene) throw Error("render: no scene is loaded", "Call load() before look_around().");
    auto around = std::make_shared<PictureAround>(impl_->device, small.settings.width, small.settings.height);
    impl_->render(small, small, impl_->pictures, nullptr, around.get());
    return around;
}

RenderResult Renderer::render(const Frame& frame, const PictureTile& tile, const std::shared_ptr<PictureAround>& around)
{
    if (tile.x % kTileStep != 0 || tile.y % kTileStep != 0) {
        throw Error("render: a window at " + std::to_string(tile.x) + ", " + std::to_string(tile.y),
                    "Let it begin at multiples of " + std::to_string(kTileStep) + " pixels.");
    }
    const Frame part = tile_frame(frame, tile);
    check_frame(part, impl_->device.limits());
    if (!impl_->scene) throw Error("render: no scene is loaded", "Call load() before render().");
    return impl_->render(part, frame, impl_->pictures, around.get());
}

MeterReading Renderer::meter(const Frame& frame, MeterOf what)
{
    const Frame small = metering_frame(frame, what);
    check_frame(small, impl_->device.limits());
    if (!impl_->scene) throw Error("render: no scene is loaded", "Call load() before meter().");
    const RenderResult result = impl_->render(small, small, impl_->metering);
    // Of the sky of a picture nothing is known.
    const bool computed = !impl_->environment && frame.sky.analytic_sun;
    const std::vector<float>& snow = result.aovs.front().pixels;
    MeterReading reading;
    reading.ev100 = metered_ev100(result.beauty, snow, computed ? frame.sky.cloud_cover : 1.0f, frame.weather.rain);
    if (what == MeterOf::ExposureAndLight) {
        reading.light = metered_light({.scattered_direct = result.aovs[2].pixels,
                                       .scattered_indirect = result.aovs[3].pixels,
                                       .base_color = result.aovs[1].pixels,
                                       .snow = snow});
    }
    return reading;
}

void Renderer::end_metering()
{
    impl_->metering = TargetSet(impl_->device);
    impl_->metering_ended = true;
}

const DeviceInfo& Renderer::device() const
{
    return impl_->device.info();
}

const std::vector<std::string>& Renderer::validation_messages() const
{
    return impl_->device.validation_messages();
}

std::string Renderer::describe_graph() const
{
    return impl_->graph_text;
}

}  // namespace petrichor::gpu
