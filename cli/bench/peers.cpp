#include "cli/bench/peers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/bench/rival.h"
#include "cli/bench/shell.h"
#include "film/data/folders.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

struct Peer {
    const char* name;
    const char* command;                // with $PEERS, $SCRIPTS; the task follows (see data/peers)
    std::vector<const char*> programs;  // of Debian, as its packages are called
    std::vector<const char*> modules;   // of npm
};

const std::vector<Peer>& all_peers()
{
    static const std::vector<Peer> peers = {
        {"three.js",
         "node \"$SCRIPTS/browser.mjs\" \"$SCRIPTS/three.html\"",
         {"node", "chromium"},
         {"three", "puppeteer-core"}},
        {"Filament",
         "node \"$SCRIPTS/browser.mjs\" \"$SCRIPTS/filament.html\"",
         {"node", "chromium"},
         {"filament", "puppeteer-core"}},
        {"Blender EEVEE",
         "xvfb-run -a blender -b --factory-startup -noaudio --python-exit-code 1 "
         "--python \"$SCRIPTS/blender.py\" -- BLENDER_EEVEE",
         {"blender", "xvfb-run"},
         {}},
        {"Blender Cycles",
         "blender -b --factory-startup -noaudio --python-exit-code 1 "
         "--python \"$SCRIPTS/blender.py\" -- CYCLES",
         {"blender"},
         {}},
    };
    return peers;
}

std::string package_of(const std::string& program)
{
    if (program == "node") return "nodejs";
    if (program == "xvfb-run") return "xvfb xauth";
    return program == "blender" ? "blender python3-numpy" : program;
}

// How to install what the peer lacks here; empty: nothing.
std::string missing(const Peer& peer, const fs::path& modules)
{
    std::string apt, npm;
    for (const char* program : peer.programs) {
        if (!is_installed(program)) apt += " " + package_of(program);
    }
    for (const char* module : peer.modules) {
        if (!fs::exists(modules / "node_modules" / module)) npm += std::string(" ") + module;
    }
    std::string words;
    if (!apt.empty()) words = "apt install" + apt;
    if (!npm.empty()) {
        words += std::string(words.empty() ? "" : "; ") + "npm install --prefix " +
                 for_shell(modules.string()) + npm;
    }
    return words;
}

std::vector<double> numbers_of(const nlohmann::json& report, const char* key)
{
    std::vector<double> numbers;
    if (!report.contains(key) || !report[key].is_array()) return numbers;
    for (const auto& number : report[key]) {
        if (number.is_number()) numbers.push_back(number.get<double>());
    }
    return numbers;
}

// What the script wrote about its frames.
void read_report(const fs::path& file, PeerRow& row)
{
    std::ifstream in(file);
    const nlohmann::json report = nlohmann::json::parse(in, nullptr, false);
    const std::vector<double> cpu =
        report.is_object() ? numbers_of(report, "cpu_ms") : std::vector<double>{};
    if (cpu.empty()) {
        row.note = "it drew, and told no times";
        return;
    }
    row.cost = Cost{median(cpu), median(numbers_of(report, "wall_ms")), 0.0};
    if (report.contains("version") && report["version"].is_string())
        row.version = report["version"];
}

void check_picture(const fs::path& file, const Image& ours, PeerRow& row)
{
    if (!fs::exists(file)) {
        row.note = "it left no picture: its time does not count";
        return;
    }
    row.likeness = likeness(ours, texproc::read_image(file, {.space = ColorSpace::Data}));
    if (*row.likeness < kSameScene) row.note = "another picture: its time does not count";
}

PeerRow run_peer(const Peer& peer, const PeerTask& task, const fs::path& scripts, const Image& ours,
                 const fs::path& folder)
{
    PeerRow row;
    row.name = peer.name;
    if (const std::string words = missing(peer, task.modules); !words.empty()) {
        row.note = "missing: " + words;
        return row;
    }
    std::string file = peer.name;
    std::replace(file.begin(), file.end(), ' ', '-');
    const fs::path picture =
        (task.pictures.empty() ? folder : fs::absolute(task.pictures)) / (file + ".png");
    const fs::path report = folder / (file + ".json");
    const std::string command =
        "PEERS=" + for_shell(fs::absolute(task.modules).string()) +
        " SCRIPTS=" + for_shell(scripts.string()) +
        " CHROMIUM=$(command -v chromium); export PEERS SCRIPTS CHROMIUM; exec timeout -k 5 " +
        std::to_string(task.limit_s) + " " + peer.command + " " +
        for_shell(fs::absolute(task.scene).string()) + " " + std::to_string(task.width) + " " +
        std::to_string(task.height) + " " + std::to_string(task.repeat) + " " +
        for_shell(picture.string()) + " " + for_shell(report.string());
    Cost whole;
    try {
        whole = timed([&] { run_once({peer.name, command}); });
        read_report(report, row);
        if (row.cost) check_picture(picture, ours, row);
    } catch (const Error& error) {
        row.note = error.what();
        if (row.note.find("exit code 124") != std::string::npos) {
            row.note = "ended after " + std::to_string(task.limit_s) + " s (--peer-limit)";
        }
    }
    return row;
}

