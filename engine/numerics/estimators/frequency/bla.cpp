#include "numerics/estimators/frequency/bla.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/error.h"
#include "numerics/fit/spectral_estimate.h"
#include "numerics/signals/fourier.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kRepeatsRoughly = 0.02, kRepeatsNot = 0.25;  // of the input's power, that changes between periods
constexpr Index kEnoughValues = 10;                           // behind every variance
constexpr Index kMinSamples = 8;
constexpr double kSameInput = 0.999;  // correlation of two inputs, at the best shift in time

/// The Fourier coefficients of one realization at lines 1 .. L, a column for each period.
struct Periods {
    Eigen::MatrixXcd U, Y;
};

/// One realization's means over the periods, and the noise estimated from its periods: variances of one period.
struct Realization {
    ComplexVector U, Y;
    Vector input_noise, output_noise;
    ComplexVector cross_noise;
    double unsettled = 0, spread = 0;  // sums of squares: the first period against the others, and what noise explains
};

struct Cut {
    std::size_t experiment;
    Index first, periods;
};

/// Positions of the complete periods of every realization; `rest` is set to the number of samples left out of each.
std::vector<Cut> cuts_of(const IdData& data, const BlaOptions& options, Index& rest) {
    std::vector<Cut> cuts;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
        const Index N = data.sample_count(e), length = N / options.realizations;
        if (length * options.realizations != N)
            throw InvalidArgument("bla: the number of realizations, {}, must divide the number of samples, {}",
                                  options.realizations, N);
        const Index periods = length / options.period;
        if (periods < 1)
            throw InvalidArgument("bla: the period of {} samples is longer than a realization of {} samples",
                                  options.period, length);
        if (options.transient >= periods)
            throw InvalidArgument("bla: no data remain after {} of {} are omitted; omit fewer periods",
                                  options.transient, plural(periods, "{} period", "{} periods"));
        rest = length - periods * options.period;
        for (Index r = 0; r < options.realizations; ++r)
            cuts.push_back({e, r * length + rest + options.transient * options.period, periods - options.transient});
    }
    return cuts;
}

Periods transformed(const Experiment& experiment, const Cut& cut, Index period) {
    const Index lines = (period - 1) / 2;
    Periods all{Eigen::MatrixXcd(lines, cut.periods), Eigen::MatrixXcd(lines, cut.periods)};
    for (Index p = 0; p < cut.periods; ++p) {
        const Index first = cut.first + p * period;
        const TransformPair pair =
            fourier_transforms(experiment.u.col(0).segment(first, period), experiment.y.col(0).segment(first, period));
        all.U.col(p) = pair.first.segment(1, lines) / static_cast<double>(period);
        all.Y.col(p) = pair.second.segment(1, lines) / static_cast<double>(period);
    }
    return all;
}

/// How far the first period lies from the mean of the others, and how far noise would let it lie.
void look_for_transient(const Periods& periods, Realization& found) {
    const Index others = periods.Y.cols() - 1;
    if (others < 2) return;
    const ComplexVector mean = periods.Y.rightCols(others).rowwise().mean();
    const double share = 1 + 1 / static_cast<double>(others);
    found.unsettled = (periods.Y.col(0) - mean).squaredNorm();
    found.spread =
        share * (periods.Y.rightCols(others).colwise() - mean).squaredNorm() / static_cast<double>(others - 1);
}

Realization realization_of(const Periods& periods) {
    Realization found;
    found.U = periods.U.rowwise().mean(), found.Y = periods.Y.rowwise().mean();
    if (periods.U.cols() < 2) return found;
    const Eigen::MatrixXcd u = periods.U.colwise() - found.U, y = periods.Y.colwise() - found.Y;
    const auto degrees = static_cast<double>(periods.U.cols() - 1);
    found.input_noise = u.rowwise().squaredNorm() / degrees;
    found.output_noise = y.rowwise().squaredNorm() / degrees;
    found.cross_noise = y.cwiseProduct(u.conjugate()).rowwise().sum() / degrees;
    look_for_transient(periods, found);
    return found;
}

