#pragma once
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

/// A SampledSystem sample by sample: the recursion as it is defined. The fast filters are checked against it, and
/// ExactFilter leaves it the samples that do not fill a block. The caller guarantees the sizes, and that the system and
/// the samples outlive the recursion.
class SampledRecursion {
  public:
    SampledRecursion(const SampledSystem& system, const Eigen::Map<const Vector>& u)
        : system_(system), u_(u), x_(Vector::Zero(system.F.rows())), next_(x_) {}

    Index output_count() const { return system_.C.rows(); }
    const Vector& state() const { return x_; }
    void set_state(const Vector& x) { x_ = x; }

    /// Output at sample k for the state there.
    void output(Index k, Vector& y) const {
        const Index now = k - system_.delay;
        y.noalias() = system_.C.lazyProduct(x_);
        if (now == 0) y += system_.first_D * u_[0];
        if (now > 0) y += system_.D.col(0) * u_[now] + system_.D.col(1) * u_[now - 1];
    }

    /// From the state at sample k to the one at k + 1; past the last sample of u nothing is defined, nor done.
    void step(Index k) {
        const Index now = k - system_.delay;
        if (now + 1 >= u_.size()) return;
        next_.noalias() = system_.F.lazyProduct(x_);
        x_.swap(next_);
        if (now == 0) x_ += system_.first_G.col(0) * u_[1] + system_.first_G.col(1) * u_[0];
        if (now > 0) x_ += system_.G.col(0) * u_[now + 1] + system_.G.col(1) * u_[now] + system_.G.col(2) * u_[now - 1];
    }

  private:
    const SampledSystem& system_;
    const Eigen::Map<const Vector> u_;
    Vector x_, next_;
};

}  // namespace dynlab::inline numerics
