#include "gpu/renderer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "gpu/frame/metering.h"
#include "gpu/renderer_impl.h"
#include "gpu/surface_path.h"

namespace petrichor::gpu {

Renderer::Impl::Impl(const RendererOptions& options, const WeatherMaps& weather_maps)
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
