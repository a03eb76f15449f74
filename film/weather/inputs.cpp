#include "film/weather/inputs.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "base/error.h"
#include "base/input_file.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "weather/readers/text.h"
#include "weather/text/utf16.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 256u << 20;
constexpr std::uintmax_t kMostCheckpoint = 4ull << 30;

std::vector<Input> read_one(const std::string& word, const GridPlace& place,
                            std::vector<std::string>* notes)
{
    Input input;
    input.file = printable(word);
    if (word == "-") {
        std::string piece(1 << 16, '\0');
        while (std::cin.read(piece.data(), static_cast<std::streamsize>(piece.size())) ||
               std::cin.gcount() > 0) {
            input.text.append(piece.data(), static_cast<std::size_t>(std::cin.gcount()));
            if (input.text.size() > kMostBytes) {
                throw Error("simulate: standard input has more than " + std::to_string(kMostBytes) +
                                " bytes",
                            "Give a smaller file.");
            }
        }
        if (weather::is_utf16(input.text)) input.text = weather::utf8_of_utf16(input.text);
        input.name = "keys";
        input.kind = kind_of_text(input.text);
        return {input};
    }
    const std::vector<std::string> presets = preset_names("weather");
    fs::path path = word;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
        if (std::find(presets.begin(), presets.end(), word) == presets.end()) {
            throw Error(
                "simulate: no file and no preset \"" + word + "\"." + did_you_mean(word, presets),
                presets.empty()
                    ? "Give a weather file, a CSV of keys or a weather TOML."
                    : "Give a weather file, a CSV of keys, a weather TOML, or one of: " +
                          join_words(presets) + ".");
        }
        path = data_folder() / "weather" / (word + ".toml");
    }
    input.text = read_input_file(path);
    input.name = printable(path.stem().string());
    if (is_packed_weather(input.text)) {
        std::vector<std::string> left_out;
        std::vector<Input> inputs;
        for (UnpackedText& text : unpack_weather(path, place, left_out)) {
            const std::string inside = text.name.empty() ? "" : ": " + text.name;
            inputs.push_back(
                {input.name, input.file + inside, kind_of_text(text.text), std::move(text.text)});
        }
        if (notes && !left_out.empty())
            notes->push_back(input.file +
                             ": left out, as they are no weather: " + join_words(left_out));
        return inputs;
    }
    input.kind = path.extension() == ".toml" ? InputKind::Script : kind_of_text(input.text);
    return {input};
}

}  // namespace

std::string read_input_file(const fs::path& path)
{
    // What is packed is read by another program: its head is enough here.
    const InputFile file = open_regular_file(path, "simulate: input");
    std::string head(4096, ' ');
    const ssize_t got = ::pread(file.fd(), head.data(), head.size(), 0);
    head.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    const bool wide = weather::is_utf16(head);
    if (is_packed_weather(head) || (!wide && head.find('\0') != head.npos)) return head;
    std::string text = read_file(path, "simulate: input", kMostBytes);
    return wide ? weather::utf8_of_utf16(text) : text;
}

std::string read_checkpoint_file(const fs::path& path)
{
    return read_file(path, "simulate: --resume:", kMostCheckpoint);
}

InputKind kind_of_text(std::string_view text)
{
    weather::Lines lines(text.substr(0, 65536));
    while (const auto line = lines.next()) {
        const auto words = weather::trimmed(*line);
        if (words.empty() || words.front() == '#') continue;
        const std::string low = weather::lower(words);
        const auto has = [&](const char* word) { return low.find(word) != low.npos; };
        const bool some = has("temperature_c") || has("rainfall");
        // Both without any time are keys whose time column has another name: their reader says so.
        const bool both = has("temperature_c") && has("rainfall") && !has("time") && !has("date");
        return (has("time_s") && !has("time_utc") && some) || both ? InputKind::Keys
                                                                   : InputKind::Weather;
    }
    return InputKind::Weather;
}

std::vector<Input> read_inputs(const std::vector<std::string>& words, const GridPlace& place,
                               std::vector<std::string>* notes)
{
    std::vector<Input> inputs;
    for (const std::string& word : words) {
        for (Input& input : read_one(word, place, notes)) inputs.push_back(std::move(input));
    }
    if (inputs.size() > 1) {
        for (const Input& input : inputs) {
            if (input.kind == InputKind::Weather) continue;
            throw Error("simulate: " + input.file + " cannot be joined with other inputs",
                        "Give several weather files of one place, or one file of keys, one weather "
                        "TOML or one preset.");
        }
    }
    return inputs;
}

}  // namespace petrichor::film
