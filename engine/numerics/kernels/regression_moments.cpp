#include "numerics/kernels/regression_moments.h"

#include <numeric>

namespace dynlab {

namespace {

/// The chains of one record, their outputs numbered through, and which of them stand for what.
class Equation {
  public:
    Equation(const RegressionRecord& record, Index n) : record_(record), n_(n) {}

    /// Outputs first, first + 1, ... of a new chain.
    Index add(FilterChain chain) {
        const Index first = outputs_;
        outputs_ += chain.filter.C.rows();
        chains_.push_back(std::move(chain));
        return first;
    }
    /// p^n y_f ... y_f.
    void add_output(const VectorView& filter) { y_ = add({record_.y, derivatives_filter(filter, n_), record_.hold_y}); }
    void add_inputs(const VectorView& filter) {
        for (std::size_t j = 0; j < record_.u.size(); ++j) {
            const Index m = record_.zeros[j];
            set_input(add({record_.u[j], derivatives_filter(filter, m), record_.hold, record_.delays[j]}), m);
        }
    }
    /// The derivatives of input j begin at this output.
    void set_input(Index first, Index m) {
        for (Index l = 0; l <= m; ++l) inputs_.push_back(first + l);
    }

    Index parameters() const { return n_ + static_cast<Index>(inputs_.size()); }
    const std::vector<Index>& inputs() const { return inputs_; }

    /// phi and p^n y_f; the first n of them still lack their sign.
    std::vector<Index> right() const {
        std::vector<Index> outputs(static_cast<std::size_t>(n_));
        std::iota(outputs.begin(), outputs.end(), y_ + 1);
        outputs.insert(outputs.end(), inputs_.begin(), inputs_.end());
        outputs.push_back(y_);
        return outputs;
    }
    Matrix moments(const std::vector<Index>& left, const std::vector<Index>& right) const {
        return chain_moments(chains_, record_.sampling, left, right);
    }
    /// sum z [phi' p^n y_f] for z = combination * outputs left.
    RegressionMoments with_instruments(const std::vector<Index>& left, const Matrix& combination) const {
        Matrix all = combination * moments(left, right());
        all.leftCols(n_) *= -1;
        const Index d = parameters();
        return {all.leftCols(d), all.col(d), Matrix(), 0};
    }

  private:
    const RegressionRecord& record_;
    Index n_, outputs_ = 0, y_ = 0;
    std::vector<FilterChain> chains_;
    std::vector<Index> inputs_;
};

SingleInputSystem model_system(const Vector& B, const VectorView& A) {
    SingleInputSystem derivatives = derivatives_filter(A, B.size() - 1);
    return {derivatives.A, derivatives.B, B.transpose() * derivatives.C, Vector::Constant(1, B.dot(derivatives.D))};
}

}  // namespace

void RegressionMoments::add(const RegressionMoments& other, double weight) {
    const auto sum = [&](auto& mine, const auto& theirs) {
        if (mine.size() == 0)
            mine = weight * theirs;
        else
            mine += weight * theirs;
    };
    sum(z_phi, other.z_phi);
    sum(z_y, other.z_y);
    sum(z_z, other.z_z);
    y_y += weight * other.y_y;
}

RegressionMoments svf_moments(const RegressionRecord& record, const VectorView& E, double gain) {
    const Index n = E.size() - 1;
    Equation equation(record, n);
    equation.add_output(E);
    equation.add_inputs(E);
    const std::vector<Index> columns = equation.right();
    Matrix all = gain * gain * equation.moments(columns, columns);
    const Index d = equation.parameters();
    all.leftCols(n) *= -1;
    all.topRows(n) *= -1;
    return {all.topLeftCorner(d, d), all.col(d).head(d), all.topLeftCorner(d, d), all(d, d)};
}

RegressionMoments auxiliary_moments(const RegressionRecord& record, const VectorView& E, const VectorView& A,
                                    const std::vector<Vector>& B, double gain) {
    const Index n = E.size() - 1;
    Equation equation(record, n);
    equation.add_output(E);
    equation.add_inputs(E);
    const std::vector<Index>& inputs = equation.inputs();
    const Index d = equation.parameters(), of_inputs = static_cast<Index>(record.u.size()) * n;
    std::vector<Index> left;
    Matrix combination = Matrix::Zero(d, of_inputs + d - n);
    for (std::size_t j = 0; j < record.u.size(); ++j) {
        FilterChain chain{record.u[j], derivatives_filter(E, n - 1), record.hold_y};
        chain.front = FrontModel{model_system(B[j], A), record.hold, record.delays[j]};
        const Index first = equation.add(std::move(chain));
        for (Index i = 0; i < n; ++i) {
            combination(i, static_cast<Index>(left.size())) = -1;
            left.push_back(first + i);
        }
    }
    combination.bottomRightCorner(d - n, d - n).setIdentity();
    left.insert(left.end(), inputs.begin(), inputs.end());
    return equation.with_instruments(left, gain * gain * combination);
}

RegressionMoments refined_moments(const RegressionRecord& record, const VectorView& A, const std::vector<Vector>& B,
                                  bool with_instruments) {
    const Index n = A.size() - 1;
    Equation equation(record, n);
    equation.add_output(A);
    std::vector<Index> left;
    std::vector<Index> rows;  // of z, for each output in `left`
    Index b_place = n;
    for (std::size_t j = 0; j < record.u.size(); ++j) {
        SingleInputSystem system = sensitivity_system(B[j], A);
        const Index m = B[j].size() - 1, used = n + m + 1;
        system.C = system.C.middleRows(1, used).eval();
        system.D = system.D.segment(1, used).eval();
        const Index first = equation.add({record.u[j], std::move(system), record.hold, record.delays[j]});
        equation.set_input(first + n, m);
        for (Index i = 0; i < used; ++i) {
            left.push_back(first + i);
            rows.push_back(i < n ? i : b_place + i - n);
        }
        b_place += m + 1;
    }
    Matrix combination = Matrix::Zero(equation.parameters(), static_cast<Index>(left.size()));
    for (std::size_t i = 0; i < left.size(); ++i) combination(rows[i], static_cast<Index>(i)) = 1;
    RegressionMoments result = equation.with_instruments(left, combination);
    if (with_instruments) result.z_z = combination * equation.moments(left, left) * combination.transpose();
    return result;
}

}  // namespace dynlab
