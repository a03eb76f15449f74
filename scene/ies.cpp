#include "scene/ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace petrichor::scene {
namespace {

constexpr const char* kFix = "Export the photometry again as LM-63, type C.";
constexpr std::size_t kMostAngles = 1024;

// The numbers behind the line of TILT.
class Numbers {
public:
    Numbers(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    double next(const char* what)
    {
        const auto apart = [](char c) {
            return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
        };
        while (at_ < text_.size() && apart(text_[at_])) ++at_;
        std::size_t end = at_;
        while (end < text_.size() && !apart(text_[end])) ++end;
        std::string_view word = text_.substr(at_, end - at_);
        if (word.empty()) fail(std::string("ends before ") + what);
        if (word.front() == '+') word.remove_prefix(1);
        double value = 0.0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
        if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(value))
            fail(std::string(what) + " must be a number, got \"" + std::string(word.substr(0, 40)) + "\"");
        at_ = end;
        return value;
    }
    std::size_t count(const char* what, std::size_t low)
    {
        const double value = next(what);
        if (!(value >= static_cast<double>(low) && value <= static_cast<double>(kMostAngles)) ||
            value != std::floor(value)) {
            fail(std::string(what) + " must be a whole number from " + std::to_string(low) + " to " +
                 std::to_string(kMostAngles) + ", got " + std::to_string(value));
        }
        return static_cast<std::size_t>(value);
    }
    std::vector<double> angles(const char* what, std::size_t count)
    {
        std::vector<double> all;
        for (std::size_t i = 0; i < count; ++i) {
            all.push_back(next(what));
            if (i > 0 && !(all[i] > all[i - 1])) fail(std::string(what) + " must grow");
        }
        return all;
    }
    [[noreturn]] void fail(const std::string& problem) const { throw Error(name_ + ": " + problem, kFix); }

private:
    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
};

// Place of an angle among the measured ones: the one below and how far it is to the next.
std::pair<std::size_t, double> between(const std::vector<double>& angles, double angle)
{
    if (angles.size() == 1 || angle <= angles.front()) return {0, 0.0};
    if (angle >= angles.back()) return {angles.size() - 2, 1.0};
    const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
    const auto i = static_cast<std::size_t>(above - angles.begin()) - 1;
    return {i, (angle - angles[i]) / (angles[i + 1] - angles[i])};
}

}  // namespace

IesLight read_ies(std::string_view text, const std::string& name)
{
    if (text.size() > (1u << 19)) throw Error(name + ": larger than any photometry", kFix);
    const std::size_t tilt = text.find("TILT=");
    if (tilt == std::string_view::npos) throw Error(name + ": no TILT= line: this is no LM-63 text", kFix);
    const std::size_t line = text.find('\n', tilt);
    std::string_view kind = text.substr(tilt + 5, line == std::string_view::npos ? line : line - tilt - 5);
    while (!kind.empty() && (kind.back() == '\r' || kind.back() == ' ')) kind.remove_suffix(1);
    Numbers in(line == std::string_view::npos ? std::string_view() : text.substr(line), name);
    if (kind == "INCLUDE") {
        // How the output changes as the lamp is tilted: ours hangs as it was measured.
        in.next("the lamp's geometry");
        const std::size_t pairs = in.count("the number of tilts", 1);
        for (std::size_t i = 0; i < 2 * pairs; ++i) in.next("a tilt");
    } else if (kind != "NONE") {
        in.fail("TILT must be NONE or INCLUDE, got \"" + std::string(kind.substr(0, 40)) + "\"");
    }
    in.next("the number of lamps");
    in.next("lumens");
    const double multiplier = in.next("the multiplier");
    const std::size_t rows = in.count("the number of vertical angles", 2);
    const std::size_t columns = in.count("the number of horizontal angles", 1);
    const std::size_t type = in.count("the photometric type", 1);
    if (type != 1) in.fail("photometry of type " + std::string(type == 2 ? "B" : "A") + "; only type C is read");
    for (const char* what : {"units", "width", "length", "height"}) in.next(what);
    const double ballast = in.next("the ballast factor");
    in.next("the lamp factor");
    in.next("watts");
    const double scale = multiplier * ballast;
    if (!(scale > 0.0)) in.fail("multiplier and ballast factor must be above 0");
    const std::vector<double> vertical = in.angles("vertical angles", rows);
    const std::vector<double> horizontal = in.angles("horizontal angles", columns);
    if (vertical.front() < 0.0 || vertical.back() > 180.0)
        in.fail("vertical angles must lie from 0 to 180 degrees");
    const double turn = horizontal.back();
    const bool symmetric = columns == 1 || turn == 90.0 || turn == 180.0 || turn == 360.0;
    if (horizontal.front() != 0.0 || !symmetric)
        in.fail("horizontal angles must run from 0 to 0, 90, 180 or 360 degrees, got " +
                std::to_string(horizontal.front()) + " to " + std::to_string(turn));
    std::vector<double> candela(rows * columns);
    double peak = 0.0;
    for (double& value : candela) {
        value = in.next("candelas");
        if (!(value >= 0.0)) in.fail("candelas must be 0 or more, got " + std::to_string(value));
        peak = std::max(peak, value);
    }
    if (!(peak > 0.0)) in.fail("all candelas are 0");
    IesLight light;
    light.peak_cd = static_cast<float>(peak * scale);
    light.profile.name = name;
    for (int y = 0; y < kLightProfileSide; ++y) {
        const double down = 180.0 * y / (kLightProfileSide - 1);
        const bool measured = down >= vertical.front() - 1e-9 && down <= vertical.back() + 1e-9;
        const auto [v, part_v] = between(vertical, down);
        for (int x = 0; x < kLightProfileSide; ++x) {
            double around = 360.0 * x / kLightProfileSide;
            if (turn == 180.0 && around > 180.0) around = 360.0 - around;
            if (turn == 90.0) {
                around = std::fmod(around, 180.0);
                if (around > 90.0) around = 180.0 - around;
            }
            const auto [h, part_h] = between(horizontal, around);
            const std::size_t other = std::min(h + 1, columns - 1);
            const auto at = [&, row = v, part = part_v](std::size_t column) {
                return candela[column * rows + row] * (1.0 - part) +
                       candela[column * rows + row + 1] * part;
            };
            const double value = measured ? at(h) * (1.0 - part_h) + at(other) * part_h : 0.0;
            light.profile.texels.emplace_back(static_cast<float>(value / peak));
        }
    }
    return light;
}

}  // namespace petrichor::scene
