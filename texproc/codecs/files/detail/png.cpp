#include "texproc/codecs/files/detail/png.h"

#include <zlib.h>

#include <cassert>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "base/parallel.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kBlock = 512 * 1024;  // bytes deflated as one; also the size of an IDAT chunk
constexpr std::size_t kBatch = 32 << 20;    // bytes filtered and deflated before they are handed on
constexpr std::size_t kWindow =
    32 * 1024;  // what deflate may look back into, from the block before
constexpr std::size_t kSample = 16 * 1024;  // bytes that stand for their block

void put32(std::byte* to, std::uint32_t v)
{
    for (int i = 0; i < 4; ++i) to[i] = static_cast<std::byte>(v >> (24 - 8 * i));
}

void add_chunk(const ByteSink& sink, const char* kind, const std::byte* data, std::size_t size)
{
    std::byte head[8], sum[4];
    put32(head, static_cast<std::uint32_t>(size));
    std::memcpy(head + 4, kind, 4);
    uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(head + 4), 4);
    if (size) crc = crc32_z(crc, reinterpret_cast<const Bytef*>(data), size);
    put32(sum, static_cast<std::uint32_t>(crc));
    sink(head);
    if (size) sink({data, size});
    sink(sum);
}

// Cost of a filtered row: the sum of its bytes taken as signed, the usual guess of how well it
// deflates.
std::uint64_t row_cost(const std::uint8_t* row, std::size_t size)
{
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const int v = static_cast<std::int8_t>(row[i]);
        sum += static_cast<std::uint64_t>(v < 0 ? -v : v);
    }
    return sum;
}

// One row with its filter byte: 1 (left) or 2 (above), whichever looks cheaper.
void filter_row(const std::uint8_t* row, const std::uint8_t* above, std::size_t size,
                std::size_t pixel, std::uint8_t* to, std::vector<std::uint8_t>& scratch)
{
    to[0] = 1;
    std::uint8_t* left = to + 1;
    std::memcpy(left, row, pixel);
    for (std::size_t i = pixel; i < size; ++i) {
        left[i] = static_cast<std::uint8_t>(row[i] - row[i - pixel]);
    }
    if (!above) return;
    scratch.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
        scratch[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    }
    if (row_cost(scratch.data(), size) < row_cost(left, size)) {
        to[0] = 2;
        std::memcpy(left, scratch.data(), size);
    }
}

// PNG stores 16-bit samples high byte first.
void big_endian_row(const std::byte* from, std::size_t bytes, std::vector<std::uint8_t>& to)
{
    to.resize(bytes);
    for (std::size_t i = 0; i + 1 < bytes; i += 2) {
        std::uint16_t v;
        std::memcpy(&v, from + i, 2);
        to[i] = static_cast<std::uint8_t>(v >> 8);
        to[i + 1] = static_cast<std::uint8_t>(v & 255);
    }
}

struct Block {
    std::vector<std::byte> deflated;
    uLong adler = 1;
    std::size_t size = 0;
};

// Raw deflate of `data`, which may point back into the `before_size` bytes in front of it.
std::vector<std::byte> deflated(const std::uint8_t* data, std::size_t size, std::size_t before_size,
                                bool last, int level, int strategy)
{
    z_stream z{};
    if (deflateInit2(&z, level, Z_DEFLATED, -15, 8, strategy) != Z_OK) throw std::bad_alloc();
    if (before_size) deflateSetDictionary(&z, data - before_size, static_cast<uInt>(before_size));
    const std::size_t most = deflateBound(&z, static_cast<uLong>(size)) + 16;
    const auto scratch = std::make_unique_for_overwrite<Bytef[]>(most);  // far more than is kept
    z.next_in = const_cast<Bytef*>(data);
    z.avail_in = static_cast<uInt>(size);
    z.next_out = scratch.get();
    z.avail_out = static_cast<uInt>(most);
    const int result = deflate(&z, last ? Z_FINISH : Z_SYNC_FLUSH);
    const bool ok = z.avail_in == 0 && (last ? result == Z_STREAM_END : result == Z_OK);
    const auto* written = reinterpret_cast<const std::byte*>(scratch.get());
    std::vector<std::byte> kept(written, written + (most - z.avail_out));
    deflateEnd(&z);
    if (!ok) throw std::runtime_error("png: deflate failed");
    return kept;
}

// Looking for repeats pays on patterns; on the fine grain of most scanned maps it takes twice the
// time and finds nothing. A sample of the block tells; a tenth of its size is not worth the time.
int best_strategy(const std::uint8_t* data, std::size_t size, int level)
{
    if (size < kWindow + kSample) return Z_FILTERED;
    const std::uint8_t* end = data + size - kSample;
    const std::size_t runs = deflated(end, kSample, 0, false, level, Z_RLE).size();
    const std::size_t repeats = deflated(end, kSample, kWindow, false, level, Z_FILTERED).size();
    return 9 * runs <= 10 * repeats ? Z_RLE : Z_FILTERED;
}

