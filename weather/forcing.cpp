#include "weather/forcing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

constexpr FieldInfo kInfo[kFieldCount] = {
    {"air_temp", "K", 173.15, 333.15, false},  {"rel_humidity", "%", 0.0, 110.0, false},
    {"wind", "m/s", 0.0, 110.0, false},        {"pressure", "Pa", 30000.0, 110000.0, false},
    {"sw_down", "W/m2", -15.0, 1600.0, false}, {"lw_down", "W/m2", 40.0, 700.0, false},
    {"cloud", "1", 0.0, 1.0, false},           {"precip", "kg m-2 s-1", 0.0, 0.15, true},
    {"rain", "kg m-2 s-1", 0.0, 0.15, true},   {"snow", "kg m-2 s-1", 0.0, 0.15, true},
    {"dew_point", "K", 143.15, 313.15, false}, {"wind_from", "deg", 0.0, 360.0, false},
    {"visibility", "m", 0.0, 1.0e6, false},    {"snow_depth", "m", 0.0, 30.0, false},
    {"direct", "W/m2", -15.0, 1500.0, false},  {"diffuse", "W/m2", -15.0, 1300.0, false},
};

FieldReport& report_of(ReadReport& report, Field field)
{
    const std::string name = field_info(field).name;
    for (FieldReport& f : report.fields) {
        if (f.name == name) return f;
    }
    report.fields.push_back({});
    report.fields.back().name = name;
    return report.fields.back();
}

void note_filled(ReadReport& report, Field field, std::size_t count, const std::string& how)
{
    if (count == 0) return;
    FieldReport& f = report_of(report, field);
    f.filled += count;
    const std::string rows = std::to_string(count);
    if (!f.filled_by.empty()) f.filled_by += "; ";
    f.filled_by.append(how).append(" (").append(rows).append(" rows)");
    report.add({ReadNote::Kind::Filled, 0, f.name,
                std::string(how).append(" in ").append(rows).append(" rows")});
}

std::size_t count_missing(const std::vector<double>& v)
{
    return static_cast<std::size_t>(
        std::count_if(v.begin(), v.end(), [](double x) { return std::isnan(x); }));
}

