#ifndef PETRICHOR_CLI_BENCH_PEERS_H
#define PETRICHOR_CLI_BENCH_PEERS_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "cli/bench/measure.h"

namespace petrichor::cli {

/// What other renderers are asked to draw: the lights and the camera of a GLB, nothing else.
struct PeerTask {
    std::filesystem::path scene;  ///< .glb
    int width = 0, height = 0;
    int repeat = 5;                  ///< frames timed after one to warm up
    std::filesystem::path modules;   ///< holds node_modules with three, filament, puppeteer-core
    std::filesystem::path pictures;  ///< where each one's picture is kept; empty: nowhere
    int limit_s = 300;               ///< a peer that takes longer is ended
};

/// What one of them took, or why it did not.
struct PeerRow {
    std::string name;     ///< "three.js"
    std::string version;  ///< as it says itself
    std::optional<Cost> cost;
    std::optional<double> likeness;  ///< likeness() of its picture and ours
    std::string note;  ///< "missing: apt install blender", or why its time does not count
};

/// From here on two pictures show the same scene. Tone mapping and lobes that differ leave 0.9 and
/// more; lights that are left out, or nothing drawn, less than that.
constexpr double kSameScene = 0.85;

/// How alike two pictures of one size are in their coarse shape: correlation of the mean codes of
/// blocks of 16 x 16 pixels, over red, green and blue. 1: the same; 0 where one is even.
///   throws  Error when sizes differ
double likeness(const Image& ours, const Image& theirs);

/// Runs every known peer (the table in peers.cpp, scripts in data/peers) one after the other.
/// `ours` is our picture of the task, 3 channels or more of codes.
///   throws  Error when the scripts are not there; Interrupted on Ctrl-C
std::vector<PeerRow> compare_peers(const PeerTask& task, const Image& ours);

/// One row each, ours first; ratios to its CPU time, of those alone whose picture is the same.
std::string peers_text(const Cost& ours, const std::vector<PeerRow>& rows);

}  // namespace petrichor::cli

#endif
