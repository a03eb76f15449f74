#ifndef PETRICHOR_CLI_BENCH_SHELL_H
#define PETRICHOR_CLI_BENCH_SHELL_H

#include <filesystem>
#include <string>

namespace petrichor::cli {

/// The text in single quotes, as one word of a command.
std::string for_shell(const std::string& text);

/// Whether the shell finds a program of that name.
bool is_installed(const std::string& program);

/// A folder below the system's for temporary files, removed with what it holds at the end.
class BenchFolder {
public:
    /// throws  Error when none can be made
    BenchFolder();
    BenchFolder(const BenchFolder&) = delete;
    BenchFolder& operator=(const BenchFolder&) = delete;
    ~BenchFolder();
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace petrichor::cli

#endif
