#ifndef PETRICHOR_CLI_BENCH_TEXTURE_BENCH_H
#define PETRICHOR_CLI_BENCH_TEXTURE_BENCH_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/measure.h"

namespace petrichor::cli {

/// What `petrichor bench texture` times: whole programs, files included, ours beside others.
struct TextureBenchOptions {
    std::filesystem::path petrichor;  ///< the program; empty: the one that runs
    std::string normal, roughness;    ///< maps of one size; empty: a generated wall
    std::string color;  ///< what is compressed as colour; empty: the wall's, or normal
    int size = 4096;    ///< of the generated one
    int repeat = 3;
    bool full = false;  ///< also the slow row: overlap in full quality
    bool json = false;
};

struct TextureBenchRow {
    std::string task;     ///< "prefilter", "mips", "pack", "bc5", "bc7"
    std::string program;  ///< "petrichor median", "maketx"
    std::optional<Cost> cost;
    std::optional<double> psnr_db;  ///< of what was compressed
    /// Why there is no cost ("missing: apt install libfilament-tools"), or what more there is to
    /// say.
    std::string note;
};

/// Medians of every row. Writes into a folder of its own, which it removes. Throws Error when the
/// maps cannot be read or made.
std::vector<TextureBenchRow> texture_rows(const TextureBenchOptions& options);

std::string to_text(const std::vector<TextureBenchRow>& rows);
std::string to_json(const std::vector<TextureBenchRow>& rows);

}  // namespace petrichor::cli

#endif
