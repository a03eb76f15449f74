#include "weather/models/physical/physical_checkpoint.h"

#include <charconv>

#include "base/error.h"

namespace petrichor::weather {

namespace {

// "petrichor-run-1 <weather> <ground> <model> <time in microseconds>\n<state>"
constexpr std::string_view kHeader = "petrichor-run-1";

Error refused(const std::string& why, const char* fix = "Give a file that --checkpoint wrote.")
{
    return {"physical model: this checkpoint cannot be used: " + why, fix};
}

// The number after the next space of a line.
template <class Number>
Number take_word(std::string_view& line, int base)
{
    Number number{};
    if (line.empty()) throw refused("it is cut short");
    if (line.front() != ' ') throw refused("its first line is damaged");
    const auto [end, problem] =
        std::from_chars(line.data() + 1, line.data() + line.size(), number, base);
    if (problem != std::errc{}) throw refused("its first line is damaged");
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return number;
}

}  // namespace

std::string save_checkpoint(const CellCheckpoint& checkpoint, const RunIdentity& identity)
{
    std::string text(kHeader);
    for (const std::uint64_t hash : {identity.weather, identity.ground, identity.model})
        text += " " + hash_text(hash);
    return text + " " + std::to_string(checkpoint.at_us) + "\n" + save_state(checkpoint.state);
}

CellCheckpoint load_checkpoint(std::string_view text, const RunIdentity& identity)
{
    if (text.substr(0, kHeader.size()) != kHeader)
        throw refused("it is no checkpoint of the physical model of this version");
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) throw refused("it is cut short");
    std::string_view line = text.substr(kHeader.size(), end - kHeader.size());
    RunIdentity saved;
    saved.weather = take_word<std::uint64_t>(line, 16);
    saved.ground = take_word<std::uint64_t>(line, 16);
    saved.model = take_word<std::uint64_t>(line, 16);
    CellCheckpoint checkpoint;
    checkpoint.at_us = take_word<std::int64_t>(line, 10);
    if (!line.empty()) throw refused("its first line is damaged");
    const char* again = "Resume with the weather files, surface and options of the first run.";
    if (saved.weather != identity.weather)
        throw refused("it belongs to other weather or another site", again);
    if (saved.ground != identity.ground) throw refused("it belongs to another surface", again);
    if (saved.model != identity.model)
        throw refused("it belongs to another --phase, --dt or other parameters", again);
    checkpoint.state = load_state(text.substr(end + 1));
    return checkpoint;
}

}  // namespace petrichor::weather
