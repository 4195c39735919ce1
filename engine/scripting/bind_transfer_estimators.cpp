#include <array>
#include <cmath>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/lssvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/kernels/simulation_report.h"
#include "numerics/kernels/transfer_data.h"
#include "scripting/bindings.h"
#include "scripting/estimation.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/model.h"
#include "scripting/order_vector.h"

namespace dynlab {
namespace {

constexpr OrderEntry kNb{"nb", "coefficients of B"};
constexpr OrderEntry kNk{"nk", "samples of delay"};
constexpr std::array kCarxOrders = {OrderEntry{"na", "poles"}, kNb, kNk};
constexpr std::array kOutputErrorOrders = {kNb, OrderEntry{"nf", "poles"}, kNk};
constexpr Index kMostAssessed = 200'000;  // samples: robust errors of longer records would take longer than the fit

/// A channel's numbers of zeros and delays in seconds from its orders.
std::vector<int> zeros_of(const std::vector<int>& coefficients) {
    std::vector<int> zeros;
    for (const int nb : coefficients) {
        if (nb < 1) throw InvalidArgument("nb, the number of coefficients of B, must be at least 1");
        zeros.push_back(nb - 1);
    }
    return zeros;
}

/// Orders of inputs, repeated for each output.
template <class Value>
std::vector<Value> for_channels(const std::vector<Value>& of_inputs, const IdData& data) {
    if (of_inputs.size() == 1 || data.output_count() == 1) return of_inputs;
    std::vector<Value> all;
    for (Index output = 0; output < data.output_count(); ++output)
        all.insert(all.end(), of_inputs.begin(), of_inputs.end());
    return all;
}

std::vector<double> delays_of(const std::vector<int>& samples, const IdData& data) {
    std::vector<double> delays;
    for (const int nk : samples) {
        if (nk > 0 && !data.regular())
            throw InvalidArgument("nk counts samples of delay, which irregularly sampled data do not have: give 0");
        delays.push_back(nk * data.Ts);
    }
    return delays;
}

TransferStructure structure_for(const IdData& data, Denominators sharing, const std::vector<int>& poles,
                                const std::vector<int>& zeros, const std::vector<double>& delays) {
    return TransferStructure::grid(data.output_count(), data.input_count(), sharing, for_channels(poles, data),
                                   for_channels(zeros, data), for_channels(delays, data));
}

Estimate estimate_of(const char* method, const TransferEstimate& result) {
    Estimate estimate;
    estimate.method = method;
    estimate.names = result.names;
    estimate.theta = result.theta;
    estimate.std = result.std;
    estimate.covariance = result.covariance;
    estimate.message = result.message;
    estimate.warnings = result.warnings;
    estimate.converged = result.termination == Termination::kConverged;
    estimate.numbers = {{"fit_percent", result.fit_percent[0]},
                        {"noise_variance", result.noise_variance[0]},
                        {"loss", result.loss},
                        {"condition_number", result.condition_number},
                        {"iterations", static_cast<double>(result.trace.size())}};
    estimate.vectors = {{"fits", result.fit_percent},
                        {"delay_grid", result.delay_grid},
                        {"delay_loss", result.delay_loss},
                        {"initial_values", result.initial_values.empty() ? Vector() : result.initial_values.front()},
                        {"offsets", result.offsets.col(0)}};
    Vector changes(static_cast<Index>(result.trace.size()));
    Matrix path(changes.size(), result.theta.size());
    for (Index i = 0; i < changes.size(); ++i) {
        const TransferIteration& iteration = result.trace[static_cast<std::size_t>(i)];
        changes[i] = iteration.change;
        path.row(i) = iteration.theta.transpose();
    }
    estimate.vectors.emplace_back("changes", changes);
    estimate.matrices = {{"path", path}};
    return estimate;
}

int give_estimate(const Call& call, Estimate estimate, const TransferEstimate& result) {
    Model model{result.models.front()};
    if (result.models.size() > 1) {
        model.channels = result.models;
        model.outputs = static_cast<std::size_t>(result.structure.outputs);
    }
    model.estimate = std::make_shared<Estimate>(std::move(estimate));
    push_object(call.state(), std::move(model));
    return 1;
}

const char* name_of(Call& call) {
    return static_cast<const char*>(lua_touserdata(call.state(), lua_upvalueindex(1)));
}

Hold hold_y_of(const Options& options) {
    return options.choice("hold_y", {"foh", "zoh"}, 0) == 0 ? Hold::kFoh : Hold::kZoh;
}

/// lssvf and ivsvf; lsgpmf and ivgpmf, whose filter has a gain beta.
template <auto kMethod, bool kMomentFunctionals>
Estimation read_filtered(const Call& call) {
    call.at_most(4);
    const auto orders = order_lists(call, 2, kCarxOrders);
    if (orders[0].size() != 1)
        throw InvalidArgument(
            fmt::format("na is one number of poles for all inputs, but {} were given", orders[0].size()));
    const Options options = kMomentFunctionals ? Options(call, 4, {"hold_y", "beta"}) : Options(call, 4, {"hold_y"});
    SvfOptions wanted;
    wanted.lambda = call.number(3, "lambda");
    wanted.hold_y = hold_y_of(options);
    if constexpr (kMomentFunctionals) wanted.beta = options.optional_number("beta").value_or(wanted.lambda);
    return [orders, zeros = zeros_of(orders[1]), wanted](const IdData& data) {
        return kMethod(
            data, structure_for(data, Denominators::kPerOutput, orders[0], zeros, delays_of(orders[2], data)), wanted);
    };
}

template <auto kMethod, bool kMomentFunctionals>
int estimate_filtered(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    TransferEstimate result = read_filtered<kMethod, kMomentFunctionals>(call)(data);
    measure_fit(result, data);
    Estimate estimate = estimate_of(name_of(call), result);
    estimate.carx = true;
    return give_estimate(call, std::move(estimate), result);
}

/// The options that srivc, coe and their tf twins share.
void read_common_options(const Options& options, TransferOptions& wanted) {
    wanted.lambda = options.optional_number("lambda");
    wanted.hold_y = hold_y_of(options);
    wanted.initial_state = parse_initial_state(options.text("InitialState", "zero"));
    wanted.offset = parse_offset(options.text("Offset", "none"));
    wanted.MaxIter = static_cast<int>(options.size("MaxIter", wanted.MaxIter));
    wanted.Tol = options.number("Tol", wanted.Tol);
    wanted.cancel = options.call().cancel();
}

Denominators sharing_of(const Options& options) {
    return options.flag("CommonDenominator", false) ? Denominators::kCommon : Denominators::kPerChannel;
}

/// What the estimator saw: without the operating points for Offset "remove".
std::shared_ptr<const Assessment> assessment_of(const IdData& data, const TransferEstimate& result,
                                                const TransferOptions& options) {
    if (data.sample_count() > kMostAssessed) return {};
    if (options.offset != Offset::kRemove) return std::make_shared<Assessment>(assess(data, result));
    return std::make_shared<Assessment>(assess(without_operating_points(data).data, result));
}

int give_refined(Call& call, const IdData& data, const TransferEstimate& result, const TransferOptions& options) {
    Estimate estimate = estimate_of(name_of(call), result);
    estimate.assessment = assessment_of(data, result, options);
    return give_estimate(call, std::move(estimate), result);
}

/// An output-error estimation with the options it was asked for.
struct RefinedReading {
    TransferOptions options;
    Estimation estimation;
};

/// srivc and coe: orders and fixed delays in samples.
template <auto kMethod>
RefinedReading read_refined(const Call& call) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kOutputErrorOrders);
    const Options options(call, 3,
                          {"lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator"});
    RefinedReading reading;
    read_common_options(options, reading.options);
    reading.estimation = [orders, zeros = zeros_of(orders[0]), sharing = sharing_of(options),
                          wanted = reading.options](const IdData& data) {
        return kMethod(data, structure_for(data, sharing, orders[1], zeros, delays_of(orders[2], data)), wanted);
    };
    return reading;
}

