#include "numerics/fit/channel_scan.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/discrete/long_regression.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/transfer_refinement.h"
#include "numerics/fit/transfer_search.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kChannelSamples = 20'000;
constexpr int kChannelRounds = 3;
constexpr int kChannelIterations = 15;
constexpr double kChannelTolerance = 1e-3;
constexpr double kGain = 1e-4;  // of the loss: less is no reason for another round

class ChannelSearch {
  public:
    ChannelSearch(const IdData& data, const TransferStructure& structure, const FitOptions& options)
        : data_(data), structure_(structure), options_(options) {
        theta_ = Vector::Zero(structure.parameter_count());
    }

    DelayScan run() {
        begin();
        for (int round = 0; round < kChannelRounds && !canceled(); ++round) {
            const double before = loss_;
            for (Index input = 0; input < structure_.inputs && !canceled(); ++input) improve(input);
            if (!(loss_ < (1 - kGain) * before)) break;
        }
        scan_.starts = {theta_};
        scan_.largest = largest_;
        return scan_;
    }

  private:
    bool canceled() const { return options_.cancel && options_.cancel(); }
    FitOptions rough() const { return options_.rough(kChannelIterations, kChannelTolerance); }

    TransferStructure single(Index input) const {
        const TransferChannel& channel = structure_.channel(0, input);
        TransferStructure own =
            TransferStructure::single(structure_.poles[static_cast<std::size_t>(channel.denominator)], channel.zeros);
        own.free_delays = true;
        return own;
    }

    /// The model with one channel's parameters, its delay last, in their places.
    Vector with_channel(Index input, const Vector& own) const {
        const TransferChannel& channel = structure_.channel(0, input);
        const Index n = structure_.poles[static_cast<std::size_t>(channel.denominator)];
        Vector theta = theta_;
        theta.segment(structure_.denominator_start(channel.denominator), n) = own.head(n);
        theta.segment(structure_.numerator_start(0, input), own.size() - n) = own.tail(own.size() - n);
        return theta;
    }

    /// The best model of one channel for its share of the output: of a few steps from the lowest valleys of the loss
    /// over the delay, or of the whole search that an only input has.
    Fit search(Index input, const std::vector<Vector>& share, bool whole) {
        const IdData own = single_channel(data_, share, input);
        const TransferStructure structure = single(input);
        FitOptions how = rough().from_rest();
        if (whole) {
            Fit fit = search_transfer("Output error", own, structure, how);
            keep(fit.delay_grid, fit.delay_loss);
            return fit;
        }
        const DelayScan scan = scan_delays(own, structure, options_);
        keep(scan.delays, scan.losses);
        how.largest_delay = scan.largest;
        std::vector<Fit> fits(scan.starts.size());
        side_by_side(fits.size(), [&](std::size_t i) {
            fits[i] = refine_output_error(own, structure, {InitialState::kZero, false}, scan.starts[i], how);
        });
        return *std::ranges::min_element(fits, {}, &Fit::loss);
    }

    void keep(const Vector& delays, const Vector& losses) {
        scan_.delays = delays;
        scan_.losses = losses;
        if (delays.size() > 0) largest_ = std::max(largest_, delays[delays.size() - 1]);
    }

    void begin() {
        std::vector<std::vector<Vector>> shares;
        if (data_.regular()) {
            const double max_delay = options_.largest_delay.value_or(likely_largest_delay(data_));
            const LongRegression regression(data_, static_cast<Index>(std::ceil(max_delay / data_.Ts)));
            for (Index input = 0; input < structure_.inputs; ++input) shares.push_back(regression.share(input));
        }
        if (shares.empty() || shares.front().empty()) {
            const TransferStructure at = with_fixed_delays(structure_);
            theta_ = with_delays(structure_, at, start_from_rest(data_, at, options_));
        } else {
            for (Index input = 0; input < structure_.inputs; ++input)
                theta_ = with_channel(input, search(input, shares[static_cast<std::size_t>(input)], false).theta);
        }
        refine(theta_);
    }

    /// What the other channels leave.
    std::vector<Vector> rest(Index input) const {
        std::vector<Vector> all;
        for (const Experiment& experiment : data_.experiments) {
            all.push_back(experiment.y.col(0));
            for (Index other = 0; other < structure_.inputs; ++other)
                if (other != input)
                    all.back() -= response_from_rest(data_, experiment, structure_.numerator(theta_, 0, other),
                                                     structure_.denominator(theta_, 0, other),
                                                     structure_.delay(theta_, 0, other), other);
        }
        return all;
    }

    void improve(Index input) {
        const Fit own = search(input, rest(input), true);
        if (own.loss < loss_) refine(with_channel(input, own.theta));
    }

    void refine(const Vector& start) {
        FitOptions how = rough();
        how.largest_delay = std::max(largest_, options_.largest_delay.value_or(largest_));
        const Fit fit = refine_output_error(data_, structure_, {InitialState::kZero, false}, start, how);
        if (!(fit.loss < loss_)) return;
        loss_ = fit.loss;
        theta_ = fit.theta;
    }

    const IdData& data_;
    const TransferStructure& structure_;
    const FitOptions& options_;
    DelayScan scan_;
    Vector theta_;
    double loss_ = kInfinity, largest_ = 0;
};

}  // namespace

bool has_separate_channels(const TransferStructure& structure) {
    return structure.free_delays && structure.outputs == 1 && structure.inputs > 1 &&
           static_cast<Index>(structure.poles.size()) == structure.inputs;
}

DelayScan scan_channels(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    return ChannelSearch(beginning_of(data, kChannelSamples), structure, options).run();
}

}  // namespace dynlab::inline numerics
