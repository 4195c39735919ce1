#include "numerics/criteria/discrete_output.h"

#include <algorithm>
#include <complex>
#include <numeric>

#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"
#include "numerics/simulation/exact_filter.h"

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
    const ExactFilter filter(
        discrete_system(companion(monic(f)), Vector::Unit(n, 0), -f.transpose(), Vector::Ones(1), 0));
    return filter.run(signal);
}

Vector reflect_poles_into_unit_circle(const VectorView& f) {
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
    set_free(orders_.parameter_count() + each * static_cast<Index>(experiments_.size()));
}

Index DiscreteOutput::rows(const SampledExperiment& experiment) const {
    return std::max<Index>(0, experiment.y.size() - head_);
}

Index DiscreteOutput::left_out() const {
    Index count = 0;
    for (const SampledExperiment& experiment : experiments_) count += experiment.y.size() - rows(experiment);
    return count;
}

Index DiscreteOutput::initial_start(std::size_t experiment, std::size_t input) const {
    Index place = orders_.parameter_count() + static_cast<Index>(experiment) * values_;
    for (std::size_t i = 0; i < input; ++i) place += orders_.nf[i];
    return place;
}

Index DiscreteOutput::offset_index(std::size_t experiment) const {
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

/// Adds the share of one input in one experiment's output and its derivatives.
void DiscreteOutput::add_channel(const Vector& theta, std::size_t experiment, std::size_t input, bool with_derivatives,
                                 DrivenSignals& all) const {
    const SampledExperiment& data_set = experiments_[experiment];
    const Index N = data_set.y.size(), nf = orders_.nf[input], nb = orders_.nb[input], nk = orders_.nk[input];
    const Index f_start = orders_.f_start(input), b_start = orders_.b_start(input);
    const Vector f = theta.segment(f_start, nf), b = theta.segment(b_start, nb);
    const auto u = data_set.u.col(static_cast<Index>(input));
    const double resting = steady() ? u[0] : 0, denominator = 1 + f.sum();
    Vector w = resting == 0 ? all_pole_filter(f, u) : all_pole_filter(f, u.array() - resting);  // u/F
    Vector x = Vector::Zero(N);
    for (Index j = 0; j < nb; ++j) add_late(x, w, b[j], nk + j, 0);
    Vector pulse;  // 1/F of a pulse at the first sample
    const Index values_at = initial_start(experiment, input);
    if (free_state() && nf > 0) {
        pulse = all_pole_filter(f, Vector::Unit(N, 0));
        for (Index j = 0; j < nf; ++j) add_late(x, pulse, theta[values_at + j], head_ + j, 0);
    }
    const auto add = [&all](Index first, Index count, Vector signal, Index late, double weight, double constant) {
        all.signals.push_back(std::move(signal));
        for (Index j = 0; j < count; ++j) {
            all.columns.push_back({all.signals.back(), late + j, weight, constant});
            all.places.push_back(first + j);
        }
    };
    if (with_derivatives) {
        if (nf > 0) add(f_start, nf, all_pole_filter(f, x), 1, -1, -resting * b.sum() / (denominator * denominator));
        add(b_start, nb, std::move(w), nk, 1, resting / denominator);
        if (pulse.size() > 0) add(values_at, nf, std::move(pulse), head_, 1, 0);
    }
    if (resting != 0) x.array() += resting * b.sum() / denominator;
    if (all.output.size() == 0)
        all.output = std::move(x);
    else
        all.output += x;
}

DrivenSignals DiscreteOutput::driven(const Vector& theta, std::size_t experiment, bool with_derivatives) const {
    DrivenSignals all;
    all.signals.reserve(3 * orders_.inputs() + 1);  // columns refer to their memory
    for (std::size_t input = 0; input < orders_.inputs(); ++input)
        add_channel(theta, experiment, input, with_derivatives, all);
    if (!condition_.offset) return all;
    all.output.array() += theta[offset_index(experiment)];
    if (with_derivatives) {
        all.signals.push_back(Vector::Zero(all.output.size()));
        all.columns.push_back({all.signals.back(), 0, 0, 1});
        all.places.push_back(offset_index(experiment));
    }
    return all;
}

void DiscreteOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    Index total = 0;
    for (const SampledExperiment& experiment : experiments_) total += rows(experiment);
    output.resize(total);
    if (sensitivities != nullptr) *sensitivities = Matrix::Zero(total, parameter_count());
    Index place = 0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        const Index count = rows(experiments_[e]);
        const DrivenSignals share = driven(theta, e, sensitivities != nullptr);
        output.segment(place, count) = share.output.tail(count);
        for (std::size_t c = 0; c < share.columns.size(); ++c) {
            auto target = sensitivities->col(share.places[c]).segment(place, count);
            const LateColumn& column = share.columns[c];
            target.setConstant(column.constant);
            if (column.weight != 0) add_late(target, column.signal, column.weight, column.late, head_);
        }
        place += count;
    }
}

