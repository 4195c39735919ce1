#include "numerics/validation/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/number_text.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab::inline numerics {

namespace {

using Channels = std::span<const TransferFunction>;  // of one output, one per input

// One output of one experiment.
struct ComparedRecord {
    Matrix u;
    Vector y, t;
    double Ts;
    Hold hold;
};

Vector simulate(const ComparedRecord& record, const TransferFunction& G, const VectorView& u, const VectorView& x0) {
    return record.Ts > 0 ? lsim(G, u, record.Ts, record.hold, x0) : lsim(G, u, record.t, record.hold, x0);
}

// Response from rest at zero input, or at the first input values.
Vector driven_response(const ComparedRecord& record, Channels channels, InitialState state) {
    Vector response = Vector::Zero(record.y.size());
    for (Index j = 0; j < record.u.cols(); ++j) {
        const TransferFunction& G = channels[static_cast<std::size_t>(j)];
        const double gain = G.dc_gain();
        const double resting = state == InitialState::kZero || !std::isfinite(gain) ? 0 : record.u(0, j);
        response += simulate(record, G, record.u.col(j).array() - resting, Vector());
        if (resting != 0) response.array() += gain * resting;
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

Matrix free_motions(const ComparedRecord& record, Channels channels) {
    const Index N = record.y.size();
    Matrix motions(N, free_order(channels));
    Index column = 0;
    for (const TransferFunction* G : free_systems(channels)) {
        const Index n = G->pole_count();
        const TransferFunction poles(Vector::Ones(1), G->den(), G->Ts());
        for (Index i = 0; i < n; ++i)
            motions.col(column++) = simulate(record, poles, Vector::Zero(N), Vector::Unit(n, i));
    }
    return motions;
}

struct DelayCandidate {
    CompareResult result;
    double bic = std::numeric_limits<double>::infinity();
};

DelayCandidate candidate(const ComparedRecord& record, Channels channels, const StartCondition& condition) {
    DelayCandidate found;
    CompareResult& result = found.result;
    result.start = condition;
    result.output = driven_response(record, channels, condition.state);
    const Index N = record.y.size(), n = condition.state == InitialState::kEstimate ? free_order(channels) : 0;
    const Index d = n + (condition.offset ? 1 : 0);
    if (d > 0) {
        if (N <= d)
            throw InvalidArgument("compare needs more samples than the " + std::to_string(d) +
                                  " values it estimates, and the record holds " + std::to_string(N));
        Matrix regressors = Matrix::Ones(N, d);
        if (n > 0) regressors.leftCols(n) = free_motions(record, channels);
        const Vector error = record.y - result.output;
        if (!regressors.allFinite() || !error.allFinite()) return found;  // an unstable model: nothing to estimate
        const LeastSquares fit = solve_least_squares(regressors, error);
        result.output = record.y - fit.residuals;
        result.initial_values = fit.solution.head(n);
        if (condition.offset) result.offset = fit.solution[d - 1];
    }
    const double samples = static_cast<double>(N);
    const double loss = (record.y - result.output).squaredNorm() / samples;
    if (std::isfinite(loss)) found.bic = bic_of_loss(loss, record.y.squaredNorm() / samples, N, d);
    return found;
}

CompareResult compare_record(ComparedRecord record, Channels channels, const CompareOptions& options) {
    double removed_output = 0;
    if (options.offset == Offset::kRemove) {
        const JointOperatingPoint removed = joint_operating_point(record.u, record.y);
        record.u.rowwise() -= removed.inputs.transpose();
        record.y.array() -= removed.output;
        removed_output = removed.output;
    }
    const auto conditions = start_conditions(record.u, options.initial_state, options.offset);
    DelayCandidate best = candidate(record, channels, conditions.front());
    for (std::size_t i = 1; i < conditions.size(); ++i) {
        const Index n = conditions[i].state == InitialState::kEstimate ? free_order(channels) : 0;
        if (record.y.size() <= n + 1) continue;
        DelayCandidate next = candidate(record, channels, conditions[i]);
        if (next.bic < best.bic) best = std::move(next);
    }
    CompareResult result = std::move(best.result);
    result.fit_percent = fit_percent(record.y, result.output);
    result.output.array() += removed_output;
    result.offset += removed_output;
    result.message = "Simulated " + description(result.start) + ": fit " + number_text(result.fit_percent, 4) + " %.";
    return result;
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
        throw InvalidArgument("The model needs one transfer function from each of the " + std::to_string(nu) +
                              " input(s) to each of the " + std::to_string(ny) + " output(s) of the data, and has " +
                              std::to_string(channels.size()) + ": select the channels it describes");
    Comparison all;
    Vector squares = Vector::Zero(ny), variation = Vector::Zero(ny);
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Experiment& experiment = data.experiments[k];
        auto& row = all.results.emplace_back();
        for (Index i = 0; i < ny; ++i) {
            const Vector y = experiment.y.col(i);
            const Channels own(channels.data() + i * nu, static_cast<std::size_t>(nu));
            row.push_back(compare_record({experiment.u, y, data.time(k), data.Ts, data.hold}, own, options));
            squares[i] += (y - row.back().output).squaredNorm();
            variation[i] += (y.array() - y.mean()).matrix().squaredNorm();
        }
    }
    all.fit_percent = 100 * (1 - (squares.array() / variation.array()).sqrt());
    return all;
}

CompareResult compare(const IdData& data, const TransferFunction& G, const CompareOptions& options) {
    if (data.experiments.size() != 1 || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument("compare needs one experiment with one input and one output, and the data hold " +
                              std::to_string(data.experiments.size()) + " experiment(s), " +
                              std::to_string(data.input_count()) + " input(s) and " +
                              std::to_string(data.output_count()) + " output(s): select one of each");
    return compare_all(data, {G}, options).results.front().front();
}

}  // namespace dynlab::inline numerics
