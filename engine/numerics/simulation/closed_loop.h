#pragma once
#include "numerics/models/state_space.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The controller of a loop u = C (r - y), y = G u + v: in continuous time, or in discrete time with the sampling time
/// of the data, whose u is then held until the next sample.
struct LoopController {
    TransferFunction C;
    Index computing_delay = 0;  ///< samples from reading y to the resulting u, in addition to C's delay; sampled C

    bool sampled() const { return !C.continuous(); }
};

/// A single loop at the instants k Ts, exact: the plant by matrix exponentials, a sampled controller by its difference
/// equation. `v` is added to the output that the controller reads. With a controller in continuous time r behaves
/// between samples as `hold` says, and v is linearly interpolated; u then changes between samples, too.
class ClosedLoop {
  public:
    /// Throws InvalidArgument for a plant in discrete time, improper models, a controller of another sampling time,
    /// delays in a loop of continuous time (there is no exact recursion: see pade()), a computing delay there, and for
    /// direct terms on both sides, which answer each other without end.
    ClosedLoop(const TransferFunction& plant, const LoopController& controller, double Ts, Hold hold = Hold::kZoh);

    bool stable() const;  ///< all poles of the loop decay

    struct Response {
        Vector u, x;  ///< N each; x is the plant's output without v
    };
    /// From rest. N samples. Throws InvalidArgument for samples that are not finite.
    Response to_reference(const VectorView& r) const { return response(r, 0, hold_); }
    Response to_disturbance(const VectorView& v) const { return response(v, 1, Hold::kFoh); }

    /// d x/d [a_1 .. a_n b_0 .. b_zeros] of to_reference(r).x, N x (n + zeros + 1), for a plant B/A whose B has the
    /// degree `zeros`: bounded if the loop is stable, even for an unstable plant. The result is exact: the derivative
    /// is a second loop with the same poles, driven by the signals of the first.
    Matrix sensitivities(const VectorView& r, int zeros) const;

    /// The data of r and v together: y = x + v, u, and the reference r. The hold is zoh with a sampled controller and
    /// foh with one in continuous time, whose u between the samples neither hold describes exactly. Throws
    /// InvalidArgument for signals of different lengths and an unstable loop.
    IdData simulate(const VectorView& r, const VectorView& v) const;

  private:
    Response response(const VectorView& signal, Index input, Hold hold) const;

    TransferFunction plant_;
    LoopController controller_;
    StateSpace system_;  // from [r v] to [x u]
    double Ts_;
    Hold hold_, data_hold_;
};

}  // namespace dynlab::inline numerics
