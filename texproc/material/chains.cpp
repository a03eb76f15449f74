#include "texproc/material/chains.h"

namespace petrichor::texproc {

PrefilterOptions prefilter_options(const PrefilterChoice& choice, const ChainUse& use)
{
    PrefilterOptions options;
    options.rule = choice.rule;
    options.quick = choice.quick;
    options.design_light = choice.design_light;
    options.joint = use.joint;
    options.lobes = choice.lobes;
    options.bits = use.bits == 8 ? 8 : 0;  // codes chosen for the files that ship
    options.smoothness = use.smoothness;
    options.threads = use.threads;
    return options;
}

bool is_color(const std::string& role)
{
    return role == "albedo" || role == "specular" || role == "emission";
}

std::vector<Image> plain_levels(const Image& map, const std::string& role, MipOptions options)
{
    options.normals = role == "normal";
    if (map.channels != 4 || role != "albedo") options.alpha_cutoff = -1.0f;
    return mip_chain(map, options);
}

}  // namespace petrichor::texproc
