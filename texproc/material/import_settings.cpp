#include "texproc/material/import_settings.h"

#include "base/hash.h"
#include "base/output_file.h"

namespace petrichor::texproc {

namespace {

// TextureWrapMode of Unity.
int wrap_mode(bool wrap, bool mirror)
{
    return wrap ? 0 : mirror ? 2 : 1;
}

const char* flag(bool value)
{
    return value ? "1" : "0";
}

std::string sampling(const MipOptions& edges)
{
    return "  textureSettings:\n"
           "    serializedVersion: 2\n"
           "    filterMode: 2\n"  // trilinear: the levels are worth blending
           "    aniso: 8\n"
           "    mipBias: 0\n"
           "    wrapU: " +
           std::to_string(wrap_mode(edges.wrap_u, edges.mirror_u)) +
           "\n"
           "    wrapV: " +
           std::to_string(wrap_mode(edges.wrap_v, edges.mirror_v)) +
           "\n"
           "    wrapW: 0\n";
}

std::string unity_meta(const PlannedOutput& output, const std::string& file,
                       const MipOptions& edges)
{
    Hasher name;
    name.add("petrichor unity asset");
    name.add(file);
    std::string text = "fileFormatVersion: 2\nguid: " + name.text() + "\n";
    if (output.rule.format == "dds") {
        text += "IHVImageFormatImporter:\n  externalObjects: {}\n" + sampling(edges) +
                "  isReadable: 0\n  sRGBTexture: " + flag(output.rule.srgb()) +
                "\n  streamingMipmaps: 1\n  streamingMipmapsPriority: 0\n";
    } else {
        const bool normal = use_of(output) == TextureUse::Normal;
        text += std::string("TextureImporter:\n  externalObjects: {}\n  serializedVersion: 11\n") +
                "  mipmaps:\n    enableMipMap: 1\n    sRGBTexture: " + flag(output.rule.srgb()) +
                "\n  isReadable: 0\n  streamingMipmaps: 1\n" + sampling(edges) +
                "  textureType: " + flag(normal) + "\n";
    }
    return text + "  userData: \n  assetBundleName: \n  assetBundleVariant: \n";
}

std::string godot_import(const PlannedOutput& output)
{
    const TextureUse use = use_of(output);
    return std::string(
               "[remap]\n\nimporter=\"texture\"\ntype=\"CompressedTexture2D\"\n\n[params]\n\n"
               "compress/mode=2\n"  // in video memory
               "compress/high_quality=true\n"
               "compress/normal_map=") +
           (use == TextureUse::Normal ? "1" : "2") +
           "\ncompress/channel_pack=" + (use == TextureUse::Grey ? "1" : "0") +
           "\nmipmaps/generate=true\nmipmaps/limit=-1\nroughness/mode=1\n"
           "process/normal_map_invert_y=false\ndetect_3d/compress_to=0\n";
}

}  // namespace

TextureUse use_of(const PlannedOutput& output)
{
    if (output.roles.size() == 1 && output.roles[0] == "normal") return TextureUse::Normal;
    if (output.rule.srgb()) return TextureUse::Color;
    return output.rule.channels.channels.size() == 1 ? TextureUse::Grey : TextureUse::Mask;
}

const char* name_of(TextureUse use)
{
    switch (use) {
        case TextureUse::Color:
            return "color";
        case TextureUse::Normal:
            return "normal";
        case TextureUse::Grey:
            return "grey";
        case TextureUse::Mask:
            break;
    }
    return "mask";
}

std::string import_settings(const PlannedOutput& output, const std::string& file,
                            const MipOptions& edges)
{
    const std::string &engine = output.rule.import, &format = output.rule.format;
    if (engine == "unity" && format != "ktx2") return unity_meta(output, file, edges);
    if (engine == "godot" && (format == "png" || format == "tga" || format == "exr"))
        return godot_import(output);
    return {};
}

std::vector<std::string> write_import_settings(const std::filesystem::path& folder,
                                               const PlannedOutput& output,
                                               const std::vector<std::string>& files,
                                               const MipOptions& edges)
{
    std::vector<std::string> written;
    for (const std::string& file : files) {
        const std::string text = import_settings(output, file, edges);
        if (text.empty()) continue;
        written.push_back(file + (output.rule.import == "unity" ? ".meta" : ".import"));
        write_text_file(folder / written.back(), text);
    }
    return written;
}

}  // namespace petrichor::texproc
