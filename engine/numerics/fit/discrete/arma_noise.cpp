#include "numerics/fit/discrete/arma_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numerics/criteria/arx_equations.h"
#include "numerics/criteria/prediction_error_products.h"
#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/triangular_factor.h"
#include "numerics/signals/lagged_gram.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kStartGramLimit = 1e5;  // beyond this condition number a start by sums of products loses digits
constexpr double kMaxRoot = 0.98;        // of a start whose root lies on the unit circle

/// w/C of one signal, from rest.
void divide(const Vector& C, Eigen::Ref<Vector> w) {
    const Index nc = C.size() - 1;
    if (nc == 0) return;
    for (Index k = 1; k < std::min(nc, w.size()); ++k)
        for (Index j = 1; j <= k; ++j) w[k] -= C[j] * w[k - j];
    for (Index k = nc; k < w.size(); ++k) {
        double value = w[k];
        for (Index j = nc; j >= 1; --j) value -= C[j] * w[k - j];
        w[k] = value;
    }
}

/// x late by `lag` samples, zero up to the sample `first`.
Vector lagged(const Vector& x, Index lag, Index first) {
    Vector late = Vector::Zero(x.size());
    const Index from = std::max(lag, first);
    if (from < x.size()) late.tail(x.size() - from) = x.segment(from - lag, x.size() - from);
    return late;
}

/// The one-step prediction of v as a function of [c d], for the output-error search: v minus it is e.
class Prediction : public OutputErrorModel {
  public:
    Prediction(const std::vector<Vector>& data_sets, int nc, int nd) : data_sets_(data_sets), nc_(nc), nd_(nd) {
        set_free(nc + nd);
        for (const Vector& data_set : data_sets) samples_ += data_set.size();
    }

    ArmaNoise noise(const Vector& theta) const {
        ArmaNoise noise;
        noise.C = monic(theta.head(nc_));
        noise.D = monic(theta.tail(nd_));
        return noise;
    }

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        output = Vector::Constant(samples_, std::numeric_limits<double>::quiet_NaN());
        if (sensitivities != nullptr) *sensitivities = Matrix::Zero(samples_, theta.size());
        if (!theta.allFinite()) return;
        const ArmaNoise at = noise(theta);
        if (!inside_unit_circle(at.C) || !inside_unit_circle(at.D)) return;
        Index row = 0;
        for (const Vector& v : data_sets_) {
            const Vector e = whitened(at, v);
            output.segment(row, v.size()) = v - e;
            if (sensitivities != nullptr) sensitivities->middleRows(row, v.size()) = noise_sensitivities(at, v, e);
            row += v.size();
        }
    }

    bool products_are_cheap() const override { return true; }
    OutputErrorProducts products(const Vector& theta, const VectorView& y) const override {
        const Index d = theta.size();
        OutputErrorProducts sums{kNaN, Matrix::Zero(d, d), Vector::Constant(d, kNaN)};
        if (!theta.allFinite()) return sums;
        const ArmaNoise at = noise(theta);
        if (!inside_unit_circle(at.C) || !inside_unit_circle(at.D)) return sums;
        sums.squares = 0;
        sums.descent.setZero();
        std::vector<Index> places(static_cast<std::size_t>(d) + 1);
        std::iota(places.begin(), places.end(), Index{-1});
        Index row = 0;
        for (const Vector& v : data_sets_) {
            const Matrix all =
                prediction_error_products({}, {y.segment(row, v.size()), 0, 1, 0}, 0, v.size(), at.C, at.D);
            add_to(sums, all, places);
            row += v.size();
        }
        return sums;
    }

  private:
    const std::vector<Vector>& data_sets_;
    Index nc_, nd_, samples_ = 0;
};

/// The triangular factor of the regression below, block by block: for signals whose lags are nearly dependent.
Matrix regression_factor(const std::vector<Vector>& v, const std::vector<Vector>& e, Index nc, Index nd, Index first) {
    constexpr Index kBlock = 1024;
    TriangularFactor factor(nc + nd + 1);
    Matrix block(kBlock, nc + nd + 1);
    for (std::size_t r = 0; r < v.size(); ++r)
        for (Index k = first; k < v[r].size(); k += kBlock) {
            const Index rows = std::min(kBlock, v[r].size() - k);
            for (Index j = 1; j <= nc; ++j) block.col(j - 1).head(rows) = e[r].segment(k - j, rows);
            for (Index i = 1; i <= nd; ++i) block.col(nc + i - 1).head(rows) = -v[r].segment(k - i, rows);
            block.col(nc + nd).head(rows) = v[r].segment(k, rows);
            factor.add(block.topRows(rows));
        }
    return factor.R();
}

/// Regression of v(k) on its past (`nd` lags) and that of e (`nc` lags), from sample `first` of each experiment on.
Vector regress(const std::vector<Vector>& v, const std::vector<Vector>& e, Index nc, Index nd, Index first) {
    Index rows = 0;
    for (const Vector& data_set : v) rows += std::max<Index>(0, data_set.size() - first);
    if (rows <= nc + nd)
        throw InvalidArgument(
            "the noise model needs longer experiments: at least {} samples are required, not counting the first {} of "
            "each experiment, but the number is {}",
            nc + nd + 1, first, rows);
    Matrix gram = Matrix::Zero(nc + nd + 1, nc + nd + 1);
    for (std::size_t r = 0; r < v.size(); ++r)
        gram += lagged_gram({{e[r], 1, nc, 1}, {v[r], 1, nd, -1}, {v[r], 0, 1, 1}}, first, v[r].size() - first);
    const ArxSolution quick = solve_gram(gram);
    if (quick.condition_number < kStartGramLimit) return quick.theta;
    const Matrix R = regression_factor(v, e, nc, nd, first);
    return solve_least_squares(R.leftCols(nc + nd), R.col(nc + nd)).solution;
}

