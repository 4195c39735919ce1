#include "numerics/estimators/catalogue.h"

#include <algorithm>

namespace dynlab {

const std::vector<MethodEntry>& method_catalogue() {
    static const std::vector<MethodEntry> kMethods = {
        {"step_test",
         {"step_first_order", "step_second_order", "step_delayed"},
         "parameters read off a step response",
         "K/(1 + T s), K w0^2/(s^2 + 2 z w0 s + w0^2), K exp(-D s)/(1 + T s)",
         TimeDomain::kContinuous,
         "small against the step",
         "Broida (1969) for the delayed first order; overshoot and settling time are classical"},
        {"linear_regression",
         {"lsq", "polyfit_report", "forecast"},
         "linear least squares with standard errors and prediction intervals",
         "y = Phi theta + e",
         TimeDomain::kStatic,
         "white, independent of the regressors",
         "Ljung (1999), section 7.3; Seber and Lee (2003), chapter 5"},
        {"gradient_descent",
         {"gradient_descent"},
         "linear least squares by steepest descent",
         "y = Phi theta + e",
         TimeDomain::kStatic,
         "white, independent of the regressors",
         "Boyd and Vandenberghe (2004), section 9.3"},
        {"lssvf",
         {"lssvf", "lsgpmf"},
         "least squares on filtered signals",
         "A y = B u + e (CARX)",
         TimeDomain::kContinuous,
         "white in the filtered equation; noise on the output biases it",
         "Young (1981); Garnier and Wang (2008), section 1.3"},
        {"ivsvf",
         {"ivsvf", "ivgpmf"},
         "instrumental variables on filtered signals",
         "A y = B u + e (CARX)",
         TimeDomain::kContinuous,
         "any that is independent of the input; best for none in particular",
         "Young and Jakeman (1980); Garnier and Wang (2008), section 1.4"},
        {"srivc",
         {"srivc", "tfsrivc"},
         "refined instrumental variables for transfer functions",
         "y = B/F u + e (COE)",
         TimeDomain::kContinuous,
         "white at the output; consistent for any that is independent of the input",
         "Young and Jakeman (1980); Young, Garnier and Gilson in Garnier and Wang (2008), chapter 4"},
        {"coe",
         {"coe", "tfcoe"},
         "output error for transfer functions",
         "y = B/F u + e (COE)",
         TimeDomain::kContinuous,
         "white at the output",
         "Ljung (1999), sections 4.2 and 10.2; Garnier and Wang (2008), chapter 1"},
        {"rivc",
         {"rivc", "tfrivc"},
         "refined instrumental variables with a noise model",
         "y = B/F u + C/D e (CBJ)",
         TimeDomain::kContinuous,
         "autoregressive moving-average, of the orders given",
         "Young, Garnier and Gilson in Garnier and Wang (2008), chapter 4"},
        {"procsrivc",
         {"procsrivc"},
         "process models from any record, delay included",
         "P1, P2, P3, P2U, P3U, each with any of D, I, Z",
         TimeDomain::kContinuous,
         "white at the output",
         "Young, Garnier and Gilson in Garnier and Wang (2008), chapter 4; Ljung (1999), section 10.2"},
        {"arx",
         {"arx"},
         "least squares on the difference equation",
         "A y = B u + e",
         TimeDomain::kDiscrete,
         "white inside the equation",
         "Ljung (1999), sections 7.3 and 10.1"},
        {"oe",
         {"oe"},
         "smallest simulation error of a difference equation",
         "y = B/F u + e",
         TimeDomain::kDiscrete,
         "white at the output",
         "Ljung (1999), sections 4.2 and 10.2"},
        {"sriv",
         {"sriv"},
         "instrumental variables refined with the model's own filter",
         "y = B/F u + e",
         TimeDomain::kDiscrete,
         "white at the output",
         "Young and Jakeman (1979); Young (2011), chapter 7"},
    };
    return kMethods;
}

std::optional<MethodEntry> find_method(const std::string& lua_name) {
    for (const MethodEntry& method : method_catalogue())
        if (std::find(method.lua_names.begin(), method.lua_names.end(), lua_name) != method.lua_names.end())
            return method;
    return std::nullopt;
}

}  // namespace dynlab
