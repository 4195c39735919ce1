#include "numerics/fit/missed_options.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "numerics/criteria/discrete_output.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kLookedAt = 3000, kFitted = 100'000;  // samples
constexpr double kStrongEvidence = 10;                // BIC
constexpr double kHalfPoint = 0.5, kFairShare = 0.2, kLeastPoints = 0.05;
constexpr double kLostFit = 20;     // per cent, of a difference equation
constexpr double kRidge = 1e-9;     // of a sum of squares of sensitivities
constexpr double kFastestPole = 2;  // per sample: faster ones are as good as none
constexpr double kLargestCorrelation = 0.999;
constexpr double kLeastSquares = 1e-300;  // keeps logarithms finite without errors

/// How well a model explains one output.
struct Explanation {
    double squares = 0, variation = 0;  ///< of the errors; of the output about its means
    double samples = 0;                 ///< that count
    Index values = 0;                   ///< estimated

    double fit() const { return fit_percent_of_sums(squares, variation); }
};

bool is_worth_telling(double fit, double better) {
    const double gain = better - fit;
    return gain >= kHalfPoint || gain >= std::max(kLeastPoints, kFairShare * (100 - fit));
}

/// Whether the second is better by more than chance, and by enough.
bool gains(const Explanation& one, const Explanation& other) {
    const double N = std::max(other.samples, 2.0);
    const double evidence =
        N * std::log(one.squares / other.squares) - static_cast<double>(other.values - one.values) * std::log(N);
    return evidence > kStrongEvidence && is_worth_telling(one.fit(), other.fit());
}

/// The structure with so many more poles, and the zeros that `zeros_of` gives for the poles and zeros it has.
template <class Zeros>
TransferStructure changed(TransferStructure structure, int more_poles, const Zeros& zeros_of) {
    for (TransferChannel& channel : structure.channels)
        channel.zeros = zeros_of(structure.poles[static_cast<std::size_t>(channel.denominator)], channel.zeros);
    for (int& poles : structure.poles) poles += more_poles;
    return structure;
}

TransferStructure with_direct_terms(const TransferStructure& structure) {
    return changed(structure, 0, [](int poles, int) { return poles; });
}

/// theta of the structure with as many zeros as poles: the further coefficients are zero.
Vector with_direct_terms(const TransferStructure& structure, const TransferStructure& direct, const Vector& theta) {
    Vector all = Vector::Zero(direct.parameter_count());
    for (Index input = 0; input < structure.inputs; ++input) {
        const TransferChannel& channel = structure.channel(0, input);
        const Index n = structure.poles[static_cast<std::size_t>(channel.denominator)], own = channel.zeros + 1;
        all.segment(direct.denominator_start(channel.denominator), n) =
            theta.segment(structure.denominator_start(channel.denominator), n);
        all.segment(direct.numerator_start(0, input) + n + 1 - own, own) =
            theta.segment(structure.numerator_start(0, input), own);
        if (structure.free_delays) all[direct.delay_index(0, input)] = theta[structure.delay_index(0, input)];
    }
    return all;
}

/// What one Gauss-Newton step from a fit of one output by the defaults gains with further values.
class LookAhead {
  public:
    LookAhead(const IdData& data, const TransferStructure& structure, const Vector& theta) {
        const IdData part = data.sample_count() > kLookedAt ? beginning_of(data, kLookedAt) : IdData();
        const IdData& record = data.sample_count() > kLookedAt ? part : data;
        samples_ = static_cast<double>(data.sample_count());
        whole_ = samples_ / static_cast<double>(record.sample_count());
        variation_ = output_variations(record)[0];
        const TransferStructure direct = with_direct_terms(structure);
        // Nothing rests at the first input here, so that the free motions are added to a start from rest.
        const TransferOutput model(direct, {InitialState::kEstimate, true}, record, 0, shortest_record(record),
                                   TransferOutput::AtRest::kNothing);
        Vector point = Vector::Zero(model.parameter_count());
        point.head(direct.parameter_count()) =
            with_direct_terms(structure, direct, theta).cwiseQuotient(model.seconds().head(direct.parameter_count()));
        sums_ = model.products(point, model.target());
        scale_ = sums_.gram.diagonal().cwiseSqrt();
        set_places(structure, direct, point);
        for (Index i = model.initial_start(0, 0); i < model.offset_index(0, 0); ++i) motions_.push_back(i);
        for (Index i = model.offset_index(0, 0); i < model.parameter_count(); ++i) constants_.push_back(i);
    }

