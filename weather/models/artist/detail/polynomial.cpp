#include "weather/models/artist/detail/polynomial.h"

#include <algorithm>
#include <cassert>

namespace petrichor::weather {
namespace {

std::size_t at(int i)
{
    return static_cast<std::size_t>(i);
}

Polynomial trimmed(Polynomial a)
{
    while (a.degree > 0 && a.c[at(a.degree)] == 0.0) --a.degree;
    return a;
}

}  // namespace

bool Polynomial::is_zero() const
{
    return std::all_of(c.begin(), c.begin() + degree + 1, [](double v) { return v == 0.0; });
}

Polynomial constant(double value)
{
    Polynomial a;
    a.c[0] = value;
    return a;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b)
{
    Polynomial sum;
    sum.degree = std::max(a.degree, b.degree);
    for (int i = 0; i <= sum.degree; ++i) sum.c[at(i)] = a.c[at(i)] + b.c[at(i)];
    return trimmed(sum);
}

Polynomial operator-(const Polynomial& a, const Polynomial& b)
{
    return a + (-1.0) * b;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b)
{
    assert(a.degree + b.degree <= Polynomial::kMaxDegree);
    Polynomial product;
    product.degree = a.degree + b.degree;
    for (int i = 0; i <= a.degree; ++i) {
        for (int j = 0; j <= b.degree; ++j) product.c[at(i + j)] += a.c[at(i)] * b.c[at(j)];
    }
    return trimmed(product);
}

Polynomial operator*(double factor, const Polynomial& a)
{
    Polynomial product = a;
    for (int i = 0; i <= a.degree; ++i) product.c[at(i)] = factor * a.c[at(i)];
    return trimmed(product);
}

Polynomial derivative(const Polynomial& a)
{
    Polynomial slope;
    slope.degree = std::max(0, a.degree - 1);
    for (int i = 1; i <= a.degree; ++i) slope.c[at(i - 1)] = i * a.c[at(i)];
    return slope;
}

Polynomial integral(const Polynomial& a)
{
    assert(a.degree < Polynomial::kMaxDegree);
    Polynomial area;
    area.degree = a.degree + 1;
    for (int i = 0; i <= a.degree; ++i) area.c[at(i + 1)] = a.c[at(i)] / (i + 1);
    return trimmed(area);
}

Polynomial shifted(const Polynomial& a, double shift)
{
    Polynomial moved = a;  // Horner's scheme, one coefficient settled a round
    if (shift == 0.0) return moved;
    for (int low = 0; low < a.degree; ++low) {
        for (int i = a.degree - 1; i >= low; --i) moved.c[at(i)] += shift * moved.c[at(i + 1)];
    }
    return moved;
}

Polynomial stretched(const Polynomial& a, double scale)
{
    Polynomial result = a;
    double power = 1.0;
    for (int i = 1; i <= a.degree; ++i) {
        power *= scale;
        result.c[at(i)] *= power;
    }
    return trimmed(result);
}

std::vector<double> sign_changes(const Polynomial& a, double low, double high)
{
    std::vector<double> found;
    if (a.degree == 0 || !(low < high)) return found;
    std::vector<double> bounds = sign_changes(derivative(a), low, high);
    bounds.insert(bounds.begin(), low);
    bounds.push_back(high);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        const double left = a(bounds[i]);
        const double right = a(bounds[i + 1]);
        if ((left > 0.0 && right < 0.0) || (left < 0.0 && right > 0.0)) {
            found.push_back(bisect(a, bounds[i], bounds[i + 1]));
        } else if (right == 0.0 && i + 2 < bounds.size() && left * a(bounds[i + 2]) < 0.0) {
            found.push_back(bounds[i + 1]);  // a flat crossing exactly at an extreme point
        }
    }
    return found;
}

}  // namespace petrichor::weather
