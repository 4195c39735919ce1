#include "numerics/filters/delta_regression.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory_resource>

#include "numerics/filters/delta_expansion.h"
#include "numerics/filters/delta_products.h"
#include "numerics/filters/delta_sampling.h"
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

namespace {

/// p^highest/den .. 1/den as outputs of the filter's companion form, the n-th by identity.
StateOutputs<4> derivatives(const VectorView& den, int highest) {
    const int n = static_cast<int>(den.size()) - 1;
    StateOutputs<4> outputs;
    outputs.count = highest + 1;
    for (int row = 0; row <= highest; ++row)
        if (n - 1 - highest + row >= 0) outputs.C[row][n - 1 - highest + row] = 1;
    if (highest < n) return outputs;
    for (int i = 0; i < n; ++i) outputs.C[0][i] = -den[i + 1];
    outputs.D[0] = 1;
    return outputs;
}

/// p^n/A .. 1/A of the output.
DeltaSignal filtered_output(const RegressionData& data_set, const SampledFilter<4>& filter, const VectorView& den) {
    return delta_signal(filter, derivatives(den, filter.poles), data_set.y, data_set.hold_y, 0, false);
}

template <int capacity>
DeltaSignal outputs_of_input(const RegressionData& data_set, std::size_t input, const SampledFilter<capacity>& filter,
                             const StateOutputs<capacity>& outputs, bool longer) {
    return delta_signal(filter, outputs, data_set.u[input], data_set.hold, data_set.delays[input], longer);
}

/// p^m/A .. 1/A of an input.
DeltaSignal filtered_input(const RegressionData& data_set, std::size_t input, const SampledFilter<4>& filter,
                           const VectorView& den, bool longer) {
    return outputs_of_input(data_set, input, filter, derivatives(den, data_set.zeros[input]), longer);
}

DeltaSignal simulated(const RegressionData& data_set, std::size_t input, const VectorView& A, const Vector& B,
                      bool longer) {
    const StateOutputs<4> of_z = derivatives(A, static_cast<int>(B.size()) - 1);
    StateOutputs<4> output;
    output.count = 1;
    for (int j = 0; j < of_z.count; ++j) {
        output.C[0].add(B[j], of_z.C[j]);
        output.D[0] += B[j] * of_z.D[j];
    }
    return outputs_of_input(data_set, input, SampledFilter<4>(A, data_set.sampling.Ts, false), output, longer);
}

/// A signal as it is.
DeltaSignal unfiltered(const SampleView& samples) {
    DeltaSignal signal;
    signal.chain.samples = samples.data();
    signal.chain.count = samples.size();
    signal.count = 1;
    signal.outputs[0][0] = 1;
    return signal;
}

/// SRIVC's instruments -p^(n-1) B/A^2 .. -B/A^2, p^m/A .. 1/A of one input: of z = u/A and w = z/A.
template <int capacity>
DeltaSignal sensitivities(const RegressionData& data_set, std::size_t input, const SampledFilter<capacity>& cascade,
                          const VectorView& A, const Vector& B, bool longer) {
    const int n = cascade.poles, m = static_cast<int>(B.size()) - 1;
    // Row r: p^r w, from A(p) w = z for r >= n.
    StateVector<capacity> derivatives_of_w[capacity];
    for (int r = 0; r < 2 * n; ++r) {
        derivatives_of_w[r][2 * n - 1 - r] = 1;
        if (r >= n)
            for (int i = 1; i <= n; ++i) derivatives_of_w[r].add(-A[i], derivatives_of_w[r - i]);
    }
    const StateOutputs<4> of_z = derivatives(A, m);
    StateOutputs<capacity> outputs;
    outputs.count = n + m + 1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= m; ++j) outputs.C[i].add(-B[j], derivatives_of_w[n - 1 - i + m - j]);
    for (int i = 0; i <= m; ++i) {
        std::copy_n(of_z.C[i].at, n, outputs.C[n + i].at);
        outputs.D[n + i] = of_z.D[i];
    }
    return outputs_of_input(data_set, input, cascade, outputs, longer);
}

