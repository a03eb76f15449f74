#include "film/frames/film.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"
#include "base/limited_child.h"
#include "base/output_file.h"
#include "base/words.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = 1ull << 30;  // of one picture

struct Socket {
    int ours = -1, theirs = -1;
    Socket()
    {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
            throw Error(std::string("film: cannot start ffmpeg: ") + std::strerror(errno),
                        "Close some programs and try again.");
        }
        ours = ends[0];
        theirs = ends[1];
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket()
    {
        shut(ours);
        shut(theirs);
    }
    static void shut(int& end)
    {
        if (end >= 0) ::close(end);
        end = -1;
    }
};

// Pictures into one end, words out of the other. Sockets: a program that ends early shows as a
// failed write, not as a signal.
class Encoder {
public:
    Encoder(const std::vector<std::string>& words, const StopRequest& stop)
        : stop_(stop),
          child_(words.front(), {words.begin() + 1, words.end()}, {},
                 {{pictures_.theirs, 0}, {said_.theirs, 1}, {said_.theirs, 2}}, Trust::Full)
    {
        Socket::shut(pictures_.theirs);
        Socket::shut(said_.theirs);
    }

    // False: it takes no more.
    bool send(std::string_view bytes)
    {
        while (!bytes.empty()) {
            const auto ready = wait(true);
            if (ready & kWrite) {
                const ssize_t n =
                    ::send(pictures_.ours, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
                if (n < 0 && errno != EINTR && errno != EAGAIN) return false;
                if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
            }
        }
        return true;
    }

    ChildEnd finish()
    {
        Socket::shut(pictures_.ours);
        while (said_.ours >= 0) wait(false);
        return child_.end(false);
    }
    const std::string& last_words() const { return last_words_; }

private:
    static constexpr int kWrite = 1;
    int wait(bool to_write)
    {
        if (stop_ && stop_()) throw Interrupted("interrupted while making the film");
        pollfd ends[2] = {{said_.ours, POLLIN, 0}, {to_write ? pictures_.ours : -1, POLLOUT, 0}};
        if (::poll(ends, 2, 50) <= 0) return 0;
        if (ends[0].revents != 0) {
            char buffer[4096];
            const ssize_t got = ::recv(said_.ours, buffer, sizeof buffer, MSG_DONTWAIT);
            if (got > 0) {
                last_words_.append(buffer, static_cast<std::size_t>(got));
                if (last_words_.size() > 8192) last_words_.erase(0, 4096);
            } else if (got == 0 || (errno != EINTR && errno != EAGAIN)) {
                Socket::shut(said_.ours);
            }
        }
        return ends[1].revents != 0 ? kWrite : 0;
    }

    const StopRequest& stop_;
    Socket pictures_, said_;
    std::string last_words_;
    LimitedChild child_;
};

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

void make_film(const fs::path& folder, Job first, int count, double fps, const fs::path& film,
               const StopRequest& stop)
{
    const int start = first.frame;
    make_film(
        [&](int i) {
            first.frame = start + i;
            return read_file(folder / file_name(first, "png"), "film", kMostBytes, stop);
        },
        count, fps, film, stop);
}

void make_film(const std::function<std::string(int)>& picture, int count, double fps, const fs::path& film,
               const StopRequest& stop)
{
    OutputFile output(film);
    // Pictures go in through a pipe and the film's name behind "file:", so that no folder is taken
    // for an option, a pattern or a protocol. One thread, no dates: the same frames give the same
    // film.
    Encoder encoder(
        {find_ffmpeg(), "-nostdin", "-y", "-loglevel", "error", "-threads", "1", "-f", "image2pipe",
         "-c:v", "png", "-framerate", number_text(fps), "-i", "pipe:0", "-frames:v",
         std::to_string(count),
         // sRGB pictures become video with the matrix and range written into the file.
         "-vf",
         "crop=trunc(iw/2)*2:trunc(ih/"
         "2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
         "-c:v", "libx264", "-crf", "16", "-preset", "medium", "-pix_fmt", "yuv420p", "-colorspace",
         "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv",
         "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags",
         "+faststart", "file:" + fs::absolute(output.temporary()).string()},
        stop);
    for (int i = 0; i < count; ++i) {
        if (!encoder.send(picture(i))) break;
    }
    const ChildEnd end = encoder.finish();
    if (!end.exited || end.code != 0) {
        const std::string words = encoder.last_words();
        throw Error("film: ffmpeg " + (words.empty() ? end.text() : "failed: " + words),
                    "The frames are kept; render with --no-film, or make the film by hand.");
    }
    output.commit();
}

}  // namespace petrichor::film
