#include "numerics/fit/discrete/prediction_model.h"

#include <algorithm>
#include <limits>

#include "numerics/criteria/arx_equations.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

PolynomialOrders driven_orders(const PolynomialOrders& orders) {
    return PolynomialOrders::output_error(orders.nb, orders.nf, orders.nk);
}

}  // namespace

PredictionModel::PredictionModel(const PolynomialOrders& orders, const StartCondition& condition,
                                 const std::vector<SampledExperiment>& experiments)
    : orders_(orders), driven_(driven_orders(orders), condition, experiments), experiments_(experiments) {
    if (condition.state == InitialState::kEstimate) blind_ = std::max<Index>(0, orders_.na - driven_.head());
    const Index linear = driven_.parameter_count() - dynamic_count();
    set_free(orders_.parameter_count() + linear);
}

std::vector<Index> PredictionModel::lengths() const {
    std::vector<Index> lengths;
    for (const SampledExperiment& experiment : experiments_)
        lengths.push_back(std::max<Index>(0, experiment.y.size() - driven_.head() - skipped()));
    return lengths;
}

Vector PredictionModel::target() const {
    const std::vector<Index> counts = lengths();
    Vector y(0);
    for (std::size_t e = 0; e < counts.size(); ++e) {
        y.conservativeResize(y.size() + counts[e]);
        y.tail(counts[e]) = experiments_[e].y.tail(counts[e]);
    }
    return y;
}

Index PredictionModel::offset_index(std::size_t experiment) const {
    return driven_.offset_index(experiment) - dynamic_count() + orders_.parameter_count();
}

/// [F and B; initial values and offsets] as DiscreteOutput has them.
Vector PredictionModel::driven_parameters(const Vector& theta) const {
    Vector values(driven_.parameter_count());
    values << theta.segment(orders_.na, dynamic_count()), theta.tail(linear_count());
    return values;
}

/// q^-lag y in the rows of driven_ that are not blind.
Vector PredictionModel::past_output(std::size_t experiment, Index lag) const {
    const Vector& y = experiments_[experiment].y;
    const Index first = driven_.head() + blind_, rows = std::max<Index>(0, y.size() - first);
    Vector late = Vector::Zero(rows);
    const Index unknown = std::clamp<Index>(lag - first, 0, rows);
    late.tail(rows - unknown) = y.segment(first + unknown - lag, rows - unknown);
    return late;
}

ArmaNoise PredictionModel::noise_at(const Vector& theta) const {
    ArmaNoise noise = ArmaNoise::white(orders_.nc, orders_.nd);
    noise.C = monic(theta.segment(orders_.c_start(), orders_.nc));
    noise.D = monic(theta.segment(orders_.d_start(), orders_.nd));
    return noise;
}

bool PredictionModel::possible(const Vector& theta, const ArmaNoise& noise) const {
    return theta.allFinite() && inside_unit_circle(noise.C) && inside_unit_circle(noise.D);
}

/// w = A y - driven for every sample of an experiment, y zero before it; `driven` as DiscreteOutput gives it.
Vector PredictionModel::equation_errors(const Vector& theta, std::size_t experiment, const Vector& driven) const {
    const Vector& y = experiments_[experiment].y;
    Vector w = y - driven;
    for (Index i = 1; i <= std::min<Index>(orders_.na, y.size()); ++i)
        w.tail(y.size() - i) += theta[i - 1] * y.head(y.size() - i);
    return w;
}

