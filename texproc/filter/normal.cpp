#include "texproc/filter/normal.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "base/error.h"
#include "texproc/filter/detail/fft.h"

namespace petrichor::texproc {

namespace {

void check_normal(const Image& normal)
{
    if (normal.empty() || normal.channels != 3) {
        throw Error("normal: a normal map needs 3 channels, got " + std::to_string(normal.channels),
                    "Unpack two-channel maps first (--from-layout).");
    }
}

// Slopes dh/du and dh/dv (v down the image) of a green-up map.
void slopes(const Image& normal, std::vector<float>& su, std::vector<float>& sv)
{
    const std::size_t count = normal.pixels.size() / 3;
    su.resize(count);
    sv.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float x = 2.0f * normal.pixels[3 * i] - 1.0f;
        const float y = 2.0f * normal.pixels[3 * i + 1] - 1.0f;
        const float z = std::max(0.05f, 2.0f * normal.pixels[3 * i + 2] - 1.0f);
        su[i] = -x / z;
        sv[i] = y / z;
    }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

int wrapped(int i, int size)
{
    return (i % size + size) % size;
}

}  // namespace

void flip_green(Image& normal)
{
    check_normal(normal);
    for (std::size_t i = 1; i < normal.pixels.size(); i += 3) {
        normal.pixels[i] = 1.0f - normal.pixels[i];
    }
}

void renormalize(Image& normal, float tolerance)
{
    check_normal(normal);
    for (std::size_t i = 0; i < normal.pixels.size(); i += 3) {
        float* c = &normal.pixels[i];
        const float x = 2.0f * c[0] - 1.0f, y = 2.0f * c[1] - 1.0f, z = 2.0f * c[2] - 1.0f;
        const float length = std::sqrt(x * x + y * y + z * z);
        if (std::abs(length - 1.0f) < tolerance) continue;
        const bool fine = length > 0.01f;  // a zero in 8 bits is not exactly zero
        c[0] = fine ? 0.5f + 0.5f * (x / length) : 0.5f;
        c[1] = fine ? 0.5f + 0.5f * (y / length) : 0.5f;
        c[2] = fine ? 0.5f + 0.5f * (z / length) : 1.0f;
    }
}

NormalLayout normal_layout(const std::string& name)
{
    if (name == "rgb") return NormalLayout::Rgb;
    if (name == "rg") return NormalLayout::Rg;
    if (name == "ag") return NormalLayout::Ag;
    if (name == "rxgb") return NormalLayout::Rxgb;
    if (name == "rg-signed") return NormalLayout::RgSigned;
    throw Error("normal: there is no layout '" + name + "'", "Use rgb, rg, ag, rxgb or rg-signed.");
}

Image to_layout(const Image& normal, NormalLayout layout)
{
    check_normal(normal);
    if (layout == NormalLayout::Rgb) return normal;
    if (layout == NormalLayout::RgSigned) {
        Image out(normal.width, normal.height, 2, ColorSpace::Data);
        for (std::size_t i = 0; i < out.pixels.size(); ++i) {
            out.pixels[i] = 2.0f * normal.pixels[3 * (i / 2) + i % 2] - 1.0f;
        }
        return out;
    }
    const bool four = layout != NormalLayout::Rg;
    Image out(normal.width, normal.height, four ? 4 : 3, ColorSpace::Data);
    const std::size_t step = four ? 4 : 3;
    for (std::size_t i = 0; i < normal.pixels.size() / 3; ++i) {
        const float* n = &normal.pixels[3 * i];
        float* o = &out.pixels[step * i];
        o[1] = n[1];
        if (layout == NormalLayout::Rg) {
            o[0] = n[0];
        } else {
            o[0] = layout == NormalLayout::Ag ? 1.0f : 0.0f;
            o[2] = layout == NormalLayout::Ag ? 1.0f : n[2];
            o[3] = n[0];
        }
    }
    return out;
}

Image from_layout(const Image& image, NormalLayout layout)
{
    const bool alpha = layout == NormalLayout::Ag || layout == NormalLayout::Rxgb;
    const int needed = layout == NormalLayout::Rgb ? 3 : alpha ? 4 : 2;
    if (image.channels < needed) {
        throw Error("normal: this layout needs " + std::to_string(needed) + " channels, got " +
                        std::to_string(image.channels),
                    "Name the layout that the file really has.");
    }
    Image out(image.width, image.height, 3, ColorSpace::Data);
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < out.pixels.size() / 3; ++i) {
        const float* c = &image.pixels[step * i];
        float* o = &out.pixels[3 * i];
        o[0] = alpha ? c[3] : c[0];
        o[1] = c[1];
        if (layout == NormalLayout::RgSigned) {
            o[0] = 0.5f + 0.5f * o[0];
            o[1] = 0.5f + 0.5f * o[1];
        }
        const float x = 2.0f * o[0] - 1.0f, y = 2.0f * o[1] - 1.0f;
        o[2] = layout == NormalLayout::Rgb
                   ? c[2]
                   : 0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - x * x - y * y));
    }
    return out;
}

