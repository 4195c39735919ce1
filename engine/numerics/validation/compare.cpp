#include "numerics/validation/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "numerics/error.h"
#include "numerics/fit/fit.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab::inline numerics {

namespace {

using Channels = std::span<const TransferFunction>;  // of one output, one per input

// One output of one experiment; t is empty when sampled regularly.
struct ComparedData {
    const Matrix& u;
    VectorView y, t;
    double Ts;
    Hold hold;
};

Vector simulate(const ComparedData& data_set, const TransferFunction& G, const VectorView& u, const VectorView& x0) {
    return data_set.Ts > 0 ? lsim(G, u, data_set.Ts, data_set.hold, x0)
                           : lsim(G, u, data_set.t.head(u.size()), data_set.hold, x0);
}

// Response from rest at zero input, or at the first input values, over the first `rows` samples.
Vector driven_response(const ComparedData& data_set, Channels channels, InitialState state, Index rows) {
    Vector response;
    for (Index j = 0; j < data_set.u.cols(); ++j) {
        const TransferFunction& G = channels[static_cast<std::size_t>(j)];
        const double gain = G.dc_gain();
        const double resting = state == InitialState::kZero || !std::isfinite(gain) ? 0 : data_set.u(0, j);
        const auto u = data_set.u.col(j).head(rows);
        Vector share =
            resting == 0 ? simulate(data_set, G, u, Vector()) : simulate(data_set, G, u.array() - resting, Vector());
        if (resting != 0) share.array() += gain * resting;
        if (j == 0)
            response = std::move(share);
        else
            response += share;
    }
    return response;
}

// One of each set of channels with a denominator in common.
std::vector<const TransferFunction*> free_systems(Channels channels) {
    std::vector<const TransferFunction*> systems;
    for (const TransferFunction& G : channels) {
        const auto shares = [&G](const TransferFunction* other) {
            return other->den().size() == G.den().size() && other->den() == G.den();
        };
        if (std::none_of(systems.begin(), systems.end(), shares)) systems.push_back(&G);
    }
    return systems;
}

Index free_order(Channels channels) {
    Index n = 0;
    for (const TransferFunction* G : free_systems(channels)) n += G->pole_count();
    return n;
}

Matrix free_motions(const ComparedData& data_set, Channels channels, Index rows) {
    Matrix motions(rows, free_order(channels));
    Index column = 0;
    for (const TransferFunction* G : free_systems(channels)) {
        const Index n = G->pole_count();
        const TransferFunction poles(Vector::Ones(1), G->den(), G->Ts());
        for (Index i = 0; i < n; ++i)
            motions.col(column++) = simulate(data_set, poles, Vector::Zero(rows), Vector::Unit(n, i));
    }
    return motions;
}

// The effect of the system's past on the first samples of the data. After them the effect is below rounding; with poles
// that do not decay, or irregular sampling, they are all samples.
struct Beginning {
    Matrix motions;  // free motions, one column each
    Vector steady;   // the response when the system rested at the first input values
    Index rows() const { return motions.rows(); }
};

bool has_decayed(const Matrix& motions) {
    constexpr double kDecayed = 1e-18;
    const Matrix last = motions.bottomRows(motions.rows() / 4);
    if (!motions.allFinite()) return false;
    return (last.colwise().lpNorm<Eigen::Infinity>().array() <=
            kDecayed * motions.colwise().lpNorm<Eigen::Infinity>().array())
        .all();
}

Beginning beginning(const ComparedData& data_set, Channels channels) {
    const Index N = data_set.y.size();
    Index late = 0;  // samples until the slowest channel begins to answer
    for (const TransferFunction& G : channels)
        if (data_set.Ts > 0) late = std::max(late, static_cast<Index>(std::min(G.delay() / data_set.Ts + 2, 1e9)));
    Beginning start;
    for (Index reach = 1024;; reach *= 4) {
        const Index rows = data_set.Ts > 0 ? std::min(N, late + reach) : N;
        start.motions = free_motions(data_set, channels, std::min(rows, reach));
        if (rows < N && !has_decayed(start.motions)) continue;
        if (start.motions.rows() < rows) start.motions = free_motions(data_set, channels, rows);
        start.steady = driven_response(data_set, channels, InitialState::kSteady, rows);
        return start;
    }
}

// Number, mean and squares about the mean of the errors past the beginning, which only an offset can explain.
struct Remainder {
    double count = 0, mean = 0, squares = 0;
};

Remainder remainder_of(const ComparedData& data_set, const Vector& response, Index first) {
    constexpr Index kBlock = 2048;
    Remainder sums;
    for (Index k = first; k < response.size(); k += kBlock) {
        const Index rows = std::min(kBlock, response.size() - k);
        const auto errors = (data_set.y.segment(k, rows) - response.segment(k, rows)).eval();
        const double count = static_cast<double>(rows), mean = errors.mean(), step = mean - sums.mean;
        const double together = sums.count + count;
        sums.squares += (errors.array() - mean).square().sum() + step * step * sums.count * count / together;
        sums.mean += step * count / together;
        sums.count = together;
    }
    return sums;
}

struct StartCandidate {
    StartCondition condition{};
    Vector initial_values;
    double offset = 0;
    double bic = std::numeric_limits<double>::infinity();
};

// Values that all start conditions of one experiment share.
struct StartSearch {
    const ComparedData& data_set;
    Channels channels;
    Vector response;  // from rest at zero input
    Beginning start;
    Remainder rest;
    double power = 0;  // mean square of y

