#include "film/tiles/exposed_light.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace petrichor::film {
namespace {

constexpr std::size_t kPixel = 3 * sizeof(std::uint16_t);

[[noreturn]] void fail(const std::string& doing, const std::filesystem::path& file)
{
    throw Error("tiles: cannot " + doing + " " + file.string() + ": " + std::strerror(errno),
                "Make room on the disk: a picture in tiles takes 6 bytes a pixel there besides its files, while it is made.");
}

}  // namespace

ExposedLight::ExposedLight(const std::filesystem::path& file, int width, int height)
    : file_(file), width_(width), height_(height)
{
    descriptor_ = ::open(file_.temporary().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    const auto bytes = static_cast<off_t>(kPixel) * width * height;
    if (descriptor_ < 0 || ::ftruncate(descriptor_, bytes) != 0) fail("write", file_.destination());
    void* mapped = ::mmap(nullptr, static_cast<std::size_t>(bytes), PROT_READ, MAP_SHARED, descriptor_, 0);
    if (mapped == MAP_FAILED) fail("map", file_.destination());
    mapped_ = mapped;
}

ExposedLight::~ExposedLight()
{
    if (mapped_) ::munmap(mapped_, kPixel * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    if (descriptor_ >= 0) ::close(descriptor_);
}

void ExposedLight::put(int x, int y, std::span<const std::uint16_t> rgba)
{
    std::vector<std::uint16_t> rgb(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
        for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = rgba[4 * i + c];
    const auto* bytes = reinterpret_cast<const char*>(rgb.data());
    std::size_t left = rgb.size() * sizeof(std::uint16_t);
    auto at = static_cast<off_t>(kPixel) * (static_cast<off_t>(y) * width_ + x);
    while (left > 0) {
        const ssize_t done = ::pwrite(descriptor_, bytes, left, at);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) fail("write", file_.destination());
        bytes += done;
        at += done;
        left -= static_cast<std::size_t>(done);
    }
}

std::vector<std::uint16_t> ExposedLight::rows(int first, int count) const
{
    std::vector<std::uint16_t> rgb(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(count));
    auto* bytes = reinterpret_cast<char*>(rgb.data());
    std::size_t left = rgb.size() * sizeof(std::uint16_t);
    auto at = static_cast<off_t>(kPixel) * first * width_;
    while (left > 0) {
        const ssize_t done = ::pread(descriptor_, bytes, left, at);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) fail("read", file_.destination());
        bytes += done;
        at += done;
        left -= static_cast<std::size_t>(done);
    }
    return rgb;
}

const std::uint16_t* ExposedLight::all() const
{
    return static_cast<const std::uint16_t*>(mapped_);
}

}  // namespace petrichor::film