    /// Whether the sums have a meaning.
    bool usable() const { return sums_.gram.allFinite() && std::isfinite(sums_.squares); }

    bool constant_promises() const { return gains(left({}, false), left({&constants_}, false)); }
    bool start_promises() const { return gains(left({}, false), left({&motions_}, true)); }
    bool both_promise() const {
        const Explanation constant = left({&constants_}, false);
        Explanation both = left({&constants_, &motions_}, false);
        both.squares = constant.squares - (constant.squares - both.squares) / whole_;
        return gains(left({}, false), both);
    }
    bool feedthrough_promises() const {
        return !direct_.empty() && gains(left({&zeros_}, false), left({&zeros_, &direct_}, false));
    }

  private:
    using Places = std::vector<Index>;

    void set_places(const TransferStructure& structure, const TransferStructure& direct, const Vector& point) {
        const auto add = [](Places& places, Index first, Index count) {
            for (Index i = first; i < first + count; ++i) places.push_back(i);
        };
        for (std::size_t d = 0; d < direct.poles.size(); ++d)
            add(own_, direct.denominator_start(static_cast<Index>(d)), direct.poles[d]);
        for (Index input = 0; input < direct.inputs; ++input) {
            const Index place = direct.numerator_start(0, input), n = direct.channel(0, input).zeros;
            const Index m = structure.channel(0, input).zeros;
            if (m < n) direct_.push_back(place);
            add(zeros_, place + 1, std::max<Index>(0, n - m - 1));
            add(own_, place + n - m, m + 1);
            const Index delay = direct.delay_index(0, input);
            if (direct.free_delays && point[delay] > 0) own_.push_back(delay);
        }
    }

    /// Of the whole record, when the parameters and these values make their step; what is gained at `the_beginning`
    /// only is gained once.
    Explanation left(const std::vector<const Places*>& more, bool the_beginning) const {
        const double own = gained(own_);
        Places all = own_;
        for (const Places* places : more) all.insert(all.end(), places->begin(), places->end());
        const double further = gained(all) - own;
        const double squares = whole_ * (sums_.squares - own) - (the_beginning ? 1 : whole_) * further;
        return {std::max(squares, kLeastSquares), whole_ * variation_, samples_, static_cast<Index>(all.size())};
    }

    /// g' (J'J)^-1 g of these columns.
    double gained(const Places& places) const {
        Vector scale = scale_(places);
        for (double& value : scale)
            if (!(value > 0)) value = 1;
        const auto scaling = scale.cwiseInverse().asDiagonal();
        Matrix gram = scaling * sums_.gram(places, places) * scaling;
        gram.diagonal().array() += kRidge;
        const Vector descent = scaling * sums_.descent(places);
        return std::max(0.0, descent.dot(solve_semidefinite(gram, descent)));
    }

    OutputErrorProducts sums_;
    Vector scale_;
    double samples_ = 0, whole_ = 1, variation_ = 0;
    Places own_, zeros_, direct_, motions_, constants_;
};

/// A way to fit one output anew.
struct Remedy {
    TransferStructure structure;
    StartCondition condition;
    bool feedthrough = false;
};

double correlation_of_neighbours(const Vector& errors, const TransferOutput& model) {
    double products = 0, squares = 0;
    for (std::size_t e = 0; e < model.experiment_count(); ++e) {
        const auto own = errors.segment(model.row(e, 0), model.rows(e));
        products += own.head(own.size() - 1).dot(own.tail(own.size() - 1));
        squares += own.squaredNorm();
    }
    return squares > 0 ? std::clamp(products / squares, 0.0, kLargestCorrelation) : 0;
}

Explanation explanation_of(const IdData& record, const Fit& fit) {
    const TransferOutput model(fit.structure, fit.start, record, 0, shortest_record(record));
    const Vector errors = model.target() - model.output_at(search_point(fit, model, model.seconds()));
    const bool finite = errors.allFinite();
    const double r = finite ? correlation_of_neighbours(errors, model) : 0;
    return {finite ? std::max(errors.squaredNorm(), kLeastSquares) : kInfinity, output_variations(record)[0],
            static_cast<double>(record.sample_count()) * (1 - r) / (1 + r), model.parameter_count()};
}

