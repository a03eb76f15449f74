#include "scene/detail/material_row.h"

namespace petrichor::scene::detail {
namespace {

using D = Displacement;

Row at_load(Row r)
{
    r.keyed = false;
    r.at_load = true;
    return r;
}

}  // namespace

// Lux 2.02's tessellation, done once when a sequence is loaded.
void add_displacement_rows(std::vector<MaterialProperty>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(at_load(number<&M::displacement, &D::height_m>(
        "displacement_m", 0, 10, place("displacement"),
        "height 1 of the height map above height 0 as geometry, metres: the mesh is cut and moved; "
        "0: off")));
    t.push_back(at_load(number<&M::displacement, &D::edge_m>(
        "displacement_edge_m", 0.001f, 100, place("displacementEdge"),
        "longest edge that the cut mesh keeps near the cameras, metres")));
    t.push_back(at_load(number<&M::displacement, &D::near_m>(
        "displacement_near_m", 0, kLargest, place("displacementNear"),
        "up to here from the nearest camera of the film edges and heights are as they are told")));
    t.push_back(at_load(number<&M::displacement, &D::far_m>(
        "displacement_far_m", 0, kLargest, place("displacementFar"),
        "from here on nothing is cut or moved")));
    t.push_back(at_load(number<&M::displacement, &D::phong>(
        "displacement_phong", 0, 1, place("displacementPhong"),
        "how far cut triangles bulge towards the tangent planes of their corners; 0 flat")));
    t.push_back(at_load(number<&M::displacement, &D::most>(
        "displacement_most", 1, 1024, place("displacementMost"),
        "an edge of the mesh becomes at most so many, a power of two")));
}

}  // namespace petrichor::scene::detail
