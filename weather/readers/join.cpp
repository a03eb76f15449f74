#include "weather/readers/join.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

// Names of the columns that both have, by comma.
std::string fields_of_both(const ForcingTable& a, const ForcingTable& b)
{
    std::string names;
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        if (a.columns[f].empty() || b.columns[f].empty()) continue;
        names.append(names.empty() ? "" : ", ").append(field_info(static_cast<Field>(f)).name);
    }
    return names;
}

// Columns of two tables over the same time: all times of both. A rate goes on until its own table's
// next row; other values stay open where their table has no row.
ForcingTable merged(const ForcingTable& a, const ForcingTable& b)
{
    ForcingTable out;
    out.site = a.site;
    std::set_union(a.time_us.begin(), a.time_us.end(), b.time_us.begin(), b.time_us.end(),
                   std::back_inserter(out.time_us));
    for (const ForcingTable* table : {&a, &b}) {
        for (std::size_t f = 0; f < kFieldCount; ++f) {
            const auto& from = table->columns[f];
            if (from.empty()) continue;
            const bool rate = field_info(static_cast<Field>(f)).is_rate;
            auto& to = out.columns[f];
            to.assign(out.rows(), kMissing);
            std::size_t next = 0;  // of the rows of `table`
            for (std::size_t i = 0; i < out.rows(); ++i) {
                while (next < from.size() && table->time_us[next] <= out.time_us[i]) ++next;
                if (next == 0) continue;
                const bool here = table->time_us[next - 1] == out.time_us[i];
                if (here || (rate && next < from.size())) to[i] = from[next - 1];
            }
        }
    }
    return out;
}

// What the first file does not say about the place, another one may.
void take_place(Site& site, const Site& other)
{
    const auto take = [](double& mine, double theirs) {
        if (std::isnan(mine)) mine = theirs;
    };
    take(site.latitude_deg, other.latitude_deg);
    take(site.longitude_deg, other.longitude_deg);
    take(site.elevation_m, other.elevation_m);
    take(site.utc_offset_h, other.utc_offset_h);
}

void append(ReadReport& whole, const Part& part)
{
    const ReadReport& more = part.read.report;
    if (whole.format.find(more.format) == std::string::npos)
        whole.format += (whole.format.empty() ? "" : ", ") + more.format;
    whole.rows += more.rows;
    whole.typical_year = whole.typical_year || more.typical_year;
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
            if (const std::string both = fields_of_both(result.table, part.read.table);
                !both.empty()) {
                throw Error("weather: " + part.file->name + " begins at " +
                                iso_from_us(part.read.table.time_us.front()) +
                                ", before the file ahead of it ends at " +
                                iso_from_us(times.back()) + ", and both have " + both,
                            "Give files whose times do not overlap, or that hold different "
                            "quantities.");
            }
            result.table = merged(result.table, part.read.table);
        } else {
            append(result.table, part.read.table);
        }
        append(result.report, part);
        take_place(result.table.site, part.read.table.site);
    }
    if (options.fill) fill_forcing(result.table, result.report, options.filling);
    return result;
}

}  // namespace petrichor::weather
