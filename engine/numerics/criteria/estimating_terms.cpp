#include "numerics/criteria/estimating_terms.h"

#include <optional>

#include "numerics/filters/filter_chain.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

FilteredEquation filtered_equation(const RegressionData& data_set, const VectorView& E, double gain) {
    const Index n = E.size() - 1;
    const Matrix output =
        gain * chain_outputs({data_set.y, derivatives_filter(E, n), data_set.hold_y}, data_set.sampling);
    Index d = n;
    for (const int m : data_set.zeros) d += m + 1;
    FilteredEquation equation{output.col(0), Matrix(data_set.y.size(), d)};
    equation.Phi.leftCols(n) = -output.rightCols(n);
    Index first = n;
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        const Index count = data_set.zeros[j] + 1;
        const FilterChain chain{data_set.u[j], derivatives_filter(E, data_set.zeros[j]), data_set.hold,
                                data_set.delays[j]};
        equation.Phi.middleCols(first, count) = gain * chain_outputs(chain, data_set.sampling);
        first += count;
    }
    return equation;
}

namespace {

/// -p^(n-1) x_f .. -x_f of the model's output x, filtered as y is.
Matrix auxiliary_instruments(const RegressionData& data_set, const VectorView& E, double gain,
                             const CommonDenominator& model) {
    const Index n = E.size() - 1;
    Matrix Z = Matrix::Zero(data_set.y.size(), n);
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        FilterChain chain{data_set.u[j], derivatives_filter(E, n - 1), data_set.hold_y};
        chain.front = FrontModel{transfer_system(model.B[j], model.A), data_set.hold, data_set.delays[j]};
        Z -= gain * chain_outputs(chain, data_set.sampling);
    }
    return Z;
}

Vector coefficients(const CommonDenominator& model, Index count) {
    Vector theta(count);
    theta.head(model.A.size() - 1) = model.A.tail(model.A.size() - 1);
    Index first = model.A.size() - 1;
    for (const Vector& b : model.B) {
        theta.segment(first, b.size()) = b;
        first += b.size();
    }
    return theta;
}

Vector output_errors(const RegressionData& data_set, const CommonDenominator& model) {
    Vector errors = data_set.y;
    for (std::size_t j = 0; j < data_set.u.size(); ++j)
        errors -=
            chain_outputs({data_set.u[j], transfer_system(model.B[j], model.A), data_set.hold, data_set.delays[j]},
                          data_set.sampling);
    return errors;
}

/// Columns filtered by A/E from the last sample to the first. From rest a filter of regular samples is a lower
/// triangular Toeplitz matrix, whose transpose runs backwards.
Matrix filtered_backwards(const RegressionData& data_set, const VectorView& A, const VectorView& E, const Matrix& Z) {
    const Matrix reversed = Z.colwise().reverse();
    Matrix filtered(Z.rows(), Z.cols());
    for (Index i = 0; i < Z.cols(); ++i)
        filtered.col(i) =
            chain_outputs({SampleView(reversed.col(i).data(), reversed.rows()), transfer_system(A, E), data_set.hold_y},
                          data_set.sampling);
    return filtered.colwise().reverse();
}

}  // namespace

EstimatingTerms estimating_terms(const RegressionData& data_set, const VectorView& E, double gain,
                                 const CommonDenominator& model, const CommonDenominator* instrument) {
    FilteredEquation equation = filtered_equation(data_set, E, gain);
    EstimatingTerms terms{equation.Phi, {}};
    if (instrument) terms.Z.leftCols(E.size() - 1) = auxiliary_instruments(data_set, E, gain, *instrument);
    const bool stable = (roots(model.A).real().array() < 0).all();
    if (data_set.sampling.Ts > 0 && stable) {
        terms.Z = gain * filtered_backwards(data_set, model.A, E, terms.Z);
        terms.errors = output_errors(data_set, model);
    } else {
        terms.errors = equation.y - equation.Phi * coefficients(model, equation.Phi.cols());
    }
    return terms;
}

EstimatingTerms estimating_terms(const DenominatorGroup& group, const VectorView& E, double gain, const Vector& theta,
                                 const Vector* instrument) {
    EstimatingTerms all{Matrix::Zero(group.sample_count(), group.parameter_count()), Vector(group.sample_count())};
    Index first = 0;
    for (const DenominatorGroup::Member& member : group.members()) {
        const auto model = [&](const Vector& of) {
            return CommonDenominator{group.denominator(of), group.numerators(member, of)};
        };
        std::optional<CommonDenominator> auxiliary;
        if (instrument) auxiliary = model(*instrument);
        const EstimatingTerms own =
            estimating_terms(member.data_set, E, gain, model(theta), auxiliary ? &*auxiliary : nullptr);
        const Index length = own.errors.size();
        all.Z(Eigen::seqN(first, length), member.places) = own.Z;
        all.errors.segment(first, length) = own.errors;
        first += length;
    }
    return all;
}

}  // namespace dynlab::inline numerics