/// p^(n-1)/E .. 1/E of the sampled output of B/A, then p^m/E .. 1/E of the input, which is held: products of the
/// sampled systems' numerators over A E.
DeltaSignal auxiliary(const RegressionData& data_set, std::size_t input, const SampledFilter<4>& filter,
                      const VectorView& E, const VectorView& A, const Vector& B, const DeltaSignal& filtered_y) {
    const int n = filter.poles;
    const DeltaSignal of_u = filtered_input(data_set, input, filter, E, false);
    const DeltaSignal model = simulated(data_set, input, A, B, false);
    StateVector<4> of_filter, of_model;
    std::copy_n(of_u.chain.alpha.data(), n, of_filter.at);
    std::copy_n(model.chain.alpha.data(), n, of_model.at);
    DeltaSignal signal;
    signal.chain = model.chain;
    signal.chain.order = 2 * n;
    std::copy_n(delta_product(of_filter, of_model, n).at, 2 * n, signal.chain.alpha.data());
    signal.count = n + of_u.count;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            for (int row = 0; row < n; ++row)
                signal.outputs[row][i + j] += model.outputs[0][j] * filtered_y.outputs[1 + row][i];
            for (int row = 0; row < of_u.count; ++row)
                signal.outputs[n + row][i + j] += (j < n ? of_model[j] : 1) * of_u.outputs[row][i];
        }
    return signal;
}

/// The signals of an equation; those of one input need no memory on the heap.
class DeltaSignals {
  public:
    explicit DeltaSignals(std::size_t count) { signals_.reserve(count); }

    /// The number of its first output, all being numbered through.
    Index add(const DeltaSignal& signal) {
        const Index first = outputs_;
        outputs_ += signal.count;
        signals_.push_back(signal);
        return first;
    }
    const DeltaSignal& operator[](std::size_t i) const { return signals_[i]; }

    /// Of two signals or more: the sums of products of all outputs, or of all but the first signal's among themselves
    /// (first_alone = false); nothing where a pair has no loop.
    std::optional<Matrix> products(Index N, bool first_alone = true) const {
        Matrix total(outputs_, outputs_);
        const std::size_t last = signals_.size() - 1;
        Index row = 0;
        for (std::size_t i = 0; i < last; row += signals_[i++].count) {
            Index column = row;
            for (std::size_t j = i + 1; j <= last; ++j) {
                const bool own = j == i + 1 && (i > 0 || first_alone);
                const bool highest = signals_[j].sees_highest();
                const auto products = delta_products(signals_[i].chain, signals_[j].chain, N, {own, highest});
                if (!products) return {};
                if (own) set(products->first, i, row, i, row, total);
                column += signals_[j - 1].count;
                set(products->both, i, row, j, column, total);
                if (i + 1 == j && j == last) set(products->second, j, column, j, column, total);
            }
        }
        return total;
    }

  private:
    /// The block of two signals' outputs, and its mirror image.
    void set(const ColumnMatrix& products, std::size_t left, Index row, std::size_t right, Index column,
             Matrix& total) const {
        const DeltaSignal &L = signals_[left], &R = signals_[right];
        const Index columns = products.rows();
        double weighted[kMaxDeltaOrder + 1];
        for (int j = 0; j < R.count; ++j) {
            for (Index a = 0; a < columns; ++a) {
                double sum = 0;
                for (Index b = 0; b < products.cols(); ++b) sum += R.outputs[j][b] * products(a, b);
                weighted[a] = sum;
            }
            for (int i = 0; i < L.count; ++i) {
                double sum = 0;
                for (Index a = 0; a < columns; ++a) sum += L.outputs[i][a] * weighted[a];
                total(row + i, column + j) = total(column + j, row + i) = sum;
            }
        }
    }

    std::array<std::byte, 3 * sizeof(DeltaSignal)> buffer_;
    std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
    std::pmr::vector<DeltaSignal> signals_{&memory_};
    Index outputs_ = 0;
};