// Mean codes of blocks, channel by channel.
std::vector<double> block_means(const Image& image)
{
    constexpr int kSide = 16;
    const int columns = (image.width + kSide - 1) / kSide,
              rows = (image.height + kSide - 1) / kSide;
    const int channels = std::min(3, image.channels);
    std::vector<double> means;
    for (int block = 0; block < columns * rows; ++block) {
        const int x0 = block % columns * kSide, y0 = block / columns * kSide;
        const int x1 = std::min(image.width, x0 + kSide), y1 = std::min(image.height, y0 + kSide);
        for (int c = 0; c < channels; ++c) {
            double sum = 0.0;
            for (int y = y0; y < y1; ++y) {
                for (int x = x0; x < x1; ++x) sum += static_cast<double>(image.at(x, y, c));
            }
            means.push_back(sum / ((x1 - x0) * (y1 - y0)));
        }
    }
    return means;
}

std::string line_of(const std::string& name, const Cost& cost, double ours_ms,
                    std::optional<double> alike, bool counts)
{
    char line[160];
    std::snprintf(line, sizeof line, "  %-24s %12.2f %12.2f", name.c_str(), cost.cpu_ms,
                  cost.wall_ms);
    std::string text = line;
    std::snprintf(line, sizeof line, counts ? "  %7.2f x" : "        - ", cost.cpu_ms / ours_ms);
    text += line;
    if (alike) {
        std::snprintf(line, sizeof line, "  %8.3f", *alike);
        text += line;
    }
    return text;
}

}  // namespace

double likeness(const Image& ours, const Image& theirs)
{
    if (ours.width != theirs.width || ours.height != theirs.height || ours.channels < 3 ||
        theirs.channels < 3) {
        throw Error("bench: the picture of a peer has " + std::to_string(theirs.width) + " x " +
                        std::to_string(theirs.height) + " pixels, ours " +
                        std::to_string(ours.width) + " x " + std::to_string(ours.height),
                    "Try another --size.");
    }
    const std::vector<double> a = block_means(ours), b = block_means(theirs);
    double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        mean_a += a[i] / static_cast<double>(a.size());
        mean_b += b[i] / static_cast<double>(b.size());
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

std::vector<PeerRow> compare_peers(const PeerTask& task, const Image& ours)
{
    const fs::path scripts = fs::absolute(film::data_folder() / "peers");
    if (!fs::exists(scripts)) {
        throw Error("bench: there is no folder " + scripts.string(),
                    "Install petrichor whole, or unset PETRICHOR_DATA.");
    }
    if (!task.pictures.empty()) film::require_writable_folder(task.pictures);
    const BenchFolder folder;
    std::vector<PeerRow> rows;
    for (const Peer& peer : all_peers()) {
        rows.push_back(run_peer(peer, task, scripts, ours, folder.path()));
    }
    return rows;
}

std::string peers_text(const Cost& ours, const std::vector<PeerRow>& rows)
{
    std::string text =
        "  renderer                   CPU ms/frame         wall ms      CPU  likeness\n";
    text += line_of("petrichor", ours, ours.cpu_ms, {}, true) + "\n";
    for (const PeerRow& row : rows) {
        const std::string name = row.version.empty() ? row.name : row.name + " " + row.version;
        if (row.cost) {
            const bool counts = row.likeness.value_or(0.0) >= kSameScene;
            text += line_of(name, *row.cost, ours.cpu_ms, row.likeness, counts);
        } else {
            char start[40];
            std::snprintf(start, sizeof start, "  %-24s", name.c_str());
            text += start;
        }
        if (!row.note.empty()) text += "  " + row.note;
        text += "\n";
    }
    return text;
}

}  // namespace petrichor::cli
