#include "numerics/criteria/discrete_output.h"

#include <algorithm>
#include <complex>
#include <limits>
#include <numeric>

#include "numerics/filters/exact_filter.h"
#include "numerics/filters/tapped_system.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

/// target += weight q^-late signal, where target has the rows of the signal from `head` on.
template <class Target>
void add_late(Target&& target, const VectorView& signal, double weight, Index late, Index head) {
    const Index first = std::max<Index>(0, late - head), rows = target.size() - first;
    if (rows > 0) target.tail(rows) += weight * signal.segment(first + head - late, rows);
}

}  // namespace

Vector all_pole_filter(const VectorView& f, const VectorView& signal) {
    const Index n = f.size();
    if (n == 0) return signal;
    const ExactFilter filter(tapped(companion(monic(f)), Vector::Unit(n, 0), -f.transpose(), Vector::Ones(1), 0));
    return filter.run(signal);
}

Vector reflect_into_unit_circle(const VectorView& f) {
    if (f.size() == 0 || !f.allFinite()) return f;
    ComplexVector poles = roots(monic(f));
    if (poles.cwiseAbs().maxCoeff() <= 1) return f;
    for (Complex& pole : poles)
        if (std::abs(pole) > 1) pole = 1.0 / std::conj(pole);
    return polynomial_from_roots(poles).tail(f.size());
}

DiscreteOutput::DiscreteOutput(const PolynomialOrders& orders, const StartCondition& condition,
                               const std::vector<SampledExperiment>& experiments)
    : orders_(orders), condition_(condition), experiments_(experiments) {
    if (free_state()) {
        for (std::size_t i = 0; i < orders_.inputs(); ++i)
            head_ = std::max<Index>(head_, orders_.nk[i] + orders_.nb[i] - 1 - orders_.nf[i]);
        values_ = std::accumulate(orders_.nf.begin(), orders_.nf.end(), Index{0});
    }
    const Index each = values_ + (condition_.offset ? 1 : 0);
    const Index count = orders_.parameter_count() + each * static_cast<Index>(experiments_.size());
    lower_ = Vector::Constant(count, -std::numeric_limits<double>::infinity());
    upper_ = -lower_;
}

Index DiscreteOutput::rows(const SampledExperiment& experiment) const {
    return std::max<Index>(0, experiment.y.size() - head_);
}

Index DiscreteOutput::left_out() const {
    Index count = 0;
    for (const SampledExperiment& experiment : experiments_) count += experiment.y.size() - rows(experiment);
    return count;
}

Index DiscreteOutput::values_place(std::size_t experiment, std::size_t input) const {
    Index place = orders_.parameter_count() + static_cast<Index>(experiment) * values_;
    for (std::size_t i = 0; i < input; ++i) place += orders_.nf[i];
    return place;
}

Index DiscreteOutput::offset_place(std::size_t experiment) const {
    return orders_.parameter_count() + static_cast<Index>(experiments_.size()) * values_ +
           static_cast<Index>(experiment);
}

Vector DiscreteOutput::target() const {
    Vector y(std::accumulate(experiments_.begin(), experiments_.end(), Index{0},
                             [&](Index sum, const SampledExperiment& e) { return sum + rows(e); }));
    Index place = 0;
    for (const SampledExperiment& experiment : experiments_) {
        y.segment(place, rows(experiment)) = experiment.y.tail(rows(experiment));
        place += rows(experiment);
    }
    return y;
}

double DiscreteOutput::target_variation() const {
    double sum = 0;
    for (const SampledExperiment& experiment : experiments_) {
        if (rows(experiment) == 0) continue;
        const Vector y = experiment.y.tail(rows(experiment));
        sum += (y.array() - y.mean()).matrix().squaredNorm();
    }
    return sum;
}

