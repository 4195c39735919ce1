#include "numerics/validation/compare.h"

#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/number_text.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/fit_measures.h"

namespace dynlab {

namespace {

struct Record {
    Vector u, y, t;
    double Ts;
    Hold hold;
};

Record one_record(const IdData& data) {
    if (data.experiments.size() != 1 || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument("compare needs one experiment with one input and one output, and the data hold " +
                              std::to_string(data.experiments.size()) + " experiment(s), " +
                              std::to_string(data.input_count()) + " input(s) and " +
                              std::to_string(data.output_count()) + " output(s): select one of each");
    const Experiment& experiment = data.experiments.front();
    return {experiment.u.col(0), experiment.y.col(0), data.time(), data.Ts, data.hold};
}

Vector simulate(const Record& record, const TransferFunction& G, const VectorView& u, const VectorView& x0) {
    return record.Ts > 0 ? lsim(G, u, record.Ts, record.hold, x0) : lsim(G, u, record.t, record.hold, x0);
}

// Response from rest at zero input, or at the first input value.
Vector driven_response(const Record& record, const TransferFunction& G, InitialState state) {
    if (state == InitialState::kZero || record.u[0] == 0) return simulate(record, G, record.u, Vector());
    const double gain = G.dc_gain();
    if (!std::isfinite(gain)) return simulate(record, G, record.u, Vector());
    const double resting = record.u[0];
    return simulate(record, G, record.u.array() - resting, Vector()).array() + gain * resting;
}

Matrix free_motions(const Record& record, const TransferFunction& G) {
    const Index n = G.pole_count(), N = record.y.size();
    const TransferFunction poles(Vector::Ones(1), G.den(), G.Ts());
    Matrix motions(N, n);
    for (Index i = 0; i < n; ++i) motions.col(i) = simulate(record, poles, Vector::Zero(N), Vector::Unit(n, i));
    return motions;
}

struct Candidate {
    CompareResult result;
    double bic = std::numeric_limits<double>::infinity();
};

Candidate candidate(const Record& record, const TransferFunction& G, const StartCondition& condition) {
    Candidate found;
    CompareResult& result = found.result;
    result.start = condition;
    result.output = driven_response(record, G, condition.state);
    const Index N = record.y.size(), n = condition.state == InitialState::kEstimate ? G.pole_count() : 0;
    const Index d = n + (condition.offset ? 1 : 0);
    if (d > 0) {
        if (N <= d)
            throw InvalidArgument("compare needs more samples than the " + std::to_string(d) +
                                  " values it estimates, and the record holds " + std::to_string(N));
        Matrix regressors = Matrix::Ones(N, d);
        if (n > 0) regressors.leftCols(n) = free_motions(record, G);
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

}  // namespace

CompareResult compare(const IdData& data, const TransferFunction& G, const CompareOptions& options) {
    Record record = one_record(data);
    OperatingPoint removed;
    if (options.offset == Offset::kRemove) {
        removed = operating_point(record.u, record.y);
        record.u.array() -= removed.input;
        record.y.array() -= removed.output;
    }
    const auto conditions = start_conditions(record.u, options.initial_state, options.offset);
    Candidate best = candidate(record, G, conditions.front());
    for (std::size_t i = 1; i < conditions.size(); ++i) {
        const Index n = conditions[i].state == InitialState::kEstimate ? G.pole_count() : 0;
        if (record.y.size() <= n + 1) continue;
        Candidate next = candidate(record, G, conditions[i]);
        if (next.bic < best.bic) best = std::move(next);
    }
    CompareResult result = std::move(best.result);
    result.fit_percent = fit_percent(record.y, result.output);
    result.output.array() += removed.output;
    result.offset += removed.output;
    result.message = "Simulated " + description(result.start) + ": fit " + number_text(result.fit_percent, 4) + " %.";
    return result;
}

}  // namespace dynlab