OutputErrorProducts PredictionModel::products(const Vector& theta, const VectorView&) const {
    const Index d = parameter_count(), na = orders_.na, count = dynamic_count();
    OutputErrorProducts sums{kNaN, Matrix::Zero(d, d), Vector::Constant(d, kNaN)};
    const ArmaNoise noise = noise_at(theta);
    if (!possible(theta, noise)) return sums;
    sums.squares = 0;
    sums.descent.setZero();
    const Vector driven_theta = driven_parameters(theta);
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        const Vector& y = experiments_[e].y;
        const Index first = driven_.head() + blind_, rows = y.size() - first;
        if (rows <= orders_.nd) continue;
        const DrivenSignals driven = driven_.driven(driven_theta, e, true);
        const Vector w = equation_errors(theta, e, driven.output);
        std::vector<LateColumn> columns = driven.columns;
        std::vector<Index> places;
        for (const Index place : driven.places)
            places.push_back(place < count ? na + place : place - count + orders_.parameter_count());
        for (Index i = 1; i <= na; ++i) {
            columns.push_back({y, i, -1, 0});
            places.push_back(i - 1);
        }
        places.push_back(-1);
        for (Index j = 0; j < orders_.nc; ++j) places.push_back(orders_.c_start() + j);
        for (Index i = 0; i < orders_.nd; ++i) places.push_back(orders_.d_start() + i);
        add_to(sums, prediction_error_products(columns, {w, 0, 1, 0}, first, rows, noise.C, noise.D), places);
    }
    return sums;
}

void PredictionModel::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    output = target();
    const Index na = orders_.na, nc = orders_.nc, nd = orders_.nd, count = dynamic_count();
    if (sensitivities != nullptr) *sensitivities = Matrix::Zero(output.size(), parameter_count());
    const ArmaNoise noise = noise_at(theta);
    if (!possible(theta, noise)) {
        output.setConstant(std::numeric_limits<double>::quiet_NaN());
        return;
    }
    Vector driven;
    Matrix driven_sensitivities;
    driven_.simulate(driven_parameters(theta), driven, sensitivities != nullptr ? &driven_sensitivities : nullptr);
    Index place = 0, driven_end = 0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        Vector w = past_output(e, 0);
        const Index rows = w.size(), used = std::max<Index>(0, rows - nd);
        driven_end += std::max<Index>(0, experiments_[e].y.size() - driven_.head());
        if (used == 0) continue;
        w -= driven.segment(driven_end - rows, rows);
        for (Index i = 1; i <= na; ++i) w += theta[i - 1] * past_output(e, i);
        const Vector errors = whitened(noise, w);
        output.segment(place, used) -= errors.tail(used);
        if (sensitivities != nullptr) {
            Matrix unfiltered(rows, na + count + linear_count());
            for (Index i = 1; i <= na; ++i) unfiltered.col(i - 1) = -past_output(e, i);
            unfiltered.rightCols(count + linear_count()) = driven_sensitivities.middleRows(driven_end - rows, rows);
            const Matrix filtered = whitened(noise, unfiltered).bottomRows(used);
            auto block = sensitivities->middleRows(place, used);
            block.leftCols(na + count) = filtered.leftCols(na + count);
            block.rightCols(linear_count()) = filtered.rightCols(linear_count());
            block.middleCols(orders_.c_start(), nc + nd) = noise_sensitivities(noise, w, errors).bottomRows(used);
        }
        place += used;
    }
}

Vector PredictionModel::simulated(const Vector& theta) const {
    Vector driven, output = target();
    driven_.simulate(driven_parameters(theta), driven, nullptr);
    const std::vector<Index> counts = lengths();
    Index place = 0, driven_row = 0;
    for (std::size_t e = 0; e < counts.size(); ++e) {
        const Vector& y = experiments_[e].y;
        const Index rows = std::max<Index>(0, y.size() - driven_.head());
        Vector all = Vector::Zero(y.size());
        all.tail(rows) = driven.segment(driven_row, rows);
        const Vector run = free_run(theta.head(orders_.na), all, y, orders_.na > 0 ? driven_.head() + blind_ : 0);
        output.segment(place, counts[e]) = run.tail(counts[e]);
        place += counts[e];
        driven_row += rows;
    }
    return output;
}

Vector PredictionModel::completed(const VectorView& head) const {
    Vector theta = Vector::Zero(parameter_count());
    theta.head(head.size()) = head;
    if (linear_count() == 0) return theta;
    Vector output;
    Matrix sensitivities;
    simulate(theta, output, &sensitivities);
    theta.tail(linear_count()) =
        solve_least_squares(sensitivities.rightCols(linear_count()), target() - output).solution;
    return theta;
}

}  // namespace dynlab::inline numerics
