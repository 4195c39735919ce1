#include "numerics/simulation/companion_series.h"

#include <algorithm>
#include <cmath>

#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

double power_of_two_near(double x) {
    return std::exp2(std::round(std::log2(x)));
}

}  // namespace

CompanionSeries::CompanionSeries(const CompanionPair& pair)
    : twice(pair.twice), order(pair.one.rows()), driving(pair.driving) {
    if (order == 0) return;
    const Index n = order, states = (twice ? 2 : 1) * n;
    Matrix one = pair.one;
    scale = balance(one);
    scale /= scale[0];
    Matrix both = one;
    if (twice) {
        // So large that the entry in between is like the others.
        const double entry = pair.drive * scale[driving], norm = one.cwiseAbs().colwise().sum().maxCoeff();
        const double second = entry != 0 && norm > 0 ? power_of_two_near(std::abs(entry) / norm) : 1;
        both = Matrix::Zero(states, states);
        both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = one;
        both(n, driving) = entry / second;
        scale = scale.replicate(2, 1).eval();
        scale.tail(n) *= second;
    }

    const Vector below = one.diagonal(-1);
    integral = below.cwiseInverse();
    first = integral * one.row(0);
    next = Matrix::Zero(n - 1, n);
    next.leftCols(n - 1) = integral * below.transpose();
    if (twice) drive = both(n, driving) * integral;

    set_terms(both);
}

void CompanionSeries::set_terms(const Matrix& A) {
    gap = order > kMaxStatesOfOneRow ? 2 : order;
    std::array<double, kLastTerm + 3> largest = {};  // coefficients of h^k, inputs in units of A
    const Index n = order, systems = twice ? 2 : 1, rows = (n + gap - 1) / gap, inputs = rows * systems;
    const Index count = inputs * (n + 2);
    terms = Matrix::Zero((count + kTogether - 1) / kTogether * kTogether, kLastTerm + 1);
    const double rate = A.cwiseAbs().colwise().sum().maxCoeff();
    for (Index i = 0; i < rows; ++i) {
        const Index first_term = i * systems * (n + 1), first_ramp = inputs * (n + 1) + i * systems;
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(A.rows(), A.rows() - 1 - i * gap), next_row = row;
        Eigen::Vector2d input = Eigen::Vector2d::Zero(), ramp = Eigen::Vector2d::Zero();  // of both systems
        for (Index k = 0; k <= kLastTerm + 2; ++k) {
            double& max_magnitude = largest[static_cast<std::size_t>(k)];
            max_magnitude = std::max({max_magnitude, row.cwiseAbs().maxCoeff(), rate * input.cwiseAbs().maxCoeff(),
                                      rate * rate * ramp.cwiseAbs().maxCoeff()});
            for (Index system = 0; system < systems && k <= kLastTerm; ++system) {
                auto own = terms.col(k).segment(first_term + system * (n + 1), n + 1);
                own.head(n) = row.segment(system == 0 ? A.rows() - n : 0, n).transpose();
                if (k == 0) own.setZero();
                own[n] = input[system];
                terms(first_ramp + system, k) = ramp[system];
            }
            const double next_term = static_cast<double>(k + 1);
            ramp = input / next_term;
            input = Eigen::Vector2d(row[A.rows() - n], twice ? row[0] : 0) / next_term;
            next_row.noalias() = row.lazyProduct(A);
            row = next_row / next_term;
        }
    }
    // Every other term may be zero.
    const auto reach_of = [&](std::size_t k) { return std::pow(4e-17 / largest[k], 1 / static_cast<double>(k)); };
    for (std::size_t last = 0; last < reach.size(); ++last)
        reach[last] = std::min(reach_of(last + 1), reach_of(last + 2));
}

StepPlan::StepPlan(const CompanionSeries& series, double max_step) {
    constexpr int kMaxDoublings = 1000;  // more than numbers have
    for (; max_step > series.reach.back() && doublings < kMaxDoublings; max_step /= 2) ++doublings;
    part = std::ldexp(1.0, -doublings);
    last_term = CompanionSeries::kLastTerm;
    while (last_term > 2 && max_step <= series.reach[static_cast<std::size_t>(last_term - 1)]) --last_term;
}

}  // namespace dynlab::inline numerics
