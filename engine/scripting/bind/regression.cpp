#include <array>

#include "base/reader.h"
#include "figures/plots/regression_plot.h"
#include "numerics/estimators/gradient_descent.h"
#include "numerics/estimators/linear_regression.h"
#include "numerics/statistics/distributions.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/figure_object.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {

/// Result of lsq and polyfit_report.
struct RegressionFit {
    LinearRegression regression;
    std::optional<PolynomialFit> polynomial;
};

template <>
struct Userdata<RegressionFit> {
    static constexpr ObjectType type{"regression"};
    static std::size_t outside_bytes(const RegressionFit& fit) {
        return 4 * sizeof(double) * static_cast<std::size_t>(fit.regression.residuals.size());
    }
};

namespace {

constexpr std::array kRegressionMethods = {"qr", "normal"};
constexpr OptionEntry kRegressionMethod = option<&PolyfitOptions::method>(
    "method",
    about("orthogonal factorization (\"qr\"), or the normal equations (\"normal\"), which "
          "square the condition number"),
    {.initial = "\"qr\"", .choices = kRegressionMethods});
constexpr std::array kLsqOptions = {kRegressionMethod};
constexpr std::array kPolyfitOptions = {
    option<&PolyfitOptions::centered>("centered",
                                      about("true uses powers of x minus its mean, instead of powers of x")),
    kRegressionMethod};
constexpr OptionEntry kRegressionPlotOptions[] = {
    {"forecast", ValueKind::kNumber, about("value of x at which to mark a forecast")},
    {"text", ValueKind::kText, about("label of the forecast; by default, the value of the forecast")},
    {"level", ValueKind::kNumber, about("confidence level of the bands"), {.initial = "0.95"}},
    {"xlabel", ValueKind::kText, about("x-axis label")},
    {"ylabel", ValueKind::kText, about("y-axis label")}};
constexpr std::array kDescentOptions = {
    option<&GradientDescentOptions::step_size>(
        "step", about("step size; by default 1/lambda_max, where lambda_max is the largest eigenvalue of Phi'*Phi/N")),
    option<&GradientDescentOptions::max_iterations>("MaxIter", about("maximum number of iterations")),
    option<&GradientDescentOptions::tolerance>("Tol", about("relative change of theta below which the search stops"),
                                               {.minimum = 0}),
    option<&GradientDescentOptions::start>("start", about("initial theta; by default, zero"))};
constexpr OptionTable kLsqTables[] = {kLsqOptions}, kPolyfitTables[] = {kPolyfitOptions},
                      kRegressionPlotTables[] = {kRegressionPlotOptions}, kDescentTables[] = {kDescentOptions};

constexpr ArgumentEntry kRegressionX = {"x", ValueKind::kVector, about("vector of N values")},
                        kRegressionY = {"y", ValueKind::kVector, about("vector of N values")},
                        kPolynomialDegree = {"degree", ValueKind::kCount,
                                             about("degree of the polynomial; 1 for a line")};
constexpr std::array kPolynomialArguments = {kRegressionX, kRegressionY, kPolynomialDegree};
constexpr ArgumentEntry kRegressorArguments[] = {
    {"Phi", ValueKind::kAny, about("matrix with N rows and d columns, where N is at least d")}, kRegressionY};
constexpr ArgumentEntry kForecastArguments[] = {
    {"fit", ValueKind::kAny, about("result of `polyfit_report` or `lsq`")},
    {"x", ValueKind::kAny, about("number for a polynomial, or vector of d regressors for `lsq`")},
    {"level", ValueKind::kNumber, about("confidence level of the interval; by default 0.95")}};
constexpr ArgumentEntry kQuantileArguments[] = {
    {"p", ValueKind::kNumber,
     about("probability between 0 and 1; 0.975 for a 95 % confidence interval, with 2.5 % on each side")},
    {"degrees", ValueKind::kNumber, about("degrees of freedom, greater than 0")}};
constexpr ArgumentEntry kRegressionPlotArguments[] = {
    kRegressionX, kRegressionY, {"fit", ValueKind::kAny, about("result of `polyfit_report`")}};

template <auto kMember>
constexpr lua_CFunction regression_field =
    field<RegressionFit, [](const RegressionFit& fit) { return fit.regression.*kMember; }>;

Vector coefficients_of(const RegressionFit& fit) {
    return fit.polynomial ? fit.polynomial->coefficients : fit.regression.theta;
}
double center_of(const RegressionFit& fit) {
    return fit.polynomial ? fit.polynomial->center : 0.0;
}

const Message& message_of(const RegressionFit& fit) {
    return fit.regression.message;
}

Message regression_text(const RegressionFit& given) {
    const LinearRegression& fit = given.regression;
    MessageList lines{{}, Join::kLines};
    lines.items.push_back(Message("theta = {}", vector_text(fit.theta)));
    lines.items.push_back(Message("standard errors = {}", vector_text(fit.std)));
    lines.items.push_back(Message("RMSE = {}, condition number = {}", fit.rmse, fit.condition_number));
    lines.items.push_back(fit.message);
    return Message("{}", lines);
}

constexpr std::array kRegressionFields = {
    Member{"theta", regression_field<&LinearRegression::theta>},
    Member{"std", regression_field<&LinearRegression::std>},
    Member{"fitted", regression_field<&LinearRegression::fitted>},
    Member{"residuals", regression_field<&LinearRegression::residuals>},
    Member{"sigma", regression_field<&LinearRegression::sigma>},
    Member{"rmse", regression_field<&LinearRegression::rmse>},
    Member{"condition_number", regression_field<&LinearRegression::condition_number>},
    Member{"covariance", regression_field<&LinearRegression::covariance>},
    Member{"rank", regression_field<&LinearRegression::rank>},
    Member{"message", localized_field<RegressionFit, message_of>},
    Member{"coefficients", field<RegressionFit, coefficients_of>},
    Member{"center", field<RegressionFit, center_of>},
};
constexpr std::array kRegressionOperators = {Member{"__tostring", localized_field<RegressionFit, regression_text>}};

int least_squares(Call& call) {
    call.at_most(3);
    PolyfitOptions requested;
    Options(call, 3, kLsqTables).read(requested);
    const MatrixMap Phi = call.matrix(1, "Phi");
    push_object(call.state(), RegressionFit{lsq(Phi, call.vector(2, "y"), requested.method), {}});
    return 1;
}

int polynomial(Call& call) {
    call.at_most(4);
    PolyfitOptions requested;
    Options(call, 4, kPolyfitTables).read(requested);
    const VectorMap x = call.vector(1, "x"), y = call.vector(2, "y");
    const PolynomialFit fit = fit_polynomial(x, y, static_cast<int>(call.size(3, "degree")), requested);
    push_object(call.state(), RegressionFit{fit.regression, fit});
    return 1;
}

int polyfit(Call& call) {
    call.at_most(3);
    const VectorMap x = call.vector(1, "x"), y = call.vector(2, "y");
    return call.give_vector(fit_polynomial(x, y, static_cast<int>(call.size(3, "degree"))).coefficients);
}

int quantile_of_student(Call& call) {
    call.at_most(2);
    lua_pushnumber(call.state(), student_t_quantile(call.number(1, "p"), call.number(2, "degrees")));
    return 1;
}

Forecast forecast_at(const RegressionFit& fit, double x, double level) {
    return forecast(*fit.polynomial, x, level);
}

int predict(Call& call) {
    call.at_most(3);
    const RegressionFit& fit = object_argument<RegressionFit>(call, 1, "fit");
    const double level = call.number_or(3, "level", 0.95);
    const bool single = fit.polynomial && call.type(2) == LUA_TNUMBER;
    const Forecast result = single ? forecast_at(fit, call.number(2, "x"), level)
                                   : forecast(fit.regression, call.vector(2, "regressors"), level);
    return give_table(call, "value", result.value, "low", result.low, "high", result.high, "std", result.std,
                      "mean_std", result.mean_std, "level", result.level);
}

/// Line and bands of a fitted polynomial over [from, to].
void add_line(RegressionPicture& picture, const RegressionFit& fit, double from, double to, double level) {
    constexpr Index kPoints = 200;
    picture.line_x = Vector::LinSpaced(kPoints, from, to);
    for (Vector* part : {&picture.line_y, &picture.confidence_lower, &picture.confidence_upper,
                         &picture.prediction_lower, &picture.prediction_upper})
        part->resize(kPoints);
    for (Index i = 0; i < kPoints; ++i) {
        const Forecast at = forecast_at(fit, picture.line_x[i], level);
        const double half_width = (at.high - at.value) * at.mean_std / at.std;
        picture.line_y[i] = at.value;
        picture.confidence_lower[i] = at.value - half_width;
        picture.confidence_upper[i] = at.value + half_width;
        picture.prediction_lower[i] = at.low;
        picture.prediction_upper[i] = at.high;
    }
}

int draw_regression(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kRegressionPlotTables);
    const RegressionFit& fit = object_argument<RegressionFit>(call, 3, "fit");
    if (!fit.polynomial)
        throw InvalidArgument("{} must be a result of polyfit_report, but a result of lsq was given",
                              argument_label(3, "fit"));
    RegressionPicture picture;
    picture.x = call.vector(1, "x");
    picture.y = call.vector(2, "y");
    if (picture.x.size() == 0)
        throw InvalidArgument("{} must have at least one element, but it is empty", argument_label(1, "x"));
    const double level = options.number("level", 0.95);
    const auto x_new = options.optional_number("forecast");
    const double from = picture.x.minCoeff();
    const double to = std::max(picture.x.maxCoeff(), x_new.value_or(from));
    add_line(picture, fit, from, to, level);
    if (x_new) {
        const Forecast at = forecast_at(fit, *x_new, level);
        picture.forecast =
            ForecastPoint{*x_new, at.value, at.low, at.high,
                          options.has("text") ? Message::verbatim(options.text("text", "")) : Message("{}", at.value)};
    }
    picture.level = level;
    picture.x_label = Message::verbatim(options.text("xlabel", ""));
    picture.y_label = Message::verbatim(options.text("ylabel", ""));
    return give_figure(call, regression_plot(picture));
}

