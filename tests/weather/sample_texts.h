// Samples of files as texts, changed ones, and what a reader says of them.
#ifndef PETRICHOR_TESTS_WEATHER_SAMPLE_TEXTS_H
#define PETRICHOR_TESTS_WEATHER_SAMPLE_TEXTS_H

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "tests/weather/archive_samples.h"

namespace petrichor::weather::archive_samples {

inline std::string corpus(const char* name)
{
    return text_of(std::filesystem::path(PETRICHOR_SAMPLES) / name);
}
inline std::string with(std::string text, const std::string& from, const std::string& to)
{
    EXPECT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
inline std::string refusal(const std::string& text, const ReadOptions& options = {})
{
    try {
        raw(text, options);
    } catch (const Error& error) {
        return std::string(error.what()) + " | " + error.fix();
    }
    return "read";
}

}  // namespace petrichor::weather::archive_samples

#endif