    Index values(const StartCondition& condition) const {
        return condition.state == InitialState::kEstimate ? start.motions.cols() : 0;
    }
    VectorView first_response(const StartCondition& condition) const {
        return condition.state == InitialState::kZero ? VectorView(response.head(start.rows()))
                                                      : VectorView(start.steady);
    }
};

StartSearch start_search(const ComparedData& data_set, Channels channels, const std::vector<StartCondition>& all) {
    StartSearch search{data_set, channels, driven_response(data_set, channels, InitialState::kZero, data_set.y.size()),
                       {},       {},       0};
    const bool past =
        std::any_of(all.begin(), all.end(), [](const StartCondition& one) { return one.state != InitialState::kZero; });
    if (past) search.start = beginning(data_set, channels);
    search.rest = remainder_of(data_set, search.response, search.start.rows());
    search.power = data_set.y.squaredNorm() / static_cast<double>(data_set.y.size());
    return search;
}

// The equations of the beginning, and two that say of the rest what an offset makes of its sum of squares.
struct StartEquations {
    Matrix regressors;
    Vector errors;
};

StartEquations start_equations(const StartSearch& search, const StartCondition& condition) {
    const Index rows = search.start.rows(), n = search.values(condition), d = n + (condition.offset ? 1 : 0);
    StartEquations equations{Matrix::Zero(rows + 2, d), Vector(rows + 2)};
    equations.regressors.topLeftCorner(rows, n) = search.start.motions.leftCols(n);
    const double weight = std::sqrt(search.rest.count);
    if (condition.offset) {
        equations.regressors.col(n).head(rows).setOnes();
        equations.regressors(rows, n) = weight;
    }
    equations.errors.head(rows) = search.data_set.y.head(rows) - search.first_response(condition);
    equations.errors.tail(2) << weight * search.rest.mean, std::sqrt(search.rest.squares);
    return equations;
}

StartCandidate candidate(const StartSearch& search, const StartCondition& condition) {
    StartCandidate found{condition, {}, 0, std::numeric_limits<double>::infinity()};
    const Index N = search.data_set.y.size(), n = search.values(condition), d = n + (condition.offset ? 1 : 0);
    const StartEquations equations = start_equations(search, condition);
    if (!equations.regressors.allFinite() || !equations.errors.allFinite()) return found;  // an unstable model
    double squares = equations.errors.squaredNorm();
    if (d > 0) {
        const LeastSquares fit = solve_least_squares(equations.regressors, equations.errors);
        squares = fit.residuals.squaredNorm();
        found.initial_values = fit.solution.head(n);
        if (condition.offset) found.offset = fit.solution[d - 1];
    }
    const double loss = squares / static_cast<double>(N);
    if (std::isfinite(loss)) found.bic = bic_of_loss(loss, search.power, N, d);
    return found;
}

Vector simulated_output(StartSearch& search, const StartCandidate& best) {
    Vector output = std::move(search.response);
    if (best.condition.state != InitialState::kZero) output.head(search.start.rows()) = search.start.steady;
    if (best.initial_values.size() > 0) output.head(search.start.rows()) += search.start.motions * best.initial_values;
    if (best.offset != 0) output.array() += best.offset;
    return output;
}

struct Compared {
    CompareResult result;
    double squares = 0, variation = 0;  // of the errors, and of the outputs about their mean
};

CompareResult compare_centered(const ComparedData& data_set, Channels channels, const CompareOptions& options) {
    const Index N = data_set.y.size(), order = free_order(channels);
    const auto conditions = start_conditions(data_set.u, options.initial_state, options.offset);
    const auto values = [order](const StartCondition& condition) {
        return (condition.state == InitialState::kEstimate ? order : 0) + (condition.offset ? 1 : 0);
    };
    if (const Index d = values(conditions.front()); d > 0 && N <= d)
        throw InvalidArgument(
            "compare estimates {} and needs more samples than that, but the data have {}. Use more data",
            plural(d, "{} value", "{} values"), N);
    StartSearch search = start_search(data_set, channels, conditions);
    StartCandidate best = candidate(search, conditions.front());
    for (std::size_t i = 1; i < conditions.size(); ++i) {
        const bool estimated = conditions[i].state == InitialState::kEstimate;
        if (N <= (estimated ? order : 0) + 1) continue;
        StartCandidate next = candidate(search, conditions[i]);
        if (next.bic < best.bic) best = std::move(next);
    }
    return {simulated_output(search, best), 0, best.condition, best.initial_values, best.offset, {}};
}

Compared compare_data(const ComparedData& data_set, Channels channels, const CompareOptions& options) {
    Compared compared;
    CompareResult& result = compared.result;
    double removed_output = 0;
    if (options.offset == Offset::kRemove) {
        const JointOperatingPoint removed = joint_operating_point(data_set.u, data_set.y);
        const Matrix u = data_set.u.rowwise() - removed.inputs.transpose();
        const Vector y = data_set.y.array() - removed.output;
        result = compare_centered({u, y, data_set.t, data_set.Ts, data_set.hold}, channels, options);
        removed_output = removed.output;
        result.output.array() += removed_output;
    } else {
        result = compare_centered(data_set, channels, options);
    }
    result.offset += removed_output;
    compared.squares = (data_set.y - result.output).squaredNorm();
    compared.variation = variation_about_mean(data_set.y);
    result.fit_percent = fit_percent_of_sums(compared.squares, compared.variation);
    result.message = Message("Simulated {}: fit {} %.", description(result.start), significant(result.fit_percent, 4));
    return compared;
}

}  // namespace

