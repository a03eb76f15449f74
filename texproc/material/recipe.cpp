#include "texproc/material/recipe.h"

#include "base/words.h"

namespace petrichor::texproc {

namespace {

constexpr const char* kFilterNames[] = {"box", "kaiser", "lanczos3", "mitchell"};  // MipFilter

}  // namespace

std::string options_text(const OutputRule& output)
{
    std::string text = output.folder + "/" + output.file + "." + output.format + " [" +
                       join_words(output.channels.channels) + "]";
    text += output.srgb() ? " srgb" : " linear";
    text += " " + std::to_string(output.bits) + " bits";
    if (output.compression != "none") text += " " + output.compression;
    if (output.price_of_a_bit() > 0.0f)
        text += " rdo " + number_text(static_cast<double>(output.price_of_a_bit())) + " up to " +
                number_text(static_cast<double>(output.rdo_most)) + " codes";
    if (output.level_files) text += " level files";
    if (output.has_levels()) text += " mips";
    if (output.size > 0) text += " size " + std::to_string(output.size);
    if (output.blue_first) text += " bgra";
    if (!output.import.empty()) text += " import " + output.import;
    if (!output.prefilter) text += " plain";
    return text;
}

std::string options_text(const Recipe& recipe)
{
    const MipOptions& m = recipe.mips;
    std::string text =
        "green " + std::to_string(static_cast<int>(recipe.green)) + ", layout " + recipe.layout +
        "\nprefilter " + recipe.prefilter.rule + (recipe.prefilter.quick ? " quick" : " full") +
        " light " + number_text(static_cast<double>(recipe.prefilter.design_light)) +
        (recipe.prefilter.lobes == 2 ? " two lobes" : "") + (recipe.score ? " scored" : "") + "\nmips " +
        kFilterNames[static_cast<std::size_t>(m.filter)] + " wrap " + std::to_string(m.wrap_u) +
        std::to_string(m.wrap_v) + " mirror " + std::to_string(m.mirror_u) +
        std::to_string(m.mirror_v) + " cutoff " + number_text(static_cast<double>(m.alpha_cutoff)) +
        (m.alpha_weighted ? "" : " alpha data") + "\nbake " + join_words(recipe.bake) + " depth " +
        number_text(static_cast<double>(recipe.baking.depth)) + " reach " +
        number_text(static_cast<double>(recipe.baking.reach)) + "\n";
    for (const OutputRule& output : recipe.outputs) text += options_text(output) + "\n";
    return text;
}

}  // namespace petrichor::texproc