/// A whole number, or a list of one for each input.
std::vector<int> counts_argument(const Call& call, int index, const char* what) {
    if (call.type(index) != LUA_TTABLE && !call.holds_vector(index)) return {static_cast<int>(call.size(index, what))};
    const auto values = call.vector(index, what);
    std::vector<int> counts;
    for (const double value : values) {
        if (!(value >= 0) || value != std::floor(value))
            throw InvalidArgument(fmt::format("argument {} ({}) must hold whole numbers from 0 on", index, what));
        counts.push_back(static_cast<int>(value));
    }
    return counts;
}

/// IODelay: a number of seconds or one for each input.
std::vector<double> delays_option(const Options& options) {
    if (options.push("IODelay") && lua_type(options.call().state(), -1) == LUA_TNUMBER)
        return {options.number("IODelay", 0)};
    const auto delays = options.vector("IODelay");
    return {delays.begin(), delays.end()};
}

/// tfsrivc and tfcoe: numbers of poles and zeros, and a delay that is estimated unless it is given.
template <auto kMethod>
RefinedReading read_transfer_function(const Call& call) {
    call.at_most(4);
    const Options options(call, 4,
                          {"lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator", "TdMin",
                           "TdMax", "NumTd", "IODelay"});
    RefinedReading reading;
    TransferOptions& wanted = reading.options;
    read_common_options(options, wanted);
    wanted.TdMin = options.number("TdMin", wanted.TdMin);
    wanted.TdMax = options.optional_number("TdMax");
    wanted.NumTd = static_cast<int>(options.size("NumTd", wanted.NumTd));
    std::vector<double> delays{wanted.TdMin};
    if (options.has("IODelay")) delays = delays_option(options);
    const bool free_delays = !options.has("IODelay") && wanted.TdMax.value_or(1) > wanted.TdMin;
    reading.estimation = [poles = counts_argument(call, 2, "np"), zeros = counts_argument(call, 3, "nz"), delays,
                          sharing = sharing_of(options), free_delays, wanted](const IdData& data) {
        TransferStructure structure = structure_for(data, sharing, poles, zeros, delays);
        structure.free_delays = free_delays;
        return kMethod(data, structure, wanted);
    };
    return reading;
}

