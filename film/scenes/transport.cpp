#include "film/data/source_fingerprint.h"
#include "film/scenes/transport.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "scene/patches/lamps.h"
#include "scene/patches/patch_file.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr const char* kPatchKind = "patches";
constexpr const char* kSurfaceKind = "patch_surfaces";
// Patches are larger than a texel of this, and means of them are all that is asked for.
constexpr int kColorSide = 128;

enum class Use { Nothing, Color, Data };

// What patches want to know of each texture.
// Colours of a ground of layers besides the first's.
std::array<const scene::TextureUse*, 4> ground_colors(const scene::Material& material)
{
    const scene::SecondSet& s = material.second;
    return {&s.base_color_texture, &s.third.base_color_texture, &s.fourth.base_color_texture, &s.far_texture};
}

std::vector<Use> uses_of(const scene::Scene& scene)
{
    std::vector<Use> uses(scene.textures.size(), Use::Nothing);
    const auto want = [&](const scene::TextureUse& texture, Use use) {
        if (texture.present()) uses[static_cast<std::size_t>(texture.texture)] = use;
    };
    for (const scene::Material& material : scene.materials) {
        want(material.metallic_roughness_texture, Use::Data);
        if (material.emissive != glm::vec3(0.0f)) want(material.emissive_texture, Use::Color);
        want(material.base_color_texture, Use::Color);
        if (material.second.use == scene::SecondSetUse::Layers) {
            want(material.second.mix_mask, Use::Data);
            for (const scene::TextureUse* use : ground_colors(material)) want(*use, Use::Color);
        }
    }
    return uses;
}

std::vector<bool> cut_holes(const scene::Scene& scene)
{
    std::vector<bool> cut(scene.textures.size(), false);
    for (const scene::Material& material : scene.materials) {
        const scene::TextureUse& use = material.base_color_texture;
        if (material.alpha_mode == scene::AlphaMode::Mask && use.present())
            cut[static_cast<std::size_t>(use.texture)] = true;
    }
    return cut;
}

void keep(const ContentCache& cache, const char* kind, const std::string& key,
          std::span<const std::byte> bytes, std::vector<std::string>& notes)
{
    try {
        cache.keep(kind, key, {bytes});
    } catch (const Error& error) {
        notes.push_back(std::string(error.what()) + ": patches are traced again at every start. " +
                        error.fix());
    }
}

std::string surfaces_key(const scene::Scene& scene, const std::string& patches_key)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(patches_key);
    const std::vector<Use> uses = uses_of(scene);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (uses[i] != Use::Nothing) hasher.add_bytes(scene.textures[i].bytes);
    }
    const auto add_use = [&](const scene::TextureUse& use) {
        hasher.add(use.texture);
        hasher.add(use.texcoord);
        for (const float v : {use.offset.x, use.offset.y, use.scale.x, use.scale.y,
                              use.rotation_rad})
            hasher.add(v);
    };
    for (const scene::Material& m : scene.materials) {
        for (const float v : {m.base_color.r, m.base_color.g, m.base_color.b,
                              m.specular_workflow ? 0.0f : m.metallic,
                              m.roughness, m.emissive.r, m.emissive.g, m.emissive.b,
                              m.emissive_strength})
            hasher.add(v);
        add_use(m.base_color_texture);
        add_use(m.metallic_roughness_texture);
        add_use(m.emissive_texture);
        const scene::SecondSet& s = m.second;
        hasher.add(static_cast<int>(s.use));
        if (s.use != scene::SecondSetUse::Layers) continue;
        add_use(s.mix_mask);
        for (const scene::TextureUse* use : ground_colors(m)) add_use(*use);
        for (const glm::vec2& v : {s.mix_mask_tiling, s.tiling, s.third.tiling, s.fourth.tiling}) {
            hasher.add(v.x);
            hasher.add(v.y);
        }
        for (const glm::vec3& v : {s.color, s.third.color, s.fourth.color}) {
            for (int i = 0; i < 3; ++i) hasher.add(v[i]);
        }
    }
    // Which material a triangle has, its texture coordinates and colours.
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            hasher.add(p.material);
            hasher.add_bytes(std::as_bytes(std::span(p.uv0)));
            hasher.add_bytes(std::as_bytes(std::span(p.uv1)));
            hasher.add_bytes(std::as_bytes(std::span(p.colors)));
        }
    }
    return hasher.text();
}

}  // namespace

