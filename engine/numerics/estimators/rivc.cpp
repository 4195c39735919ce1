#include "numerics/estimators/rivc.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/prediction_error_products.h"
#include "numerics/error.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/delay_scan.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/long_regression.h"
#include "numerics/fit/discrete/prediction_fit.h"
#include "numerics/fit/finished_fit.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/start_choice.h"
#include "numerics/fit/transfer_refinement.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNoiseRounding = 1e-10;  // of the output's variation: a smaller simulation error holds no noise

void check(const IdData& data, const NoiseOrders& orders, const TransferStructure& structure) {
    orders.validate();
    if (!data.regular())
        throw InvalidArgument(
            "rivc: the noise model is discrete-time, so the data must be sampled regularly: interpolate them "
            "(interp1), or use srivc, which accepts any sampling");
    if (structure.outputs != 1 || data.output_count() != 1)
        throw InvalidArgument(
            "rivc: exactly one output is required, because each output has a separate noise model, but the data have "
            "{}: select one output at a time",
            data.output_count());
    const Index requested = 3 * (structure.parameter_count() + orders.nc + orders.nd);
    if (data.sample_count() < requested)
        throw InvalidArgument("rivc: at least {} samples are needed for the model and its noise, but the data have {}",
                              requested, data.sample_count());
}

/// The simulated output of all experiments and its sensitivities, filtered by D/C.
class WhitenedOutput : public OutputErrorModel {
  public:
    WhitenedOutput(const TransferOutput& output, const ArmaNoise& noise, const Vector& y)
        : output_(output), noise_(noise), y_(y) {
        lower_ = output.lower(), upper_ = output.upper();
    }

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        output_.simulate(theta, output, sensitivities);
        output = filtered(output);
        if (sensitivities != nullptr) *sensitivities = filtered(*sensitivities);
    }
    OutputErrorProducts products(const Vector& theta, const VectorView&) const override {
        const Index d = theta.size();
        OutputErrorProducts sums{0, Matrix::Zero(d, d), Vector::Zero(d)};
        Vector errors;
        Matrix sensitivities;
        output_.simulate(theta, errors, &sensitivities);
        errors = y_ - errors;
        std::vector<LateColumn> columns;
        std::vector<Index> places;
        for (Index i = 0; i < d; ++i) {
            columns.push_back({sensitivities.col(i), 0, 1, 0});
            places.push_back(i);
        }
        places.push_back(-1);
        for (std::size_t e = 0; e < output_.experiment_count(); ++e) {
            const Matrix all = prediction_error_products(columns, {errors, 0, 1, 0}, first_counted(e),
                                                         output_.counted_rows(e), noise_.C, noise_.D);
            const auto count = static_cast<Index>(places.size());
            add_to(sums, all.topLeftCorner(count, count), places);
        }
        return sums;
    }
    Vector target() const { return filtered(y_); }
    Matrix filtered(const MatrixView& rows) const {
        Matrix result = Matrix::Zero(rows.rows(), rows.cols());
        for (std::size_t e = 0; e < output_.experiment_count(); ++e)
            result.middleRows(first_counted(e), output_.counted_rows(e)) =
                whitened(noise_, rows.middleRows(first_counted(e), output_.counted_rows(e)));
        return result;
    }

  private:
    /// Noise begins with the first sample that counts.
    Index first_counted(std::size_t e) const { return output_.row(e, 0) + output_.rows(e) - output_.counted_rows(e); }

    const TransferOutput& output_;
    const ArmaNoise& noise_;
    const Vector& y_;
};

double largest_change(const Vector& next, const Vector& before, const Vector& errors) {
    double change = 0;
    for (Index i = 0; i < next.size(); ++i)
        if (next[i] != before[i])
            change = std::max(change, std::abs(next[i] - before[i]) / std::max(std::abs(next[i]), errors[i]));
    return change;
}

/// The passes between the noise model and the instrumental equations.
class Passes {
  public:
    /// From where `start` ended, which stays stable if it is.
    Passes(TransferOutput model, const Fit& start, const NoiseOrders& orders, const FitOptions& options)
        : model_(std::move(model)), y_(model_.target()), orders_(orders), options_(options) {
        if (std::none_of(start.models.begin(), start.models.end(), has_unstable_pole)) model_.keep_stable();
        model_.fix(options.fixed);
        theta_ = search_point(start, model_, model_.seconds()).cwiseMax(model_.lower()).cwiseMin(model_.upper());
    }

    /// Sets the initial values and offsets that match the other parameters, instead of those of the start.
    void set_linear_part() { solve_linear_part(model_, theta_); }

