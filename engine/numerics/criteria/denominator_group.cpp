#include "numerics/criteria/denominator_group.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSharedSamples = 5'000;  // fewer are filtered sooner than several cores meet

SampleView sample_view(const VectorView& samples) {
    return {samples.data(), samples.size()};
}

/// Without inputs.
RegressionData regression_data(const IdData& data, const Experiment& experiment, Index output, Hold hold_y) {
    return {sample_view(experiment.y.col(output)), {}, {}, {}, {data.Ts, sample_view(experiment.t)}, data.hold, hold_y};
}

/// Adds weight times `block` to these rows and columns of `sum`.
void add_at(const std::vector<Index>& places, double weight, const Matrix& block, Matrix& sum) {
    for (Index j = 0; j < block.cols(); ++j)
        for (Index i = 0; i < block.rows(); ++i)
            sum(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)]) += weight * block(i, j);
}

}  // namespace

DenominatorGroup::DenominatorGroup(const IdData& data, const TransferStructure& structure, Index group, Hold hold_y)
    : n_(structure.poles[static_cast<std::size_t>(group)]), place_(structure.denominator_start(group)), count_(n_) {
    for (Index output = 0; output < structure.outputs; ++output) {
        std::vector<Index> places(static_cast<std::size_t>(n_));
        for (Index i = 0; i < n_; ++i) places[static_cast<std::size_t>(i)] = i;
        std::vector<Index> inputs;
        for (Index input = 0; input < structure.inputs; ++input) {
            if (structure.channel(output, input).denominator != group) continue;
            inputs.push_back(input);
            const Index b = structure.numerator_start(output, input) - place_,
                        m = structure.channel(output, input).zeros;
            for (Index j = 0; j <= m; ++j) places.push_back(b + j);
            count_ += m + 1;
        }
        if (inputs.empty()) continue;
        for (const Experiment& experiment : data.experiments) {
            RegressionData data_set = regression_data(data, experiment, output, hold_y);
            for (const Index input : inputs) {
                data_set.u.push_back(sample_view(experiment.u.col(input)));
                data_set.zeros.push_back(structure.channel(output, input).zeros);
                data_set.delays.push_back(structure.channel(output, input).delay);
            }
            members_.push_back({std::move(data_set), places, outputs_.size()});
        }
        outputs_.push_back(output);
    }
    weights_.assign(outputs_.size(), 1);
    targets_.resize(members_.size());
}

Index DenominatorGroup::sample_count() const {
    Index count = 0;
    for (const Member& member : members_) count += member.data_set.y.size();
    return count;
}

void DenominatorGroup::set_target(std::size_t data_set, const Vector& y) {
    targets_[data_set] = y;
    new (&members_[data_set].data_set.y) SampleView(targets_[data_set].data(), y.size());
}

void DenominatorGroup::set_weight(Index output, double weight) {
    for (std::size_t i = 0; i < outputs_.size(); ++i)
        if (outputs_[i] == output) weights_[i] = weight;
}

Vector DenominatorGroup::denominator(const VectorView& theta) const {
    Vector den(n_ + 1);
    den << 1, theta.head(n_);
    return den;
}

std::vector<Vector> DenominatorGroup::numerators(const Member& member, const VectorView& theta) const {
    std::vector<Vector> B;
    std::size_t place = static_cast<std::size_t>(n_);
    for (const int m : member.data_set.zeros) {
        Vector b(m + 1);
        for (double& value : b) value = theta[member.places[place++]];
        B.push_back(std::move(b));
    }
    return B;
}

template <class Equations>
NormalEquations DenominatorGroup::sum_over_experiments(const Equations& equations_of) const {
    if (members_.size() == 1 && weights_[0] == 1) return equations_of(members_.front());
    std::vector<NormalEquations> equations(members_.size());
    side_by_side(
        members_.size(), [&](std::size_t i) { equations[i] = equations_of(members_[i]); },
        sample_count() >= kSharedSamples);
    NormalEquations sum{Matrix::Zero(count_, count_), Vector::Zero(count_), Matrix(), 0};
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const Member& member = members_[i];
        const double weight = weights_[member.output];
        const NormalEquations& own = equations[i];
        add_at(member.places, weight, own.z_phi, sum.z_phi);
        for (std::size_t k = 0; k < member.places.size(); ++k)
            sum.z_y[member.places[k]] += weight * own.z_y[static_cast<Index>(k)];
        if (own.z_z.size() > 0) {
            if (sum.z_z.size() == 0) sum.z_z = Matrix::Zero(count_, count_);
            add_at(member.places, weight, own.z_z, sum.z_z);
        }
        sum.y_y += weight * own.y_y;
    }
    return sum;
}

NormalEquations DenominatorGroup::svf(const VectorView& E, double gain) const {
    return sum_over_experiments([&](const Member& member) { return transfer_filters().svf(member.data_set, E, gain); });
}

NormalEquations DenominatorGroup::auxiliary(const VectorView& E, const VectorView& theta, double gain) const {
    const Vector A = denominator(theta);
    return sum_over_experiments([&](const Member& member) {
        return transfer_filters().auxiliary(member.data_set, E, A, numerators(member, theta), gain);
    });
}

NormalEquations DenominatorGroup::refined(const VectorView& theta, bool with_gram) const {
    const Vector A = denominator(theta);
    return sum_over_experiments([&](const Member& member) {
        return transfer_filters().refined(member.data_set, A, numerators(member, theta), with_gram);
    });
}