int descend(Call& call) {
    call.at_most(3);
    GradientDescentOptions requested;
    Options(call, 3, kDescentTables).read(requested);
    requested.cancel = call.cancel();
    const MatrixMap Phi = call.matrix(1, "Phi");
    const GradientDescentResult result = gradient_descent(Phi, call.vector(2, "y"), requested);
    return give_table(call, "theta", result.theta, "loss", result.loss, "step", result.step_size, "largest_step",
                      result.largest_step, "condition_number", result.condition_number, "iterations", result.iterations,
                      "converged", result.termination == Termination::kConverged, "message",
                      localized(call, result.message));
}

constexpr FunctionEntry kRegressionFunctions[] = {
    {"polyfit", "vectors", "polyfit(x, y, degree) -> p", "Fit a polynomial by least squares", guarded<polyfit>,
     kNoOptions, kPolynomialArguments},
    {"lsq", "regression", "lsq(Phi, y, {options}) -> fit", "Linear least squares with standard errors and residuals",
     guarded<least_squares>, kLsqTables, kRegressorArguments},
    {"polyfit_report", "regression", "polyfit_report(x, y, degree, {options}) -> fit",
     "Fit a polynomial by least squares with standard errors", guarded<polynomial>, kPolyfitTables,
     kPolynomialArguments},
    {"forecast", "regression", "forecast(fit, x, level) -> {value, low, high, ...}",
     "Forecast a value with its prediction interval", guarded<predict>, kNoOptions, kForecastArguments},
    {"tinv", "regression", "tinv(p, degrees) -> t", "Quantile of Student's t-distribution",
     guarded<quantile_of_student>, kNoOptions, kQuantileArguments},
    {"regression_plot", "regression", "regression_plot(x, y, fit, {options}) -> fig",
     "Plot data and a fitted polynomial with its confidence and prediction bands", guarded<draw_regression>,
     kRegressionPlotTables, kRegressionPlotArguments},
    {"gradient_descent", "regression", "gradient_descent(Phi, y, {options}) -> table",
     "Solve a least-squares problem by steepest descent, and return the loss after each iteration", guarded<descend>,
     kDescentTables, kRegressorArguments},
};

constexpr std::array kRegressionTypes = {
    TypeEntry{&Userdata<RegressionFit>::type, kRegressionFields, {}, kRegressionOperators}};

}  // namespace

TypeEntries regression_types() {
    return kRegressionTypes;
}

FunctionEntries regression_functions() {
    return kRegressionFunctions;
}

}  // namespace dynlab::inline scripting
