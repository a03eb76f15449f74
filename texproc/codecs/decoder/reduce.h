#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_REDUCE_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_REDUCE_H

#include <cstddef>
#include <vector>

#include "base/image.h"
#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Makes an image smaller while its rows arrive, so that the whole of it is never in memory: halved
/// (rounded down) until both sides are at most `max_side`. A texel is the mean over its exact area,
/// as in mip_chain() with the box filter; colour (space Linear) is averaged as light.
class Reducer {
public:
    /// `to` takes reduced().bytes() bytes, floats, linear where `space` says so.
    Reducer(const Header& full, int max_side, ColorSpace space);

    static bool needed(const Header& full, int max_side)
    {
        return max_side > 0 && (full.width > max_side || full.height > max_side);
    }
    const Header& reduced() const { return reduced_; }
    void write_to(std::byte* to) { to_ = reinterpret_cast<float*>(to); }
    /// The next row from the top, in the numbers of the full header.
    void row(const std::byte* from);

private:
    void finish_row();

    Header full_, reduced_;
    ColorSpace space_;
    float* to_ = nullptr;
    int y_ = 0, out_y_ = 0;
    double filled_ = 0.0;               // of the row that is being summed, in input rows
    std::vector<float> input_;          // one row as numbers
    std::vector<double> narrow_, sum_;  // one reduced row, and the sum over rows
};

}  // namespace petrichor::texproc::decoder

#endif