// Bridges runs of NaN that are no longer than the limit; ends of the table repeat the nearest
// value.
void bridge(ForcingTable& table, ReadReport& report, Field field, const FillOptions& options)
{
    auto& v = table[field];
    if (v.empty()) return;
    const bool rate = field_info(field).is_rate;
    std::size_t short_gaps = 0, long_gaps = 0;
    std::size_t i = 0;
    while (i < v.size()) {
        if (!std::isnan(v[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < v.size() && std::isnan(v[end])) ++end;
        if (rate) {
            for (std::size_t k = i; k < end; ++k) v[k] = 0.0;
            short_gaps += end - i;
        } else if (i > 0 || end < v.size()) {
            const std::size_t left = i > 0 ? i - 1 : end;
            const std::size_t right = end < v.size() ? end : i - 1;
            const std::int64_t span = table.time_us[right] - table.time_us[left];
            const bool too_long = right > left && span > options.longest_gap_us;
            if (!too_long || field == Field::AirTemp || field == Field::Wind ||
                field == Field::Pressure) {
                for (std::size_t k = i; k < end; ++k) {
                    double x = 0.0;
                    if (right > left) {
                        x = static_cast<double>(table.time_us[k] - table.time_us[left]) /
                            static_cast<double>(span);
                    }
                    v[k] = v[left] + (v[right] - v[left]) * x;
                }
                (too_long ? long_gaps : short_gaps) += end - i;
            }
        }
        i = end;
    }
    note_filled(report, field, short_gaps,
                rate ? "the file gives no amount, taken as 0" : "line between neighbours");
    note_filled(report, field, long_gaps, "line across a long gap");
}

void fill_humidity(ForcingTable& table, ReadReport& report)
{
    auto& rh = table[Field::RelHumidity];
    const auto& dew = table[Field::DewPoint];
    rh.resize(table.rows(), kMissing);
    std::size_t from_dew = 0, assumed = 0;
    for (std::size_t i = 0; i < rh.size(); ++i) {
        if (!std::isnan(rh[i])) continue;
        if (!dew.empty() && !std::isnan(dew[i])) {
            rh[i] = std::clamp(rel_humidity_of_dew_point_pct(table[Field::AirTemp][i], dew[i]), 1.0,
                               100.0);
            ++from_dew;
        } else {
            rh[i] = 70.0;
            ++assumed;
        }
    }
    note_filled(report, Field::RelHumidity, from_dew, "from the dew point");
    note_filled(report, Field::RelHumidity, assumed, "assumed 70 %");
}

void fill_pressure(ForcingTable& table, ReadReport& report)
{
    auto& p = table[Field::Pressure];
    p.resize(table.rows(), kMissing);
    const double z = std::isnan(table.site.elevation_m) ? 0.0 : table.site.elevation_m;
    const double standard = standard_pressure_pa(z);
    std::size_t filled = 0;
    for (double& v : p) {
        if (!std::isnan(v)) continue;
        v = standard;
        ++filled;
    }
    char how[80];
    std::snprintf(how, sizeof how, "standard pressure at %.0f m", z);
    note_filled(report, Field::Pressure, filled, how);
}

// Cloud, then shortwave, then longwave: each from what is there.
void fill_radiation(ForcingTable& table, ReadReport& report, const FillOptions& options)
{
    const std::size_t n = table.rows();
    auto& cloud = table[Field::Cloud];
    auto& sw = table[Field::Shortwave];
    auto& lw = table[Field::Longwave];
    cloud.resize(n, kMissing);
    sw.resize(n, kMissing);
    lw.resize(n, kMissing);
    const bool place =
        !std::isnan(table.site.latitude_deg) && !std::isnan(table.site.longitude_deg);
    const double latitude = place ? table.site.latitude_deg : 45.0;
    const double longitude = place ? table.site.longitude_deg : 0.0;
    std::size_t from_sun = 0, assumed = 0, made_sw = 0, made_lw = 0;
    double last_cloud = kMissing;
    for (std::size_t i = 0; i < n; ++i) {
        double sine = 0.0;
        if (std::isnan(cloud[i]) || std::isnan(sw[i])) {
            sine = sun_direction(table.time_us[i], latitude, longitude).up;
        }
        if (std::isnan(cloud[i])) {
            // A low sun tells little about clouds: keep what the day said.
            if (!std::isnan(sw[i]) && sine > 0.17 && place) {
                cloud[i] = cloud_fraction_of(sw[i], sine);
                ++from_sun;
            } else if (!std::isnan(last_cloud)) {
                cloud[i] = last_cloud;
                ++from_sun;
            } else {
                cloud[i] = options.default_cloud;
                ++assumed;
            }
        }
        last_cloud = cloud[i];
        if (std::isnan(sw[i])) {
            sw[i] = cloudy_sky_w_m2(sine, cloud[i]);
            ++made_sw;
        }
        sw[i] = std::max(sw[i], 0.0);
        if (std::isnan(lw[i])) {
            const double t = table[Field::AirTemp][i];
            lw[i] = longwave_from_sky_w_m2(t, vapour_pressure_pa(t, table[Field::RelHumidity][i]),
                                           cloud[i]);
            ++made_lw;
        }
    }
    const std::string where = place ? "" : " at 45 N 0 E: the file gives no place";
    note_filled(report, Field::Cloud, from_sun, "from shortwave, kept through the night");
    note_filled(report, Field::Cloud, assumed, "assumed");
    note_filled(report, Field::Shortwave, made_sw,
                "clear sky (Haurwitz 1945) and cloud (Kasten & Czeplak 1980)" + where);
    note_filled(report, Field::Longwave, made_lw, "air and cloud (Prata 1996)");
}

// Rows in which the file says how much fell.
std::vector<bool> known_precipitation(const ForcingTable& table)
{
    std::vector<bool> known(table.rows(), false);
    for (std::size_t i = 0; i < known.size(); ++i) {
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow}) {
            if (table.has(f) && !std::isnan(table[f][i])) known[i] = true;
        }
    }
    return known;
}

void fill_precipitation(ForcingTable& table, ReadReport& report)
{
    const std::size_t n = table.rows();
    auto& total = table[Field::Precip];
    const auto& rain = table[Field::Rain];
    const auto& snow = table[Field::Snow];
    if (!rain.empty() || !snow.empty()) {
        total.resize(n, kMissing);
        std::size_t summed = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double sum = (rain.empty() ? 0.0 : rain[i]) + (snow.empty() ? 0.0 : snow[i]);
            if (std::isnan(total[i])) {
                total[i] = sum;
                ++summed;
            }
        }
        note_filled(report, Field::Precip, summed, "rain plus snow");
    } else if (total.empty()) {
        total.assign(n, 0.0);
        note_filled(report, Field::Precip, n, "no precipitation in the file, taken as 0");
    }
}