Matrix Comparison::outputs(std::size_t experiment) const {
    const auto& row = results[experiment];
    Matrix all(row.front().output.size(), static_cast<Index>(row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) all.col(static_cast<Index>(i)) = row[i].output;
    return all;
}

Comparison compare_all(const IdData& data, const std::vector<TransferFunction>& channels,
                       const CompareOptions& options) {
    const Index ny = data.output_count(), nu = data.input_count();
    if (ny < 1 || nu < 1 || static_cast<Index>(channels.size()) != ny * nu)
        throw InvalidArgument(
            "The model needs one transfer function from each input to each output of the data ({} and {}), but has {}: "
            "select the channels of the model",
            plural(nu, "{} input", "{} inputs"), plural(ny, "{} output", "{} outputs"), channels.size());
    Comparison all;
    Vector squares = Vector::Zero(ny), variation = Vector::Zero(ny);
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Experiment& experiment = data.experiments[k];
        auto& row = all.results.emplace_back();
        for (Index i = 0; i < ny; ++i) {
            const Channels own(channels.data() + i * nu, static_cast<std::size_t>(nu));
            const ComparedData data_set{experiment.u, experiment.y.col(i), experiment.t, data.Ts, data.hold};
            Compared compared = compare_data(data_set, own, options);
            squares[i] += compared.squares;
            variation[i] += compared.variation;
            row.push_back(std::move(compared.result));
        }
    }
    all.fit_percent = squares.binaryExpr(variation, &fit_percent_of_sums);
    return all;
}

Comparison compare_all(const IdData& data, const FreeRunModel& model) {
    const Index ny = data.output_count();
    Comparison all;
    Vector squares = Vector::Zero(ny), variation = Vector::Zero(ny);
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const FreeRun run = model.free_run(data, k, Vector());
        auto& row = all.results.emplace_back();
        for (Index i = 0; i < ny; ++i) {
            const auto y = data.experiments[k].y.col(i);
            const double errors = (y - run.output.col(i)).squaredNorm(), own = variation_about_mean(y);
            squares[i] += errors;
            variation[i] += own;
            CompareResult& result = row.emplace_back();
            result.output = run.output.col(i);
            result.fit_percent = fit_percent_of_sums(errors, own);
            result.message =
                Message("Free-run simulation {}: fit {} %.", run.start, significant(result.fit_percent, 4));
            if (run.lost_at) result.message = sentences({result.message, divergence_text(data, k, *run.lost_at)});
        }
    }
    all.fit_percent = squares.binaryExpr(variation, &fit_percent_of_sums);
    return all;
}

CompareResult compare(const IdData& data, const TransferFunction& G, const CompareOptions& options) {
    if (data.experiments.size() != 1 || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument(
            "compare needs one experiment with one input and one output, but the data have {}, {} and {}: select one "
            "of each",
            plural(static_cast<Index>(data.experiments.size()), "{} experiment", "{} experiments"),
            plural(data.input_count(), "{} input", "{} inputs"),
            plural(data.output_count(), "{} output", "{} outputs"));
    return compare_all(data, {G}, options).results.front().front();
}

Vector fits_without_offsets(const IdData& data, const Comparison& comparison) {
    Vector squares = Vector::Zero(data.output_count());
    for (std::size_t k = 0; k < data.experiments.size(); ++k)
        for (Index i = 0; i < squares.size(); ++i) {
            const CompareResult& result = comparison.results[k][static_cast<std::size_t>(i)];
            const double offset = result.start.offset ? result.offset : 0;
            squares[i] += (data.experiments[k].y.col(i).array() - result.output.array() + offset).square().sum();
        }
    return squares.binaryExpr(output_variations(data), &fit_percent_of_sums);
}

LevelledOutputs levelled_outputs(const IdData& data, const Comparison& comparison) {
    LevelledOutputs all{Vector(data.sample_count()), Vector(data.sample_count()), Vector(data.sample_count())};
    Index first = 0;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const auto y = data.experiments[k].y.col(0);
        all.measured.segment(first, y.size()) = y.array() - y.mean();
        const Vector& output = comparison.results[k].front().output;
        all.simulated.segment(first, y.size()) = output.array() - y.mean();
        all.swing.segment(first, y.size()) = output.array() - output.mean();
        first += y.size();
    }
    return all;
}

}  // namespace dynlab::inline numerics
