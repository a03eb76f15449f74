#include "base/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <set>
#include <system_error>

#include "base/error.h"
#include "base/lock_within.h"
#include "base/words.h"

namespace petrichor {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".petrichor-";
constexpr std::size_t kDigits = 16;

// What this process is writing, for remove_own_temporaries(), and the folders it has tidied. A
// process has one set of files, so there is one of these a process.
struct Own {
    std::mutex together;  // taken before `guard`
    std::mutex guard;
    std::set<fs::path> temporaries;
    std::set<fs::path> tidied;
};
Own& own()
{
    static Own* the_own = new Own;  // never destroyed: used while the process ends
    return *the_own;
}

Error cannot_write(const fs::path& path, int why)
{
    const std::string text = "output: cannot write " + printable(path.string()) + ": ";
    if (why == EFBIG) {
        return {text + "it is over this shell's limit on the size of a file",
                "Raise the limit: ulimit -f unlimited."};
    }
    return {text + std::strerror(why),
            "Check that the folder is writable and the disk is not full."};
}

// A rename would replace a link or a device by a file, which nobody means.
void check_place(const fs::path& path)
{
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        if (errno == ENOENT) return;
        throw cannot_write(path, errno);
    }
    if (S_ISREG(status.st_mode)) return;
    const char* kind = S_ISLNK(status.st_mode)   ? "a link"
                       : S_ISDIR(status.st_mode) ? "a folder"
                                                 : "a device or a pipe";
    throw Error("output: " + printable(path.string()) + " is " + kind +
                    ", which would be replaced by a file",
                "Name a file, or remove what is there.");
}

std::string random_name()
{
    std::uint64_t number = 0;
    if (::getrandom(&number, sizeof number, 0) != sizeof number) {
        number =
            static_cast<std::uint64_t>(::getpid()) << 32 ^
            static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    }
    std::string name(kPrefix);
    for (std::size_t i = 0; i < kDigits; ++i, number >>= 4)
        name += "0123456789abcdef"[number & 15u];
    return name;
}

bool is_ours(const std::string& name)
{
    if (name.rfind(kPrefix, 0) != 0 || name.size() < kPrefix.size() + kDigits) return false;
    for (std::size_t i = 0; i < kDigits; ++i) {
        const char c = name[kPrefix.size() + i];
        if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'))) return false;
    }
    return name.size() == kPrefix.size() + kDigits || name[kPrefix.size() + kDigits] == '.';
}

bool still_named(int fd, const fs::path& path)
{
    struct stat open {
    }, named{};
    return ::fstat(fd, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
           open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

void forget(const fs::path& path)
{
    const std::lock_guard lock(own().guard);
    own().temporaries.erase(fs::absolute(path));
}

void make_folder(const fs::path& folder)
{
    if (folder.empty()) return;
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) {
        throw Error("output: cannot create the folder " + printable(folder.string()) + ": " +
                        failed.message(),
                    "Choose a folder that you may write to.");
    }
}

void tidy_once(const fs::path& folder)
{
    std::error_code failed;
    const fs::path place = fs::absolute(folder.empty() ? "." : folder, failed);
    {
        const std::lock_guard lock(own().guard);
        if (failed || !own().tidied.insert(place).second) return;
    }
    remove_dead_temporaries(place);
}

// A new file or folder with a random name, locked. Between its making and its lock another program
// may take it for one that was left behind; then it is not there any more, and a new one is made.
template <class Make>
int make_locked(const fs::path& folder, const std::string& extension, fs::path& path,
                const fs::path& wanted, const Make& make)
{
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::lock_guard lock(own().guard);  // it is made and known, or neither
        path = folder / (random_name() + extension);
        const int fd = make(path);
        if (fd < 0) {
            if (errno == EEXIST) continue;
            throw cannot_write(wanted, errno);
        }
        // Locked by somebody else: who is about to remove it. Where locks do not work (some network folders) nothing is
        // ever taken for left behind.
        const bool taken = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (!taken && still_named(fd, path)) {
            own().temporaries.insert(fs::absolute(path));
            return fd;
        }
        ::close(fd);
    }
    throw cannot_write(wanted, EEXIST);
}

}  // namespace

OutputFile::OutputFile(fs::path destination) : destination_(std::move(destination))
{
    const fs::path folder = destination_.parent_path();
    make_folder(folder);
    check_place(destination_);
    tidy_once(folder);
    fd_ = make_locked(folder, destination_.extension().string(), temporary_, destination_,
                      [](const fs::path& path) {
                          return ::open(path.c_str(),
                                        O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC, 0666);
                      });
}

OutputFile::~OutputFile()
{
    if (!committed_) {
        ::unlink(temporary_.c_str());
        forget(temporary_);
    }
    if (fd_ >= 0) ::close(fd_);
}

void OutputFile::write(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) throw cannot_write(destination_, n < 0 ? errno : ENOSPC);
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

void OutputFile::commit()
{
    check_place(destination_);
    if (::rename(temporary_.c_str(), destination_.c_str()) != 0)
        throw cannot_write(destination_, errno);
    committed_ = true;
    forget(temporary_);
    // Some file systems say only now that the disk is full.
    const int failed = ::close(fd_);
    fd_ = -1;
    if (failed != 0 && errno != EINTR) throw cannot_write(destination_, errno);
}

void write_text_file(const fs::path& path, std::string_view content)
{
    OutputFile file(path);
    file.write(content);
    file.commit();
}

ScratchFolder::ScratchFolder(const fs::path& folder) : folder_(folder)
{
    make_folder(folder);
    tidy_once(folder);
    lock_ = make_locked(folder, "", path_, folder, [](const fs::path& path) {
        if (::mkdir(path.c_str(), 0777) != 0) return -1;
        return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    });
}

ScratchFolder::~ScratchFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    forget(path_);
    if (lock_ >= 0) ::close(lock_);
}

void ScratchFolder::publish(const std::vector<std::string>& files)
{
    for (const std::string& file : files) {
        make_folder((folder_ / file).parent_path());
        check_place(folder_ / file);
    }
    for (const std::string& file : files) {
        if (::rename((path_ / file).c_str(), (folder_ / file).c_str()) != 0)
            throw cannot_write(folder_ / file, errno);
    }
}

void remove_dead_temporaries(const fs::path& folder)
{
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const fs::path path = entry->path();
        if (!is_ours(path.filename().string())) continue;
        struct stat status {};
        if (::lstat(path.c_str(), &status) != 0) continue;
        if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) continue;
        const int fd = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (fd < 0) continue;
        if (::flock(fd, LOCK_EX | LOCK_NB) == 0 && still_named(fd, path)) {
            std::error_code ignored;
            fs::remove_all(path, ignored);
        }
        ::close(fd);
    }
}

KeptTogether::KeptTogether()
{
    own().together.lock();
}

KeptTogether::~KeptTogether()
{
    own().together.unlock();
}

void remove_own_temporaries() noexcept
{
    try {
        Own& mine = own();
        std::unique_lock together = lock_within(mine.together, std::chrono::milliseconds(100));
        std::unique_lock lock = lock_within(mine.guard, std::chrono::milliseconds(50));
        if (!lock) return;
        for (const fs::path& path : mine.temporaries) {
            std::error_code ignored;
            fs::remove_all(path, ignored);
        }
        lock.release();  // stays locked: nothing new is begun
        if (together) together.release();
    } catch (...) {  // what stays is removed by the next program
    }
}

}  // namespace petrichor
