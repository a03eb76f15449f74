#include "cli/report/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "cli/report/detail/stroke_font.h"

namespace petrichor::cli {
namespace {

std::string number(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.2f", value);
    std::string trimmed = text;
    while (trimmed.back() == '0') trimmed.pop_back();
    if (trimmed.back() == '.') trimmed.pop_back();
    return trimmed == "-0" ? "0" : trimmed;
}

std::string points_text(const std::vector<DrawnPoint>& points)
{
    std::string text;
    for (const DrawnPoint& point : points) {
        if (!text.empty()) text += ' ';
        text += number(point.x) + "," + number(point.y);
    }
    return text;
}

struct SvgWriter {
    std::string operator()(const DrawnLine& line) const
    {
        return "<polyline points=\"" + points_text(line.points) + "\" fill=\"none\" stroke=\"" +
               line.color + "\" stroke-width=\"" + number(line.width) + "\"" +
               (line.dashed ? " stroke-dasharray=\"3 4\"" : " stroke-linejoin=\"round\"") + "/>\n";
    }
    std::string operator()(const DrawnArea& area) const
    {
        return "<polygon points=\"" + points_text(area.points) + "\" fill=\"" + area.color +
               "\" fill-opacity=\"" + number(area.opacity) + "\"/>\n";
    }
    std::string operator()(const DrawnDots& dots) const
    {
        std::string svg = "<g fill=\"" + dots.color + "\">\n";
        for (const DrawnPoint& p : dots.points) {
            svg += "<circle cx=\"" + number(p.x) + "\" cy=\"" + number(p.y) + "\" r=\"" +
                   number(dots.radius) + "\"/>\n";
        }
        return svg + "</g>\n";
    }
    std::string operator()(const DrawnText& text) const
    {
        const char* const anchors[] = {"start", "middle", "end"};
        return "<text x=\"" + number(text.at.x) + "\" y=\"" + number(text.at.y) +
               "\" text-anchor=\"" + anchors[static_cast<int>(text.anchor)] + "\" font-size=\"" +
               number(text.size) + "\"" + (text.bold ? " font-weight=\"600\"" : "") + " fill=\"" +
               text.color + "\">" + escaped(text.text) + "</text>\n";
    }
};

// ---- pixels ----

std::array<double, 3> rgb_of(const std::string& color)
{
    const auto pair = [&](std::size_t at) {
        return static_cast<double>(std::stoi(color.substr(at, 2), nullptr, 16));
    };
    return {pair(1), pair(3), pair(5)};
}

class Canvas {
public:
    Canvas(int width, int height, double scale)
        : width_(width),
          height_(height),
          scale_(scale),
          rgb_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 255.0f)
    {
    }

    void operator()(const DrawnLine& line)
    {
        const auto color = rgb_of(line.color);
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            DrawnPoint a = line.points[i];
            const DrawnPoint b = line.points[i + 1];
            if (!line.dashed) {
                segment(a, b, line.width, color);
                continue;
            }
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            for (double at = 0.0; at < length; at += 7.0) {  // 3 on, 4 off
                const double end = std::min(at + 3.0, length);
                segment({a.x + (b.x - a.x) * at / length, a.y + (b.y - a.y) * at / length},
                        {a.x + (b.x - a.x) * end / length, a.y + (b.y - a.y) * end / length},
                        line.width, color);
            }
        }
    }

