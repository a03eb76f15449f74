// Files that were cut or filled with zeros: refused where the format shows it, else said.
#include <gmock/gmock.h>

#include <algorithm>

#include "base/error.h"
#include "tests/texproc/textures.h"
#include "texproc/codecs/files/io.h"
#include "texproc/image/zero_rows.h"

namespace petrichor::texproc {
namespace {

class DamagedFiles : public TextureFiles {
protected:
    static RawImage grain(int width, int height)
    {
        return small_chain(width, height, 3, PixelType::U8).front();
    }
    std::filesystem::path file(const std::string& name, std::span<const std::byte> bytes) const
    {
        std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return folder / name;
    }
    // Formats that we do not write.
    void write_portable(const std::filesystem::path& path, const RawImage& image) const
    {
        std::ofstream(path, std::ios::binary)
            << "P6\n"
            << image.width << " " << image.height << "\n255\n"
            << std::string(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size());
    }
    void write_bitmap(const std::filesystem::path& path, const RawImage& image) const
    {
        std::string head = "BM";
        const auto put = [&](std::size_t value, int size) {
            for (int i = 0; i < size; ++i) head += static_cast<char>(value >> (8 * i));
        };
        for (const std::size_t v :
             {54 + image.bytes.size(), std::size_t{0}, std::size_t{54}, std::size_t{40},
              static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height)})
            put(v, 4);
        put(1, 2);
        put(24, 2);
        for (const std::size_t v : {std::size_t{0}, image.bytes.size(), std::size_t{2835},
                                    std::size_t{2835}, std::size_t{0}, std::size_t{0}})
            put(v, 4);
        std::ofstream(path, std::ios::binary)
            << head
            << std::string(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size());
    }
};

TEST_F(DamagedFiles, ThatAreCutAreRefused)
{
    const RawImage image = grain(64, 48);
    for (const char* name : {"a.png", "a.tga", "a.tif", "a.jpg", "a.exr", "a.ppm", "a.bmp"}) {
        const auto path = folder / name;
        if (path.extension() == ".ppm") {
            write_portable(path, image);
        } else if (path.extension() == ".bmp") {
            write_bitmap(path, image);
        } else if (path.extension() == ".exr") {
            write_raw(path, to_raw(to_image(image, ColorSpace::Data), PixelType::F16));
        } else {
            write_raw(path, image);
        }
        EXPECT_EQ(read_raw(path).width, 64) << name;
        const std::vector<std::byte> whole = content_of(path);
        for (const double share : {0.3, 0.6, 0.85}) {
            const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
            EXPECT_THROW(
                read_raw(file("cut" + path.extension().string(), std::span(whole).first(size))),
                Error)
                << name << " " << share;
        }
    }
}

// The image library reads noise here and says nothing.
TEST_F(DamagedFiles, StripsOfATiffThatDoNotInflateAreRefused)
{
    write_raw(folder / "a.tif", grain(200, 150));
    std::vector<std::byte> bytes = content_of(folder / "a.tif");
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2), 200, std::byte{});
    try {
        read_raw(file("damaged.tif", bytes));
        ADD_FAILURE() << "read";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("does not inflate"));
    }
}

TEST(ZeroRows, AreToldFromBothEnds)
{
    RawImage image = small_chain(16, 32, 3, PixelType::U8).front();
    EXPECT_EQ(zero_rows(image), "");
    std::fill(image.bytes.begin() + 48 * 24, image.bytes.end(), std::byte{});
    EXPECT_EQ(zero_rows(image), "rows 24 to 31 of 32 are zero");
    std::reverse(image.bytes.begin(), image.bytes.end());
    EXPECT_EQ(zero_rows(image), "rows 0 to 7 of 32 are zero");
    std::fill(image.bytes.begin(), image.bytes.end(), std::byte{});
    EXPECT_EQ(zero_rows(image), "it is zero all over");
    RawImage alpha = small_chain(16, 32, 4, PixelType::U16).front();
    for (std::size_t i = 0; i < alpha.bytes.size(); i += 8)
        std::fill_n(alpha.bytes.begin() + static_cast<std::ptrdiff_t>(i), 6, std::byte{});
    EXPECT_EQ(zero_rows(alpha), "it is zero all over");
}

}  // namespace
}  // namespace petrichor::texproc