/// Which outputs the equation is made of.
struct EquationOutputs {
    Index n = 0;
    std::vector<Index> instruments;  ///< where the first n instruments of each input begin
    double sign = 1;                 ///< of these
    std::vector<Index> inputs;       ///< the derivatives of all inputs; p^n y_f .. y_f are the first outputs

    NormalEquations equations(const Matrix& products, double gain, bool with_gram) const {
        const Index d = n + static_cast<Index>(inputs.size());
        // Rows of z: of p^n y_f .. y_f, then of all inputs' derivatives, then of z itself.
        const auto times_z = [&](Index output, auto&& column) {
            for (Index i = 0; i < n; ++i) {
                double sum = 0;
                for (const Index first : instruments) sum += products(first + i, output);
                column[i] = gain * gain * sign * sum;
            }
            for (Index i = n; i < d; ++i)
                column[i] = gain * gain * products(inputs[static_cast<std::size_t>(i - n)], output);
        };
        NormalEquations sums{Matrix(d, d), Vector(d), Matrix(), 0};
        times_z(0, sums.z_y);
        for (Index j = 0; j < n; ++j) {
            times_z(1 + j, sums.z_phi.col(j));
            sums.z_phi.col(j) *= -1;
        }
        for (Index j = n; j < d; ++j) times_z(inputs[static_cast<std::size_t>(j - n)], sums.z_phi.col(j));
        if (!with_gram) return sums;
        sums.z_z = Matrix::Zero(d, d);
        Vector column(d);
        for (Index j = 0; j < n; ++j)
            for (const Index first : instruments) {
                times_z(first + j, column);
                sums.z_z.col(j) += sign * column;
            }
        sums.z_z.rightCols(d - n) = sums.z_phi.rightCols(d - n);
        return sums;
    }
};

/// Regularly sampled, and not so slowly that the filter 1/A forgets everything from one sample to the next: states that
/// follow their input at once are no combinations of its differences.
bool is_sampled_for(const RegressionData& data_set, const VectorView& A) {
    constexpr double kFastestPole = 5;  // mean of the poles times the sampling time
    const double Ts = data_set.sampling.Ts;
    return Ts > 0 && data_set.y.size() > 1 && A.allFinite() && A.size() > 1 &&
           std::abs(A[1]) * Ts < kFastestPole * static_cast<double>(A.size() - 1);
}

/// Whether an input's chain needs another column (delta_signal): all then have one.
bool needs_longer(const RegressionData& data_set) {
    return data_set.hold == Hold::kFoh &&
           std::any_of(data_set.delays.begin(), data_set.delays.end(),
                       [&](double delay) { return split_delay(delay, data_set.sampling.Ts).rest > 0; });
}

/// Models whose chains have loops.
bool has_loops(const VectorView& den) {
    constexpr Index kMaxPoles = 4;
    return den.size() > 1 && den.size() - 1 <= kMaxPoles;
}

void append_range(std::vector<Index>& places, Index first, Index count) {
    for (Index i = 0; i < count; ++i) places.push_back(first + i);
}

}  // namespace

std::optional<NormalEquations> delta_svf_equations(const RegressionData& data_set, const VectorView& E, double gain) {
    if (!has_loops(E) || !is_sampled_for(data_set, E)) return {};
    const bool longer = needs_longer(data_set);
    EquationOutputs equation{E.size() - 1, {1}, -1, {}};
    DeltaSignals signals(1 + data_set.u.size());
    const SampledFilter<4> filter(E, data_set.sampling.Ts, false);
    signals.add(filtered_output(data_set, filter, E));
    for (std::size_t j = 0; j < data_set.u.size(); ++j)
        append_range(equation.inputs, signals.add(filtered_input(data_set, j, filter, E, longer)),
                     data_set.zeros[j] + 1);
    const std::optional<Matrix> products = signals.products(data_set.y.size());
    if (!products) return {};
    NormalEquations sums = equation.equations(*products, gain, false);
    sums.z_z = sums.z_phi;
    sums.y_y = gain * gain * (*products)(0, 0);
    return sums;
}

