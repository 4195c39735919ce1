#include "numerics/fit/discrete/sriv_iteration.h"

#include <array>
#include <cmath>
#include <numeric>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr std::array kFilterPoles = {0.9, 0.5, 0.98, 0.8, 0.95, 0.0};
constexpr int kStartIterations = 4;
constexpr double kStartTolerance = 1e-3, kSameLoss = 1e-4;
constexpr double kMinStepLength = 1.0 / 8, kRounding = 1e-9;

/// Lengths of columns by the sums of their squares; one for those without any.
Vector lengths_of(const Matrix& gram) {
    Vector scale = gram.diagonal().cwiseSqrt();
    for (double& value : scale)
        if (!(value > 0)) value = 1;
    return scale;
}

/// (Psi' Phi)^-1 Psi' e with the columns of both scaled to norm one; directions without weight stay where they are.
Vector instrumental_solution(const Matrix& psi_phi, const Vector& psi_e, const Vector& psi_lengths,
                             const Vector& phi_lengths) {
    const Vector left = psi_lengths.cwiseInverse(), right = phi_lengths.cwiseInverse();
    const Matrix system = left.asDiagonal() * psi_phi * right.asDiagonal();
    const Vector known = left.asDiagonal() * psi_e;
    return right.asDiagonal() * minimum_norm_solution(system, known);
}

struct Point {
    Vector theta;
    InstrumentProducts products;
    double loss = 0;
};

Point point_at(const DiscreteOutput& model, const Vector& y, const Vector& theta) {
    Point point{theta, model.instrument_products(theta, y), 0};
    const double loss = point.products.squares / static_cast<double>(y.size());
    point.loss = std::isfinite(loss) ? loss : kInfinity;
    return point;
}

/// Goes the step, or the half, quarter or eighth of it when the whole one raises the loss (and the eighth even if
/// it does). Returns whether poles were mirrored.
bool move(const DiscreteOutput& model, const Vector& y, const Vector& step, Point& here) {
    const Vector from = here.theta;
    const double loss = here.loss;
    for (double part = 1;; part /= 2) {
        const Vector requested = from + part * step, next = model.with_stable_poles(requested);
        here = point_at(model, y, next);
        if (here.loss <= loss * (1 + kRounding) || part <= kMinStepLength) return next != requested;
    }
}

/// Orders of one channel alone.
PolynomialOrders channel_orders(const PolynomialOrders& orders, std::size_t input) {
    return PolynomialOrders::output_error({orders.nb[input]}, {orders.nf[input]}, {orders.nk[input]});
}

/// Orders whose channels have all poles in common: B_i gets the poles of the other inputs as zeros.
PolynomialOrders common_orders(const PolynomialOrders& orders) {
    const int poles = std::accumulate(orders.nf.begin(), orders.nf.end(), 0);
    PolynomialOrders common = orders;
    for (std::size_t i = 0; i < orders.inputs(); ++i) {
        common.nb[i] = orders.nb[i] + poles - orders.nf[i];
        common.nf[i] = poles;
    }
    return common;
}

/// Equation-error least squares with one denominator for all inputs, prefiltered by 1/(1 - alpha q^-1)^n.
Vector common_least_squares(const DiscreteOutput& model, const Vector& y, double alpha) {
    const PolynomialOrders& orders = model.orders();
    const int n = orders.nf.front();
    Vector theta = Vector::Zero(model.parameter_count());
    const Vector filter = power(Eigen::Vector2d(1, -alpha), n).tail(n);
    for (std::size_t i = 0; i < orders.inputs(); ++i) theta.segment(orders.f_start(i), n) = filter;
    InstrumentProducts products = model.instrument_products(theta, y);
    for (std::size_t i = 1; i < orders.inputs(); ++i) {
        products.phi_phi.middleCols(orders.f_start(i), n).setZero();
        products.phi_phi.middleRows(orders.f_start(i), n).setZero();
        products.phi_e.segment(orders.f_start(i), n).setZero();
    }
    const Vector lengths = lengths_of(products.phi_phi);
    theta += instrumental_solution(products.phi_phi, products.phi_e, lengths, lengths);
    for (std::size_t i = 1; i < orders.inputs(); ++i)
        theta.segment(orders.f_start(i), n) = theta.segment(orders.f_start(0), n);
    return model.with_stable_poles(theta);
}

