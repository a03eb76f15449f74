#ifndef PETRICHOR_GPU_LIGHTING_LIGHTING_MODELS_H
#define PETRICHOR_GPU_LIGHTING_LIGHTING_MODELS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/compiler/own_text.h"

namespace petrichor::gpu {

/// Names of the built-in models; the index is the model's number.
const std::vector<std::string>& built_in_lighting_models();

/// The lighting models of a scene, by number: the built-in ones, then users' own in the order in
/// which they are asked for.
///
/// A model is named by a built-in name or by the path of a GLSL file NAME.glsl, at most 256 KiB,
/// that defines NAME_light, NAME_surround and NAME_own (gpu/lighting/models/lighting_model.glsl); NAME_gather
/// and NAME_compose beside NAME_light or in its place gather the light first.
class LightingModels {
public:
    /// Throws Error when a name is no built-in one and no such file.
    explicit LightingModels(const std::vector<std::string>& names = {});

    /// The number of one of those names; "" is the standard model.
    std::uint32_t number_of(const std::string& name) const;
    std::uint32_t count() const;
    /// The model of that number can gather light before it asks the material.
    bool gathers(std::uint32_t number) const;

    /// SPIR-V of the lighting pass with users' own models in it; empty when there are none. Throws
    /// Error with the user's file and line.
    std::vector<std::uint32_t> compile_lighting() const;

private:
    struct Own {
        OwnText text;
        bool answers = true;   ///< it has NAME_light
        bool gathers = false;  ///< it has NAME_gather and NAME_compose
    };
    static Own read_own(const std::string& path, const std::vector<std::string>& taken);

    std::vector<Own> own_;
};

}  // namespace petrichor::gpu

#endif
