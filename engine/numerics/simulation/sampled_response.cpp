#include "numerics/simulation/sampled_response.h"

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"
#include "numerics/simulation/frequency_response.h"

namespace dynlab::inline numerics {

Eigen::MatrixXcd sampled_responses(const MatrixView& numerators, const VectorView& denominator, const VectorView& w,
                                   double Ts, Hold hold, double delay) {
    const Index order = denominator.size() - 1, outputs = numerators.rows();
    Eigen::MatrixXcd responses = Eigen::MatrixXcd::Constant(w.size(), outputs, Complex(kNaN, kNaN));
    const Vector direct = numerators.col(0);
    const Matrix C = numerators.rightCols(order) - direct * denominator.tail(order).transpose();
    const SampledSystem system = discretize(companion(denominator), Vector::Unit(order, 0), C, direct, Ts, hold, delay);
    if (!system.F.allFinite() || !system.G.allFinite()) return responses;
    for (Index k = 0; k < w.size(); ++k) {
        const Complex z = std::polar(1.0, w[k] * Ts), late = std::pow(z, -static_cast<double>(system.delay));
        const Eigen::Vector3cd inputs(late * z, late, late / z);
        const auto inverse = inverse_of_regular(Eigen::MatrixXcd(z * Matrix::Identity(order, order) - system.F));
        if (!inverse) continue;
        const ComplexVector state = *inverse * (system.G * inputs);
        responses.row(k) = (system.C * state + system.D * inputs.tail<2>()).transpose();
    }
    return responses;
}

ComplexVector response_between_samples(const TransferFunction& G, const VectorView& w, double Ts,
                                       InterSample inter_sample) {
    if (inter_sample == InterSample::kBandLimited || !G.continuous() || Ts == 0) return frequency_response(G, w);
    if (!G.proper())
        throw InvalidArgument(
            "frequency response: with a zero-order hold input (zoh), the model must have at least as many poles as "
            "zeros");
    if (!w.allFinite()) throw InvalidArgument("frequency response: the frequencies contain a value that is not finite");
    if (G.pole_count() == 0) {
        // a gain: as much of it arrives as the delay lets through
        const TransferFunction first(Vector(G.num()[0] * Vector{{1.0, 1.0}}), Vector{{1.0, 1.0}}, 0, G.delay());
        return response_between_samples(first, w, Ts, inter_sample);
    }
    Matrix numerator = Matrix::Zero(1, G.pole_count() + 1);
    numerator.row(0).tail(G.num().size()) = G.num().transpose();
    return sampled_responses(numerator, G.den(), w, Ts, inter_sample == InterSample::kZoh ? Hold::kZoh : Hold::kFoh,
                             G.delay())
        .col(0);
}

}  // namespace dynlab::inline numerics
