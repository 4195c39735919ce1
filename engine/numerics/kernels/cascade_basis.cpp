#include "numerics/kernels/cascade_basis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dynlab {

namespace {

/// The pair of a 2 x 2 block, without cancellation where its poles are close; equal poles are so exactly.
CascadeBasis::Pair pair_of(const Eigen::Matrix2d& F) {
    constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
    const double half = 0.5 * (F(0, 0) - F(1, 1)), square = half * half + F(0, 1) * F(1, 0);
    return {0.5 * (F(0, 0) + F(1, 1)), std::abs(square) <= kRounding * half * half ? 0 : square};
}

bool split_poles(const Matrix& F, std::vector<CascadeBasis::Pair>& pairs) {
    switch (F.rows()) {
        case 0:
            return true;
        case 1:
            pairs = {{F(0, 0), 0}};
            return true;
        case 2:
            pairs = {pair_of(F)};
            return true;
        case 4:
            pairs = {pair_of(F.topLeftCorner(2, 2)), pair_of(F.bottomRightCorner(2, 2))};
            return F.topRightCorner(2, 2).isZero(0);
        default:
            return false;
    }
}

}  // namespace

namespace {

/// The solution of A x = b for a matrix whose rows and columns may differ in size by many orders of magnitude.
template <int n>
Vector solve_scaled(Eigen::Matrix<double, n, n> A, Eigen::Matrix<double, n, 1> b) {
    const auto inverse = [](double norm) { return norm > 0 ? 1 / norm : 1; };
    const Eigen::Matrix<double, n, 1> rows = A.rowwise().norm().unaryExpr(inverse);
    A = rows.asDiagonal() * A;
    const Eigen::Matrix<double, n, 1> columns = A.colwise().norm().transpose().unaryExpr(inverse);
    A = A * columns.asDiagonal();
    b = rows.cwiseProduct(b);
    return columns.cwiseProduct(A.fullPivLu().solve(b));
}

}  // namespace

Vector CascadeBasis::from_state(const Vector& x, double v) const {
    const Vector rest = x - tap * v;
    if (order == 0) return rest;
    if (order == 1) return solve_scaled<1>(to_state, rest);
    return order == 2 ? solve_scaled<2>(to_state, rest) : solve_scaled<4>(to_state, rest);
}

namespace {

/// `in_order`: the pairs are those of the blocks of F, one after the other.
template <int n>
void set_columns(const TappedSystem& system, Index next, bool in_order, CascadeBasis& basis) {
    const Eigen::Matrix<double, n, n> F = system.F;
    Eigen::Matrix<double, n, 1> g = F * system.G.col(next) + system.G.col(next + 1);
    basis.to_state.resize(n, n);
    for (Index i = 0; i < n; i += 2) {
        const auto [centre, square] = basis.pairs[static_cast<std::size_t>(i / 2)];
        const Eigen::Matrix<double, n, 1> second = F * g - centre * g;
        basis.to_state.col(i) = g;
        if (i + 1 < n) basis.to_state.col(i + 1) = second;
        g = F * second - centre * second - square * g;
        // The poles of what comes before are done with, but for rounding.
        if (in_order) g.head(std::min<Index>(n, i + 2)).setZero();
    }
}

std::optional<CascadeBasis> basis_with(const TappedSystem& system, std::vector<CascadeBasis::Pair> pairs,
                                       bool in_order) {
    // x = G0 u[k-d] + (z - F)^-1 (F G0 + G1) u[k-d], and one sample later for what u[k-d-1] does.
    const bool late = !system.G.col(2).isZero(0) || !system.D.col(1).isZero(0);
    if (late && !(system.G.col(0).isZero(0) && system.D.col(0).isZero(0))) return {};
    const Index next = late ? 1 : 0, n = system.F.rows();
    CascadeBasis basis;
    basis.pairs = std::move(pairs);
    basis.order = n;
    basis.delay = system.delay + next;
    basis.tap = system.G.col(next);
    if (n == 1) set_columns<1>(system, next, in_order, basis);
    if (n == 2) set_columns<2>(system, next, in_order, basis);
    if (n == 4) set_columns<4>(system, next, in_order, basis);
    basis.outputs.resize(system.C.rows(), n + 1);
    basis.outputs << system.C * basis.to_state, system.C * basis.tap + system.D.col(next);
    return basis;
}

}  // namespace

std::optional<CascadeBasis> cascade_basis(const TappedSystem& system) {
    std::vector<CascadeBasis::Pair> pairs;
    if (!split_poles(system.F, pairs)) return {};
    return basis_with(system, std::move(pairs), true);
}

std::optional<CascadeBasis> joint_basis(const TappedSystem& shorter, const TappedSystem& longer) {
    if (shorter.F.rows() != 2 || longer.F.rows() != 4 || longer.F.bottomRightCorner(2, 2) != shorter.F) return {};
    std::vector<CascadeBasis::Pair> pairs;
    if (!split_poles(longer.F, pairs)) return {};
    std::swap(pairs[0], pairs[1]);
    const std::optional<CascadeBasis> own = cascade_basis(shorter);
    std::optional<CascadeBasis> joint = basis_with(longer, std::move(pairs), false);
    if (!own || !joint || own->delay != joint->delay) return {};
    Matrix outputs = Matrix::Zero(own->outputs.rows() + joint->outputs.rows(), 5);
    outputs.topLeftCorner(own->outputs.rows(), 2) = own->outputs.leftCols(2);
    outputs.topRightCorner(own->outputs.rows(), 1) = own->outputs.col(2);
    outputs.bottomRows(joint->outputs.rows()) = joint->outputs;
    joint->outputs = std::move(outputs);
    return joint;
}

}  // namespace dynlab
