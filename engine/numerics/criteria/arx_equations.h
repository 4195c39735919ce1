#pragma once
#include <algorithm>
#include <vector>

#include "numerics/linalg/types.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The equations [Phi y] of A y = B u + e over all experiments: a row [-y(k-1) .. u(k-nk) .. y(k)] for each sample
/// whose whole past is recorded, made block by block and never stored. Keeps references to data and orders.
class ArxEquations {
  public:
    ArxEquations(const IdData& data, const PolynomialOrders& orders) : data_(data), orders_(orders) {}

    Index count() const;
    Index parameters() const { return orders_.parameter_count(); }

    /// Calls use(block) with up to kBlock rows at a time.
    template <class Use>
    void for_each_block(Use use) const {
        Matrix block(kBlock, parameters() + 1);
        for (const Experiment& experiment : data_.experiments)
            for (Index k = orders_.past(); k < experiment.y.rows(); k += kBlock) {
                const Index rows = std::min(kBlock, experiment.y.rows() - k);
                fill(experiment, k, rows, block);
                use(block.topRows(rows));
            }
    }

    /// [Phi y]'[Phi y], or with the Phi of other equations as instruments Z'[Phi y] and Z'Z. The other ones belong to
    /// data of the same lengths and to the same orders.
    Matrix gram() const;
    struct InstrumentProducts {
        Matrix with_equations, gram;  ///< d x (d + 1) and d x d
    };
    InstrumentProducts products(const ArxEquations& instruments) const;
    /// Triangular factor of [Phi y].
    Matrix triangular_factor() const;
    /// e = y - Phi theta, one vector per experiment; empty for an experiment that is too short.
    std::vector<Vector> errors(const VectorView& theta) const;

  private:
    static constexpr Index kBlock = 1024;  // rows worked on together: they stay in the processor's cache

    void fill(const Experiment& experiment, Index k, Index rows, Matrix& block) const;

    const IdData& data_;
    const PolynomialOrders& orders_;
};

struct ArxSolution {
    Vector theta;
    Matrix inverse_gram;
    double condition_number = 0;  ///< of the column-scaled Phi
};

/// From the sums [Phi y]'[Phi y], scaled: `theta` is right while the condition number is below about 1e6, the condition
/// number itself always.
ArxSolution solve_gram(const MatrixView& gram);

/// Solves the least-squares problem by the Gram matrix if its condition number is below 1e3, otherwise by the
/// triangular factor. If the data do not determine the parameters uniquely, the solution is the one of least scaled
/// norm.
ArxSolution solve_arx(const ArxEquations& equations);

/// The free run y(k) = driven(k) - a_1 y(k-1) - ... after the recorded first `known` samples of y.
Vector free_run(const VectorView& a, const VectorView& driven, const VectorView& y, Index known);

/// B u, the sum of all inputs' weighted past values, with zeros before the first sample (N values).
Vector driven_part(const PolynomialModel& model, const MatrixView& u);

}  // namespace dynlab::inline numerics
