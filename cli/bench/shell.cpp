#include "cli/bench/shell.h"

#include <cstdlib>
#include <system_error>

#include "base/error.h"

namespace petrichor::cli {

namespace fs = std::filesystem;

std::string for_shell(const std::string& text)
{
    std::string to = "'";
    for (const char c : text) to += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return to + "'";
}

bool is_installed(const std::string& program)
{
    return std::system(("command -v " + for_shell(program) + " >/dev/null 2>&1").c_str()) == 0;
}

BenchFolder::BenchFolder()
{
    std::string name = (fs::temp_directory_path() / "petrichor-bench-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
        throw Error("bench: cannot make a folder in " + fs::temp_directory_path().string(),
                    "Set TMPDIR to a folder that you may write to.");
    }
    path_ = name;
}

BenchFolder::~BenchFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace petrichor::cli
