#include "texproc/codecs/decoder/png.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace petrichor::texproc::decoder {

namespace {

// libpng reports errors by a jump, which must not pass over C++ objects: the calls below are made
// in functions that own none, and the message is kept here.
struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string problem;
    std::span<const std::byte> rest;  // of the file
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message)
{
    static_cast<Reader*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp)
{
}

void take_bytes(png_structp png, png_bytep to, std::size_t count)
{
    Reader& reader = *static_cast<Reader*>(png_get_io_ptr(png));
    if (count > reader.rest.size()) png_error(png, "the file ends too early");
    std::memcpy(to, reader.rest.data(), count);
    reader.rest = reader.rest.subspan(count);
}

bool read_header(Reader& reader)
{
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_read_fn(reader.png, &reader, take_bytes);
    png_read_info(reader.png, reader.info);
    const int color = png_get_color_type(reader.png, reader.info);
    const int depth = png_get_bit_depth(reader.png, reader.info);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(reader.png);
    if (color == PNG_COLOR_TYPE_GRAY && depth < 8) png_set_expand_gray_1_2_4_to_8(reader.png);
    if (png_get_valid(reader.png, reader.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(reader.png);
    if (depth == 16 && std::endian::native == std::endian::little) png_set_swap(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

// Row by row, for images without interlacing. `row` owns nothing that a jump would leave behind.
bool read_each_row(Reader& reader, png_bytep row, int height, const Accept& accept)
{
    if (setjmp(png_jmpbuf(reader.png))) return false;
    for (int y = 0; y < height; ++y) {
        png_read_row(reader.png, row, nullptr);
        accept.row(reinterpret_cast<const std::byte*>(row));
    }
    png_read_end(reader.png, nullptr);
    return true;
}

bool read_rows(Reader& reader, png_bytep* rows)
{
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

std::runtime_error undecodable(const Reader& reader)
{
    return std::runtime_error("its PNG data is damaged or cut short: " + reader.problem);
}

}  // namespace

void read_png(std::span<const std::byte> file, const Accept& accept)
{
    Reader reader;
    reader.rest = file;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    if (reader.png) reader.info = png_create_info_struct(reader.png);
    if (!reader.info) throw std::bad_alloc();
    png_set_user_limits(reader.png, 1 << 24, 1 << 24);  // accept() has the limit that counts
    // Texts, profiles and the like, which nobody reads here: some files claim a gigabyte of them.
    static constexpr png_byte kSkipped[] =
        "bKGD\0cHRM\0eXIf\0gAMA\0hIST\0iCCP\0iTXt\0oFFs\0pCAL\0pHYs\0sBIT\0sCAL\0sPLT\0sRGB\0tEXt\0"
        "tIME\0zTXt";
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, kSkipped, sizeof kSkipped / 5);
    if (!read_header(reader)) throw undecodable(reader);

    Header header;
    header.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
    header.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
    header.channels = png_get_channels(reader.png, reader.info);
    header.type = png_get_bit_depth(reader.png, reader.info) == 16 ? PixelType::U16 : PixelType::U8;
    static const char* const kNames[5][4] = {
        {}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    for (int c = 0; c < header.channels; ++c) {
        header.channel_names.push_back(kNames[header.channels][c]);
    }
    const bool interlaced = png_get_interlace_type(reader.png, reader.info) != PNG_INTERLACE_NONE;
    if (!interlaced && accept.by_rows(header)) {
        std::vector<png_byte> one(png_get_rowbytes(reader.png, reader.info));
        if (!read_each_row(reader, one.data(), header.height, accept)) throw undecodable(reader);
        return;
    }
    std::byte* pixels = accept(header);
    const std::size_t row = static_cast<std::size_t>(header.width) *
                            static_cast<std::size_t>(header.channels) * size_of(header.type);
    std::vector<png_bytep> rows(static_cast<std::size_t>(header.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = reinterpret_cast<png_bytep>(pixels + y * row);
    }
    if (!read_rows(reader, rows.data())) throw undecodable(reader);
}

}  // namespace petrichor::texproc::decoder
