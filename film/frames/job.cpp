#include "film/frames/job.h"

#include <charconv>
#include <cstdio>

#include "base/error.h"

namespace petrichor::film {

std::string name_suffix(const Job& job)
{
    return (job.variant.empty() ? "" : "_" + job.variant) +
           (job.view.empty() ? "" : "_" + job.view);
}

std::string file_name(const Job& job, const std::string& extension)
{
    char number[24];
    std::snprintf(number, sizeof number, "frame_%04d", job.frame);
    return number + name_suffix(job) + "." + extension;
}

Shard parse_shard(std::string_view text)
{
    Shard shard{0, 0};
    const std::size_t slash = text.find('/');
    if (slash != std::string_view::npos) {
        const auto number = [&](std::string_view part, int& value) {
            const auto [end, problem] =
                std::from_chars(part.data(), part.data() + part.size(), value);
            return problem == std::errc() && end == part.data() + part.size();
        };
        if (number(text.substr(0, slash), shard.index) &&
            number(text.substr(slash + 1), shard.count) && shard.index >= 1 &&
            shard.index <= shard.count && shard.count <= 1000000) {
            return shard;
        }
    }
    throw Error("shard: expected I/N with I from 1 to N, got \"" + std::string(text) + "\"",
                "For example --shard 2/8 for the second of eight parts.");
}

}  // namespace petrichor::film