    // Even-odd filling: four scan lines a row, exact coverage along each.
    void operator()(const DrawnArea& area)
    {
        constexpr int kLines = 4;
        const auto color = rgb_of(area.color);
        std::vector<double> cover(static_cast<std::size_t>(width_));
        for (int y = 0; y < height_; ++y) {
            std::fill(cover.begin(), cover.end(), 0.0);
            for (int k = 0; k < kLines; ++k) {
                auto crossings = crossings_at(area.points, (y + (k + 0.5) / kLines) / scale_);
                for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
                    add_span(cover, crossings[i] * scale_, crossings[i + 1] * scale_, 1.0 / kLines);
                }
            }
            for (int x = 0; x < width_; ++x) {
                blend(x, y, color, cover[static_cast<std::size_t>(x)] * area.opacity);
            }
        }
    }

    void operator()(const DrawnDots& dots)
    {
        for (const DrawnPoint& p : dots.points)
            segment(p, p, 2.0 * dots.radius, rgb_of(dots.color));
    }

    void operator()(const DrawnText& text)
    {
        const double unit = text.size / 9.0;  // capitals are 6 high
        const double width = unit * stroke_text_width(text.text);
        double x = text.at.x;
        if (text.anchor == Anchor::Middle) x -= 0.5 * width;
        if (text.anchor == Anchor::End) x -= width;
        for (const StrokeLine& stroke : stroke_text(text.text)) {
            DrawnLine line{{}, text.color, text.bold ? 1.6 : 1.05, false};
            for (const auto& [px, py] : stroke) {
                line.points.push_back({x + unit * px, text.at.y - unit * py});
            }
            (*this)(line);
        }
    }

    Pixels pixels() const
    {
        Pixels result{width_, height_, std::vector<std::uint8_t>(rgb_.size())};
        for (std::size_t i = 0; i < rgb_.size(); ++i) {
            result.rgb[i] = static_cast<std::uint8_t>(std::lround(std::clamp(rgb_[i], 0.f, 255.f)));
        }
        return result;
    }

private:
    static std::vector<double> crossings_at(const std::vector<DrawnPoint>& points, double y)
    {
        std::vector<double> found;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const DrawnPoint& a = points[i];
            const DrawnPoint& b = points[(i + 1) % points.size()];
            if ((a.y <= y) == (b.y <= y)) continue;
            found.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    void add_span(std::vector<double>& cover, double from, double to, double weight) const
    {
        from = std::clamp(from, 0.0, static_cast<double>(width_));
        to = std::clamp(to, 0.0, static_cast<double>(width_));
        for (int x = static_cast<int>(from); x < width_ && x < to; ++x) {
            const double part = std::min(to, x + 1.0) - std::max(from, static_cast<double>(x));
            cover[static_cast<std::size_t>(x)] += weight * std::max(0.0, part);
        }
    }

    // A capsule: coverage from the distance to the segment.
    void segment(DrawnPoint a, DrawnPoint b, double width, const std::array<double, 3>& color)
    {
        const double half = 0.5 * width * scale_;
        a = {a.x * scale_, a.y * scale_};
        b = {b.x * scale_, b.y * scale_};
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        const double square = dx * dx + dy * dy;
        const int x0 = std::max(0, static_cast<int>(std::min(a.x, b.x) - half - 1));
        const int x1 = std::min(width_ - 1, static_cast<int>(std::max(a.x, b.x) + half + 1));
        const int y0 = std::max(0, static_cast<int>(std::min(a.y, b.y) - half - 1));
        const int y1 = std::min(height_ - 1, static_cast<int>(std::max(a.y, b.y) + half + 1));
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                const double px = x + 0.5 - a.x;
                const double py = y + 0.5 - a.y;
                const double t =
                    square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
                const double ex = px - t * dx;
                const double ey = py - t * dy;
                blend(x, y, color, std::clamp(half + 0.5 - std::sqrt(ex * ex + ey * ey), 0.0, 1.0));
            }
        }
    }

    void blend(int x, int y, const std::array<double, 3>& color, double alpha)
    {
        if (alpha <= 0.0) return;
        const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(x)) *
                               3;
        for (std::size_t c = 0; c < 3; ++c) {
            rgb_[at + c] +=
                static_cast<float>(alpha * (color[c] - static_cast<double>(rgb_[at + c])));
        }
    }

    int width_;
    int height_;
    double scale_;
    std::vector<float> rgb_;
};

}  // namespace

std::string escaped(const std::string& text)
{
    std::string result;
    for (char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

double text_width(const std::string& text, double size)
{
    return size / 9.0 * stroke_text_width(text);
}

std::string to_svg(const Drawing& drawing)
{
    const std::string width = number(drawing.width);
    const std::string height = number(drawing.height);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height +
        "\" width=\"" + width + "\" height=\"" + height +
        "\" font-family=\"system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const DrawnShape& shape : drawing.shapes) svg += std::visit(SvgWriter{}, shape);
    return svg + "</svg>\n";
}

Pixels to_pixels(const Drawing& drawing, double scale)
{
    Canvas canvas(static_cast<int>(std::ceil(drawing.width * scale)),
                  static_cast<int>(std::ceil(drawing.height * scale)), scale);
    for (const DrawnShape& shape : drawing.shapes) std::visit(canvas, shape);
    return canvas.pixels();
}

}  // namespace petrichor::cli
