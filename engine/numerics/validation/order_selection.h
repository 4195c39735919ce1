#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

enum class OrderCriterion { kRecommended, kRSquared, kYic, kAic, kBic, kFpe, kFit, kValidationFit };

/// One structure that was tried. Measures are those of the simulation error (validation/fit_measures.h).
struct OrderCandidate {
    int poles = 1, zeros = 0;
    double delay = 0;  ///< s, fixed or estimated
    Message failure;   ///< why there is no estimate; empty when there is one, and nothing below holds otherwise
    Fit estimate;
    double r_squared = 0, yic = 0, aic = 0, bic = 0, fpe = 0;
    double log_condition = 0;  ///< log10 of the column-scaled equations' condition number
    int iterations = 0;
    double fit_percent = 0;
    std::optional<double> validation_fit;  ///< percent, of the second record; minus infinity when it overflows
    double evidence = 0;  ///< N ln V + d ln N, V the mean square error, but not below rounding of the output
    std::vector<std::string> undetermined;  ///< parameters whose standard error exceeds their value
    bool cancellation = false;              ///< a zero lies on a pole within what the data can tell
    bool converged = true;
    bool integrator = false;  ///< besides the poles, which do not count it
    bool unstable = false;    ///< the integrator aside

    /// An estimate without the three faults that tell of too high an order.
    bool sound() const { return failure.empty() && undetermined.empty() && !cancellation && converged; }
    int parameters() const { return static_cast<int>(estimate.theta.size()); }
};

struct OrderSelection {
    std::vector<OrderCandidate> candidates;  ///< in the order they were given
    Index samples = 0;
    bool validated = false;
    bool canceled = false;  ///< candidates that had not begun say so in their failure
};

struct OrderSelectionOptions {
    const IdData* validation = nullptr;                   ///< another record of the same channels
    int threads = 0;                                      ///< all cores when 0; never more than there are
    FitOptions estimation = {};                           ///< the same for every structure, an integrator among it
    std::function<void(std::size_t done)> progress = {};  ///< called by one thread at a time
    std::function<bool()> cancel = {};                    ///< asked before every candidate, by one thread at a time
};

/// All structures with poles and zeros from .. to, fewer zeros than poles or with `feedthrough` as many, and each of
/// the delays (s); with `free_delay` the delay is estimated from FitOptions' least_delay to largest_delay instead.
/// Throws InvalidArgument for empty or absurd ranges.
std::vector<TransferStructure> order_grid(std::pair<int, int> poles, std::pair<int, int> zeros,
                                          const std::vector<double>& delays, bool free_delay = false,
                                          bool feedthrough = false);

/// Estimates every structure on `data` (one input, one output, any number of experiments) by srivc, several at once,
/// from few poles and zeros up: a structure's search knows the fits of those that are a step poorer.
/// A second record is simulated as compare_all() does it with the initial state estimated, for that is the record's
/// own, and with the offset that the estimation was asked for, or chose. Equal numbers for any number of threads.
/// Throws InvalidArgument for other data, no candidates, and when none of them could be estimated. Where the options
/// leave the start open each fit chooses its own (fit/start_choice.h), and AIC, BIC and FPE count its initial values
/// and its offset. With estimation.integration inputs are held (zoh), the record begins at rest, and a second record's
/// initial state is that of the integrator too, so that an offset of its output is part of it.
OrderSelection select_order(const IdData& data, const std::vector<TransferStructure>& candidates,
                            const OrderSelectionOptions& options = {});

/// What a criterion compares.
struct OrderMeasure {
    OrderCriterion criterion;
    const char* word;  ///< of scripts: "YIC", "validation"
    bool larger_is_better;
    double (*value)(const OrderCandidate&);  ///< not a number where there is none
};
std::span<const OrderMeasure> order_measures();               ///< of all criteria but kRecommended
const OrderMeasure& order_measure(OrderCriterion criterion);  ///< of any but kRecommended

/// "2 poles, 1 zero and a delay of 0.5 s"
Message structure_text(const OrderCandidate& candidate);

struct OrderChoice {
    std::size_t place = 0;  ///< among the candidates
    Message explanation;    ///< plain sentences
};
/// kRecommended: among the sound candidates, the stable ones if there are any, with a second record the one with fewest
/// parameters whose validation fit is within half a point of the best; otherwise the smallest BIC, or a candidate with
/// fewer parameters that is behind by no more than 2 (Kass and Raftery 1995: not worth a mention). Without sound
/// candidates all count. Other criteria: the best value among all estimates. Throws InvalidArgument for kValidationFit
/// without a second record.
OrderChoice choose_order(const OrderSelection& selection, OrderCriterion criterion = OrderCriterion::kRecommended);

}  // namespace dynlab::inline numerics
