#pragma once
#include <optional>

#include "base/message.h"
#include "numerics/models/frequency_data.h"
#include "numerics/models/transfer_function.h"
#include "numerics/validation/uncertainty.h"

namespace dynlab::inline figures {

/// What is known of an estimated model's uncertainty, and how much of it a figure shows.
struct ModelConfidence {
    UncertainModel model;
    double level = 0.99;  ///< probability that a band holds the truth, point by point
};

/// How a measurement was sampled that models are drawn beside.
struct MeasuredSamples {
    double Ts = 0;  ///< s
    InterSample inter_sample = InterSample::kBandLimited;
    bool held() const { return Ts > 0 && inter_sample != InterSample::kBandLimited; }
};

/// A model with the name that the legend shows (no entry when empty).
struct NamedModel {
    Message name;
    TransferFunction G;
    std::optional<ModelConfidence> confidence = {};  ///< for bands and ellipses
    /// Of an input that is held between samples: frequency responses of a continuous-time model are those that such
    /// samples show, up to pi/Ts, and the legend says so.
    MeasuredSamples beside = {};
};

/// A measured response with the name that the legend shows, and the probability that its bands hold the truth.
struct NamedResponse {
    Message name;
    FrequencyData data;
    double level = 0.99;
};

}  // namespace dynlab::inline figures
