#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Behavior of the input between the samples of the data from which a response was estimated.
enum class InterSample {
    kBandLimited,  ///< a sum of sines below pi/Ts: the response is that of the continuous-time system, G(i w)
    kZoh,          ///< held: the response is that of the sampled system, G_d(exp(i w Ts))
    kFoh,          ///< linearly interpolated between the samples
};
InterSample inter_sample_of(Hold hold);  ///< zoh or foh

/// What a periodic output holds at lines of one kind, each as its part of the output's variance.
struct OutputLevels {
    Vector w;           ///< rad/s
    Vector power;       ///< of the mean over the periods, mean over the realizations
    Vector noise;       ///< what noise adds to it; empty with one period
    Vector distortion;  ///< what nonlinear distortion adds to it; empty where it is not known
};

/// A measured frequency response of one input and one output, and what is known of its errors. With Ts > 0 (s) it was
/// found from samples, and frequencies end at pi/Ts.
struct FrequencyData {
    Vector w;                ///< rad/s, rising
    ComplexVector response;  ///< at each w
    Vector variance;  ///< mean of |error|^2, half of it in the real and half in the imaginary part; empty: unknown
    double Ts = 0;    ///< s
    InterSample inter_sample = InterSample::kBandLimited;
    std::string input_name = "u1", output_name = "y1", input_unit, output_unit;

    bool neighbors_share_errors = false;  ///< the response was smoothed over the frequencies

    Vector noise_variance;      ///< of bla: the part of `variance` that noise makes
    Vector distortion;          ///< of bla: variance of the response of one realization that nonlinearity makes
    Eigen::MatrixXcd realized;  ///< of bla: the response of each realization, a column each; empty with one
    Vector coherence;           ///< of spa and etfe: 0 to 1
    Vector noise_spectrum;      ///< of spa and etfe: power per sample
    OutputLevels excited;       ///< of bla: at the lines of w
    OutputLevels odd, even;     ///< of bla: at odd and even lines without input
    std::string method;         ///< that gave it
    Message message;            ///< its sentence
    std::vector<Message> warnings;
};

/// The response of a list of frequencies (rad/s), in rising order. `variance` may be empty or one value for all. Throws
/// InvalidArgument as check_frequency_data().
FrequencyData frequency_data(const ComplexVector& response, const VectorView& w, const VectorView& variance,
                             double Ts = 0, InterSample inter_sample = InterSample::kBandLimited);

/// Throws an InvalidArgument that begins with `caller` for no frequency, sizes that differ, frequencies (rad/s) that
/// are not positive, not rising or above pi/Ts, values that are not finite, variances that are not positive, Ts (s)
/// below zero, and a hold without Ts.
void check_frequency_data(const std::string& caller, const FrequencyData& data);

}  // namespace dynlab::inline numerics
