#pragma once
#include <cmath>

#include "numerics/fit/recursive/error_variance.h"
#include "numerics/fit/recursive/product_color.h"
#include "numerics/fit/recursive/small_equations.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

/// The equations sum_k w(k) z(k) (y(k) - phi(k)' theta) = 0, added one at a time, in the form
///     Q' [Z | Phi | y] = [R | C | c],  R upper triangular, Q orthogonal,
/// of the weighted rows: a new row is rotated into the array (Givens), so that nothing is ever inverted or subtracted,
/// and theta = C^-1 c is the batch estimate to rounding at every sample, from an exactly diffuse start. Its covariance
/// variance (C'C)^-1 = variance (Z'Phi)^-1 Z'Z (Phi'Z)^-1 for white errors is positive whatever happened before, and so
/// is variance C^-1 T C^-T for colored ones, T from the sums of z e over blocks of samples (product_color.h). Where
/// weights w(k) forget, both are multiplied by sum w(k)^2/sum w(k): 1/2 for a long memory (Ljung 1999, section 11.2).
/// With z = phi, C is R and this is the square-root information filter of least squares (Bierman 1977, chapter V).
/// Sizes: kCount parameters, or with Eigen::Dynamic as many as the constructor says.
template <int kCount, bool kInstruments>
class InstrumentArray {
  public:
    static constexpr std::size_t kMax = kCount > 0 ? kCount : 17;
    using Row = SmallRow<kMax>;

    /// `block`: samples that outlast the memory of colored errors.
    explicit InstrumentArray(int count, double block = 1) : count_(count), color_(block) {}

    /// Adds a row. The weights of all earlier rows are multiplied by `forgetting`, unless the new row has almost no
    /// information. Otherwise earlier information would be lost without a replacement.
    void add(Row z, Row phi, double y, double forgetting) {
        const std::size_t d = size();
        const Row given_z = z, given_phi = phi;
        const double given_y = y;
        if (forgetting < 1) scale(std::sqrt(forgetting));
        double kept = 1;  // product of the cosines: 1/(1 + z' (R'R)^-1 z)
        for (std::size_t i = 0; i < d; ++i) {
            if (z[i] == 0) continue;
            const double length = std::sqrt(R_[i][i] * R_[i][i] + z[i] * z[i]);
            const double reciprocal = 1 / length, cosine = R_[i][i] * reciprocal, sine = z[i] * reciprocal;
            kept *= cosine * cosine;
            R_[i][i] = length;
            for (std::size_t j = i + 1; j < d; ++j) rotate(cosine, sine, R_[i][j], z[j]);
            if constexpr (kInstruments)
                for (std::size_t j = 0; j < d; ++j) rotate(cosine, sine, C_[i][j], phi[j]);
            rotate(cosine, sine, c_[i], y);
        }
        const bool silent = forgetting < 1 && 1 - kept < kSilent * (1 - forgetting);
        if (silent) scale(1 / std::sqrt(forgetting));
        solve();
        double left = y;
        if constexpr (kInstruments)
            for (std::size_t j = 0; j < d; ++j) left -= phi[j] * theta_[j];
        if (!silent) memory_.add(forgetting);
        errors_.add(left, silent ? 1 : forgetting, known_);
        if constexpr (kInstruments) {
            if (!known_) return;
            double error = given_y;
            for (std::size_t j = 0; j < d; ++j) error -= given_phi[j] * theta_[j];
            color_.add(given_z, error, d, silent ? 1 : forgetting);
        }
    }

