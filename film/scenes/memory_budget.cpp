#include "film/scenes/memory_budget.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

#include "base/error.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using Kind = TextureRecipe::Kind;

std::uint64_t texel_bytes(Kind kind)
{
    switch (kind) {
        case Kind::Scalar:
            return 1;
        case Kind::Normal:
            return 2;
        case Kind::Light:
            return 8;
        case Kind::Color:
        case Kind::Surface:
        case Kind::Weights:
            break;
    }
    return 4;
}

std::string mib(std::uint64_t bytes)
{
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

}  // namespace

MemoryNeed memory_need(const scene::Scene& scene, const TextureOptions& options, int width,
                       int height)
{
    scene::Scene plan;  // plan_textures changes what it is given, and needs no pixels
    plan.materials = scene.materials;
    for (const scene::EncodedImage& image : scene.textures) {
        scene::EncodedImage named = image;
        named.bytes.clear();
        plan.textures.push_back(std::move(named));
    }
    std::vector<std::uint64_t> texels(scene.textures.size(), 0);
    MemoryNeed need;
    std::uint64_t largest = 0;
    for (const TextureRecipe& recipe : plan_textures(plan)) {
        const auto image = static_cast<std::size_t>(recipe.image);
        if (texels[image] == 0 && !scene.textures[image].bytes.empty()) {
            if (options.stop && options.stop())
                throw Interrupted("interrupted while reading images");
            const texproc::RawImage shape =
                texproc::image_shape(scene.textures[image].bytes, scene.textures[image].name,
                                     {.max_side = options.max_size});
            texels[image] =
                static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height);
        }
        // All levels are a third more; a copy waits for the upload.
        need.textures += texels[image] * texel_bytes(recipe.kind) * 4 / 3 * 2;
        largest = std::max(largest, texels[image]);
    }
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const auto threads = static_cast<std::uint64_t>(
        std::min(4u, options.threads > 0 ? static_cast<unsigned>(options.threads) : cores));
    need.making =
        largest * 16 * 4 * threads;  // four floats a texel: decoded, widened, levels, next
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            constexpr std::uint64_t kVertexBytes = 96, kDrawBytes = 4096;
            need.geometry += 2 * (primitive.positions.size() * kVertexBytes +
                                  primitive.indices.size() * sizeof(std::uint32_t)) +
                             kDrawBytes;
        }
    }
    need.frame = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 400;
    return need;
}

std::uint64_t default_memory_budget()
{
    std::uint64_t memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                           static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    std::uint64_t limit = 0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit && limit > 0)
        memory = std::min(memory, limit);
    return memory / 4 * 3;
}

MemoryNeed check_memory(const scene::Scene& scene, const TextureOptions& options, int width,
                        int height, std::uint64_t budget)
{
    if (budget == 0) budget = default_memory_budget();
    const MemoryNeed need = memory_need(scene, options, width, height);
    if (need.total() <= budget) return need;
    std::string fix =
        "Raise the budget with --memory " + std::to_string((need.total() >> 20) + 1) + " (MiB)";
    for (int side = options.max_size / 2; side >= 256; side /= 2) {
        const MemoryNeed less =
            memory_need(scene, {.max_size = side, .threads = options.threads}, width, height);
        if (less.total() > budget) continue;
        fix = "Set [scene] max_texture = " + std::to_string(side) + ", which takes " +
              mib(less.total()) + ", or raise the budget with --memory " +
              std::to_string((need.total() >> 20) + 1) + " (MiB)";
        break;
    }
    throw Error("scene: it takes about " + mib(need.total()) + " of memory (textures " +
                    mib(need.textures) + ", making them " + mib(need.making) + ", geometry " +
                    mib(need.geometry) + ", pictures " + mib(need.frame) + "), the budget is " +
                    mib(budget),
                fix + ".");
}

}  // namespace petrichor::film
