#include "texproc/codecs/decoder/reduce.h"

#include <algorithm>
#include <cmath>

namespace petrichor::texproc::decoder {

Reducer::Reducer(const Header& full, int max_side, ColorSpace space)
    : full_(full), reduced_(full), space_(space)
{
    while (std::max(reduced_.width, reduced_.height) > max_side) {
        reduced_.width = std::max(1, reduced_.width / 2);
        reduced_.height = std::max(1, reduced_.height / 2);
    }
    reduced_.type = PixelType::F32;
    const auto channels = static_cast<std::size_t>(full.channels);
    input_.resize(static_cast<std::size_t>(full.width) * channels);
    narrow_.resize(static_cast<std::size_t>(reduced_.width) * channels);
    sum_.assign(narrow_.size(), 0.0);
}

void Reducer::row(const std::byte* from)
{
    if (y_++ >= full_.height) return;
    to_float(from, full_.type, input_.size(), full_.channels, space_, input_.data());
    const auto channels = static_cast<std::size_t>(full_.channels);
    const double step = static_cast<double>(full_.width) / reduced_.width;
    const int whole = full_.width / reduced_.width;
    if (whole * reduced_.width == full_.width) {  // nearly always: no texel is shared
        const float* in = input_.data();
        for (std::size_t x = 0; x < narrow_.size(); x += channels) {
            for (std::size_t c = 0; c < channels; ++c) {
                double sum = 0.0;
                for (int i = 0; i < whole; ++i)
                    sum += static_cast<double>(in[static_cast<std::size_t>(i) * channels + c]);
                narrow_[x + c] = sum;
            }
            in += static_cast<std::size_t>(whole) * channels;
        }
    }
    for (int x = whole * reduced_.width == full_.width ? reduced_.width : 0; x < reduced_.width;
         ++x) {
        const double begin = x * step, end = std::min<double>((x + 1) * step, full_.width);
        double* out = &narrow_[static_cast<std::size_t>(x) * channels];
        std::fill_n(out, channels, 0.0);
        for (double at = begin; at < end;) {
            const double next = std::min(std::floor(at) + 1.0, end);
            const float* in = &input_[static_cast<std::size_t>(at) * channels];
            for (std::size_t c = 0; c < channels; ++c)
                out[c] += (next - at) * static_cast<double>(in[c]);
            at = next;
        }
    }
    // This row may end one output row and begin the next.
    const double rows = static_cast<double>(full_.height) / reduced_.height;
    double left = 1.0;
    while (left > 1e-9 && out_y_ < reduced_.height) {
        const double share = std::min(left, rows - filled_);
        for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += share * narrow_[i];
        filled_ += share;
        left -= share;
        if (filled_ > rows - 1e-9 || y_ == full_.height) {
            finish_row();
        }
    }
}

void Reducer::finish_row()
{
    const double area =
        filled_ * static_cast<double>(full_.width) / static_cast<double>(reduced_.width);
    float* to = to_ + static_cast<std::size_t>(out_y_++) * sum_.size();
    for (std::size_t i = 0; i < sum_.size(); ++i) to[i] = static_cast<float>(sum_[i] / area);
    std::fill(sum_.begin(), sum_.end(), 0.0);
    filled_ = 0.0;
}

}  // namespace petrichor::texproc::decoder
