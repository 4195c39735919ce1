#include "numerics/filters/cascade_basis.h"

#include "numerics/filters/newton_basis.h"

namespace dynlab::inline numerics {

namespace {

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

Vector CascadeBasis::from_state(const Vector& x, double v) const {
    const Vector rest = x - tap * v;
    if (order == 0) return rest;
    if (order == 1) return solve_scaled<1>(to_state, rest);
    if (order == 2) return solve_scaled<2>(to_state, rest);
    return solve_scaled<4>(to_state, rest);
}

namespace {

template <int n>
Matrix columns_of(const TappedSystem& system, Index next, const std::vector<CascadeBasis::Pair>& pairs, bool in_order) {
    const Eigen::Matrix<double, n, n> F = system.F;
    return newton_columns<n>(F, F * system.G.col(next) + system.G.col(next + 1), pairs.data(), in_order);
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
    if (n == 1) basis.to_state = columns_of<1>(system, next, basis.pairs, in_order);
    if (n == 2) basis.to_state = columns_of<2>(system, next, basis.pairs, in_order);
    if (n == 4) basis.to_state = columns_of<4>(system, next, basis.pairs, in_order);
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

}  // namespace dynlab::inline numerics
