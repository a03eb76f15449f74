#include "scene/detail/material_row.h"

namespace petrichor::scene::detail {

using D = DecalLook;

void add_decal_rows(std::vector<Row>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    const auto fixed = [&t](Row row) {
        row.keyed = false;
        t.push_back(std::move(row));
    };
    t.push_back(flag<&M::decal, &D::on>(
        "decal", place("decal"),
        "laid over the surfaces below by its alpha (OPAQUE: all of it, MASK: cut out), and no surface of "
        "its own: posters, road marks, moss, cracks"));
    t.push_back(number<&M::decal, &D::weights>(
        "decal_weights", 0, 1, place("decalWeights"),
        "how much a decal covers of the colour and glow; of the normal; of roughness, metal and "
        "occlusion; of the weather (1: puddles, snow and frost lie by its own relief)"));
    fixed(number<&M::decal, &D::order>("decal_order", -1000, 1000, place("decalOrder"),
                                       "decals of a higher order lie over those of a lower one"));
    t.push_back(number<&M::decal, &D::reach_m>(
        "decal_reach_m", 0.001f, 10, place("decalReach"),
        "a decal of triangles is laid onto surfaces so near to them, on both sides; metres"));
    t.push_back(flag<&M::decal, &D::received>("receives_decals", place("receivesDecals"),
                                              "decals are laid over it"));
}

}  // namespace petrichor::scene::detail
