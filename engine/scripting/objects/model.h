#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numerics/estimators/step_test.h"
#include "numerics/fit/diagnostics.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/models/process_model.h"
#include "numerics/models/state_space.h"
#include "numerics/validation/uncertainty.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// Of estimated parameters, in their order; empty when the method gives none.
struct ParameterErrors {
    Vector std;
    Matrix covariance;
};

/// What G.report says by name.
struct ReportFields {
    std::vector<std::pair<std::string, double>> numbers = {};   ///< fit_percent, noise_variance, iterations, ...
    std::vector<std::pair<std::string, Vector>> vectors = {};   ///< output, delay_grid, delay_loss, ...
    std::vector<std::pair<std::string, Matrix>> matrices = {};  ///< path (parameters after each iteration)
    Message simulated = {};  ///< a sentence: from which state, and with which offsets, fit_percent was simulated

    std::optional<double> number(std::string_view name) const;
    std::size_t values() const;  ///< numbers in vectors and matrices
};

/// The results of an estimation method other than the coefficients.
struct Estimate {
    std::string method;              ///< Lua name
    std::vector<std::string> names;  ///< of the parameters
    Vector theta;
    Deferred<ParameterErrors> errors;  ///< some methods compute them when they are read
    Message message;                   ///< how the estimation ended, with its warnings
    std::vector<Message> warnings;     ///< of the estimation
    Deferred<ReportFields> fields;
    bool converged = true;
    bool of_coefficients =
        true;           ///< theta and covariance are those of G's coefficients, with the delay where it is free
    bool carx = false;  ///< of the equation A(p) y = B(p) u + e: G has fields A and B
    std::shared_ptr<const StepTestResult> step_test = {};  ///< of the graphical methods
    DeferredDiagnostics diagnostics = {};                  ///< computed when something below is read
    std::shared_ptr<const NoiseModel> noise = {};          ///< of rivc
    std::shared_ptr<const ParameterHistory> history = {};  ///< of recursive methods

    /// Message and warnings with what the diagnostics add.
    Message full_message() const;
    std::vector<Message> all_warnings() const;
    /// The assessment of errors that are colored; nothing for others.
    std::shared_ptr<const Assessment> color() const;
    const Vector& std() const { return errors.get().std; }
    const Matrix& covariance() const { return errors.get().covariance; }
    const ReportFields& report() const { return fields.get(); }
    /// The robust covariance when the output errors are colored.
    Matrix trusted_covariance() const;
};

/// A model as scripts hold it: a transfer function, with its process parameters, polynomials and estimate where it has
/// them. With several inputs or outputs G is the first channel's.
struct Model {
    TransferFunction G;
    std::optional<ProcessModel> process = {};
    std::shared_ptr<const Estimate> estimate = {};
    std::shared_ptr<const PolynomialModel> polynomial = {};
    /// Models with several channels that are no polynomial model: all of them, output by output.
    std::vector<TransferFunction> channels = {};
    std::size_t outputs = 1;
    std::shared_ptr<const StateSpace> system = {};  ///< of n4sid

    std::size_t inputs() const {
        if (polynomial) return polynomial->B.size();
        return channels.empty() ? 1 : channels.size() / outputs;
    }
    bool single_channel() const { return inputs() == 1 && outputs == 1; }
};

template <>
struct Userdata<Model> {
    static constexpr ObjectType type{"model"};
    static std::size_t outside_bytes(const Model& model);
};

template <>
struct Userdata<StateSpace> {
    static constexpr ObjectType type{"state-space model"};
    static std::size_t outside_bytes(const StateSpace& system);
};

template <>
struct Userdata<Complex> {
    static constexpr ObjectType type{"complex number"};
    static std::size_t outside_bytes(const Complex&) { return 0; }
};

template <>
struct Userdata<ComplexVector> {
    static constexpr ObjectType type{"complex vector"};
    static std::size_t outside_bytes(const ComplexVector& v) {
        return sizeof(Complex) * static_cast<std::size_t>(v.size());
    }
};

bool holds_model(const Call& call, int index);
/// A tf, idproc or estimated model or a state-space model, with one input and one output; a number as a gain.
Model model_argument(const Call& call, int index, ArgumentName what);
/// "it has 2 inputs and 1 outputs: take one of its channels, ..." for messages.
Message channels_hint(const Model& model);
int give_model(const Call& call, TransferFunction G);

/// The transfer functions of all channels, output by output.
std::vector<TransferFunction> channels_of(const Model& model);
/// What an estimated continuous-time model with one input and a finite covariance knows of its uncertainty.
std::optional<UncertainModel> uncertain_model(const Model& model);

/// Names and values of theta = [a_1..a_n b_0..b_m] (F instead of A for process models their own names), and the
/// standard errors where an estimate has them.
struct ModelParameters {
    std::vector<std::string> names;
    Vector values, std;
};
ModelParameters parameters_of(const Model& model);

}  // namespace dynlab::inline scripting
