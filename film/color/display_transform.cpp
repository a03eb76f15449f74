#include "film/color/display_transform.h"

#include "base/error.h"

#ifdef PETRICHOR_OCIO

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/packing.hpp>

#include "base/hash.h"
#include "base/input_file.h"
#include "base/words.h"
#include "formulas/noise/noise.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
namespace ocio = OCIO_NAMESPACE;

constexpr std::uint64_t kMostConfigBytes = 64u << 20;
constexpr std::uint64_t kMostTableBytes = 1u << 30;
constexpr std::size_t kRows = 64;  // at a time: a few hundred KiB of floats stay in the cache

// Names under which configs in use have linear light of Rec. 709 primaries and D65: OpenColorIO's own and ACES 2,
// Blender, ACES 1, AgX, spi.
constexpr const char* kLinearRec709[] = {
    "Linear Rec.709 (sRGB)", "Linear Rec.709",           "lin_rec709_srgb",
    "lin_rec709",            "Utility - Linear - sRGB",  "Utility - Linear - Rec.709",
    "Linear BT.709",         "Linear sRGB",              "lin_srgb"};

// "the OpenColorIO config FILE", for messages.
std::string called(const std::string& config)
{
    return "OpenColorIO config " + printable(config);
}

[[noreturn]] void refuse(const std::string& config, const std::string& key, const std::string& found,
                         const std::vector<std::string>& known)
{
    throw Error("[render] " + key + ": " + called(config) + " has no \"" + printable(found) + "\"." +
                    did_you_mean(found, known),
                known.empty() ? "It has none at all; leave the key out or take another config."
                              : "Use one of: " + printable(join_words(known)) + ".");
}

bool holds(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> displays_of(const ocio::Config& config)
{
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
    return names;
}

std::vector<std::string> views_of(const ocio::Config& config, const std::string& display)
{
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
        names.emplace_back(config.getView(display.c_str(), i));
    return names;
}

std::vector<std::string> spaces_of(const ocio::Config& config)
{
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumColorSpaces(); ++i) names.emplace_back(config.getColorSpaceNameByIndex(i));
    return names;
}

// The config, and its text for the fingerprint ("" where the library has it).
ocio::ConstConfigRcPtr read_config(const std::string& name, const fs::path& folder, std::string& text)
{
    if (name.starts_with("ocio://")) {
#if OCIO_VERSION_HEX < 0x02020000
        throw Error("[render] ocio_config: configs that come with the library, such as \"" + printable(name) +
                        "\", begin with OpenColorIO 2.2; this program has " OCIO_VERSION_FULL_STR,
                    "Name a config file instead.");
#else
        return ocio::Config::CreateFromFile(name.c_str());
#endif
    }
    const fs::path file = folder / name;
    text = read_file(file, "[render] ocio_config", kMostConfigBytes);
    return ocio::Config::CreateFromFile(file.c_str());
}

// What our light is read as.
std::string scene_space_of(const ocio::Config& config, const ColorManagement& asked, std::vector<std::string>& notes)
{
    const auto name_of = [&](const std::string& name) {
        const ocio::ConstColorSpaceRcPtr space = config.getColorSpace(name.c_str());
        return space ? std::string(space->getName()) : std::string();
    };
    if (!asked.scene_space.empty()) {
        const std::string name = name_of(asked.scene_space);  // also by a role or an alias
        if (name.empty()) refuse(asked.config, "ocio_scene_space", asked.scene_space, spaces_of(config));
        return name;
    }
    for (const char* known : kLinearRec709) {
        if (const std::string name = name_of(known); !name.empty()) return name;
    }
    const std::string linear = name_of(ocio::ROLE_SCENE_LINEAR);
    if (linear.empty()) {
        throw Error("[render] ocio_config: " + called(asked.config) +
                        " has neither a role scene_linear nor a space known to be linear Rec. 709, which our light is in",
                    "Name one by ocio_scene_space: " + printable(join_words(spaces_of(config))) + ".");
    }
    notes.push_back(called(asked.config) + ": none of its spaces is known to be linear Rec. 709, so our light is read as "
                    "its scene_linear, \"" + printable(linear) + "\"; another one by [render] ocio_scene_space");
    return linear;
}

}  // namespace

struct DisplayTransform::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

bool has_color_management()
{
    return true;
}

std::string color_management_version()
{
    return ocio::GetVersion();
}

