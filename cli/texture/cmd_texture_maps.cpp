// petrichor texture mips, normal, bake, unpack: one map in, other maps out.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/maps/pack_file.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/bake.h"
#include "texproc/filter/fitted_depth.h"
#include "texproc/filter/mips.h"
#include "texproc/filter/normal.h"
#include "texproc/material/material_names.h"
#include "texproc/material/normal_channels.h"
#include "texproc/material/pack.h"

namespace petrichor::cli {

namespace {

const std::map<std::string, texproc::MipFilter> kFilters{
    {"box", texproc::MipFilter::Box},
    {"kaiser", texproc::MipFilter::Kaiser},
    {"lanczos3", texproc::MipFilter::Lanczos3},
    {"mitchell", texproc::MipFilter::Mitchell}};

const std::map<std::string, texproc::Edge> kEdges{{"wrap", texproc::Edge::Wrap},
                                                  {"clamp", texproc::Edge::Clamp},
                                                  {"mirror", texproc::Edge::Mirror}};

// What lies past the edges of a map, for each axis.
struct EdgeNames {
    std::string u = "wrap", v = "wrap";
};
void add_edges(CLI::App& app, EdgeNames& edges, const std::string& when)
{
    for (const auto& [axis, value] : {std::pair{"--wrap-u", &edges.u}, {"--wrap-v", &edges.v}}) {
        app.add_option(axis, *value, when + "wrap, clamp or mirror")
            ->check(CLI::IsMember({"wrap", "clamp", "mirror"}))
            ->capture_default_str();
    }
}

// Numbers that are none would spread through every filter.
Image checked(Image image, const std::string& path)
{
    for (const float v : image.pixels) {
        if (std::isfinite(v)) continue;
        throw Error("texture: " + path + " holds values that are not numbers",
                    "Repair the NaN or infinite pixels first.");
    }
    return image;
}

Image read_numbers(const std::string& path, ColorSpace space = ColorSpace::Data)
{
    return checked(texproc::read_image(path, {.space = space}), path);
}

// A map of one number a texel: FILE, or FILE:a. Without a channel the name may tell it (`wall_alb_ht` holds
// the height in alpha); else it is the first, which is said where the others differ.
Image read_scalar(const std::string& text, const std::string& role)
{
    MapFile file = parse_map_file(text);
    if (file.channel >= 0) return checked(texproc::to_image(read_map(text, {}), ColorSpace::Data), text);
    const texproc::RawImage raw = read_map(text, {});
    Image image = checked(texproc::to_image(raw, ColorSpace::Data), text);
    if (image.channels < 2) return image;
    const auto roles = texproc::maps_named(file.path.stem().string()).roles;
    const auto named = roles.find(role);
    std::string channel = named != roles.end() && named->second.size() == 1 ? named->second : "";
    if (std::string("rgba").find(channel) >= static_cast<std::size_t>(image.channels)) channel.clear();
    if (!channel.empty()) {
        std::cerr << "note: " << role << " is " << text << ":" << channel << ", as the name says\n";
    } else {
        tell_red_taken(text, raw, role);
    }
    const std::size_t take = channel.empty() ? 0 : std::string("rgba").find(channel);
    const std::size_t step = static_cast<std::size_t>(image.channels);
    Image one(image.width, image.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) one.pixels[i] = image.pixels[i * step + take];
    return one;
}

void check_same_size(const std::string& name_a, const Image& a, const std::string& name_b,
                     const Image& b)
{
    if (a.width == b.width && a.height == b.height) return;
    throw Error("texture: " + name_a + " is " + std::to_string(a.width) + " x " +
                    std::to_string(a.height) + ", " + name_b + " is " + std::to_string(b.width) +
                    " x " + std::to_string(b.height),
                "Resample one of them.");
}

struct MipsArguments {
    std::string in, out, format, filter = "box";
    EdgeNames edges;
    bool color = false, alpha_data = false;
    int bits = 8;
    texproc::MipOptions options;
};

// One file with all levels, or one file a level.
void write_mips(const MipsArguments& a, const std::vector<Image>& chain)
{
    if (!texproc::holds_mip_chain(a.out)) {
        for (std::size_t k = 0; k < chain.size(); ++k) {
            texproc::write_image(level_name(a.out, static_cast<int>(k)), chain[k],
                                 {.bits = a.bits});
        }
        return;
    }
    // Sixteen bits of colour are linear halves: no such integer format is sRGB.
    const std::string format = a.format.empty() && a.bits == 16 && a.color ? "rgba16f" : a.format;
    const bool exr = std::filesystem::path(a.out).extension() == ".exr";
    if (!format.empty() || a.bits == 8 || exr) {
        texproc::write_mip_chain(a.out, chain, {.format = exr ? "" : format});
        return;
    }
    std::vector<texproc::RawImage> levels;
    for (const Image& level : chain) levels.push_back(to_raw(level, texproc::PixelType::U16));
    texproc::write_mip_chain(a.out, levels);
}

void run_mips(MipsArguments& a)
{
    if (!texproc::holds_mip_chain(a.out)) level_name(a.out, 0);
    a.options.wrap_u = a.edges.u == "wrap";
    a.options.wrap_v = a.edges.v == "wrap";
    a.options.mirror_u = a.edges.u == "mirror";
    a.options.mirror_v = a.edges.v == "mirror";
    a.options.alpha_weighted = !a.alpha_data;
    a.options.filter = kFilters.at(a.filter);
    Image image = read_numbers(a.in, a.color ? ColorSpace::Linear : ColorSpace::Data);
    if (a.options.normals && image.channels == 3 && texproc::drops_z(a.format))
        texproc::renormalize(image, texproc::kUnitRounding);
    const bool floats = std::filesystem::path(a.out).extension() == ".exr" || a.format.ends_with('f') ||
                        a.format.starts_with("bc6h") || (a.format.empty() && a.bits == 16 && a.color && texproc::holds_mip_chain(a.out));
    if (!floats) tell_cut_numbers(image);
    const std::vector<Image> chain = texproc::mip_chain(image, a.options);
    write_mips(a, chain);
    std::cout << chain.size() << " levels\n";
}

struct NormalArguments {
    std::string in, out, height, blend, from = "rgb", to = "rgb";
    bool flip = false, detect = false, from_height = false, to_height = false, renormalize = false;
    float depth = 0.05f;
    int bits = 16;
    EdgeNames edges;
};

void run_normal(const NormalArguments& a)
{
    const Image image = a.from_height ? read_scalar(a.in, "height") : read_numbers(a.in);
    const texproc::Edge edge_u = kEdges.at(a.edges.u), edge_v = kEdges.at(a.edges.v);
    Image normal = a.from_height
                       ? texproc::normal_from_height(
                             image, {.depth = a.depth, .edge_u = edge_u, .edge_v = edge_v})
                       : texproc::from_layout(image, texproc::normal_layout(a.from));
    if (a.detect) {
        const Image height = a.height.empty() ? Image() : read_scalar(a.height, "height");
        if (!height.empty()) check_same_size(a.in, normal, a.height, height);
        const texproc::GreenDirection green =
            height.empty() ? texproc::detect_green(normal) : texproc::detect_green(normal, height);
        std::cout << "green " << (green.down ? "down (DirectX)" : "up (OpenGL)") << ", confidence "
                  << green.confidence << "\n";
        if (a.out.empty()) return;
    }
    if (a.out.empty()) throw Error("texture normal: --out is needed", "Give -o FILE.");
    if (a.to == "rg-signed" && std::filesystem::path(a.out).extension() != ".exr") {
        throw Error("texture normal: " + a.out + " cannot hold values below 0",
                    "Write rg-signed as .exr.");
    }
    if (a.flip) texproc::flip_green(normal);
    if (!a.blend.empty()) {
        const Image detail = read_numbers(a.blend);
        check_same_size(a.in, normal, a.blend, detail);
        normal = texproc::blend_normals(normal, detail);
    }
    if (a.renormalize) texproc::renormalize(normal);
    if (a.to_height) {
        const texproc::IntegratedHeight height =
            texproc::height_from_normal(normal, edge_u, edge_v);
        texproc::write_image(a.out, height.height, {.bits = a.bits});
        std::cout << "depth " << height.depth << " of the width\n";
        return;
    }
    // Whoever reads two channels makes z from them.
    if (a.to != "rgb" && a.to != "rxgb") texproc::renormalize(normal, texproc::kUnitRounding);
    texproc::write_image(a.out, texproc::to_layout(normal, texproc::normal_layout(a.to)),
                         {.bits = a.bits});
}

struct BakeArguments {
    std::string height, normal, occlusion, roughness, metallic, out;
    double width_m = 0.0;
    bool depth_given = false;
    int bits = 8, size = 256;
    std::uint32_t seed = 1;
    EdgeNames edges;
    texproc::BakeOptions options;
};

// Number k: the share under water k / 64 of the deepest below the brim.
std::string hypsometry(const texproc::Hollows& h)
{
    std::string text = "{\"deepest\": " + std::to_string(h.deepest) + ", \"covered\": [";
    for (std::size_t k = 0; k < h.covered.size(); ++k) {
        text += (k ? ", " : "") + std::to_string(h.covered[k]);
    }
    return text + "]}";
}

// The depth that the normals of the surface imply, green up or down as the heights tell, said; where
// they tell of another surface, the default stays, and that is said.
void fit_depth(BakeArguments& a, const Image& height, Image normal)
{
    constexpr float kLeastAgreement = 0.3f;
    if (a.depth_given) {
        throw Error("texture bake: --depth and --normal both say how deep it is",
                    "Give one of them.");
    }
    check_same_size(a.height, height, a.normal, normal);
    const bool down = texproc::detect_green(normal, height).down;
    if (down) texproc::flip_green(normal);
    const texproc::FittedDepth fitted =
        texproc::fitted_depth(height, normal, a.options.edge_u, a.options.edge_v);
    const bool good = fitted.agreement >= kLeastAgreement && fitted.depth > 0.0f;
    if (good) a.options.depth = fitted.depth;
    std::printf("depth %.4f of the width", static_cast<double>(a.options.depth));
    if (a.width_m > 0.0)
        std::printf(", %.4f m", static_cast<double>(a.options.depth) * a.width_m);
    std::printf(good ? ", fitted (heights and normals agree by %.2f%s)\n"
                     : ", not fitted: heights and normals agree by %.2f only%s\n",
                static_cast<double>(fitted.agreement), down ? ", green down" : "");
}

void run_bake(BakeArguments& a)
{
    a.options.edge_u = kEdges.at(a.edges.u);
    a.options.edge_v = kEdges.at(a.edges.v);
    level_name(a.out, 0);  // the same rule for the pattern, with a name in the place of %d
    const auto name = [&](const std::string& what) {
        const std::size_t at = a.out.find('%');
        return a.out.substr(0, at) + what + a.out.substr(a.out.find('d', at) + 1);
    };
    const texproc::WriteOptions writing{.bits = a.bits};
    if (a.height.empty() && !(a.normal.empty() && a.occlusion.empty())) {
        throw Error("texture bake: --normal and --occlusion go with --height",
                    "Name the height map.");
    }
    if (a.height.empty()) {
        texproc::write_image(name("ripple"), texproc::ripple_drops(a.size, a.seed), writing);
        texproc::write_image(name("snow_mask"), texproc::snow_mask(a.size, a.seed), writing);
        texproc::write_image(name("snow_water_bump"), texproc::snow_water_bump(a.size, a.seed),
                             writing);
        return;
    }
    const Image height = read_scalar(a.height, "height");
    // All inputs are read before the first output is written.
    const Image roughness = a.roughness.empty() ? Image() : read_scalar(a.roughness, "roughness");
    const Image metallic = a.metallic.empty() ? Image() : read_scalar(a.metallic, "metallic");
    if (!roughness.empty() && !metallic.empty())
        check_same_size(a.roughness, roughness, a.metallic, metallic);
    const Image truth = a.occlusion.empty() ? Image() : read_scalar(a.occlusion, "occlusion");
    if (!truth.empty()) check_same_size(a.height, height, a.occlusion, truth);
    if (!a.normal.empty()) fit_depth(a, height, read_numbers(a.normal));
    const Image occlusion = texproc::ambient_occlusion(height, a.options);
    if (!truth.empty()) {
        std::printf("occlusion correlates %.3f with %s\n", texproc::correlation(occlusion, truth),
                    a.occlusion.c_str());
    }
    texproc::write_image(name("occlusion"), occlusion, writing);
    texproc::write_image(name("cavity"), texproc::cavity(height, a.options), writing);
    texproc::write_image(name("curvature"), texproc::curvature(height, a.options), writing);
    texproc::write_image(name("flow"), texproc::flow_direction(height, a.options), writing);
    const texproc::Hollows puddles = texproc::puddles(height, a.options);
    const texproc::Hollows cracks = texproc::cracks(height, a.options);
    texproc::write_image(name("puddle"), puddles.depth, writing);
    texproc::write_image(name("crack"), cracks.depth, writing);
    write_text_file(
        std::filesystem::path(name("hypsometry")).replace_extension(".json"),
        "{\"puddle\": " + hypsometry(puddles) + ",\n\"crack\": " + hypsometry(cracks) + "}\n");
    if (!roughness.empty()) {
        texproc::write_image(name("porosity"), texproc::porosity(roughness, metallic), writing);
    }
}

struct UnpackArguments {
    std::string in, preset, out;
};

void run_unpack(const UnpackArguments& a)
{
    level_name(a.out, 0);
    const std::size_t at = a.out.find('%');
    const texproc::PackPreset preset = pack_preset_or_file(a.preset);
    const texproc::RawImage packed = texproc::read_raw(a.in);
    std::size_t needed = 0;  // channels up to the last one that holds a map
    for (std::size_t c = 0; c < preset.channels.size(); ++c) {
        if (!texproc::parse_pack_channel(preset.channels[c]).front().role.empty()) needed = c + 1;
    }
    if (static_cast<std::size_t>(packed.channels) < needed) {
        throw Error("texture unpack: " + a.in +
                        " has channels: " + std::to_string(packed.channels) + ", " + a.preset +
                        " holds maps in the first " + std::to_string(needed),
                    "Name the preset that it was packed with (pack --list).");
    }
    for (const auto& [role, image] : texproc::unpack(preset, packed)) {
        const std::string name = a.out.substr(0, at) + role + a.out.substr(a.out.find('d', at) + 1);
        texproc::write_raw(name, image);
        std::cout << name << "\n";
    }
}

}  // namespace

void add_texture_maps(CLI::App& texture)
{
    {
        auto a = std::make_shared<MipsArguments>();
        CLI::App* app = texture.add_subcommand("mips", "mip levels of one image");
        app->add_option("image", a->in, "the largest level")->required();
        app->add_option("-o,--out", a->out, "level k: 'out_%d.png'; all in one: .dds, .ktx2, .exr")
            ->required();
        app->add_option("--format", a->format, "of .dds and .ktx2: bc1, bc7, rgba16f, ...");
        app->add_option("--filter", a->filter, "box: the mean over the exact area")
            ->check(CLI::IsMember({"box", "kaiser", "lanczos3", "mitchell"}))
            ->capture_default_str();
        add_edges(*app, a->edges, "");
        app->add_flag("--color", a->color, "sRGB colour: filtered in linear light");
        app->add_flag("--alpha-data", a->alpha_data,
                      "--color: alpha is no coverage; colour counts the same under all of it");
        app->add_flag("--normals", a->options.normals, "a normal map: unit length on every level");
        app->add_flag("--keep-length", a->options.keep_length, "normals: leave them shortened");
        app->add_option("--alpha-cutoff", a->options.alpha_cutoff,
                        "keep the coverage of alpha above this");
        app->add_option("--bits", a->bits, "8 or 16")->check(CLI::IsMember({8, 16}));
        app->footer(
            "Example:\n  petrichor texture mips albedo.png --color --filter kaiser -o "
            "'albedo_%d.png'\n"
            "  petrichor texture mips albedo.png --color --format bc7 -o albedo.ktx2");
        app->callback([a] { run_mips(*a); });
    }
    {
        auto a = std::make_shared<NormalArguments>();
        CLI::App* app =
            texture.add_subcommand("normal", "turn, detect, convert, blend normal maps");
        app->add_option("image", a->in, "a normal map, or a height map with --from-height")
            ->required();
        app->add_option("-o,--out", a->out, "the result");
        app->add_flag("--detect", a->detect, "say which way green points, and how sure that is");
        app->add_option("--height", a->height, "--detect: the height map of the same surface");
        app->add_flag("--flip-green", a->flip, "OpenGL to DirectX or back");
        app->add_option("--from-layout", a->from, "rgb, rg, ag, rxgb, or rg-signed (-1..1)")
            ->capture_default_str();
        app->add_option("--to-layout", a->to, "the same; rg-signed needs an .exr")
            ->capture_default_str();
        app->add_flag("--from-height", a->from_height, "make normals from a height map");
        app->add_flag("--to-height", a->to_height, "integrate to a height map");
        app->add_option("--depth", a->depth, "--from-height: height 1 in units of the width")
            ->capture_default_str();
        add_edges(*app, a->edges, "--from-height, --to-height: ");
        app->add_option("--blend", a->blend, "add the bumps of another normal map");
        app->add_flag("--renormalize", a->renormalize, "unit length");
        app->add_option("--bits", a->bits, "8 or 16")
            ->check(CLI::IsMember({8, 16}))
            ->capture_default_str();
        app->footer("Example:\n  petrichor texture normal wall_dx.png --flip-green -o wall_gl.png");
        app->callback([a] { run_normal(*a); });
    }
    {
        auto a = std::make_shared<BakeArguments>();
        CLI::App* app = texture.add_subcommand(
            "bake", "occlusion, cavity, curvature, puddles, cracks, flow from a height map");
        app->add_option("--height", a->height,
                        "height map, white is high, FILE or FILE:a; without it: ripple, snow mask, snow bump");
        app->add_option("--normal", a->normal,
                        "normals of the same surface: the depth is fitted to them");
        app->add_option("--width-m", a->width_m, "width in metres: the fitted depth is told so too")
            ->check(CLI::PositiveNumber);
        app->add_option("--occlusion", a->occlusion,
                        "one that is known: says how the baked one correlates with it");
        app->add_option("--roughness", a->roughness, "also makes a porosity map; FILE or FILE:g");
        app->add_option("--metallic", a->metallic, "metals are not porous");
        app->add_option("-o,--out", a->out, "'wall_%d.png': %d becomes the name of the map")
            ->required();
        CLI::Option* depth =
            app->add_option("--depth", a->options.depth, "height 1 in units of the width")
                ->capture_default_str();
        app->add_option("--reach", a->options.reach, "how far it looks, in units of the width")
            ->capture_default_str();
        add_edges(*app, a->edges, "");
        app->add_option("--bits", a->bits, "8 or 16")
            ->check(CLI::IsMember({8, 16}))
            ->capture_default_str();
        app->add_option("--size", a->size, "of the weather textures")->capture_default_str();
        app->add_option("--seed", a->seed, "of the weather textures")->capture_default_str();
        app->footer(
            "Examples:\n"
            "  petrichor texture bake --height wall_h.png -o 'wall_%d.png'\n"
            "  petrichor texture bake --height wall_h.png --normal wall_n.png --width-m 2 -o "
            "'wall_%d.png'");
        app->callback([a, depth] {
            a->depth_given = depth->count() > 0;
            run_bake(*a);
        });
    }
    {
        auto a = std::make_shared<UnpackArguments>();
        CLI::App* app = texture.add_subcommand("unpack", "the maps back out of a packed image");
        app->add_option("image", a->in, "the packed image")->required();
        app->add_option("--preset", a->preset,
                        "as it was packed: a name of pack --list, or a file of yours (.toml)")
            ->required();
        app->add_option("-o,--out", a->out, "'wall_%d.png': %d becomes the role")->required();
        app->footer(
            "Example:\n  petrichor texture unpack mask.png --preset unity-hdrp-mask -o "
            "'wall_%d.png'");
        app->callback([a] { run_unpack(*a); });
    }
}

}  // namespace petrichor::cli
