#include "weather/readers/join.h"

#include <algorithm>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Part {
    const NamedText* file;
    ReadResult read;
};

void append(ForcingTable& whole, const ForcingTable& part)
{
    const std::size_t before = whole.rows();
    whole.time_us.insert(whole.time_us.end(), part.time_us.begin(), part.time_us.end());
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        auto& column = whole.columns[f];
        const auto& more = part.columns[f];
        if (column.empty() && more.empty()) continue;
        column.resize(before, kMissing);
        column.insert(column.end(), more.begin(), more.end());
        column.resize(whole.rows(), kMissing);
    }
}

void append(ReadReport& whole, const Part& part)
{
    const ReadReport& more = part.read.report;
    if (whole.format.find(more.format) == std::string::npos)
        whole.format += (whole.format.empty() ? "" : ", ") + more.format;
    whole.rows += more.rows;
    whole.bad_rows += more.bad_rows;
    whole.notes_dropped += more.notes_dropped;
    for (const FieldReport& f : more.fields) {
        const auto same = std::find_if(whole.fields.begin(), whole.fields.end(),
                                       [&](const FieldReport& w) { return w.name == f.name; });
        if (same == whole.fields.end()) {
            whole.fields.push_back(f);
            continue;
        }
        same->present += f.present;
        same->missing += f.missing;
        same->out_of_range += f.out_of_range;
    }
    for (const ReadNote& note : more.notes) {
        ReadNote named = note;
        named.text = part.file->name + ": " + note.text;
        whole.add(std::move(named));
    }
}

}  // namespace

ReadResult read_weather_files(const std::vector<NamedText>& files, const ReadOptions& options)
{
    if (files.empty()) throw Error("weather: no file", "Give at least one weather file.");
    if (files.size() == 1) return read_weather(files.front().text, options);
    ReadOptions raw = options;
    raw.fill = false;
    std::vector<Part> parts;
    for (const NamedText& file : files) {
        try {
            parts.push_back({&file, read_weather(file.text, raw)});
        } catch (const Error& error) {
            throw Error(file.name + ": " + error.what(), error.fix());
        }
    }
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return a.read.table.time_us.front() < b.read.table.time_us.front();
    });
    ReadResult result;
    result.table.site = parts.front().read.table.site;
    for (const Part& part : parts) {
        const auto& times = result.table.time_us;
        if (!times.empty() && part.read.table.time_us.front() <= times.back()) {
            throw Error("weather: " + part.file->name + " begins at " +
                            iso_from_us(part.read.table.time_us.front()) +
                            ", before the file ahead of it ends at " + iso_from_us(times.back()),
                        "Give files whose times do not overlap.");
        }
        append(result.table, part.read.table);
        append(result.report, part);
    }
    if (options.fill) fill_forcing(result.table, result.report, options.filling);
    return result;
}

}  // namespace petrichor::weather
