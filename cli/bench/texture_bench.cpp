#include "cli/bench/texture_bench.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/bench/rival.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

// N, R: the maps; P: petrichor; D: the folder to write to.
struct Contest {
    const char* task;
    const char* row;
    const char* program;  // to look for; null: ours
    const char* package;
    const char* command;
    bool slow = false;
};

constexpr Contest kContests[] = {
    {"prefilter", "petrichor median", nullptr, "",
     "$P texture prefilter --rule median --normal $N --roughness $R -o $D/r_%d.png "
     "--normal-out $D/n_%d.png"},
    {"prefilter", "petrichor overlap quick", nullptr, "",
     "$P texture prefilter --quality quick --normal $N --roughness $R -o $D/r_%d.png "
     "--normal-out $D/n_%d.png"},
    {"prefilter", "petrichor overlap full", nullptr, "",
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
    {"pack", "petrichor", nullptr, "",
     "$P texture pack --preset unity-hdrp-mask --metallic $R --occlusion $R --map detail=$R "
     "--smoothness $R -o $D/p.png"},
    {"pack", "oiiotool", "oiiotool", "openimageio-tools",
     "oiiotool $R $R --chappend $R --chappend $R --chappend --chnames R,G,B,A -o $D/o.png"},
    {"pack", "convert", "convert", "imagemagick",
     "convert $R $R $R $R -channel RGBA -combine $D/c.png"},
    {"bc5", "petrichor", nullptr, "",
     "$P texture convert $N -o $D/b.dds --format bc5 --mips --normals"},
    {"bc5", "nvcompress", "nvcompress", "libnvtt-bin", "nvcompress -normal -bc5 $N $D/v.dds"},
};

bool is_installed(const std::string& program)
{
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// In single quotes for the shell.
std::string for_shell(const std::string& text)
{
    std::string to = "'";
    for (const char c : text) to += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return to + "'";
}

class BenchFolder {
public:
    BenchFolder()
    {
        std::string name = (fs::temp_directory_path() / "petrichor-bench-XXXXXX").string();
        if (!::mkdtemp(name.data())) {
            throw Error("bench: cannot make a folder in " + fs::temp_directory_path().string(),
                        "Set TMPDIR to a folder that you may write to.");
        }
        path_ = name;
    }
    BenchFolder(const BenchFolder&) = delete;
    BenchFolder& operator=(const BenchFolder&) = delete;
    ~BenchFolder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

TextureBenchRow timed_row(const Contest& contest, const std::string& settings, int repeat)
{
    TextureBenchRow row{contest.task, contest.row, {}, ""};
    if (contest.program && !is_installed(contest.program)) {
        row.note = std::string("missing: apt install ") + contest.package;
        return row;
    }
    try {
        row.cost = time_rival({contest.row, settings + contest.command}, repeat);
    } catch (const Error& error) {
        row.note = error.what();
    }
    return row;
}

// A generated wall in 16 bits where no maps were named.
void make_maps(TextureBenchOptions& o, const fs::path& folder)
{
    if (!o.normal.empty() && !o.roughness.empty()) return;
    time_rival(
        {"generate", for_shell(o.petrichor.string()) + " texture generate brick --bits 16 " +
                         "--size " + std::to_string(o.size) + " -o " + for_shell(folder.string())},
        1);
    o.normal = (folder / "brick_normal.png").string();
    o.roughness = (folder / "brick_roughness.png").string();
}

}  // namespace

std::vector<TextureBenchRow> texture_rows(const TextureBenchOptions& options)
{
    TextureBenchOptions o = options;
    if (o.normal.empty() != o.roughness.empty()) {
        throw Error("bench texture: --normal and --roughness belong together",
                    "Give both, or neither for a generated wall.");
    }
    for (const std::string& map : {o.normal, o.roughness}) {
        if (!map.empty() && !fs::exists(map)) {
            throw Error("bench texture: there is no file " + map, "Check the path.");
        }
    }
    if (o.petrichor.empty()) o.petrichor = fs::read_symlink("/proc/self/exe");
    const BenchFolder folder;
    make_maps(o, folder.path());
    const std::string settings = "P=" + for_shell(o.petrichor.string()) +
                                 " N=" + for_shell(o.normal) + " R=" + for_shell(o.roughness) +
                                 " D=" + for_shell(folder.path().string()) + "; ";
    std::vector<TextureBenchRow> rows;
    for (const Contest& contest : kContests) {
        if (contest.slow && !o.full) continue;
        rows.push_back(timed_row(contest, settings, o.repeat));
    }
    return rows;
}

std::string to_text(const std::vector<TextureBenchRow>& rows)
{
    std::string text = "task       program                    CPU s   wall s\n";
    for (const TextureBenchRow& row : rows) {
        char line[200];
        if (row.cost) {
            std::snprintf(line, sizeof line, "%-10s %-24s %7.2f  %7.2f\n", row.task.c_str(),
                          row.program.c_str(), 1e-3 * row.cost->cpu_ms, 1e-3 * row.cost->wall_ms);
        } else {
            std::snprintf(line, sizeof line, "%-10s %-24s %s\n", row.task.c_str(),
                          row.program.c_str(), row.note.substr(0, 120).c_str());
        }
        text += line;
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
        } else {
            one["note"] = row.note;
        }
        all.push_back(one);
    }
    return nlohmann::ordered_json{{"rows", all}}.dump(1) + "\n";
}

}  // namespace petrichor::cli
