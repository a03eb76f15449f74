#include "texproc/material/source_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <utility>

#include "base/error.h"
#include "texproc/codecs/files/io.h"
#include "texproc/filter/bake.h"
#include "texproc/filter/normal.h"
#include "texproc/filter/resample.h"
#include "texproc/image/zero_rows.h"
#include "texproc/material/chains.h"
#include "texproc/material/one_size.h"
#include "texproc/material/pack.h"

namespace petrichor::texproc {

namespace {

int bits_of(const RawImage& image)
{
    return image.type == PixelType::U8 ? 8 : image.type == PixelType::U16 ? 16 : 32;
}

// Grey paint is colour too.
RawImage widened(const RawImage& image)
{
    const PackPreset grey{"grey", "", {"m.r", "m.r", "m.r"}, {}};
    return pack(grey, {{"m", image}}, bits_of(image), 1);
}

// Some channels of an image, in its own numbers.
RawImage channels_of(const RawImage& image, const InputMap& map)
{
    if (map.channels.empty()) return image;
    PackPreset preset{"channels", "", {}, {}};
    for (const char letter : map.channels) {
        const int channel = static_cast<int>(std::string("rgba").find(letter));
        if (channel >= image.channels) {
            throw Error("texture build: " + map.path.string() + " has " +
                            std::to_string(image.channels) + " channels, '" + letter +
                            "' is not one of them",
                        "Choose a channel that is there.");
        }
        preset.channels.push_back(std::string("map.") + letter);
    }
    if (preset.channels.size() == 1) {
        return channel_of(image, static_cast<int>(std::string("rgba").find(map.channels[0])));
    }
    return pack(preset, {{"map", image}}, bits_of(image), 1);
}

void check_numbers(const RawImage& image, const InputMap& map)
{
    if (image.type != PixelType::F16 && image.type != PixelType::F32) return;
    for (const float v : to_image(image, ColorSpace::Data).pixels) {
        if (std::isfinite(v)) continue;
        throw Error("texture build: " + map.path.string() + " holds values that are not numbers",
                    "Repair the NaN or infinite pixels first.");
    }
}

bool has_word(const std::vector<std::string>& words, const std::string& word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Turns green in place: codes are subtracted from the largest, which is exact.
void turn_green(RawImage& normal)
{
    PackPreset turned{"turned", "", {"n.r", "1 - n.g", "n.b"}, {}};
    normal = pack(turned, {{"n", normal}}, bits_of(normal));
}

std::string percent(double share)
{
    return std::to_string(std::lround(100.0 * share)) + " %";
}

// Whether an output, a baked map or the prefilter looks at this input.
bool is_wanted(const PlannedMaterial& plan, const std::string& role)
{
    const auto baked = [&](const char* name) { return has_word(plan.baked, name); };
    for (const PlannedOutput& output : plan.outputs) {
        if (has_word(output.roles, role)) return true;
        if (output.prefiltered && (role == "normal" || role == "roughness" || role == "smoothness"))
            return true;
    }
    if (role == "roughness" || role == "smoothness" || role == "metallic") return baked("porosity");
    if (role == "normal") return baked("height");
    // It tells which way green points, the same for every engine.
    if (role == "height" && plan.recipe->green == Green::Auto &&
        plan.files.inputs.count("normal") && is_wanted(plan, "normal"))
        return true;
    if (role == "height") {
        return baked("puddle") || baked("crack") || baked("cavity") || baked("occlusion") ||
               baked("normal");
    }
    return false;
}

// Two at a time: a reading process costs a fifth of a second to start, more of them would cost more
// than they bring.
std::vector<RawImage> read_files(const std::vector<std::string>& names, int threads)
{
    std::vector<RawImage> images(names.size());
    const auto read_from = [&](std::size_t first, std::size_t step) {
        for (std::size_t i = first; i < names.size(); i += step) images[i] = read_raw(names[i]);
    };
    if (threads == 1 || names.size() < 2) {
        read_from(0, 1);
        return images;
    }
    std::future<void> other = std::async(std::launch::async, read_from, 1, 2);
    read_from(0, 2);
    other.get();
    return images;
}

void read(const PlannedMaterial& plan, int threads, SourceMaps& maps)
{
    std::vector<std::string> names;  // a packed file is read once
    for (const auto& [role, map] : plan.files.inputs) {
        const std::string name = map.path.string();
        if (is_wanted(plan, role) && !has_word(names, name)) names.push_back(name);
    }
    const std::vector<RawImage> images = read_files(names, threads);
    for (const auto& [role, map] : plan.files.inputs) {
        if (!is_wanted(plan, role)) continue;
        const auto at = std::find(names.begin(), names.end(), map.path.string());
        const RawImage& whole = images[static_cast<std::size_t>(at - names.begin())];
        maps.sources.push_back({role, whole.width, whole.height, whole.channels,
                                static_cast<int>(8 * size_of(whole.type))});
        RawImage& image = maps.images[role] = channels_of(whole, map);
        if (is_color(role) && image.channels < 3) image = widened(image);
        check_numbers(image, map);
        // Masks, metal and heights may well be zero; these are not.
        constexpr std::array kNeverZero{"albedo", "normal", "roughness", "smoothness", "occlusion"};
        if (std::find(kNeverZero.begin(), kNeverZero.end(), role) == kNeverZero.end()) continue;
        if (const std::string zero = zero_rows(image); !zero.empty()) {
            maps.notes.push_back(map.path.string() + " as " + role + ": " + zero +
                                 "; look whether the file is damaged");
        }
    }
}

// Three channels that hold x, y and z.
Image as_rgb(Image normal)
{
    return normal.channels > 3 ? from_layout(normal, NormalLayout::Rgb) : std::move(normal);
}

struct ChosenGreen {
    Green green;
    std::string how;
};

// The recipe's word first, then the height map, whose slopes cannot be wrong, then the name of the
// file, then the map alone. What says little is passed over: up is what most tools write.
ChosenGreen green_of(const PlannedMaterial& plan, const SourceMaps& maps, const RawImage& normal)
{
    constexpr double kSure = 0.25;
    const auto plain = [](Green green) {
        return ChosenGreen{green, green == Green::Down ? "down, turned" : "up"};
    };
    const Green told = plan.recipe->green, named = plan.files.green;
    if (told != Green::Auto) return plain(told);
    const Image rgb = as_rgb(to_image(normal, ColorSpace::Data));
    const auto found_by = [](const GreenDirection& found, const std::string& by) {
        const bool down = found.down && found.confidence > kSure;
        return ChosenGreen{down ? Green::Down : Green::Up,
                           std::string(down ? "down, turned" : "up") + ", found from " + by + " (" +
                               percent(found.confidence) + " " + (found.down ? "down" : "up") +
                               ")"};
    };
    if (const RawImage* height = maps.find("height")) {
        Image heights = maps.data("height");
        if (height->width != normal.width || height->height != normal.height)
            heights = resized(heights, normal.width, normal.height);
        const GreenDirection found = detect_green(rgb, heights);
        if (found.confidence > kSure) {
            ChosenGreen chosen = found_by(found, "the height map");
            if (named != Green::Auto && named != chosen.green) {
                chosen.how +=
                    std::string("; its name says ") + (named == Green::Down ? "down" : "up");
            }
            return chosen;
        }
    }
    if (named != Green::Auto) return plain(named);
    return found_by(detect_green(rgb), "the map");
}

void orient_normal(const PlannedMaterial& plan, SourceMaps& maps)
{
    const auto at = maps.images.find("normal");
    if (at == maps.images.end()) return;
    RawImage& normal = at->second;
    const NormalLayout layout = normal_layout(plan.recipe->layout);
    if (layout != NormalLayout::Rgb) {
        normal = to_raw(from_layout(to_image(normal, ColorSpace::Data), layout),
                        normal.type == PixelType::U8 ? PixelType::U16 : normal.type);
    }
    if (normal.channels < 3) {
        throw Error("texture build: the normal map " + file_of(plan, "normal") + " has " +
                        std::to_string(normal.channels) + " channels, 3 are needed",
                    "Give a three-channel normal map, or name its layout in [normal].");
    }
    const auto [green, how] = green_of(plan, maps, normal);
    maps.green = how;
    if (green == Green::Down) turn_green(normal);
}

void bake(const PlannedMaterial& plan, int threads, SourceMaps& maps)
{
    const auto missing = [&](const char* role) { return has_word(plan.baked, role); };
    const auto put = [&](const char* role, const Image& image) {
        maps.images[role] = to_raw(image, PixelType::U16);
    };
    BakeOptions options = plan.recipe->baking;
    options.threads = threads;
    if (missing("height")) {
        put("height",
            height_from_normal(as_rgb(maps.data("normal")), options.edge_u, options.edge_v).height);
    }
    const auto height = [&] { return maps.data("height"); };
    if (missing("normal"))
        put("normal",
            normal_from_height(height(), {options.depth, options.edge_u, options.edge_v}));
    if (missing("occlusion")) put("occlusion", ambient_occlusion(height(), options));
    if (missing("cavity")) put("cavity", cavity(height(), options));
    if (missing("puddle")) put("puddle", puddles(height(), options).depth);
    if (missing("crack")) put("crack", cracks(height(), options).depth);
    if (missing("porosity")) {
        Image rough = maps.data(maps.rough_role());
        if (maps.rough_role() == "smoothness") {
            for (float& v : rough.pixels) v = 1.0f - v;
        }
        put("porosity", porosity(rough, maps.find("metallic") ? maps.data("metallic") : Image()));
    }
}

}  // namespace

std::string file_of(const PlannedMaterial& plan, const std::string& role)
{
    const auto at = plan.files.inputs.find(role);
    return at == plan.files.inputs.end() ? "the baked " + role : at->second.path.string();
}

SourceMaps read_source_maps(const PlannedMaterial& plan, int threads)
{
    SourceMaps maps;
    read(plan, threads, maps);
    for (std::string& note : bring_to_one_size(plan, maps.images, threads))
        maps.notes.push_back(std::move(note));
    orient_normal(plan, maps);
    bake(plan, threads, maps);
    return maps;
}

}  // namespace petrichor::texproc
