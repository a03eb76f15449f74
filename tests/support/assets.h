// Shared test data: there only when PETRICHOR_ASSETS names their folder; tests skip without.
#ifndef PETRICHOR_TESTS_SUPPORT_ASSETS_H
#define PETRICHOR_TESTS_SUPPORT_ASSETS_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace petrichor::testing_assets {

/// The folder; empty when there is none.
inline std::filesystem::path asset_folder()
{
    const char* folder = std::getenv("PETRICHOR_ASSETS");
    if (!folder || !std::filesystem::is_directory(folder)) return {};
    return folder;
}

/// The bytes of a file in it; "" when there is none.
inline std::string asset_text(const std::string& name)
{
    std::ifstream in(asset_folder() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace petrichor::testing_assets

/// Declares `variable`, the folder of the data, or skips the test.
#define NEED_ASSETS(variable)                                                            \
    const std::filesystem::path variable = petrichor::testing_assets::asset_folder();    \
    if (variable.empty()) GTEST_SKIP() << "PETRICHOR_ASSETS does not name the shared data"

#endif
