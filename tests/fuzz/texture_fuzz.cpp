// libFuzzer target for the texture containers that we read ourselves: DDS and KTX2, by their
// signature, and SGI for everything else. In the program they are read by the limited decoder.
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/error.h"
#include "texproc/codecs/decoder/sgi.h"
#include "texproc/codecs/files/detail/dds.h"
#include "texproc/codecs/files/detail/ktx2.h"

namespace {

using namespace petrichor::texproc;

class SmallOnly : public decoder::Accept {
public:
    std::byte* operator()(const decoder::Header& h) const override
    {
        if (h.bytes() > 1 << 20) throw std::runtime_error("too large here");
        pixels_.resize(h.bytes());
        return pixels_.data();
    }
    bool by_rows(const decoder::Header&) const override { return false; }
    void row(const std::byte*) const override {}

private:
    mutable std::vector<std::byte> pixels_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::span file(reinterpret_cast<const std::byte*>(data), size);
    const ReadOptions limits{.max_pixels = 1 << 18, .max_bytes = 1 << 22};
    try {
        if (size > 4 && data[0] == 'D') {
            decode_level(detail::parse_dds(file, limits), 0, 1);
        } else if (size > 4 && data[0] == 0xab) {
            decode_level(detail::parse_ktx2(file, limits), 0, 1);
        } else {
            decoder::read_sgi(file, SmallOnly());
        }
    } catch (const petrichor::Error&) {
    } catch (const std::runtime_error&) {
    }
    return 0;
}
