#include "numerics/estimators/learning/sindy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/criteria/rate_equations.h"
#include "numerics/error.h"
#include "numerics/estimators/learning/canceled.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/triangular_factor.h"
#include "numerics/simulation/ode_solver.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxIntegratedStates = 8;  // of the integrator
constexpr double kStateOutOfBounds = 1e3;  // times the largest value of a state in the data

/// R of [Theta B] over all experiments: the part of the equations that least squares needs.
struct Rotated {
    Matrix R;
    Index rows = 0;
};

Rotated rotated_equations(const IdData& data, const FunctionLibrary& library, const SindyOptions& options,
                          const std::optional<double>& width) {
    const Index functions = library.count(), states = data.output_count();
    TriangularFactor factor(functions + states);
    Rotated rotated;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        check_canceled("sindy", options.cancel);
        const RateEquations own =
            width ? weak_equations(data, k, library, *width) : derivative_equations(data, k, library, options.window);
        Matrix joint(own.B.rows(), functions + states);
        joint << own.Theta, own.B;
        factor.add(joint);
        rotated.rows += own.B.rows();
    }
    rotated.R = factor.R();
    if (rotated.rows > functions) return rotated;
    throw InvalidArgument(
        width ? Message("sindy: the number of equations must be greater than the number of functions, {}, but is {}. "
                        "Use more samples, a smaller {} or fewer functions",
                        functions, rotated.rows, OptionName{"width"})
              : Message("sindy: the number of equations must be greater than the number of functions, {}, but is {}. "
                        "Use more samples or fewer functions, or {} = true if the input jumps often",
                        functions, rotated.rows, OptionName{"weak"}));
}

/// The coefficients of one state, with those of small contributions at zero.
struct Sparse {
    Vector coefficients;
    double loss = 0, condition_number = 1;
};

/// What each term explains that the others cannot, |xi_j| |theta_j without its projection on the others|: the root of
/// what the sum of squares rises by without it. Terms that cancel each other have large coefficients and explain
/// little.
Vector own_contributions(const LeastSquares& solution) {
    return solution.solution.cwiseAbs().cwiseQuotient(solution.inverse_gram.diagonal().cwiseSqrt());
}

Sparse thresholded(const Matrix& R, Index functions, Index state, const SindyOptions& options) {
    const auto b = R.col(functions + state);
    const double size = b.norm();
    Sparse found{Vector::Zero(functions), size * size};
    std::vector<Index> active;
    for (Index j = 0; j < functions && size > 0; ++j)
        if (R.col(j).norm() > 0) active.push_back(j);
    while (!active.empty()) {
        const LeastSquares solution = solve_least_squares(R(Eigen::all, active), b);
        Index least = 0;
        if (own_contributions(solution).minCoeff(&least) < options.threshold * size) {
            active.erase(active.begin() + least);
            continue;
        }
        found.coefficients(active) = solution.solution;
        found.loss = solution.residuals.squaredNorm();
        found.condition_number = solution.condition_number;
        break;
    }
    return found;
}

std::string equation_text(const std::string& state, const FunctionLibrary& library, const VectorView& coefficients) {
    std::string text = "d" + state + "/dt =";
    bool first = true;
    for (Index j = 0; j < coefficients.size(); ++j) {
        const double value = coefficients[j];
        if (value == 0) continue;
        text += (value < 0 ? (first ? " -" : " - ") : first ? " " : " + ") + number_text(std::abs(value), 5);
        const std::string& name = library.names[static_cast<std::size_t>(j)];
        if (name != "1") text += "*" + name;
        first = false;
    }
    return first ? text + " 0" : text;
}

void assess(SindyFit& found, const IdData& data) {
    Fit& fit = found.fit;
    Vector errors = Vector::Zero(data.output_count());
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const FreeRun run = found.model->free_run(data, k, Vector());
        if (run.lost_at) fit.warnings.push_back(divergence_text(data, k, *run.lost_at));
        errors += (data.experiments[k].y - run.output).colwise().squaredNorm().transpose();
    }
    fit.fit_percent = errors.binaryExpr(output_variations(data), &fit_percent_of_sums);
    constexpr double kReproduces = 80;  // per cent of fit
    for (Index i = 0; i < fit.fit_percent.size(); ++i)
        if (fit.fit_percent[i] < kReproduces) {
            fit.warnings.push_back(
                Message("The equations do not reproduce the data: the simulation fit of {} is only {} %. Use other "
                        "functions, for example with {} = 3.",
                        data.output_names[static_cast<std::size_t>(i)], significant(fit.fit_percent[i], 3),
                        OptionName{"degree"}));
            break;
        }
}

void check(const IdData& data, const FunctionLibrary& library, const SindyOptions& options) {
    options.validate();
    if (library.count() == 0) throw InvalidArgument("sindy: the library contains no functions");
    if (data.output_count() < 1 || data.output_count() > kMaxIntegratedStates)
        throw InvalidArgument("sindy uses the outputs as states and supports 1 to {} outputs, but the data have {}",
                              kMaxIntegratedStates, data.output_count());
    const Vector variations = output_variations(data);
    for (Index i = 0; i < variations.size(); ++i)
        if (!(variations[i] > 0))
            throw InvalidArgument(
                "sindy: the state {} never changes, so its equation cannot be estimated. Use data in which all states "
                "vary",
                data.output_names[static_cast<std::size_t>(i)]);
}

Vector largest_states(const IdData& data) {
    Vector largest = Vector::Zero(data.output_count());
    for (const Experiment& experiment : data.experiments)
        largest = largest.cwiseMax(experiment.y.cwiseAbs().colwise().maxCoeff().transpose());
    return largest;
}

