#ifndef PETRICHOR_TEXPROC_CODECS_FILES_EXR_STRIPS_H
#define PETRICHOR_TEXPROC_CODECS_FILES_EXR_STRIPS_H

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "texproc/codecs/files/io.h"

namespace petrichor::texproc {

/// A multi-channel EXR as write_exr() makes it, from strips of rows, so that the whole need not be in memory. The file appears
/// with finish(), or not at all.
class ExrStrips {
public:
    /// channels: names, and whether they are halves
    ExrStrips(const std::filesystem::path& path, int width, int height,
              const std::vector<std::pair<std::string, bool>>& channels,
              const std::vector<std::pair<std::string, std::string>>& metadata);
    ExrStrips(const ExrStrips&) = delete;
    ExrStrips& operator=(const ExrStrips&) = delete;
    ~ExrStrips();

    /// The next rows, from the top: as many values a channel as the strip has pixels, channels in the order of the constructor.
    /// Throws Error for other numbers of them, and when it cannot be written.
    void write(int rows, const std::vector<ExrChannel>& channels);
    /// Throws Error when rows are missing.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::texproc

#endif
