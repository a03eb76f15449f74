#include "cli/texture/chain_output.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/error.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "cli/texture/maps/files.h"
#include "texproc/codecs/files/io.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

bool one_file(const std::string& name)
{
    return name.find('%') == std::string::npos && texproc::holds_mip_chain(name);
}

texproc::PixelType type_of(int bits)
{
    return bits == 8 ? texproc::PixelType::U8 : texproc::PixelType::U16;
}

// Level 0 is the input in the depth that was asked for.
texproc::RawImage recoded(const texproc::RawImage& image, int bits)
{
    return texproc::to_raw(texproc::to_image(image, ColorSpace::Data), type_of(bits));
}

bool is_png(const fs::path& file)
{
    static constexpr std::array<char, 8> kSignature{'\x89', 'P',  'N',    'G',
                                                    '\r',   '\n', '\x1a', '\n'};
    std::array<char, 8> start{};
    const InputFile in = open_regular_file(file, "image");
    return in.read(std::as_writable_bytes(std::span(start))) == 8 && start == kSignature;
}

void write_level0(const ChainOutput& output, const texproc::RawImage& level0,
                  const fs::path& source)
{
    const fs::path to = level_name(output.name, 0);
    const texproc::WriteOptions writing{.bits = output.bits, .threads = output.threads};
    if (level0.type != type_of(output.bits)) {
        texproc::write_raw(to, recoded(level0, output.bits), writing);
        return;
    }
    std::error_code failed;
    if (source.empty() || to.extension() != ".png" || !is_png(source) ||
        fs::equivalent(source, to, failed)) {
        texproc::write_raw(to, level0, writing);
        return;
    }
    OutputFile file(to);
    fs::copy_file(source, file.temporary(), fs::copy_options::overwrite_existing, failed);
    if (failed) {
        throw Error("output: cannot write " + to.string() + ": " + failed.message(),
                    "Choose a folder that you may write to, with room for the file.");
    }
    fs::permissions(file.temporary(), fs::perms::owner_write, fs::perm_options::add, failed);
    file.commit();
}

}  // namespace

void check_chain_name(const std::string& name)
{
    if (!one_file(name)) level_name(name, 0);
}

void write_chain(const ChainOutput& output, const texproc::RawImage& level0, const fs::path& source,
                 const std::vector<Image>& levels)
{
    const texproc::Rounding rounding =
        output.dither ? texproc::Rounding::Ordered : texproc::Rounding::Nearest;
    if (!one_file(output.name)) {
        write_level0(output, level0, source);
        for (std::size_t k = 1; k < levels.size(); ++k) {
            texproc::write_image(
                level_name(output.name, static_cast<int>(k)), levels[k],
                {.bits = output.bits, .threads = output.threads, .rounding = rounding});
        }
        return;
    }
    std::vector<texproc::RawImage> all{recoded(level0, output.bits)};
    for (std::size_t k = 1; k < levels.size(); ++k) {
        all.push_back(texproc::to_raw(levels[k], type_of(output.bits), rounding));
    }
    texproc::TextureWriteOptions writing;
    writing.format = output.format;
    writing.threads = output.threads;
    writing.texel_weights = output.texel_weights;
    texproc::write_mip_chain(output.name, all, writing);
}

}  // namespace petrichor::cli
