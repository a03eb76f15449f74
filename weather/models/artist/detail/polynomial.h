#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_POLYNOMIAL_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_POLYNOMIAL_H

#include <array>
#include <vector>

namespace petrichor::weather {

/// c[0] + c[1] x + c[2] x^2 + ...; what the drivers are between two keys. No allocation.
struct Polynomial {
    static constexpr int kMaxDegree = 14;
    std::array<double, kMaxDegree + 1> c{};
    int degree = 0;

    double operator()(double x) const
    {
        double sum = c[static_cast<std::size_t>(degree)];
        for (int i = degree - 1; i >= 0; --i) sum = sum * x + c[static_cast<std::size_t>(i)];
        return sum;
    }
    bool is_zero() const;
};

Polynomial constant(double value);
/// The degree of a result is at most kMaxDegree (asserted).
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);
Polynomial operator*(double factor, const Polynomial& a);
/// d/dx.
Polynomial derivative(const Polynomial& a);
/// The integral from 0 to x.
Polynomial integral(const Polynomial& a);
/// p(x + shift) as a polynomial of x.
Polynomial shifted(const Polynomial& a, double shift);
/// p(scale x) as a polynomial of x.
Polynomial stretched(const Polynomial& a, double scale);

/// Bisects a function that changes sign once between low and high, down to neighbouring doubles or
/// 200 halvings; returns the end on the side of `high`.
template <class Function>
double bisect(const Function& function, double low, double high)
{
    const bool positive = function(high) > 0.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) break;
        ((function(middle) > 0.0) == positive ? high : low) = middle;
    }
    return high;
}

/// Where the polynomial changes sign strictly between low and high, ascending. Roots are isolated
/// by the roots of the derivative, so none is missed; a root that only touches zero is not
/// reported.
std::vector<double> sign_changes(const Polynomial& a, double low, double high);

}  // namespace petrichor::weather

#endif
