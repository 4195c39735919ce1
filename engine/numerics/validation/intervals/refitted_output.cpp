#include "numerics/validation/intervals/refitted_output.h"

#include <algorithm>

#include "numerics/criteria/process_output.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/output_error.h"
#include "numerics/fit/transfer_refinement.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kMaxErrorsOff = 3;  // standard errors: largest change of a parameter by refitting that is accepted
                                     // without a message

/// A model some of whose parameters stay where they are.
class HeldOutput : public OutputErrorModel {
  public:
    HeldOutput(const OutputErrorModel& inner, const std::map<Index, double>& held) : inner_(inner) {
        lower_ = inner.lower(), upper_ = inner.upper();
        for (const auto& [place, value] : held) lower_[place] = upper_[place] = value;
    }
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        inner_.simulate(theta, output, sensitivities);
    }
    OutputErrorProducts products(const Vector& theta, const VectorView& y) const override {
        return inner_.products(theta, y);
    }
    Index masked_rows() const override { return inner_.masked_rows(); }
    bool products_are_cheap() const override { return inner_.products_are_cheap(); }

  private:
    const OutputErrorModel& inner_;
};

/// The criterion of a fitted model on some data, in the units of a search.
class Criterion {
  public:
    Criterion(const IdData& data, const FittedOutput& fitted)
        : transfer_(fitted.process ? transfer_structure(*fitted.process) : fitted.structure, fitted.start, data, 0,
                    shortest_experiment(data) / 2,
                    fitted.process ? at_rest(*fitted.process) : TransferOutput::AtRest::kCoefficients) {
        if (fitted.process) process_.emplace(process_output(*fitted.process, transfer_));
        seconds_ = fitted.process ? process_seconds(*fitted.process, transfer_) : transfer_.seconds();
    }
    Criterion(const Criterion&) = delete;
    Criterion& operator=(const Criterion&) = delete;

    const TransferOutput& transfer() const { return transfer_; }
    const OutputErrorModel& model() const {
        return process_ ? static_cast<const OutputErrorModel&>(*process_) : transfer_;
    }
    const Vector& seconds() const { return seconds_; }
    /// theta with initial values and offsets at zero.
    Vector start_at(const Vector& theta) const {
        Vector start = Vector::Zero(model().parameter_count());
        start.head(theta.size()) = theta.cwiseQuotient(seconds_.head(theta.size()));
        return start.cwiseMax(model().lower()).cwiseMin(model().upper());
    }

  private:
    TransferOutput transfer_;
    std::optional<Reparametrized> process_;
    Vector seconds_;
};

}  // namespace

std::vector<std::string> FittedOutput::names() const {
    return process ? process->parameter_names() : structure.parameter_names();
}

Index FittedOutput::place_of(const std::string& name) const {
    const std::vector<std::string> all = names();
    const auto found = std::find(all.begin(), all.end(), name);
    if (found != all.end()) return found - all.begin();
    throw InvalidArgument("The model has no estimated parameter '{}'; its parameters are {}", name, listed(all));
}

FittedOutput FittedOutput::at(const Vector& values) const {
    FittedOutput other = *this;
    other.theta = values;
    return other;
}

TransferFunction FittedOutput::model() const {
    return process ? ProcessModel(*process, theta).transfer_function() : structure.models(theta).front();
}

/// With a free delay also a sample earlier and later: at the samples the loss has corners where inputs are held.
std::vector<Vector> RefittedOutput::starts_around(const OutputErrorModel& model, const Vector& start) const {
    std::vector<Vector> starts{start};
    const std::vector<std::string> all = fitted_.names();
    const Index delay = std::find(all.begin(), all.end(), "Td") - all.begin();
    if (delay == static_cast<Index>(all.size()) || model.lower()[delay] == model.upper()[delay]) return starts;
    for (const double shift : {-1.0, 1.0}) {  // delays are counted in samples here
        starts.push_back(start);
        starts.back()[delay] = std::clamp(start[delay] + shift, model.lower()[delay], model.upper()[delay]);
    }
    return starts;
}

RefittedOutput::RefittedOutput(IdData data, FittedOutput fitted) : data_(std::move(data)), fitted_(std::move(fitted)) {
    if (data_.experiments.empty() || data_.input_count() != 1 || data_.output_count() != 1)
        throw InvalidArgument(
            "Repeated estimation requires one input and one output, but the data have {} and {}: select one of each",
            data_.input_count(), data_.output_count());
    if (!fitted_.theta.allFinite()) throw InvalidArgument("The parameters of the model are not all finite");
    check_sample_count("A repeated fit", data_.sample_count(), value_count());
}

Fit RefittedOutput::fit(const std::map<Index, double>& held, const Fit* from, const Vector* outputs) const {
    IdData other;
    if (outputs != nullptr) {
        other = data_;
        Index row = 0;
        for (Experiment& experiment : other.experiments) {
            experiment.y = outputs->segment(row, experiment.y.rows());
            row += experiment.y.rows();
        }
    }
    const Criterion criterion(outputs != nullptr ? other : data_, fitted_);
    const Vector& seconds = criterion.seconds();
    std::map<Index, double> own;
    for (const auto& [place, value] : held) own[place] = value / seconds[place];
    Vector start =
        from != nullptr ? search_point(*from, criterion.transfer(), seconds) : criterion.start_at(fitted_.theta);
    for (const auto& [place, value] : own) start[place] = value;
    const HeldOutput model(criterion.model(), own);
    Fit fit = minimize_output_error(model, criterion.transfer().target(), starts_around(model, start), {});
    keep_parameters(fit, criterion.transfer(), fitted_.start, seconds);
    fit.names = fitted_.names();
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    return fit;
}

std::optional<Message> RefittedOutput::moved(const Fit& fit) const {
    const Vector errors = (fit.theta - fitted_.theta).cwiseAbs().cwiseQuotient(fit.std);
    Index place = 0;
    if (!(errors.maxCoeff(&place) > kMaxErrorsOff)) return std::nullopt;
    return Message(
        "The model does not minimize the simulation error on these data: {} = {} becomes {}, and the intervals refer "
        "to the new value.",
        fit.names[static_cast<std::size_t>(place)], significant(fitted_.theta[place], 4),
        significant(fit.theta[place], 4));
}

Vector RefittedOutput::simulated(const Fit& fit) const {
    const Criterion criterion(data_, fitted_);
    return criterion.model().output_at(search_point(fit, criterion.transfer(), criterion.seconds()));
}

Vector RefittedOutput::measured() const {
    return Criterion(data_, fitted_).transfer().target();
}

std::vector<Index> RefittedOutput::lengths() const {
    std::vector<Index> all;
    for (const Experiment& experiment : data_.experiments) all.push_back(experiment.y.rows());
    return all;
}

std::pair<double, double> RefittedOutput::bounds(Index place) const {
    const Criterion criterion(data_, fitted_);
    const double unit = criterion.seconds()[place];
    return {criterion.model().lower()[place] * unit, criterion.model().upper()[place] * unit};
}

Index RefittedOutput::value_count() const {
    return numerics::value_count(fitted_.process ? transfer_structure(*fitted_.process) : fitted_.structure,
                                 fitted_.start, static_cast<Index>(data_.experiments.size()));
}

}  // namespace dynlab::inline numerics
