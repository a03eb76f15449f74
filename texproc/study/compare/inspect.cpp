#include "texproc/study/compare/inspect.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

ChannelFacts facts_of(const Image& image, int channel)
{
    ChannelFacts facts;
    std::vector<float> values;
    const std::size_t step = static_cast<std::size_t>(image.channels);
    values.reserve(image.pixels.size() / step);
    for (std::size_t i = static_cast<std::size_t>(channel); i < image.pixels.size(); i += step) {
        if (std::isfinite(image.pixels[i])) {
            values.push_back(image.pixels[i]);
        } else {
            ++facts.not_finite;
        }
    }
    if (values.empty()) return facts;
    const double count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    for (const float v : values) {
        sum += static_cast<double>(v);
        const int bin = static_cast<int>(std::clamp(16.0f * v, 0.0f, 15.0f));
        facts.histogram[static_cast<std::size_t>(bin)] += 1.0 / count;
    }
    facts.mean = sum / count;
    for (const float v : values) {
        const double d = static_cast<double>(v) - facts.mean;
        squares += d * d;
    }
    facts.deviation = std::sqrt(squares / count);
    const auto quantile = [&](double share) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (count - 1.0));
        std::nth_element(values.begin(), at, values.end());
        return static_cast<double>(*at);
    };
    facts.p5 = quantile(0.05);
    facts.median = quantile(0.5);
    facts.p95 = quantile(0.95);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    facts.low = static_cast<double>(*low);
    facts.high = static_cast<double>(*high);
    return facts;
}

int codes_of(const RawImage& image, int channel)
{
    if (image.type != PixelType::U8) return 0;
    std::array<bool, 256> seen{};
    for (std::size_t i = static_cast<std::size_t>(channel); i < image.bytes.size();
         i += static_cast<std::size_t>(image.channels)) {
        seen[static_cast<std::size_t>(image.bytes[i])] = true;
    }
    return static_cast<int>(std::count(seen.begin(), seen.end(), true));
}

// Mean absolute step between columns a and b (or rows).
double step_between(const Image& image, int a, int b, bool columns)
{
    const int length = columns ? image.height : image.width;
    double sum = 0.0;
    for (int i = 0; i < length; ++i) {
        for (int c = 0; c < image.channels; ++c) {
            const float p = columns ? image.at(a, i, c) : image.at(i, a, c);
            const float q = columns ? image.at(b, i, c) : image.at(i, b, c);
            if (std::isfinite(p) && std::isfinite(q)) sum += static_cast<double>(std::abs(p - q));
        }
    }
    return sum / (length * image.channels);
}

// The step across the seam, over the larger steps inside (a joint that runs along the seam is no
// seam).
double seam(const Image& image, bool columns)
{
    const int size = columns ? image.width : image.height;
    if (size < 8) return 0.0;
    std::vector<double> inside;
    const int stride = std::max(1, size / 1024);
    for (int i = 0; i + 1 < size; i += stride)
        inside.push_back(step_between(image, i, i + 1, columns));
    std::sort(inside.begin(), inside.end());
    const double usual = inside[inside.size() * 97 / 100];
    const double across = step_between(image, size - 1, 0, columns);
    return usual > 1e-9 ? across / usual : across > 1e-9 ? 99.0 : 1.0;
}

struct Lengths {
    double mean = 0.0, near_one = 0.0, upward = 0.0;
};

Lengths lengths_of(const Image& image)
{
    Lengths l;
    const std::size_t step = static_cast<std::size_t>(image.channels);
    const double count = static_cast<double>(image.pixels.size() / step);
    for (std::size_t i = 0; i < image.pixels.size(); i += step) {
        const double x = 2.0 * static_cast<double>(image.pixels[i]) - 1.0;
        const double y = 2.0 * static_cast<double>(image.pixels[i + 1]) - 1.0;
        const double z = 2.0 * static_cast<double>(image.pixels[i + 2]) - 1.0;
        const double length = std::sqrt(x * x + y * y + z * z);
        if (!std::isfinite(length)) continue;
        l.mean += length / count;
        l.near_one += (std::abs(length - 1.0) < 0.2) / count;
        l.upward += (z > 0.0) / count;
    }
    return l;
}

// x and y about one half within the unit circle, and nothing in the other channels.
bool is_two_channel(const std::vector<ChannelFacts>& c, std::size_t x, std::size_t y)
{
    const auto centred = [](const ChannelFacts& f) {
        return std::abs(f.mean - 0.5) < 0.06 && f.deviation > 0.002;
    };
    return centred(c[x]) && centred(c[y]);
}

bool is_constant(const ChannelFacts& c)
{
    return c.high - c.low < 0.012;  // block compression moves a code or two
}

