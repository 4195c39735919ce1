#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// State of a simulated system before its first sample.
enum class InitialState {
    kZero,      ///< "none" or "zero": at rest with zero input
    kSteady,    ///< "steady": at rest with the first input value
    kEstimate,  ///< "estimate": as steady, plus a free motion whose initial values are estimated
    kAuto,      ///< "auto": whichever of these explains the output best (smallest BIC)
};

/// A constant that is no answer to the input.
enum class Offset {
    kNone,      ///< "none"
    kRemove,    ///< "remove": input and output are counted from the operating point, see joint_operating_point
    kEstimate,  ///< "estimate": a constant is added to the model's output and estimated
    kAuto,      ///< "auto": none or estimate, by BIC
};

/// Operating point of the signals of one experiment. A step experiment (inputs, N x nu, that change at most once each)
/// rests at its values before the step: the first input values, and the mean output up to the sample of the first step.
/// Inputs that never change are a step from zero at the first sample: both are zero. For all other data the operating
/// point is the mean of the signals.
struct JointOperatingPoint {
    Vector inputs;  ///< nu
    double output = 0;
};
JointOperatingPoint joint_operating_point(const MatrixView& u, const VectorView& y);

/// One way a model may start: what "auto" chooses among.
struct StartCondition {
    InitialState state;  ///< never kAuto
    bool offset;         ///< a constant is estimated
};

/// Returns the conditions that the options allow and the inputs (N x nu) can distinguish, sorted by number of
/// parameters. With a constant input a steady start contains no information, and a free motion with an offset would
/// hide the gain. Throws InvalidArgument if the options ask for one of these.
std::vector<StartCondition> start_conditions(const MatrixView& u, InitialState state, Offset offset);
/// Returns the conditions that the inputs of all experiments together can distinguish.
std::vector<StartCondition> start_conditions(const IdData& data, InitialState state, Offset offset);

/// "from rest at zero input, with an estimated offset" and the like, for messages.
Message description(const StartCondition& condition);

/// ln V + d ln(N)/N for the mean square V, which is counted as no less than rounding leaves of outputs of mean
/// square `output_power`.
double bic_of_loss(double mean_square, double output_power, Index samples, Index parameters);

/// A fit to data whose inputs never change: they teach only through the transient after a step at the first sample.
struct StepFit {
    double loss;          ///< mean square of its errors
    double spread;        ///< mean square of the outputs about each experiment's mean
    double output_power;  ///< mean square of the outputs
    Index samples, parameters, experiments;
};
/// Throws InvalidArgument that begins with `caller` and names the poor excitation when the fit explains the outputs no
/// better, by BIC, than one constant per experiment does.
void require_transient(const std::string& caller, const StepFit& fit);

}  // namespace dynlab::inline numerics
