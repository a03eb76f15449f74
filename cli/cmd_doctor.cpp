// petrichor doctor: what works on this machine, what is missing, how to get it.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/content_cache.h"
#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/rooms.h"
#include "film/color/display_transform.h"
#include "film/data/folders.h"
#include "film/frames/film.h"
#include "film/weather/packed.h"
#include "gpu/device/specialize.h"
#include "gpu/renderer.h"
#include "scene/gltf/gltf.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/files/io.h"
#include "weather/readers/formats.h"

namespace petrichor::cli {
namespace {

using Json = nlohmann::ordered_json;

// One line of the report.
struct Finding {
    std::string name;
    bool works = false;
    bool needed = false;  ///< rendering is impossible without it
    std::string detail;
    std::string fix;  ///< what to do, when it does not work
};

Finding check_devices(const std::vector<gpu::DeviceInfo>& devices)
{
    Finding finding{"vulkan", false, true, "", ""};
    for (const gpu::DeviceInfo& device : devices) finding.works = finding.works || device.usable;
    if (finding.works) {
        finding.detail = "rendering works";
        return finding;
    }
    finding.detail = devices.empty() ? "no Vulkan driver found" : "no Vulkan device is good enough";
    finding.fix =
        "Install a Vulkan 1.3 driver; on any CPU: apt-get install mesa-vulkan-drivers (lavapipe). "
        "If VK_ICD_FILENAMES or VK_DRIVER_FILES is set, check that it names existing files.";
    return finding;
}

Finding check_ffmpeg()
{
    const std::string program = find_ffmpeg();
    if (program.empty()) {
        return {"ffmpeg", false, false, "not found: no films", "apt-get install ffmpeg"};
    }
    return {"ffmpeg", true, false, program, ""};
}

Finding check_data()
{
    const auto folder = find_data_folder();
    if (!folder) {
        return {"data", false, true, "data folder not found",
                "Set PETRICHOR_DATA to the folder that holds scenarios/ and weather/."};
    }
    return {"data", true, true, folder->string(), ""};
}

Finding check_cache()
{
    const auto folder = cache_folder();
    try {
        const ContentCache cache = user_cache();
        if (!cache.on()) {
            return {"cache", true, false, "off (PETRICHOR_CACHE_MIB is 0): every start is cold",
                    ""};
        }
        require_writable_folder(folder);
        return {"cache", true, false,
                folder.string() + ", " + std::to_string((cache.size() + (1u << 19)) >> 20) +
                    " of at most " + std::to_string(cache.max_bytes() >> 20) +
                    " MiB used (PETRICHOR_CACHE_MIB)",
                ""};
    } catch (const Error& error) {
        return {
            "cache", false, false, error.what(),
            "Set PETRICHOR_CACHE to a folder you may write to, PETRICHOR_CACHE_MIB to a number."};
    }
}

std::vector<std::string> weather_kinds()
{
    std::vector<std::string> names;
    for (const weather::Reader* reader : weather::weather_readers()) names.push_back(reader->name);
    return names;
}

// Damaged and hostile images are read by a process of its own; how well it is locked in.
Finding check_decoder()
{
    try {
        const std::string text = texproc::decoder_confinement();
        return {
            "sandbox", text.rfind("seccomp", 0) == 0, false, text,
            "Build with libseccomp (Debian: apt-get install libseccomp-dev) on a kernel that has "
            "seccomp; until then give it only images that you trust."};
    } catch (const Error& error) {
        return {"sandbox", false, true, error.what(), error.fix()};
    }
}

Finding check_shaders()
{
    if (gpu::can_specialize()) {
        return {"shaders", true, false, "cut down to what a picture uses before the driver sees them",
                ""};
    }
    return {"shaders", false, false, "given to the driver whole: the first frame takes longer",
            "Build with SPIRV-Tools (Debian: apt-get install spirv-tools)."};
}

void print_json(const std::vector<Finding>& findings, const std::vector<gpu::DeviceInfo>& devices,
                bool can_render)
{
    Json report;
    report["version"] = PETRICHOR_VERSION;
    report["can_render"] = can_render;
    report["threads"] = std::thread::hardware_concurrency();
    report["devices"] = Json::array();
    for (const gpu::DeviceInfo& device : devices) {
        report["devices"].push_back({{"name", device.name},
                                     {"driver", device.driver},
                                     {"kind", device.kind},
                                     {"api_version", device.api_version},
                                     {"usable", device.usable},
                                     {"why_not", device.why_not}});
    }
    report["checks"] = Json::array();
    for (const Finding& one : findings) {
        report["checks"].push_back({{"name", one.name},
                                    {"works", one.works},
                                    {"needed", one.needed},
                                    {"detail", one.detail},
                                    {"fix", one.fix}});
    }
    report["weather_presets"] = preset_names("weather");
    report["scenarios"] = preset_names("scenarios");
    report["weather_files"] = weather_kinds();
    report["packed_weather_files"] = packed_kinds();
    std::cout << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

void print_text(const std::vector<Finding>& findings, const std::vector<gpu::DeviceInfo>& devices,
                bool can_render)
{
    std::cout << "petrichor " PETRICHOR_VERSION ", " << std::thread::hardware_concurrency()
              << " threads\n";
    int index = 0;
    for (const gpu::DeviceInfo& device : devices) {
        std::cout << (device.usable ? "  ok    " : "  no    ") << "device " << index++ << ": "
                  << device.name << " (" << device.kind << ", Vulkan " << device.api_version << ", "
                  << device.driver << ")";
        if (!device.usable) std::cout << ": " << device.why_not;
        std::cout << "\n";
    }
    for (const Finding& one : findings) {
        std::cout << (one.works    ? "  ok    "
                      : one.needed ? "  MISSING "
                                   : "  no    ")
                  << one.name << ": " << one.detail << "\n";
        if (!one.works) std::cout << "        " << one.fix << "\n";
    }
    std::cout << "  weather presets: " << join_words(preset_names("weather"))
              << "\n  scenarios: " << join_words(preset_names("scenarios"))
              << "\n  weather files: " << join_words(weather_kinds())
              << "; packed: " << packed_kinds() << "\n"
              << (can_render ? "ready to render\n" : "cannot render: see above\n");
}

Finding check_draco()
{
    const bool works = scene::reads_draco();
    return {"Draco meshes", works, false, works ? "read" : "scenes with them are refused",
            "Install libdraco-dev and build again."};
}

Finding check_astc()
{
    const bool works = texproc::has_astc();
    return {"ASTC textures", works, false, works ? "written and read" : "neither written nor read",
            "Install libastcenc-dev and build again."};
}

Finding check_color_management()
{
    const bool works = film::has_color_management();
    return {"OpenColorIO configs", works, false,
            works ? "read, by the library " + film::color_management_version() : "refused: pictures have our own curves",
            "Install libopencolorio-dev and build again."};
}

void doctor(bool json)
{
    const auto devices = gpu::list_devices();
    const std::vector<Finding> findings{check_devices(devices), check_data(), check_ffmpeg(),
                                        check_decoder(), check_cache(),
                                        check_shaders(), check_draco(), check_astc(),
                                        check_color_management()};
    bool can_render = true;
    for (const Finding& one : findings) can_render = can_render && (one.works || !one.needed);
    if (json) {
        print_json(findings, devices, can_render);
    } else {
        print_text(findings, devices, can_render);
    }
    if (!can_render) throw ExitCode{kExitUser};
}

}  // namespace

void add_doctor(CLI::App& app)
{
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand(
        "doctor", "Tell what works on this machine, what is missing, how to get it.");
    command->add_flag("--json", *json, "the same for programs");
    command->footer(
        "Example: petrichor doctor --json\nExit code 2 when rendering is impossible here.");
    command->callback([json] { doctor(*json); });
}

}  // namespace petrichor::cli