struct Lines {
    std::vector<Index> excited, odd, even;  // 0-based: line k has index k - 1
    bool some_differ = false;
};

Lines lines_of(const std::vector<Realization>& all, double least_input) {
    Lines lines;
    Vector least = all.front().U.cwiseAbs(), largest = least;
    for (const Realization& one : all) {
        least = least.cwiseMin(one.U.cwiseAbs());
        largest = largest.cwiseMax(one.U.cwiseAbs());
    }
    const double limit = least_input * largest.maxCoeff();
    for (Index i = 0; i < least.size(); ++i) {
        if (least[i] > limit)
            lines.excited.push_back(i);
        else if (largest[i] > limit)
            lines.some_differ = true;
        else
            (i % 2 == 0 ? lines.odd : lines.even).push_back(i);
    }
    return lines;
}

/// The largest correlation of two inputs over all shifts in time: a shifted input causes a shifted output, and adds no
/// information.
double shifted_correlation(const ComplexVector& a, const ComplexVector& b, Index period) {
    const ComplexVector cross = a.conjugate().cwiseProduct(b);
    Vector real = Vector::Zero(period), imaginary = Vector::Zero(period);
    real.segment(1, cross.size()) = cross.real();
    imaginary.segment(1, cross.size()) = cross.imag();
    const TransformPair turned = fourier_transforms(real, imaginary);
    return (turned.first.real() + turned.second.imag()).maxCoeff() / (a.norm() * b.norm());
}

Vector mean_over_neighbors(const Vector& values, Index reach) {
    Vector means(values.size());
    for (Index i = 0; i < values.size(); ++i) {
        const Index first = std::max<Index>(0, i - reach), last = std::min(values.size() - 1, i + reach);
        means[i] = values.segment(first, last - first + 1).mean();
    }
    return means;
}

class Approximation {
  public:
    Approximation(const IdData& data, const BlaOptions& options) : options_(options) {
        result_.Ts = data.Ts;
        result_.method = "bla";
        result_.inter_sample = options.inter_sample.value_or(inter_sample_of(data.hold));
        result_.input_name = data.input_names.front(), result_.output_name = data.output_names.front();
        result_.input_unit = data.input_units.front(), result_.output_unit = data.output_units.front();
        const std::vector<Cut> cuts = cuts_of(data, options, rest_);
        periods_ = cuts.front().periods;
        for (const Cut& cut : cuts) {
            if (options.cancel && options.cancel()) break;
            all_.push_back(realization_of(transformed(data.experiments[cut.experiment], cut, options.period)));
            periods_ = std::min(periods_, cut.periods);
        }
        if (all_.empty()) throw InvalidArgument("bla: stopped before the first realization was processed");
        check_repetition();
        check_independence();
        lines_ = lines_of(all_, options.least_input);
        count_ = static_cast<double>(all_.size());
    }

    FrequencyData result() {
        const Index K = static_cast<Index>(lines_.excited.size());
        Eigen::MatrixXcd G(K, static_cast<Index>(all_.size()));
        Vector noise = Vector::Zero(K);
        for (std::size_t m = 0; m < all_.size(); ++m) {
            const ComplexVector response = all_[m].Y(lines_.excited).cwiseQuotient(all_[m].U(lines_.excited));
            G.col(static_cast<Index>(m)) = response;
            if (periods_ > 1) noise += noise_of(all_[m], response) / count_;
        }
        result_.w = frequencies(lines_.excited);
        result_.response = G.rowwise().mean();
        set_variances(G, noise);
        result_.odd = without_input(lines_.odd), result_.even = without_input(lines_.even);
        describe();
        return result_;
    }

  private:
    Vector frequencies(const std::vector<Index>& lines) const {
        const double first = 2 * std::numbers::pi / (static_cast<double>(options_.period) * result_.Ts);
        Vector w(static_cast<Index>(lines.size()));
        for (std::size_t i = 0; i < lines.size(); ++i)
            w[static_cast<Index>(i)] = first * static_cast<double>(lines[i] + 1);
        return w;
    }

