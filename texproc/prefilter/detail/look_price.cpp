#include "texproc/prefilter/detail/look_price.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "texproc/prefilter/detail/picture_cost.h"

namespace petrichor::texproc::detail {

namespace {

// What a light costs that is worse than with plain mips, and what a view of it does, beside their part of the mean;
// and over how much of a change the price of a light sets in.
constexpr double kWorseLight = 12.0, kWorseView = 3.0, kGently = 0.02;
// What a light costs that was sought because it is worse, and how much more for being worse by 1: most of it is for
// what is worst.
constexpr double kSoughtLight = 0.035, kSoughtMore = 40.0;
// Downhill with a step for each number by its own slopes (Adam), from a rate of .3 steps to a hundredth of one.
constexpr int kSteps = 150;
constexpr float kRate = 0.3f, kLastRate = 0.03f, kKeepSlope = 0.8f, kKeepSquare = 0.95f;
// What it costs for a number to go a step farther than that of the level beside it: next to nothing, so that levels
// which the pictures hardly see go with those that they do.
constexpr float kApart = 2e-5f;
constexpr double kLeastSquare = 1e-10;  // a form may fall below nothing far away

// log(1 + exp(x)), which is x where it is large.
double soft_plus(double x)
{
    return x > 30.0 ? x : std::log1p(std::exp(x));
}

// A form at x, and half of its slope there.
double value_at(const PictureForms::Form& form, const std::vector<float>& x, std::span<float> rise)
{
    const std::size_t n = x.size();
    std::copy(form.slope.begin(), form.slope.end(), rise.begin());
    for (std::size_t i = 0; i < n; ++i) {
        if (x[i] == 0.0f) continue;
        const float* row = &form.square[i * n];
        for (std::size_t j = 0; j < n; ++j) rise[j] += x[i] * row[j];
    }
    double value = form.error;
    for (std::size_t i = 0; i < n; ++i) value += static_cast<double>(x[i] * (rise[i] + form.slope[i]));
    return value;
}

// The price of the forms at x, and its slope. of_level: numbers of a level, one level after another; sought: as
// cheapest_steps() has it.
double price_at(const PictureForms& forms, const std::vector<PictureScore>& plain, std::size_t of_level,
                std::size_t sought, const std::vector<float>& x, std::vector<float>& slope)
{
    const std::size_t n = forms.count, cases = forms.cases.size(), floors = cases - sought;
    std::vector<double> changes(cases), by(cases);
    std::vector<float> rises(cases * n), moves(n);  // of the change of each case
    std::fill(slope.begin(), slope.end(), 0.0f);
    double price = 0.0;
    for (std::size_t c = 0; c < cases; ++c) {
        const std::span<float> rise(&rises[c * n], n);
        const double square = value_at(forms.cases[c].all, x, rise);
        const double rmse = std::sqrt(std::max(square, kLeastSquare));
        changes[c] = change_of(rmse, plain[c].rmse);
        const float scale = static_cast<float>(1.0 / (rmse * (plain[c].rmse + kNothing)));
        for (float& r : rise) r *= scale;
        if (c >= floors) continue;
        // What moves is a form itself.
        const double moving = value_at(forms.cases[c].moving, x, moves);
        const double weight = kFlickerWeight / static_cast<double>(floors);
        price += weight * change_of(moving, plain[c].flicker);
        const float of_moving = static_cast<float>(2.0 * weight / (plain[c].flicker + kNothing));
        for (std::size_t i = 0; i < n; ++i) slope[i] += of_moving * moves[i];
    }
    const std::span<const double> all(changes);
    price += look_price(all.first(floors), std::span(by).first(floors));
    price += worst_price(all.last(sought), std::span(by).last(sought));
    for (std::size_t c = 0; c < cases; ++c)
        for (std::size_t i = 0; i < n; ++i) slope[i] += static_cast<float>(by[c]) * rises[c * n + i];
    for (std::size_t i = 0; i + of_level < n; ++i) {
        const float apart = x[i + of_level] - x[i];
        price += static_cast<double>(kApart * apart * apart);
        slope[i] -= 2.0f * kApart * apart;
        slope[i + of_level] += 2.0f * kApart * apart;
    }
    return price;
}

}  // namespace

double look_price(std::span<const double> changes, std::span<double> slope)
{
    const double each = 1.0 / static_cast<double>(changes.size());
    double sum = 0.0;
    for (std::size_t first = 0; first < changes.size(); first += kHeldOutViews) {
        double light = 0.0;
        for (std::size_t i = first; i < first + kHeldOutViews; ++i) light += changes[i] / kHeldOutViews;
        sum += kHeldOutViews * kWorseLight * kGently * soft_plus(light / kGently);
        const double of_light = kWorseLight / (1.0 + std::exp(-light / kGently));
        for (std::size_t i = first; i < first + kHeldOutViews; ++i) {
            const double of_view = changes[i] > 0.0 ? 1.0 + kWorseView : 1.0;
            sum += of_view * changes[i];
            slope[i] = each * (of_view + of_light);
        }
    }
    return each * sum;
}

double worst_price(std::span<const double> changes, std::span<double> slope)
{
    double sum = 0.0;
    for (std::size_t first = 0; first < changes.size(); first += kHeldOutViews) {
        double light = 0.0;
        for (std::size_t i = first; i < first + kHeldOutViews; ++i) light += changes[i] / kHeldOutViews;
        const double worse = kGently * soft_plus(light / kGently);
        sum += kSoughtLight * worse * (1.0 + 0.5 * kSoughtMore * worse);
        const double of_light = kSoughtLight * (1.0 + kSoughtMore * worse) / (1.0 + std::exp(-light / kGently));
        for (std::size_t i = first; i < first + kHeldOutViews; ++i) slope[i] = of_light / kHeldOutViews;
    }
    return sum;
}

std::vector<float> cheapest_steps(const PictureForms& forms, const std::vector<PictureScore>& plain,
                                  std::span<const float> low, std::span<const float> high, std::size_t of_level,
                                  std::size_t sought)
{
    const std::size_t n = forms.count;
    std::vector<float> x(n, 0.0f), found = x, slope(n), mean(n, 0.0f), square(n, 0.0f);
    double least = std::numeric_limits<double>::infinity();
    float mean_left = 1.0f, square_left = 1.0f;  // of what they began from: nothing
    for (int step = 0; step < kSteps; ++step) {
        const double price = price_at(forms, plain, of_level, sought, x, slope);
        if (price < least) least = price, found = x;
        const float rate = kRate * std::pow(kLastRate, static_cast<float>(step) / static_cast<float>(kSteps));
        mean_left *= kKeepSlope;
        square_left *= kKeepSquare;
        for (std::size_t i = 0; i < n; ++i) {
            mean[i] += (1.0f - kKeepSlope) * (slope[i] - mean[i]);
            square[i] += (1.0f - kKeepSquare) * (slope[i] * slope[i] - square[i]);
            const float typical = std::sqrt(square[i] / (1.0f - square_left)) + 1e-7f;
            x[i] = std::clamp(x[i] - rate * mean[i] / ((1.0f - mean_left) * typical), low[i], high[i]);
        }
    }
    return found;
}

}  // namespace petrichor::texproc::detail