DisplayTransform::DisplayTransform(const ColorManagement& asked, const fs::path& folder)
{
    try {
        std::string text;
        const ocio::ConstConfigRcPtr config = read_config(asked.config, folder, text);
        const auto displays = displays_of(*config);
        display_ = asked.display.empty() ? config->getDefaultDisplay() : asked.display;
        if (!holds(displays, display_)) refuse(asked.config, "ocio_display", display_, displays);
        scene_space_ = scene_space_of(*config, asked, notes_);
        const auto views = views_of(*config, display_);
        view_ = asked.view.empty() ? config->getDefaultView(display_.c_str()) : asked.view;
        if (!holds(views, view_)) refuse(asked.config, "ocio_view of display \"" + display_ + "\"", view_, views);
        if (!asked.look.empty() && !config->getLook(asked.look.c_str())) {
            std::vector<std::string> looks;
            for (int i = 0; i < config->getNumLooks(); ++i) looks.emplace_back(config->getLookNameByIndex(i));
            refuse(asked.config, "ocio_look", asked.look, looks);
        }

        const ocio::DisplayViewTransformRcPtr shown = ocio::DisplayViewTransform::Create();
        shown->setSrc(scene_space_.c_str());
        shown->setDisplay(display_.c_str());
        shown->setView(view_.c_str());
        const ocio::LegacyViewingPipelineRcPtr pipeline = ocio::LegacyViewingPipeline::Create();
        pipeline->setDisplayViewTransform(shown);
        if (!asked.look.empty()) {
            pipeline->setLooksOverrideEnabled(true);
            pipeline->setLooksOverride(asked.look.c_str());
        }
        const ocio::ConstContextRcPtr context = config->getCurrentContext();
        const ocio::ConstProcessorRcPtr whole = pipeline->getProcessor(config, context);
        // Rounding powers and logarithms, as the library does by default, gains nothing.
        processor_ = std::make_shared<Processor>(Processor{whole->getOptimizedCPUProcessor(
            ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32, ocio::OPTIMIZATION_LOSSLESS)});

        Hasher hasher;
        hasher.add(ocio::GetVersion());
        for (const std::string& part : {text.empty() ? asked.config : text, display_, view_, scene_space_, asked.look})
            hasher.add(part);
        hasher.add(context->getCacheID());  // variables that the config takes from the environment
        const ocio::ConstProcessorMetadataRcPtr used = whole->getProcessorMetadata();
        for (int i = 0; i < used->getNumFiles(); ++i) {
            const fs::path table = used->getFile(i);
            hasher.add(table.filename().string());
            // Those inside an archive are a part of its text.
            if (fs::exists(table)) hasher.add(read_file(table, "[render] ocio_config", kMostTableBytes));
        }
        fingerprint_ = hasher.text();
        notes_.insert(notes_.begin(), "pictures are shown by view \"" + printable(view_) + "\" of display \"" +
                                          printable(display_) + "\" of " + called(asked.config) +
                                          ", our light read as \"" + printable(scene_space_) + "\"");
    } catch (const ocio::Exception& problem) {
        throw Error("[render] ocio_config: " + called(asked.config) + ": " + printable(problem.what()),
                    "Mend the config, or name another one.");
    }
}

std::vector<std::uint8_t> DisplayTransform::picture(std::span<const std::uint16_t> light, int width, bool dither, int first_row) const
{
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t rows = light.size() / 4 / columns;
    std::vector<std::uint8_t> codes(light.size());
    std::vector<float> band(std::min(rows, kRows) * columns * 3);
    for (std::size_t first = 0; first < rows; first += kRows) {
        const std::size_t count = std::min(kRows, rows - first);
        const std::size_t begin = first * columns;
        for (std::size_t i = 0; i < count * columns; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                band[i * 3 + c] = glm::unpackHalf1x16(light[(begin + i) * 4 + c]);
        }
        ocio::PackedImageDesc image(band.data(), static_cast<long>(columns), static_cast<long>(count), 3L);
        processor_->cpu->apply(image);
        for (std::size_t i = 0; i < count * columns; ++i) {
            const glm::ivec2 pixel(static_cast<int>(i % columns), first_row + static_cast<int>(first + i / columns));
            const float noise = dither ? shared::dither(pixel, 0u) - 0.5f : 0.0f;
            std::uint8_t* out = &codes[(begin + i) * 4];
            for (std::size_t c = 0; c < 3; ++c) {
                // As the resolve pass rounds; what is not a number is black.
                const float code = band[i * 3 + c] * 255.0f + 0.5f + noise;
                out[c] = code > 0.0f ? static_cast<std::uint8_t>(std::min(code, 255.0f)) : std::uint8_t{0};
            }
            out[3] = 255;
        }
    }
    return codes;
}

}  // namespace petrichor::film

#else

namespace petrichor::film {

struct DisplayTransform::Processor {};

bool has_color_management()
{
    return false;
}

std::string color_management_version()
{
    return "";
}

DisplayTransform::DisplayTransform(const ColorManagement&, const std::filesystem::path&)
{
    throw Error("[render] ocio_config: this program was built without OpenColorIO",
                "Install libopencolorio-dev and build again, or use tone_map.");
}

std::vector<std::uint8_t> DisplayTransform::picture(std::span<const std::uint16_t>, int, bool, int) const
{
    return {};
}

}  // namespace petrichor::film

#endif
