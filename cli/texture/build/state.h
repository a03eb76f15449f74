#ifndef PETRICHOR_CLI_TEXTURE_BUILD_STATE_H
#define PETRICHOR_CLI_TEXTURE_BUILD_STATE_H

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace petrichor::cli {

/// What a file was when its bytes were last hashed. Equal size, time and inode: equal hash.
struct FileMark {
    std::uint64_t bytes = 0;
    std::int64_t modified_ns = 0;
    std::uint64_t inode = 0;
    std::string sha256;
};

/// What was made of a material.
struct BuiltSet {
    std::string key;                   ///< hash of sources, options and program version
    std::vector<std::string> outputs;  ///< relative to the output folder
    std::string manifest;              ///< its entry in the manifest, JSON
};

/// The memory of an output folder, in OUT/.petrichor-build.json. Losing it costs a rebuild.
class BuildState {
public:
    /// Reads it; an unreadable or foreign file counts as none.
    explicit BuildState(const std::filesystem::path& folder);

    /// Hash of a file: remembered while size, time and inode stay, else read. Throws Error.
    std::string hash_of(const std::filesystem::path& file);

    /// A material as it was made for some engines: one folder may hold several of the same name.
    struct SetName {
        std::string material;
        std::string engines;  ///< "unity-hdrp, godot"; empty: outputs of a recipe alone
        auto operator<=>(const SetName&) const = default;
    };

    /// Whether a material was built with this key and its outputs are still as they were written.
    bool is_current(const SetName& name, const std::string& key);

    /// Forgets sets that had a file of this one among their outputs: it is another file now.
    void remember(const SetName& name, BuiltSet set);
    const std::map<SetName, BuiltSet>& sets() const { return sets_; }

    /// Writes it where something changed. Of the engines that `names` are for, all others are
    /// forgotten. True when there was something to write.
    bool save(const std::vector<SetName>& names);

private:
    std::filesystem::path folder_;
    std::map<std::string, FileMark> files_;
    std::map<SetName, BuiltSet> sets_;
    bool changed_ = false;
};

}  // namespace petrichor::cli

#endif
