#include "texproc/material/write_levels.h"

#include <utility>

#include "texproc/codecs/files/io.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {

namespace {

// The float type that an EXR file holds.
RawImage as_exr(const RawImage& level, int bits)
{
    if (bits == 32) return level;
    return to_raw(to_image(level, ColorSpace::Data), PixelType::F16);
}

}  // namespace

std::vector<std::string> write_levels(const std::filesystem::path& folder, const std::string& stem,
                                      const OutputRule& rule, std::vector<RawImage> levels,
                                      std::vector<Image> texel_weights, int threads)
{
    if (rule.format == "exr") {
        for (RawImage& level : levels) level = as_exr(level, rule.bits);
    }
    const auto path_of = [&](const std::string& suffix) {
        const std::string file = stem + suffix + "." + rule.format;
        return std::pair(folder / file, file);
    };
    if (rule.format == "dds" || rule.format == "ktx2" ||
        (rule.format == "exr" && rule.has_levels() && !rule.level_files)) {
        const auto [path, file] = path_of("");
        TextureWriteOptions options;
        if (rule.compression != "none") options.format = rule.compression;
        if (rule.blue_first) options.format = "bgra8";
        if (rule.compression == "uastc") {
            if (levels.front().channels == 4) options.format = "uastca";
            options.zstd = 10;  // what its readers expect
        }
        options.repeat = rule.has_rdo() ? rule.price_of_a_bit() : 0.0f;
        options.repeat_most = rule.rdo_most;
        options.srgb = rule.srgb();
        options.threads = threads;
        // Whose blocks are to repeat others cannot aim between codes as well.
        if (options.repeat == 0.0f) options.texel_weights = std::move(texel_weights);
        write_mip_chain(path, levels, options);
        return {file};
    }
    std::vector<std::string> files;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const auto [path, file] = path_of(rule.level_files ? "_" + std::to_string(k) : "");
        write_raw(path, levels[k], {.bits = rule.bits, .threads = threads});
        files.push_back(file);
    }
    return files;
}

}  // namespace petrichor::texproc