GreenDirection detect_green(const Image& normal, const Image& height)
{
    check_normal(normal);
    if (height.width != normal.width || height.height != normal.height) {
        throw Error("normal: the height map has another size than the normal map",
                    "Resample one of them.");
    }
    std::vector<float> su, sv;
    slopes(normal, su, sv);
    std::vector<double> found, wanted;
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            const double rise =
                static_cast<double>(height.at(x, wrapped(y + 1, height.height), 0)) -
                static_cast<double>(height.at(x, wrapped(y - 1, height.height), 0));
            wanted.push_back(rise);
            found.push_back(static_cast<double>(sv[wanted.size() - 1]));
        }
    }
    const double c = correlation(found, wanted);
    return {c < 0.0, std::abs(c)};
}

GreenDirection detect_green(const Image& normal)
{
    check_normal(normal);
    std::vector<float> su, sv;
    slopes(normal, su, sv);
    const auto at = [&](const std::vector<float>& s, int x, int y) {
        return static_cast<double>(s[static_cast<std::size_t>(wrapped(y, normal.height)) *
                                         static_cast<std::size_t>(normal.width) +
                                     static_cast<std::size_t>(wrapped(x, normal.width))]);
    };
    std::vector<double> a, b;  // d su / dv and d sv / du: equal on a surface
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) {
            a.push_back(at(su, x, y + 1) - at(su, x, y - 1));
            b.push_back(at(sv, x + 1, y) - at(sv, x - 1, y));
        }
    }
    const double c = correlation(a, b);
    return {c < 0.0, std::abs(c)};
}

Image normal_from_height(const Image& height, const HeightScale& scale)
{
    if (height.empty()) throw Error("normal: the height map is empty", "Pass a map with pixels.");
    Image out(height.width, height.height, 3, ColorSpace::Data);
    const float per_texel = scale.depth * static_cast<float>(height.width) * 0.5f;
    const auto at = [&](int x, int y) {
        return height.at(edge_index(x, height.width, scale.edge_u),
                         edge_index(y, height.height, scale.edge_v), 0);
    };
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            const float nx = -per_texel * (at(x + 1, y) - at(x - 1, y));
            const float ny = per_texel * (at(x, y + 1) - at(x, y - 1));
            const float s = 0.5f / std::sqrt(1.0f + nx * nx + ny * ny);
            out.at(x, y, 0) = 0.5f + nx * s;
            out.at(x, y, 1) = 0.5f + ny * s;
            out.at(x, y, 2) = 0.5f + s;
        }
    }
    return out;
}

// The normals of a surface that goes on mirrored along the chosen axes, once more as wide or high:
// it tiles, and in the copies the slope across the mirror turns round.
static Image mirrored_on(const Image& normal, bool u, bool v)
{
    Image out(normal.width * (u ? 2 : 1), normal.height * (v ? 2 : 1), 3, ColorSpace::Data);
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const int from_x = edge_index(x, normal.width, Edge::Mirror);
            const int from_y = edge_index(y, normal.height, Edge::Mirror);
            const float nx = normal.at(from_x, from_y, 0), ny = normal.at(from_x, from_y, 1);
            out.at(x, y, 0) = x < normal.width ? nx : 1.0f - nx;
            out.at(x, y, 1) = y < normal.height ? ny : 1.0f - ny;
            out.at(x, y, 2) = normal.at(from_x, from_y, 2);
        }
    }
    return out;
}

