#include "numerics/filters/normal_equations.h"
#include "numerics/filters/transfer_filters.h"
#include "numerics/filters/transfer_sensitivity.h"

namespace dynlab::inline numerics {

namespace {

/// With regular sampling by Ts, otherwise by the instants.
template <class Regular, class Irregular>
auto by_sampling(const Sampling& sampling, const Regular& regular, const Irregular& irregular) {
    return sampling.Ts > 0 ? regular(sampling.Ts) : irregular(VectorView(sampling.t));
}

class ExactTransferFilters : public TransferFilters {
  public:
    Vector response(const VectorView& B, const VectorView& A, double delay, const VectorView& u,
                    const Sampling& sampling, Hold hold) const override {
        const auto at = [&](const auto& when) { return transfer_response(B, A, delay, u, when, hold); };
        return by_sampling(sampling, at, at);
    }
    Matrix sensitivities(const VectorView& B, const VectorView& A, double delay, const VectorView& u,
                         const Sampling& sampling, Hold hold) const override {
        const auto at = [&](const auto& when) { return transfer_sensitivities(B, A, delay, u, when, hold); };
        return by_sampling(sampling, at, at);
    }
    Matrix free_responses(const VectorView& A, Index N, const Sampling& sampling) const override {
        return by_sampling(
            sampling, [&](double Ts) { return numerics::free_responses(A, N, Ts); },
            [&](const VectorView& t) { return numerics::free_responses(A, t); });
    }
    Matrix free_sensitivities(const VectorView& A, const VectorView& initial, Index N,
                              const Sampling& sampling) const override {
        return by_sampling(
            sampling, [&](double Ts) { return numerics::free_sensitivities(A, initial, N, Ts); },
            [&](const VectorView& t) { return numerics::free_sensitivities(A, initial, t); });
    }

    NormalEquations svf(const RegressionData& data_set, const VectorView& E, double gain) const override {
        return svf_equations(data_set, E, gain);
    }
    NormalEquations auxiliary(const RegressionData& data_set, const VectorView& E, const VectorView& A,
                              const std::vector<Vector>& B, double gain) const override {
        return auxiliary_equations(data_set, E, A, B, gain);
    }
    NormalEquations refined(const RegressionData& data_set, const VectorView& A, const std::vector<Vector>& B,
                            bool with_gram) const override {
        return refined_equations(data_set, A, B, with_gram);
    }
    double output_error_squares(const RegressionData& data_set, const std::vector<Vector>& A,
                                const std::vector<Vector>& B) const override {
        return numerics::output_error_squares(data_set, A, B);
    }
};

}  // namespace

const TransferFilters& transfer_filters() {
    static const ExactTransferFilters kFilters;
    return kFilters;
}

}  // namespace dynlab::inline numerics
