#pragma once
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/criteria/output_error_model.h"
#include "numerics/linalg/types.h"
#include "numerics/models/process_model.h"
#include "numerics/signals/iddata.h"

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

/// The input of one record for a process model, TIMES COUNTED IN SAMPLES, or in mean steps with irregular sampling.
struct ProcessInput {
    Vector u;
    Hold hold = Hold::kZoh;
    Vector t;  ///< instants from 0 on; empty with regular sampling
};

/// How many initial values each experiment has under a start condition.
Index initial_value_count(const ProcessStructure& structure, const StartCondition& condition);

/// A process model's output as a function of [model parameters; initial values of each experiment; offset of each
/// experiment], for the output-error search, in the times of its ProcessInputs. Rows are stacked experiment by
/// experiment. With a start condition other than zero the model rests at u[0] before each record, so that its output
/// is Kp u[0] + B/A (u - u[0]) (+ free motion from n initial values of y, dy/dt, ... in the deviation from rest)
/// (+ offset). An integrating process has no such rest: there the input is taken as it is, and the n initial values,
/// the integrator's among them, are those of the output from rest at zero input.
class ProcessOutput : public OutputErrorModel {
  public:
    /// The delay lies between the two bounds, where the structure has one.
    ProcessOutput(const ProcessStructure& structure, const StartCondition& condition, std::vector<ProcessInput> inputs,
                  double least_delay, double largest_delay);

    Index parameter_count() const override { return lower_.size(); }
    const Vector& lower() const override { return lower_; }
    const Vector& upper() const override { return upper_; }
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;

    const ProcessStructure& structure() const { return structure_; }
    Index model_parameters() const { return model_parameters_; }
    Index initial_values() const { return initial_values_; }  ///< of each experiment
    bool has_offset() const { return condition_.offset; }
    Index initial_place(std::size_t experiment) const;
    Index offset_place(std::size_t experiment) const;

    std::size_t experiment_count() const { return records_.size(); }
    Index row(std::size_t experiment) const { return records_[experiment].row; }
    Index rows(std::size_t experiment) const { return records_[experiment].input.u.size(); }
    Index longest() const;  ///< rows of the longest record
    /// Counted from the resting input.
    const ProcessInput& input(std::size_t experiment) const { return records_[experiment].input; }
    double resting_input(std::size_t experiment) const { return records_[experiment].resting; }

  private:
    struct Record {
        ProcessInput input;
        double resting = 0;
        Index row = 0;  // the first of its stacked rows
    };
    Matrix motions(const ProcessInput& input, const VectorView& den) const;
    void set_bounds(double least_delay, double largest_delay);
    void simulate_record(std::size_t experiment, const ProcessCoefficients& c, const Vector& theta, Vector& output,
                         Matrix* sensitivities) const;

    ProcessStructure structure_;
    StartCondition condition_;
    std::vector<Record> records_;
    Index samples_ = 0, model_parameters_ = 0, initial_values_ = 0;
    Vector lower_, upper_;
};

}  // namespace dynlab::inline numerics
