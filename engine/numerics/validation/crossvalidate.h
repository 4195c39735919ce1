#pragma once
#include <functional>
#include <vector>

#include "base/message.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"
#include "numerics/validation/compare.h"

namespace dynlab::inline numerics {

struct CrossValidationOptions {
    int folds = 5;               ///< contiguous segments of about equal length; not used with `by_experiment`
    bool by_experiment = false;  ///< leave out one experiment after the other instead
    CompareOptions simulation{InitialState::kEstimate, Offset::kAuto};  ///< of the part left out
    std::function<bool()> cancel = {};                                  ///< asked before every fold

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// A part of the data that a model has not seen.
struct CrossValidationFold {
    std::size_t experiment = 0;              ///< 0-based
    Index first = 1, last = 1;               ///< samples, 1-based and inclusive
    std::vector<TransferFunction> channels;  ///< fitted to all other parts
    Comparison validation;                   ///< of the part left out
};

struct CrossValidation {
    std::vector<CrossValidationFold> folds;
    Matrix fit_percent;   ///< folds x ny, simulation of the parts left out; minus infinity when it overflows
    Vector mean, spread;  ///< per output, over the folds; spread: standard deviation
    Message message;      ///< a line per output
};

/// Fits a model to data: the ny nu transfer functions row by row.
using ModelFitter = std::function<std::vector<TransferFunction>(const IdData&)>;

/// k-fold cross-validation (Stone 1974) of any method. Every fold is left out once: `fit` gets all other parts, as
/// separate experiments if the fold is cut out of the middle of an experiment (their initial states are not zero then).
/// Its model is simulated on the fold with the initial state estimated. Segments keep the order of samples, because
/// neighboring samples are not independent. Exceptions of `fit` pass through. Throws InvalidArgument for fewer than two
/// folds, folds of fewer than ten samples, or by_experiment with a single experiment.
CrossValidation cross_validate(const IdData& data, const ModelFitter& fit, const CrossValidationOptions& options = {});

}  // namespace dynlab::inline numerics
