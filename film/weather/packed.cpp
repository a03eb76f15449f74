#include "film/weather/packed.h"

#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "base/input_file.h"
#include "base/limited_child.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

constexpr std::size_t kMostText = std::size_t{256} << 20;

bool begins(std::string_view text, std::string_view magic)
{
    return text.substr(0, magic.size()) == magic;
}

std::string number_word(const char* option, double value)
{
    char word[64];
    std::snprintf(word, sizeof word, "%s=%.9g", option, value);
    return word;
}

// "file LENGTH NAME\n" and the bytes, again and again. The helper is not trusted.
std::vector<UnpackedText> texts_of(std::string_view answer, const std::string& name)
{
    const auto refuse = [&] {
        throw Error("weather: " + name + ": the helper's answer is not understood",
                    "This is a fault of ours or of the file; unpack or convert it first.");
    };
    std::vector<UnpackedText> texts;
    while (!answer.empty()) {
        const auto end = answer.substr(0, 400).find('\n');
        if (!begins(answer, "file ") || end == answer.npos) refuse();
        const auto line = answer.substr(5, end - 5);
        const auto blank = line.find(' ');
        const auto length = weather::to_integer(line.substr(0, blank));
        answer.remove_prefix(end + 1);
        if (blank == line.npos || !length || *length < 0 ||
            static_cast<unsigned long long>(*length) > answer.size())
            refuse();
        const auto bytes = static_cast<std::size_t>(*length);
        texts.push_back(
            {std::string(line.substr(blank + 1)), std::string(answer.substr(0, bytes))});
        answer.remove_prefix(bytes);
    }
    return texts;
}

bool is_weather(const std::string& text)
{
    try {
        weather::recognise_weather(text);
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

bool is_packed_weather(std::string_view head)
{
    using namespace std::literals;
    return begins(head, "\x1f\x8b"sv) || begins(head, "PK\x03\x04"sv) || begins(head, "PK\x05\x06"sv) ||
           begins(head, "CDF\x01"sv) || begins(head, "CDF\x02"sv) || begins(head, "CDF\x05"sv) ||
           begins(head, "\x89HDF\r\n"sv) || begins(head, "GRIB"sv);
}

std::string packed_kinds()
{
    return PETRICHOR_PACKED_KINDS;
}

std::vector<UnpackedText> unpack_weather(const std::filesystem::path& path, const GridPlace& place,
                                         std::vector<std::string>& left_out,
                                         const StopRequest& stop)
{
    const InputFile file = open_regular_file(path, "weather file");
    HelperJob job;
    job.program = find_helper("petrichor-weather", {PETRICHOR_WEATHER_HELPER_BUILT});
    job.name = "weather " + path.string();
    job.input = file.fd();
    job.limits = {.memory_bytes = 3ull << 30, .cpu_seconds = 120};
    job.max_answer_bytes = kMostText;
    job.stop = stop;
    if (place.latitude_deg) job.arguments.push_back(number_word("--latitude", *place.latitude_deg));
    if (place.longitude_deg)
        job.arguments.push_back(number_word("--longitude", *place.longitude_deg));
    if (place.nearest) job.arguments.emplace_back("--nearest");
    // Its tables take a moment to load, and only GRIB needs them; an archive may hold it.
    const std::string head = [&] {
        FILE* in = std::fopen(path.c_str(), "rb");
        char bytes[4] = {};
        const std::size_t n = in ? std::fread(bytes, 1, sizeof bytes, in) : 0;
        if (in) std::fclose(in);
        return std::string(bytes, n);
    }();
    if (!begins(head, "CDF") && !begins(head, "\x89HDF")) job.arguments.emplace_back("--grib");
    const std::vector<std::byte> answer = run_limited(job);
    auto texts =
        texts_of({reinterpret_cast<const char*>(answer.data()), answer.size()}, path.string());
    if (texts.size() < 2) return texts;
    std::vector<UnpackedText> weather;
    for (UnpackedText& text : texts) {
        if (is_weather(text.text))
            weather.push_back(std::move(text));
        else
            left_out.push_back(text.name);
    }
    if (weather.empty()) {
        throw Error("weather: " + path.string() + ": none of its " + std::to_string(texts.size()) +
                        " files is weather",
                    "Unpack the archive and give the file that is.");
    }
    return weather;
}

}  // namespace petrichor::film
