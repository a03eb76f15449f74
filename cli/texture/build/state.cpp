#include "cli/texture/build/state.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/texture/build/sha256.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFile = ".petrichor-build.json";
constexpr int kFormat = 2;
constexpr std::uint64_t kMostBytes = 1ull << 30;

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

// JSON holds UTF-8 only; other names are written as their bytes in hexadecimal.
constexpr std::string_view kBytes = "bytes:";

std::string to_json_name(const std::string& name)
{
    if (is_utf8(name) && name.rfind(kBytes, 0) != 0) return name;
    std::string text(kBytes);
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    }
    return text;
}

std::string from_json_name(const std::string& text)
{
    if (text.rfind(kBytes, 0) != 0) return text;
    std::string name;
    for (std::size_t i = kBytes.size(); i + 1 < text.size(); i += 2)
        name += static_cast<char>(std::strtol(text.substr(i, 2).c_str(), nullptr, 16));
    return name;
}

std::vector<std::string> with_each(std::vector<std::string> names,
                                   std::string (*change)(const std::string&))
{
    for (std::string& name : names) name = change(name);
    return names;
}

}  // namespace

BuildState::BuildState(const fs::path& folder) : folder_(folder)
{
    if (!fs::exists(folder / kFile)) return;
    const json all =
        json::parse(read_file(folder / kFile, "texture build:", kMostBytes), nullptr, false);
    if (all.is_discarded() || !all.is_object()) return;
    try {
        if (all.at("format") != kFormat) return;
        for (const auto& [path, f] : all.at("files").items()) {
            files_[from_json_name(path)] = {
                f.at(0).get<std::uint64_t>(), f.at(1).get<std::int64_t>(),
                f.at(2).get<std::uint64_t>(), f.at(3).get<std::string>()};
        }
        for (const json& s : all.at("sets")) {
            sets_[{from_json_name(s.at("material").get<std::string>()),
                   s.at("engines").get<std::string>()}] = {
                s.at("key").get<std::string>(),
                with_each(s.at("outputs").get<std::vector<std::string>>(), from_json_name),
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

bool BuildState::is_current(const SetName& name, const std::string& key)
{
    const auto set = sets_.find(name);
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

void BuildState::remember(const SetName& name, BuiltSet set)
{
    for (const std::string& output : set.outputs) hash_of(folder_ / output);
    const std::set<std::string> mine(set.outputs.begin(), set.outputs.end());
    std::erase_if(sets_, [&](const auto& other) {
        const std::vector<std::string>& files = other.second.outputs;
        return other.first != name &&
               std::any_of(files.begin(), files.end(),
                           [&](const std::string& file) { return mine.count(file) > 0; });
    });
    sets_[name] = std::move(set);
    changed_ = true;
}

bool BuildState::save(const std::vector<SetName>& names)
{
    const std::set<SetName> wanted(names.begin(), names.end());
    std::set<std::string> engines;
    for (const SetName& name : names) engines.insert(name.engines);
    const std::size_t forgotten = std::erase_if(sets_, [&](const auto& set) {
        return engines.count(set.first.engines) > 0 && wanted.count(set.first) == 0;
    });
    changed_ = changed_ || forgotten > 0;
    if (!changed_) return false;
    json files = json::object(), sets = json::array();
    std::erase_if(files_, [](const auto& file) { return !mark_of(file.first); });
    for (const auto& [path, f] : files_)
        files[to_json_name(path)] = {f.bytes, f.modified_ns, f.inode, f.sha256};
    for (const auto& [name, s] : sets_) {
        sets.push_back({{"material", to_json_name(name.material)},
                        {"engines", name.engines},
                        {"key", s.key},
                        {"outputs", with_each(s.outputs, to_json_name)},
                        {"manifest", s.manifest}});
    }
    write_text_file(folder_ / kFile,
                    json{{"format", kFormat}, {"files", files}, {"sets", sets}}.dump(
                        -1, ' ', false, nlohmann::json::error_handler_t::replace) +
                        "\n");
    changed_ = false;
    return true;
}

}  // namespace petrichor::cli