namespace {

// Cells are smaller near them.
std::string lamps_key(const scene::Scene& scene)
{
    const std::vector<glm::vec3> lamps_m = scene::lamps_that_cut(scene);
    if (lamps_m.empty()) return {};
    Hasher hasher;
    hasher.add_bytes(std::as_bytes(std::span(lamps_m)));
    return hasher.text();
}

}  // namespace

std::string what_rays_see(const scene::Scene& scene, const scene::Triangles& triangles)
{
    Hasher seen;
    seen.add(triangles.fingerprint());
    const std::vector<bool> cut = cut_holes(scene);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        if (!cut[i]) continue;
        seen.add(i);
        seen.add_bytes(scene.textures[i].bytes);
        seen.add(scene.textures[i].wrap_u);
        seen.add(scene.textures[i].wrap_v);
    }
    return seen.text();
}

std::vector<scene::ColorImage> color_images(const scene::Scene& scene, int threads,
                                            std::vector<std::string>& notes)
{
    const std::vector<Use> uses = uses_of(scene);
    std::vector<scene::ColorImage> images(scene.textures.size());
    std::vector<std::string> problems(scene.textures.size());
    parallel_for(images.size(), threads, [&](std::size_t i) {
        const scene::EncodedImage& source = scene.textures[i];
        if (uses[i] == Use::Nothing || source.bytes.empty()) return;
        try {
            const Image image = texproc::decode_image(
                source.bytes, source.name,
                {.space = uses[i] == Use::Color ? ColorSpace::Linear : ColorSpace::Data,
                 .max_side = kColorSide});
            images[i].width = image.width;
            images[i].height = image.height;
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    for (int c = 0; c < 3; ++c)
                        images[i].rgb.push_back(image.at(x, y, image.channels >= 3 ? c : 0));
                }
            }
        } catch (const Error& error) {
            problems[i] = error.what();
        }
    });
    for (const std::string& problem : problems) {
        if (!problem.empty()) notes.push_back("patches take it as white: " + problem);
    }
    return images;
}

std::vector<scene::AlphaImage> alpha_images(const scene::Scene& scene,
                                            std::vector<std::string>& notes)
{
    const std::vector<bool> cut = cut_holes(scene);
    std::vector<scene::AlphaImage> images(scene.textures.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        const scene::EncodedImage& source = scene.textures[i];
        if (!cut[i] || source.bytes.empty()) continue;
        try {
            const Image image = texproc::decode_image(source.bytes, source.name);
            if (image.channels != 2 && image.channels != 4) continue;
            images[i].width = image.width;
            images[i].height = image.height;
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const float alpha = image.at(x, y, image.channels - 1);
                    images[i].alpha.push_back(
                        static_cast<std::uint8_t>(alpha <= 0.0f   ? 0.0f
                                                  : alpha >= 1.0f ? 255.0f
                                                                  : alpha * 255.0f + 0.5f));
                }
            }
        } catch (const Error& error) {
            notes.push_back(std::string("patches take it as opaque: ") + error.what());
        }
    }
    return images;
}

namespace {

constexpr const char* kLampKind = "patch_lamps";
constexpr float kLantern_m = 0.5f;

// A lantern's glass and the lamp in it are the same light.
bool in_a_lantern(const scene::Scene& scene, const glm::vec3& position_m)
{
    for (const scene::Light& light : scene.lights) {
        if (light.kind != scene::LightKind::Directional && glm::distance(light.position_m, position_m) < kLantern_m)
            return true;
    }
    return false;
}

// Rays are only needed for what is not kept.
struct LazyTracer {
    const scene::Scene& scene;
    std::vector<std::string>& notes;
    std::optional<scene::Triangles> triangles;
    std::optional<scene::Tracer> tracer;

