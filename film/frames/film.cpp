#include "film/frames/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

struct ProcessResult {
    int status = 0;
    std::string last_words;  ///< the end of what it printed
};

// Runs a program without a shell, stdin closed, and collects what it prints.
ProcessResult run_program(const std::vector<std::string>& arguments)
{
    int pipe_ends[2];
    if (::pipe2(pipe_ends, O_CLOEXEC) != 0) {
        throw Error("film: cannot start " + arguments[0] + ": " + std::strerror(errno),
                    "Close some programs and try again.");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], 1);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], 2);
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int failed = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[1]);
    ProcessResult result;
    if (failed == 0) {
        char buffer[4096];
        for (;;) {
            const ssize_t got = ::read(pipe_ends[0], buffer, sizeof buffer);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            result.last_words.append(buffer, static_cast<std::size_t>(got));
            if (result.last_words.size() > 8192) result.last_words.erase(0, 4096);
        }
        while (::waitpid(child, &result.status, 0) < 0 && errno == EINTR) {
        }
    }
    ::close(pipe_ends[0]);
    if (failed != 0) {
        throw Error("film: cannot start " + arguments[0] + ": " + std::strerror(failed),
                    "Check that it runs by itself.");
    }
    return result;
}

}  // namespace

std::string find_ffmpeg()
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    std::string folder;
    while (std::getline(folders, folder, ':')) {
        const fs::path candidate = fs::path(folder.empty() ? "." : folder) / "ffmpeg";
        std::error_code ignored;
        if (fs::is_regular_file(candidate, ignored) && ::access(candidate.c_str(), X_OK) == 0) {
            return candidate.string();
        }
    }
    return "";
}

void make_film(const fs::path& folder, const std::string& suffix, int first, int count, double fps,
               const fs::path& film)
{
    OutputFile output(film);
    // One thread, no dates: the same frames give the same film.
    const ProcessResult result = run_program(
        {find_ffmpeg(), "-nostdin", "-y", "-loglevel", "error", "-threads", "1", "-framerate",
         number_text(fps), "-start_number", std::to_string(first), "-i",
         (folder / ("frame_%04d" + suffix + ".png")).string(), "-frames:v", std::to_string(count),
         // sRGB pictures become video with the matrix and range written into the file.
         "-vf",
         "crop=trunc(iw/2)*2:trunc(ih/"
         "2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
         "-c:v", "libx264", "-crf", "16", "-preset", "medium", "-pix_fmt", "yuv420p", "-colorspace",
         "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv",
         "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags",
         "+faststart", output.temporary().string()});
    if (!WIFEXITED(result.status) || WEXITSTATUS(result.status) != 0) {
        throw Error("film: ffmpeg failed: " + result.last_words,
                    "The frames are kept; render with --no-film, or make the film by hand.");
    }
    output.commit();
}

}  // namespace petrichor::film
