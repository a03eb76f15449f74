#ifndef PETRICHOR_CLI_TEXTURE_BUILD_WATCH_H
#define PETRICHOR_CLI_TEXTURE_BUILD_WATCH_H

#include <filesystem>
#include <set>
#include <vector>

namespace petrichor::cli {

/// Waits for files in folders to change (inotify).
class FolderWatch {
public:
    /// Throws Error when the system gives no more watches.
    explicit FolderWatch(const std::set<std::filesystem::path>& folders);
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;
    ~FolderWatch();

    /// Returns true some moments after the last of a row of changes (a program that saves ten maps
    /// makes one change), false on Ctrl-C.
    bool wait();

private:
    bool take_events(int timeout_ms);
    int file_ = -1;
};

/// All folders that hold the files, and all folders below `trees`.
std::set<std::filesystem::path> folders_of(const std::vector<std::filesystem::path>& files,
                                           const std::vector<std::filesystem::path>& trees);

}  // namespace petrichor::cli

#endif
