#include "cli/texture/build/watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "cli/signals.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

constexpr int kQuiet_ms = 150;      // no change for so long: the row is over
constexpr int kInterrupt_ms = 200;  // how soon Ctrl-C is heard

Error failure(const std::string& what)
{
    return Error("texture build: cannot watch " + what + ": " + std::strerror(errno),
                 "Watch fewer folders, or raise fs.inotify.max_user_watches.");
}

}  // namespace

FolderWatch::FolderWatch(const std::set<fs::path>& folders)
    : file_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC))
{
    if (file_ < 0) throw failure("files");
    for (const fs::path& folder : folders) {
        const int watch = ::inotify_add_watch(
            file_, folder.c_str(),
            IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE);
        if (watch >= 0) continue;
        const Error error = failure(folder.string());
        ::close(file_);
        throw error;
    }
}

FolderWatch::~FolderWatch()
{
    ::close(file_);
}

// True when there was an event within the time. Names that start with a dot (temporary files of
// editors, and our own) do not count.
bool FolderWatch::take_events(int timeout_ms)
{
    pollfd ready{file_, POLLIN, 0};
    if (::poll(&ready, 1, timeout_ms) <= 0) return false;
    alignas(inotify_event) std::array<char, 8192> buffer;
    bool any = false;
    for (ssize_t length; (length = ::read(file_, buffer.data(), buffer.size())) > 0;) {
        for (ssize_t at = 0; at < length;) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            any = any || event->len == 0 || event->name[0] != '.';
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        }
    }
    return any;
}

bool FolderWatch::wait()
{
    while (!interrupted()) {
        if (!take_events(kInterrupt_ms)) continue;
        while (take_events(kQuiet_ms) && !interrupted()) {
        }
        return !interrupted();
    }
    return false;
}

std::set<fs::path> folders_of(const std::vector<fs::path>& files,
                              const std::vector<fs::path>& trees)
{
    std::set<fs::path> folders;
    const auto add = [&](const fs::path& folder) { folders.insert(folder.empty() ? "." : folder); };
    for (const fs::path& file : files) add(file.parent_path());
    std::error_code ignored;
    for (const fs::path& tree : trees) {
        add(tree);
        for (const auto& entry : fs::recursive_directory_iterator(
                 tree, fs::directory_options::skip_permission_denied, ignored)) {
            if (entry.is_directory(ignored)) add(entry.path());
        }
    }
    return folders;
}

}  // namespace petrichor::cli
