#include "cli/texture/build/state.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/texture/build/sha256.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFile = ".petrichor-build.json";
constexpr int kFormat = 1;

std::optional<FileMark> mark_of(const fs::path& file)
{
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return FileMark{static_cast<std::uint64_t>(status.st_size),
                    static_cast<std::int64_t>(status.st_mtim.tv_sec) * 1000000000 +
                        static_cast<std::int64_t>(status.st_mtim.tv_nsec),
                    static_cast<std::uint64_t>(status.st_ino), ""};
}

bool same_file(const FileMark& a, const FileMark& b)
{
    return a.bytes == b.bytes && a.modified_ns == b.modified_ns && a.inode == b.inode;
}

std::string key_of(const fs::path& file)
{
    return fs::absolute(file).lexically_normal().string();
}

}  // namespace

BuildState::BuildState(const fs::path& folder) : folder_(folder)
{
    std::ifstream in(folder / kFile, std::ios::binary);
    const json all = json::parse(in, nullptr, false);
    if (all.is_discarded() || !all.is_object()) return;
    try {
        if (all.at("format") != kFormat) return;
        for (const auto& [path, f] : all.at("files").items()) {
            files_[path] = {f.at(0).get<std::uint64_t>(), f.at(1).get<std::int64_t>(),
                            f.at(2).get<std::uint64_t>(), f.at(3).get<std::string>()};
        }
        for (const auto& [name, s] : all.at("sets").items()) {
            sets_[name] = {s.at("key").get<std::string>(),
                           s.at("outputs").get<std::vector<std::string>>(),
                           s.at("manifest").get<std::string>()};
        }
    } catch (const json::exception&) {
        files_.clear();
        sets_.clear();
    }
}

std::string BuildState::hash_of(const fs::path& file)
{
    const std::optional<FileMark> now = mark_of(file);
    if (!now) {
        throw Error("texture build: cannot read " + file.string() + ": " + std::strerror(errno),
                    "Check the path and its permissions.");
    }
    FileMark& known = files_[key_of(file)];
    if (!known.sha256.empty() && same_file(known, *now)) return known.sha256;
    known = *now;
    known.sha256 = sha256_of_file(file);
    changed_ = true;
    return known.sha256;
}

bool BuildState::is_current(const std::string& material, const std::string& key)
{
    const auto set = sets_.find(material);
    if (set == sets_.end() || set->second.key != key) return false;
    for (const std::string& output : set->second.outputs) {
        const fs::path path = folder_ / output;
        const auto known = files_.find(key_of(path));
        if (known == files_.end() || !mark_of(path)) return false;
        const std::string before = known->second.sha256;
        if (hash_of(path) != before) return false;
    }
    return true;
}

void BuildState::remember(const std::string& material, BuiltSet set)
{
    for (const std::string& output : set.outputs) hash_of(folder_ / output);
    sets_[material] = std::move(set);
    changed_ = true;
}

void BuildState::save(const std::vector<std::string>& materials)
{
    const std::set<std::string> wanted(materials.begin(), materials.end());
    for (auto at = sets_.begin(); at != sets_.end();) {
        const bool keep = wanted.count(at->first) > 0;
        changed_ = changed_ || !keep;
        at = keep ? std::next(at) : sets_.erase(at);
    }
    if (!changed_) return;
    json files = json::object(), sets = json::object();
    for (const auto& [path, f] : files_) files[path] = {f.bytes, f.modified_ns, f.inode, f.sha256};
    for (const auto& [name, s] : sets_) {
        sets[name] = {{"key", s.key}, {"outputs", s.outputs}, {"manifest", s.manifest}};
    }
    write_text_file(folder_ / kFile,
                    json{{"format", kFormat}, {"files", files}, {"sets", sets}}.dump() + "\n");
    changed_ = false;
}

}  // namespace petrichor::cli
