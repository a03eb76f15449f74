#include "scene/merge.h"

#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace petrichor::scene {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from)
{
    to.insert(to.end(), from.begin(), from.end());
}

// Two primitives with one key can be one: their arrays are all there or all empty.
std::pair<std::uint32_t, unsigned> key_of(const Primitive& p)
{
    unsigned attributes = 0;
    for (const bool there : {!p.normals.empty(), !p.tangents.empty(), !p.uv0.empty(),
                             !p.uv1.empty(), !p.colors.empty(), !p.weather.empty(), p.deforms()}) {
        attributes = attributes * 2 + (there ? 1 : 0);
    }
    return {p.material, attributes};
}

void join(Primitive& to, const Primitive& from)
{
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    append(to.positions, from.positions);
    append(to.normals, from.normals);
    append(to.tangents, from.tangents);
    append(to.uv0, from.uv0);
    append(to.uv1, from.uv1);
    append(to.colors, from.colors);
    append(to.weather, from.weather);
    for (const std::uint32_t index : from.indices) to.indices.push_back(first + index);
}

}  // namespace

void merge_primitives(Scene& scene)
{
    for (Mesh& mesh : scene.meshes) {
        std::vector<Primitive> merged;
        std::map<std::pair<std::uint32_t, unsigned>, std::size_t> places;
        for (Primitive& primitive : mesh.primitives) {
            const Material& material = scene.materials[primitive.material];
            const bool blends =
                material.alpha_mode == AlphaMode::Blend || material.transmission > 0.0f;
            const auto [place, is_new] = places.try_emplace(key_of(primitive), merged.size());
            const bool fits =
                !is_new && merged[place->second].positions.size() + primitive.positions.size() <
                               std::numeric_limits<std::uint32_t>::max();
            if (fits && !blends && !material.decal.on && !primitive.deforms()) {
                join(merged[place->second], primitive);
            } else {
                place->second = merged.size();
                merged.push_back(std::move(primitive));
            }
        }
        mesh.primitives = std::move(merged);
    }
}

}  // namespace petrichor::scene
