#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "base/message.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/simulation/noise.h"
#include "numerics/validation/compare.h"

namespace dynlab::inline numerics {

/// A model with what it says of its noise: y = sum_i G_i u_i + v, v(k) = H(q) e(k) with white e and monic H. Without a
/// noise model H = 1.
struct NoisyModel {
    std::vector<TransferFunction> channels;             ///< all G, as compare_all() takes them
    std::shared_ptr<const PolynomialModel> polynomial;  ///< of a difference equation: H = C/(A D)
    Vector C = Vector::Ones(1), D = Vector::Ones(1);    ///< otherwise H = C/D, in powers of q^-1, for one output
    double noise_Ts = 0;                                ///< s, the samples that C and D count; 0 when unknown

    bool has_noise_model() const;  ///< H is not 1
};

/// H as one filter of white noise.
ColoredNoise noise_of(const NoisyModel& model);

/// The first `count` values 1, h_1, h_2, ... of the impulse response of H, by long division.
Vector noise_impulse_response(const NoisyModel& model, Index count);

/// A model of a difference equation as its orders and their parameters.
struct OrderedParameters {
    PolynomialOrders orders;
    Vector theta;
};
OrderedParameters ordered_parameters(const PolynomialModel& model);

struct PredictionOptions {
    std::optional<Index> steps = 1;  ///< samples ahead, from 1 on; nothing: infinitely many, a simulation
    CompareOptions start;
};

/// One output of one experiment.
struct PredictedOutput {
    Vector output;           ///< N; the recorded output before `first`
    Vector errors;           ///< N, e: measured minus predicted one step ahead; zero before `first`
    Index first = 0;         ///< the first sample (0-based) that is predicted
    double fit_percent = 0;  ///< of `output` from there on
};

struct Predictions {
    std::vector<std::vector<PredictedOutput>> results;  ///< [experiment][output]
    Vector fit_percent;                                 ///< per output over all experiments
    Vector loss;      ///< per output, mean square of `errors` over the samples that are predicted
    Message message;  ///< one sentence
    /// N x ny outputs of one experiment (0-based), and measured minus predicted ones.
    Matrix outputs(std::size_t experiment) const;
    Matrix output_errors(const IdData& data, std::size_t experiment) const;
};

/// The output y(k) predicted from the inputs up to k and the outputs up to k - steps. With e the one-step errors, its
/// error is the part of v that is not known yet (Ljung 1999, section 3.2),
///     y(k) - y(k | k - steps) = sum_{i < steps} h_i e(k - i).
/// Start conditions and offset:
/// * H = 1: the prediction is the simulation of compare_all() with the same options;
/// * H = C/D: what compare_all() simulates is taken from y, e = D/C of the rest from its nd-th sample on, whose past is
///   known (fit/discrete/arma_noise.h);
/// * a difference equation: e is that of fit/discrete/prediction_model.h, initial values and offset are those that
/// predict best,
///   and "auto" chooses among the start conditions by BIC of e over the samples all of them predict. With A the
///   recorded outputs are the start: "auto" means "estimate" and no offset, as arx and armax have it.
/// Throws InvalidArgument for steps below one, data that do not fit the model or its sampling time (s), C or D
/// with a root on or outside the unit circle, and as compare_all().
Predictions predict(const IdData& data, const NoisyModel& model, const PredictionOptions& options = {});

}  // namespace dynlab::inline numerics
