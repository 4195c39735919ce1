#include "numerics/validation/delay_profile.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "numerics/error.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr std::size_t kSearchedApart = 4;  // delays from one that is searched without passes as well to the next
constexpr int kMaxSweeps = 10, kProfileIterations = 50;
constexpr double kProfileTolerance = 1e-4, kLower = 1e-4;  // relative, of parameters and of the loss

struct ProfilePoint {
    Vector theta = {};
    double loss = kInfinity;
    int lowered = 0;  ///< the sweep that found it
};

class DelayProfile {
  public:
    DelayProfile(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                 const Vector& delays, const FitOptions& options)
        : data_(data),
          structure_(structure),
          condition_(condition),
          delays_(delays),
          options_(options.started(condition)),
          points_(static_cast<std::size_t>(delays.size())) {
        structure_.free_delays = false;
    }

    void fit_each(int threads) {
        tbb::task_arena arena(thread_count(threads));
        arena.execute([&] { tbb::parallel_for(std::size_t{0}, points_.size(), [&](std::size_t i) { fit_alone(i); }); });
    }

    void sweep() {
        for (sweep_ = 1; sweep_ <= kMaxSweeps; ++sweep_) {
            bool lower = false;
            for (std::size_t i = 0; i + 1 < points_.size(); ++i) lower |= try_neighbor(i + 1, points_[i]);
            for (std::size_t i = points_.size(); i-- > 1;) lower |= try_neighbor(i - 1, points_[i]);
            if (!lower) return;
        }
    }

    Vector losses() const {
        Vector all(delays_.size());
        for (std::size_t i = 0; i < points_.size(); ++i) all[static_cast<Index>(i)] = points_[i].loss;
        return all;
    }

  private:
    TransferStructure structure_at(std::size_t i) const {
        TransferStructure at = structure_;
        at.channels.front().delay = delays_[static_cast<Index>(i)];
        return at;
    }

    void fit_alone(std::size_t i) {
        if (stopped()) return;
        try {
            take(i, on_all_samples(i, srivc(data_, structure_at(i), options_)));
            if (i % kSearchedApart == 0) take(i, on_all_samples(i, coe(data_, structure_at(i), options_)));
        } catch (const InvalidArgument&) {
            // no separate solution: those of the neighbors remain
        }
    }

    /// A fit with an estimated start leaves out what is not heard at its delay.
    Fit on_all_samples(std::size_t i, Fit fit) const {
        return condition_.state == InitialState::kEstimate ? refined(i, fit.theta) : fit;
    }

    /// Follows a neighbor's solution here, unless that was done in a sweep before.
    bool try_neighbor(std::size_t i, const ProfilePoint& neighbor) {
        if (stopped() || !std::isfinite(neighbor.loss) || neighbor.lowered < sweep_ - 1) return false;
        const Fit fit = refined(i, neighbor.theta);
        return !swings_fast(fit) && take(i, fit);
    }

    Fit refined(std::size_t i, const Vector& theta) const {
        FitOptions how = options_.rough(kProfileIterations, kProfileTolerance);
        how.stable = options_.stable.value_or(true);
        return refine_output_error(data_, structure_at(i), condition_, theta, how);
    }

    /// With fewer than four samples a turn: this looks slower or still in the samples, and makes up for a wrong delay.
    bool swings_fast(const Fit& fit) const {
        const double fastest = std::numbers::pi / (2 * data_.mean_step());
        return fit.models.front().poles().imag().cwiseAbs().maxCoeff() > fastest;
    }

    bool take(std::size_t i, const Fit& fit) {
        if (!(fit.loss < (1 - kLower) * points_[i].loss)) return false;
        points_[i] = {fit.theta, fit.loss, sweep_};
        return true;
    }

    bool stopped() const { return options_.cancel && options_.cancel(); }

    const IdData& data_;
    TransferStructure structure_;
    StartCondition condition_;
    const Vector& delays_;
    FitOptions options_;
    std::vector<ProfilePoint> points_;
    int sweep_ = 0;
};

}  // namespace

Vector delay_profile(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                     const Vector& delays, const FitOptions& options, int threads) {
    if (!structure.single_channel()) throw InvalidArgument("a delay profile needs one input and one output");
    DelayProfile profile(data, structure, condition, delays, options);
    profile.fit_each(threads);
    profile.sweep();
    return profile.losses();
}

}  // namespace dynlab::inline numerics