// Rows [first, end) filtered, and before them as many as deflate may look back into.
Block encode_rows(const PngImage& image, std::size_t first, std::size_t end, int level)
{
    const std::size_t pixel =
        static_cast<std::size_t>(image.channels) * static_cast<std::size_t>(image.bits / 8);
    const std::size_t row = pixel * static_cast<std::size_t>(image.width), line = row + 1;
    const std::size_t lines_before = (kWindow + line - 1) / line;
    const std::size_t start = first > lines_before ? first - lines_before : 0;
    std::vector<std::uint8_t> filtered((end - start) * line);
    std::vector<std::uint8_t> scratch, now, above;
    const std::size_t from = start > 0 ? start - 1 : 0;
    std::vector<std::byte> made;
    if (image.rows) made = image.rows(from, end);
    for (std::size_t y = start; y < end; ++y) {
        const std::byte* source = image.rows ? made.data() + (y - from) * row : image.pixels + y * row;
        const std::uint8_t* current = reinterpret_cast<const std::uint8_t*>(source);
        const std::uint8_t* previous =
            y ? reinterpret_cast<const std::uint8_t*>(source - row) : nullptr;
        if (image.bits == 16) {
            if (y && y == start) big_endian_row(source - row, row, above);
            big_endian_row(source, row, now);
            current = now.data();
            previous = y ? above.data() : nullptr;
        }
        filter_row(current, previous, row, pixel, &filtered[(y - start) * line], scratch);
        if (image.bits == 16) std::swap(now, above);
    }
    const std::size_t skip = (first - start) * line;
    const std::size_t before = std::min(skip, kWindow);
    const std::uint8_t* data = filtered.data() + skip;
    const std::size_t size = filtered.size() - skip;
    Block block;
    block.deflated = deflated(data, size, before, end == static_cast<std::size_t>(image.height),
                              level, best_strategy(data, size, level));
    block.adler = adler32_z(1, data, size);
    block.size = size;
    return block;
}

void add_start(const PngImage& image, const std::vector<std::pair<std::string, std::string>>& texts,
               const ByteSink& sink)
{
    static constexpr std::uint8_t kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    sink(std::as_bytes(std::span(kSignature)));
    std::byte header[13] = {};
    put32(header, static_cast<std::uint32_t>(image.width));
    put32(header + 4, static_cast<std::uint32_t>(image.height));
    header[8] = static_cast<std::byte>(image.bits);
    static constexpr int kColourType[5] = {0, 0, 4, 2, 6};
    header[9] = static_cast<std::byte>(kColourType[image.channels]);
    add_chunk(sink, "IHDR", header, sizeof header);
    for (const auto& [key, value] : texts) {
        const std::string text = key.substr(0, 79) + std::string(1, '\0') + value;
        add_chunk(sink, "tEXt", reinterpret_cast<const std::byte*>(text.data()), text.size());
    }
}

}  // namespace

void encode_png(const PngImage& image,
                const std::vector<std::pair<std::string, std::string>>& texts, int level,
                int threads, const ByteSink& sink)
{
    assert(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4);
    assert(image.bits == 8 || image.bits == 16);
    const std::size_t line = static_cast<std::size_t>(image.channels) *
                                 static_cast<std::size_t>(image.bits / 8) *
                                 static_cast<std::size_t>(image.width) +
                             1;
    const std::size_t height = static_cast<std::size_t>(image.height);
    const std::size_t lines_a_block = std::max<std::size_t>(1, kBlock / line);
    const std::size_t blocks = (height + lines_a_block - 1) / lines_a_block;
    const std::size_t batch = std::max<std::size_t>(1, kBatch / std::max(kBlock, line));
    add_start(image, texts, sink);
    uLong adler = 1;
    for (std::size_t from = 0; from < blocks; from += batch) {
        std::vector<Block> done(std::min(batch, blocks - from));
        parallel_for(done.size(), threads, [&](std::size_t i) {
            const std::size_t first = (from + i) * lines_a_block;
            done[i] = encode_rows(image, first, std::min(height, first + lines_a_block), level);
        });
        for (std::size_t i = 0; i < done.size(); ++i) {
            std::vector<std::byte>& data = done[i].deflated;
            if (from + i == 0) data.insert(data.begin(), {std::byte{0x78}, std::byte{0x01}});
            adler = adler32_combine(adler, done[i].adler, static_cast<z_off_t>(done[i].size));
            if (from + i + 1 == blocks) {
                std::byte sum[4];
                put32(sum, static_cast<std::uint32_t>(adler));
                data.insert(data.end(), sum, sum + 4);
            }
            add_chunk(sink, "IDAT", data.data(), data.size());
        }
    }
    add_chunk(sink, "IEND", nullptr, 0);
}

std::vector<std::byte> encode_png(const PngImage& image,
                                  const std::vector<std::pair<std::string, std::string>>& texts,
                                  int level, int threads)
{
    std::vector<std::byte> file;
    encode_png(image, texts, level, threads, [&](std::span<const std::byte> bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
    });
    return file;
}

}  // namespace petrichor::texproc::detail
