#include "cli/bench/texture_bench.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "cli/bench/rival.h"
#include "cli/bench/shell.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

// N, R, C: the maps; P: petrichor; D: the folder to write to.
struct Contest {
    const char* task;
    const char* row;
    const char* program;  // to look for; null: ours
    const char* package;
    const char* command;
    bool slow = false;
    // Of what was compressed: reference, result and the channels that it kept (empty: all).
    const char *reference = nullptr, *result = nullptr, *channels = "";
};

constexpr Contest kContests[] = {
    {"prefilter", "petrichor median", nullptr, "",
     "$P texture prefilter --rule median --normal $N --roughness $R -o $D/r_%d.png "
     "--normal-out $D/n_%d.png"},
    {"prefilter", "petrichor picture quick", nullptr, "",
     "$P texture prefilter --quality quick --normal $N --roughness $R -o $D/r_%d.png "
     "--normal-out $D/n_%d.png"},
    {"prefilter", "petrichor picture full", nullptr, "",
     "$P texture prefilter --normal $N --roughness $R -o $D/r_%d.png --normal-out $D/n_%d.png",
     true},
    {"prefilter", "roughness-prefilter", "roughness-prefilter", "libfilament-tools",
     "roughness-prefilter --roughness-map=$R $N $D/f_%d.png"},
    {"mips", "petrichor", nullptr, "", "$P texture mips $N --normals --bits 16 -o $D/m_%d.png"},
    {"mips", "petrichor lanczos3", nullptr, "",
     "$P texture mips $N --normals --filter lanczos3 --bits 16 -o $D/m_%d.png"},
    {"mips", "mipgen normals", "mipgen", "libfilament-tools",
     "mipgen --quiet --linear --kernel=normals $N $D/g_%d.png"},
    {"mips", "maketx", "maketx", "openimageio-tools", "maketx $N -o $D/x.exr"},
    {"pack", "petrichor png", nullptr, "",
     "$P texture pack --preset unity-hdrp-mask --metallic $R --occlusion $R --map detail=$R "
     "--smoothness $R --bits 16 -o $D/p.png"},
    {"pack", "petrichor dds", nullptr, "",
     "$P texture pack --preset unity-hdrp-mask --metallic $R --occlusion $R --map detail=$R "
     "--smoothness $R -o $D/p.dds"},
    {"pack", "oiiotool", "oiiotool", "openimageio-tools",
     "oiiotool $R $R --chappend $R --chappend $R --chappend --chnames R,G,B,A -o $D/o.png"},
    {"pack", "convert", "convert", "imagemagick",
     "convert $R $R $R $R -channel RGBA -combine $D/c.png"},
    {"bc5", "petrichor fast", nullptr, "",
     "$P texture convert $N -o $D/b.dds --format bc5 --mips --normals --quality fast", false, "$N",
     "$D/b.dds", "rg"},
    {"bc5", "petrichor", nullptr, "",
     "$P texture convert $N -o $D/b.dds --format bc5 --mips --normals", false, "$N", "$D/b.dds",
     "rg"},
    {"bc5", "nvcompress", "nvcompress", "libnvtt-bin", "nvcompress -normal -bc5 $N $D/v.dds", false,
     "$N", "$D/v.dds", "rg"},
    {"bc5", "nvcompress fast", "nvcompress", "libnvtt-bin",
     "nvcompress -fast -normal -bc5 $N $D/v.dds", false, "$N", "$D/v.dds", "rg"},
    {"bc7", "petrichor fast", nullptr, "",
     "$P texture convert $C -o $D/b.dds --format bc7 --quality fast", false, "$C", "$D/b.dds"},
    {"bc7", "petrichor", nullptr, "", "$P texture convert $C -o $D/b.dds --format bc7", false, "$C",
     "$D/b.dds"},
    // The packaged one writes no BC7: the best that it has for colour.
    {"bc7", "nvcompress bc1", "nvcompress", "libnvtt-bin", "nvcompress -nomips -bc1 $C $D/v.dds",
     false, "$C", "$D/v.dds", "rgb"},
    {"bc7", "nvcompress bc1 fast", "nvcompress", "libnvtt-bin",
     "nvcompress -nomips -fast -bc1 $C $D/v.dds", false, "$C", "$D/v.dds", "rgb"},
};

// What a command of the shell prints.
std::string output_of(const std::string& command)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"),
                                                               ::pclose);
    std::string text;
    for (int c = pipe ? std::fgetc(pipe.get()) : EOF; c != EOF; c = std::fgetc(pipe.get())) {
        text += static_cast<char>(c);
    }
    return text;
}

// Over all channels together, from the mean of their squared errors.
std::optional<double> psnr_of(const Contest& contest, const std::string& settings)
{
    std::vector<std::string> channels;
    for (const char* c = contest.channels; *c; ++c) channels.push_back(std::string(":") + *c);
    if (channels.empty()) channels.emplace_back();
    double squared = 0.0;
    for (const std::string& channel : channels) {
        const std::string answer =
            output_of(settings + "$P texture compare --json --psnr-only --kind color " +
                      contest.reference + channel + " " + contest.result + channel);
        const auto json = nlohmann::json::parse(answer, nullptr, false);
        if (!json.is_object() || !json.contains("psnr_db") || !json["psnr_db"].is_number())
            return {};
        squared += std::pow(10.0, -0.1 * json["psnr_db"].get<double>());
    }
    return -10.0 * std::log10(squared / static_cast<double>(channels.size()));
}