    /// The parameters walk: their covariance grows by variance times diag(steps), theta stays.
    void walk(const Row& steps) {
        walks_ = true;
        const std::size_t d = size();
        Square U{};  // I + C diag(steps) C' = U U'
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t j = 0; j < d; ++j) {
                U[i][j] = i == j ? 1 : 0;
                for (std::size_t l = 0; l < d; ++l) U[i][j] += regressors(i, l) * steps[l] * regressors(j, l);
            }
        upper_root(U, d);
        for (std::size_t i = d; i-- > 0;) {
            for (std::size_t j = i + 1; j < d; ++j) take_off(i, j, U[i][j]);
            multiply_row(i, 1 / U[i][i]);
        }
    }

    bool known() const { return known_; }        ///< theta is determined
    const Row& theta() const { return theta_; }  ///< of the last sample that determined it
    /// Of the errors; infinite without more rows than parameters. Least squares: that of all rows and the last theta,
    /// to rounding. Instruments: of the last half to three quarters of the rows, each with its current theta, because
    /// the first errors belong to a theta that is still imprecise.
    double variance() const { return known_ ? errors_.value(count_) : kInfinity; }
    /// (C'C)^-1, d x d; without meaning unless known.
    Matrix inverse_gram() const {
        const Matrix inverse = inverse_regressors();
        return inverse * inverse.transpose();
    }
    /// Of theta: with instruments for errors of any color; of least squares and a Kalman filter for white ones.
    Matrix covariance() const {
        const double scale = variance() * memory_.factor();
        if (!kInstruments || walks_) return scale * inverse_gram();
        const Matrix inverse = inverse_regressors();
        return scale * inverse * color_.ratio(count_) * inverse.transpose();
    }

    /// Whether white errors leave the first `count` parameters standard errors of no more than `part` of themselves.
    bool known_to(double part, std::size_t count) const {
        Square inverse;
        if (!known_ || !invert_small(kInstruments ? C_ : R_, size(), inverse)) return false;
        for (std::size_t i = 0; i < count; ++i) {
            double squares = 0;
            for (std::size_t j = 0; j < size(); ++j) squares += inverse[i][j] * inverse[i][j];
            if (!(variance() * squares <= part * part * theta_[i] * theta_[i])) return false;
        }
        return true;
    }

  private:
    using Square = SmallMatrix<kMax>;
    static constexpr double kSilent = 1e-6;

    Matrix inverse_regressors() const {
        const Index d = count_;
        Matrix C(d, d);
        for (Index k = 0; k < d * d; ++k)
            C(k / d, k % d) = regressors(static_cast<std::size_t>(k / d), static_cast<std::size_t>(k % d));
        return solve_by_lu(C, Matrix::Identity(d, d)).x;
    }

    std::size_t size() const { return static_cast<std::size_t>(kCount > 0 ? kCount : count_); }
    double regressors(std::size_t i, std::size_t j) const {
        if constexpr (kInstruments) return C_[i][j];
        return j < i ? 0 : R_[i][j];
    }
    void multiply_row(std::size_t i, double factor) {
        for (std::size_t j = i; j < size(); ++j) R_[i][j] *= factor;
        if constexpr (kInstruments)
            for (std::size_t j = 0; j < size(); ++j) C_[i][j] *= factor;
        c_[i] *= factor;
    }
    void scale(double factor) {
        for (std::size_t i = 0; i < size(); ++i) multiply_row(i, factor);
    }
    void take_off(std::size_t i, std::size_t j, double factor) {
        for (std::size_t l = j; l < size(); ++l) R_[i][l] -= factor * R_[j][l];
        if constexpr (kInstruments)
            for (std::size_t l = 0; l < size(); ++l) C_[i][l] -= factor * C_[j][l];
        c_[i] -= factor * c_[j];
    }

    /// theta of C theta = c; it stays where C is singular.
    void solve() {
        known_ = kInstruments ? solve_small(C_, c_, size(), theta_) : solve_triangular(R_, c_, size(), theta_);
    }

    int count_;
    Square R_{}, C_{};
    Row c_{}, theta_{};
    ErrorVariance<kInstruments> errors_;
    FadingWeights memory_;
    ProductColor<kMax> color_;
    bool known_ = false, walks_ = false;
};

}  // namespace dynlab::inline numerics
