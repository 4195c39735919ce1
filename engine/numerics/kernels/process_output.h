#pragma once
#include "numerics/kernels/initial_conditions.h"
#include "numerics/kernels/output_error.h"
#include "numerics/linalg/types.h"
#include "numerics/models/process_model.h"
#include "numerics/signals/iddata.h"

namespace dynlab {

/// Coefficients of B/A exp(-delay s) of a process model and their derivatives with respect to its parameters q.
struct ProcessCoefficients {
    Vector num, den;  ///< den monic
    double delay = 0;
    Matrix num_by_parameter;  ///< (m + 1) x q
    Matrix den_by_parameter;  ///< n x q, of a_1..a_n
};

/// For structures P1, P2, P2U, each with or without D. `parameters` as in ProcessModel, in any unit of time.
ProcessCoefficients process_coefficients(const ProcessStructure& structure, const Vector& parameters);

/// Derivatives of [a_1..a_n b_0..b_m], followed by the delay when the structure has one, with respect to the
/// parameters.
Matrix coefficients_by_parameter(const ProcessModel& model);

/// Throws InvalidArgument that names the structures process_coefficients knows.
void require_supported(const ProcessStructure& structure);

/// A process model's output as a function of [model parameters, initial values, offset], for the output-error
/// search. TIMES ARE COUNTED IN SAMPLES here. With a start condition other than zero the model rests at
/// u[0] before the record, so that its output is Kp u[0] + B/A (u - u[0]) (+ free motion from `n` initial values
/// of y, dy/dt, ... in the deviation from rest) (+ offset).
class ProcessOutput : public OutputErrorModel {
  public:
    ProcessOutput(const ProcessStructure& structure, const StartCondition& condition, const VectorView& u, Hold hold,
                  double least_delay, double largest_delay);

    Index parameter_count() const override { return lower_.size(); }
    const Vector& lower() const override { return lower_; }
    const Vector& upper() const override { return upper_; }
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;

    Index model_parameters() const { return model_parameters_; }
    Index initial_values() const { return initial_values_; }
    bool has_offset() const { return condition_.offset; }
    double resting_input() const { return resting_input_; }
    const Vector& input() const { return input_; }  ///< counted from the resting input
    Hold hold() const { return hold_; }
    const ProcessStructure& structure() const { return structure_; }

  private:
    ProcessStructure structure_;
    StartCondition condition_;
    Vector input_;
    Hold hold_;
    double resting_input_ = 0;
    Index model_parameters_ = 0, initial_values_ = 0;
    Vector lower_, upper_;
};

}  // namespace dynlab
