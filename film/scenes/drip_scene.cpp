#include "film/scenes/drip_scene.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

#include "base/error.h"
#include "base/hash.h"
#include "film/data/source_fingerprint.h"
#include "film/scenes/transport.h"
#include "film/weather/surface_by_name.h"

namespace petrichor::film {
namespace {

constexpr const char* kKind = "drips";
static_assert(sizeof(scene::DripPoint) == 9 * sizeof(float), "no padding: bytes are kept");
static_assert(std::is_trivially_copyable_v<scene::DripPoint>);

}  // namespace

std::shared_ptr<const std::vector<scene::DripPoint>> prepare_drips(const scene::Scene& scene,
                                                                   const ContentCache& cache,
                                                                   std::vector<std::string>& notes)
{
    auto points = std::make_shared<std::vector<scene::DripPoint>>();
    std::vector<std::uint8_t> leaves;
    for (const scene::Material& material : scene.materials) leaves.push_back(is_foliage(material) ? 1 : 0);
    const scene::Triangles plain(scene, {});
    std::string key;
    if (cache.on()) {
        Hasher hasher;
        hasher.add(source_fingerprint());
        hasher.add(what_rays_see(scene, plain));
        hasher.add_bytes(std::as_bytes(std::span(leaves)));
        key = hasher.text();
        const auto bytes = cache.find(kKind, key);
        if (bytes && bytes->size() % sizeof(scene::DripPoint) == 0) {
            points->resize(bytes->size() / sizeof(scene::DripPoint));
            if (!bytes->empty()) std::memcpy(points->data(), bytes->data(), bytes->size());
            return points;
        }
    }
    std::vector<std::string> said;  // by the patches already
    const auto alphas = alpha_images(scene, said);
    const bool holes =
        std::any_of(alphas.begin(), alphas.end(), [](const auto& image) { return !image.alpha.empty(); });
    const std::optional<scene::Triangles> cut =
        holes ? std::optional<scene::Triangles>(std::in_place, scene, alphas) : std::nullopt;
    const scene::Tracer tracer(cut ? *cut : plain);
    scene::DripOptions options;
    options.left_out = leaves;
    options.gutters = true;
    *points = scene::drip_points(tracer, options);
    if (cache.on()) {
        try {
            cache.keep(kKind, key, {std::as_bytes(std::span(*points))});
        } catch (const Error& error) {
            notes.push_back(std::string(error.what()) + ": edges that drip are looked for at every start. " +
                            error.fix());
        }
    }
    return points;
}

}  // namespace petrichor::film
