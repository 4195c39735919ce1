#include "scripting/answers/answer_json.h"

#include <cmath>
#include <limits>

namespace dynlab::inline scripting {
namespace {

using nlohmann::json;

constexpr Index kHighestOrder = 100;

[[noreturn]] void does_not_fit(const char* what) {
    throw InvalidArgument(std::string("the answer's ") + what + " does not fit together");
}

json json_of_vector(const VectorView& v) {
    json j = json::array();
    for (const double value : v) j.push_back(json_of_number(value));
    return j;
}

Vector vector_of_json(const json& j) {
    if (!j.is_array()) does_not_fit("list of numbers");
    Vector v(static_cast<Index>(j.size()));
    for (std::size_t i = 0; i < j.size(); ++i) v[static_cast<Index>(i)] = number_of_json(j[i]);
    return v;
}

Vector coefficients_of_json(const json& j) {
    Vector v = vector_of_json(j);
    if (v.size() > kHighestOrder + 1) throw InvalidArgument("the answer's model is of an absurdly high order");
    return v;
}

json json_of_vectors(const std::vector<Vector>& all) {
    json j = json::array();
    for (const Vector& v : all) j.push_back(json_of_vector(v));
    return j;
}

std::vector<Vector> vectors_of_json(const json& j) {
    std::vector<Vector> all;
    for (const json& v : j) all.push_back(coefficients_of_json(v));
    return all;
}

json json_of_function(const TransferFunction& G) {
    return {{"num", json_of_vector(G.num())},
            {"den", json_of_vector(G.den())},
            {"Ts", json_of_number(G.Ts())},
            {"delay", json_of_number(G.delay())}};
}

TransferFunction function_of_json(const json& j) {
    return TransferFunction(coefficients_of_json(j.at("num")), coefficients_of_json(j.at("den")),
                            number_of_json(j.at("Ts")), number_of_json(j.at("delay")));
}

json json_of_estimate(const Estimate& estimate) {
    json numbers = json::array();
    for (const auto& [name, value] : estimate.numbers) numbers.push_back({name, json_of_number(value)});
    return {{"method", estimate.method},
            {"names", estimate.names},
            {"theta", json_of_vector(estimate.theta)},
            {"std", json_of_vector(estimate.std)},
            {"covariance", json_of_matrix(estimate.covariance)},
            {"message", estimate.message},
            {"warnings", estimate.warnings},
            {"numbers", std::move(numbers)},
            {"converged", estimate.converged},
            {"of_coefficients", estimate.of_coefficients},
            {"carx", estimate.carx}};
}

Estimate estimate_of_json(const json& j) {
    Estimate estimate;
    estimate.method = j.at("method");
    estimate.names = j.at("names").get<std::vector<std::string>>();
    estimate.theta = vector_of_json(j.at("theta"));
    estimate.std = vector_of_json(j.at("std"));
    estimate.covariance = matrix_of_json(j.at("covariance"));
    estimate.message = j.at("message");
    estimate.warnings = j.at("warnings").get<std::vector<std::string>>();
    for (const json& number : j.at("numbers"))
        estimate.numbers.emplace_back(number.at(0), number_of_json(number.at(1)));
    estimate.converged = j.at("converged");
    estimate.of_coefficients = j.at("of_coefficients");
    estimate.carx = j.at("carx");
    const Index d = estimate.theta.size(), known = estimate.covariance.rows();
    if (static_cast<Index>(estimate.names.size()) != d || (estimate.std.size() != d && estimate.std.size() != 0) ||
        known != estimate.covariance.cols() || (known != d && known != 0))
        does_not_fit("estimate");
    return estimate;
}

json json_of_polynomial(const PolynomialModel& model) {
    return {{"A", json_of_vector(model.A)},  {"C", json_of_vector(model.C)},  {"D", json_of_vector(model.D)},
            {"B", json_of_vectors(model.B)}, {"F", json_of_vectors(model.F)}, {"Ts", json_of_number(model.Ts)}};
}

PolynomialModel polynomial_of_json(const json& j) {
    PolynomialModel model(PolynomialOrders::arx(1, {1}, {1}), Vector::Zero(2), 1);
    model.A = coefficients_of_json(j.at("A"));
    model.C = coefficients_of_json(j.at("C"));
    model.D = coefficients_of_json(j.at("D"));
    model.B = vectors_of_json(j.at("B"));
    model.F = vectors_of_json(j.at("F"));
    model.Ts = number_of_json(j.at("Ts"));
    const auto empty = [](const Vector& v) { return v.size() == 0; };
    if (empty(model.A) || empty(model.C) || empty(model.D) || model.B.empty() || model.B.size() != model.F.size() ||
        std::any_of(model.B.begin(), model.B.end(), empty) || std::any_of(model.F.begin(), model.F.end(), empty) ||
        !(model.Ts > 0))
        does_not_fit("model");
    return model;
}

const char* const kNanText = "NaN";
const char* const kInfinite = "Infinity";
const char* const kMinusInfinite = "-Infinity";

}  // namespace

json json_of_number(double value) {
    if (std::isnan(value)) return kNanText;
    if (std::isinf(value)) return value > 0 ? kInfinite : kMinusInfinite;
    return value;
}

double number_of_json(const json& j) {
    if (j.is_number()) return j.get<double>();
    if (j == kNanText) return std::numeric_limits<double>::quiet_NaN();
    if (j == kInfinite) return std::numeric_limits<double>::infinity();
    if (j == kMinusInfinite) return -std::numeric_limits<double>::infinity();
    does_not_fit("number");
}

json json_of_matrix(const MatrixView& m) {
    json values = json::array();
    for (Index j = 0; j < m.cols(); ++j)
        for (Index i = 0; i < m.rows(); ++i) values.push_back(json_of_number(m(i, j)));
    return {{"rows", m.rows()}, {"columns", m.cols()}, {"values", std::move(values)}};
}

Matrix matrix_of_json(const json& j) {
    const Vector values = vector_of_json(j.at("values"));
    const auto rows = j.at("rows").get<Index>(), columns = j.at("columns").get<Index>();
    if (rows < 0 || columns < 0 || (rows > 0 && columns > values.size() / rows) || rows * columns != values.size())
        does_not_fit("matrix");
    return values.reshaped(rows, columns);
}

json json_of_data(const IdData& data) {
    json experiments = json::array();
    for (const Experiment& experiment : data.experiments)
        experiments.push_back({{"y", json_of_matrix(experiment.y)},
                               {"u", json_of_matrix(experiment.u)},
                               {"t", json_of_vector(experiment.t)},
                               {"start_time", json_of_number(experiment.start_time)},
                               {"name", experiment.name}});
    return {{"experiments", std::move(experiments)},
            {"Ts", json_of_number(data.Ts)},
            {"hold", data.hold == Hold::kFoh ? "foh" : "zoh"},
            {"input_names", data.input_names},
            {"output_names", data.output_names},
            {"input_units", data.input_units},
            {"output_units", data.output_units},
            {"time_unit", data.time_unit}};
}

IdData data_of_json(const json& j) {
    const double Ts = number_of_json(j.at("Ts"));
    std::vector<IdData> parts;
    for (const json& e : j.at("experiments")) {
        Matrix y = matrix_of_json(e.at("y")), u = matrix_of_json(e.at("u"));
        IdData part = Ts > 0 ? IdData(std::move(y), std::move(u), Ts)
                             : IdData(std::move(y), std::move(u), vector_of_json(e.at("t")));
        part.experiments.front().start_time = number_of_json(e.at("start_time"));
        part.experiments.front().name = e.at("name");
        part.hold = j.at("hold") == "foh" ? Hold::kFoh : Hold::kZoh;
        part.input_names = j.at("input_names").get<std::vector<std::string>>();
        part.output_names = j.at("output_names").get<std::vector<std::string>>();
        part.input_units = j.at("input_units").get<std::vector<std::string>>();
        part.output_units = j.at("output_units").get<std::vector<std::string>>();
        part.time_unit = j.at("time_unit");
        const auto names = [](const std::vector<std::string>& given, Index wanted) {
            return static_cast<Index>(given.size()) == wanted;
        };
        if (!names(part.input_names, part.input_count()) || !names(part.input_units, part.input_count()) ||
            !names(part.output_names, part.output_count()) || !names(part.output_units, part.output_count()))
            does_not_fit("data");
        parts.push_back(std::move(part));
    }
    if (parts.empty()) does_not_fit("data");
    return parts.size() == 1 ? parts.front() : IdData::merge(parts);
}

json json_of_system(const StateSpace& system) {
    return {{"A", json_of_matrix(system.A)},
            {"B", json_of_matrix(system.B)},
            {"C", json_of_matrix(system.C)},
            {"D", json_of_matrix(system.D)},
            {"Ts", json_of_number(system.Ts)}};
}

StateSpace system_of_json(const json& j) {
    return StateSpace(matrix_of_json(j.at("A")), matrix_of_json(j.at("B")), matrix_of_json(j.at("C")),
                      matrix_of_json(j.at("D")), number_of_json(j.at("Ts")));
}

json json_of_model(const Model& model) {
    json j = {{"function", json_of_function(model.G)}, {"outputs", model.outputs}, {"channels", json::array()}};
    for (const TransferFunction& G : model.channels) j["channels"].push_back(json_of_function(G));
    if (model.process)
        j["process"] = {{"structure", model.process->structure.text()},
                        {"parameters", json_of_vector(model.process->parameters)}};
    if (model.estimate) j["estimate"] = json_of_estimate(*model.estimate);
    if (model.polynomial) j["polynomial"] = json_of_polynomial(*model.polynomial);
    if (model.system) j["system"] = json_of_system(*model.system);
    return j;
}

Model model_of_json(const json& j) {
    Model model{function_of_json(j.at("function"))};
    model.outputs = j.at("outputs").get<std::size_t>();
    for (const json& channel : j.at("channels")) model.channels.push_back(function_of_json(channel));
    if (model.outputs == 0 || (!model.channels.empty() && model.channels.size() % model.outputs != 0))
        does_not_fit("model");
    if (j.contains("process"))
        model.process = ProcessModel(ProcessStructure::parse(j.at("process").at("structure").get<std::string>()),
                                     coefficients_of_json(j.at("process").at("parameters")));
    if (j.contains("estimate")) model.estimate = std::make_shared<Estimate>(estimate_of_json(j.at("estimate")));
    if (j.contains("polynomial"))
        model.polynomial = std::make_shared<PolynomialModel>(polynomial_of_json(j.at("polynomial")));
    if (j.contains("system")) model.system = std::make_shared<StateSpace>(system_of_json(j.at("system")));
    return model;
}

}  // namespace dynlab::inline scripting
