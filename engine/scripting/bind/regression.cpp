#include <array>

#include "base/reader.h"
#include "figures/plots/regression_plot.h"
#include "numerics/estimators/gradient_descent.h"
#include "numerics/estimators/linear_regression.h"
#include "numerics/statistics/distributions.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
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
struct Boxed<RegressionFit> {
    static constexpr ObjectType type{"regression"};
    static std::size_t outside_bytes(const RegressionFit& fit) {
        return 4 * sizeof(double) * static_cast<std::size_t>(fit.regression.residuals.size());
    }
};

namespace {

template <auto kMember>
constexpr lua_CFunction regression_field =
    field<RegressionFit, [](const RegressionFit& fit) { return fit.regression.*kMember; }>;

Vector coefficients_of(const RegressionFit& fit) {
    return fit.polynomial ? fit.polynomial->coefficients : fit.regression.theta;
}
double centre_of(const RegressionFit& fit) {
    return fit.polynomial ? fit.polynomial->centre : 0.0;
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
    Member{"centre", field<RegressionFit, centre_of>},
};
constexpr std::array kRegressionOperators = {Member{"__tostring", localized_field<RegressionFit, regression_text>}};

int least_squares(Call& call) {
    call.at_most(3);
    const Options options(call, 3, {"method"});
    const MatrixMap Phi = call.matrix(1, "Phi");
    push_object(
        call.state(),
        RegressionFit{lsq(Phi, call.vector(2, "y"), parse_regression_method(options.text("method", "qr"))), {}});
    return 1;
}

int polynomial(Call& call) {
    call.at_most(4);
    const Options options(call, 4, {"centred", "method"});
    const VectorMap x = call.vector(1, "x"), y = call.vector(2, "y");
    const PolynomialFit fit =
        fit_polynomial(x, y, static_cast<int>(call.size(3, "degree")),
                       {options.flag("centred", true), parse_regression_method(options.text("method", "qr"))});
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

/// regression_plot(x, y, fit, {forecast = x_new, level =, xlabel =, ylabel =, text =})
int draw_regression(Call& call) {
    call.at_most(4);
    const Options options(call, 4, {"forecast", "text", "level", "xlabel", "ylabel"});
    const RegressionFit& fit = object_argument<RegressionFit>(call, 3, "fit");
    if (!fit.polynomial) throw InvalidArgument("{} must come from polyfit_report", argument_label(3, "fit"));
    RegressionPicture picture;
    picture.x = call.vector(1, "x");
    picture.y = call.vector(2, "y");
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
    const Options options(call, 3, {"step", "MaxIter", "Tol", "start"});
    GradientDescentOptions wanted;
    wanted.step_size = options.optional_number("step");
    wanted.max_iterations = static_cast<int>(options.size("MaxIter", wanted.max_iterations));
    wanted.tolerance = options.number("Tol", wanted.tolerance);
    if (options.has("start")) wanted.start = options.vector("start");
    wanted.cancel = call.cancel();
    const MatrixMap Phi = call.matrix(1, "Phi");
    const GradientDescentResult result = gradient_descent(Phi, call.vector(2, "y"), wanted);
    return give_table(call, "theta", result.theta, "loss", result.loss, "step", result.step_size, "largest_step",
                      result.largest_step, "condition_number", result.condition_number, "iterations", result.iterations,
                      "converged", result.termination == Termination::kConverged, "message",
                      localized(call, result.message));
}

constexpr FunctionEntry kRegressionFunctions[] = {
    {"polyfit", "vectors", "polyfit(x, y, degree) -> p", "least-squares polynomial, highest power first",
     guarded<polyfit>},
    {"lsq", "regression", "lsq(Phi, y, {method = \"qr\" | \"normal\"}) -> fit",
     "least squares with standard errors, residuals and condition number", guarded<least_squares>},
    {"polyfit_report", "regression", "polyfit_report(x, y, degree, {centred =, method =}) -> fit",
     "polynomial by least squares with its standard errors", guarded<polynomial>},
    {"forecast", "regression", "forecast(fit, x, level) -> {value, low, high, ...}",
     "forecast with its prediction interval", guarded<predict>},
    {"tinv", "regression", "tinv(p, degrees) -> t", "quantile of Student's distribution, for intervals by hand",
     guarded<quantile_of_student>},
    {"regression_plot", "regression", "regression_plot(x, y, fit, {forecast =, level =, xlabel =, ylabel =}) -> fig",
     "data, fitted polynomial and its bands", guarded<draw_regression>},
    {"gradient_descent", "regression", "gradient_descent(Phi, y, {step =, MaxIter =, Tol =, start =}) -> table",
     "least squares by steepest descent, with the loss after every step", guarded<descend>},
};

constexpr std::array kRegressionTypes = {
    TypeEntry{&Boxed<RegressionFit>::type, kRegressionFields, {}, kRegressionOperators}};

}  // namespace

TypeEntries regression_types() {
    return kRegressionTypes;
}

FunctionEntries regression_functions() {
    return kRegressionFunctions;
}

}  // namespace dynlab::inline scripting