/// Hannan and Rissanen: e from a long autoregression, then v on the past of both.
Vector regression_start(const std::vector<Vector>& data_sets, Index nc, Index nd) {
    std::vector<Vector> e = data_sets;
    Index first = nd;
    if (nc > 0) {
        Index longest = 0;
        for (const Vector& data_set : data_sets) longest = std::max(longest, data_set.size());
        const Index requested = std::max<Index>(2 * (nc + nd), static_cast<Index>(10 * std::log10(longest)));
        const Index order = std::min(requested, longest / 4);
        ArmaNoise autoregression = ArmaNoise::white(0, static_cast<int>(order));
        autoregression.D = monic(regress(data_sets, data_sets, 0, order, order));
        for (std::size_t r = 0; r < data_sets.size(); ++r) e[r] = whitened(autoregression, data_sets[r]);
        first = std::max(nd, order + nc);
    }
    Vector theta = regress(data_sets, e, nc, nd, first);
    theta.head(nc) = reflect_roots_into_unit_circle(monic(theta.head(nc))).tail(nc);
    theta.tail(nd) = reflect_roots_into_unit_circle(monic(theta.tail(nd))).tail(nd);
    return theta;
}

}  // namespace

bool inside_unit_circle(const Vector& p) {
    return p.size() == 1 || roots(p).cwiseAbs().maxCoeff() < 1;
}

Vector reflect_roots_into_unit_circle(const Vector& p) {
    if (inside_unit_circle(p)) return p;
    ComplexVector z = roots(p);
    for (Complex& root : z) {
        if (std::abs(root) > 1) root = 1.0 / std::conj(root);
        if (std::abs(root) > kMaxRoot) root *= kMaxRoot / std::abs(root);
    }
    return polynomial_from_roots(z);
}

ArmaNoise ArmaNoise::white(int nc, int nd) {
    return {Vector::Unit(nc + 1, 0), Vector::Unit(nd + 1, 0), Matrix::Zero(nc + nd, nc + nd), 0,
            Termination::kConverged};
}

Matrix whitened(const ArmaNoise& noise, const MatrixView& v) {
    const Index N = v.rows(), nd = noise.D.size() - 1;
    Matrix e = Matrix::Zero(N, v.cols());
    if (N <= nd) return e;
    for (Index column = 0; column < v.cols(); ++column) {
        for (Index i = 0; i <= nd; ++i)
            e.col(column).tail(N - nd) += noise.D[i] * v.col(column).segment(nd - i, N - nd);
        divide(noise.C, e.col(column));
    }
    return e;
}

Matrix noise_sensitivities(const ArmaNoise& noise, const VectorView& v, const VectorView& e) {
    const Index nc = noise.C.size() - 1, nd = noise.D.size() - 1;
    Matrix J(v.size(), nc + nd);
    for (Index j = 1; j <= nc; ++j) J.col(j - 1) = lagged(e, j, nd);
    for (Index i = 1; i <= nd; ++i) J.col(nc + i - 1) = -lagged(v, i, nd);
    for (Index i = 0; i < J.cols(); ++i) divide(noise.C, J.col(i));
    return J;
}

ArmaNoise estimate_arma(const std::vector<Vector>& data_sets, int nc, int nd, double tolerance,
                        const ArmaNoise* start) {
    if (nc < 0 || nd < 0) throw InvalidArgument("nc and nd, the orders of the noise model, must be nonnegative");
    double squares = 0;
    Index used = 0;
    Vector v(0);
    for (const Vector& data_set : data_sets) {
        used += std::max<Index>(0, data_set.size() - nd);
        v.conservativeResize(v.size() + data_set.size());
        v.tail(data_set.size()) = data_set;
    }
    ArmaNoise noise = ArmaNoise::white(nc, nd);
    Fit solution;
    if (nc + nd > 0) {
        const Prediction prediction(data_sets, nc, nd);
        Vector first(nc + nd);
        if (start != nullptr)
            first << start->C.tail(nc), start->D.tail(nd);
        else
            first = regression_start(data_sets, nc, nd);
        solution = minimize_output_error(prediction, v, first, FitOptions{}.limited(100, tolerance));
        noise = prediction.noise(solution.theta);
        noise.termination = solution.termination;
    }
    for (const Vector& data_set : data_sets) squares += whitened(noise, data_set).squaredNorm();
    noise.variance = squares / static_cast<double>(used - nc - nd);
    noise.covariance = Matrix::Zero(nc + nd, nc + nd);
    if (nc + nd > 0 && solution.noise_variance[0] > 0)
        noise.covariance = noise.variance / solution.noise_variance[0] * solution.covariance;
    return noise;
}

}  // namespace dynlab::inline numerics
