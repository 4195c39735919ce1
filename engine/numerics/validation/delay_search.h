#pragma once
#include <optional>
#include <utility>

#include "numerics/validation/order_selection.h"

namespace dynlab::inline numerics {

struct DelaySearchOptions {
    std::pair<int, int> poles{1, 3}, zeros{0, 1};  ///< structures among which the recommended one is taken
    FitOptions estimation = {};  ///< least_delay, largest_delay, delay_count and all else for every structure
    bool profile = true;         ///< else the curve is what the search met on its way, which may lie higher
    int threads = 0;             ///< all cores when 0; never more than there are
    std::function<void(std::size_t done)> progress = {};  ///< structures done; called by one thread at a time
    std::function<bool()> cancel = {};                    ///< asked before every structure, by one thread at a time
};

/// A delay, and how well the data determine it.
struct DelaySearch {
    double delay = 0, std = 0;    ///< s, a real number and its standard error
    OrderCandidate candidate;     ///< the structure that was taken, with its model
    std::optional<double> rival;  ///< s, another delay on the grid whose loss differs from the smallest only by chance
    Message explanation;          ///< plain sentences
    bool canceled = false;        ///< nothing else holds then

    /// s, the delays that were tried, and the smallest mean square error at each (delay_profile.h), on at most the
    /// first 50,000 samples.
    const Vector& grid() const { return candidate.estimate.delay_grid; }
    const Vector& losses() const { return candidate.estimate.delay_loss; }
    double loss() const { return candidate.estimate.loss; }  ///< at the delay itself
};

/// The delay between one input and one output, any number of experiments. A model of too low an order has a longer
/// delay, so every structure of the ranges is estimated by srivc with its delay free (fit/transfer_search.h: a grid
/// between least_delay and largest_delay, then a joint refinement), and the structure recommended by choose_order
/// counts. A second valley of the loss is a rival when N ln(V/V_min) stays below the 99 % quantile of chi-square with
/// one degree of freedom, and it is farther away than two grid steps and three standard errors. Throws InvalidArgument
/// for other data, empty ranges, largest_delay not above least_delay, and when no structure could be estimated.
DelaySearch search_delay(const IdData& data, const DelaySearchOptions& options = {});

/// The warning about an input that was logged late (fit/structure_advice.h).
Message late_input_sentence(const IdData& data);

}  // namespace dynlab::inline numerics