    const scene::Tracer& get()
    {
        if (!tracer) {
            triangles.emplace(scene, alpha_images(scene, notes));
            tracer.emplace(*triangles);
        }
        return *tracer;
    }
};

// Numbers one after the other, for the cache.
struct Bytes {
    std::vector<std::byte> all;
    template <class T>
    void add(const std::vector<T>& list)
    {
        const std::uint64_t count = list.size();
        const auto head = std::as_bytes(std::span(&count, 1));
        all.insert(all.end(), head.begin(), head.end());
        const auto body = std::as_bytes(std::span(list));
        all.insert(all.end(), body.begin(), body.end());
    }
};
struct FromBytes {
    std::span<const std::byte> left;
    bool good = true;
    template <class T>
    std::vector<T> take()
    {
        std::uint64_t count = 0;
        if (left.size() < sizeof count) good = false;
        if (good) std::memcpy(&count, left.data(), sizeof count);
        if (!good || count > (left.size() - sizeof count) / sizeof(T)) {
            good = false;
            return {};
        }
        std::vector<T> list(count);
        if (count > 0) std::memcpy(list.data(), left.data() + sizeof count, count * sizeof(T));
        left = left.subspan(sizeof count + count * sizeof(T));
        return list;
    }
};

// Whether numbers of a patch, of entries and of rays are there.
bool near_fits(const scene::NearLinks& near, const scene::GlowLinks& glow, std::uint32_t count, int rays)
{
    const std::size_t entries = near.entries(), sources = near.sources();
    bool good = near.first.size() == std::size_t{count} + 1 &&
                near.ray_first.size() == std::size_t{count} + 1 && near.corners.size() == entries &&
                near.seen.size() == entries && near.normal.size() == sources &&
                near.points.size() == sources * scene::NearLinks::kSamples && near.visible.size() == sources &&
                near.material.size() == sources && near.links.size() == sources * scene::NearLinks::kLinks &&
                near.first.front() == 0 && near.first.back() == entries &&
                near.ray_first.front() == 0 && near.ray_first.back() == near.rays.size();
    for (std::uint32_t i = 0; good && i < count; ++i) {
        good = near.first[i + 1] >= near.first[i] &&
               near.first[i + 1] - near.first[i] <= scene::NearLinks::kMostAPatch &&
               near.ray_first[i + 1] >= near.ray_first[i];
    }
    for (const std::uint32_t s : near.source) good = good && s < sources;
    for (const std::uint32_t s : near.sender) good = good && s < count;
    const bool glows = !glow.empty();
    good = good && near.glow_taken.size() == (glows ? glow.factor.size() : 0) &&
           near.glow_first.size() == (glows ? sources + 1 : 0) && near.glow_more.size() == near.glow_patch.size() &&
           (!glows || (near.glow_first.front() == 0 && near.glow_first.back() == near.glow_patch.size()));
    for (std::size_t s = 1; s < near.glow_first.size(); ++s)
        good = good && near.glow_first[s] >= near.glow_first[s - 1];
    for (const std::uint32_t g : near.glow_patch) good = good && g < count;
    for (const std::uint16_t r : near.rays) good = good && r < rays;
    for (const std::uint16_t l : near.links)
        good = good && l <= count + static_cast<std::uint32_t>(shared::kSkyBins);
    return good;
}

// Glow, what is near and lamps from what was kept; false when it does not fit.
bool take_lights(std::span<const std::byte> bytes, std::size_t lights, gpu::PatchScene& made)
{
    FromBytes from{bytes};
    scene::GlowLinks glow;
    glow.senders = from.take<std::uint32_t>();
    glow.first = from.take<std::uint32_t>();
    glow.sender = from.take<std::uint32_t>();
    glow.factor = from.take<float>();
    scene::NearLinks near;
    near.first = from.take<std::uint32_t>();
    near.corners = from.take<std::array<glm::vec3, 4>>();
    near.seen = from.take<float>();
    near.source = from.take<std::uint32_t>();
    near.normal = from.take<glm::vec3>();
    near.points = from.take<glm::vec3>();
    near.sender = from.take<std::uint32_t>();
    near.material = from.take<std::uint32_t>();
    near.visible = from.take<std::array<std::uint32_t, 8>>();
    near.links = from.take<std::uint16_t>();
    near.glow_first = from.take<std::uint32_t>();
    near.glow_patch = from.take<std::uint32_t>();
    near.glow_more = from.take<float>();
    near.glow_taken = from.take<std::uint8_t>();
    near.ray_first = from.take<std::uint32_t>();
    near.rays = from.take<std::uint16_t>();
    auto near_surfaces = from.take<scene::PatchSurface>();
    std::vector<std::vector<std::uint8_t>> reach;
    for (std::size_t i = 0; i < lights && from.good; ++i)
        reach.push_back(from.take<std::uint8_t>());
    std::vector<std::vector<std::uint8_t>> near_reach;
    for (std::size_t i = 0; i < lights && from.good; ++i)
        near_reach.push_back(from.take<std::uint8_t>());
    const std::uint32_t count = made.patches.count;
    bool good = from.good && from.left.empty() && glow.sender.size() == glow.factor.size() &&
                (glow.senders.empty() || (glow.first.size() == std::size_t{count} + 1 &&
                                          glow.first.back() == glow.sender.size()));
    for (const std::uint32_t s : glow.senders) good = good && s < count;
    for (const std::uint32_t s : glow.sender) good = good && s < glow.senders.size();
    for (std::size_t i = 1; i < glow.first.size(); ++i)
        good = good && glow.first[i] >= glow.first[i - 1];
    good = good && near_fits(near, glow, count, made.patches.rays);
    for (const auto& list : reach) good = good && (list.empty() || list.size() == count);
    for (const auto& list : near_reach)
        good = good && (list.empty() || list.size() == near.sources());
    good = good && near_surfaces.size() == near.sources();
    for (const std::uint32_t m : near.material) good = good && m < made.materials.size();
    if (!good) return false;
    made.near_surfaces = std::move(near_surfaces);
    made.near_reach = std::move(near_reach);
    made.glow = std::move(glow);
    made.near = std::move(near);
    made.lamp_reach = std::move(reach);
    return true;
}

// Dry, under the open sky and by its lamps.
std::vector<scene::NearHint> near_hints(const gpu::PatchScene& made, const std::vector<scene::Light>& lights,
                                        int threads)
{
    const scene::Patches& p = made.patches;
    std::vector<glm::vec3> albedo;
    bool lamps = false;
    for (const scene::PatchSurface& surface : made.surfaces) albedo.push_back(surface.base_color);
    std::vector<glm::vec3> direct(p.count, glm::vec3(0.0f));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].kind == scene::LightKind::Directional) continue;
        lamps = true;
        scene::add_lamp(p, lights[i], {}, made.lamp_reach[i], direct);
    }
    const std::vector<glm::vec3> none(p.count, glm::vec3(0.0f));
    const auto under = [&](const std::vector<glm::vec3>& falls, float sky_light) {
        const std::vector<glm::vec3> sky(static_cast<std::size_t>(shared::kSkyBins), glm::vec3(sky_light));
        scene::Relight input;
        input.albedo = albedo;
        input.direct = falls;
        input.sky = sky;
        input.threads = threads;
        const scene::PatchIrradiance lit = scene::relight(p, input);
        scene::NearHint hint;
        const glm::vec3 luminous(0.2126f, 0.7152f, 0.0722f);
        for (std::uint32_t i = 0; i < p.count; ++i) {
            hint.radiosity.push_back(glm::dot(lit.radiosity[i], luminous));
            hint.irradiance.push_back(glm::dot(glm::vec3(lit.irradiance[i]), luminous));
        }
        return hint;
    };
    std::vector<scene::NearHint> hints{under(none, 1.0f)};
    if (lamps) hints.push_back(under(direct, 0.0f));
    return hints;
}

