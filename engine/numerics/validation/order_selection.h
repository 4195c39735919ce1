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
    std::optional<double> validation_fit;  ///< percent, of the validation data; minus infinity if the simulation
                                           ///< overflows
    double evidence = 0;  ///< N ln V + d ln N, V the mean square error, but not below rounding of the output
    std::vector<std::string> undetermined;  ///< parameters whose standard error exceeds their value
    bool cancellation = false;              ///< a zero equals a pole to within its uncertainty
    bool converged = true;
    bool integrator = false;  ///< in addition to the poles, which do not include it
    bool unstable = false;    ///< the integrator aside

    /// An estimate without the three problems that indicate too high an order.
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
    const IdData* validation = nullptr;                   ///< other data of the same channels
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

/// Estimates every structure on `data` (one input, one output, any number of experiments) by srivc, several in
/// parallel, in order of increasing poles and zeros: a structure's search uses the fits of the next smaller ones.
/// Validation data are simulated as in compare_all() with the initial state estimated, because it is that of these
/// data, and with the offset that the estimation used or selected. The results do not depend on the number of threads.
/// Throws InvalidArgument for other data, no candidates, and if none of them could be estimated. If the options do not
/// specify the start, each fit selects its start (fit/start_choice.h), and AIC, BIC and FPE count its initial values
/// and its offset. With estimation.integration inputs are held (zoh) and the data begin at rest. The initial state of
/// validation data then includes the integrator's, and thereby an offset of its output.
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
/// kRecommended: among the sound candidates, the stable ones if there are any. With validation data it is the one with
/// fewest parameters whose validation fit is within half a point of the best. Without them it is the smallest BIC, or a
/// candidate with fewer parameters whose BIC is at most 2 larger (Kass and Raftery 1995: not worth a mention). Without
/// sound candidates all count. Other criteria: the best value among all estimates. Throws InvalidArgument for
/// kValidationFit without validation data.
OrderChoice choose_order(const OrderSelection& selection, OrderCriterion criterion = OrderCriterion::kRecommended);

}  // namespace dynlab::inline numerics
