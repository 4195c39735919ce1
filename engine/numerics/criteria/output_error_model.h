#pragma once
#include "numerics/linalg/tall_gram.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Sums over all samples of the errors e = y - output and the sensitivities J of the output (N x d).
struct OutputErrorProducts {
    double squares = 0;  ///< e'e
    Matrix gram;         ///< J'J
    Vector descent;      ///< J'e
};

/// A model whose output depends smoothly on parameters: what an output-error method minimizes over. Implemented by
/// each structure (process models, transfer functions); the search (fit/output_error.h) knows nothing else of it.
class OutputErrorModel {
  public:
    virtual ~OutputErrorModel() = default;

    Index parameter_count() const { return lower_.size(); }
    /// Closed bounds of each parameter (infinite when free); the search never evaluates outside them.
    const Vector& lower() const { return lower_; }
    const Vector& upper() const { return upper_; }
    /// Simulated output (N) and, when wanted, its derivatives with respect to the parameters (N x d).
    virtual void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const = 0;
    Vector output_at(const Vector& theta) const;  ///< simulate() without derivatives
    /// The sums against the measured `y` (N), for which a model need not store J: what each step of a search needs. By
    /// simulate() unless a structure knows a faster way; a model may take the `y` it was made of for granted.
    virtual OutputErrorProducts products(const Vector& theta, const VectorView& y) const;
    /// Rows that are zero for every theta, and in what is fitted: they do not count as samples.
    virtual Index masked_rows() const { return 0; }
    /// Whether they cost little more than the output alone, so that a search asks for them before it knows whether it
    /// will go there.
    virtual bool products_are_cheap() const { return false; }

  protected:
    void set_free(Index count) {
        lower_ = Vector::Constant(count, -kInfinity);
        upper_ = Vector::Constant(count, kInfinity);
    }

    Vector lower_, upper_;
};

inline Vector OutputErrorModel::output_at(const Vector& theta) const {
    Vector output;
    simulate(theta, output, nullptr);
    return output;
}

inline OutputErrorProducts OutputErrorModel::products(const Vector& theta, const VectorView& y) const {
    Vector errors;
    Matrix J;
    simulate(theta, errors, &J);
    errors = y - errors;
    const Index d = J.cols();
    const Matrix sums = tall_gram(J, errors);
    return {sums(d, d), sums.topLeftCorner(d, d), sums.col(d).head(d)};
}

}  // namespace dynlab::inline numerics
