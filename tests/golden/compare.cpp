#include "tests/golden/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "texproc/codecs/files/io.h"

namespace petrichor::golden {
namespace {

const Channel* find(const Picture& picture, const std::string& name)
{
    for (const Channel& channel : picture.channels) {
        if (channel.name == name) return &channel;
    }
    return nullptr;
}

std::string mismatch_of(const Picture& actual, const Picture& expected)
{
    if (actual.width != expected.width || actual.height != expected.height) {
        return std::to_string(actual.width) + " x " + std::to_string(actual.height) +
               " pixels, expected " + std::to_string(expected.width) + " x " +
               std::to_string(expected.height);
    }
    for (const Channel& channel : expected.channels) {
        if (!find(actual, channel.name)) return "channel " + channel.name + " is missing";
    }
    for (const Channel& channel : actual.channels) {
        if (!find(expected, channel.name)) return "channel " + channel.name + " is new";
    }
    return "";
}

// Mean of |expected| of each group: what counts as a normal value in it. Alpha is one everywhere.
std::map<std::string, float> scales_of(const Picture& expected)
{
    std::map<std::string, std::pair<double, std::size_t>> sums;
    for (const Channel& channel : expected.channels) {
        if (channel.name == "A") continue;
        auto& [sum, count] = sums[group_of(channel.name)];
        for (const float v : channel.values) {
            if (!std::isfinite(v)) continue;
            sum += static_cast<double>(std::abs(v));
            ++count;
        }
    }
    std::map<std::string, float> scales;
    for (const auto& [group, sum] : sums) {
        const double mean = sum.second ? sum.first / static_cast<double>(sum.second) : 0.0;
        scales[group] = std::max(static_cast<float>(mean), 1e-6f);
    }
    return scales;
}

float relative_difference(float actual, float expected, float scale)
{
    if (actual == expected || (std::isnan(actual) && std::isnan(expected))) return 0.0f;
    if (!std::isfinite(actual) || !std::isfinite(expected)) {
        return std::numeric_limits<float>::infinity();
    }
    return std::abs(actual - expected) / std::max(std::abs(expected), scale);
}

}  // namespace

Comparison compare(const Picture& actual, const Picture& expected, const Tolerance& tolerance)
{
    Comparison result;
    result.mismatch = mismatch_of(actual, expected);
    if (!result.mismatch.empty()) return result;
    result.relative = {expected.width, expected.height, {}};
    const auto scales = scales_of(expected);
    double sum = 0.0;
    for (const Channel& wanted : expected.channels) {
        const Channel& found = *find(actual, wanted.name);
        const float scale = wanted.name == "A" ? 1.0f : scales.at(group_of(wanted.name));
        Channel relative{wanted.name, false, {}};
        for (std::size_t i = 0; i < wanted.values.size(); ++i) {
            const float d = relative_difference(found.values[i], wanted.values[i], scale);
            relative.values.push_back(d);
            ++result.values;
            if (d == 0.0f) continue;
            ++result.differ;
            if (d > tolerance.fail) ++result.over;
            if (std::isfinite(d)) sum += static_cast<double>(d);
            if (d > result.largest) {
                result.largest = d;
                const std::size_t width = static_cast<std::size_t>(expected.width);
                char text[160];
                std::snprintf(text, sizeof text, "%s at %zu, %zu: %.6g, expected %.6g",
                              wanted.name.c_str(), i % width, i / width,
                              static_cast<double>(found.values[i]),
                              static_cast<double>(wanted.values[i]));
                result.worst_place = text;
            }
        }
        result.relative.channels.push_back(std::move(relative));
    }
    result.mean = result.values ? sum / static_cast<double>(result.values) : 0.0;
    return result;
}

bool passes(const Comparison& comparison, const Tolerance& tolerance)
{
    if (!comparison.mismatch.empty()) return false;
    const double percent =
        100.0 * static_cast<double>(comparison.over) / static_cast<double>(comparison.values);
    return percent <= static_cast<double>(tolerance.percent) &&
           comparison.largest <= tolerance.hard_fail;
}

std::string summary(const Comparison& c)
{
    if (!c.mismatch.empty()) return c.mismatch;
    if (c.equal()) return "equal, " + std::to_string(c.values) + " values";
    const auto percent = [&c](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(c.values);
    };
    char text[240];
    std::snprintf(text, sizeof text,
                  "differs: largest %.3g, mean %.3g, %.3f %% of values differ, %.3f %% too far; "
                  "worst: ",
                  static_cast<double>(c.largest), c.mean, percent(c.differ), percent(c.over));
    return text + c.worst_place;
}

void write_difference_png(const std::filesystem::path& png, const Comparison& comparison,
                          const Tolerance& tolerance)
{
    const Picture& relative = comparison.relative;
    if (relative.channels.empty()) return;
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < relative.channels[0].values.size(); ++i) {
        float worst = 0.0f;
        for (const Channel& channel : relative.channels) worst = std::max(worst, channel.values[i]);
        // From one to ten thousand times the smallest step of a half, in equal steps of the ratio.
        const float shown =
            worst > 0.0f ? std::clamp(0.25f + 0.19f * std::log10(worst * 2048.0f), 0.1f, 1.0f)
                         : 0.0f;
        const auto level = static_cast<std::uint8_t>(std::lround(255.0f * shown));
        const bool over = worst > tolerance.fail;
        bytes.insert(bytes.end(),
                     {level, over ? std::uint8_t{0} : level, over ? std::uint8_t{0} : level});
    }
    texproc::write_png8(png, relative.width, relative.height, 3, bytes);
}

}  // namespace petrichor::golden
