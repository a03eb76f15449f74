#include "base/content_cache.h"

#include <sys/mman.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"
#include "base/output_file.h"

namespace petrichor {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDefaultMib = 2048;
constexpr char kMagic[9] = "PTRCACH2";

// What an entry starts with.
struct Header {
    char magic[8];
    std::uint64_t bytes;  // of the content
    char fingerprint[32];
};
static_assert(sizeof(Header) == 48);

Header header_of(std::span<const std::byte> content)
{
    Hasher hasher;
    hasher.add_bytes(content);
    Header header{};
    std::memcpy(header.magic, kMagic, 8);
    header.bytes = content.size();
    std::memcpy(header.fingerprint, hasher.text().data(), 32);
    return header;
}

// A file as it lies in the system's memory; on file systems that cannot share it, a copy. Entries
// are never written into: they appear by renaming.
CachedBytes mapped(const InputFile& in)
{
    const auto size = static_cast<std::size_t>(in.size());
    void* at = size == 0 ? MAP_FAILED
                         : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, in.fd(), 0);
    if (at != MAP_FAILED) {
        return {{static_cast<const std::byte*>(at), size},
                std::shared_ptr<const void>(at, [size](void* p) { ::munmap(p, size); })};
    }
    const auto copy = std::make_shared<std::vector<std::byte>>(size);
    const std::size_t got = in.read(*copy);
    return {std::span<const std::byte>(*copy).first(got), copy};
}

fs::path entry_path(const fs::path& folder, const std::string& kind, const std::string& key)
{
    return folder / kind / (key + ".bin");
}

struct Entry {
    fs::path path;
    std::uint64_t bytes = 0;
    fs::file_time_type used;
};

// Everything below the folder that looks like ours, unfinished files too.
std::vector<Entry> entries_in(const fs::path& folder)
{
    std::vector<Entry> entries;
    std::error_code failed;
    for (auto at = fs::recursive_directory_iterator(folder, failed);
         !failed && at != fs::recursive_directory_iterator(); at.increment(failed)) {
        std::error_code gone;  // another program may be cleaning up too
        if (at->path().extension() != ".bin" || !at->is_regular_file(gone) || gone) continue;
        Entry entry{at->path(), at->file_size(gone), {}};
        if (!gone) entry.used = at->last_write_time(gone);
        if (!gone) entries.push_back(std::move(entry));
    }
    return entries;
}

}  // namespace

ContentCache::ContentCache(fs::path folder, std::uint64_t max_bytes)
    : folder_(std::move(folder)), max_bytes_(max_bytes)
{
}

std::optional<CachedBytes> ContentCache::find(const std::string& kind, const std::string& key) const
{
    if (!on()) return std::nullopt;
    const fs::path path = entry_path(folder_, kind, key);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return std::nullopt;
    std::optional<CachedBytes> whole;
    try {
        whole = mapped(open_regular_file(path, "cache"));
    } catch (const Error&) {  // gone meanwhile, or a bad disk: it is made again
        return std::nullopt;
    }
    Header header{};
    bool good = whole->size() >= sizeof header;
    if (good) {
        std::memcpy(&header, whole->data(), sizeof header);
        good = std::memcmp(header.magic, kMagic, 8) == 0 &&
               header.bytes == whole->size() - sizeof header &&
               std::memcmp(header.fingerprint,
                           header_of(whole->subspan(sizeof header)).fingerprint, 32) == 0;
    }
    if (!good) {
        fs::remove(path, ignored);
        return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // used just now
    return whole->without_first(sizeof header);
}

void ContentCache::keep(const std::string& kind, const std::string& key,
                        const std::vector<std::span<const std::byte>>& parts) const
{
    std::uint64_t bytes = 0;
    for (const auto& part : parts) bytes += part.size();
    if (!on() || bytes > max_bytes_ / 2) return;
    std::vector<std::byte> content;
    content.reserve(bytes);
    for (const auto& part : parts) content.insert(content.end(), part.begin(), part.end());
    const Header header = header_of(content);
    const fs::path path = entry_path(folder_, kind, key);
    const std::string_view head(reinterpret_cast<const char*>(&header), sizeof header);
    OutputFile file(path);
    try {
        file.write(head);
        file.write({reinterpret_cast<const char*>(content.data()), content.size()});
    } catch (const Error& error) {
        throw Error(std::string("cache: ") + error.what(),
                    "Free some space, let PETRICHOR_CACHE name another folder, or set "
                    "PETRICHOR_CACHE_MIB=0 to keep nothing.");
    }
    file.commit();
    make_room(path);
}

std::uint64_t ContentCache::size() const
{
    std::uint64_t sum = 0;
    for (const Entry& entry : entries_in(folder_)) sum += entry.bytes;
    return sum;
}

// Down to nine tenths, so that not every new entry has to clean up.
void ContentCache::make_room(const fs::path& newest) const
{
    std::vector<Entry> entries = entries_in(folder_);
    std::uint64_t sum = 0;
    for (const Entry& entry : entries) sum += entry.bytes;
    if (sum <= max_bytes_) return;
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.used != b.used ? a.used < b.used : a.path < b.path;
    });
    // A file that is just being written by another program has a new date and stays.
    const auto young = fs::file_time_type::clock::now() - std::chrono::minutes(10);
    for (const Entry& entry : entries) {
        if (sum <= max_bytes_ / 10 * 9) return;
        const bool unfinished = entry.path.filename().string().front() == '.';
        if (entry.path == newest || (unfinished && entry.used > young)) continue;
        std::error_code ignored;
        if (fs::remove(entry.path, ignored)) sum -= entry.bytes;
    }
}

fs::path cache_folder()
{
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string own = set("PETRICHOR_CACHE"); !own.empty()) return own;
    if (const std::string user = set("XDG_CACHE_HOME"); !user.empty()) {
        return fs::path(user) / "petrichor";
    }
    if (const std::string home = set("HOME"); !home.empty()) {
        return fs::path(home) / ".cache" / "petrichor";
    }
    std::error_code failed;
    return fs::temp_directory_path(failed) / "petrichor";
}

ContentCache user_cache()
{
    std::uint64_t mib = kDefaultMib;
    if (const char* set = std::getenv("PETRICHOR_CACHE_MIB"); set && *set) {
        const char* end = set + std::strlen(set);
        const auto [at, problem] = std::from_chars(set, end, mib);
        if (problem != std::errc() || at != end || mib > (1u << 24)) {
            throw Error(std::string("cache: PETRICHOR_CACHE_MIB must be a whole number of MiB, 0 "
                                    "to 16777216, got \"") +
                            set + "\"",
                        "Set it to 2048, for example, or to 0 to keep nothing.");
        }
    }
    return ContentCache(cache_folder(), mib << 20);
}

}  // namespace petrichor
