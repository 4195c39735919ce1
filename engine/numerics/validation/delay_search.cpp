#include "numerics/validation/delay_search.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "numerics/error.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/operating_points.h"
#include "numerics/fit/structure_advice.h"
#include "numerics/validation/delay_profile.h"

namespace dynlab::inline numerics {
namespace {

constexpr double kChance = 6.635;  // 99 % quantile of chi-square with one degree of freedom
constexpr double kFarSteps = 2, kFarErrors = 3;
constexpr Index kProfiledSamples = 50'000;  // of longer data, their beginning

void check_options(const IdData& data, const DelaySearchOptions& options) {
    const FitOptions& estimation = options.estimation;
    if (estimation.largest_delay && !(*estimation.largest_delay > estimation.least_delay))
        throw InvalidArgument("{} must be greater than {} ({} {}), but {} {} was given: the range contains no delay",
                              OptionName{"largest_delay"}, OptionName{"least_delay"}, estimation.least_delay,
                              data.time_unit, *estimation.largest_delay, data.time_unit);
}

/// The loss of a model that does not answer at all, which is there at every delay.
double loss_without_model(const IdData& data) {
    double squares = 0;
    for (const Experiment& experiment : data.experiments) squares += experiment.y.squaredNorm();
    return squares / static_cast<double>(data.sample_count());
}

/// Of the structure that was taken, under the start condition that its model has.
Vector profile_of(const DelaySearch& search, const IdData& data, const DelaySearchOptions& options) {
    const Fit& estimate = search.candidate.estimate;
    const IdData beginning = beginning_of(data, kProfiledSamples);
    const bool remove = options.estimation.offset == Offset::kRemove;
    std::mutex callbacks;
    FitOptions estimation = options.estimation;
    estimation.cancel = [&] {
        const std::scoped_lock lock(callbacks);
        return options.cancel && options.cancel();
    };
    return delay_profile(remove ? without_operating_points(beginning).data : beginning, estimate.structure,
                         estimate.start, search.grid(), estimation, options.threads);
}

bool is_valley(const Vector& losses, Index i) {
    const bool left = i == 0 || losses[i] <= losses[i - 1];
    return left && (i + 1 == losses.size() || losses[i] < losses[i + 1]);
}

/// The lowest valley of the curve away from the estimate that chance could have made the second one.
std::optional<double> rival_of(const DelaySearch& search, Index samples) {
    const Vector &delays = search.grid(), &losses = search.losses();
    if (delays.size() < 2) return std::nullopt;
    const double step = delays[1] - delays[0], smallest = losses.minCoeff();
    const double far = std::max(kFarSteps * step, kFarErrors * search.std);
    const double limit = smallest * std::exp(kChance / static_cast<double>(samples));
    std::optional<Index> rival;
    for (Index i = 0; i < losses.size(); ++i) {
        if (!is_valley(losses, i) || losses[i] > limit || std::abs(delays[i] - search.delay) <= far) continue;
        if (!rival || losses[i] < losses[*rival]) rival = i;
    }
    if (!rival) return std::nullopt;
    return delays[*rival];
}

/// The structure in words, without its delay.
Message orders_of(const OrderCandidate& candidate) {
    OrderCandidate bare;
    bare.poles = candidate.poles;
    bare.zeros = candidate.zeros;
    return structure_text(bare);
}

/// The value down to the second digit of its error, with five digits at most.
Number known_to(double value, double error) {
    constexpr int kMaxDigits = 5;
    if (!(error > 0 && std::isfinite(error) && value != 0)) return significant(value, kMaxDigits);
    const double digits = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(error)) + 2;
    return significant(value, static_cast<int>(std::clamp(digits, 1.0, static_cast<double>(kMaxDigits))));
}

Message result_of(const DelaySearch& search, const IdData& data) {
    const Number delay = known_to(search.delay, search.std), std = significant(search.std, 2);
    const Number fit = significant(search.candidate.fit_percent, 4);
    const Message orders = orders_of(search.candidate);
    const std::string& unit = data.time_unit;
    if (!data.regular())
        return std::isfinite(search.std)
                   ? Message(
                         "The delay is {} {}, with a standard error of {} {}, in a model with {} and a fit of {} %.",
                         delay, unit, std, unit, orders, fit)
                   : Message("The delay is {} {} in a model with {} and a fit of {} %.", delay, unit, orders, fit);
    const Number samples = known_to(search.delay / data.Ts, search.std / data.Ts);
    return std::isfinite(search.std)
               ? Message(
                     "The delay is {} {} ({} samples), with a standard error of {} {}, in a model "
                     "with {} and a fit of {} %.",
                     delay, unit, samples, std, unit, orders, fit)
               : Message("The delay is {} {} ({} samples) in a model with {} and a fit of {} %.", delay, unit, samples,
                         orders, fit);
}

Message explanation_of(const DelaySearch& search, const IdData& data, bool reported) {
    std::vector<Message> all{result_of(search, data)};
    if (search.delay <= 2 * search.std) all.push_back(Message("The delay does not differ significantly from zero."));
    if (reported && search.delay < data.Ts && late_input(data, search.candidate.poles, search.loss()))
        all.push_back(late_input_sentence(data));
    const Vector& errors = search.candidate.estimate.std;
    if (search.rival && !std::isinf(errors[errors.size() - 1]))  // else a warning of the estimate says so
        all.push_back(
            Message("A delay of {} {} explains the data nearly as well. Inspect the loss as a function of the delay, "
                    "and use your knowledge of the plant.",
                    *search.rival, data.time_unit));
    for (const Message& warning : search.candidate.estimate.warnings) all.push_back(warning);
    return sentences(std::move(all));
}

}  // namespace

Message late_input_sentence(const IdData& data) {
    return Message(
        "{} responds about one sample before {} changes: the input was logged late. Shift the input with "
        "data:shift(-1).",
        data.output_names.front(), data.input_names.front());
}

DelaySearch search_delay(const IdData& data, const DelaySearchOptions& options) {
    check_options(data, options);
    OrderSelectionOptions selecting;
    selecting.threads = options.threads;
    selecting.progress = options.progress;
    selecting.cancel = options.cancel;
    selecting.estimation = options.estimation;
    const OrderSelection selection =
        select_order(data, order_grid(options.poles, options.zeros, {options.estimation.least_delay}, true), selecting);
    DelaySearch search;
    search.canceled = selection.canceled;
    if (search.canceled) return search;
    search.candidate = selection.candidates[choose_order(selection).place];
    Vector& losses = search.candidate.estimate.delay_loss;
    if (options.profile) losses = profile_of(search, data, options);
    search.canceled = options.cancel && options.cancel();
    if (search.canceled) return search;
    losses = losses.cwiseMin(loss_without_model(data));
    search.delay = search.candidate.delay;
    const Fit& estimate = search.candidate.estimate;
    search.std = estimate.std[estimate.std.size() - 1];
    if (const Index last = estimate.covariance.rows(); std::isinf(search.std) && last > 0)  // in its own valley
        search.std = std::sqrt(estimate.covariance(last - 1, last - 1));
    search.rival = rival_of(search, data.sample_count());
    search.explanation = explanation_of(search, data, options.profile);
    return search;
}

}  // namespace dynlab::inline numerics