TextureBenchRow timed_row(const Contest& contest, const std::string& settings, int repeat)
{
    TextureBenchRow row{contest.task, contest.row, {}, {}, ""};
    if (contest.program && !is_installed(contest.program)) {
        row.note = std::string("missing: apt install ") + contest.package;
        return row;
    }
    try {
        row.cost = time_rival({contest.row, settings + contest.command}, repeat);
        if (contest.result) row.psnr_db = psnr_of(contest, settings);
    } catch (const Error& error) {
        row.note = error.what();
    }
    return row;
}

// The filter alone, without files, beside what memory can move: as the program itself measures it,
// in the run that took the median CPU time.
TextureBenchRow kernel_row(const std::string& settings, int repeat)
{
    struct Run {
        Cost cost;
        std::string words;
    };
    std::vector<Run> runs;
    for (int i = 0; i < repeat; ++i) {
        std::istringstream lines(
            output_of(settings +
                      "$P texture prefilter --timings --rule median --normal $N --roughness $R "
                      "-o $D/r_%d.png --normal-out $D/n_%d.png"));
        for (std::string line; std::getline(lines, line);) {
            Run run;
            double cpu_s = 0.0, wall_s = 0.0;
            if (std::sscanf(line.c_str(), "kernel %lf CPU-s %lf s", &cpu_s, &wall_s) != 2) continue;
            run.cost = {1e3 * cpu_s, 1e3 * wall_s, 0.0};
            run.words = line.substr(std::min(line.size(), line.find(": ") + 2));
            runs.push_back(run);
        }
    }
    TextureBenchRow row{"prefilter", "petrichor median kernel", {}, {}, "prefilter failed"};
    if (runs.empty()) return row;
    std::sort(runs.begin(), runs.end(),
              [](const Run& a, const Run& b) { return a.cost.cpu_ms < b.cost.cpu_ms; });
    row.cost = runs[runs.size() / 2].cost;
    row.note = runs[runs.size() / 2].words;
    return row;
}

// A generated wall in 16 bits where no maps were named.
void make_maps(TextureBenchOptions& o, const fs::path& folder)
{
    if (o.normal.empty()) {
        const std::string command = for_shell(o.petrichor.string()) +
                                    " texture generate brick --bits 16 --size " +
                                    std::to_string(o.size) + " -o " + for_shell(folder.string());
        if (std::system((command + " >/dev/null").c_str()) != 0) {
            throw Error("bench texture: the wall could not be generated",
                        "Run by itself to see why: " + command);
        }
        o.normal = (folder / "brick_normal.png").string();
        o.roughness = (folder / "brick_roughness.png").string();
        if (o.color.empty()) o.color = (folder / "brick_albedo.png").string();
    }
    if (o.color.empty()) o.color = o.normal;
}

}  // namespace

std::vector<TextureBenchRow> texture_rows(const TextureBenchOptions& options)
{
    TextureBenchOptions o = options;
    if (o.normal.empty() != o.roughness.empty()) {
        throw Error("bench texture: --normal and --roughness belong together",
                    "Give both, or neither for a generated wall.");
    }
    for (const std::string& map : {o.normal, o.roughness, o.color}) {
        if (!map.empty() && !fs::exists(map)) {
            throw Error("bench texture: there is no file " + map, "Check the path.");
        }
    }
    if (o.petrichor.empty()) o.petrichor = fs::read_symlink("/proc/self/exe");
    const BenchFolder folder;
    make_maps(o, folder.path());
    const std::string settings = "P=" + for_shell(o.petrichor.string()) +
                                 " N=" + for_shell(o.normal) + " R=" + for_shell(o.roughness) +
                                 " C=" + for_shell(o.color) +
                                 " D=" + for_shell(folder.path().string()) + "; ";
    std::vector<TextureBenchRow> rows;
    for (const Contest& contest : kContests) {
        if (contest.slow && !o.full) continue;
        rows.push_back(timed_row(contest, settings, o.repeat));
        if (rows.size() == 1) rows.push_back(kernel_row(settings, o.repeat));
    }
    return rows;
}

std::string to_text(const std::vector<TextureBenchRow>& rows)
{
    std::string text = "task       program                    CPU s   wall s     MiB  PSNR dB\n";
    const auto number = [](const char* format, std::optional<double> value) {
        char cell[40];
        std::snprintf(cell, sizeof cell, format, value.value_or(0.0));
        return value ? std::string(cell) : std::string(std::strlen(cell), ' ');
    };
    for (const TextureBenchRow& row : rows) {
        char line[80];
        std::snprintf(line, sizeof line, "%-10s %-24s", row.task.c_str(), row.program.c_str());
        text += line;
        if (row.cost) {
            const double mib = row.cost->peak_mib;
            text += number(" %7.2f", 1e-3 * row.cost->cpu_ms);
            text += number("  %7.2f", 1e-3 * row.cost->wall_ms);
            text += number(" %7.0f", mib > 0.0 ? std::optional(mib) : std::nullopt);
            text += number("  %7.2f", row.psnr_db);
        }
        if (!row.note.empty()) text += (row.cost ? "  " : " ") + row.note.substr(0, 120);
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

std::string to_json(const std::vector<TextureBenchRow>& rows)
{
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const TextureBenchRow& row : rows) {
        nlohmann::ordered_json one{{"task", row.task}, {"program", row.program}};
        if (row.cost) {
            one["cpu_s"] = 1e-3 * row.cost->cpu_ms;
            one["wall_s"] = 1e-3 * row.cost->wall_ms;
            if (row.cost->peak_mib > 0.0) one["peak_mib"] = row.cost->peak_mib;
        }
        if (row.psnr_db) one["psnr_db"] = *row.psnr_db;
        if (!row.note.empty()) one["note"] = row.note;
        all.push_back(one);
    }
    return nlohmann::ordered_json{{"rows", all}}.dump(1, ' ', false,
                                                      nlohmann::json::error_handler_t::replace) +
           "\n";
}

}  // namespace petrichor::cli
