#include "scene/gltf/detail/meshopt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace petrichor::scene {
namespace {

using Bytes = std::vector<std::byte>;

/// Takes bytes from the front; past the end it gives zeros and remembers that.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::uint8_t byte()
    {
        if (at_ >= bytes_.size()) {
            short_ = true;
            return 0;
        }
        return std::to_integer<std::uint8_t>(bytes_[at_++]);
    }
    std::span<const std::byte> take(std::size_t count)
    {
        if (count > bytes_.size() - at_) {
            short_ = true;
            at_ = bytes_.size();
            return {};
        }
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    /// Seven bits a byte, the lowest first.
    std::uint32_t varint()
    {
        std::uint32_t value = 0;
        for (int i = 0; i < 5; ++i) {
            const std::uint32_t part = byte();
            value |= (part & 127u) << (7 * i);
            if (part < 128u) break;
        }
        return value;
    }
    bool ran_out() const { return short_; }
    bool done() const { return !short_ && at_ == bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool short_ = false;
};

std::uint32_t unzigzag(std::uint32_t v)
{
    return (v >> 1) ^ (0u - (v & 1u));
}

// Sixteen deltas: none, 2 or 4 bits each with the rest of the large ones behind, or whole bytes.
void read_group(Reader& in, unsigned kind, std::array<std::uint8_t, 16>& out)
{
    out.fill(0);
    if (kind == 0) return;
    if (kind == 3) {
        for (std::uint8_t& value : out) value = in.byte();
        return;
    }
    const unsigned bits = kind == 1 ? 2 : 4;
    const unsigned large = (1u << bits) - 1;
    const auto packed = in.take(2 * bits);
    if (packed.empty()) return;
    for (unsigned i = 0; i < 16; ++i) {
        const unsigned from = i * bits;
        const auto byte = std::to_integer<unsigned>(packed[from / 8]);
        const unsigned value = byte >> (8 - bits - from % 8) & large;
        out[i] = value == large ? in.byte() : static_cast<std::uint8_t>(value);
    }
}

std::optional<Bytes> unpack_attributes(std::span<const std::byte> packed, std::size_t count,
                                       std::size_t stride)
{
    const std::size_t tail = std::max<std::size_t>(stride, 32);
    if (packed.size() < 1 + tail || packed[0] != std::byte{0xa0}) return std::nullopt;
    Reader in(packed.subspan(1, packed.size() - 1 - tail));
    std::vector<std::uint8_t> last(stride);
    std::memcpy(last.data(), packed.data() + packed.size() - stride, stride);
    Bytes out(count * stride);
    const std::size_t most = std::min<std::size_t>(8192 / stride & ~std::size_t{15}, 256);
    for (std::size_t first = 0; first < count; first += most) {
        const std::size_t here = std::min(most, count - first);
        const std::size_t groups = (here + 15) / 16;
        for (std::size_t k = 0; k < stride; ++k) {
            const auto kinds = in.take((groups + 3) / 4);
            if (kinds.empty()) return std::nullopt;
            for (std::size_t g = 0; g < groups; ++g) {
                const unsigned kind =
                    std::to_integer<unsigned>(kinds[g / 4]) >> (2 * (g % 4)) & 3u;
                std::array<std::uint8_t, 16> deltas;
                read_group(in, kind, deltas);
                for (std::size_t i = 0; i < 16 && 16 * g + i < here; ++i) {
                    last[k] = static_cast<std::uint8_t>(last[k] + unzigzag(deltas[i]));
                    out[(first + 16 * g + i) * stride + k] = static_cast<std::byte>(last[k]);
                }
            }
        }
    }
    if (!in.done()) return std::nullopt;
    return out;
}

void put_index(Bytes& out, std::size_t i, std::size_t stride, std::uint32_t value)
{
    std::memcpy(out.data() + i * stride, &value, stride);  // little-endian
}

struct Ring {
    std::array<std::uint32_t, 16> slots;
    unsigned at = 0;
    Ring() { slots.fill(~0u); }
    std::uint32_t back(unsigned steps) const { return slots[(at - steps) & 15u]; }
    void push(std::uint32_t value, bool keep = true)
    {
        slots[at] = value;
        if (keep) at = (at + 1) & 15u;
    }
};

class TriangleReader {
public:
    TriangleReader(std::span<const std::byte> codes, std::span<const std::byte> data,
                   std::span<const std::byte> table, bool second)
        : codes_(codes), data_(data), table_(table), most_recent_(second ? 13 : 15)
    {
    }

    bool read(Bytes& out, std::size_t stride)
    {
        for (std::size_t i = 0; i < codes_.size(); ++i) {
            const auto code = std::to_integer<unsigned>(codes_[i]);
            const std::array<std::uint32_t, 3> corners =
                code < 0xf0 ? with_edge(code) : without_edge(code);
            for (std::size_t c = 0; c < 3; ++c) put_index(out, 3 * i + c, stride, corners[c]);
        }
        return data_.done();
    }

private:
    using Corners = std::array<std::uint32_t, 3>;

    std::uint32_t explicit_index() { return last_ += unzigzag(data_.varint()); }

    void push_edges(const std::array<std::uint32_t, 2>& a, const std::array<std::uint32_t, 2>& b)
    {
        push_edge(a);
        push_edge(b);
    }
    void push_edge(const std::array<std::uint32_t, 2>& edge)
    {
        edge_from_.push(edge[0]);
        edge_to_.push(edge[1]);
    }

    // The triangle continues over a recent edge.
    Corners with_edge(unsigned code)
    {
        const unsigned edge = code >> 4, how = code & 15u;
        const std::uint32_t a = edge_from_.back(1 + edge), b = edge_to_.back(1 + edge);
        std::uint32_t c = 0;
        bool keep = true;
        if (how < most_recent_) {
            keep = how == 0;
            c = keep ? next_++ : vertices_.back(1 + how);
        } else {
            c = how == 15 ? explicit_index() : last_ += how == 13 ? ~0u : 1u;
        }
        vertices_.push(c, keep);
        push_edges({c, b}, {a, c});
        return {a, b, c};
    }

    // It begins anew.
    Corners without_edge(unsigned code)
    {
        std::uint32_t a = 0, b = 0, c = 0;
        unsigned second = 0, third = 0;
        bool keep_b = false, keep_c = false;
        if (code < 0xfe) {
            const auto pair = std::to_integer<unsigned>(table_[code & 15u]);
            second = pair >> 4, third = pair & 15u;
            a = next_++;
            keep_b = second == 0, keep_c = third == 0;
            b = keep_b ? next_++ : vertices_.back(second);
            c = keep_c ? next_++ : vertices_.back(third);
        } else {
            const unsigned pair = data_.byte();
            second = pair >> 4, third = pair & 15u;
            if (pair == 0) next_ = 0;
            if (code == 0xfe) a = next_++;
            if (second != 15) b = second == 0 ? next_++ : vertices_.back(second);
            if (third != 15) c = third == 0 ? next_++ : vertices_.back(third);
            if (code != 0xfe) a = explicit_index();
            if (second == 15) b = explicit_index();
            if (third == 15) c = explicit_index();
            keep_b = second == 0 || second == 15, keep_c = third == 0 || third == 15;
        }
        vertices_.push(a);
        vertices_.push(b, keep_b);
        vertices_.push(c, keep_c);
        push_edges({b, a}, {c, b});
        push_edge({a, c});
        return {a, b, c};
    }

    std::span<const std::byte> codes_;
    Reader data_;
    std::span<const std::byte> table_;
    unsigned most_recent_;
    Ring edge_from_, edge_to_, vertices_;
    std::uint32_t next_ = 0, last_ = 0;
};

std::optional<Bytes> unpack_triangles(std::span<const std::byte> packed, std::size_t count,
                                      std::size_t stride)
{
    constexpr std::size_t kTable = 16;
    if (packed.size() < 1 + count / 3 + kTable || count % 3 != 0) return std::nullopt;
    const auto header = std::to_integer<unsigned>(packed[0]);
    if (header != 0xe0 && header != 0xe1) return std::nullopt;
    const auto codes = packed.subspan(1, count / 3);
    const auto data = packed.subspan(1 + count / 3, packed.size() - 1 - count / 3 - kTable);
    Bytes out(count * stride);
    if (!TriangleReader(codes, data, packed.last(kTable), header == 0xe1).read(out, stride))
        return std::nullopt;
    return out;
}

std::optional<Bytes> unpack_indices(std::span<const std::byte> packed, std::size_t count,
                                    std::size_t stride)
{
    constexpr std::size_t kTail = 4;
    if (packed.size() < 1 + count + kTail) return std::nullopt;
    const auto header = std::to_integer<unsigned>(packed[0]);
    if (header != 0xd0 && header != 0xd1) return std::nullopt;
    Reader in(packed.subspan(1, packed.size() - 1 - kTail));
    std::array<std::uint32_t, 2> last{0, 0};
    Bytes out(count * stride);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t value = in.varint();
        std::uint32_t& base = last[value & 1u];
        base += unzigzag(value >> 1);
        put_index(out, i, stride, base);
    }
    if (!in.done()) return std::nullopt;
    return out;
}

template <class T>
T get(const std::byte* from)
{
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

template <class T>
void put(std::byte* to, T value)
{
    std::memcpy(to, &value, sizeof value);
}

float rounded(float v)
{
    return std::trunc(v + (v >= 0.0f ? 0.5f : -0.5f));
}

// A unit vector on an octahedron; its third number says what 1 is.
template <class T>
void from_octahedron(std::byte* at)
{
    constexpr float kLargest = sizeof(T) == 1 ? 127.0f : 32767.0f;
    float x = get<T>(at), y = get<T>(at + sizeof(T));
    float z = static_cast<float>(get<T>(at + 2 * sizeof(T))) - std::abs(x) - std::abs(y);
    const float below = std::min(z, 0.0f);
    x += x >= 0.0f ? below : -below;
    y += y >= 0.0f ? below : -below;
    const float length = std::sqrt(x * x + y * y + z * z);
    const float scale = length > 0.0f ? kLargest / length : 0.0f;
    const float out[3] = {x * scale, y * scale, z * scale};
    for (std::size_t i = 0; i < 3; ++i)
        put(at + i * sizeof(T), static_cast<T>(rounded(out[i])));
}

// A unit quaternion of which three numbers are kept; the lowest bits of the fourth say which is not.
void from_three_of_four(std::byte* at)
{
    const auto number = [at](std::size_t i) { return get<std::int16_t>(at + 2 * i); };
    const int fourth = number(3);
    const float scale = 0.70710678f / static_cast<float>(fourth | 3);
    const float x = static_cast<float>(number(0)) * scale;
    const float y = static_cast<float>(number(1)) * scale;
    const float z = static_cast<float>(number(2)) * scale;
    const float w = std::sqrt(std::max(0.0f, 1.0f - x * x - y * y - z * z));
    const auto which = static_cast<std::size_t>(fourth & 3);
    const float out[4] = {w, x, y, z};
    for (std::size_t i = 0; i < 4; ++i) {
        const float value = std::clamp(out[i] * 32767.0f, -32767.0f, 32767.0f);
        put(at + 2 * ((which + i) & 3u), static_cast<std::int16_t>(rounded(value)));
    }
}

void from_exponent(std::byte* at)
{
    const auto packed = get<std::uint32_t>(at);
    const auto mantissa = static_cast<std::int32_t>(packed << 8) >> 8;
    const auto exponent = static_cast<std::int32_t>(packed) >> 24;
    put(at, std::ldexp(static_cast<float>(mantissa), exponent));
}

bool unfilter(Bytes& bytes, std::size_t stride, MeshoptFilter filter)
{
    if (filter == MeshoptFilter::Octahedral && stride != 4 && stride != 8) return false;
    if (filter == MeshoptFilter::Quaternion && stride != 8) return false;
    const std::size_t step = filter == MeshoptFilter::Exponential ? 4 : stride;
    for (std::size_t at = 0; at + step <= bytes.size(); at += step) {
        std::byte* here = bytes.data() + at;
        if (filter == MeshoptFilter::Quaternion)
            from_three_of_four(here);
        else if (filter == MeshoptFilter::Exponential)
            from_exponent(here);
        else if (stride == 4)
            from_octahedron<std::int8_t>(here);
        else
            from_octahedron<std::int16_t>(here);
    }
    return true;
}

}  // namespace

std::optional<Bytes> unpack_meshopt(std::span<const std::byte> packed, std::size_t count,
                                    std::size_t stride, MeshoptMode mode, MeshoptFilter filter)
{
    if (mode == MeshoptMode::Attributes) {
        if (stride == 0 || stride > 256 || stride % 4 != 0) return std::nullopt;
        auto out = unpack_attributes(packed, count, stride);
        if (out && filter != MeshoptFilter::None && !unfilter(*out, stride, filter))
            return std::nullopt;
        return out;
    }
    if ((stride != 2 && stride != 4) || filter != MeshoptFilter::None) return std::nullopt;
    return mode == MeshoptMode::Triangles ? unpack_triangles(packed, count, stride)
                                          : unpack_indices(packed, count, stride);
}

}  // namespace petrichor::scene