Vector DenominatorGroup::with_stable_poles(const VectorView& theta, bool* any) const {
    Vector result = theta;
    result.head(n_) = reflect_unstable_roots(denominator(theta), any).tail(n_);
    return result;
}

Vector response_from_rest(const IdData& data, const Experiment& experiment, const VectorView& B, const VectorView& A,
                          double delay, Index input) {
    const Sampling sampling{data.Ts, SampleView(experiment.t.data(), experiment.t.size())};
    return transfer_filters().response(B, A, delay, experiment.u.col(input), sampling, data.hold);
}

double simulation_squares(const IdData& data, const TransferStructure& structure, const VectorView& theta,
                          Index output) {
    Vector squares(static_cast<Index>(data.experiments.size()));
    const auto simulate = [&](std::size_t e) {
        const Experiment& experiment = data.experiments[e];
        RegressionData data_set = regression_data(data, experiment, output, Hold::kFoh);  // y is not filtered
        std::vector<Vector> A, B;
        for (Index input = 0; input < structure.inputs; ++input) {
            data_set.u.push_back(sample_view(experiment.u.col(input)));
            data_set.delays.push_back(structure.delay(theta, output, input));
            A.push_back(structure.denominator(theta, output, input));
            B.push_back(structure.numerator(theta, output, input));
        }
        squares[static_cast<Index>(e)] = transfer_filters().output_error_squares(data_set, A, B);
    };
    side_by_side(data.experiments.size(), simulate, data.sample_count() >= kSharedSamples);
    return squares.sum();
}

namespace {

/// Gauss and Jordan's elimination with pivots. Column i holds equation i: its coefficients, then its right-hand sides,
/// which become the solutions. By plain loops, for a few unknowns at every pass of a search. Whether it could be done.
bool eliminate(Matrix& equations) {
    const Index d = equations.cols(), size = equations.rows();
    for (Index k = 0; k < d; ++k) {
        Index pivot = k;
        for (Index i = k + 1; i < d; ++i)
            if (std::abs(equations(k, i)) > std::abs(equations(k, pivot))) pivot = i;
        const double largest = equations(k, pivot);
        if (!(std::abs(largest) > 0)) return false;
        for (Index j = k; j < size; ++j) {
            std::swap(equations(j, k), equations(j, pivot));
            equations(j, k) /= largest;
        }
        for (Index i = 0; i < d; ++i) {
            const double factor = equations(k, i);
            if (i == k || factor == 0) continue;
            for (Index j = k; j < size; ++j) equations(j, i) -= factor * equations(j, k);
        }
    }
    return true;
}

/// The 1-norm of the square whose columns are rows first .. first + d - 1.
double norm_of_rows(const Matrix& equations, Index first) {
    double largest = 0;
    for (Index j = 0; j < equations.cols(); ++j) {
        double sum = 0;
        for (Index i = 0; i < equations.cols(); ++i) sum += std::abs(equations(first + j, i));
        largest = std::max(largest, sum);
    }
    return largest;
}

}  // namespace

Vector solve_equations(const NormalEquations& equations, double* condition_number) {
    const Index d = equations.z_y.size();
    const Vector unsolvable = Vector::Constant(d, kNaN);
    if (condition_number) *condition_number = kInfinity;
    if (!equations.z_phi.allFinite() || !equations.z_y.allFinite()) return unsolvable;
    // Rows and columns are brought to a common size; a Gram matrix then has a diagonal of ones.
    Vector columns(d);
    for (Index j = 0; j < d; ++j) columns[j] = equations.z_phi.col(j).norm();
    Matrix work(condition_number ? 2 * d + 1 : d + 1, d);
    for (Index i = 0; i < d; ++i) {
        double square = 0;
        for (Index j = 0; j < d; ++j) {
            work(j, i) = equations.z_phi(i, j) / columns[j];
            square += work(j, i) * work(j, i);
        }
        work(d, i) = equations.z_y[i];
        const double row = std::sqrt(square);
        if (!(row > 0) || !(columns[i] > 0)) return unsolvable;
        for (Index j = 0; j <= d; ++j) work(j, i) /= row;
        for (Index j = d + 1; j < work.rows(); ++j) work(j, i) = j - d - 1 == i ? 1 : 0;
    }
    const double norm = norm_of_rows(work, 0);
    if (!eliminate(work)) return unsolvable;
    if (condition_number) *condition_number = norm * norm_of_rows(work, d + 1);
    Vector theta(d);
    for (Index i = 0; i < d; ++i) theta[i] = work(d, i) / columns[i];
    return theta;
}

Matrix inverse_gram(const Matrix& gram, double* condition_number) {
    const Vector scale = gram.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * gram * scale.asDiagonal();
    const auto [inverse, reciprocal] = solve_by_lu(scaled, Matrix::Identity(scaled.rows(), scaled.cols()));
    if (condition_number) *condition_number = 1 / reciprocal;
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

Vector reflect_unstable_roots(const VectorView& den, bool* any) {
    if (any) *any = false;
    const Index n = den.size() - 1;
    // Orders one and two need no roots.
    if (den.allFinite() && n <= 2 && (den.tail(n).array() > 0).all()) return den;
    ComplexVector poles = roots(den);
    bool changed = false;
    for (Complex& pole : poles) {
        if (pole.real() <= 0) continue;
        pole = Complex(-pole.real(), pole.imag());
        changed = true;
    }
    if (any) *any = changed;
    return changed ? polynomial_from_roots(poles) : Vector(den);
}

Vector filter_denominator(double lambda, Index n) {
    return power(Eigen::Vector2d(1, lambda), static_cast<int>(n));
}

}  // namespace dynlab::inline numerics
