#include "numerics/fit/closed_loop/loop_equations.h"

#include "numerics/criteria/estimating_terms.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/statistics/robust_covariance.h"

namespace dynlab::inline numerics {

Vector LoopEquations::solution(double* condition_number) const {
    return solve_equations({Z.transpose() * Phi, Z.transpose() * y, Matrix(), 0}, condition_number);
}

Matrix LoopEquations::covariance(const VectorView& theta) const {
    const Index d = theta.size();
    const Matrix inverse = solve_by_lu(Z.transpose() * Phi, Matrix::Identity(d, d)).x;
    return robust_covariance(inverse, Z, y - Phi * theta, lengths).covariance;
}

LoopEquations loop_equations(const DenominatorGroup& group, const VectorView& E, const LoopSignals::All& signals) {
    const Index N = group.sample_count(), d = group.parameter_count();
    LoopEquations all{Matrix(N, d), Matrix(N, d), Vector(N), {}};
    Index first = 0;
    for (std::size_t e = 0; e < group.members().size(); ++e) {
        const RegressionData& measured = group.members()[e].data_set;
        const LoopSignals::Signals& own = signals.experiments[e];
        const Index count = measured.y.size();
        const FilteredEquation equation = filtered_equation(measured, E);
        const RegressionData clean{{own.x.data(), count}, {{own.u.data(), count}}, measured.zeros, measured.delays,
                                   measured.sampling,     measured.hold,           measured.hold_y};
        all.Phi.middleRows(first, count) = equation.Phi;
        all.y.segment(first, count) = equation.y;
        all.Z.middleRows(first, count) = filtered_equation(clean, E).Phi;
        all.lengths.push_back(count);
        first += count;
    }
    return all;
}

}  // namespace dynlab::inline numerics
