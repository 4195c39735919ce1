#pragma once
#include "numerics/criteria/reparametrized.h"
#include "numerics/criteria/transfer_output.h"
#include "numerics/models/process_model.h"

namespace dynlab::inline numerics {

/// Coefficients of B/A exp(-delay s) of a process model and their derivatives with respect to its parameters q.
struct ProcessCoefficients {
    Vector num, den;  ///< den monic
    double delay = 0;
    Matrix num_by_parameter;  ///< (m + 1) x q
    Matrix den_by_parameter;  ///< n x q, of a_1..a_n
};

/// For every structure; `parameters` as in ProcessModel, in any unit of time. With I the denominator has the factor p.
ProcessCoefficients process_coefficients(const ProcessStructure& structure, const Vector& parameters);

/// Derivatives of [a_1..a_n b_0..b_m], followed by the delay when the structure has one, with respect to the
/// parameters.
Matrix coefficients_by_parameter(const ProcessModel& model);

/// Its poles (the integrator's among them) and zeros, with a free delay where the process has one.
TransferStructure transfer_structure(const ProcessStructure& structure);

/// kOwnGain without an integrator, kNothing with one.
TransferOutput::AtRest at_rest(const ProcessStructure& structure);

/// A process model's output, that of the transfer functions with its coefficients, as a function of [parameters of the
/// process; initial values and offsets of `output`], with TIMES COUNTED IN output.time_unit(). `output` has
/// transfer_structure(structure) and rests as at_rest(structure) says; it must outlive this. The gain is what a process
/// at rest answers with, so that no other parameter bears on that part, not even by rounding. A process with an
/// integrator has no rest but that at zero input: `output` then takes its inputs as they are, and the initial values,
/// the integrator's among them, are those of the output itself.
Reparametrized process_output(const ProcessStructure& structure, const TransferOutput& output);

/// Factors that bring the parameters of process_output() back to seconds.
Vector process_seconds(const ProcessStructure& structure, const TransferOutput& output);

}  // namespace dynlab::inline numerics