template <auto kRead>
int estimate_refined(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const RefinedReading reading = kRead(call);
    return give_refined(call, data, reading.estimation(data), reading.options);
}

template <auto kRead>
Estimation read_estimation(const Call& call) {
    return kRead(call).estimation;
}

constexpr std::pair<const char*, EstimationReader> kReaders[] = {
    {"lssvf", read_filtered<lssvf, false>},
    {"ivsvf", read_filtered<ivsvf, false>},
    {"lsgpmf", read_filtered<lssvf, true>},
    {"ivgpmf", read_filtered<ivsvf, true>},
    {"srivc", read_estimation<read_refined<srivc>>},
    {"coe", read_estimation<read_refined<coe>>},
    {"tfsrivc", read_estimation<read_transfer_function<srivc>>},
    {"tfcoe", read_estimation<read_transfer_function<coe>>}};

constexpr const char* kArea = "continuous time";
constexpr std::array kFunctions = {
    FunctionEntry{"lssvf", kArea, "lssvf(data, {na, nb, nk}, lambda, {hold_y =}) -> G",
                  "A y = B u + e by least squares on state-variable filtered signals",
                  guarded<estimate_filtered<lssvf, false>>},
    FunctionEntry{"ivsvf", kArea, "ivsvf(data, {na, nb, nk}, lambda, {hold_y =}) -> G",
                  "the same by instrumental variables, without lssvf's bias", guarded<estimate_filtered<ivsvf, false>>},
    FunctionEntry{"lsgpmf", kArea, "lsgpmf(data, {na, nb, nk}, lambda, {beta =, hold_y =}) -> G",
                  "least squares on Poisson moment functionals", guarded<estimate_filtered<lssvf, true>>},
    FunctionEntry{"ivgpmf", kArea, "ivgpmf(data, {na, nb, nk}, lambda, {beta =, hold_y =}) -> G",
                  "instrumental variables on Poisson moment functionals", guarded<estimate_filtered<ivsvf, true>>},
    FunctionEntry{"srivc", kArea, "srivc(data, {nb, nf, nk}, {lambda =, MaxIter =, Tol =, ...}) -> G",
                  "y = B/F u + e by refined instrumental variables", guarded<estimate_refined<read_refined<srivc>>>},
    FunctionEntry{"coe", kArea, "coe(data, {nb, nf, nk}, {lambda =, MaxIter =, Tol =, ...}) -> G",
                  "y = B/F u + e with the smallest simulation error", guarded<estimate_refined<read_refined<coe>>>},
    FunctionEntry{"tfsrivc", kArea, "tfsrivc(data, np, nz, {TdMin =, TdMax =, IODelay =, ...}) -> G",
                  "srivc by numbers of poles and zeros, the delay estimated",
                  guarded<estimate_refined<read_transfer_function<srivc>>>},
    FunctionEntry{"tfcoe", kArea, "tfcoe(data, np, nz, {TdMin =, TdMax =, IODelay =, ...}) -> G",
                  "coe by numbers of poles and zeros, the delay estimated",
                  guarded<estimate_refined<read_transfer_function<coe>>>},
};

}  // namespace

EstimationReader find_estimation_reader(const std::string& method) {
    for (const auto& [name, reader] : kReaders)
        if (method == name) return reader;
    return nullptr;
}

std::vector<std::string> estimation_names() {
    std::vector<std::string> names;
    for (const auto& [name, reader] : kReaders) names.emplace_back(name);
    return names;
}

int give_transfer_estimate(const Call& call, const char* method, const TransferEstimate& estimate) {
    return give_estimate(call, estimate_of(method, estimate), estimate);
}

FunctionEntries transfer_estimator_functions() {
    return kFunctions;
}

}  // namespace dynlab
