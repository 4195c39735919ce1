#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/signals/segments.h"

namespace dynlab::inline numerics {

/// Whether a finding only describes a record, or asks for something to be done before a model is fitted.
enum class Weight { kNote, kWarning };

/// One thing that a teacher would say of a record.
struct DataIssue {
    std::string code;  ///< one word, "saturation", for programs
    Weight weight;
    std::string channel;  ///< its name; empty when the finding is about the whole record
    Message message;      ///< whole sentences with numbers, units and the remedy
    double value = 0;     ///< the finding's number: dB, s, a step, a ratio
    std::size_t experiment = 0;
    std::vector<Segment> sections = {};  ///< samples of that experiment it is about
};

struct Advice {
    std::vector<DataIssue> findings;  ///< what to mend first
    /// Stretches of the first experiment better left out (data:discard): saturated or not following the linear model.
    std::vector<Segment> discard;

    bool has(const std::string& code) const;
    const DataIssue* find(const std::string& code) const;  ///< nullptr when there is none
    bool clean() const;                                    ///< no warnings
};

/// What the signals alone tell: "constant" channels, a "time_column", the "same_column" twice, "saturation" and
/// "quantization" of outputs, "outliers", "degrees" declared as radians, "mixed_sampling" and "gaps" between the
/// instants, and "excitation": how many parameters each input can determine. Any number of channels and experiments.
std::vector<DataIssue> signal_advice(const IdData& data);

/// What a linear model tells of the first experiment of a record.
struct ModelAdvice {
    std::vector<DataIssue> findings;
    bool checks_outliers = false;  ///< the model explains enough to judge single samples: there are no other "outliers"
    Vector error = {};             ///< of the model; empty when it does not explain enough
};

/// What a linear model with one to three poles and a free delay (search_delay) tells of a record with one input, one
/// output and regular sampling: "noise" (signal-to-noise ratio), "dead_time", "offset", "running_start", "integrator",
/// "slow_sampling" or "fast_sampling" against the bandwidth; "drift" and "random_walk"; "outliers"; "nonlinear" curves,
/// backlash, "saturation" under noise, "changing_gain"; "feedback"; "causality" (columns exchanged); and "nonlinear"
/// sections that the model does not follow although it follows the rest. Tests and levels: model_issues.h. Long
/// records are searched in a window (advice_record.h).
/// No findings when nothing can be fitted.
ModelAdvice model_advice(const IdData& data, const std::function<bool()>& cancel = {});

/// Both, in the order of weight. A record with several outputs and one input is judged output by output.
Advice advise(const IdData& data, const std::function<bool()>& cancel = {});

}  // namespace dynlab::inline numerics