// A sky from which it may well fall. Humidity alone must be higher where the sight is not known.
bool sky_for_precipitation(const ForcingTable& table, std::size_t row)
{
    const auto& sight = table[Field::Visibility];
    const bool sight_known = !sight.empty() && !std::isnan(sight[row]) && sight[row] < 700.0e3;
    return table[Field::Cloud][row] >= 0.95 &&
           table[Field::RelHumidity][row] >= (sight_known ? 85.0 : 92.0) &&
           (!sight_known || sight[row] < 16.0e3);
}

// Needs humidity and cloud; `known` tells which rows had an amount.
void estimate_precipitation(ForcingTable& table, ReadReport& report, const std::vector<bool>& known)
{
    auto& precip = table[Field::Precip];
    double fallen = 0.0;
    std::size_t skies = 0, filled = 0;
    for (std::size_t i = 0; i < precip.size(); ++i) {
        if (!known[i]) continue;
        fallen += precip[i];
        skies += sky_for_precipitation(table, i);
    }
    const bool from_file = skies >= 10 && fallen > 0.0;
    const double rate = from_file ? fallen / static_cast<double>(skies) : 0.5 / 3600.0;
    for (std::size_t i = 0; i < precip.size(); ++i) {
        if (known[i] || !sky_for_precipitation(table, i)) continue;
        precip[i] = rate;
        ++filled;
    }
    char how[160];
    std::snprintf(how, sizeof how,
                  "of these, estimated as %.2f mm/h under overcast, humid, hazy sky%s",
                  rate * 3600.0, from_file ? ", the rate of the rows with an amount" : "");
    note_filled(report, Field::Precip, filled, how);
}

void warn_of_dry_gaps(ReadReport& report, const std::vector<bool>& known, bool estimated)
{
    // Amounts of the past leave the last row open: nothing falls after the end.
    if (known.size() < 2) return;
    const auto unknown =
        static_cast<std::size_t>(std::count(known.begin(), known.end() - 1, false));
    if (unknown == 0) return;
    report.add({ReadNote::Kind::Warning, 0, "precipitation",
                std::to_string(unknown) + " of " + std::to_string(known.size()) +
                    " rows have no amount in the file: " +
                    (estimated ? "estimated from cloud, humidity and sight" : "taken as dry")});
}

std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (u < 0x20 || u >= 0x7f) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", u);
            out += code;
        } else {
            out += c;
        }
    }
    return out + "\"";
}

const char* kind_name(ReadNote::Kind kind)
{
    switch (kind) {
        case ReadNote::Kind::Filled:
            return "filled";
        case ReadNote::Kind::OutOfRange:
            return "out of range";
        case ReadNote::Kind::BadRow:
            return "bad row";
        case ReadNote::Kind::Time:
            return "time";
        case ReadNote::Kind::Warning:
            return "warning";
        case ReadNote::Kind::Info:
            break;
    }
    return "info";
}

}  // namespace

const FieldInfo& field_info(Field field)
{
    return kInfo[static_cast<std::size_t>(field)];
}

void ReadReport::add(ReadNote note)
{
    if (notes.size() < kMostNotes)
        notes.push_back(std::move(note));
    else
        ++notes_dropped;
}

std::string to_text(const ReadReport& report)
{
    std::string out = "format " + report.format + ", " + std::to_string(report.rows) + " rows";
    if (report.bad_rows) out += ", " + std::to_string(report.bad_rows) + " bad rows bridged";
    out += "\n";
    for (const FieldReport& f : report.fields) {
        out += "  " + f.name + ": " + std::to_string(f.present) + " read";
        if (f.missing) out += ", " + std::to_string(f.missing) + " missing";
        if (f.first_missing_line)
            out += " (first in line " + std::to_string(f.first_missing_line) + ")";
        if (f.out_of_range) out += ", " + std::to_string(f.out_of_range) + " out of range";
        if (!f.filled_by.empty()) out += "; filled: " + f.filled_by;
        out += "\n";
    }
    for (const ReadNote& n : report.notes) {
        if (n.kind == ReadNote::Kind::Filled) continue;
        out += std::string("  ") + kind_name(n.kind);
        if (n.line) out += " line " + std::to_string(n.line);
        if (!n.field.empty()) out += " " + n.field;
        out += ": " + n.text + "\n";
    }
    if (report.notes_dropped) out += "  and " + std::to_string(report.notes_dropped) + " more\n";
    return out;
}