/// The share of one input in one experiment's output; its derivatives go into the columns of `part`.
Vector DiscreteOutput::channel(const Vector& theta, std::size_t experiment, std::size_t input,
                               Eigen::Ref<Matrix>* part) const {
    const SampledExperiment& record = experiments_[experiment];
    const Index N = record.y.size(), nf = orders_.nf[input], nb = orders_.nb[input], nk = orders_.nk[input];
    const Index f_place = orders_.f_place(input), b_place = orders_.b_place(input);
    const Vector f = theta.segment(f_place, nf), b = theta.segment(b_place, nb);
    const double resting = steady() ? record.u(0, static_cast<Index>(input)) : 0;
    const Vector w = all_pole_filter(f, record.u.col(static_cast<Index>(input)).array() - resting);  // u/F
    Vector x = Vector::Zero(N);
    for (Index j = 0; j < nb; ++j) add_late(x, w, b[j], nk + j, 0);

    Vector pulse;  // 1/F of a pulse at the first sample
    const Index values_at = values_place(experiment, input);
    if (free_state() && nf > 0) {
        pulse = all_pole_filter(f, Vector::Unit(N, 0));
        for (Index j = 0; j < nf; ++j) add_late(x, pulse, theta[values_at + j], head_ + j, 0);
    }
    const double denominator = 1 + f.sum();
    if (part != nullptr) {
        const Vector y_late = nf > 0 ? all_pole_filter(f, x) : Vector();
        for (Index j = 0; j < nf; ++j) add_late(part->col(f_place + j), y_late, -1, j + 1, head_);
        for (Index j = 0; j < nb; ++j) add_late(part->col(b_place + j), w, 1, nk + j, head_);
        for (Index j = 0; j < nf && pulse.size() > 0; ++j)
            add_late(part->col(values_at + j), pulse, 1, head_ + j, head_);
        if (resting != 0) {
            part->middleCols(f_place, nf).array() -= resting * b.sum() / (denominator * denominator);
            part->middleCols(b_place, nb).array() += resting / denominator;
        }
    }
    if (resting != 0) x.array() += resting * b.sum() / denominator;
    return x;
}

void DiscreteOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    Index total = 0;
    for (const SampledExperiment& experiment : experiments_) total += rows(experiment);
    output = Vector::Zero(total);
    if (sensitivities != nullptr) *sensitivities = Matrix::Zero(total, parameter_count());
    Index place = 0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        const Index count = rows(experiments_[e]);
        for (std::size_t input = 0; input < orders_.inputs(); ++input) {
            if (sensitivities == nullptr) {
                output.segment(place, count) += channel(theta, e, input, nullptr).tail(count);
                continue;
            }
            Eigen::Ref<Matrix> part = sensitivities->middleRows(place, count);
            output.segment(place, count) += channel(theta, e, input, &part).tail(count);
        }
        if (condition_.offset) {
            output.segment(place, count).array() += theta[offset_place(e)];
            if (sensitivities != nullptr) sensitivities->col(offset_place(e)).segment(place, count).setOnes();
        }
        place += count;
    }
}

void DiscreteOutput::regressors(const Vector& theta, const Matrix& sensitivities, const Vector& errors,
                                Matrix& Phi) const {
    Phi = sensitivities;
    Index place = 0;
    for (const SampledExperiment& experiment : experiments_) {
        const Index count = rows(experiment);
        for (std::size_t input = 0; input < orders_.inputs(); ++input) {
            const Index f_place = orders_.f_place(input), nf = orders_.nf[input];
            if (nf == 0) continue;
            const Vector filtered = all_pole_filter(theta.segment(f_place, nf), errors.segment(place, count));
            for (Index j = 0; j < nf; ++j) add_late(Phi.col(f_place + j).segment(place, count), filtered, -1, j + 1, 0);
        }
        place += count;
    }
}

Vector DiscreteOutput::stabilised(Vector theta) const {
    for (std::size_t input = 0; input < orders_.inputs(); ++input) {
        const Index place = orders_.f_place(input), nf = orders_.nf[input];
        theta.segment(place, nf) = reflect_into_unit_circle(theta.segment(place, nf));
    }
    return theta;
}

}  // namespace dynlab::inline numerics
