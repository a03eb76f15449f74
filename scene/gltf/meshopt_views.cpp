#include "scene/gltf/detail/meshopt_views.h"

#include <cstring>

#include "base/error.h"
#include "base/limited_child.h"
#include "scene/gltf/detail/meshopt_question.h"

namespace petrichor::scene {

std::vector<std::optional<std::vector<std::byte>>> unpack_meshopt_views(std::span<const MeshoptView> views,
                                                                        const std::string& name)
{
    std::vector<std::optional<std::vector<std::byte>>> unpacked(views.size());
    if (views.empty()) return unpacked;
    std::uint64_t packed_bytes = 0, most = 0;
    for (const MeshoptView& view : views) {
        packed_bytes += sizeof(MeshoptQuestion) + view.packed.size();
        most += 1 + view.count * view.stride;
    }
    std::vector<std::byte> question;
    question.reserve(packed_bytes);
    for (const MeshoptView& view : views) {
        const MeshoptQuestion asked{view.packed.size(), view.count, view.stride,
                                    static_cast<std::uint32_t>(view.mode),
                                    static_cast<std::uint32_t>(view.filter)};
        const auto* words = reinterpret_cast<const std::byte*>(&asked);
        question.insert(question.end(), words, words + sizeof asked);
        question.insert(question.end(), view.packed.begin(), view.packed.end());
    }
    HelperJob job;
    job.program = find_helper("petrichor-meshopt", {PETRICHOR_MESHOPT_HELPER_BUILT});
    job.name = "scene " + name + ": meshopt";
    job.limits = {.memory_bytes = (1ull << 30) + 4 * most, .cpu_seconds = 120};
    job.max_answer_bytes = most;
    const std::vector<std::byte> answer = run_limited(job, question);
    // Whatever the child sends is bytes of views: how many is known here.
    std::span<const std::byte> rest(answer);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::uint64_t size = views[i].count * views[i].stride;
        const bool whole = !rest.empty() && rest[0] == std::byte{1};
        if (rest.empty() || (whole && size > rest.size() - 1)) {
            throw Error("scene " + name + ": its packed buffers were not unpacked as a whole",
                        "Export the scene without EXT_meshopt_compression.");
        }
        rest = rest.subspan(1);
        if (!whole) continue;
        unpacked[i].emplace(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(size));
        rest = rest.subspan(size);
    }
    return unpacked;
}

}  // namespace petrichor::scene
