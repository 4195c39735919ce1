#include <array>

#include "figures/plots/regression_plot.h"
#include "numerics/estimators/gradient_descent.h"
#include "numerics/estimators/linear_regression.h"
#include "scripting/bind/bindings.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/text_form.h"

namespace dynlab::inline scripting {

/// Result of lsq and polyfit_report.
struct RegressionFit {
    LinearRegression regression;
    std::optional<PolynomialFit> polynomial;
};

template <>
struct Boxed<RegressionFit> {
    static const ObjectType type;
    static std::size_t outside_bytes(const RegressionFit& fit) {
        return 4 * sizeof(double) * static_cast<std::size_t>(fit.regression.residuals.size());
    }
};

namespace {

const RegressionFit& regression_self(Call& call) {
    return object_argument<RegressionFit>(call, 1, "fit");
}

template <auto kMember>
int field_vector(Call& call) {
    return call.give_vector(regression_self(call).regression.*kMember);
}
template <auto kMember>
int field_number(Call& call) {
    return call.give(regression_self(call).regression.*kMember);
}
int regression_covariance(Call& call) {
    return call.give_matrix(regression_self(call).regression.covariance);
}
int field_rank(Call& call) {
    return call.give_integer(regression_self(call).regression.rank);
}
int field_message(Call& call) {
    return call.give(regression_self(call).regression.message);
}
int field_coefficients(Call& call) {
    const RegressionFit& fit = regression_self(call);
    return call.give_vector(fit.polynomial ? fit.polynomial->coefficients : fit.regression.theta);
}
int field_centre(Call& call) {
    return call.give(regression_self(call).polynomial ? regression_self(call).polynomial->centre : 0.0);
}

int fit_text(Call& call) {
    const LinearRegression& fit = regression_self(call).regression;
    return call.give(fmt::format("theta = {}\nstandard errors = {}\nRMSE = {}, condition number = {}\n{}",
                                 vector_text(fit.theta), vector_text(fit.std), number_text(fit.rmse),
                                 number_text(fit.condition_number), fit.message));
}

constexpr std::array kRegressionFields = {
    Member{"theta", guarded<field_vector<&LinearRegression::theta>>},
    Member{"std", guarded<field_vector<&LinearRegression::std>>},
    Member{"fitted", guarded<field_vector<&LinearRegression::fitted>>},
    Member{"residuals", guarded<field_vector<&LinearRegression::residuals>>},
    Member{"sigma", guarded<field_number<&LinearRegression::sigma>>},
    Member{"rmse", guarded<field_number<&LinearRegression::rmse>>},
    Member{"condition_number", guarded<field_number<&LinearRegression::condition_number>>},
    Member{"covariance", guarded<regression_covariance>},
    Member{"rank", guarded<field_rank>},
    Member{"message", guarded<field_message>},
    Member{"coefficients", guarded<field_coefficients>},
    Member{"centre", guarded<field_centre>},
};
constexpr std::array kRegressionOperators = {Member{"__tostring", guarded<fit_text>}};

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

Forecast forecast_at(const RegressionFit& fit, double x, double level) {
    return forecast(*fit.polynomial, x, level);
}

int predict(Call& call) {
    call.at_most(3);
    const RegressionFit& fit = regression_self(call);
    const double level = call.number_or(3, "level", 0.95);
    const bool single = fit.polynomial && call.type(2) == LUA_TNUMBER;
    const Forecast result = single ? forecast_at(fit, call.number(2, "x"), level)
                                   : forecast(fit.regression, call.vector(2, "regressors"), level);
    lua_State* L = call.state();
    lua_createtable(L, 0, 6);
    for (const auto& [name, value] :
         {std::pair("value", result.value), std::pair("low", result.low), std::pair("high", result.high),
          std::pair("std", result.std), std::pair("mean_std", result.mean_std), std::pair("level", result.level)}) {
        lua_pushnumber(L, value);
        lua_setfield(L, -2, name);
    }
    return 1;
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
    if (!fit.polynomial) throw InvalidArgument("argument 3 (fit) must come from polyfit_report");
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
            ForecastPoint{*x_new, at.value, at.low, at.high, options.text("text", number_text(at.value))};
    }
    picture.confidence_label = fmt::format("{} % confidence band", number_text(100 * level));
    picture.prediction_label = fmt::format("{} % prediction band", number_text(100 * level));
    picture.x_label = options.text("xlabel", "");
    picture.y_label = options.text("ylabel", "");
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
    lua_State* L = call.state();
    lua_createtable(L, 0, 8);
    call.give_vector(result.theta), lua_setfield(L, -2, "theta");
    call.give_vector(result.loss), lua_setfield(L, -2, "loss");
    call.give(result.step_size), lua_setfield(L, -2, "step");
    call.give(result.largest_step), lua_setfield(L, -2, "largest_step");
    call.give(result.condition_number), lua_setfield(L, -2, "condition_number");
    call.give_integer(result.iterations), lua_setfield(L, -2, "iterations");
    call.give(result.termination == Termination::kConverged), lua_setfield(L, -2, "converged");
    call.give(result.message), lua_setfield(L, -2, "message");
    return 1;
}

constexpr const char* kRegressionArea = "regression";
constexpr std::array kRegressionFunctions = {
    FunctionEntry{"polyfit", "vectors", "polyfit(x, y, degree) -> p", "least-squares polynomial, highest power first",
                  guarded<polyfit>},
    FunctionEntry{"lsq", kRegressionArea, "lsq(Phi, y, {method = \"qr\" | \"normal\"}) -> fit",
                  "least squares with standard errors, residuals and condition number", guarded<least_squares>},
    FunctionEntry{"polyfit_report", kRegressionArea, "polyfit_report(x, y, degree, {centred =, method =}) -> fit",
                  "polynomial by least squares with its standard errors", guarded<polynomial>},
    FunctionEntry{"forecast", kRegressionArea, "forecast(fit, x, level) -> {value, low, high, ...}",
                  "forecast with its prediction interval", guarded<predict>},
    FunctionEntry{"regression_plot", kRegressionArea,
                  "regression_plot(x, y, fit, {forecast =, level =, xlabel =, ylabel =}) -> fig",
                  "data, fitted polynomial and its bands", guarded<draw_regression>},
    FunctionEntry{"gradient_descent", kRegressionArea,
                  "gradient_descent(Phi, y, {step =, MaxIter =, Tol =, start =}) -> table",
                  "least squares by steepest descent, with the loss after every step", guarded<descend>},
};

}  // namespace

const ObjectType Boxed<RegressionFit>::type{"regression", kRegressionFields, {}, kRegressionOperators};

FunctionEntries regression_functions() {
    return kRegressionFunctions;
}

}  // namespace dynlab::inline scripting
