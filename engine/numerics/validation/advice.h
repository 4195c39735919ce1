#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/signals/segments.h"

namespace dynlab::inline numerics {

/// Whether a finding only describes the data, or asks for an action before estimation.
enum class Weight { kNote, kWarning };

/// A problem of the data, or a note on them.
struct DataIssue {
    std::string code;  ///< one word, "saturation", for programs
    Weight weight;
    std::string channel;  ///< its name; empty if the finding is about the entire data set
    Message message;      ///< whole sentences with numbers, units and the remedy
    double value = 0;     ///< the finding's number: dB, s, a step, a ratio
    std::size_t experiment = 0;
    std::vector<Segment> sections = {};  ///< samples of that experiment it is about
};

struct Advice {
    std::vector<DataIssue> findings;  ///< the most important ones first
    /// Stretches of the first experiment better left out (data:discard): saturated or not following the linear model.
    std::vector<Segment> discard;

    bool has(const std::string& code) const;
    const DataIssue* find(const std::string& code) const;  ///< nullptr when there is none
    bool clean() const;                                    ///< no warnings
};

/// Problems that the signals alone show: "constant" channels, a "time_column", the "same_column" twice, "saturation"
/// and "quantization" of outputs, "outliers", "degrees" declared as radians, "mixed_sampling" and "gaps" between the
/// instants, and "excitation": how many parameters each input can determine. Any number of channels and experiments.
std::vector<DataIssue> signal_advice(const IdData& data);

/// Problems that a linear model shows in the first experiment of the data.
struct ModelAdvice {
    std::vector<DataIssue> findings;
    bool checks_outliers = false;  ///< the model explains enough to check single samples: there are no other "outliers"
    Vector error = {};             ///< of the model; empty when it does not explain enough
};

/// Problems that a linear model with one to three poles and a free delay (search_delay) shows in data with one input,
/// one output and regular sampling: "noise" (signal-to-noise ratio), "dead_time", "offset", "running_start",
/// "integrator", "slow_sampling" or "fast_sampling" compared with the bandwidth; "drift" and "random_walk"; "outliers";
/// "nonlinear" curves, backlash, "saturation" under noise, "changing_gain"; "feedback"; "causality" (columns
/// exchanged); and "nonlinear" sections that the model does not follow although it follows the rest. Tests and levels:
/// model_issues.h. For long data the model is searched in a window (advice_record.h). No findings if no model can be
/// fitted.
ModelAdvice model_advice(const IdData& data, const std::function<bool()>& cancel = {});

/// Both, in the order of weight. Data with several outputs and one input are checked output by output.
Advice advise(const IdData& data, const std::function<bool()>& cancel = {});

}  // namespace dynlab::inline numerics
