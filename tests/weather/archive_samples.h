// The samples of weather archives: one each lies in the corpus of the fuzzer, laid out as the archive does.
#ifndef PETRICHOR_TESTS_WEATHER_ARCHIVE_SAMPLES_H
#define PETRICHOR_TESTS_WEATHER_ARCHIVE_SAMPLES_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather::archive_samples {

inline std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

inline ReadResult raw(const std::string& text, ReadOptions options = {})
{
    options.fill = false;
    return read_weather(text, options);
}

inline ReadResult sample(const std::string& name, const ReadOptions& options = {})
{
    return raw(text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name), options);
}

/// Row of a time, or the number of rows.
inline std::size_t row_at(const ForcingTable& table, const std::string& iso)
{
    const std::int64_t us = us_from_iso(iso).value();
    return static_cast<std::size_t>(std::find(table.time_us.begin(), table.time_us.end(), us) -
                                    table.time_us.begin());
}

inline double at(const ForcingTable& table, Field field, const std::string& iso)
{
    const std::size_t row = row_at(table, iso);
    EXPECT_LT(row, table.rows()) << iso;
    return row < table.rows() && table.has(field) ? table[field][row] : kMissing;
}

/// What fell in all rows, kg/m2.
inline double total(const ForcingTable& table, Field field)
{
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < table.rows(); ++i) {
        const double rate = table[field][i];
        if (!std::isnan(rate))
            sum += rate * static_cast<double>(table.time_us[i + 1] - table.time_us[i]) * 1e-6;
    }
    return sum;
}

inline std::string notes(const ReadReport& report)
{
    return to_text(report);
}

}  // namespace petrichor::weather::archive_samples

#endif
