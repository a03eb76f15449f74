#ifndef PETRICHOR_CLI_TEXTURE_BUILD_SHA256_H
#define PETRICHOR_CLI_TEXTURE_BUILD_SHA256_H

#include <filesystem>
#include <string>
#include <string_view>

namespace petrichor::cli {

/// SHA-256 (FIPS 180-4) of some bytes, 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256(std::string_view bytes);

/// The same for a file. Throws Error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace petrichor::cli

#endif