    /// Variance that noise gives the response of one realization.
    Vector noise_of(const Realization& one, const ComplexVector& G) const {
        const std::vector<Index>& k = lines_.excited;
        const Vector input = one.input_noise(k).cwiseProduct(G.cwiseAbs2());
        const Vector common = 2 * G.conjugate().cwiseProduct(one.cross_noise(k)).real();
        return (one.output_noise(k) + input - common).cwiseQuotient(one.U(k).cwiseAbs2()) /
               static_cast<double>(periods_);
    }

    void set_variances(const Eigen::MatrixXcd& G, const Vector& noise) {
        const bool several = all_.size() > 1, periods = periods_ > 1;
        result_.excited = levels(lines_.excited);
        if (!several && !periods) return;
        Vector spread = noise;
        if (several) result_.realized = G;
        if (several) spread = (G.colwise() - result_.response).rowwise().squaredNorm() / (count_ - 1);
        if (several && periods) {
            const Vector distortion = spread - noise;
            result_.excited.distortion = 2 * distortion.cwiseProduct(input_power(lines_.excited));
            result_.distortion = mean_over_neighbors(distortion, reach()).cwiseMax(0);
        }
        if (periods) result_.noise_variance = mean_over_neighbors(noise, reach()) / count_;
        const Vector rounding = (8 * std::numeric_limits<double>::epsilon() * result_.response.cwiseAbs()).cwiseAbs2();
        result_.variance = (mean_over_neighbors(spread, reach()) / count_)
                               .cwiseMax(rounding)
                               .cwiseMax(std::numeric_limits<double>::min());
    }

    /// Lines on either side that a variance is averaged over.
    Index reach() const {
        if (options_.smooth) return *options_.smooth;
        const Index values = std::max<Index>(1, all_.size() > 1 ? static_cast<Index>(all_.size()) - 1 : periods_ - 1);
        return (kEnoughValues + values - 1) / values / 2;
    }

    Vector input_power(const std::vector<Index>& lines) const {
        Vector power = Vector::Zero(static_cast<Index>(lines.size()));
        for (const Realization& one : all_) power += one.U(lines).cwiseAbs2() / count_;
        return power;
    }

    OutputLevels levels(const std::vector<Index>& lines) const {
        OutputLevels found;
        found.w = frequencies(lines);
        found.power = Vector::Zero(found.w.size());
        for (const Realization& one : all_) found.power += 2 * one.Y(lines).cwiseAbs2() / count_;
        if (periods_ < 2) return found;
        found.noise = Vector::Zero(found.w.size());
        for (const Realization& one : all_)
            found.noise += 2 * one.output_noise(lines) / (count_ * static_cast<double>(periods_));
        return found;
    }

    /// There all that is not noise is distortion.
    OutputLevels without_input(const std::vector<Index>& lines) const {
        OutputLevels found = levels(lines);
        if (periods_ > 1) found.distortion = found.power - found.noise;
        return found;
    }

    void check_repetition() {
        if (periods_ < 2) return;
        double changing = 0, all = 0;
        for (const Realization& one : all_) changing += one.input_noise.sum(), all += one.U.squaredNorm();
        const double part = changing / (changing + all);
        if (part > kRepeatsNot)
            throw InvalidArgument(
                "bla: the input is not periodic with a period of {} samples: {} % of its power varies from period to "
                "period. Specify the period of the input",
                options_.period, significant(100 * part, 3));
        if (part > kRepeatsRoughly)
            result_.warnings.push_back(
                Message("The input is only approximately periodic ({} % of its power varies from period to period). "
                        "The period is wrong or the input is noisy, and leakage may bias the response.",
                        significant(100 * part, 3)));
    }

    /// Each input is held against the first one and the one before it.
    void check_independence() const {
        for (std::size_t m = 1; m < all_.size(); ++m)
            for (const std::size_t other : {m - 1, std::size_t{0}})
                if (shifted_correlation(all_[other].U, all_[m].U, options_.period) > kSameInput)
                    throw InvalidArgument(
                        "bla: realizations {} and {} have the same input, but the estimate of the distortion requires "
                        "different inputs. Use different phases for each realization, as multisine does, or treat the "
                        "realizations as periods of one realization",
                        other + 1, m + 1);
    }