    void run() {
        noise_ = ArmaNoise::white(orders_.nc, orders_.nd);
        for (int pass = 0; pass < std::max(1, options_.max_iterations); ++pass) {
            if (pass > 0 && options_.cancel && options_.cancel()) {
                termination_ = Termination::kCanceled;
                break;
            }
            const double change = one_pass(pass > 0);
            const Vector errors = y_ - simulated();
            trace_.push_back({theta_, errors.squaredNorm() / static_cast<double>(model_.sample_count()), change});
            if (change <= options_.tolerance) {
                termination_ = Termination::kConverged;
                break;
            }
        }
        set_matrix();
    }

    Vector simulated() const { return model_.output_at(theta_); }
    double variance() const { return variance_; }  ///< of e
    bool canceled() const { return termination_ == Termination::kCanceled; }
    /// Nothing but rounding is left, so that there is no noise to model.
    bool exact(const Vector& errors) const {
        return errors.norm() <= kNoiseRounding * (y_.array() - y_.mean()).matrix().norm();
    }

    /// The result in seconds, with the passes as its trace.
    Fit fit(const StartCondition& condition) const {
        const Vector errors = y_ - simulated();
        Fit result = solution_;
        result.loss = errors.squaredNorm() / static_cast<double>(model_.sample_count());
        result.noise_variance = Vector::Constant(1, variance_);
        result.termination = termination_;
        result.trace = trace_;
        keep_parameters(result, model_, condition, model_.seconds());
        return result;
    }

    ArmaNoise noise_;
    bool without_noise_ = false;

  private:
    std::vector<Vector> residuals_by_experiment() const {
        const Vector errors = y_ - simulated();
        std::vector<Vector> data_sets;
        for (std::size_t e = 0; e < model_.experiment_count(); ++e)
            data_sets.push_back(errors.segment(model_.row(e, 0), model_.rows(e)).tail(model_.counted_rows(e)));
        return data_sets;
    }

    /// Largest relative change of theta and the noise model.
    double one_pass(bool noise_known) {
        const ArmaNoise before = noise_;
        const double tolerance = std::min(options_.tolerance, 1e-6);
        without_noise_ = exact(y_ - simulated());
        noise_ = without_noise_ ? ArmaNoise::white(orders_.nc, orders_.nd)
                                : estimate_arma(residuals_by_experiment(), orders_.nc, orders_.nd, tolerance,
                                                noise_known ? &before : nullptr);
        const WhitenedOutput whitened_output(model_, noise_, y_);
        solution_ = minimize_output_error(whitened_output, whitened_output.target(), theta_,
                                          options_.limited(options_.max_iterations, tolerance));
        const Vector last = theta_;
        theta_ = solution_.theta;
        const Vector ones = Vector::Constant(std::max(noise_.C.size(), noise_.D.size()), 1);
        return std::max({largest_change(theta_, last, solution_.covariance.diagonal().cwiseMax(0).cwiseSqrt()),
                         largest_change(noise_.C, before.C, ones), largest_change(noise_.D, before.D, ones)});
    }

    /// Error variance over the samples that the conditional sum of squares uses, and the covariance that follows.
    void set_matrix() {
        const WhitenedOutput whitened_output(model_, noise_, y_);
        const double squares = whitened_output.filtered(y_ - simulated()).squaredNorm();
        const double used =
            static_cast<double>(model_.sample_count() - orders_.nd * static_cast<Index>(model_.experiment_count()));
        variance_ = squares / (used - static_cast<double>(theta_.size() + orders_.nc + orders_.nd));
        if (solution_.noise_variance[0] > 0) solution_.covariance *= variance_ / solution_.noise_variance[0];
    }

    TransferOutput model_;
    Vector y_;
    NoiseOrders orders_;
    FitOptions options_;
    Vector theta_;
    Fit solution_;
    double variance_ = kInfinity;
    Termination termination_ = Termination::kIterationLimit;
    std::vector<FitIteration> trace_;
};