/// Sets coefficients, theta and names, equations, and the messages about them.
void describe(SindyFit& found, const IdData& data, const SindyOptions& options) {
    Fit& fit = found.fit;
    const Matrix& Xi = found.model->coefficients();
    const FunctionLibrary& library = found.model->library();
    std::vector<double> theta;
    for (Index i = 0; i < Xi.cols(); ++i) {
        const std::string& state = data.output_names[static_cast<std::size_t>(i)];
        for (Index j = 0; j < Xi.rows(); ++j) {
            if (Xi(j, i) == 0) continue;
            theta.push_back(Xi(j, i));
            fit.names.push_back(state + ": " + library.names[static_cast<std::size_t>(j)]);
        }
        found.equations.push_back(equation_text(state, library, Xi.col(i)));
        if ((Xi.col(i).array() == 0).all())
            fit.warnings.push_back(Message(
                "No function of the library contributes to the derivative of {}. Lower the threshold, or use other "
                "functions.",
                state));
    }
    fit.theta = Vector::Map(theta.data(), static_cast<Index>(theta.size()));
    if (fit.condition_number > kAmbiguousCondition)
        fit.warnings.push_back(
            Message("The functions of the library are nearly linearly dependent on these data (condition number {}): "
                    "use fewer functions.",
                    significant(fit.condition_number, 2)));
    assess(found, data);
    const Message equations = options.weak ? Message("in weak form") : Message("from derivatives");
    fit.message = Message("Sparse equations {} with {} of {}: {}.", equations, theta.size(),
                          plural(Xi.size(), "{} coefficient", "{} coefficients"), simulation_text(fit));
}

}  // namespace

SindyModel::SindyModel(FunctionLibrary library, Matrix coefficients, Index inputs, Vector largest)
    : library_(std::move(library)),
      coefficients_(std::move(coefficients)),
      inputs_(inputs),
      largest_(std::move(largest)) {}

Vector SindyModel::rate(const VectorView& x, const VectorView& u) const {
    return (library_.values(Matrix(x.transpose()), Matrix(u.transpose())) * coefficients_).transpose();
}

FreeRun SindyModel::free_run(const IdData& data, std::size_t experiment, const VectorView& x0) const {
    check_channels("sindy", *this, data);
    const Experiment& data_set = data.experiments[experiment];
    const Vector t = data.time(experiment);
    const Index N = t.size(), n = output_count();
    if (x0.size() != 0 && x0.size() != n)
        throw InvalidArgument("sindy: x0 must contain the {} at the first sample, but has {}",
                              plural(n, "{} state", "{} states"), plural(x0.size(), "{} value", "{} values"));
    FreeRun run{Matrix::Constant(N, n, kNaN), {}, Message("from the first sample of the data")};
    OdeState x = OdeState::Zero(n);
    if (x0.size() > 0)
        x = x0;
    else if (data_set.y.cols() > 0)
        x = data_set.y.row(0).transpose();
    run.output.row(0) = x.transpose();
    Vector u = data_set.u.row(0).transpose();
    Index k = 0;
    bool broken = false;  // the library itself
    OdeSolver solver(
        [&](double time, const OdeState& state) -> OdeState {
            if (!(state.array().abs() <= kStateOutOfBounds * kStateOutOfBounds * largest_.array()).all())
                return OdeState::Constant(n, std::numeric_limits<double>::max());
            if (data.hold == Hold::kFoh && u.size() > 0) {
                const double share = (time - t[k]) / (t[k + 1] - t[k]);
                u = ((1 - share) * data_set.u.row(k) + share * data_set.u.row(k + 1)).transpose();
            }
            broken = true;
            const Vector rates = rate(state, u);
            broken = false;
            return rates;
        },
        {1e-9, 1e-9 * largest_.minCoeff(), data.mean_step() / 10});
    for (; k + 1 < N; ++k) {
        u = data_set.u.row(k).transpose();
        double time = t[k];
        try {
            solver.advance(time, x, t[k + 1]);
        } catch (const InvalidArgument&) {
            if (broken) throw;
            x.setConstant(kNaN);
        }
        if (!(x.array().abs() <= kStateOutOfBounds * largest_.array()).all()) {
            run.lost_at = k + 1;
            break;
        }
        run.output.row(k + 1) = x.transpose();
    }
    return run;
}

void SindyOptions::validate() const {
    if (!(threshold >= 0 && threshold < 1))
        throw InvalidArgument("sindy: {}, a fraction of the derivative, must be at least 0 and less than 1, but is {}",
                              OptionName{"threshold"}, threshold);
    if (window < 3 || window % 2 == 0)
        throw InvalidArgument("sindy: {} must be an odd number of samples, at least 3, but is {}", OptionName{"window"},
                              window);
    if (width && !(*width > 0))
        throw InvalidArgument("sindy: {} must be positive, but is {}", OptionName{"width"}, *width);
}

SindyFit sindy(const IdData& data, const FunctionLibrary& library, const SindyOptions& options) {
    check(data, library, options);
    SindyFit found;
    if (options.weak) found.width = options.width ? *options.width : usual_width(data);
    const auto [R, rows] = rotated_equations(data, library, options, found.width);
    const Index functions = library.count(), states = data.output_count();
    Matrix Xi(functions, states);
    double squares = 0;
    for (Index i = 0; i < states; ++i) {
        check_canceled("sindy", options.cancel);
        const Sparse sparse = thresholded(R, functions, i, options);
        Xi.col(i) = sparse.coefficients;
        squares += sparse.loss;
        found.fit.condition_number = std::max(found.fit.condition_number, sparse.condition_number);
    }
    found.fit.loss = squares / static_cast<double>(rows * states);
    found.model = std::make_shared<SindyModel>(library, Xi, data.input_count(), largest_states(data));
    describe(found, data, options);
    return found;
}

}  // namespace dynlab::inline numerics
