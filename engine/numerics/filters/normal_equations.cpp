#include "numerics/filters/normal_equations.h"

#include <numeric>

#include "numerics/filters/delta_regression.h"
#include "numerics/filters/filter_chain.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kStoredSamples = 50'000;  // up to this count outputs are stored: faster for short data

/// The chains of one experiment, with numbered outputs, and the role of each output.
class Equation {
  public:
    Equation(const RegressionData& data_set, Index n) : data_set_(data_set), n_(n) {}

    /// Outputs first, first + 1, ... of a new chain.
    Index add(FilterChain chain) {
        const Index first = outputs_;
        outputs_ += chain.filter.C.rows();
        chains_.push_back(std::move(chain));
        return first;
    }
    /// p^n y_f ... y_f.
    void add_output(const VectorView& filter) {
        y_ = add({data_set_.y, derivatives_filter(filter, n_), data_set_.hold_y});
    }
    void add_inputs(const VectorView& filter) {
        for (std::size_t j = 0; j < data_set_.u.size(); ++j) {
            const Index m = data_set_.zeros[j];
            set_input(add({data_set_.u[j], derivatives_filter(filter, m), data_set_.hold, data_set_.delays[j]}), m);
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
    Matrix products(const std::vector<Index>& left, const std::vector<Index>& right) const {
        return chain_products(chains_, data_set_.sampling, left, right, sums_);
    }
    /// Outputs for the n first instruments: sums over the inputs, where there are several. `firsts` are the places
    /// where the n outputs of each input begin.
    std::vector<Index> summed_over_inputs(const std::vector<Index>& firsts) {
        std::vector<Index> places;
        for (Index i = 0; i < n_; ++i) {
            if (firsts.size() == 1) {
                places.push_back(firsts[0] + i);
                continue;
            }
            OutputSum sum;
            for (const Index first : firsts) sum.terms.push_back({first + i, 1});
            places.push_back(outputs_ + static_cast<Index>(sums_.size()));
            sums_.push_back(std::move(sum));
        }
        return places;
    }
    /// sum z [phi' p^n y_f] for z = sign (n first) and input derivatives; and sum z z' in the same run when wanted.
    NormalEquations with_instruments(const std::vector<Index>& z, double sign, bool with_gram) const {
        std::vector<Index> columns = right();
        if (with_gram) columns.insert(columns.end(), z.begin(), z.end());
        Matrix all = products(z, columns);
        const Index d = parameters();
        all.leftCols(n_) *= -1;
        all.topRows(n_) *= sign;
        if (with_gram) all.middleCols(d + 1, n_) *= sign;
        return {all.leftCols(d), all.col(d), with_gram ? Matrix(all.rightCols(d)) : Matrix(), 0};
    }

  private:
    const RegressionData& data_set_;
    Index n_, outputs_ = 0, y_ = 0;
    std::vector<FilterChain> chains_;
    std::vector<Index> inputs_;
    std::vector<OutputSum> sums_;
};

}  // namespace

NormalEquations svf_equations(const RegressionData& data_set, const VectorView& E, double gain) {
    if (auto equations = delta_svf_equations(data_set, E, gain)) return *std::move(equations);
    const Index n = E.size() - 1;
    Equation equation(data_set, n);
    equation.add_output(E);
    equation.add_inputs(E);
    const std::vector<Index> columns = equation.right();
    Matrix all = gain * gain * equation.products(columns, columns);
    const Index d = equation.parameters();
    all.leftCols(n) *= -1;
    all.topRows(n) *= -1;
    return {all.topLeftCorner(d, d), all.col(d).head(d), all.topLeftCorner(d, d), all(d, d)};
}

NormalEquations auxiliary_equations(const RegressionData& data_set, const VectorView& E, const VectorView& A,
                                    const std::vector<Vector>& B, double gain) {
    if (auto equations = delta_auxiliary_equations(data_set, E, A, B, gain)) return *std::move(equations);
    const Index n = E.size() - 1;
    Equation equation(data_set, n);
    equation.add_output(E);
    equation.add_inputs(E);
    std::vector<Index> firsts;
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        FilterChain chain{data_set.u[j], derivatives_filter(E, n - 1), data_set.hold_y};
        chain.front = FrontModel{transfer_system(B[j], A), data_set.hold, data_set.delays[j]};
        firsts.push_back(equation.add(std::move(chain)));
    }
    std::vector<Index> z = equation.summed_over_inputs(firsts);
    z.insert(z.end(), equation.inputs().begin(), equation.inputs().end());
    const NormalEquations sums = equation.with_instruments(z, -1, true);
    return {gain * gain * sums.z_phi, gain * gain * sums.z_y, gain * gain * sums.z_z, 0};
}

namespace {

/// The outputs for SRIVC's z, of chains that this adds.
std::vector<Index> add_sensitivities(Equation& equation, const RegressionData& data_set, const VectorView& A,
                                     const std::vector<Vector>& B) {
    const Index n = A.size() - 1;
    std::vector<Index> firsts;
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        SingleInputSystem system = sensitivity_system(B[j], A);
        const Index m = B[j].size() - 1;
        system.C = system.C.middleRows(1, n + m + 1).eval();
        system.D = system.D.segment(1, n + m + 1).eval();
        firsts.push_back(equation.add({data_set.u[j], std::move(system), data_set.hold, data_set.delays[j]}));
        equation.set_input(firsts.back() + n, m);
    }
    std::vector<Index> z = equation.summed_over_inputs(firsts);
    z.insert(z.end(), equation.inputs().begin(), equation.inputs().end());
    return z;
}

}  // namespace

NormalEquations refined_equations(const RegressionData& data_set, const VectorView& A, const std::vector<Vector>& B,
                                  bool with_gram) {
    if (auto equations = delta_refined_equations(data_set, A, B, with_gram)) return *std::move(equations);
    Equation equation(data_set, A.size() - 1);
    equation.add_output(A);
    const std::vector<Index> z = add_sensitivities(equation, data_set, A, B);
    return equation.with_instruments(z, 1, with_gram);
}

double output_error_squares(const RegressionData& data_set, const std::vector<Vector>& A,
                            const std::vector<Vector>& B) {
    // The quickest, where enough digits are left: nearly noise-free data go the long way.
    constexpr double kLeft = 1e-4;
    if (const auto sums = delta_output_products(data_set, A, B)) {
        Vector error = Vector::Constant(sums->rows(), -1);
        error[0] = 1;
        const double squares = error.dot(*sums * error);
        if (squares > kLeft * sums->diagonal().maxCoeff()) return squares;
    }
    std::vector<FilterChain> chains{{data_set.y, no_filter(), data_set.hold_y}};
    for (std::size_t j = 0; j < data_set.u.size(); ++j)
        chains.push_back({data_set.u[j], transfer_system(B[j], A[j]), data_set.hold, data_set.delays[j]});
    if (!(data_set.sampling.Ts > 0) || data_set.y.size() <= kStoredSamples) {
        Vector error = data_set.y;
        for (std::size_t j = 1; j < chains.size(); ++j) error -= chain_outputs(chains[j], data_set.sampling).col(0);
        return error.squaredNorm();
    }
    OutputSum error{{{0, 1}}};
    for (std::size_t j = 1; j < chains.size(); ++j) error.terms.push_back({static_cast<Index>(j), -1});
    const Index place = static_cast<Index>(chains.size());
    return chain_products(chains, data_set.sampling, {place}, {place}, {error})(0, 0);
}

}  // namespace dynlab::inline numerics