void fill_noise(Fit& result, const Passes& passes, const NoiseOrders& orders, const IdData& data) {
    result.noise_covariance = passes.noise_.covariance;
    const Vector std = result.noise_covariance.diagonal().cwiseMax(0).cwiseSqrt();
    NoiseModel& noise = result.noise.emplace(NoiseModel{passes.noise_.C, passes.noise_.D, Vector::Zero(orders.nc + 1),
                                                        Vector::Zero(orders.nd + 1), data.Ts});
    noise.C_std.tail(orders.nc) = std.head(orders.nc);
    noise.D_std.tail(orders.nd) = std.tail(orders.nd);
    const bool asked = orders.nc + orders.nd > 0;
    if (asked && passes.without_noise_)
        result.warnings.push_back(
            Message("The residuals contain only rounding errors, so the noise cannot be modeled."));
    for (const char letter : {'C', 'D'})
        if (const auto root = undetermined_root(letter, letter == 'C' ? noise.C : noise.D, data.sample_count())) {
            Vector& errors = letter == 'C' ? noise.C_std : noise.D_std;
            errors.tail(errors.size() - 1).setConstant(kInfinity);
            result.warnings.push_back(root->warning);
        }
}

/// Samples that an input may be late.
Index max_delay_samples(const TransferStructure& structure, const DelayRange& range, double Ts) {
    double max_delay = structure.free_delays ? range.largest : 0;
    for (const TransferChannel& channel : structure.channels) max_delay = std::max(max_delay, channel.delay);
    return static_cast<Index>(std::ceil(max_delay / Ts));
}

/// The passes, or better ones where a long regression predicts better than they do: from models of filtered data, whose
/// simulation error a drift does not dominate.
Passes best_passes(const IdData& data, const TransferOutput& model, const Fit& start, const DelayRange& range,
                   const NoiseOrders& orders, const FitOptions& options) {
    Passes best(model, start, orders, options);
    best.run();
    if (orders.nd == 0 || best.without_noise_ || best.canceled()) return best;
    const LongRegression regression(data, max_delay_samples(start.structure, range, data.Ts));
    if (!regression.predicts_better_than(best.variance())) return best;
    const FitOptions plain = options.started({start.start.state, false});
    for (const IdData& filtered : regression.filtered_data(start.start.state == InitialState::kZero)) {
        Fit other;
        try {
            other = srivc(filtered, start.structure, plain);
        } catch (const InvalidArgument&) {
            continue;  // too little happens in the filtered inputs
        }
        other.initial_values.clear();
        other.offsets.setZero();
        Passes passes(model, other, orders, options);
        passes.set_linear_part();
        passes.run();
        if (passes.canceled()) break;
        if (passes.variance() < best.variance()) best = std::move(passes);
        if (!regression.predicts_better_than(best.variance())) break;
    }
    return best;
}

Fit rivc_fit(const IdData& data, const TransferStructure& structure, const NoiseOrders& orders,
             const FitOptions& options) {
    check_transfer_data("rivc", data, structure, options.offset);
    const Fit start = srivc(data, structure, options);
    FitOptions requested = options;
    if (structure.free_delays && !requested.largest_delay)
        requested.largest_delay = start.delay_grid[start.delay_grid.size() - 1];
    const DelayRange range = structure.free_delays ? delay_range(data, requested) : DelayRange{};
    const CenteredData centered = centered_for(data, options.offset);
    TransferOutput model(structure, start.start, centered.data, range.least, range.largest);
    model.mask_start(masked_start(start, centered.data));
    const Passes passes = best_passes(centered.data, model, start, range, orders, requested);
    Fit result = passes.fit(start.start);
    result.structure = structure;
    result.fit_percent = Vector::Constant(
        1, fit_percent_of_sums(result.loss * static_cast<double>(model.sample_count()), counted_variations(model)[0]));
    if (options.offset == Offset::kRemove) add_operating_points(result, centered.removed);
    result.delay_grid = start.delay_grid;
    result.delay_loss = start.delay_loss;
    fill_noise(result, passes, orders, data);
    describe_search(result, data, requested, range);
    warn_of_later_responses(result, data, requested);
    result.message = has_settled(result)
                         ? Message("RIVC converged after {} for a simulation {}: {}.", iteration_count(result),
                                   description(result.start), simulation_text(result))
                         : Message("RIVC stopped after {} for a simulation {}: {}.", iteration_count(result),
                                   description(result.start), simulation_text(result));
    return result;
}

}  // namespace

void NoiseOrders::validate() const {
    if (nc < 0 || nd < 0)
        throw InvalidArgument("nc and nd, the orders of the noise model, must be nonnegative, but are {} and {}", nc,
                              nd);
}

Fit rivc(const IdData& data, const TransferStructure& structure, const NoiseOrders& orders, const FitOptions& options) {
    options.validate();
    check(data, orders, structure);
    return finished_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        const auto fit_with = [&](const FitOptions& how) { return rivc_fit(seen, structure, orders, how); };
        return best_predicting_start(fit_with(requested), requested, fit_with);
    });
}

}  // namespace dynlab::inline numerics
