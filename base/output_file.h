#ifndef PETRICHOR_BASE_OUTPUT_FILE_H
#define PETRICHOR_BASE_OUTPUT_FILE_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor {

// Everything that is written appears whole or not at all: it is made under a random name,
// ".petrichor-0123456789abcdef.ext", in the folder where it will lie, and then renamed. The writer
// holds a lock on it as long as it lives, so the next program that writes into the folder can tell
// what a killed one left behind (it gets the lock) from what is being written, and removes the
// former.

/// A file on its way. Without commit() the destructor removes it.
class OutputFile {
public:
    /// Makes the folder and the temporary (O_EXCL, O_NOFOLLOW), which keeps the extension of the
    /// destination, since writers choose formats by it. Throws Error: a destination that is a link,
    /// a device or a folder (a rename would replace it), no room, no permission.
    explicit OutputFile(std::filesystem::path destination);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    const std::filesystem::path& temporary() const { return temporary_; }
    const std::filesystem::path& destination() const { return destination_; }

    /// Appends to the temporary. Throws Error (disk full, over a limit).
    void write(std::string_view bytes);
    /// Renames the temporary to the destination. Throws Error when that fails.
    void commit();

private:
    std::filesystem::path destination_;
    std::filesystem::path temporary_;
    int fd_ = -1;
    bool committed_ = false;
};

/// Writes `content` to `path`, whole or not at all. Throws Error (disk full, read-only folder,
/// ...).
void write_text_file(const std::filesystem::path& path, std::string_view content);

/// A folder inside `folder` for files that belong together: they are made in it, and publish() then
/// puts them beside each other. The destructor removes what is left of it.
class ScratchFolder {
public:
    explicit ScratchFolder(const std::filesystem::path& folder);
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    const std::filesystem::path& path() const { return path_; }
    /// Renames files (names relative to path(), folders allowed in them) into `folder`. All of them
    /// are whole by then, so renaming is all that is left. Throws Error, before the first when one
    /// of the places is taken by a folder, a link or a device.
    void publish(const std::vector<std::string>& files);

private:
    std::filesystem::path folder_;
    std::filesystem::path path_;
    int lock_ = -1;
};

/// Removes what killed programs left in a folder, never what a living one is writing. Writing into
/// a folder for the first time does it by itself.
void remove_dead_temporaries(const std::filesystem::path& folder);

/// Files that only mean something together (pictures and the list that names them): while one of
/// these lives, remove_own_temporaries() waits, so that a program that is ended has published all
/// of them or none.
class KeptTogether {
public:
    KeptTogether();
    KeptTogether(const KeptTogether&) = delete;
    KeptTogether& operator=(const KeptTogether&) = delete;
    ~KeptTogether();
};

/// Removes every temporary of this process: the last act before it ends without unwinding. Waits at
/// most 0.1 s for what is being published; nothing can be published or begun after it.
void remove_own_temporaries() noexcept;

}  // namespace petrichor

#endif