std::string to_json(const ReadReport& report)
{
    std::string out;
    const auto text = [&](const char* key, const std::string& value) {
        out.append("\"").append(key).append("\":").append(quoted(value));
    };
    const auto number = [&](const char* key, std::size_t value) {
        out.append(",\"").append(key).append("\":").append(std::to_string(value));
    };
    out.append("{");
    text("format", report.format);
    number("rows", report.rows);
    number("bad_rows", report.bad_rows);
    out.append(",\"fields\":[");
    for (const FieldReport& f : report.fields) {
        if (&f != &report.fields.front()) out.append(",");
        out.append("{");
        text("name", f.name);
        number("present", f.present);
        number("missing", f.missing);
        number("first_missing_line", f.first_missing_line);
        number("out_of_range", f.out_of_range);
        number("filled", f.filled);
        out.append(",");
        text("filled_by", f.filled_by);
        out.append("}");
    }
    out.append("],\"notes\":[");
    for (const ReadNote& n : report.notes) {
        if (&n != &report.notes.front()) out.append(",");
        out.append("{");
        text("kind", kind_name(n.kind));
        number("line", n.line);
        out.append(",");
        text("field", n.field);
        out.append(",");
        text("text", n.text);
        out.append("}");
    }
    out.append("]");
    number("notes_dropped", report.notes_dropped);
    return out.append("}");
}

void fill_forcing(ForcingTable& table, ReadReport& report, const FillOptions& options)
{
    const std::size_t n = table.rows();
    if (n == 0)
        throw Error("weather: the table has no rows",
                    "Give a file with at least one row of weather.");
    for (std::size_t i = 1; i < n; ++i) {
        if (table.time_us[i] <= table.time_us[i - 1]) {
            throw Error(
                "weather: times must increase, data row " + std::to_string(i + 1) + " does not",
                "Sort the rows and remove duplicates.");
        }
    }
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        auto& column = table.columns[f];
        if (column.empty()) continue;
        if (column.size() != n) {
            throw Error(std::string("weather: column ") + kInfo[f].name + " has " +
                            std::to_string(column.size()) + " values for " + std::to_string(n) +
                            " rows",
                        "Make every column as long as time_us, or leave it empty.");
        }
        for (double& v : column) {
            if (std::isinf(v)) v = kMissing;
        }
        // A column without one value says nothing.
        if (count_missing(column) == n) column.clear();
    }
    if (!table.has(Field::AirTemp)) {
        throw Error("weather: no air temperature in the file",
                    "Give a file with air temperature in every row.");
    }
    bridge(table, report, Field::AirTemp, options);
    bridge(table, report, Field::DewPoint, options);
    bridge(table, report, Field::RelHumidity, options);
    bridge(table, report, Field::Wind, options);
    bridge(table, report, Field::Pressure, options);
    bridge(table, report, Field::Cloud, options);
    bridge(table, report, Field::Shortwave, options);
    bridge(table, report, Field::Longwave, options);
    const std::vector<bool> precip_known = known_precipitation(table);
    bridge(table, report, Field::Rain, options);
    bridge(table, report, Field::Snow, options);
    if (!table.has(Field::Rain) && !table.has(Field::Snow))
        bridge(table, report, Field::Precip, options);
    if (!table.has(Field::Wind)) {
        table[Field::Wind].assign(n, 2.0);
        note_filled(report, Field::Wind, n, "no wind in the file, assumed 2 m/s");
    }
    for (double& rh : table[Field::RelHumidity]) rh = std::min(rh, 100.0);
    fill_humidity(table, report);
    fill_pressure(table, report);
    fill_precipitation(table, report);
    fill_radiation(table, report, options);
    const bool estimate = options.missing_precip == MissingPrecip::Estimate &&
                          !table.has(Field::Rain) && !table.has(Field::Snow);
    if (estimate) estimate_precipitation(table, report, precip_known);
    warn_of_dry_gaps(report, precip_known, estimate);
}

double value_at(const ForcingTable& table, Field field, std::int64_t time_us)
{
    const auto& v = table[field];
    if (v.empty()) return kMissing;
    const auto& t = table.time_us;
    const auto upper = std::upper_bound(t.begin(), t.end(), time_us);
    if (upper == t.begin()) return v.front();
    if (upper == t.end()) return v.back();
    const auto i = static_cast<std::size_t>(upper - t.begin());
    const double x = static_cast<double>(time_us - t[i - 1]) / static_cast<double>(t[i] - t[i - 1]);
    return v[i - 1] + (v[i] - v[i - 1]) * x;
}

}  // namespace petrichor::weather
