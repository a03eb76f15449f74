#include "scene/gltf/detail/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace petrichor::scene {

using nlohmann::json;

void Warnings::add(const std::string& where, const std::string& what)
{
    const auto [entry, is_new] = entries_.try_emplace(what, Entry{where});
    if (!is_new) ++entry->second.others;
}

std::vector<std::string> Warnings::lines() const
{
    std::vector<std::string> lines;
    for (const auto& [what, entry] : entries_) {
        std::string line = entry.where.empty() ? what : entry.where + ": " + what;
        if (entry.others > 0) line += " (and " + std::to_string(entry.others) + " more like it)";
        lines.push_back(std::move(line));
    }
    return lines;
}

std::string in_quotes(std::string_view text)
{
    constexpr std::size_t kLongest = 60;
    std::string out = "\"";
    for (const char c : text.substr(0, kLongest)) {
        const auto code = static_cast<unsigned char>(c);
        out += code < 0x20 || code == 0x7f ? '?' : c;
    }
    // Never cut a UTF-8 character in half: take its leading bytes away again.
    if (text.size() > kLongest) {
        while (out.size() > 1 && (static_cast<unsigned char>(out.back()) & 0xc0) == 0x80) {
            out.pop_back();
        }
        if (static_cast<unsigned char>(out.back()) >= 0xc0) out.pop_back();
        out += "...";
    }
    return out + "\"";
}

std::string number_text(double value)
{
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.9g", value);
    return buffer;
}

std::optional<std::string> nearest_word(std::string_view word,
                                        std::span<const std::string_view> candidates)
{
    if (word.size() > 100) return std::nullopt;
    std::size_t best = std::max<std::size_t>(3, word.size() / 2) + 1;
    std::optional<std::string> found;
    for (const std::string_view candidate : candidates) {
        // Levenshtein distance, one row at a time.
        std::vector<std::size_t> row(candidate.size() + 1);
        for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
        for (std::size_t i = 1; i <= word.size(); ++i) {
            std::size_t diagonal = row[0];
            row[0] = i;
            for (std::size_t j = 1; j < row.size(); ++j) {
                const std::size_t replaced = diagonal + (word[i - 1] == candidate[j - 1] ? 0 : 1);
                diagonal = row[j];
                row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
            }
        }
        if (row.back() < best) {
            best = row.back();
            found = std::string(candidate);
        }
    }
    return found;
}

void GltfLog::fail(const std::string& path, const std::string& problem,
                   const std::string& fix) const
{
    throw Error(file + ": " + (path.empty() ? "" : path + ": ") + problem, fix);
}

