#include "numerics/fit/structure_advice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/signals/preprocess.h"
#include "numerics/statistics/wandering.h"

namespace dynlab::inline numerics {
namespace {

constexpr Index kLookedAt = 3000, kFitted = 100'000;  // samples
constexpr double kStrongEvidence = 10;                // BIC
constexpr double kHalfPoint = 0.5, kFairShare = 0.2, kLeastPoints = 0.05;
constexpr double kRidge = 1e-9;                                        // of a sum of squares of sensitivities
constexpr double kFastestPole = 2;                                     // per sample: faster ones are as good as none
constexpr double kLargestCorrelation = 0.999, kLeastSquares = 1e-300;  // the second keeps logarithms finite

/// How well a model explains one output.
struct Explanation {
    double squares = 0, variation = 0;  ///< of the errors; of the output about its means
    double samples = 0;                 ///< that count
    Index values = 0;                   ///< estimated

    double fit() const { return fit_percent_of_sums(squares, variation); }
};

bool is_worth_reporting(double fit, double better) {
    const double gain = better - fit;
    return gain >= kHalfPoint || gain >= std::max(kLeastPoints, kFairShare * (100 - fit));
}

/// By how much the second lowers BIC.
double evidence_for(const Explanation& one, const Explanation& other) {
    const double N = std::max(other.samples, 2.0);
    return N * std::log(one.squares / other.squares) - static_cast<double>(other.values - one.values) * std::log(N);
}

/// Whether the second is better by more than chance, and by enough.
bool gains(const Explanation& one, const Explanation& other) {
    return evidence_for(one, other) > kStrongEvidence && is_worth_reporting(one.fit(), other.fit());
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

/// What one Gauss-Newton step from a fit of one output gains with direct terms.
class LookAhead {
  public:
    LookAhead(const IdData& data, const Fit& fit) {
        const IdData part = data.sample_count() > kLookedAt ? beginning_of(data, kLookedAt) : IdData();
        const IdData& data_set = data.sample_count() > kLookedAt ? part : data;
        whole_ = static_cast<double>(data.sample_count()) / static_cast<double>(data_set.sample_count());
        samples_ = static_cast<double>(data.sample_count());
        variation_ = output_variations(data_set)[0];
        const TransferStructure direct = with_direct_terms(fit.structure);
        const TransferOutput model(direct, fit.start, data_set, 0, shortest_experiment(data_set));
        const Index own = direct.parameter_count();
        Fit extended = fit;
        extended.structure = direct;
        extended.theta = with_direct_terms(fit.structure, direct, fit.theta);
        const Vector point = search_point(extended, model, model.seconds());
        sums_ = model.products(point, model.target());
        set_places(fit.structure, direct, point);
        for (Index i = own; i < model.parameter_count(); ++i) own_.push_back(i);
    }

    bool promises() const {
        if (!sums_.gram.allFinite() || !std::isfinite(sums_.squares) || direct_.empty()) return false;
        return gains(left(zeros_, {}), left(zeros_, direct_));
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

    /// Of all data, after a step of the parameters and these values.
    Explanation left(const Places& some, const Places& more) const {
        Places all = own_;
        all.insert(all.end(), some.begin(), some.end());
        all.insert(all.end(), more.begin(), more.end());
        const double squares = whole_ * (sums_.squares - gained(all));
        return {std::max(squares, kLeastSquares), whole_ * variation_, samples_, static_cast<Index>(all.size())};
    }

    /// g' (J'J)^-1 g of these columns.
    double gained(const Places& places) const {
        Vector scale = sums_.gram.diagonal()(places).cwiseSqrt();
        for (double& value : scale)
            if (!(value > 0)) value = 1;
        const auto scaling = scale.cwiseInverse().asDiagonal();
        Matrix gram = scaling * sums_.gram(places, places) * scaling;
        gram.diagonal().array() += kRidge;
        const Vector descent = scaling * sums_.descent(places);
        return std::max(0.0, descent.dot(solve_semidefinite(gram, descent)));
    }

    OutputErrorProducts sums_;
    double samples_ = 0, whole_ = 1, variation_ = 0;
    Places own_, zeros_, direct_;
};

double correlation_of_neighbors(const Vector& errors, const TransferOutput& model) {
    double products = 0, squares = 0;
    for (std::size_t e = 0; e < model.experiment_count(); ++e) {
        const auto own = errors.segment(model.row(e, 0), model.rows(e));
        products += own.head(own.size() - 1).dot(own.tail(own.size() - 1));
        squares += own.squaredNorm();
    }
    return squares > 0 ? std::clamp(products / squares, 0.0, kLargestCorrelation) : 0;
}

/// Without the first seconds, which do not count.
Explanation explanation_of(const IdData& data_set, const Fit& fit, double masked_seconds) {
    TransferOutput model(fit.structure, fit.start, data_set, 0, shortest_experiment(data_set));
    model.mask_start(masked_seconds);
    const Vector errors = model.target() - model.output_at(search_point(fit, model, model.seconds()));
    const bool finite = errors.allFinite();
    const double r = finite ? correlation_of_neighbors(errors, model) : 0;
    return {finite ? std::max(errors.squaredNorm(), kLeastSquares) : kInfinity, counted_variations(model)[0],
            static_cast<double>(model.sample_count()) * (1 - r) / (1 + r), model.parameter_count()};
}

/// One output, its fit, and how others are found.
struct Question {
    const IdData& data_set;
    const Fit& given;
    const FitOptions& options;

    Explanation explanation(const Fit& fit) const {
        return explanation_of(data_set, fit, masked_start(given, data_set));
    }

    /// The search that a user's structure leads to; nothing where the data do not allow it.
    std::optional<Fit> fit_of(const TransferStructure& structure) const {
        FitOptions how = options;
        how.extend_iterations = false;  // only chance separates such a late result from the fit
        how.integration = false;
        how.fixed.clear();
        how.output_weights.resize(0);
        try {
            Fit fit = search_with_chosen_start("missed_structure", data_set, structure, how);
            if (fit.termination != Termination::kCanceled) return fit;
        } catch (const InvalidArgument&) {
            return std::nullopt;
        }
        return std::nullopt;
    }
};

/// Whether a direct term does what neither more zeros nor one more pole does. A pole that is too fast to be seen is
/// one.
bool is_direct(const Question& asked, const Explanation& direct) {
    const TransferStructure& structure = asked.given.structure;
    const auto zeros = asked.fit_of(changed(structure, 0, [](int n, int m) { return std::max(m, n - 1); }));
    if (zeros && !gains(asked.explanation(*zeros), direct)) return false;
    const auto pole = asked.fit_of(changed(structure, 1, [](int, int m) { return m + 1; }));
    if (!pole || is_worth_reporting(asked.explanation(*pole).fit(), direct.fit())) return true;
    double fastest = 0;
    for (const TransferFunction& G : pole->models) fastest = std::max(fastest, G.poles().cwiseAbs().maxCoeff());
    return fastest * asked.data_set.mean_step() > kFastestPole;
}

/// What the structure explains when an input that moves at nearly every sample is not held between them; nothing where
/// a direct term does better.
std::optional<Explanation> without_hold(const Question& asked, const Explanation& direct) {
    if (!moves_between_samples(asked.data_set)) return std::nullopt;
    IdData lines = asked.data_set;
    lines.hold = Hold::kFoh;
    const Question other{lines, asked.given, asked.options};
    const std::optional<Fit> fit = other.fit_of(asked.given.structure);
    if (!fit) return std::nullopt;
    const Explanation found = other.explanation(*fit);
    return gains(found, direct) ? std::nullopt : std::optional(found);
}

using Candidate = std::pair<StructureAdviceCode, TransferStructure>;  ///< a structure to try

std::vector<Candidate> candidates(const IdData& data, const Question& asked) {
    const TransferStructure& structure = asked.given.structure;
    std::vector<Candidate> all;
    if (structure.single_channel() && errors_follow_input(asked.data_set, asked.given)) {
        if (!structure.free_delays) {
            all.push_back({StructureAdviceCode::kDelay, structure});
            all.back().second.free_delays = true;
        }
        all.push_back({StructureAdviceCode::kPole, changed(structure, 1, [](int, int m) { return m; })});
    }
    if (!asked.options.integration && LookAhead(data, asked.given).promises())
        all.push_back({StructureAdviceCode::kFeedthrough, with_direct_terms(structure)});
    return all;
}

/// Whether a straight line may be missed: the errors wander (those of the first experiment), or a slow or unstable pole
/// has taken it over.
bool may_miss_line(const Question& asked) {
    const double duration = shortest_experiment(asked.data_set);
    constexpr double kSlowTurns = 3;
    for (const TransferFunction& G : asked.given.models)
        for (const Complex& pole : G.poles())
            if (has_unstable_pole(G) || std::abs(pole) * duration < kSlowTurns) return true;
    const TransferOutput model(asked.given.structure, asked.given.start, asked.data_set, 0,
                               shortest_experiment(asked.data_set));
    const Vector errors = model.target() - model.output_at(search_point(asked.given, model, model.seconds()));
    return !errors.allFinite() || wanders(errors.head(model.rows(0)));
}

/// The same structure on other data, where that gains over the present fit with so many more values.
std::optional<StructureAdvice> gain_on(const IdData& data, const Question& asked, const Explanation& present,
                                       StructureAdviceCode code, const char* option, Index more_values) {
    const Question other{data, asked.given, asked.options};
    const std::optional<Fit> fit = other.fit_of(asked.given.structure);
    if (!fit) return std::nullopt;
    Explanation found = other.explanation(*fit);
    found.variation = present.variation;
    found.values += more_values;
    if (!gains(present, found)) return std::nullopt;
    return StructureAdvice{
        .code = code, .option = option, .fit_percent = present.fit(), .better_fit_percent = found.fit()};
}

/// Whether the same structure fits better after linear detrending of input and output.
std::optional<StructureAdvice> missed_line(const Question& asked, const Explanation& present) {
    if (!may_miss_line(asked)) return std::nullopt;
    return gain_on(detrend(asked.data_set, TrendKind::kLinear), asked, present, StructureAdviceCode::kLine, "detrend",
                   2 * static_cast<Index>(asked.data_set.experiments.size()));
}

/// Whether it does better with the input one sample earlier.
std::optional<StructureAdvice> missed_shift(const Question& asked, const Explanation& present) {
    const auto& [data_set, given, options] = asked;
    if (!given.structure.single_channel() || options.integration || given.models.front().delay() > 0) return {};
    const int poles = given.structure.poles.front();
    if (!errors_follow_input(data_set, given)) return {};
    const auto found = gain_on(data_set.shifted(-1), asked, present, StructureAdviceCode::kLate, "shift", 0);
    return found && late_input(data_set, poles, given.loss) ? found : std::nullopt;  // the quick question first
}

double value_of(StructureAdviceCode code, const Fit& fit) {
    if (code == StructureAdviceCode::kDelay) return fit.models.front().delay();
    return code == StructureAdviceCode::kPole ? fit.structure.poles.front() : fit.structure.channels.front().zeros;
}

const char* option_of(StructureAdviceCode code) {
    return code == StructureAdviceCode::kDelay ? "delay" : code == StructureAdviceCode::kPole ? "poles" : "zeros";
}

/// For one output.
std::optional<StructureAdvice> missed_by_output(const IdData& data, const Fit& given, const FitOptions& options) {
    const bool shorter = data.sample_count() > kFitted;
    const IdData beginning = shorter ? beginning_of(data, kFitted) : IdData();
    const IdData& data_set = shorter ? beginning : data;
    const Question asked{data_set, given, options};
    const Explanation present = asked.explanation(given);
    std::optional<StructureAdvice> best = missed_line(asked, present);
    if (!best) best = missed_shift(asked, present);
    if (best) {
        best->samples = shorter ? data_set.sample_count() : 0;
        return best;
    }
    double strongest = 0;
    for (const auto& [code, structure] : candidates(data, asked)) {
        const std::optional<Fit> fit = asked.fit_of(structure);
        if (!fit) continue;
        const Explanation found = asked.explanation(*fit);
        const double evidence = evidence_for(present, found);
        if (!gains(present, found) || !(evidence > strongest)) continue;
        const bool feedthrough = code == StructureAdviceCode::kFeedthrough;
        const std::optional<Explanation> moving = feedthrough ? without_hold(asked, found) : std::nullopt;
        const bool moves = moving && gains(present, *moving);
        if (feedthrough && !moves && !is_direct(asked, found)) continue;
        strongest = evidence;
        best = StructureAdvice{.code = moves ? StructureAdviceCode::kHold : code,
                               .option = moves ? "hold" : option_of(code),
                               .value = value_of(code, *fit),
                               .samples = shorter ? data_set.sample_count() : 0,
                               .fit_percent = present.fit(),
                               .better_fit_percent = moves ? moving->fit() : found.fit()};
    }
    return best;
}

/// The fit of one output alone.
Fit fit_of_output(const Fit& fit, const OutputProblem& problem, Index output) {
    Fit own;
    own.structure = problem.structure;
    own.theta = fit.theta(problem.places);
    own.models = problem.structure.models(own.theta);
    own.fit_percent = Vector::Constant(1, fit.fit_percent[output]);
    own.start = {InitialState::kZero, false};
    return own;
}

Message option_text(const StructureAdvice& missed) {
    switch (missed.code) {
        case StructureAdviceCode::kDelay:
            return Message("a delay of {} s", significant(missed.value, 3));
        case StructureAdviceCode::kPole:
            return Message("one more pole");
        case StructureAdviceCode::kLine:
            return Message("linear trends removed (data:detrend(\"linear\"))");
        case StructureAdviceCode::kLate:
            return Message("the input shifted by one sample (data:shift(-1))");
        case StructureAdviceCode::kHold:
            return Message("linear interpolation of the input ({} = \"foh\")", OptionName{"hold"});
        default:
            return Message("as many zeros as poles");
    }
}

Message reason_text(const StructureAdvice& missed) {
    switch (missed.code) {
        case StructureAdviceCode::kDelay:
            return Message("the model responds earlier than the output");
        case StructureAdviceCode::kPole:
            return Message("the residuals of the current model are correlated with the input");
        case StructureAdviceCode::kLine:
            return Message("the output drifts, or a constant load acts on an integrator");
        case StructureAdviceCode::kLate:
            return Message("the output responds before the input changes, because the input was logged late");
        case StructureAdviceCode::kHold:
            return Message("the input changes between its samples");
        default:
            return Message("the output responds to the input immediately (direct feedthrough)");
    }
}

}  // namespace

bool moves_between_samples(const IdData& data) {
    constexpr double kNearlyAll = 0.9;
    return data.hold == Hold::kZoh && std::ranges::all_of(data.experiments, [&](const Experiment& experiment) {
               const Index steps = experiment.u.rows() - 1;
               const auto moves = experiment.u.topRows(steps).array() != experiment.u.bottomRows(steps).array();
               return static_cast<double>(moves.count()) >= kNearlyAll * static_cast<double>(moves.size());
           });
}

bool late_input(const IdData& data, int poles, double loss) {
    constexpr double kEvidence = 30, kAdequate = 20, kNoWorse = 10;  // of N log of losses
    if (!data.regular() || data.sample_count() > kFitted) return false;
    IdData lines = data;
    lines.hold = Hold::kFoh;
    const IdData shifted = data.shifted(-1);
    FitOptions options = FitOptions().started({InitialState::kEstimate, true});
    options.tolerance = 1e-3;
    const Fit none;
    const Question seen{data, none, options}, early{shifted, none, options}, straight{lines, none, options};
    const int max_poles = std::max(poles + 1, 3);  // the structure was chosen without knowing
    const auto strictly = [](int n) { return TransferStructure::single(n, n - 1); };
    const std::optional<Fit> in_time = seen.fit_of(strictly(max_poles)), earlier = early.fit_of(strictly(max_poles));
    if (!in_time || !earlier) return false;
    const double N = explanation_of(shifted, *earlier, 0).samples;
    const auto gain = [N](double from, const auto& to) { return to ? N * std::log(from / to->loss) : -kInfinity; };
    if (!(gain(std::min(loss, in_time->loss), earlier) > kEvidence)) return false;
    if (moves_between_samples(data) && gain(earlier->loss, straight.fit_of(strictly(max_poles))) > -kNoWorse)
        return false;
    // A direct feedthrough of n poles is as good as n + 1 poles with the input earlier, one too fast to be seen.
    for (int n = 1; n <= max_poles; ++n) {
        const std::optional<Fit> direct = seen.fit_of(TransferStructure::single(n, n));
        if (!direct || gain(earlier->loss, direct) < -kAdequate) continue;
        return gain(direct->loss, n < max_poles ? early.fit_of(strictly(n)) : earlier) > -kNoWorse;
    }
    return true;
}

std::optional<StructureAdvice> missed_structure(const IdData& data, const Fit& fit, const FitOptions& options) {
    if (fit.termination == Termination::kCanceled || !fit.removed.empty()) return std::nullopt;
    if (fit.structure.outputs == 1) return missed_by_output(data, fit, options);
    std::optional<StructureAdvice> strongest;
    const bool rests = fit.start.state == InitialState::kZero && !fit.start.offset;
    if (!rests || !outputs_are_separate(fit.structure)) return strongest;
    const auto gain = [](const StructureAdvice& one) { return one.better_fit_percent - one.fit_percent; };
    for (Index output = 0; output < fit.structure.outputs; ++output) {
        const OutputProblem problem = output_problem(data, fit.structure, output);
        std::optional<StructureAdvice> missed =
            missed_by_output(problem.data, fit_of_output(fit, problem, output), options);
        if (!missed || !(gain(*missed) > (strongest ? gain(*strongest) : 0))) continue;
        missed->output = data.output_names[static_cast<std::size_t>(output)];
        strongest = std::move(missed);
    }
    return strongest;
}

Message sentence_of(const StructureAdvice& missed) {
    const Message option = option_text(missed), reason = reason_text(missed);
    const bool whole = missed.samples == 0;
    const Message fit = missed.output.empty()
                            ? whole ? Message("the fit") : Message("the fit of the first {} samples", missed.samples)
                        : whole ? Message("the fit of {}", missed.output)
                                : Message("the fit of {} of the first {} samples", missed.output, missed.samples);
    const Number better = significant(missed.better_fit_percent, 4), present = significant(missed.fit_percent, 4);
    return std::isfinite(missed.fit_percent)
               ? Message("With {}, {} is {} % instead of {} %: {}.", option, fit, better, present, reason)
               : Message("With {}, {} is {} %: {}.", option, fit, better, reason);
}

}  // namespace dynlab::inline numerics