// Frankot and Chellappa 1988, with the frequency response of the central difference that
// normal_from_height takes, so that the round trip is exact for what that difference can see.
static IntegratedHeight tiling_height(const Image& normal)
{
    check_normal(normal);
    std::vector<float> su, sv;
    slopes(normal, su, sv);
    const std::size_t count = su.size();
    std::vector<std::complex<double>> u(su.begin(), su.end()), v(sv.begin(), sv.end());
    detail::fft_2d(u, normal.width, normal.height, false);
    detail::fft_2d(v, normal.width, normal.height, false);
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(normal.width) +
                static_cast<std::size_t>(x);
            const double wu = std::sin(6.283185307179586 * x / normal.width);
            const double wv = std::sin(6.283185307179586 * y / normal.height);
            const double power = wu * wu + wv * wv;
            u[i] = power > 1e-9 ? std::complex<double>(0.0, -1.0) * (wu * u[i] + wv * v[i]) / power
                                : std::complex<double>(0.0, 0.0);
        }
    }
    detail::fft_2d(u, normal.width, normal.height, true);
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < count; ++i) {
        low = std::min(low, u[i].real());
        high = std::max(high, u[i].real());
    }
    IntegratedHeight out{Image(normal.width, normal.height, 1, ColorSpace::Data, 0.5f), 0.0f};
    if (!(high - low > 1e-12)) return out;
    for (std::size_t i = 0; i < count; ++i) {
        out.height.pixels[i] = static_cast<float>((u[i].real() - low) / (high - low));
    }
    out.depth = static_cast<float>((high - low) / normal.width);
    return out;
}

IntegratedHeight height_from_normal(const Image& normal, Edge edge_u, Edge edge_v)
{
    if (edge_u == Edge::Wrap && edge_v == Edge::Wrap) return tiling_height(normal);
    check_normal(normal);
    const IntegratedHeight whole =
        tiling_height(mirrored_on(normal, edge_u != Edge::Wrap, edge_v != Edge::Wrap));
    // The copies hold the same heights, and so the same range; the depth is told in widths.
    IntegratedHeight out{
        Image(normal.width, normal.height, 1, ColorSpace::Data),
        whole.depth * static_cast<float>(whole.height.width) / static_cast<float>(normal.width)};
    for (int y = 0; y < normal.height; ++y) {
        for (int x = 0; x < normal.width; ++x) out.height.at(x, y, 0) = whole.height.at(x, y, 0);
    }
    return out;
}

Image blend_normals(const Image& base, const Image& detail)
{
    check_normal(base);
    check_normal(detail);
    if (base.width != detail.width || base.height != detail.height) {
        throw Error("normal: the two maps to blend have different sizes", "Resample one of them.");
    }
    Image out(base.width, base.height, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < base.pixels.size(); i += 3) {
        const float tx = 2.0f * base.pixels[i] - 1.0f, ty = 2.0f * base.pixels[i + 1] - 1.0f,
                    tz = 2.0f * base.pixels[i + 2];  // t + (0, 0, 1)
        const float ux = 1.0f - 2.0f * detail.pixels[i], uy = 1.0f - 2.0f * detail.pixels[i + 1],
                    uz = 2.0f * detail.pixels[i + 2] - 1.0f;  // (-x, -y, z)
        const float k = (tx * ux + ty * uy + tz * uz) / std::max(tz, 1e-3f);
        out.pixels[i] = 0.5f + 0.5f * (tx * k - ux);
        out.pixels[i + 1] = 0.5f + 0.5f * (ty * k - uy);
        out.pixels[i + 2] = 0.5f + 0.5f * (tz * k - uz);
    }
    renormalize(out);
    return out;
}

}  // namespace petrichor::texproc
