#include "numerics/filters/filter_chain.h"

#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/exact_filter.h"
#include "numerics/simulation/irregular_filter.h"

namespace dynlab::inline numerics {

namespace {

SampledSystem sampled(const SingleInputSystem& system, double Ts, Hold hold, double delay) {
    return discretize(system.A, system.B, system.C, system.D, Ts, hold, delay);
}

/// `second`, which has no delay, driven by the first output of `first`. Its input v begins with the delayed signal and
/// is zero before, so that the rule for its own first sample needs no special case.
SampledSystem series(const SampledSystem& first, const SampledSystem& second) {
    const Index n = first.F.rows(), q = second.F.rows(), p = second.C.rows();
    const Eigen::RowVectorXd C = first.C.row(0), D = first.D.row(0);
    const Vector now = second.G.col(1), next = second.G.col(0);  // weights of v[k], v[k+1]
    SampledSystem chain;
    chain.delay = first.delay;
    chain.F = Matrix::Zero(n + q, n + q);
    chain.F.topLeftCorner(n, n) = first.F;
    chain.F.bottomLeftCorner(q, n) = now * C + next * (C * first.F);
    chain.F.bottomRightCorner(q, q) = second.F;
    // v[k] = C x + D [u[k]; u[k-1]] and v[k+1] = C (F x + G samples) + D [u[k+1]; u[k]]
    Eigen::RowVector3d of_next = C * first.G, of_now = Eigen::RowVector3d(0, D[0], D[1]);
    of_next += Eigen::RowVector3d(D[0], D[1], 0);
    chain.G.resize(n + q, 3);
    chain.G << first.G, next * of_next + now * of_now;
    Eigen::RowVector2d first_next = C * first.first_G;
    first_next += Eigen::RowVector2d(D[0], D[1]);
    chain.first_G.resize(n + q, 2);
    chain.first_G << first.first_G, next * first_next + now * Eigen::RowVector2d(0, first.first_D[0]);
    chain.C = Matrix::Zero(p, n + q);
    chain.C.leftCols(n) = second.D.col(0) * C;
    chain.C.rightCols(q) = second.C;
    chain.D = second.D.col(0) * D;
    chain.first_D = second.D.col(0) * first.first_D[0];
    return chain;
}

SampledSystem sampled(const FilterChain& chain, double Ts) {
    SampledSystem filter = sampled(chain.filter, Ts, chain.hold, chain.delay);
    if (!chain.front) return filter;
    return series(sampled(chain.front->system, Ts, chain.front->hold, chain.front->delay), filter);
}

Matrix irregular_outputs(const FilterChain& chain, const SampleView& t) {
    const auto run = [&](const SingleInputSystem& system, const VectorView& signal, Hold hold, double delay) {
        IrregularFilter filter(system.A, system.B, system.C, system.D, hold, delay);
        return filter.run(signal, t, Vector::Zero(system.A.rows()));
    };
    if (!chain.front) return run(chain.filter, chain.signal, chain.hold, chain.delay);
    const Matrix between = run(chain.front->system, chain.signal, chain.front->hold, chain.front->delay);
    return run(chain.filter, between.col(0), chain.hold, 0);
}

}  // namespace

SingleInputSystem derivatives_filter(const VectorView& den, Index highest) {
    const Index n = den.size() - 1;
    SingleInputSystem system{companion(den), Vector::Unit(n, 0), Matrix::Zero(highest + 1, n),
                             Vector::Zero(highest + 1)};
    for (Index row = 0; row <= highest; ++row) {
        const Index derivative = highest - row;
        if (derivative < n)
            system.C(row, n - 1 - derivative) = 1;
        else
            system.C.row(row) = -den.tail(n).transpose();
    }
    if (highest == n) system.D[0] = 1;
    return system;
}

Matrix chain_outputs(const FilterChain& chain, const Sampling& sampling) {
    return sampling.Ts > 0 ? ExactFilter(sampled(chain, sampling.Ts)).run(chain.signal)
                           : irregular_outputs(chain, sampling.t);
}

SingleInputSystem transfer_system(const VectorView& B, const VectorView& A) {
    const SingleInputSystem derivatives = derivatives_filter(A, B.size() - 1);
    return {derivatives.A, derivatives.B, B.transpose() * derivatives.C, Vector::Constant(1, B.dot(derivatives.D))};
}

SingleInputSystem no_filter() {
    return {Matrix(0, 0), Vector(0), Matrix(1, 0), Vector::Ones(1)};
}

Matrix chain_products(const std::vector<FilterChain>& chains, const Sampling& sampling, const std::vector<Index>& left,
                      const std::vector<Index>& right, const std::vector<OutputSum>& sums) {
    if (sampling.Ts > 0) {
        std::vector<FilteredSignal> signals;
        signals.reserve(chains.size());
        for (const FilterChain& chain : chains) signals.push_back({sampled(chain, sampling.Ts), chain.signal});
        return filter_products(signals, left, right, sums);
    }
    Index count = static_cast<Index>(sums.size());
    for (const FilterChain& chain : chains) count += chain.filter.C.rows();
    Matrix outputs(sampling.t.size(), count);
    Index place = 0;
    for (const FilterChain& chain : chains) {
        outputs.middleCols(place, chain.filter.C.rows()) = chain_outputs(chain, sampling);
        place += chain.filter.C.rows();
    }
    return stored_products(outputs, left, right, sums);
}

}  // namespace dynlab::inline numerics
