#include "data_io/values/model_descriptions.h"

namespace dynlab::inline data_io {
namespace {

void check_coefficients(const Vector& polynomial, const ValueLimits& limits) {
    if (polynomial.size() > limits.coefficients) throw InvalidArgument("the order of a polynomial is too high");
}

void check_polynomials(const std::vector<Vector>& polynomials, const ValueLimits& limits) {
    for (const Vector& polynomial : polynomials) {
        if (polynomial.size() == 0) throw InvalidArgument("a polynomial has no coefficients");
        check_coefficients(polynomial, limits);
    }
}

}  // namespace

void check_value(const IdData& data, const ValueLimits&) {
    if (data.experiments.empty()) throw InvalidArgument("a data object needs at least one experiment");
    for (const Experiment& experiment : data.experiments) {
        const IdData part = data.Ts > 0 ? IdData(experiment.y, experiment.u, data.Ts)
                                        : IdData(experiment.y, experiment.u, experiment.t);
        const bool same_channels =
            part.input_count() == data.input_count() && part.output_count() == data.output_count();
        if (experiment.r.size() > 0) part.with_reference(experiment.r);
        if (!same_channels || experiment.r.cols() != data.reference_count())
            throw InvalidArgument("the experiments have different channels");
        if (data.Ts > 0 && experiment.t.size() > 0)
            throw InvalidArgument("regularly sampled data must not have sampling instants");
    }
    const auto fit = [](const std::vector<std::string>& names, Index requested) {
        return static_cast<Index>(names.size()) == requested;
    };
    if (!fit(data.input_names, data.input_count()) || !fit(data.input_units, data.input_count()) ||
        !fit(data.output_names, data.output_count()) || !fit(data.output_units, data.output_count()))
        throw InvalidArgument("the numbers of channels, names and units differ");
}

void check_value(const FrequencyData& data, const ValueLimits&) {
    const auto fits = [&](Index size) { return size == 0 || size == data.w.size(); };
    const bool all_fit = fits(data.variance.size()) && fits(data.noise_variance.size()) &&
                         fits(data.distortion.size()) && fits(data.coherence.size()) &&
                         fits(data.noise_spectrum.size());
    if (data.response.size() != data.w.size() || !all_fit)
        throw InvalidArgument("the numbers of response values and frequencies differ");
    for (const OutputLevels* levels : {&data.excited, &data.odd, &data.even})
        if (levels->power.size() != levels->w.size())
            throw InvalidArgument("the numbers of levels and frequencies differ");
}

void check_value(const TransferFunctionMembers& members, const ValueLimits& limits) {
    check_coefficients(members.num, limits);
    check_coefficients(members.den, limits);
}

void check_value(const ProcessModel& model, const ValueLimits&) {
    ProcessModel(model.structure, model.parameters);
}

void check_value(const PolynomialModel& model, const ValueLimits& limits) {
    check_polynomials({model.A, model.C, model.D}, limits);
    check_polynomials(model.B, limits);
    check_polynomials(model.F, limits);
    if (model.B.empty() || model.B.size() != model.F.size() || !(model.Ts > 0))
        throw InvalidArgument("the polynomials and the sampling time are inconsistent");
}

void check_value(const StateSpace& system, const ValueLimits&) {
    StateSpace(system.A, system.B, system.C, system.D, system.Ts);
}

}  // namespace dynlab::inline data_io
