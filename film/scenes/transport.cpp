#include "film/scenes/transport.h"

#include <chrono>
#include <cstring>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"
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
        for (const float v : {m.base_color.r, m.base_color.g, m.base_color.b, m.metallic,
                              m.roughness, m.emissive.r, m.emissive.g, m.emissive.b,
                              m.emissive_strength})
            hasher.add(v);
        add_use(m.base_color_texture);
        add_use(m.metallic_roughness_texture);
        add_use(m.emissive_texture);
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

SceneTransport prepare_transport(const scene::Scene& scene, const TransportOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    SceneTransport transport;
    // The alpha of holes counts by its encoded bytes: nothing is decoded when all is kept.
    const scene::Triangles plain(scene, {});
    Hasher seen;
    seen.add(plain.fingerprint());
    const std::vector<bool> cut = cut_holes(scene);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        if (!cut[i]) continue;
        seen.add(i);
        seen.add_bytes(scene.textures[i].bytes);
        seen.add(scene.textures[i].wrap_u);
        seen.add(scene.textures[i].wrap_v);
    }
    const std::string key = scene::patches_fingerprint(seen.text(), options.patches);

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
        const scene::Triangles triangles(scene, alpha_images(scene, transport.notes));
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