std::string lights_key(const std::string& surfaces, const gpu::PatchScene& made,
                       const std::vector<scene::Light>& lights,
                       const std::vector<std::uint32_t>& senders)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(surfaces);
    hasher.add_bytes(scene::patches_to_bytes(made.patches));
    hasher.add_bytes(std::as_bytes(std::span(senders)));
    for (const scene::Light& light : lights) {
        hasher.add(light.kind);
        for (const float v : {light.position_m.x, light.position_m.y, light.position_m.z,
                              light.range_m})
            hasher.add(v);
    }
    return hasher.text();
}

}  // namespace

namespace {

struct PreparedPatches {
    std::shared_ptr<gpu::PatchScene> scene;
    bool kept;
};

PreparedPatches prepare_lights(const scene::Scene& scene, SceneTransport transport, const TransportOptions& options,
                               std::vector<std::string>& notes)
{
    auto made = std::make_shared<gpu::PatchScene>();
    made->patches = std::move(transport.patches);
    made->surfaces = std::move(transport.surfaces);
    made->materials = scene.materials;
    made->light_profiles = scene.light_profiles;
    notes.insert(notes.end(), transport.notes.begin(), transport.notes.end());
    for (std::uint32_t i = 0; i < made->patches.count; ++i) {
        if (in_a_lantern(scene, made->patches.position_m[i])) made->surfaces[i].emission = glm::vec3(0.0f);
    }
    const auto senders = scene::glowing_patches(made->patches, made->surfaces);
    const std::string key = lights_key(surfaces_key(scene, transport.key), *made, scene.lights, senders);
    bool kept = false;
    if (const auto bytes = options.cache.find(kLampKind, key))
        kept = take_lights(*bytes, scene.lights.size(), *made);
    if (!kept) {
        LazyTracer rays{scene, notes, {}, {}};
        const int threads = options.patches.threads;
        if (!senders.empty())
            made->glow = scene::trace_glow(made->patches, rays.get(), senders, threads);
        for (const scene::Light& light : scene.lights) {
            made->lamp_reach.emplace_back();
            if (light.kind == scene::LightKind::Directional) continue;
            const float range = light.range_m > 0.0f ? light.range_m : 5000.0f;
            made->lamp_reach.back() = scene::trace_lamp(made->patches, rays.get(),
                                                        light.position_m, range, threads);
        }
        const std::vector<scene::NearHint> hints = near_hints(*made, scene.lights, threads);
        made->near = scene::trace_near(made->patches, rays.get(), &made->glow, hints, threads);
        made->near_surfaces = scene::near_surfaces(made->near, rays.get().triangles(),
                                                   color_images(scene, threads, notes));
        made->near.samples = {};  // it is coloured
        for (std::size_t s = 0; s < made->near.sources(); ++s) {
            if (in_a_lantern(scene, scene::near_middle(made->near, s)))
                made->near_surfaces[s].emission = glm::vec3(0.0f);
        }
        for (const scene::Light& light : scene.lights) {
            made->near_reach.emplace_back();
            if (light.kind == scene::LightKind::Directional) continue;
            const float range = light.range_m > 0.0f ? light.range_m : 5000.0f;
            made->near_reach.back() =
                scene::trace_near_lamp(made->near, rays.get(), made->patches.level_cell_m(1),
                                       light.position_m, range, threads);
        }
        Bytes bytes;
        bytes.add(made->glow.senders);
        bytes.add(made->glow.first);
        bytes.add(made->glow.sender);
        bytes.add(made->glow.factor);
        bytes.add(made->near.first);
        bytes.add(made->near.corners);
        bytes.add(made->near.seen);
        bytes.add(made->near.source);
        bytes.add(made->near.normal);
        bytes.add(made->near.points);
        bytes.add(made->near.sender);
        bytes.add(made->near.material);
        bytes.add(made->near.visible);
        bytes.add(made->near.links);
        bytes.add(made->near.glow_first);
        bytes.add(made->near.glow_patch);
        bytes.add(made->near.glow_more);
        bytes.add(made->near.glow_taken);
        bytes.add(made->near.ray_first);
        bytes.add(made->near.rays);
        bytes.add(made->near_surfaces);
        for (const auto& reach : made->lamp_reach) bytes.add(reach);
        for (const auto& reach : made->near_reach) bytes.add(reach);
        if (options.cache.on()) keep(options.cache, kLampKind, key, bytes.all, notes);
    }
    return {made, transport.kept && kept};
}

}  // namespace