std::optional<NormalEquations> delta_auxiliary_equations(const RegressionData& data_set, const VectorView& E,
                                                         const VectorView& A, const std::vector<Vector>& B,
                                                         double gain) {
    if (!has_loops(E) || !is_sampled_for(data_set, E) || data_set.hold != Hold::kZoh || A.size() != E.size() ||
        !is_sampled_for(data_set, A))
        return {};
    for (const Vector& numerator : B)
        if (numerator.size() >= A.size()) return {};
    const Index n = E.size() - 1;
    EquationOutputs equation{n, {}, -1, {}};
    DeltaSignals signals(1 + data_set.u.size());
    const SampledFilter<4> filter(E, data_set.sampling.Ts, false);
    signals.add(filtered_output(data_set, filter, E));
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        const Index first = signals.add(auxiliary(data_set, j, filter, E, A, B[j], signals[0]));
        equation.instruments.push_back(first);
        append_range(equation.inputs, first + n, data_set.zeros[j] + 1);
    }
    const std::optional<Matrix> products = signals.products(data_set.y.size(), false);
    if (!products) return {};
    return equation.equations(*products, gain, true);
}

namespace {

/// Whether products of the sensitivities, which have each pole twice, would lose more than half of the digits: the
/// product of the poles is small beside a power of their sum then.
bool poles_far_apart(const SampledFilter<4>& filter) {
    constexpr double kFarApart = 1e4;
    const int n = filter.poles;
    if (n <= 2) return false;
    const StateVector<4> alpha = delta_polynomial(filter.E, n);
    return std::abs(alpha[0]) * kFarApart < std::pow(alpha[n - 1], n);
}

template <int capacity>
std::optional<NormalEquations> refined(const RegressionData& data_set, const VectorView& A,
                                       const std::vector<Vector>& B, bool with_gram) {
    const Index n = A.size() - 1;
    const SampledFilter<capacity> cascade(A, data_set.sampling.Ts, true);
    const SampledFilter<4> filter = cascade.first();
    if (poles_far_apart(filter)) return {};
    EquationOutputs equation{n, {}, 1, {}};
    DeltaSignals signals(1 + data_set.u.size());
    signals.add(filtered_output(data_set, filter, A));
    const bool longer = needs_longer(data_set);
    for (std::size_t j = 0; j < data_set.u.size(); ++j) {
        const Index first = signals.add(sensitivities(data_set, j, cascade, A, B[j], longer));
        equation.instruments.push_back(first);
        append_range(equation.inputs, first + n, B[j].size());
    }
    const std::optional<Matrix> products = signals.products(data_set.y.size(), false);
    if (!products) return {};
    return equation.equations(*products, 1, with_gram);
}

}  // namespace

std::optional<NormalEquations> delta_refined_equations(const RegressionData& data_set, const VectorView& A,
                                                       const std::vector<Vector>& B, bool with_gram) {
    if (!has_loops(A) || !is_sampled_for(data_set, A)) return {};
    return A.size() - 1 <= 2 ? refined<4>(data_set, A, B, with_gram) : refined<8>(data_set, A, B, with_gram);
}

std::optional<Matrix> delta_output_products(const RegressionData& data_set, const std::vector<Vector>& A,
                                            const std::vector<Vector>& B) {
    const auto fits = [&](const Vector& den) { return den.size() == A[0].size() && is_sampled_for(data_set, den); };
    if (!has_loops(A[0]) || !std::all_of(A.begin(), A.end(), fits)) return {};
    const bool longer = needs_longer(data_set);
    DeltaSignals signals(1 + data_set.u.size());
    signals.add(unfiltered(data_set.y));
    for (std::size_t j = 0; j < data_set.u.size(); ++j) signals.add(simulated(data_set, j, A[j], B[j], longer));
    return signals.products(data_set.y.size());
}

}  // namespace dynlab::inline numerics