bool is_grey(const Image& image)
{
    for (std::size_t i = 0; i < image.pixels.size();
         i += static_cast<std::size_t>(image.channels)) {
        if (std::abs(image.pixels[i] - image.pixels[i + 1]) > 0.02f) return false;
        if (std::abs(image.pixels[i] - image.pixels[i + 2]) > 0.02f) return false;
    }
    return true;
}

// Correlation of two channels: colours go together, packed masks need not.
double correlation(const Image& image, const std::vector<ChannelFacts>& c, std::size_t a,
                   std::size_t b)
{
    double sum = 0.0;
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += step) {
        sum += (static_cast<double>(image.pixels[i + a]) - c[a].mean) *
               (static_cast<double>(image.pixels[i + b]) - c[b].mean);
    }
    const double norm =
        c[a].deviation * c[b].deviation * static_cast<double>(image.pixels.size() / step);
    return norm > 0.0 && std::isfinite(sum) ? sum / norm : 0.0;
}

void guess_meaning(const Image& image, ImageFacts& facts)
{
    const auto& c = facts.channels;
    const auto say = [&](Meaning meaning, double confidence) {
        facts.meaning = meaning;
        facts.meaning_confidence = std::clamp(confidence, 0.0, 1.0);
    };
    if (std::all_of(c.begin(), c.end(), is_constant) && c.size() != 3)
        return say(Meaning::Constant, 1.0);
    if (c.size() == 4 && is_constant(c[0]) && is_constant(c[2]) && is_two_channel(c, 3, 1)) {
        return say(Meaning::NormalTwoChannel, 0.9);
    }
    if (c.size() == 2 && is_two_channel(c, 0, 1)) return say(Meaning::NormalTwoChannel, 0.7);
    if (c.size() < 3) return say(Meaning::Grey, 0.9);
    const Lengths lengths = lengths_of(image);
    if (lengths.near_one > 0.6 && lengths.upward > 0.95 && std::abs(c[0].mean - 0.5) < 0.15 &&
        std::abs(c[1].mean - 0.5) < 0.15) {
        facts.mean_length = lengths.mean;
        return say(Meaning::Normal, lengths.near_one);
    }
    if (std::all_of(c.begin(), c.end(), is_constant)) return say(Meaning::Constant, 1.0);
    if (is_constant(c[2]) && is_two_channel(c, 0, 1)) return say(Meaning::NormalTwoChannel, 0.7);
    if (is_grey(image)) return say(Meaning::Grey, 0.9);
    const double rg = correlation(image, c, 0, 1), gb = correlation(image, c, 1, 2),
                 rb = correlation(image, c, 0, 2);
    const double together = (rg + gb + rb) / 3.0;
    if (is_constant(c[0]) || is_constant(c[1]) || is_constant(c[2])) return say(Meaning::Data, 0.9);
    if (together > 0.6) return say(Meaning::Color, together);
    if (std::max({rg, gb, rb}) > 0.9) return say(Meaning::Color, 0.6);  // red brick and grey mortar
    // Channels that go their own ways: a packed mask, or very colourful paint.
    return say(Meaning::Data, 0.5 + 0.4 * (0.6 - together));
}

}  // namespace

ImageFacts inspect(const RawImage& raw)
{
    if (raw.values() == 0) throw Error("inspect: the image is empty", "Pass an image with pixels.");
    const Image image = to_image(raw, ColorSpace::Data);
    ImageFacts facts;
    for (int c = 0; c < image.channels; ++c) {
        ChannelFacts channel = facts_of(image, c);
        channel.codes = codes_of(raw, c);
        const std::size_t at = static_cast<std::size_t>(c);
        channel.name = at < raw.channel_names.size() ? raw.channel_names[at]
                       : image.channels <= 2         ? (c == 0 ? "Y" : "A")
                       : c < 4                       ? std::string(1, "RGBA"[c])
                                                     : std::to_string(c);
        facts.channels.push_back(channel);
    }
    guess_meaning(image, facts);
    if (facts.meaning == Meaning::Normal) {
        const Image rgb = from_layout(image, NormalLayout::Rgb);
        facts.green = detect_green(rgb);
    }
    facts.seam_u = seam(image, true);
    facts.seam_v = seam(image, false);
    facts.tiles_u = facts.seam_u > 0.0 && facts.seam_u < 1.5;
    facts.tiles_v = facts.seam_v > 0.0 && facts.seam_v < 1.5;
    return facts;
}

std::string to_text(Meaning meaning)
{
    switch (meaning) {
        case Meaning::Normal:
            return "normal map";
        case Meaning::NormalTwoChannel:
            return "two-channel normal map";
        case Meaning::Color:
            return "colour (sRGB)";
        case Meaning::Grey:
            return "grey (height, roughness, mask: linear)";
        case Meaning::Data:
            return "packed data (linear)";
        case Meaning::Constant:
            return "one constant value";
    }
    return "";
}

}  // namespace petrichor::texproc
