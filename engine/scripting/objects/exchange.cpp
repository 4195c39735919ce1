#include "scripting/objects/exchange.h"

#include <cmath>

namespace dynlab::inline scripting {
namespace {

Variable row(const Vector& values) {
    return {Matrix(values.transpose())};
}

Variable list_of_texts(const std::vector<std::string>& texts) {
    auto list = std::make_shared<VariableList>();
    for (const std::string& text : texts) list->push_back({text});
    return {list};
}

Variable structs(std::vector<VariableTable> all) {
    auto list = std::make_shared<VariableList>();
    for (VariableTable& one : all) list->push_back({std::make_shared<VariableTable>(std::move(one))});
    return {list};
}

/// num of a discrete model in ascending powers of q^-1: as long as den, and as late as the delay says.
Vector in_backward_shifts(const TransferFunction& G) {
    const auto late = static_cast<Index>(std::lround(G.delay() / G.Ts()));
    Vector B = Vector::Zero(late + std::max(G.den().size(), G.num().size()));
    B.tail(G.num().size()) = G.num();
    return B;
}

void add_transfer_function(const TransferFunction& G, VariableTable& fields) {
    fields["num"] = row(G.num());
    fields["den"] = row(G.den());
    fields["Ts"] = {G.Ts()};
    fields["IODelay"] = {G.delay()};
}

/// The polynomials of y = B/F u + C/D e, or with A where the model is A y = B u + e.
void add_polynomials(const Model& model, const TransferFunction& G, VariableTable& fields) {
    const Vector one = Vector::Ones(1);
    const bool equation_error = model.estimate && model.estimate->carx;
    fields["A"] = row(equation_error ? G.den() : one);
    fields["B"] = row(G.continuous() ? G.num() : in_backward_shifts(G));
    fields["C"] = fields["D"] = row(one);
    fields["F"] = row(equation_error ? one : G.den());
}

void add_estimate(const Estimate& estimate, VariableTable& fields) {
    fields["method"] = {estimate.method};
    fields["param"] = {estimate.theta};
    if (estimate.std().size() > 0) fields["std"] = {estimate.std()};
    if (estimate.covariance().size() > 0) fields["covariance"] = {estimate.covariance()};
    fields["names"] = list_of_texts(estimate.names);
    for (const auto& [name, field] : {std::pair("noise_variance", "NoiseVariance"), {"fit_percent", "fit_percent"}})
        if (const std::optional<double> value = estimate.report().number(name)) fields[field] = {*value};
}

Variable signals(const Matrix& columns) {
    if (columns.cols() > 1) return {columns};
    return {Vector(columns.cols() == 0 ? Vector() : Vector(columns.col(0)))};
}

VariableTable struct_of_experiment(const IdData& data, std::size_t k) {
    const Experiment& one = data.experiments[k];
    VariableTable fields{{"y", signals(one.y)}, {"u", signals(one.u)}, {"t", {data.time(k)}}, {"Ts", {data.Ts}}};
    if (one.r.cols() > 0) fields["r"] = signals(one.r);
    return fields;
}

}  // namespace

VariableTable struct_of(const Model& model) {
    VariableTable fields;
    if (model.single_channel()) {
        fields["kind"] = {std::string(model.polynomial ? "idpoly" : "tf")};
        add_transfer_function(model.G, fields);
        add_polynomials(model, model.G, fields);
        if (model.polynomial) {
            const PolynomialModel& own = *model.polynomial;
            for (const auto& [name, values] :
                 {std::pair("A", &own.A), {"B", &own.B.front()}, {"C", &own.C}, {"D", &own.D}, {"F", &own.F.front()}})
                fields[name] = row(*values);
        }
    } else {
        std::vector<VariableTable> channels;
        for (const TransferFunction& G : channels_of(model)) {
            add_transfer_function(G, channels.emplace_back());
            add_polynomials(model, G, channels.back());
        }
        fields["kind"] = {std::string("channels")};
        fields["inputs"] = {static_cast<double>(model.inputs())};
        fields["outputs"] = {static_cast<double>(model.outputs)};
        fields["channels"] = structs(std::move(channels));
    }
    if (model.estimate) add_estimate(*model.estimate, fields);
    return fields;
}

VariableTable struct_of(const StateSpace& system) {
    return {{"kind", {std::string("ss")}},
            {"A", {system.A}},
            {"B", {system.B}},
            {"C", {system.C}},
            {"D", {system.D}},
            {"Ts", {system.Ts}}};
}

VariableTable struct_of(const IdData& data) {
    VariableTable fields;
    if (data.experiments.size() == 1) {
        fields = struct_of_experiment(data, 0);
    } else {
        std::vector<VariableTable> experiments;
        for (std::size_t k = 0; k < data.experiments.size(); ++k) experiments.push_back(struct_of_experiment(data, k));
        fields["experiments"] = structs(std::move(experiments));
        fields["Ts"] = {data.Ts};
    }
    fields["kind"] = {std::string("iddata")};
    fields["InterSample"] = {std::string(data.hold == Hold::kZoh ? "zoh" : "foh")};
    for (const auto& [name, texts] : {std::pair("InputName", &data.input_names),
                                      {"OutputName", &data.output_names},
                                      {"InputUnit", &data.input_units},
                                      {"OutputUnit", &data.output_units}})
        if (!texts->empty()) fields[name] = list_of_texts(*texts);
    return fields;
}

}  // namespace dynlab::inline scripting