/// The search that a user's options lead to; nothing where the data do not allow it.
std::optional<Fit> fit_of(const IdData& record, const Remedy& remedy, FitOptions options) {
    options.goes_on = false;  // what settles that late is told apart from the present fit by chance alone
    options.initial_state = remedy.condition.state;
    options.offset = remedy.condition.offset ? Offset::kEstimate : Offset::kNone;
    try {
        Fit fit = search_transfer("missed_option", record, remedy.structure, options);
        if (fit.termination != Termination::kCancelled) return fit;
    } catch (const InvalidArgument&) {
        return std::nullopt;
    }
    return std::nullopt;
}

/// Whether a direct term does what neither more zeros nor one more pole does. A pole that is too fast to be seen is
/// one.
bool is_direct(const IdData& record, const TransferStructure& structure, const Explanation& direct,
               const FitOptions& options) {
    const StartCondition rest{InitialState::kZero, false};
    const auto zeros =
        fit_of(record, {changed(structure, 0, [](int n, int m) { return std::max(m, n - 1); }), rest}, options);
    if (zeros && !gains(explanation_of(record, *zeros), direct)) return false;
    const auto pole = fit_of(record, {changed(structure, 1, [](int, int m) { return m + 1; }), rest}, options);
    if (!pole || is_worth_telling(explanation_of(record, *pole).fit(), direct.fit())) return true;
    double fastest = 0;
    for (const TransferFunction& G : pole->models) fastest = std::max(fastest, G.poles().cwiseAbs().maxCoeff());
    return fastest * record.mean_step() > kFastestPole;
}

/// A setting, as a script writes it.
Message option_text(const MissedOption& missed) {
    if (missed.feedthrough) return Message("as many zeros as poles");
    const OptionName initial_state{"initial_state"}, offset{"offset"};
    const bool steady = missed.start.state == InitialState::kSteady;
    if (missed.start.state == InitialState::kZero) return Message("{} = \"estimate\"", offset);
    if (!missed.start.offset)
        return steady ? Message("{} = \"steady\"", initial_state) : Message("{} = \"estimate\"", initial_state);
    return steady ? Message("{} = \"steady\" and {} = \"estimate\"", initial_state, offset)
                  : Message("{} = \"estimate\" and {} = \"estimate\"", initial_state, offset);
}

Message reason_text(const MissedOption& missed) {
    if (missed.feedthrough) return Message("the output follows the input at once (a direct feedthrough)");
    const bool steady = missed.start.state == InitialState::kSteady;
    if (missed.start.state == InitialState::kZero)
        return Message("the output stands on a constant that no input explains");
    if (!missed.start.offset)
        return steady ? Message("the record begins at rest at the first value of the input, not at zero")
                      : Message("the record begins in the middle of a movement");
    return steady ? Message(
                        "the record begins at rest at the first value of the input, not at zero, and the output "
                        "stands on a constant that no input explains")
                  : Message(
                        "the record begins in the middle of a movement, and the output stands on a constant that "
                        "no input explains");
}

std::vector<Remedy> promised_remedies(const IdData& data, const IdData& record, const TransferStructure& structure,
                                      const Vector& theta, double fit_percent, bool may_be_direct) {
    const LookAhead ahead(data, structure, theta);
    const bool lost = !ahead.usable() || !(fit_percent > 0);  // too far away to look ahead from
    const bool constant = lost || ahead.constant_promises(), start = lost || ahead.start_promises();
    const bool both = lost || ahead.both_promise();
    std::vector<Remedy> remedies;
    if (may_be_direct && ahead.usable() && ahead.feedthrough_promises())
        remedies.push_back({with_direct_terms(structure), {InitialState::kZero, false}, true});
    if (!constant && !start && !both) return remedies;
    for (const StartCondition& condition : start_conditions(record, InitialState::kAuto, Offset::kAuto)) {
        const bool rests = condition.state == InitialState::kZero;
        const bool promised = rests ? constant : condition.offset ? both : start || both;
        if (promised && !(rests && !condition.offset)) remedies.push_back({structure, condition, false});
    }
    const auto experiments = static_cast<Index>(record.experiments.size());
    std::stable_sort(remedies.begin(), remedies.end(), [&](const Remedy& a, const Remedy& b) {
        return value_count(a.structure, a.condition, experiments) < value_count(b.structure, b.condition, experiments);
    });
    return remedies;
}

