#ifndef PETRICHOR_CLI_REPORT_DRAWING_H
#define PETRICHOR_CLI_REPORT_DRAWING_H

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace petrichor::cli {

// A picture of lines, areas and words, before it becomes SVG or pixels. Units: pixels of a plain
// screen, y down. Colours: "#rrggbb".

struct DrawnPoint {
    double x = 0.0;
    double y = 0.0;
};
struct DrawnLine {
    std::vector<DrawnPoint> points;
    std::string color;
    double width = 1.0;
    bool dashed = false;
};
struct DrawnArea {
    std::vector<DrawnPoint> points;  ///< closed
    std::string color;
    double opacity = 1.0;
};
struct DrawnDots {
    std::vector<DrawnPoint> points;
    std::string color;
    double radius = 2.0;
};
enum class Anchor { Start, Middle, End };
struct DrawnText {
    DrawnPoint at;  ///< on the base line
    std::string text;
    std::string color;
    double size = 12.0;
    Anchor anchor = Anchor::Start;
    bool bold = false;
};
using DrawnShape = std::variant<DrawnLine, DrawnArea, DrawnDots, DrawnText>;

struct Drawing {
    double width = 0.0;
    double height = 0.0;
    std::vector<DrawnShape> shapes;  ///< first at the bottom, on white ground
};

/// How wide a text of a size is, about: the font of the viewer decides.
double text_width(const std::string& text, double size);

/// Self-contained SVG with real text.
std::string to_svg(const Drawing& drawing);

/// RGB bytes, row 0 at the top.
struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};
/// The drawing at `scale` pixels a unit, smooth edges, letters drawn as strokes (ASCII and the
/// degree sign; anything else becomes a box). The same bytes on every machine.
Pixels to_pixels(const Drawing& drawing, double scale);

/// & < > " as entities, for text in SVG and HTML.
std::string escaped(const std::string& text);

}  // namespace petrichor::cli

#endif