namespace {

constexpr const char* kFixType = "Correct the value in the file, or export the scene again.";

std::string describe(const json& value)
{
    if (value.is_string()) return "the text " + in_quotes(value.get_ref<const std::string&>());
    if (value.is_number()) return number_text(value.get<double>());
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return value.is_object() ? "an object"
           : value.is_null() ? "null"
                             : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<std::uint64_t> to_whole(const json& value)
{
    constexpr double kLimit = 9007199254740992.0;  // 2^53
    if (value.is_number_unsigned()) {
        const auto number = value.get<std::uint64_t>();
        if (number < static_cast<std::uint64_t>(kLimit)) return number;
    } else if (value.is_number_float()) {
        const auto number = value.get<double>();
        if (number >= 0.0 && number < kLimit && number == std::floor(number)) {
            return static_cast<std::uint64_t>(number);
        }
    }
    return std::nullopt;
}

std::uint32_t to_index(const json& value, const std::string& path, std::string_view thing,
                       std::size_t count, const GltfLog& log)
{
    const auto number = to_whole(value);
    if (!number) {
        log.fail(path,
                 "must be a whole number, the index of some " + std::string(thing) + ", got " +
                     describe(value),
                 kFixType);
    }
    if (*number >= count) {
        const std::string range = count == 0 ? "there are none" : "0.." + std::to_string(count - 1);
        log.fail(
            path,
            std::string(thing) + " " + std::to_string(*number) + " does not exist (" + range + ")",
            "Correct the index, or export the scene again: the file is damaged or incomplete.");
    }
    return static_cast<std::uint32_t>(*number);
}

}  // namespace

JsonObject::JsonObject(const json& value, std::string path, GltfLog& log)
    : value_(&value), path_(std::move(path)), log_(&log)
{
    if (!value.is_object()) {
        log.fail(path_, "must be an object, got " + describe(value), kFixType);
    }
}

const json* JsonObject::find(std::string_view key) const
{
    const auto found = value_->find(key);
    return found == value_->end() ? nullptr : &*found;
}

std::string JsonObject::path_to(std::string_view key) const
{
    std::string path = path_;
    if (!path.empty() && !key.empty()) path += '.';
    path += key;
    return path;
}

bool JsonObject::has(std::string_view key) const
{
    return find(key) != nullptr;
}

std::vector<std::string> JsonObject::keys() const
{
    std::vector<std::string> keys;
    for (const auto& item : value_->items()) keys.push_back(item.key());
    return keys;
}

std::optional<JsonObject> JsonObject::object(std::string_view key) const
{
    const json* value = find(key);
    if (!value) return std::nullopt;
    return JsonObject(*value, path_to(key), *log_);
}

std::optional<JsonObject> JsonObject::extension(std::string_view name) const
{
    const auto extensions = object("extensions");
    return extensions ? extensions->object(name) : std::nullopt;
}

JsonArray JsonObject::array(std::string_view key) const
{
    const json* value = find(key);
    if (value && !value->is_array()) {
        fail(key, "must be an array, got " + describe(*value), kFixType);
    }
    return {value, path_to(key), *log_};
}

std::string JsonObject::text(std::string_view key, std::string_view fallback) const
{
    const json* value = find(key);
    if (!value) return std::string(fallback);
    if (!value->is_string()) fail(key, "must be a text, got " + describe(*value), kFixType);
    return value->get<std::string>();
}

bool JsonObject::flag(std::string_view key, bool fallback) const
{
    const json* value = find(key);
    if (!value) return fallback;
    if (!value->is_boolean()) {
        fail(key, "must be true or false, got " + describe(*value), kFixType);
    }
    return value->get<bool>();
}

std::uint64_t JsonObject::whole(std::string_view key, std::uint64_t fallback) const
{
    return has(key) ? require_whole(key) : fallback;
}

std::uint64_t JsonObject::require_whole(std::string_view key) const
{
    const json* value = find(key);
    if (!value) fail(key, "is missing; a whole number of 0 or more is needed", kFixType);
    const auto number = to_whole(*value);
    if (!number) {
        fail(key, "must be a whole number of 0 or more, got " + describe(*value), kFixType);
    }
    return *number;
}

std::optional<std::uint32_t> JsonObject::index(std::string_view key, std::string_view thing,
                                               std::size_t count) const
{
    const json* value = find(key);
    if (!value) return std::nullopt;
    return to_index(*value, path_to(key), thing, count, *log_);
}

std::uint32_t JsonObject::require_index(std::string_view key, std::string_view thing,
                                        std::size_t count) const
{
    const auto found = index(key, thing, count);
    if (!found)
        fail(key, "is missing; the index of some " + std::string(thing) + " is needed", kFixType);
    return *found;
}

float JsonObject::number(std::string_view key, float fallback, float low, float high) const
{
    const json* value = find(key);
    if (!value) return fallback;
    if (!value->is_number()) fail(key, "must be a number, got " + describe(*value), kFixType);
    const auto number = value->get<double>();
    if (!(number >= static_cast<double>(low) && number <= static_cast<double>(high))) {
        const bool too_low = !(number >= static_cast<double>(low));
        std::string range = too_low ? "at least " + number_text(static_cast<double>(low))
                                    : "at most " + number_text(static_cast<double>(high));
        if (high < std::numeric_limits<float>::max()) {
            range = "in [" + number_text(static_cast<double>(low)) + ", " +
                    number_text(static_cast<double>(high)) + "]";
        }
        fail(key, "must be " + range + ", got " + number_text(number), kFixType);
    }
    return static_cast<float>(number);
}

float JsonObject::clamped(std::string_view key, float fallback, float low, float high) const
{
    const float value = number(key, fallback);
    if (value >= low && value <= high) return value;
    warn(key, "the value is out of range and was clamped");
    return std::clamp(value, low, high);
}

bool JsonObject::numbers(std::string_view key, std::span<float> values) const
{
    const json* value = find(key);
    if (!value) return false;
    if (!value->is_array() || value->size() != values.size()) {
        fail(key, "must be " + std::to_string(values.size()) + " numbers, got " + describe(*value),
             kFixType);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        const json& item = (*value)[i];
        const double number =
            item.is_number() ? item.get<double>() : std::numeric_limits<double>::infinity();
        if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max()))) {
            log_->fail(path_to(key) + "[" + std::to_string(i) + "]",
                       "must be a number that a float can hold, got " + describe(item), kFixType);
        }
        values[i] = static_cast<float>(number);
    }
    return true;
}

void JsonObject::fail(std::string_view key, const std::string& problem,
                      const std::string& fix) const
{
    log_->fail(path_to(key), problem, fix);
}

void JsonObject::warn(std::string_view key, const std::string& what) const
{
    log_->warnings.add(path_to(key), what);
}

std::size_t JsonArray::size() const
{
    return value_ ? value_->size() : 0;
}

JsonObject JsonArray::object(std::size_t i) const
{
    return {(*value_)[i], path_to(i), *log_};
}

std::string JsonArray::text(std::size_t i) const
{
    const json& item = (*value_)[i];
    if (!item.is_string()) {
        log_->fail(path_to(i), "must be a text, got " + describe(item), kFixType);
    }
    return item.get<std::string>();
}

std::uint32_t JsonArray::index(std::size_t i, std::string_view thing, std::size_t count) const
{
    return to_index((*value_)[i], path_to(i), thing, count, *log_);
}

}  // namespace petrichor::scene
