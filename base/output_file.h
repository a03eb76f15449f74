#ifndef PETRICHOR_BASE_OUTPUT_FILE_H
#define PETRICHOR_BASE_OUTPUT_FILE_H

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace petrichor {

/// A file that appears whole or not at all: it is written under a temporary name beside its
/// destination and renamed by commit(). Without commit() the destructor removes the temporary.
///
/// The temporary keeps the extension of the destination, since writers choose formats by it.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path destination) : destination_(std::move(destination))
    {
        if (destination_.has_parent_path()) {
            std::error_code failed;
            std::filesystem::create_directories(destination_.parent_path(), failed);
            if (failed) {
                throw Error("output: cannot create the folder " +
                                destination_.parent_path().string() + ": " + failed.message(),
                            "Choose a folder that you may write to.");
            }
        }
        std::filesystem::path name =
            "." + destination_.stem().string() + ".part" + std::to_string(::getpid());
        name += destination_.extension();
        temporary_ = destination_.parent_path() / name;
    }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile()
    {
        std::error_code ignored;
        if (!committed_) std::filesystem::remove(temporary_, ignored);
    }

    const std::filesystem::path& temporary() const { return temporary_; }
    const std::filesystem::path& destination() const { return destination_; }

    /// Renames the temporary to the destination. Throws Error when that fails.
    void commit()
    {
        std::error_code failed;
        std::filesystem::rename(temporary_, destination_, failed);
        if (failed) {
            throw Error("output: cannot write " + destination_.string() + ": " + failed.message(),
                        "Check that the folder is writable and the disk is not full.");
        }
        committed_ = true;
    }

private:
    std::filesystem::path destination_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

/// Writes `content` to `path`, whole or not at all. Throws Error (disk full, read-only folder,
/// ...).
inline void write_text_file(const std::filesystem::path& path, std::string_view content)
{
    OutputFile file(path);
    std::ofstream out(file.temporary(), std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) {
        throw Error("output: cannot write " + path.string() + ": " + std::strerror(errno),
                    "Check that the folder is writable and the disk is not full.");
    }
    file.commit();
}

}  // namespace petrichor

#endif
