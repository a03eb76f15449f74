#ifndef PETRICHOR_CLI_REPORT_DETAIL_STROKE_FONT_H
#define PETRICHOR_CLI_REPORT_DETAIL_STROKE_FONT_H

#include <string_view>
#include <utility>
#include <vector>

namespace petrichor::cli {

/// A pen stroke: points (x, y), y up from the base line; capitals are 6 units high.
using StrokeLine = std::vector<std::pair<double, double>>;

/// The strokes of a line of text in a small font of our own, starting at x = 0. ASCII, the degree
/// sign and superscript two; other characters become boxes.
std::vector<StrokeLine> stroke_text(std::string_view utf8);

/// Its width in the same units.
double stroke_text_width(std::string_view utf8);

}  // namespace petrichor::cli

#endif
