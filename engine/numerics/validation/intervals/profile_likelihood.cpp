#include "numerics/validation/intervals/profile_likelihood.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/residual_tests.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kReach = 4;  // standard errors
constexpr int kExtensions = 6, kBisections = 14;

/// The best fit with the parameter held at a value.
struct HeldFit {
    double value = 0, loss = kInfinity;
    Fit fit;
};

class ProfileSearch {
  public:
    ProfileSearch(const RefittedOutput& model, Index place, const ProfileOptions& options)
        : model_(model),
          place_(place),
          options_(options),
          base_(model.fit()),
          N_(static_cast<double>(model.measured().size())) {}

    const Fit& base() const { return base_; }
    bool canceled() const { return canceled_; }

    HeldFit at(double value, const Fit& from) {
        HeldFit held{value, kInfinity, from};
        if (canceled_ || (options_.cancel && options_.cancel())) {
            canceled_ = true;
            return held;
        }
        held.fit = model_.fit({{place_, value}}, &from);
        held.loss = held.fit.loss;
        return held;
    }
    /// From the estimate outwards on both sides, then back.
    std::vector<HeldFit> walk(const std::vector<double>& values) {
        std::vector<HeldFit> all(values.size());
        const auto above =
            static_cast<std::size_t>(std::ranges::upper_bound(values, base_.theta[place_]) - values.begin());
        const auto go = [&](std::size_t i, const Fit& from) {
            HeldFit next = at(values[i], from);
            if (!(all[i].loss <= next.loss)) all[i] = std::move(next);
        };
        for (std::size_t i = above; i < values.size(); ++i) go(i, i == above ? base_ : all[i - 1].fit);
        for (std::size_t i = above; i-- > 0;) go(i, i + 1 == above ? base_ : all[i + 1].fit);
        for (std::size_t i = 1; i < above; ++i) go(i, all[i - 1].fit);
        for (std::size_t i = values.size(); i-- > above + 1;) go(i - 1, all[i].fit);
        return all;
    }
    double rise(double loss, double least) const { return N_ * std::log(loss / least); }

    /// Where the rise passes the level between a fit inside the interval and one outside.
    double crossing(HeldFit inside, double outside, double least, double level) {
        for (int i = 0; i < kBisections && !canceled_; ++i) {
            HeldFit middle = at((inside.value + outside) / 2, inside.fit);
            if (rise(middle.loss, least) < level)
                inside = std::move(middle);
            else
                outside = middle.value;
        }
        return (inside.value + outside) / 2;
    }

  private:
    const RefittedOutput& model_;
    Index place_;
    const ProfileOptions& options_;
    Fit base_;
    double N_;
    bool canceled_ = false;
};

/// Values on even steps, and with a delay of a held input the samples.
std::vector<double> grid_between(double low, double high, int points, double sample) {
    std::vector<double> values;
    for (int i = 0; i < points; ++i) values.push_back(low + (high - low) * i / (points - 1));
    if (sample > 0 && (high - low) / sample < 1000)
        for (double k = std::ceil(low / sample); k * sample <= high; ++k) values.push_back(k * sample);
    std::ranges::sort(values);
    const double same = 1e-9 * (high - low);
    values.erase(std::unique(values.begin(), values.end(), [&](double a, double b) { return b - a < same; }),
                 values.end());
    return values;
}

struct Ends {
    double low, high;
};

Ends first_ends(const RefittedOutput& model, Index place, const Fit& base, const ProfileOptions& options) {
    const auto [lower, upper] = model.bounds(place);
    const double value = base.theta[place], std = base.std[place];
    if (options.range) {
        const auto [low, high] = *options.range;
        if (!(lower <= low && low < value && value < high && high <= upper))
            throw InvalidArgument(
                "profile: option {} must contain the estimate, {}, and be between {} and {}, but it ranges from {} to "
                "{}",
                OptionName{"range"}, value, lower, upper, low, high);
        return {low, high};
    }
    const bool known = std::isfinite(std) && std > 0;
    const double reach = known ? kReach * std : std::max(0.5 * std::abs(value), model.data().mean_step());
    return {std::max(lower, value - reach), std::min(upper, value + reach)};
}

