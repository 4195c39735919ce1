#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/models/transfer_structure.h"
#include "numerics/signals/iddata.h"
#include "numerics/simulation/closed_loop.h"

namespace dynlab::inline numerics {

/// Known properties of the loop u = C (r - y) in which the data were recorded.
struct LoopKnowledge {
    std::optional<LoopController> controller;  ///< no value: not known
    bool find_computing_delay = false;         ///< none or one sample, whichever makes C (r - y) come nearer to u
    Hold hold_r = Hold::kZoh;                  ///< of the reference, with a controller in continuous time
};

/// Throws InvalidArgument that begins with `method` unless the data have one input, one output and one reference that
/// changes, regular samples, and suit the structure (one input, one output, a fixed delay; check_transfer_data).
void check_loop_data(const std::string& method, const IdData& data, const TransferStructure& structure);

/// The parts of u and y that the reference alone explains: free of noise, so that products with noise vanish on the
/// average, whatever the controller feeds back.
class LoopSignals {
  public:
    /// Throws InvalidArgument for a controller that does not suit the data, and where a controller is unknown and the
    /// reference explains nothing of u.
    LoopSignals(const std::string& method, const IdData& data, const LoopKnowledge& known);

    /// One experiment's.
    struct Signals {
        Vector u, x;
    };
    struct All {
        std::vector<Signals> experiments;
        bool in_loop =
            false;  ///< simulated through the loop; otherwise u is the projection, x the model's answer to it
    };
    /// With a known controller that holds the model, the loop of both, simulated from rest; otherwise `model` driven by
    /// the projection of u on r, unstable poles mirrored.
    All of_model(const TransferFunction& model) const;

    /// Per experiment: the projection of u on r and its past by least squares, the number of weights by BIC.
    const std::vector<Vector>& projected_inputs() const;
    const std::optional<LoopController>& controller() const { return controller_; }
    Hold hold_r() const { return hold_r_; }
    /// Where C (r - y) is not u.
    const std::optional<Message>& warning() const { return warning_; }

  private:
    void check_controller(bool find_delay);

    std::string method_;
    const IdData& data_;
    std::optional<LoopController> controller_;
    Hold hold_r_;
    mutable std::vector<Vector> projected_;
    std::optional<Message> warning_;
};

/// The data with u replaced by its projection on the reference.
IdData with_projected_inputs(const IdData& data, const LoopSignals& signals);

}  // namespace dynlab::inline numerics
