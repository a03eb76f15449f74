#ifndef PETRICHOR_CLI_TEXTURE_BUILD_BUILD_H
#define PETRICHOR_CLI_TEXTURE_BUILD_BUILD_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/material/plan.h"

namespace petrichor::cli {

struct BuildOptions {
    std::filesystem::path out;
    int threads = 0;     ///< 0: all cores; the bytes do not depend on it
    bool force = false;  ///< build what is up to date as well
    bool dry_run = false;
};

struct BuildResult {
    int built = 0, current = 0;
    int files = 0;                      ///< written
    std::vector<std::string> notes;     ///< "material: what was done"
    std::vector<std::string> failures;  ///< "material: problem\n  fix"
    bool stopped = false;               ///< Ctrl-C: materials that were begun are finished
};

/// Makes what is not up to date, materials side by side. A material's files appear together or not
/// at all; one that fails leaves its old files and does not keep the others from being made. Writes
/// OUT/manifest.json. dry_run: prints what would be done. Throws Error when OUT cannot be written.
BuildResult build(const std::vector<texproc::PlannedMaterial>& plan, const BuildOptions& options);

}  // namespace petrichor::cli

#endif
