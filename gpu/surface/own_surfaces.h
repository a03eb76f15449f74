#ifndef PETRICHOR_GPU_SURFACE_OWN_SURFACES_H
#define PETRICHOR_GPU_SURFACE_OWN_SURFACES_H

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/compiler/own_text.h"

namespace petrichor::gpu {

/// Users' own surfaces of a scene, by number: GLSL files NAME.glsl that define NAME_input, which may
/// change what a surface point is asked with, and NAME_surface, which may change what it answers; NAME_move may
/// move vertices
/// (gpu/passes/surface/own_surface.glsl is the manual).
class OwnSurfaces {
public:
    /// names: of the materials, "" for none. Throws Error when one is no such file.
    explicit OwnSurfaces(const std::vector<std::string>& names = {});

    /// The number of one of those names, from 1; 0 of "".
    std::uint32_t number_of(const std::string& name) const;
    bool any() const { return !own_.empty(); }
    /// NAME of the one of that number, from 1.
    const std::string& name_of(std::uint32_t number) const { return own_[number - 1].name; }
    /// Whether that one moves vertices: it defines NAME_move.
    bool moves(std::uint32_t number) const;

    /// SPIR-V of the pass that resolves visible surfaces with users' own in it; empty when there are
    /// none. Throws Error with the user's file and line.
    std::vector<std::uint32_t> compile_resolve() const;
    /// .. of the pass that draws layers of what lets light through; `baked`: some material has a light map.
    std::vector<std::uint32_t> compile_transparent(bool baked) const;
    /// .. of the pass that asks them where vertices go; empty when none moves any.
    std::vector<std::uint32_t> compile_move() const;

private:
    std::vector<std::uint32_t> compile(const std::string& main) const;

    std::vector<OwnText> own_;
};

}  // namespace petrichor::gpu

#endif
