// What is sent to petrichor-meshopt for each view, before its packed bytes. Both are one build's.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_QUESTION_H
#define PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_QUESTION_H

#include <cstdint>

namespace petrichor::scene {

struct MeshoptQuestion {
    std::uint64_t packed_bytes = 0, count = 0, stride = 0;
    std::uint32_t mode = 0, filter = 0;  ///< MeshoptMode, MeshoptFilter
};

}  // namespace petrichor::scene

#endif
