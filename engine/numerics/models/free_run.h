#pragma once
#include <optional>
#include <string>

#include "base/message.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Simulation of a model on the inputs of one experiment alone.
struct FreeRun {
    Matrix output;                 ///< N x ny; from a divergence on NaN
    std::optional<Index> lost_at;  ///< 0-based sample at which it left all bounds
    Message start;                 ///< how it began, for messages: "from the recorded first 2 samples"
};

/// A model that is simulated and not written as transfer functions: polynomial difference equations, differential
/// equations. It is immutable, and its free run depends only on the data.
class FreeRunModel {
  public:
    virtual ~FreeRunModel() = default;
    virtual Index input_count() const = 0;
    virtual Index output_count() const = 0;

    /// Simulates one experiment (0-based) on its inputs. It uses the measured outputs only to determine the start of
    /// the run. `x0` is the state there, in the model's order. If `x0` is empty, the data determine it; for data
    /// without outputs the run begins at rest (all zero). Throws InvalidArgument for other channels or another sampling
    /// time than the model's, an `x0` of another size, or an experiment that is too short.
    virtual FreeRun free_run(const IdData& data, std::size_t experiment, const VectorView& x0) const = 0;
};

/// Throws InvalidArgument that begins with `model` unless the data have these inputs and, where they have any, these
/// outputs.
void check_channels(const std::string& model, const FreeRunModel& requested, const IdData& data);

/// "The free run leaves all bounds at t = 3.2 s." with the time of that sample.
Message divergence_text(const IdData& data, std::size_t experiment, Index sample);

/// Inputs alone, regularly sampled every Ts seconds, as free_run() takes them from rest or from an x0.
IdData inputs_alone(const MatrixView& u, double Ts, Hold hold);

}  // namespace dynlab::inline numerics