    void warn_of_transient() {
        constexpr double kMore = 1.5, kChance = 6, kSeen = 1e-12;
        double unsettled = 0, spread = 0, power = 0;
        for (const Realization& one : all_)
            unsettled += one.unsettled, spread += one.spread, power += one.Y.squaredNorm();
        const double chance = kChance / std::sqrt(count_ * static_cast<double>(all_.front().Y.size()));
        if (unsettled > kSeen * power && unsettled > (kMore + chance) * spread)
            result_.warnings.push_back(
                Message("The first period differs significantly from the other periods: the system was not yet in "
                        "steady state. Omit this period with {} = {}.",
                        OptionName{"transient"}, options_.transient + 1));
    }

    void warn_about_data() {
        if (rest_ > 0)
            result_.warnings.push_back(
                Message("The data do not contain a whole number of periods, so bla omits the first {}.",
                        plural(rest_, "{} sample", "{} samples")));
        if (lines_.some_differ)
            result_.warnings.push_back(
                Message("The realizations excite different lines; only the common lines are used."));
        if (periods_ < 2)
            result_.warnings.push_back(
                Message("With only one period, noise and nonlinear distortion cannot be separated, and steady state "
                        "cannot be verified."));
        if (all_.size() < 2)
            result_.warnings.push_back(
                Message("With only one realization, nonlinear distortion at the excited lines cannot be detected: the "
                        "variance includes only noise."));
    }

    void describe() {
        warn_of_transient();
        warn_about_data();
        std::vector<Message> all = {Message("Best linear approximation at {} from {} of {}.",
                                            plural(result_.w.size(), "{} frequency", "{} frequencies"),
                                            plural(std::ssize(all_), "{} realization", "{} realizations"),
                                            plural(periods_, "{} period", "{} periods"))};
        const LevelSums sums = level_sums(result_);
        const auto decibels = [&](double part) {
            return significant(10 * std::log10(std::max(part, 0.0) / sums.power), 3);
        };
        if (std::isfinite(sums.noise))
            all.push_back(Message("The noise level is {} dB relative to the output, averaged over {}.",
                                  decibels(sums.noise), plural(periods_, "{} period", "{} periods")));
        if (std::isfinite(sums.distortion))
            all.push_back(Message("The level of the nonlinear distortion is {} dB relative to the output.",
                                  decibels(sums.distortion)));
        result_.message = sentences(std::move(all));
    }

    const BlaOptions& options_;
    FrequencyData result_;
    std::vector<Realization> all_;
    Lines lines_;
    Index rest_ = 0, periods_ = 0;
    double count_ = 1;
};

}  // namespace

void BlaOptions::validate() const {
    if (period < kMinSamples)
        throw InvalidArgument("bla: the period must be at least {} samples, but is {}", kMinSamples, period);
    if (realizations < 1)
        throw InvalidArgument("bla: the number of realizations must be at least 1, but is {}", realizations);
    if (transient < 0)
        throw InvalidArgument("bla: the number of omitted periods must be nonnegative, but is {}", transient);
    if (!(least_input > 0 && least_input < 1))
        throw InvalidArgument(
            "bla: the threshold for the amplitude of the input must be between 0 and 1 (both excluded), but is {}",
            least_input);
    if (smooth && *smooth < 0)
        throw InvalidArgument(
            "bla: the number of frequencies on each side over which variances are averaged must be nonnegative, but is "
            "{}",
            *smooth);
}

FrequencyData bla(const IdData& data, const BlaOptions& options) {
    options.validate();
    return Approximation(nonparametric_data("bla", data, kMinSamples, false), options).result();
}

LevelSums level_sums(const FrequencyData& data) {
    LevelSums sums;
    for (const OutputLevels* levels : {&data.excited, &data.odd, &data.even}) {
        if (levels->w.size() == 0) continue;
        sums.power += levels->power.sum();
        sums.noise += levels->noise.size() > 0 ? levels->noise.sum() : kNaN;
        sums.distortion += levels->distortion.size() > 0 ? levels->distortion.sum() : kNaN;
    }
    return sums;
}

}  // namespace dynlab::inline numerics
