#ifndef PETRICHOR_TESTS_GOLDEN_JUDGE_H
#define PETRICHOR_TESTS_GOLDEN_JUDGE_H

#include <filesystem>
#include <string>
#include <vector>

#include "tests/golden/compare.h"

namespace petrichor::golden {

/// tests/golden/NAME.exr of the sources.
std::filesystem::path accepted_file(const std::string& name);

/// Names of the demo's pictures, which the program renders.
const std::vector<std::string>& demo_names();

/// Compares with the accepted picture and fails the running test when it is too far: then
/// NAME/{actual,expected,diff}.{exr,png} lie in the build tree, and the message has the command
/// that accepts the picture. Prints one line either way. With PETRICHOR_GOLDEN=accept it writes the
/// accepted file instead, with =exact one bit of difference fails.
void judge(const std::string& name, const Picture& actual, const Tolerance& tolerance = {});

}  // namespace petrichor::golden

#endif