/// For one output.
std::optional<MissedOption> missed_by_output(const IdData& data, const Fit& given, const FitOptions& options) {
    const bool shorter = data.sample_count() > kFitted;
    const IdData beginning = shorter ? beginning_of(data, kFitted) : IdData();
    const IdData& record = shorter ? beginning : data;
    const std::vector<Remedy> remedies =
        promised_remedies(data, record, given.structure, given.theta, given.fit_percent[0], !options.integration);
    if (remedies.empty()) return std::nullopt;
    const Explanation present = explanation_of(record, given);
    Explanation best = present;
    const Remedy* chosen = nullptr;
    for (const Remedy& remedy : remedies) {
        const std::optional<Fit> fit = fit_of(record, remedy, options);
        if (!fit) continue;
        const Explanation found = explanation_of(record, *fit);
        if (!gains(best, found) || (remedy.feedthrough && !is_direct(record, given.structure, found, options)))
            continue;
        best = found;
        chosen = &remedy;
    }
    if (!chosen) return std::nullopt;
    return MissedOption{.start = chosen->condition,
                        .feedthrough = chosen->feedthrough,
                        .samples = shorter ? record.sample_count() : 0,
                        .fit_percent = present.fit(),
                        .better_fit_percent = best.fit()};
}

bool by_defaults(const Fit& fit) {
    return fit.start.state == InitialState::kZero && !fit.start.offset && fit.removed.empty() &&
           fit.termination != Termination::kCancelled;
}

}  // namespace

std::optional<MissedOption> missed_option(const IdData& data, const Fit& fit, const FitOptions& options) {
    if (!by_defaults(fit)) return std::nullopt;
    if (fit.structure.outputs == 1) return missed_by_output(data, fit, options);
    std::optional<MissedOption> most;
    if (!outputs_are_separate(fit.structure)) return most;
    const auto gain = [](const MissedOption& one) { return one.better_fit_percent - one.fit_percent; };
    for (Index output = 0; output < fit.structure.outputs; ++output) {
        const OutputProblem problem = output_problem(data, fit.structure, output);
        Fit own;
        own.structure = problem.structure;
        own.theta = fit.theta(problem.places);
        own.fit_percent = Vector::Constant(1, fit.fit_percent[output]);
        std::optional<MissedOption> missed = missed_by_output(problem.data, own, options);
        if (!missed || !(gain(*missed) > (most ? gain(*most) : 0))) continue;
        missed->output = data.output_names[static_cast<std::size_t>(output)];
        most = std::move(missed);
    }
    return most;
}

namespace {

/// What is left of the errors of a discrete model when further values make their step with the parameters.
class DiscreteLookAhead {
  public:
    DiscreteLookAhead(const DiscreteOutput& model, const Fit& fit) : model_(model) {
        Vector theta = Vector::Zero(model.parameter_count()), output;
        own_ = fit.theta.size();
        theta.head(own_) = fit.theta;
        model.simulate(theta, output, &sensitivities_);
        errors_ = model.target() - output;
    }

    bool usable() const { return errors_.allFinite() && sensitivities_.allFinite(); }
    bool promises() const {
        const Index constants = model_.offset_index(0), all = model_.parameter_count();
        const Vector both = left(all, all);
        const double count = static_cast<double>(errors_.size());
        const double r = std::clamp(
            both.head(both.size() - 1).dot(both.tail(both.size() - 1)) / std::max(both.squaredNorm(), kLeastSquares),
            0.0, kLargestCorrelation);
        const auto explained = [&](const Vector& errors, Index values) {
            return Explanation{std::max(errors.squaredNorm(), kLeastSquares), model_.target_variation(),
                               count * (1 - r) / (1 + r), values};
        };
        const Explanation now = explained(left(own_, own_), own_);
        return gains(now, explained(both, all)) ||
               gains(now, explained(left(own_, constants), own_ + all - constants)) ||
               gains(now, explained(left(constants, all), constants));
    }

