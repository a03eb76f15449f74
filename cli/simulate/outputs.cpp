#include "cli/simulate/outputs.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/report/plot.h"
#include "cli/report/report.h"
#include "texproc/codecs/files/io.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

std::string kind_of(const std::filesystem::path& path)
{
    return weather::lower(path.extension().string());
}

}  // namespace

void check_output(const std::filesystem::path& path)
{
    if (path == "-") return;
    for (const char* kind : {".csv", ".json", ".svg", ".png", ".html"}) {
        if (kind_of(path) == kind) return;
    }
    throw Error(
        "simulate: cannot write " + path.string() + ": unknown kind \"" + kind_of(path) + "\"",
        "Use .csv, .json, .svg, .png or .html, or - for CSV on standard output.");
}

void write_table(const SimulationTable& table, const std::filesystem::path& path, bool with_hash)
{
    check_output(path);
    const std::string kind = kind_of(path);
    if (path == "-") {
        std::cout << csv_text(table, with_hash);
    } else if (kind == ".csv") {
        write_text_file(path, csv_text(table, with_hash));
    } else if (kind == ".json") {
        write_text_file(path, json_text(table));
    } else if (kind == ".svg") {
        write_text_file(path, svg_plot(table));
    } else if (kind == ".html") {
        write_text_file(path, html_report(table));
    } else {
        // Sharp where there is room; never more than 2000 pixels high.
        const Drawing drawing = plot_of(table);
        const Pixels pixels = to_pixels(
            drawing, std::min(2.0, std::floor(1999.0 / drawing.height * 1000.0) / 1000.0));
        texproc::write_png8(path, pixels.width, pixels.height, 3, pixels.rgb,
                            {{"state_hash", hash_text(table.state_hash)}});
    }
}

}  // namespace petrichor::cli
