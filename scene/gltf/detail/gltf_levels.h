#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_LEVELS_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_LEVELS_H

#include <utility>
#include <vector>

#include "scene/gltf/detail/gltf_json.h"
#include "scene/scene.h"

namespace petrichor::scene {

/// MSFT_lod: nodes that stand in for another where it is small in the picture.
class DetailGroups {
public:
    /// Where in a group a node stands; group < 0: in none.
    struct Place {
        std::int32_t group = -1;
        std::uint32_t level = 0;
    };

    DetailGroups(const JsonArray& nodes, const std::vector<std::int32_t>& parents);

    /// The scene shows this node by itself: it is no level of another.
    void take_root(std::uint32_t node) { taken_[node] = true; }
    /// The coarser levels of a node, if it has some; `place` becomes that of the node itself. Throws
    /// Error for a level that is part of the scene already.
    std::vector<std::pair<std::uint32_t, Place>> open(const JsonObject& node, Place& place);
    /// So many instances were placed at the end of the scene's.
    void placed(const Place& place, std::size_t count);
    /// Tells the instances when they are shown.
    void finish(Scene& scene) const;

private:
    struct Group {
        std::vector<float> coverage;  ///< by level: shown down to this
    };

    const std::vector<std::int32_t>& parents_;
    std::size_t node_count_;
    std::vector<bool> taken_;
    std::vector<Group> groups_;
    std::vector<Place> places_;  ///< by instance
};

}  // namespace petrichor::scene

#endif
