#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

// Results of particular methods in addition to a model.

/// Noise v = C(q^-1)/D(q^-1) e of an estimated model, monic, with standard errors (zero for the leading ones). C and D
/// are in powers of q^-1.
struct NoiseModel {
    Vector C, D, C_std, D_std;
    double Ts = 0;  ///< s, of the samples that q counts
};

/// The static part of a Hammerstein model: linear interpolation between K levels at the edges of bins.
struct StaticCharacteristic {
    Vector breakpoints;             ///< K edges of the bins, in units of the input
    Vector levels, levels_std;      ///< K values there, in units of the output
    double linear_fit_percent = 0;  ///< of the best linear model of the same orders
};

/// Parameter estimates of a recursive method over time: M instants, d parameters.
struct ParameterHistory {
    Vector t;           ///< M, instants of samples
    Matrix theta, std;  ///< M x d; NaN where the samples so far do not determine them
};

}  // namespace dynlab::inline numerics
