#include "numerics/criteria/response_prior.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

/// r^|i - j| falls as the square root of a does in "TC".
double correlation_of(const ResponsePrior& prior) {
    return prior.kernel == ResponseKernel::kTc ? std::sqrt(prior.decay) : prior.correlation;
}

/// L of K = L L'. "TC" and "DC" are first-order autoregressions whose weight decays, so that products with L' are
/// running sums.
class KernelRoot {
  public:
    KernelRoot(const ResponsePrior& prior, Index size) : correlation_(correlation_of(prior)), weights_(size) {
        const bool spline = prior.kernel == ResponseKernel::kSs;
        for (Index i = 0; i < size; ++i)
            weights_[i] = std::pow(prior.decay, (spline ? 1.5 : 0.5) * static_cast<double>(i));
        if (!spline) return;
        // without its decay the kernel keeps its digits
        const Vector inverse = weights_.cwiseInverse();
        Matrix scaled = inverse.asDiagonal() * prior_kernel(prior, size) * inverse.asDiagonal();
        for (double more = 0;; more = std::max(1e-15, 10 * more)) {
            scaled.diagonal() *= 1 + more;
            if (const auto root = cholesky_root(scaled)) {
                dense_ = weights_.asDiagonal() * *root;
                return;
            }
        }
    }

    Matrix transposed_times(const Matrix& M) const {
        if (dense_.size() > 0) return dense_.transpose() * M;
        Matrix product = weights_.asDiagonal() * M;
        for (Index i = product.rows() - 2; i >= 0; --i) product.row(i) += correlation_ * product.row(i + 1);
        product.bottomRows(product.rows() - 1) *= std::sqrt(1 - correlation_ * correlation_);
        return product;
    }
    /// L'GL for a symmetric G.
    Matrix inside(const Matrix& G) const {
        const Matrix half = transposed_times(G);
        return transposed_times(half.transpose());
    }

  private:
    double correlation_;
    Vector weights_;
    Matrix dense_;
};

/// -2 log of the marginal likelihood as a function of kappa = c/sigma^2 alone: with the tridiagonal T of L'Phi'Phi L
/// and b of L'Phi'y,
///     sigma^2 = (y'y - kappa b'(I + kappa T)^-1 b)/N,   N log sigma^2 + log det(I + kappa T).
struct Evidence {
    TridiagonalForm form;
    double energy, count;

    /// Noise variance, and the loss.
    std::pair<double, double> at(double kappa) const {
        const Vector &d = form.diagonal, &s = form.beside, &b = form.rotated;
        double determinant = 0, explained = 0, pivot = 1, rest = 0;
        for (Index i = 0; i < d.size(); ++i) {  // L D L' of I + kappa T, and with it the quadratic form
            const double beside = i > 0 ? kappa * s[i - 1] : 0, ratio = beside / pivot;
            pivot = std::max(1 + kappa * d[i] - beside * ratio, 1e-300);
            rest = b[i] - ratio * rest;
            determinant += std::log(pivot);
            explained += rest * rest / pivot;
        }
        const double variance = std::max((energy - kappa * explained) / count, 1e-14 * energy / count);
        return {variance, count * std::log(variance) + determinant};
    }
};

constexpr double kGolden = 0.6180339887498949;

/// Where f is smallest between low and high, by golden section.
template <class F>
double golden_section(double low, double high, int steps, const F& f) {
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = f(left), at_right = f(right);
    for (int i = 0; i < steps; ++i) {
        if (at_left < at_right) {
            high = right, right = left, at_right = at_left;
            left = high - kGolden * (high - low), at_left = f(left);
        } else {
            low = left, left = right, at_left = at_right;
            right = low + kGolden * (high - low), at_right = f(right);
        }
    }
    return at_left < at_right ? left : right;
}

/// Smallest loss over kappa: a scan over decades, then golden section. Returns kappa.
double best_ratio(const Evidence& evidence) {
    const double unit = 1 / std::max(evidence.form.diagonal.maxCoeff(), 1e-300);
    const auto loss = [&](double exponent) { return evidence.at(unit * std::pow(10, exponent)).second; };
    double best = 0, smallest = kInfinity;
    for (int i = -8; i <= 48; ++i)
        if (const double own = loss(0.5 * i); own < smallest) smallest = own, best = 0.5 * i;
    return unit * std::pow(10, golden_section(best - 0.5, best + 0.5, 40, loss));
}

