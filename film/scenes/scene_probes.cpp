#include "film/scenes/scene_probes.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "film/data/source_fingerprint.h"
#include "film/scenes/light_picture.h"
#include "formulas/light/reflection_probe.h"
#include "scene/patches/patch_file.h"

namespace petrichor::film {
namespace {

constexpr const char* kKind = "probes";
constexpr std::size_t kAutomatic = 4;
constexpr std::size_t kTexels = std::size_t{shared::kProbeSide} * shared::kProbeSide;
constexpr std::size_t kBytes = sizeof(scene::ProbePlace) + kTexels * sizeof(scene::ProbeTexel);

std::string key_of(const gpu::PatchScene& made, const ScenarioProbes& wanted)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add_bytes(scene::patches_to_bytes(made.patches));
    hasher.add_bytes(std::as_bytes(std::span(made.surfaces)));
    hasher.add(wanted.automatic);
    hasher.add_bytes(std::as_bytes(std::span(wanted.places)));
    return hasher.text();
}

// Nothing when it does not fit.
std::vector<scene::TracedProbe> from_bytes(std::span<const std::byte> bytes, std::uint32_t patches)
{
    std::vector<scene::TracedProbe> probes(bytes.size() / kBytes);
    if (bytes.size() % kBytes != 0 || probes.size() > gpu::kMostProbes) return {};
    for (scene::TracedProbe& probe : probes) {
        std::memcpy(static_cast<void*>(&probe.place), bytes.data(), sizeof probe.place);
        probe.texels.resize(kTexels);
        std::memcpy(probe.texels.data(), bytes.data() + sizeof probe.place,
                    kTexels * sizeof(scene::ProbeTexel));
        bytes = bytes.subspan(kBytes);
        for (const scene::ProbeTexel& texel : probe.texels) {
            if (texel.patch < scene::ProbeTexel::kBlack && texel.patch >= patches) return {};
        }
    }
    return probes;
}

std::vector<std::byte> to_bytes(const std::vector<scene::TracedProbe>& probes)
{
    std::vector<std::byte> bytes(probes.size() * kBytes);
    std::byte* at = bytes.data();
    for (const scene::TracedProbe& probe : probes) {
        std::memcpy(at, &probe.place, sizeof probe.place);
        std::memcpy(at + sizeof probe.place, probe.texels.data(),
                    kTexels * sizeof(scene::ProbeTexel));
        at += kBytes;
    }
    return bytes;
}

std::vector<scene::TracedProbe> traced_probes(const scene::Scene& scene,
                                              const gpu::PatchScene& made,
                                              const ScenarioProbes& wanted,
                                              const TransportOptions& options,
                                              std::vector<std::string>& notes)
{
    std::vector<scene::TracedProbe> probes;
    const std::string key = key_of(made, wanted);
    if (const auto bytes = options.cache.find(kKind, key)) {
        probes = from_bytes(*bytes, made.patches.count);
        if (!probes.empty() || bytes->empty()) return probes;
    }
    const scene::Triangles triangles(scene, alpha_images(scene, notes));
    const scene::Tracer tracer(triangles);
    const auto places =
        wanted.automatic ? scene::place_probes(made.patches, tracer, kAutomatic) : wanted.places;
    const auto images = places.empty() ? std::vector<scene::ColorImage>()
                                       : color_images(scene, options.patches.threads, notes);
    for (const scene::ProbePlace& place : places) {
        probes.push_back(scene::trace_probe(made.patches, tracer, made.surfaces, images, place,
                                            options.patches.threads));
    }
    if (options.cache.on()) {
        try {
            const std::vector<std::byte> bytes = to_bytes(probes);
            options.cache.keep(kKind, key, {bytes});
        } catch (const Error& error) {
            notes.push_back(std::string(error.what()) +
                            ": reflection probes are traced again at every start. " + error.fix());
        }
    }
    return probes;
}

}  // namespace

std::vector<scene::TracedProbe> prepare_probes(const scene::Scene& scene,
                                               const gpu::PatchScene& made,
                                               const ScenarioProbes& wanted,
                                               const std::filesystem::path& folder,
                                               const TransportOptions& options,
                                               std::vector<std::string>& notes)
{
    if (made.patches.empty() || (!wanted.automatic && wanted.places.empty())) return {};
    auto probes = traced_probes(scene, made, wanted, options, notes);
    for (std::size_t i = 0; i < std::min(probes.size(), wanted.pictures.size()); ++i) {
        const ScenarioProbePicture& picture = wanted.pictures[i];
        if (picture.file.empty()) continue;
        const gpu::EnvironmentMap map = read_light_picture(folder / picture.file, picture.decode);
        probes[i].picture = scene::probe_picture(map.width, map.height, map.rgb);
    }
    return probes;
}

}  // namespace petrichor::film