  private:
    /// Without the columns from `first` to before `last`.
    Vector left(Index first, Index last) const {
        const Index all = first == last ? first : model_.parameter_count() - (last - first);
        Matrix columns(errors_.size(), all);
        columns.leftCols(first) = sensitivities_.leftCols(first);
        if (all > first) columns.rightCols(all - first) = sensitivities_.rightCols(all - first);
        return solve_least_squares(columns, errors_).residuals;
    }

    const DiscreteOutput& model_;
    Index own_ = 0;
    Matrix sensitivities_;
    Vector errors_;
};

}  // namespace

std::optional<MissedOption> missed_discrete_option(const IdData& data, const Fit& fit, const FitOptions& options,
                                                   const std::function<Fit(const FitOptions&)>& again) {
    if (!by_defaults(fit) || !fit.orders || !(fit.fit_percent.size() == 1)) return std::nullopt;
    const IdData beginning = data.sample_count() > kLookedAt ? beginning_of(data, kLookedAt) : data;
    const std::vector<SampledExperiment> experiments = sampled_experiments(beginning);
    const DiscreteOutput model(*fit.orders, {InitialState::kEstimate, true}, experiments);
    if (model.target().size() <= 2 * model.parameter_count()) return std::nullopt;
    const DiscreteLookAhead ahead(model, fit);
    const bool lost = !ahead.usable() || !(fit.fit_percent[0] > kLostFit);  // too far away to look ahead from
    if (!lost && !ahead.promises()) return std::nullopt;
    const double variation = output_variations(data)[0];
    const auto explained = [&](const Fit& one) {
        Index values = one.theta.size() + (one.start.offset ? 1 : 0);
        if (one.start.state == InitialState::kEstimate)
            values += std::accumulate(fit.orders->nf.begin(), fit.orders->nf.end(), Index{0});
        const auto samples = static_cast<double>(data.sample_count());
        return Explanation{std::max(one.loss * samples, kLeastSquares), variation, samples, values};
    };
    const Explanation present = explained(fit);
    Explanation best = present;
    StartCondition chosen = fit.start;
    for (const StartCondition& condition : start_conditions(data, InitialState::kAuto, Offset::kAuto)) {
        FitOptions wanted = options;
        wanted.initial_state = condition.state;
        wanted.offset = condition.offset ? Offset::kEstimate : Offset::kNone;
        try {
            const Explanation found = explained(again(wanted));
            if (!gains(best, found)) continue;
            best = found;
            chosen = condition;
        } catch (const InvalidArgument&) {
            continue;  // too few samples for it
        }
    }
    if (chosen.state == fit.start.state && chosen.offset == fit.start.offset) return std::nullopt;
    return MissedOption{.start = chosen, .fit_percent = present.fit(), .better_fit_percent = best.fit()};
}

Message sentence_of(const MissedOption& missed) {
    const Message option = option_text(missed), reason = reason_text(missed);
    const Number better = significant(missed.better_fit_percent, 4), fit = significant(missed.fit_percent, 4);
    const bool finite = std::isfinite(missed.fit_percent);
    if (missed.output.empty() && missed.samples == 0)
        return finite ? Message("With {} the fit is {} % instead of {} %: {}.", option, better, fit, reason)
                      : Message("With {} the fit is {} %: {}.", option, better, reason);
    if (missed.samples == 0)
        return finite ? Message("With {} the fit of {} is {} % instead of {} %: {}.", option, missed.output, better,
                                fit, reason)
                      : Message("With {} the fit of {} is {} %: {}.", option, missed.output, better, reason);
    if (missed.output.empty())
        return finite ? Message("With {} the fit of the first {} samples is {} % instead of {} %: {}.", option,
                                missed.samples, better, fit, reason)
                      : Message("With {} the fit of the first {} samples is {} %: {}.", option, missed.samples, better,
                                reason);
    return finite ? Message("With {} the fit of {} of the first {} samples is {} % instead of {} %: {}.", option,
                            missed.output, missed.samples, better, fit, reason)
                  : Message("With {} the fit of {} of the first {} samples is {} %: {}.", option, missed.output,
                            missed.samples, better, reason);
}

}  // namespace dynlab::inline numerics