Evidence evidence_of(const ResponseSums& sums, const ResponsePrior& prior) {
    const KernelRoot root(prior, sums.gram.rows());
    return {tridiagonal_form(root.inside(sums.gram), root.transposed_times(sums.projection)), sums.energy, sums.count};
}

/// The decay of a prior that falls to a thousandth within exp(log_span) times the response's length.
double decay_of(double log_span, Index size) {
    return std::exp(std::log(1e-3) / (std::exp(log_span) * static_cast<double>(size)));
}

/// The prior at a place of the search: the span, and the logarithm of log r/log sqrt(a).
ResponsePrior prior_at(ResponseKernel kernel, double log_span, double log_power, Index size) {
    ResponsePrior prior{kernel, decay_of(log_span, size)};
    prior.correlation = std::pow(prior.decay, 0.5 * std::exp(log_power));
    return prior;
}

}  // namespace

Matrix prior_kernel(const ResponsePrior& prior, Index size) {
    Matrix K(size, size);
    const double a = prior.decay;
    for (Index i = 0; i < size; ++i)
        for (Index j = 0; j < size; ++j) {
            const auto sum = static_cast<double>(i + j), larger = static_cast<double>(std::max(i, j));
            switch (prior.kernel) {
                case ResponseKernel::kTc:
                    K(i, j) = std::pow(a, larger);
                    break;
                case ResponseKernel::kDc:
                    K(i, j) = std::pow(a, sum / 2) * std::pow(prior.correlation, std::abs(i - j));
                    break;
                case ResponseKernel::kSs:
                    K(i, j) = std::pow(a, sum + larger) / 2 - std::pow(a, 3 * larger) / 6;
                    break;
            }
        }
    return K;
}

double prior_loss(const ResponseSums& sums, ResponsePrior& prior) {
    const Evidence evidence = evidence_of(sums, prior);
    prior.ratio = best_ratio(evidence);
    return evidence.at(prior.ratio).second;
}

ResponsePrior most_likely_prior(const ResponseSums& sums, ResponseKernel kernel) {
    constexpr int kSpans = 16, kRefinements = 8;
    const double first = std::log(0.1), last = std::log(10.0), step = (last - first) / (kSpans - 1);
    const Index size = sums.gram.rows();
    const auto loss_at = [&](double log_span, double log_power) {
        ResponsePrior prior = prior_at(kernel, log_span, log_power, size);
        return prior_loss(sums, prior);
    };
    Vector losses(kSpans);
    tbb::parallel_for(0, kSpans, [&](int i) { losses[i] = loss_at(first + step * i, 0); });
    Index place = 0;
    losses.minCoeff(&place);
    double log_span = first + step * static_cast<double>(place), log_power = 0;
    const int turns = kernel == ResponseKernel::kDc ? 2 : 1;
    for (int turn = 0; turn < turns; ++turn) {
        if (kernel == ResponseKernel::kDc)
            log_power = golden_section(-4, 3, 2 * kRefinements, [&](double power) { return loss_at(log_span, power); });
        log_span = golden_section(log_span - step, log_span + step, kRefinements,
                                  [&](double span) { return loss_at(span, log_power); });
    }
    ResponsePrior prior = prior_at(kernel, log_span, log_power, size);
    prior_loss(sums, prior);
    return prior;
}

ResponsePosterior response_posterior(const ResponseSums& sums, const ResponsePrior& prior) {
    const Index size = sums.gram.rows();
    const KernelRoot root(prior, size);
    const Matrix inside = root.inside(sums.gram), Lt = root.transposed_times(Matrix::Identity(size, size));
    const Evidence evidence{tridiagonal_form(inside, Lt * sums.projection), sums.energy, sums.count};
    const auto [values, vectors] = symmetric_eigen(inside);
    const Vector d = values.cwiseMax(0), shrink = prior.ratio / (1 + prior.ratio * d.array());
    const Matrix LU = Lt.transpose() * vectors;
    ResponsePosterior posterior;
    posterior.noise_variance = evidence.at(prior.ratio).first;
    posterior.scale = prior.ratio * posterior.noise_variance;
    posterior.mean = LU * shrink.cwiseProduct(LU.transpose() * sums.projection);
    posterior.covariance = posterior.noise_variance * (LU * shrink.asDiagonal() * LU.transpose());
    posterior.null_std = (posterior.noise_variance * (LU.cwiseAbs2() * shrink.cwiseAbs2().cwiseProduct(d))).cwiseSqrt();
    return posterior;
}

}  // namespace dynlab::inline numerics
