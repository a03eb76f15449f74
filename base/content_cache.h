#ifndef PETRICHOR_BASE_CONTENT_CACHE_H
#define PETRICHOR_BASE_CONTENT_CACHE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace petrichor {

/// The bytes of an entry, where they lie in its file: nothing is copied. They stay while this or a
/// copy of it lives, also when the entry is thrown out meanwhile.
class CachedBytes : public std::span<const std::byte> {
public:
    CachedBytes(std::span<const std::byte> bytes, std::shared_ptr<const void> holder)
        : std::span<const std::byte>(bytes), holder_(std::move(holder))
    {
    }
    const std::shared_ptr<const void>& holder() const { return holder_; }
    /// All but the first bytes.
    CachedBytes without_first(std::size_t count) const { return {subspan(count), holder_}; }

private:
    std::shared_ptr<const void> holder_;
};

/// Things that take long to make, kept on disk under the fingerprint of everything they are made
/// from. What find() returns is what keep() was given, bit for bit, or nothing: an entry that was
/// cut short or damaged is removed and counts as none. Several programs may use one folder; an
/// entry appears whole or not at all. When the folder holds more than its limit, what was longest
/// not used goes first. All functions may be called from several threads.
class ContentCache {
public:
    ContentCache() = default;  ///< keeps nothing, finds nothing
    ContentCache(std::filesystem::path folder, std::uint64_t max_bytes);

    /// Bytes that were kept under this key. `kind` is a folder name: "textures".
    std::optional<CachedBytes> find(const std::string& kind, const std::string& key) const;

    /// Keeps the parts, one after the other. Entries of more than half of the limit are not kept.
    /// Throws Error when the folder cannot be written.
    void keep(const std::string& kind, const std::string& key,
              const std::vector<std::span<const std::byte>>& parts) const;

    /// Bytes of all entries.
    std::uint64_t size() const;
    bool on() const { return max_bytes_ > 0; }
    const std::filesystem::path& folder() const { return folder_; }
    std::uint64_t max_bytes() const { return max_bytes_; }

private:
    void make_room(const std::filesystem::path& newest) const;

    std::filesystem::path folder_;
    std::uint64_t max_bytes_ = 0;
};

/// Where the user's cache lies: PETRICHOR_CACHE, else XDG_CACHE_HOME/petrichor, else
/// ~/.cache/petrichor, else petrichor under the temporary folder. Not created.
std::filesystem::path cache_folder();

/// The user's: in cache_folder(), with the limit of PETRICHOR_CACHE_MIB (2048; 0: nothing is kept).
/// Throws Error when that is not a whole number.
ContentCache user_cache();

}  // namespace petrichor

#endif