OutputErrorProducts DiscreteOutput::products(const Vector& theta, const VectorView& y) const {
    const Index d = parameter_count();
    OutputErrorProducts sums{0, Matrix::Zero(d, d), Vector::Zero(d)};
    Index place = 0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        const Index count = rows(experiments_[e]);
        DrivenSignals share = driven(theta, e, true);
        share.places.push_back(-1);
        Vector errors = -share.output;
        errors.tail(count) += y.segment(place, count);
        place += count;
        add_to(sums, prediction_error_products(share.columns, {errors, 0, 1, 0}, errors.size() - count, count),
               share.places);
    }
    return sums;
}

InstrumentProducts DiscreteOutput::instrument_products(const Vector& theta, const VectorView& y) const {
    const Index d = parameter_count();
    std::vector<Index> f_columns;  // of the columns in which Phi differs from Psi
    for (std::size_t input = 0; input < orders_.inputs(); ++input)
        for (Index j = 0; j < orders_.nf[input]; ++j) f_columns.push_back(orders_.f_start(input) + j);
    const auto m = static_cast<Index>(f_columns.size());
    OutputErrorProducts sums{0, Matrix::Zero(d + m, d + m), Vector::Zero(d + m)};  // of [Psi, Phi - Psi]
    Index place = 0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        const Index N = experiments_[e].y.size(), count = rows(experiments_[e]);
        DrivenSignals share = driven(theta, e, true);
        Vector errors = Vector::Zero(N);
        errors.tail(count) = y.segment(place, count) - share.output.tail(count);
        place += count;
        std::vector<Vector> filtered;
        filtered.reserve(orders_.inputs());  // columns refer to their memory
        Index next = d;
        for (std::size_t input = 0; input < orders_.inputs(); ++input) {
            const Index nf = orders_.nf[input];
            filtered.push_back(all_pole_filter(theta.segment(orders_.f_start(input), nf), errors));
            for (Index j = 0; j < nf; ++j) {
                share.columns.push_back({filtered.back(), j + 1, -1, 0});
                share.places.push_back(next++);
            }
        }
        share.places.push_back(-1);
        add_to(sums, prediction_error_products(share.columns, {errors, 0, 1, 0}, N - count, count), share.places);
    }
    InstrumentProducts all{sums.squares, sums.gram.topLeftCorner(d, d), sums.gram.topLeftCorner(d, d),
                           {},           sums.descent.head(d),          sums.descent.head(d)};
    Matrix difference_phi = sums.gram.bottomLeftCorner(m, d);  // (Phi - Psi)'Phi
    for (Index i = 0; i < m; ++i) {
        const Index column = f_columns[static_cast<std::size_t>(i)];
        all.psi_phi.col(column) += sums.gram.col(d + i).head(d);
        difference_phi.col(column) += sums.gram.col(d + i).tail(m);
        all.phi_e[column] += sums.descent[d + i];
    }
    all.phi_phi = all.psi_phi;
    for (Index i = 0; i < m; ++i) all.phi_phi.row(f_columns[static_cast<std::size_t>(i)]) += difference_phi.row(i);
    return all;
}

Vector DiscreteOutput::with_stable_poles(Vector theta) const {
    for (std::size_t input = 0; input < orders_.inputs(); ++input) {
        const Index place = orders_.f_start(input), nf = orders_.nf[input];
        theta.segment(place, nf) = reflect_poles_into_unit_circle(theta.segment(place, nf));
    }
    return theta;
}

}  // namespace dynlab::inline numerics
