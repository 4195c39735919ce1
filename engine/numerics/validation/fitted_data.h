#pragma once
#include <functional>
#include <optional>
#include <string>

#include "base/message.h"
#include "numerics/statistics/wandering.h"
#include "numerics/validation/advice.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/delay_search.h"

namespace dynlab::inline numerics {

/// A part of the data in which a model is searched.
struct SearchWindow {
    IdData data;
    Index first = 0;  ///< its first sample in the data (0-based)
    Index step = 1;   ///< samples of the data from one of its samples to the next
};

/// Data, the linear model that explains them best, and the model's error.
struct FittedData {
    IdData data;  ///< one experiment, one input, one output, regular sampling; findings take off y what is no response
    SearchWindow window;
    DelaySearch search;
    CompareResult simulation;   ///< of all data
    Vector error;               ///< of all data: y minus simulated output
    double movement_error = 0;  ///< rms error over rms output of the window, without slow movement where in doubt
    double disturbance = 0;     ///< standard deviation of the slow disturbance that was taken off y
    Vector taken_off = {};      ///< this disturbance; empty without one

    const TransferFunction& model() const { return search.candidate.estimate.models.front(); }
    const std::string& output() const { return data.output_names.front(); }
    const std::string& input() const { return data.input_names.front(); }
    VectorView y() const { return data.experiments.front().y.col(0); }
    VectorView u() const { return data.experiments.front().u.col(0); }
    /// A value of the output, rounded to so many significant digits.
    Message with_unit(double value, int digits) const;
    double deviation() const;  ///< standard deviation of y
    /// The model explains half of the output, or of what is left of it without slow movement.
    bool trusted() const { return simulation.fit_percent > 50 || (movement_error < 0.5 && !runs_away()); }
    /// It is unstable and explains less than half from rest, or its simulation leaves the range of the output by far:
    /// no measure of anything.
    bool runs_away() const;
    void take_off(const VectorView& part);  ///< of y, and simulates again
};

/// A model with one to three poles and a free delay. search_delay finds its structure with a free start and a constant,
/// for 10000 samples and more in averages of both signals over blocks. The model is then fitted to all samples with the
/// start that BIC selects. It comes from the window, or, if its mean square error in all data is twice that in the
/// window, from up to 16000 samples. A second model is tried if the error wanders, or if the model explains less than
/// half, has a very slow or unstable pole, or needs a free motion from before the first sample. It is fitted to input
/// and output behind the same high-pass filter, which attenuates slow disturbances, and used unless it explains these
/// signals worse by more than 5 %. An integrator that explains 80 % from rest and a constant is kept: it is not visible
/// behind the filter either (but its free motion looks like a drift). A model that explains all data worse than -50 %
/// is not used. No value if no model can be fitted, or when canceled.
std::optional<FittedData> fitted_data(const IdData& data, const std::function<bool()>& cancel);

/// A finding about the output.
DataIssue about(const FittedData& fit, const char* code, Weight weight, const Message& message, double value);

/// "3, 10 to 12, ...": the first four.
MessageList listed_places(const std::vector<Segment>& segments);
/// "3.2 V", or the number alone where it has no unit.
Message with_unit(Number number, const std::string& unit);
/// A number rounded to `digits` significant digits, shown without an exponent if six digits suffice: -110.
Number rounded(double value, int digits);
/// A number with the significant digits at the given `resolution`: 20.03 at 0.5 becomes 20.
Number rounded_to(double value, double resolution);

}  // namespace dynlab::inline numerics
