// petrichor-meshopt: unpacks the buffer views on standard input, confined.
//
//   in   for each view: a MeshoptQuestion, its packed bytes
//   out  for each: a byte, 1 where it could be unpacked; then what was packed
#include <cstring>

#include "base/confine.h"
#include "base/error.h"
#include "scene/gltf/detail/meshopt.h"
#include "scene/gltf/detail/meshopt_question.h"

namespace petrichor {
namespace {

std::vector<std::byte> answer(const HelperInput& input)
{
    std::vector<std::byte> out;
    std::span<const std::byte> rest = input.bytes;
    while (!rest.empty()) {
        scene::MeshoptQuestion asked;
        if (rest.size() >= sizeof asked) std::memcpy(&asked, rest.data(), sizeof asked);
        if (rest.size() < sizeof asked || asked.packed_bytes > rest.size() - sizeof asked)
            throw Error("a question that is cut short", "Export the scene again.");
        const auto unpacked = scene::unpack_meshopt(
            rest.subspan(sizeof asked, asked.packed_bytes), asked.count, asked.stride,
            static_cast<scene::MeshoptMode>(asked.mode),
            static_cast<scene::MeshoptFilter>(asked.filter));
        out.push_back(unpacked ? std::byte{1} : std::byte{0});
        if (unpacked) out.insert(out.end(), unpacked->begin(), unpacked->end());
        rest = rest.subspan(sizeof asked + asked.packed_bytes);
    }
    return out;
}

}  // namespace
}  // namespace petrichor

int main(int argc, char** argv)
{
    return petrichor::run_helper(argc, argv, petrichor::answer);
}
