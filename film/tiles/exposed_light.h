#ifndef PETRICHOR_FILM_TILES_EXPOSED_LIGHT_H
#define PETRICHOR_FILM_TILES_EXPOSED_LIGHT_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"

namespace petrichor::film {

/// The exposed light of a picture that is too large for memory: three halves a pixel, in a file that goes with it.
class ExposedLight {
public:
    /// Throws Error: no room, no permission.
    ExposedLight(const std::filesystem::path& file, int width, int height);
    ExposedLight(const ExposedLight&) = delete;
    ExposedLight& operator=(const ExposedLight&) = delete;
    ~ExposedLight();

    int width() const { return width_; }
    int height() const { return height_; }

    /// Pixels of a row from x on, RGBA halves of which alpha is left out. Throws Error (disk full).
    void put(int x, int y, std::span<const std::uint16_t> rgba);
    /// Rows first .. first + count - 1. May be asked by several threads. Throws Error.
    std::vector<std::uint16_t> rows(int first, int count) const;
    /// All of it, for those who look here and there; the system keeps of it in memory what fits.
    const std::uint16_t* all() const;

private:
    OutputFile file_;  // never committed
    int width_, height_;
    int descriptor_ = -1;
    void* mapped_ = nullptr;
};

}  // namespace petrichor::film

#endif