std::shared_ptr<gpu::PatchScene> prepare_patch_scene(const scene::Scene& scene, SceneTransport transport,
                                                     const TransportOptions& options,
                                                     std::vector<std::string>& notes)
{
    return prepare_lights(scene, std::move(transport), options, notes).scene;
}

std::shared_ptr<gpu::PatchScene> prepare_patch_scene(const scene::Scene& scene,
                                                     const TransportOptions& options,
                                                     std::vector<std::string>& notes)
{
    const auto start = std::chrono::steady_clock::now();
    const PreparedPatches made = prepare_lights(scene, prepare_transport(scene, options), options, notes);
    char text[160];
    std::snprintf(text, sizeof text, "light between surfaces: %u patches, %s in %.1f s",
                  made.scene->patches.count, made.kept ? "found in the cache" : "traced",
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    notes.emplace_back(text);
    return made.scene;
}

double traced_share(std::string_view stage, float share)
{
    struct Stage {
        std::string_view name;
        double first, length;
    };
    constexpr Stage kStages[] = {{"triangles", 0.0, 0.04},
                                 {"tree of boxes", 0.04, 0.06},
                                 {"patches", 0.1, 0.15},
                                 {"links", 0.25, 0.4},
                                 {"connections", 0.65, 0.05},
                                 {"visibility", 0.7, 0.3}};
    for (const Stage& s : kStages) {
        if (s.name == stage) return s.first + s.length * static_cast<double>(share);
    }
    return 0.0;
}

SceneTransport prepare_transport(const scene::Scene& scene, const TransportOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    SceneTransport transport;
    const auto begins = [&](std::string_view stage, float share) {
        if (options.patches.stop && options.patches.stop())
            throw Interrupted("interrupted while the scene was read");
        if (options.patches.progress) options.patches.progress(stage, share);
    };
    begins("triangles", 0.0f);
    // The alpha of holes counts by its encoded bytes: nothing is decoded when all is kept.
    const scene::Triangles plain(scene, {});
    const std::string key = scene::patches_fingerprint(what_rays_see(scene, plain) + lamps_key(scene), options.patches);
    transport.key = key;

    bool found_patches = false, found_surfaces = false;
    if (const auto bytes = options.cache.find(kPatchKind, key)) {
        try {
            transport.patches = scene::patches_from_bytes(*bytes, plain.size());
            found_patches = true;
        } catch (const Error&) {
            // Written by another version: made again.
        }
    }
    if (!found_patches) {
        begins("triangles", 0.5f);
        const scene::Triangles triangles(scene, alpha_images(scene, transport.notes));
        begins("tree of boxes", 0.0f);
        const scene::Tracer tracer(triangles);
        transport.patches = scene::build_patches(tracer, options.patches);
        if (options.cache.on())
            keep(options.cache, kPatchKind, key, scene::patches_to_bytes(transport.patches),
                 transport.notes);
    }
    const std::string color_key = surfaces_key(scene, key);
    const std::size_t surface_bytes = transport.patches.count * sizeof(scene::PatchSurface);
    if (const auto bytes = options.cache.find(kSurfaceKind, color_key);
        bytes && bytes->size() == surface_bytes) {
        transport.surfaces.resize(transport.patches.count);
        if (surface_bytes > 0)
            std::memcpy(transport.surfaces.data(), bytes->data(), surface_bytes);
        found_surfaces = true;
    }
    if (!found_surfaces) {
        const auto images = color_images(scene, options.patches.threads, transport.notes);
        transport.surfaces = scene::patch_surfaces(transport.patches, plain, images);
        if (options.cache.on() && transport.notes.empty())
            keep(options.cache, kSurfaceKind, color_key,
                 std::as_bytes(std::span(transport.surfaces)), transport.notes);
    }
    transport.kept = found_patches && found_surfaces;
    transport.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return transport;
}

}  // namespace petrichor::film
