#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/fit/fit.h"
#include "numerics/models/process_model.h"

namespace dynlab::inline numerics {

/// A continuous-time model with one input and one output as an output-error method leaves it: what its uncertainty is
/// asked for.
struct FittedOutput {
    TransferStructure structure;                       ///< of a process model not looked at
    std::optional<ProcessStructure> process;           ///< theta are this one's parameters, where it is given
    Vector theta;                                      ///< s and rad/s
    StartCondition start{InitialState::kZero, false};  ///< start condition of its data

    std::vector<std::string> names() const;
    /// Of a parameter by its name. Throws InvalidArgument that lists the names.
    Index place_of(const std::string& name) const;
    /// With other values.
    FittedOutput at(const Vector& values) const;
    TransferFunction model() const;
};

class OutputErrorModel;

/// Repeated output-error fits of the same structure, from a solution nearby: to other data with the same input, and
/// with a parameter held. Delays are free between zero and half of the shortest experiment.
class RefittedOutput {
  public:
    /// `data` are what the model was fitted to; they are kept. Throws InvalidArgument for other channels than one input
    /// and one output, no more samples than values to estimate, or parameters that are not finite.
    RefittedOutput(IdData data, FittedOutput fitted);

    /// The fit to the data from the model's parameters. `outputs` (of all experiments, one after the other) replaces
    /// the measured ones; `held` gives parameters, by their place, that are held at values (s). `from`: a fit of this
    /// object where the search begins.
    Fit fit(const std::map<Index, double>& held = {}, const Fit* from = nullptr, const Vector* outputs = nullptr) const;

    /// A sentence where `fit`, of nothing held, lies more than three standard errors from the model: that was fitted to
    /// other data, or by a method of another criterion.
    std::optional<Message> moved(const Fit& fit) const;

    /// The simulated outputs of such a fit, experiment after experiment.
    Vector simulated(const Fit& fit) const;
    Vector measured() const;
    std::vector<Index> lengths() const;  ///< samples of each experiment
    const FittedOutput& fitted() const { return fitted_; }
    const IdData& data() const { return data_; }
    /// Between which a parameter may lie, s and rad/s.
    std::pair<double, double> bounds(Index place) const;
    /// All values that are estimated: parameters, initial values, offsets.
    Index value_count() const;

  private:
    std::vector<Vector> starts_around(const OutputErrorModel& model, const Vector& start) const;

    IdData data_;
    FittedOutput fitted_;
};

}  // namespace dynlab::inline numerics