/// What each input does according to a model with a common denominator, fitted by a channel of the wanted orders.
Vector separated(const DiscreteOutput& model, const PolynomialModel& common, double alpha) {
    const PolynomialOrders& orders = model.orders();
    Vector theta = Vector::Zero(model.parameter_count());
    for (std::size_t i = 0; i < orders.inputs(); ++i) {
        std::vector<SampledExperiment> shares;
        for (const SampledExperiment& experiment : model.experiments()) {
            const Vector driven =
                all_pole_filter(common.F[i].tail(common.F[i].size() - 1), experiment.u.col(static_cast<Index>(i)));
            Vector share = Vector::Zero(driven.size());
            for (Index j = 0; j < std::min(common.B[i].size(), driven.size()); ++j)
                share.tail(driven.size() - j) += common.B[i][j] * driven.head(driven.size() - j);
            shares.push_back({experiment.u.col(static_cast<Index>(i)), share});
        }
        const PolynomialOrders alone = channel_orders(orders, i);
        const DiscreteOutput channel(alone, {InitialState::kZero, false}, shares);
        const Vector found = common_least_squares(channel, channel.target(), alpha);
        theta.segment(orders.f_start(i), alone.parameter_count()) = found;
    }
    return theta;
}

Vector candidate(const DiscreteOutput& model, const Vector& y, double alpha) {
    const PolynomialOrders& orders = model.orders();
    if (orders.inputs() == 1) return common_least_squares(model, y, alpha);
    const PolynomialOrders common = common_orders(orders);
    // An estimated state of the larger model would cost it samples: the start needs no more than an offset.
    const StartCondition condition{InitialState::kZero, model.condition().offset};
    const DiscreteOutput larger(common, condition, model.experiments());
    const Vector theta = common_least_squares(larger, larger.target(), alpha);
    if (!theta.allFinite()) return Vector::Constant(model.parameter_count(), kInfinity);
    return separated(model, PolynomialModel(common, theta.head(common.parameter_count()), 1), alpha);
}

}  // namespace

InstrumentSolution iterate_instruments(const DiscreteOutput& model, const Vector& y, const Vector& start,
                                       int max_iterations, double tolerance, const std::function<bool()>& cancel) {
    InstrumentSolution best;
    best.theta = start;
    Point here = point_at(model, y, start);
    best.loss = here.loss;
    const double spread = std::sqrt(model.target_variation());
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
        if (cancel && cancel()) {
            best.termination = Termination::kCanceled;
            return best;
        }
        const InstrumentProducts& products = here.products;
        const Vector lengths = lengths_of(products.psi_psi);
        const Vector step =
            instrumental_solution(products.psi_phi, products.psi_e, lengths, lengths_of(products.phi_phi));
        if (!step.allFinite()) {
            best.termination = Termination::kNoProgress;
            return best;
        }
        // Checked before poles are mirrored: a pole that leaves the circle in every pass has not settled.
        const Vector size = here.theta.cwiseAbs() + spread * lengths.cwiseInverse();
        const double change = step.cwiseAbs().cwiseQuotient(size).maxCoeff();
        best.reflected = move(model, y, step, here) || best.reflected;
        best.trace.push_back({{}, here.loss, change});
        const bool converged = change <= tolerance;
        if (here.loss < best.loss || converged) {
            best.theta = here.theta;
            best.loss = here.loss;
        }
        if (converged) {
            best.termination = Termination::kConverged;
            return best;
        }
    }
    return best;
}

Vector instrument_start(const DiscreteOutput& model, const Vector& y, const std::function<bool()>& cancel) {
    Vector best = Vector::Zero(model.parameter_count());
    double least = kInfinity;
    bool settled = false;  // the best one so far had converged
    for (const double alpha : kFilterPoles) {
        if (cancel && cancel()) break;
        const Vector start = candidate(model, y, alpha);
        if (!start.allFinite()) continue;
        const InstrumentSolution found =
            iterate_instruments(model, y, start, kStartIterations, kStartTolerance, cancel);
        const bool converged = found.termination == Termination::kConverged;
        const bool agree = settled && converged && std::abs(found.loss - least) <= kSameLoss * least;
        if (found.loss < least) {
            best = found.theta;
            least = found.loss;
            settled = converged;
        }
        if (agree) break;
    }
    return best;
}

}  // namespace dynlab::inline numerics
