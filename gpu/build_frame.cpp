// The frame: which passes run, in which order. Read it as a table of contents.
#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "gpu/build_frame.h"
#include "formulas/weather/drop_births.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/ring_sizes.h"
#include "gpu/build_shadows.h"
#include "gpu/frame/falls.h"
#include "gpu/frame/frame_words_io.h"
#include "gpu/frame/picture_tile.h"
#include "gpu/frame/window_io.h"
#include "gpu/lighting/models_io.h"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion.h"
#include "gpu/passes/background/background.h"
#include "gpu/passes/clear_ice/clear_ice.h"
#include "gpu/passes/falling/splashes.h"
#include "gpu/passes/glare/glare.h"
#include "gpu/passes/lighting/lighting_io.h"
#include "gpu/passes/lights/lights_io.h"
#include "gpu/passes/patch_light/patch_points.h"
#include "gpu/passes/reflections/reflections.h"
#include "gpu/passes/resolve/resolve.h"
#include "gpu/passes/shapes/shapes.h"
#include "gpu/upload/draw.h"
#include "gpu/passes/visibility/visibility.h"

namespace petrichor::gpu {

static_assert(LAMP_SHADOWS_MOST == kMostLampShadows);

bool uses_patches(const Frame& frame, const FrameResources& r)
{
    return frame.settings.patch_light && frame.settings.image_based_light && r.patches->loaded();
}

namespace {

// The lighting models and layers of what may be seen; a pixel around the view counts, since samples are
// jittered.
void see_models(LightingVariant& variant, const GpuScene& scene, const shared::FrameConstants& c, bool prepass)
{
    std::vector<bool>& models = variant.models;
    models.assign(scene.lighting_models().count(), false);
    variant.layers = 0;
    const Frustum frustum(c.world_to_clip);
    for (const Draw& draw : scene.draws()) {
        const GpuMaterial& material = scene.materials()[draw.material];
        const std::uint32_t model = material.lighting_model;
        if (draw.overlay && draw.index_count == 0) continue;
        if (models[model] && (material.layers & ~variant.layers) == 0) continue;
        const float pixel_m =
            c.pixel_angle * std::max(1.0f, glm::length(draw.centre_m - c.camera_m));
        if (frustum.touches(draw.centre_m, draw.radius_m + pixel_m)) {
            models[model] = true;
            variant.layers |= material.layers;
        }
    }
    variant.gathers = false;
    for (std::uint32_t model = 0; prepass && model < models.size(); ++model)
        variant.gathers |= models[model] && scene.lighting_models().gathers(model);
    // Without layers the layered model is the standard one: one text runs instead of both.
    if (models[LIGHTING_MODEL_LAYERED]) models[LIGHTING_MODEL_STANDARD] = false;
}

// Of the drops that draw rings; all are alike as Lux 2.02 has them.
float drop_spread(const Frame& frame)
{
    if (!frame.settings.film_lobe) return 0.0f;
    float rings = 0.0f;
    for (int i = 0; i < shared::kRippleLayers; ++i) {
        rings += shared::ripple_layer(i, frame.weather.rain, 0.0f, frame.look.ripple_speed).weight *
                 shared::ring_births_per_m2_s(i, frame.look.ripple_tiling, frame.look.ripple_speed);
    }
    return shared::ring_drop_spread(frame.weather.rain_kg_m2_s * 3600.0f, rings);
}

// Each is a look-up at every pixel: only those of what may lie there.
std::vector<Fall> falls_of(const Frame& frame, const VisibleWeather& weather)
{
    std::array<glm::vec3, SKY_DIRECTIONS> sky;
    for (int i = 0; i < SKY_DIRECTIONS; ++i) sky[static_cast<std::size_t>(i)] = sky_direction(i);
    const shared::WeatherMoment& w = frame.weather;
    const bool wet = weather.water || w.rain + w.film_albedo + w.film_smoothness > 0.0f;
    const bool white = weather.snow || weather.frost;
    std::vector<Fall> wanted = falls(w, sky);
    std::erase_if(wanted, [&](const Fall& fall) {
        return !(wet && fall.rain > 0.0f) && !(white && fall.snow > 0.0f);
    });
    return wanted;
}

// Pipelines are made for few numbers of directions: a film through rain and snow would ask for each of them, and each
// is a second of compiling for every material.
std::size_t rounded_falls(std::size_t count)
{
    return count == 0 || count == 3 ? count : (count + 1) / 3 * 3 + 1;  // steady rain mostly has three
}
static_assert((SKY_DIRECTIONS + 1) / 3 * 3 + 1 == SKY_DIRECTIONS);

// .. and a renderer that has had rain along four goes on with those pipelines when the wind drops: one look-up more costs
// less than to make them anew, and what falls by no share changes no bit.
std::uint32_t made_for_falls(std::size_t count, std::uint32_t& before)
{
    const auto wanted = static_cast<std::uint32_t>(rounded_falls(count));
    const std::uint32_t made = wanted == 3 && before == 4 ? 4 : wanted;
    if (made > 0) before = made;  // a dry picture in between does not count
    return made;
}

// The weather that pipelines of surfaces are made for: where some snow has begun to gather below frost, those of snow
// with frost do for the few frames before it is seen. Frost stays a kind of its own: its two readings of a map are a
// seventh of the time of a surface in snow.
VisibleWeather made_for(const VisibleWeather& weather, const Frame& frame)
{
    VisibleWeather made = weather;
    made.snow = weather.snow || (weather.frost && frame.weather.snow_depth_m > 0.0f);
    return made;
}

shared::FallConstants fall_constants(const DepthView& view, const glm::vec3& from, const Fall& fall, float lift_m)
{
    // A shelter does not shelter itself: a point is lifted along its normal, and by most of a texel towards the sky.
    glm::mat4 map = view.map_from_world;
    map[3] += map * glm::vec4(from * (view.texel_m * 0.8f), 0.0f);
    const auto row = [&map](int i) { return glm::vec4(map[0][i], map[1][i], map[2][i], map[3][i]); };
    const glm::vec4 middle(0.0f, 0.0f, 0.0f, 0.5f);
    shared::FallConstants c{};
    c.column = row(0) * static_cast<float>(SKY_MAP_SIZE) - middle;
    c.row = row(1) * static_cast<float>(SKY_MAP_SIZE) - middle;
    c.depth = row(2);
    c.lift_m = lift_m;
    c.level = shared::facing_level(from);
    c.rain = fall.rain;
    c.snow = fall.snow;
    c.layer = fall.direction;
    return c;
}

static_assert(kTileStep == WINDOW_STEP);

// Where a window begins in its picture. Both cameras have one eye and way: their middles are apart by their shifts.
glm::ivec2 corner_px(const Frame& whole, const Frame& frame)
{
    const glm::vec2 size(frame.settings.width, frame.settings.height);
    const glm::vec2 picture(whole.settings.width, whole.settings.height);
    const glm::vec2 up(1.0f, -1.0f);
    return glm::ivec2(glm::round(0.5f * (picture - size) + 0.5f * up * (size * frame.camera.shift - picture * whole.camera.shift)));
}

// Where the frame is in the picture that its mirrors see.
shared::MirrorWindow window_of(const Frame& frame, const FrameResources& r)
{
    if (!r.around) return {};
    return mirror_window(*r.around, whole_of(frame, r), corner_px(whole_of(frame, r), frame));
}

void fill_views(shared::FrameConstants& c, const Frame& frame, const Sun& sun, const VisibleWeather& weather,
                const FrameResources& r)
{
    const DepthMaps& maps = *r.depth_maps;
    // One cascade holds all of what is metered: the others end before they begin.
    const bool coarse = frame.settings.coarse_shadows;
    c.shadow_texel_m = maps.shadow_views[coarse ? kCoarseCascade : 0].texel_m;
    for (std::size_t i = 0; i < SHADOW_CASCADES; ++i) {
        c.arrays.shadow_from_world[i] = maps.shadow_views[i].map_from_world;
        c.cascade_scale[static_cast<int>(i)] =
            maps.shadow_views[i].texel_m / std::max(c.shadow_texel_m, 1e-9f);
    }
    c.cascade_scale.w = sun.shadow_strength;
    c.cascade_end_m = glm::vec4(
        coarse ? glm::vec3(-1.0f) : cascade_ends_m(whole_of(frame, r).camera, r.scene->bounds()),
        shared::window_code(corner_px(whole_of(frame, r), frame)));
    c.shelter_from_world = maps.shelter_view.map_from_world;
    if (!maps.sky_valid) c.flags &= ~FRAME_SHELTER;
    for (std::size_t i = 0; i < SKY_DIRECTIONS; ++i) {
        c.arrays.sky_from_world[i] = maps.sky_views[i].map_from_world;
        c.arrays.sky_direction[i] =
            glm::vec4(sky_direction(static_cast<int>(i)), maps.sky_views[i].texel_m);
    }
    std::vector<Fall> falls = falls_of(frame, weather);
    if (!falls.empty()) falls.resize(weather.falls, {falls.back().direction, 0.0f, 0.0f});
    // By a texel and a bit of the coarsest.
    float lift_m = 0.0f;
    for (const Fall& fall : falls) lift_m = std::max(lift_m, maps.sky_views[static_cast<std::size_t>(fall.direction)].texel_m * 1.2f);
    int k = 0;
    for (const Fall& fall : falls) {
        const int i = fall.direction;
        c.arrays.falls[k++] = fall_constants(maps.sky_views[static_cast<std::size_t>(i)], sky_direction(i), fall, lift_m);
    }
    if (weather.place) r.place->set_falls({c.arrays.falls, falls.size()});
    c.ripple_bits = std::bit_width(static_cast<unsigned>(r.surface_maps->ripple->width)) - 1;
    c.flow_bits = std::bit_width(static_cast<unsigned>(r.surface_maps->flow->width)) - 1;
    const TrackMap& tracks = r.surface_maps->track_area;
    if (tracks.width > 0) {
        c.tracks =
            glm::vec4(tracks.corner_m, 1.0f / (tracks.texel_m * static_cast<float>(tracks.width)),
                      1.0f / (tracks.texel_m * static_cast<float>(tracks.height)));
        c.tracks_y_m = {tracks.low_m, tracks.high_m};
    }
    if (r.scene->two_sets()) c.flags |= FRAME_TWO_SETS;
    if (!r.environment) c.flags |= FRAME_LAND;
    if (frame.weather.rain > 0.0f) c.flags |= FRAME_RINGS;
    c.light_tiles = {r.targets->tiles_x(), r.targets->tiles_y()};
    c.coarse_tiles = {r.targets->coarse_x(), r.targets->coarse_y()};
    c.light_count = r.lights->count;
    c.light_words = r.lights->words();
    c.directional_count = r.lights->directional;
    c.shaped_shadows = r.lights->shaped_shadows;
    c.plain_lights = r.lights->plain;
    c.shaped_lights = r.lights->shaped;
    if (uses_patches(frame, r)) {
        c.patches = r.patches->grid();
        if (frame.sky.land_as_ground && r.patches->rim()) c.land = glm::vec4(*r.patches->rim(), 1.0f);
        c.snow_lift_m = r.snow_lift_m;
        // The same radius as PatchScene's `open`.
        c.ao_radius_m = std::min(c.ao_radius_m, 0.5f);
    }
}

// The triangles that the samples of a range may show; they look from one eye, the picture alone is moved.
std::shared_ptr<const SeenDraws> seen_triangles(const Frame& frame, const Sun& sun,
                                                const FrameResources& r, SampleRange range, const VisibleWeather& weather)
{
    const FrameSettings& s = frame.settings;
    const shared::FrameConstants c = frame_constants(frame, sun, r.scene->bounds(), 0);
    SampledView view{c.world_to_clip, s.width, s.height, {}, r.over_snow ? Covered::kFromEye : std::uint8_t{0}, {}, listed_steep(weather)};
    for (std::uint32_t i = range.first; i < range.end; ++i)
        view.offsets.push_back(sample_offset(i, s.seed));
    std::vector<bool> alone(r.scene->draws().size());
    const auto mark = [&](const Draw& draw) {
        alone[static_cast<std::size_t>(&draw - r.scene->draws().data())] = true;
    };
    for (const DrawRun& run : visible_runs(*r.scene, c.world_to_clip, c.camera_m))
        if (run.count == 1) mark(*run.first);
    return r.triangles->list(*r.scene, view, false, [&](const Draw& draw) {
        return alone[static_cast<std::size_t>(&draw - r.scene->draws().data())];
    });
}

FallingPlan plan_of(const Frame& frame, const Sun& sun, const FrameResources& r)
{
    const Frame& whole = whole_of(frame, r);
    return plan_falling(whole, falling_view(frame_constants(whole, sun, r.scene->bounds(), 0), frame.lens, whole.camera.shift));
}

// What is drawn of the whole picture's drops: those of the window, in its pixels.
void keep_window(std::vector<shared::FallingDrop>& drops, const Frame& whole, const Frame& frame)
{
    if (&whole == &frame) return;
    const glm::vec2 size(frame.settings.width, frame.settings.height);
    const glm::vec2 corner(corner_px(whole, frame));
    std::erase_if(drops, [&](shared::FallingDrop& drop) {
        drop.from_px -= corner;
        drop.to_px -= corner;
        const float reach = drop.half_px + glm::length(drop.to_px - drop.from_px) + 64.0f;
        const glm::vec2 middle = 0.5f * (drop.from_px + drop.to_px);
        return middle.x < -reach || middle.y < -reach || middle.x > size.x + reach || middle.y > size.y + reach;
    });
}

FallingFacts falling_facts(const FallingPlan& plan, const Frame& frame)
{
    FallingFacts facts;
    facts.per_m3 = plan.per_m3;
    facts.extinction_per_m = plan.extinction_per_m;
    facts.drawn_reach_m = plan.drawn_reach_m;
    facts.seen = plan.seen;
    facts.visibility_m = frame.weather.visibility_m;
    return facts;
}

// What floats and falls between the eye and the scene, once for all samples.
void add_air(FrameGraph& graph, const Frame& frame, const Sun& sun, const FallingPlan& plan,
             FrameResources& r, const ConstantsRange& constants, FallingFacts& facts)
{
    const FrameSettings& settings = frame.settings;
    const shared::FrameConstants c = frame_constants(frame, sun, r.scene->bounds(), 0);
    const bool glows = r.lamp_glow->prepare(frame, c, r.lights->brightest);
    const bool rains = plan.drawn_reach_m > 0.0f;
    const bool drip = !r.drips.empty() && runs_off_kg_m2_s(frame.weather) > 0.0f;
    const bool falls = rains || drip;
    facts = falling_facts(plan, frame);
    if (falls) {
        const Frame& whole = whole_of(frame, r);
        const FallingView view = falling_view(frame_constants(whole, sun, r.scene->bounds(), 0), frame.lens, whole.camera.shift);
        std::vector<shared::FallingDrop> drops;
        if (rains) drops = falling_drops(plan, whole, view, r.lights->brightest);
        facts.drawn = static_cast<std::uint32_t>(drops.size());
        if (drip) add_drips(drops, drips(r.drips, whole, view, r.lights->brightest));
        keep_window(drops, whole, frame);
        r.falling->fill(drops);
        r.splashes->fill(rains ? falling_splashes(plan, whole, view, r.lights->brightest)
                               : std::vector<shared::FallingSplash>{});
    }
    const auto draw = [&](bool hides) {
        if (glows) add_lamp_glow(graph, *r.targets, *r.lamp_glow, constants);
        if (!falls) return;
        add_falling(graph, *r.targets, *r.depth_maps, *r.sky, *r.falling, *r.splashes, constants,
                    settings.shelter && r.depth_maps->shelter_valid,
                    settings.shadows && sun.illuminance != glm::vec3(0.0f), hides);
    };
    draw(false);
    if (!r.parts->split && !r.parts->label) return;
    // Over black: what it sends, and what it hides of the parts behind.
    clear_light_parts(graph, *r.parts->air);
    std::swap(r.targets->accumulated, r.parts->air);
    draw(true);
    std::swap(r.targets->accumulated, r.parts->air);
    add_light_parts(graph, *r.targets, *r.parts, constants, settings.image_based_light);
}

// What light comes with the surfaces.
std::uint32_t baked_kinds(const GpuScene& scene)
{
    return (scene.light_maps() ? LIGHTING_BAKED_MAPS : 0u) | (scene.vertex_lamps() ? LIGHTING_BAKED_VERTICES : 0u);
}

// What lets light through, over the solid picture: the same passes, on the targets of a layer.
void add_layers(FrameGraph& graph, const Frame& frame, FrameResources& r, const ConstantsRange& constants,
                const shared::FrameConstants& c, const VisibleWeather& weather,
                LightingVariant variant, int layers, bool more)
{
    FrameTargets& layer = r.transparent->layer;
    variant.emission = true;
    variant.baked = baked_kinds(*r.scene);
    variant.fog = false;
    variant.shares = nullptr;
    variant.background = false;
    variant.bent_normals = false;  // near things hide nothing of a layer
    variant.parts = &r.parts->or_none(r.parts->layer);
    variant.pixels = Pixels::All;
    const auto draw = [&](const SurfaceLayer& between) {
        add_surface(graph, layer, *r.scene, *r.surface_maps, *r.depth_maps, *r.place, *r.vertex_light, constants,
                    c.world_to_clip, c.camera_m, weather, Draws::LetLightThrough, &between);
    };
    const auto light = [&] {
        add_gbuffer_rows(graph, layer, {true, true, r.scene->baked()});
        add_tile_lists(graph, layer, constants);
        add_light_lists(graph, layer, *r.lights, constants);
        if (variant.patch_light) add_patch_points(graph, layer, *r.patches, constants);
        add_background(graph, layer, *r.sky, constants, variant);
        add_lighting(graph, layer, *r.scene, *r.lights, *r.light_tables, *r.sky, *r.depth_maps,
                     *r.lamp_shadows, *r.probes, constants, variant);
        if (variant.image_based_light) {
            add_reflections(graph, layer, *r.sky, *r.probes, variant.patch_light, constants,
                            {variant.parts, variant.split, variant.parts, false, variant.mirrors_picture,
                             r.scene->emissive() && r.lights->glows, r.around, window_of(frame, r), r.targets});
        }
    };
    add_transparent(graph, *r.targets, *r.transparent, *r.parts, *r.scene, *r.sky, constants,
                    layers, more, variant.gusts, draw, light);
}

}  // namespace

FrameGraph build_frame(const Frame& frame, const Sun& sun, FrameResources& r,
                       const std::vector<AovGroup>& aov_groups, SampleRange range,
                       FallingFacts& falling)
{
    FrameGraph graph;
    const FrameSettings& settings = frame.settings;
    VisibleWeather weather = visible_weather(frame, r.scene->constant_weather());
    weather.water = weather.water || (r.scene->beads() && frame.weather.film_smoothness > 0.0f);
    // Which material a pixel has is kept with the weather.
    // Shares of two sets lie beside the weather, and light asks for them too.
    const bool weathered =
        weather.any || r.scene->decals_refused() || r.scene->two_sets() || r.scene->point_lamps() || r.scene->unshadowed();
    weather.any = weathered || r.materials;
    const auto time_s = static_cast<float>(settings.time_s);

    if (weather.any && !r.surface_maps->generated) {
        add_surface_map_sources(graph, *r.surface_maps);
        r.surface_maps->generated = true;
    }
    if (weathered) {
        // Nobody asks for rings without rain.
        if (frame.weather.rain > 0.0f)
            add_ripple(graph, *r.surface_maps, frame.weather.rain, time_s, frame.look.ripple_speed, drop_spread(frame));
        add_flow(graph, *r.surface_maps, time_s);
    }
    const FallingPlan plan = plan_of(frame, sun, r);
    add_depth_maps(graph, frame, sun, r, weathered, plan);
    std::vector<int> directions;
    for (const Fall& fall : falls_of(frame, weather)) directions.push_back(fall.direction);
    weather.falls = made_for_falls(directions.size(), *r.falls_before);
    const VisibleWeather made = made_for(weather, frame);
    if (settings.shelter && r.depth_maps->sky_valid) add_depth_quads(graph, *r.depth_maps, directions);
    r.vertex_light->add(graph, *r.scene, *r.lights, *r.light_tables);
    const bool soft_lamps = soft_shadows(frame, r);
    if (!soft_lamps) r.lamp_shadows->add(graph, *r.scene, *r.triangles, r.lights->shadowed);

    // Decals and surfaces of users' own lay snow where the weather has none.
    r.targets->wet_alone = r.resolve && !made.snow && !made.frost && !r.scene->two_sets() && !r.decals && !r.scene->own_surfaces().any();

    LightingVariant variant;
    variant.weather = weathered;
    variant.split = r.parts->split;
    const bool any = settings.any_light;
    variant.sun = any || sun.illuminance != glm::vec3(0.0f);
    variant.background = settings.draw_sky;
    if (!r.environment && frame.sky.skyline_from_m >= 0.0f) variant.skyline_from_m = frame.sky.skyline_from_m;
    variant.shadows = settings.shadows && variant.sun;
    variant.image_based_light = settings.image_based_light;
    variant.mirrors_picture = settings.reflections;
    variant.ambient_occlusion = settings.ambient_occlusion;
    variant.bent_normals = settings.ambient_occlusion && settings.bent_normals;
    variant.patch_light = uses_patches(frame, r);
    variant.emission = r.scene->emissive();
    variant.baked = baked_kinds(*r.scene);
    variant.gamma = settings.gamma;
    variant.lamp_shadows = !r.lights->shadowed.empty();
    variant.soft_lamps = soft_lamps;
    variant.rectangles = r.lights->rectangles;
    variant.ways = r.lights->ways | (r.scene->point_lamps() ? LIGHTS_BY_MATERIAL : 0u) | (frame.sun_cookie.first_texel >= 0 ? LIGHTS_SUN_COOKIE : 0u) |
                   (sun.shadow_strength != 1.0f ? LIGHTS_WEAK_SUN_SHADOW : 0u) | (r.scene->unshadowed() ? LIGHTS_UNSHADOWED : 0u);
    variant.all_lights = settings.all_lights;
    variant.sparkle = any ? weathered : weather.snow && variant.sun && frame.look.snow_sparkle > 0.0f;
    variant.ice = any ? weathered : made.water && frame.weather.water_to_snow > 0.0f;
    variant.snow_scatter = weather.snow && frame.look.snow_scatter_color != glm::vec3(0.0f);
    if (r.resolve && r.scene->layer_shares()) variant.shares = r.resolve->shares.get();
    if (r.own_lighting) variant.shader = kOwnLightingShader;
    ConstantsRange constants{r.constants, 0};
    // Samples that do not see the same points light them each for itself.
    const bool apart = frame.lens.radius_m > 0.0f || !frame.shutter.empty();
    const auto seen = apart ? nullptr : seen_triangles(frame, sun, r, range, weather);
    for (std::uint32_t i = range.first; i < range.end; ++i) {
        shared::FrameConstants c = frame_constants(frame, sun, r.scene->bounds(), i);
        if (soft_sun(frame, sun)) look_from_sun(graph, frame, sun, i, r);
        fill_views(c, frame, sun, weather, r);
        // Other modes of fog know nothing of what falls.
        c.drawn_per_m = frame.fog.mode == FogMode::Metres ? plan.drawn_per_m : 0.0f;
        c.drawn_reach_m = plan.drawn_reach_m;
        if (frame.fog.mode == FogMode::Metres) c.gusts = plan.gusts;
        c.place = r.place->constants();
        if (soft_lamps) look_from_lamps(graph, frame, c, i, r);
        if (i == range.first) {
            see_models(variant, *r.scene, c, frame.settings.light_prepass);
            if ((variant.layers & LAYERS_SKIN) != 0u) r.light_tables->need_skin();
            variant.lazarov = settings.lazarov;
            variant.horizon = settings.horizon_fade > 0.0f;
            variant.grain = settings.anisotropic_dither > 0.0f &&
                            (variant.layers & LAYERS_ANISOTROPY) != 0u;
            variant.fog = c.fog_per_m > 0.0f || c.mist_per_m > 0.0f;
            variant.gusts = any || c.gusts.z > 0.0f;
            variant.film = settings.film_lobe && weathered && (any || c.weather.film_smoothness > 0.0f);
            variant.night =
                settings.draw_sky && sun.analytic && frame.sky.sun_elevation_rad < -0.03f;
        }
        constants.offset = i * r.constants_stride;
        std::memcpy(r.constants->mapped + constants.offset, &c, sizeof(c));

        const int needed = r.transparent ? transparent_layers(*r.scene, c.world_to_clip) : 0;
        const int layers = std::min(needed, settings.transparent_layers);
        const Draws solid = layers > 0 ? Draws::Solid : Draws::All;
        // The solid picture of a sample is lit into an image of its own where layers follow.
        GpuImage& lit = layers > 0 ? *r.transparent->solid : *r.targets->accumulated;
        GpuImage& lit_parts =
            layers > 0 ? r.parts->or_none(r.parts->solid) : r.parts->sum_or_none();
        const bool listed = r.adaptive && i >= 2;
        // The small frame that is metered has one sample, and the same pipelines.
        const bool by_list = settings.adaptive > 0.0f && r.resolve;
        const Pixels pixels = !by_list ? Pixels::All : listed ? Pixels::Listed : Pixels::AllForNow;
        if (by_list && i == range.first) add_all_pixels(graph, *r.targets);
        if (layers > 0) begin_transparent(graph, *r.transparent, *r.parts, constants);
        if (r.resolve) {
            add_visibility(graph, *r.resolve->ids, *r.targets->gbuffer.depth, *r.scene, constants,
                           c.world_to_clip, c.camera_m, weather, *r.resolve->draws, seen, solid);
            add_shapes(graph, *r.resolve->ids, *r.targets->gbuffer.depth, *r.scene, c);
            if (listed) {
                add_ask(graph, *r.targets, *r.resolve, *r.adaptive, lit, constants);
                if (variant.split)
                    add_parts_mean(graph, *r.targets, *r.parts, lit_parts, PARTS_MEAN_TAKE,
                                   r.resolve->asked.get(), constants);
            }
            add_surface_resolve(graph, *r.targets, *r.resolve, *r.scene, *r.surface_maps,
                                *r.depth_maps, *r.place, *r.vertex_light, constants, made, listed);
        } else {
            add_surface(graph, *r.targets, *r.scene, *r.surface_maps, *r.depth_maps, *r.place, *r.vertex_light,
                        constants, c.world_to_clip, c.camera_m, made, solid, nullptr, seen);
        }
        if (r.decals && decals_in_view(*r.scene, c.world_to_clip)) {
            add_decals(graph, *r.targets, *r.decals, *r.scene, *r.surface_maps, *r.depth_maps,
                       *r.place, constants, c.world_to_clip, made);
        }
        const GBufferParts parts = gbuffer_parts(*r.scene, weather.any);
        add_gbuffer_rows(graph, *r.targets, parts);
        if (i == 0) {
            for (std::size_t g = 0; g < aov_groups.size(); ++g) {
                add_aovs(graph, *r.targets, *r.place, constants, aov_groups[g], g, parts, r.scene->lighting_models(),
                         settings.light_prepass, !weathered);
            }
        }
        add_tile_lists(graph, *r.targets, constants);
        add_light_lists(graph, *r.targets, *r.lights, constants);
        if (settings.ambient_occlusion) {
            add_ambient_occlusion(graph, *r.targets, constants, pixels, settings.bent_normals);
        }
        if (layers > 0) {
            std::swap(r.targets->accumulated, r.transparent->solid);
        }
        if ((i == range.first || apart) && variant.patch_light) {
            add_patch_points(graph, *r.targets, *r.patches, constants);
        }
        variant.parts = &lit_parts;
        variant.pixels = pixels;
        add_background(graph, *r.targets, *r.sky, constants, variant);
        const bool label = r.parts->label && i == 0;
        if (label && settings.image_based_light) clear_mirrors(graph, *r.targets);
        add_lighting(graph, *r.targets, *r.scene, *r.lights, *r.light_tables, *r.sky, *r.depth_maps,
                     *r.lamp_shadows, *r.probes, constants, variant);
        if (r.ice_model != 0 && settings.image_based_light) {
            add_clear_ice(graph, *r.targets, *r.sky, *r.probes, variant.patch_light, constants, r.ice_model, variant.gusts,
                          {variant.parts, variant.split, nullptr, false, true, false, r.around, window_of(frame, r)}, pixels);
        }
        if (r.kept && i == 0) add_keep_around(graph, *r.targets, *r.kept, parts.emission, constants);
        if (settings.image_based_light) {
            add_reflections(graph, *r.targets, *r.sky, *r.probes, variant.patch_light, constants,
                            {variant.parts, variant.split, &r.parts->sum_or_none(),
                             label, variant.mirrors_picture,
                             variant.emission && r.lights->glows, r.around, window_of(frame, r)},
                            pixels);
        }
        if (r.adaptive && i == 0) {
            add_keep_first(graph, *r.targets, *r.resolve, *r.adaptive, lit, constants);
            if (variant.split && layers > 0)
                add_parts_mean(graph, *r.targets, *r.parts, lit_parts, PARTS_MEAN_KEEP, nullptr, constants);
        }
        if (r.adaptive && i == 1) {
            add_settle(graph, *r.targets, *r.resolve, *r.sky, *r.adaptive, lit, layers == 0,
                       settings.adaptive, constants);
            if (variant.split)
                add_parts_mean(graph, *r.targets, *r.parts, lit_parts,
                               layers > 0 ? PARTS_MEAN_OF_TWO : PARTS_MEAN_OF_SUM, nullptr, constants);
        }
        if (layers > 0) {
            std::swap(r.targets->accumulated, r.transparent->solid);
            add_layers(graph, frame, r, constants, c, made, variant, layers, needed > layers);
        }
    }
    if (range.end < static_cast<std::uint32_t>(settings.samples)) return graph;
    constants.offset = 0;
    add_air(graph, frame, sun, plan, r, constants, falling);
    if (settings.bloom > 0.0f) add_glare(graph, *r.targets, settings.samples);
    add_resolve(graph, *r.targets, *r.sky, constants, settings);
    return graph;
}

}  // namespace petrichor::gpu
