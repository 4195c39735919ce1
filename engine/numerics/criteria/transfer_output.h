#pragma once
#include <map>
#include <string>
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/criteria/output_error_model.h"
#include "numerics/filters/regression_data.h"
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The outputs of a continuous-time model in all experiments, for the output-error search, as a function of [parameters
/// of the structure; for each channel its gain at rest, where it is a separate parameter; for each experiment and
/// output the initial values of its free motions, when estimated; for each experiment and output its offset, when
/// estimated]. The rows are stacked by experiment, within an experiment by output. TIMES ARE COUNTED IN time_unit()
/// HERE, the sampling time or the mean step, so that numbers stay near one; seconds() converts them back. Outputs and
/// sensitivities are exact for regular and irregular sampling, zoh and foh, and any delay.
///
/// With a start other than zero each channel rests at the first value of its input, so that it adds
/// B(0)/A(0) u(0) + B/A (u - u(0)); with an estimated state each different denominator of an output adds a free
/// motion of n initial values (of y, dy/dt, ... in the deviation from rest).
class TransferOutput : public OutputErrorModel {
  public:
    /// What a channel makes of an input that has always been there.
    enum class AtRest {
        kCoefficients,  ///< B(0)/A(0) times that input
        kOwnGain,       ///< a separate parameter for the gain: the coefficients affect changes only
        kNothing,       ///< an integrator does not rest there: inputs are taken as they are
    };

    /// `least_delay` and `largest_delay` (s) bound free delays. Throws InvalidArgument when the data have other numbers
    /// of inputs or outputs than the structure.
    TransferOutput(const TransferStructure& structure, const StartCondition& condition, const IdData& data,
                   double least_delay, double largest_delay, AtRest at_rest = AtRest::kCoefficients);

    /// Not finite where a coefficient is beyond all use, instead of failing there.
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;

    /// Unstable models count as unusable, as those that grow beyond all bounds do.
    void keep_stable();
    /// Holds parameters of the structure at values (s), by name. Throws InvalidArgument for a name that it lacks.
    void fix(const std::map<std::string, double>& values);
    /// The samples of the first seconds of each experiment do not count: their rows are zero, in target() too.
    void mask_start(double seconds);
    Index masked_rows() const override;
    /// Multiplies each output's rows, in target() too; ones at first.
    void set_weights(const Vector& weights);
    const Vector& weights() const { return weights_; }
    Vector target() const;  ///< the measured outputs, weighted

    double time_unit() const { return time_unit_; }     ///< s
    const Vector& seconds() const { return seconds_; }  ///< factors that bring each parameter back to seconds
    /// Number of initial values and offsets, which are the last parameters.
    Index linear_count() const { return parameter_count() - initial_start(0, 0); }
    /// That count, over all experiments, of each output.
    Index sample_count() const { return samples_ - masked_rows() / structure_.outputs; }

    std::size_t experiment_count() const { return experiments_.size(); }
    Index row(std::size_t experiment, Index output) const;  ///< the first of its N
    Index rows(std::size_t experiment) const { return experiments_[experiment].y.rows(); }
    Index counted_rows(std::size_t experiment) const { return rows(experiment) - experiments_[experiment].silent; }
    /// Where an output's initial values of one experiment lie among the parameters, and how many they are.
    Index initial_start(std::size_t experiment, Index output) const;
    Index initial_count(Index output) const;
    Index offset_index(std::size_t experiment, Index output) const;  ///< with estimated offsets only
    Index gain_index(Index output, Index input) const;               ///< with separate gains only
    bool has_own_gains() const { return own_gains_; }
    bool has_offset() const { return condition_.offset; }
    Hold hold() const { return hold_; }
    const Vector& times(std::size_t experiment) const { return experiments_[experiment].t; }
    const Matrix& inputs(std::size_t experiment) const { return experiments_[experiment].u; }
    const Vector& resting_inputs(std::size_t experiment) const { return experiments_[experiment].resting; }
    /// Which parameters the rows of an output depend on.
    std::vector<bool> bears_on(Index output) const;

  private:
    struct ExperimentData {
        Matrix u, y;       // the inputs counted from where they rest
        Vector resting;    // first inputs, or zeros
        Vector t;          // in time units from the first on; empty with regular sampling
        Index row = 0;     // the first of its stacked rows
        Index silent = 0;  // of each output, at the beginning

        Sampling sampling() const;  // in time units
    };
    struct Block;  // the rows of one output in one experiment
    void set_parameter_count();
    void set_channel(Index output, Index input, double least_delay, double largest_delay);
    void set_initial_units(std::size_t experiment, Index output);
    bool usable(const Vector& theta) const;
    void simulate_experiment(const Vector& theta, std::size_t e, Vector& output, Matrix* sensitivities) const;
    void add_channel(const Vector& theta, Index output, Index input, Block& block) const;
    void add_free_motion(const Vector& theta, Index denominator, Index place, Block& block) const;

    TransferStructure structure_;
    StartCondition condition_;
    bool own_gains_, stable_only_ = false;
    Hold hold_;
    double time_unit_ = 1;
    std::vector<ExperimentData> experiments_;
    std::vector<std::vector<Index>> denominators_;  // the different ones of each output
    Index samples_ = 0;
    Vector seconds_, weights_;
};

}  // namespace dynlab::inline numerics
