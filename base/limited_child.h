#ifndef PETRICHOR_BASE_LIMITED_CHILD_H
#define PETRICHOR_BASE_LIMITED_CHILD_H

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/interrupted.h"

namespace petrichor {

// Untrusted files are read by helper programs: small programs of ours that parse with a library
// which may crash, loop or be taken over. A helper is started with
//
//   - an empty environment, its own process group, "/" as its folder, no file but those it is
//   handed;
//   - limits of memory, CPU time, size of files and number of files, no core dumps;
//   - no new privileges, and the kernel's promise to kill it when this program dies, however.
//
// Inside, it loads what it needs and calls confine() (base/confine.h): from then on it cannot open
// a file or a socket or start a program. How to write one (NetCDF, GRIB, Draco, an archive):
//
//   // THING_helper.cpp, a program of its own: add_executable(petrichor-thing THING_helper.cpp)
//   //   target_link_libraries(petrichor-thing PRIVATE petrichor_helper thing)  # petrichor_helper:
//   base/
//   //   install(TARGETS petrichor-thing RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/petrichor)
//   int main(int argc, char** argv)
//   {
//       return petrichor::run_helper(argc, argv, [](petrichor::HelperInput input) {
//           return parsed(input.bytes);   // throws Error or std::exception; returns what stdout
//           gets
//       });
//   }
//
//   // in the program; throws Error with the helper's own words, and for a crash, a loop, too much
//   const InputFile file = open_regular_file(path, "weather");
//   const std::vector<std::byte> answer = run_limited({
//       .program = find_helper("petrichor-thing", {PETRICHOR_THING_BUILT}), .name = "weather " +
//       path, .input = file.fd(), .limits = {.memory_bytes = 1ull << 30, .cpu_seconds = 30}, .stop
//       = stop});
//
// The answer comes from a process that is not trusted: check every number of it.
// Libraries that only read by name cannot be used after confine(); nearly all have a way to read
// from memory (nc_open_mem, codes_handle_new_from_message, draco::DecoderBuffer,
// archive_read_open_memory).

/// What a helper may use.
struct ChildLimits {
    std::uint64_t memory_bytes = 1ull << 30;  ///< address space, above what its libraries take
    unsigned cpu_seconds = 60;                ///< then the kernel ends it
    std::uint64_t file_bytes = 2ull << 30;    ///< of any file or shared memory that it writes
    unsigned open_files = 32;
};

/// A program that is trusted with everything we have (ffmpeg): no limits, our environment and
/// folder; still a process group of its own, and it dies with this program.
enum class Trust { None, Full };

/// How a child ended.
struct ChildEnd {
    bool exited = false;  ///< by itself, with `code`
    int code = 0;         ///< exit status, or the signal that ended it
    /// "crashed (signal 11)", "took more CPU time than its limit", "gave up", ...
    std::string text() const;
};

/// A helper that runs. Move-only; the destructor kills and reaps it.
class LimitedChild {
public:
    /// Starts `program` (an absolute path). `descriptors` are pairs of one of ours and the number
    /// it has in the child, 0..9; 0, 1 and 2 are /dev/null unless given. Throws Error when it
    /// cannot be started.
    LimitedChild(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const ChildLimits& limits, const std::vector<std::pair<int, int>>& descriptors,
                 Trust trust = Trust::None);
    LimitedChild(LimitedChild&& other) noexcept;
    LimitedChild& operator=(LimitedChild&& other) noexcept;
    ~LimitedChild();

    pid_t id() const { return pid_; }
    /// Waits for its end; with `kill`, brings it about.
    ChildEnd end(bool kill);

private:
    pid_t pid_ = -1;
};

/// Waits until `fd` can be read (or is closed at the other end). False when `seconds` have passed.
/// Asks `stop` every 50 ms and throws Interrupted when it says so.
bool wait_readable(int fd, double seconds, const StopRequest& stop);

/// One run of a helper: a file in, bytes out.
struct HelperJob {
    std::filesystem::path program;
    std::string name;  ///< of the thing that is read, for messages: "weather era5.nc"
    std::vector<std::string> arguments = {};
    int input = -1;  ///< a descriptor open for reading only; the helper's standard input
    ChildLimits limits = {};
    double wall_seconds = 120.0;
    std::uint64_t max_answer_bytes = 1ull << 30;
    StopRequest stop = {};
};

/// Runs it. Throws Error for every failure (its own words where it said any), Interrupted.
std::vector<std::byte> run_limited(const HelperJob& job);

/// The same for bytes in memory; `job.input` is not used.
std::vector<std::byte> run_limited(HelperJob job, std::span<const std::byte> bytes);

/// A helper's path: beside this program, in its libexec/petrichor, or one of `built`. Throws Error.
std::filesystem::path find_helper(std::string_view name,
                                  const std::vector<std::filesystem::path>& built);

/// Shared memory that holds a copy of `bytes`, without a name. The descriptor is the caller's;
/// throws Error when there is none.
int shared_memory_of(std::span<const std::byte> bytes, std::string_view what);

}  // namespace petrichor

#endif
