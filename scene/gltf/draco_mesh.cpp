#include "scene/gltf/detail/draco_mesh.h"

#include <cstring>

#include "base/error.h"
#include "base/limited_child.h"
#include "scene/gltf/gltf.h"

namespace petrichor::scene {
namespace {

// What the child sends is not trusted: every number is checked against what is left.
class Answer {
public:
    Answer(std::span<const std::byte> bytes, std::string name)
        : bytes_(bytes), name_(std::move(name))
    {
    }

    std::uint32_t word()
    {
        std::uint32_t value = 0;
        std::memcpy(&value, take(4).data(), 4);
        return value;
    }
    template <class T>
    std::vector<T> list(std::uint64_t count)
    {
        if (count > bytes_.size() / sizeof(T)) fail();
        std::vector<T> values(count);
        const auto from = take(count * sizeof(T));
        if (count > 0) std::memcpy(values.data(), from.data(), from.size());
        return values;
    }
    [[noreturn]] void fail() const
    {
        throw Error("scene " + name_ + ": its Draco meshes were not unpacked as a whole",
                    "Export the scene without Draco compression.");
    }

private:
    std::span<const std::byte> take(std::size_t count)
    {
        if (count > bytes_.size()) fail();
        const auto out = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return out;
    }

    std::span<const std::byte> bytes_;
    std::string name_;
};

DracoMesh mesh_of(Answer& answer)
{
    DracoMesh mesh;
    const std::uint64_t triangles = answer.word();
    mesh.vertices = answer.word();
    const std::uint32_t attributes = answer.word();
    mesh.indices = answer.list<std::uint32_t>(3 * triangles);
    for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.vertices) answer.fail();
    }
    for (std::uint32_t a = 0; a < attributes; ++a) {
        const std::uint32_t id = answer.word();
        DracoAttribute attribute;
        attribute.components = answer.word();
        if (attribute.components == 0 || attribute.components > 4) answer.fail();
        attribute.values = answer.list<float>(std::uint64_t{mesh.vertices} * attribute.components);
        mesh.attributes.emplace(id, std::move(attribute));
    }
    return mesh;
}

}  // namespace

bool reads_draco()
{
#ifdef PETRICHOR_DRACO_HELPER_BUILT
    return true;
#else
    return false;
#endif
}

std::vector<DracoMesh> unpack_draco(const std::vector<std::span<const std::byte>>& packed,
                                    const std::string& name)
{
    std::vector<DracoMesh> meshes;
    if (packed.empty()) return meshes;
#ifdef PETRICHOR_DRACO_HELPER_BUILT
    std::vector<std::byte> question;
    const auto add = [&question](const void* from, std::size_t size) {
        const auto* bytes = static_cast<const std::byte*>(from);
        question.insert(question.end(), bytes, bytes + size);
    };
    for (const auto& bytes : packed) {
        const auto size = static_cast<std::uint32_t>(bytes.size());
        add(&size, sizeof size);
        add(bytes.data(), bytes.size());
    }
    HelperJob job;
    job.program = find_helper("petrichor-draco", {PETRICHOR_DRACO_HELPER_BUILT});
    job.name = "scene " + name + ": Draco";
    job.limits = {.memory_bytes = 3ull << 30, .cpu_seconds = 120};
    const std::vector<std::byte> bytes = run_limited(job, question);
    Answer answer(bytes, name);
    for (std::size_t i = 0; i < packed.size(); ++i) meshes.push_back(mesh_of(answer));
    return meshes;
#else
    throw Error("scene " + name + ": its meshes are packed by Draco, which this build does not read",
                "Install libdraco-dev and build again, or export the scene without Draco.");
#endif
}

}  // namespace petrichor::scene
