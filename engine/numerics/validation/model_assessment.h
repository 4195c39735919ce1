#pragma once
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline numerics {

/// What an estimation doubts of its model, for verdicts on it.
struct ModelDoubts {
    std::vector<std::string> undetermined = {};  ///< parameters whose standard errors are larger than they
    Message remedy = {};                         ///< a sentence: what the estimation missed (fit/structure_advice.h)
    std::string output = {};                     ///< name of the output of the remedy; empty for the only one

    /// Those about output i (0-based) of this name: its parameters are those that all outputs share, and its own
    /// (b0_y2).
    ModelDoubts about(std::size_t i, const std::string& name) const;
};

/// What is known of the model of one output: stability, fit, the tests of its errors, the estimation's own doubts.
struct ModelEvidence {
    double fit_percent = 100;     ///< of the simulation
    bool unstable = false;        ///< a pole to the right of the stability limit
    bool white = true;            ///< the errors
    bool of_predictions = false;  ///< the errors, by one step with a noise model; else of the simulation
    bool independent = true;      ///< the errors, of every input
    bool tested = true;           ///< every input changes
    bool acts_at_once = false;    ///< the errors go most with the input of the same instant, which the model leaves out
    bool acts_earlier = false;    ///< the errors go most with an input that the model's delay holds back still
    Message start = {};           ///< a sentence: a start that would explain the errors
    ModelDoubts doubts = {};
};

/// The conclusion from all evidence, in one or two sentences. An unstable model is never called good, nor is a model
/// that explains little (explains_little in fit/diagnosis.h), however white its errors. If a model explains less than
/// half of the output and its errors are colored, the text does not call the dynamics described. A known cause is named
/// instead of missing poles.
Message model_quality_message(const ModelEvidence& model);

}  // namespace dynlab::inline numerics