void read_interval(Profile& profile, ProfileSearch& search, const std::vector<HeldFit>& fits, double least) {
    const auto inside = [&](const HeldFit& one) { return search.rise(one.loss, least) < profile.level; };
    const auto first = std::ranges::find_if(fits, inside);
    const auto last = std::find_if(fits.rbegin(), fits.rend(), inside);
    if (first == fits.end()) {  // narrower than the grid: the estimate is all there is inside
        const auto above = std::ranges::find_if(fits, [&](const HeldFit& one) { return one.value > profile.estimate; });
        const HeldFit base{profile.estimate, search.base().loss, search.base()};
        if (above != fits.begin()) profile.low = search.crossing(base, (above - 1)->value, least, profile.level);
        if (above != fits.end()) profile.high = search.crossing(base, above->value, least, profile.level);
        return;
    }
    if (first != fits.begin()) profile.low = search.crossing(*first, (first - 1)->value, least, profile.level);
    if (last != fits.rbegin()) profile.high = search.crossing(*last, (last - 1)->value, least, profile.level);
    if (std::any_of(first, last.base(), [&](const HeldFit& one) { return !inside(one); }))
        profile.warnings.push_back(
            Message("The confidence region consists of several intervals; the result contains the outermost limits."));
}

Message interval_text(const Profile& profile) {
    const std::optional<double>&low = profile.low, &high = profile.high;
    if (low && high) return Message("between {} and {}", *low, *high);
    if (low) return Message("from {}, without an upper limit on the grid", *low);
    if (high) return Message("up to {}, without a lower limit on the grid", *high);
    return Message("without limits on the grid");
}

void warn_of_color(Profile& profile, const RefittedOutput& model, const Fit& base) {
    const Vector errors = model.measured() - model.simulated(base);
    std::vector<Vector> data_sets;
    Index row = 0;
    for (const Index length : model.lengths()) {
        data_sets.emplace_back(errors.segment(row, length));
        row += length;
    }
    if (!whiteness_test(data_sets).white)
        profile.warnings.push_back(Message("The residuals are not white, so the interval is too narrow."));
}

}  // namespace

void ProfileOptions::validate() const {
    if (!(confidence > 0 && confidence < 1))
        throw InvalidArgument("profile: {} must be between 0 and 1, such as 0.95, but is {}", OptionName{"confidence"},
                              confidence);
    if (points < 5) throw InvalidArgument("profile: {} must be at least 5, but is {}", OptionName{"points"}, points);
    if (range && !(range->first < range->second))
        throw InvalidArgument("profile: {} must be two increasing numbers, but is {} to {}", OptionName{"range"},
                              range->first, range->second);
}

Profile profile_likelihood(const RefittedOutput& model, const std::string& name, const ProfileOptions& options) {
    options.validate();
    const Index place = model.fitted().place_of(name);
    ProfileSearch search(model, place, options);
    const Fit& base = search.base();
    Profile profile;
    profile.name = name;
    profile.estimate = base.theta[place];
    profile.std = base.std[place];
    profile.level = chi_squared_quantile(options.confidence, 1);
    if (!(base.loss > 0))
        throw InvalidArgument(
            "profile: all residuals are zero, so no confidence interval can be computed. Use measured data, or add "
            "noise");
    Ends ends = first_ends(model, place, base, options);
    const auto [lower, upper] = model.bounds(place);
    const IdData& data = model.data();
    const double sample = name == "Td" && data.regular() && data.hold == Hold::kZoh ? data.Ts : 0;
    std::vector<HeldFit> fits;
    double least = base.loss;
    for (int i = 0; i <= kExtensions; ++i) {
        fits = search.walk(grid_between(ends.low, ends.high, options.points, sample));
        for (const HeldFit& one : fits) least = std::min(least, one.loss);
        const bool open_below = search.rise(fits.front().loss, least) < profile.level && ends.low > lower;
        const bool open_above = search.rise(fits.back().loss, least) < profile.level && ends.high < upper;
        if (options.range || search.canceled() || !(open_below || open_above)) break;
        const double width = ends.high - ends.low;
        if (open_below) ends.low = std::max(lower, ends.low - width);
        if (open_above) ends.high = std::min(upper, ends.high + width);
    }
    profile.grid.resize(static_cast<Index>(fits.size()));
    profile.rise.resize(profile.grid.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        profile.grid[static_cast<Index>(i)] = fits[i].value;
        profile.rise[static_cast<Index>(i)] = search.rise(fits[i].loss, least);
    }
    if (const auto moved = model.moved(base)) profile.warnings.push_back(*moved);
    if (search.rise(base.loss, least) > 0.01)
        profile.warnings.push_back(
            Message("Another value of the parameter results in a better fit, so the estimate is only a local minimum "
                    "of the loss."));
    read_interval(profile, search, fits, least);
    profile.canceled = search.canceled();
    warn_of_color(profile, model, base);
    std::vector<Message> all = profile.warnings;
    all.insert(all.begin(), Message("Profile of {}: estimate {}, {} % confidence interval {}.", name, profile.estimate,
                                    significant(100 * options.confidence, 4), interval_text(profile)));
    profile.message = sentences(std::move(all));
    return profile;
}

}  // namespace dynlab::inline numerics
