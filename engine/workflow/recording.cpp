#include "workflow/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data_io/tables/unit_text.h"
#include "documents/lua_text.h"
#include "platform/error.h"
#include "platform/spelling.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline workflow {
namespace {

constexpr int kDigitsOfInstants = 10;  ///< instants that differ look different

/// One text, or a list of several.
std::string lua_texts(const std::vector<std::string>& texts) {
    std::vector<std::string> quoted;
    for (const std::string& text : texts) quoted.push_back(lua_text(text));
    return quoted.size() == 1 ? quoted.front() : fmt::format("{{{}}}", fmt::join(quoted, ", "));
}

/// What stands behind a table to give its field: .y, or ["water level"].
std::string field_of(const std::string& name) {
    return is_variable_name(name) ? "." + name : "[" + lua_text(name) + "]";
}

/// The even spacing of the instants as one writes it, where that leads no sample astray by a hundredth of a spacing.
std::optional<double> short_spacing(const Vector& t) {
    const double gaps = static_cast<double>(t.size() - 1), spacing = (t[t.size() - 1] - t[0]) / gaps;
    const double written = std::stod(fmt::format("{:.6g}", spacing));
    return std::abs(written - spacing) * gaps < 0.01 * spacing ? std::optional(written) : std::nullopt;
}

}  // namespace

Recording::Recording(const std::string& name, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& outputs, std::optional<double> Ts, const std::string& time)
    : name_(name), inputs_(inputs), loaded_(load_data(name, ".")) {
    const Index samples = signal(inputs.front()).numbers.size();
    const auto length = [this](const std::string& signal_name) {
        return plural(signal(signal_name).numbers.size(), "{} sample", "{} samples");
    };
    for (const std::string& other : inputs)
        if (signal(other).numbers.size() != samples)
            throw EnvironmentError("{}: the input '{}' has {}, but the input '{}' has {}", name_, other, length(other),
                                   inputs.front(), samples);
    for (const std::string& other : outputs)
        if (signal(other).numbers.size() != samples)
            throw EnvironmentError("{}: the output '{}' has {}, but the input '{}' has {}", name_, other, length(other),
                                   inputs.front(), samples);
    find_sampling(Ts, time);
}

void Recording::find_sampling(std::optional<double> given, const std::string& time) {
    if (given) {
        sampling_ = fmt::format("{}", *given);
        return;
    }
    const Index samples = signal(inputs_.front()).numbers.size();
    if (time.empty()) {
        time_ = time_column(loaded_, samples);
        if (!time_) time_ = time_of_struct();
    } else {
        const Signal instants = signal(time);
        if (instants.numbers.size() != samples)
            throw EnvironmentError("{}: the time '{}' has {}, but the input '{}' has {}", name_, time,
                                   plural(instants.numbers.size(), "{} sample", "{} samples"), inputs_.front(),
                                   samples);
        const auto unit = loaded_.units.find(instants.name);
        time_ = {instants.name, unit == loaded_.units.end() ? 1 : seconds_of(unit->second).value_or(1)};
    }
    if (time_) look_at_instants();
    const auto stated = loaded_.variables.find("Ts");
    const bool states_Ts = stated != loaded_.variables.end() && std::holds_alternative<double>(stated->second.value);
    if (even_ && states_Ts && time.empty()) {
        time_.reset();
        sampling_ = "{0}.Ts";
    } else if (sampling_.empty()) {
        throw UnknownSampling(Message(
            "{} states no sampling time and has no column t or time, nor one whose header has a unit of time", name_));
    }
}

void Recording::look_at_instants() {
    const Vector t = signal(time_->name).numbers;
    if (t.size() < 2) throw EnvironmentError("{} has fewer than two samples", name_);
    const InstantSpacing spacing = spacing_of(t);
    if (spacing.disorder)
        throw EnvironmentError("{}: the time '{}' must increase, but sample {} is {} and the next {}", name_,
                               time_->name, *spacing.disorder + 1, significant(t[*spacing.disorder], kDigitsOfInstants),
                               significant(t[*spacing.disorder + 1], kDigitsOfInstants));
    even_ = spacing.even;
    sampling_ = even_ ? "({0}_t[#{0}_t] - {0}_t[1])/(#{0}_t - 1)" : "nil";
    if (const auto written = even_ ? short_spacing(t * time_->seconds) : std::nullopt) {
        sampling_ = fmt::format("{}", *written);
        time_.reset();
    }
}

std::string Recording::loading(const std::string& variable) const {
    const std::string code = fmt::format("local {} = load({})\n", variable, lua_text(name_));
    if (!time_) return code;
    const std::string factor = time_->seconds == 1 ? "" : fmt::format("*{}", time_->seconds);
    return code + fmt::format("local {0}_t = {0}{1}{2}\n", variable, signal(time_->name).access, factor);
}

/// Missing samples are filled, as no estimator takes them.
std::string Recording::samples(const std::string& variable, const std::string& name) const {
    const Signal found = signal(name);
    const std::string read = variable + found.access;
    if (!found.numbers.hasNaN()) return read;
    return fmt::format("(fillmissing({}{}))", read, even_ ? "" : fmt::format(", {{t = {}_t}}", variable));
}

std::string Recording::data(const std::string& variable, const std::vector<std::string>& outputs) const {
    const auto titles = [this](const std::vector<std::string>& names) {
        std::vector<std::string> shown;
        for (const std::string& name : names)
            shown.push_back(struct_member(name) ? name.substr(name.find('.') + 1) : name);
        return lua_texts(shown);
    };
    std::string options = fmt::format("InputName = {}, OutputName = {}{}{}", titles(inputs_), titles(outputs),
                                      units("InputUnit", inputs_), units("OutputUnit", outputs));
    if (!even_) options = fmt::format("SamplingInstants = {}_t, {}", variable, options);
    return fmt::format("iddata({}, {}, {},\n  {{{}}})", channels(variable, outputs), channels(variable, inputs_),
                       fmt::format(fmt::runtime(sampling_), variable), options);
}

Recording::Signal Recording::signal(const std::string& name) const {
    const auto header = loaded_.headers.find(name);
    const std::string& key = header == loaded_.headers.end() ? name : header->second;
    const auto found = loaded_.variables.find(key);
    const Vector* numbers = found == loaded_.variables.end() ? nullptr : std::get_if<Vector>(&found->second.value);
    if (numbers != nullptr) return {*numbers, field_of(key), key};
    if (auto column = matrix_column(name)) return *std::move(column);
    if (auto member = struct_member(name)) return *std::move(member);
    if (signals().empty())
        throw EnvironmentError(
            "{} holds no columns of numbers, so no '{}'; what it holds are tables or texts, which a script reads: "
            "load({}).NAME",
            name_, name, lua_text(name_));
    if (const auto near = nearest_word(name, signals()))
        throw EnvironmentError("{} has no column of numbers '{}' (did you mean '{}'?); there are {}", name_, name,
                               *near, listed(signals()));
    throw EnvironmentError("{} has no column of numbers '{}'; there are {}", name_, name, listed(signals()));
}

std::optional<Recording::Signal> Recording::matrix_column(const std::string& name) const {
    const std::size_t last = name.find_last_not_of("0123456789");
    constexpr std::size_t kMostDigits = 6;
    if (last == std::string::npos || last + 1 == name.size() || name.size() - last > kMostDigits) return std::nullopt;
    const auto found = loaded_.variables.find(name.substr(0, last + 1));
    const Matrix* matrix = found == loaded_.variables.end() ? nullptr : std::get_if<Matrix>(&found->second.value);
    const int column = std::stoi(name.substr(last + 1));
    if (matrix == nullptr || column < 1 || column > matrix->cols()) return std::nullopt;
    return Signal{matrix->col(column - 1), fmt::format("{}:col({})", field_of(found->first), column), name};
}

std::optional<Recording::Signal> Recording::struct_member(const std::string& name) const {
    const std::size_t dot = name.find('.');
    const auto found = loaded_.variables.find(name.substr(0, dot));
    if (dot == std::string::npos || found == loaded_.variables.end()) return std::nullopt;
    const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&found->second.value);
    if (table == nullptr) return std::nullopt;
    const auto member = (*table)->find(name.substr(dot + 1));
    if (member == (*table)->end() || !std::holds_alternative<Vector>(member->second.value)) return std::nullopt;
    return Signal{std::get<Vector>(member->second.value), field_of(found->first) + field_of(member->first), name};
}

/// The time that stands in the struct of the first input.
std::optional<TimeColumn> Recording::time_of_struct() const {
    const std::size_t dot = inputs_.front().find('.');
    if (dot == std::string::npos) return std::nullopt;
    for (const char* name : {".t", ".time"})
        if (const std::string time = inputs_.front().substr(0, dot) + name; struct_member(time))
            return TimeColumn{time};
    return std::nullopt;
}

std::vector<std::string> Recording::signals() const {
    std::vector<std::string> names;
    for (const auto& [name, variable] : loaded_.variables) {
        if (std::holds_alternative<Vector>(variable.value)) names.push_back(name);
        if (const Matrix* matrix = std::get_if<Matrix>(&variable.value))
            for (Index j = 0; j < matrix->cols(); ++j) names.push_back(fmt::format("{}{}", name, j + 1));
        if (const auto* table = std::get_if<std::shared_ptr<VariableTable>>(&variable.value))
            for (const auto& [member, value] : **table)
                if (std::holds_alternative<Vector>(value.value)) names.push_back(name + "." + member);
    }
    return names;
}

/// A vector, or a matrix of several.
std::string Recording::channels(const std::string& variable, const std::vector<std::string>& names) const {
    std::vector<std::string> columns;
    for (const std::string& name : names) columns.push_back(samples(variable, name));
    return columns.size() == 1 ? columns.front() : fmt::format("matrix{{{}}}", fmt::join(columns, ", "));
}

std::string Recording::units(const char* option, const std::vector<std::string>& names) const {
    std::vector<std::string> texts;
    for (const std::string& name : names) {
        const auto found = loaded_.units.find(signal(name).name);
        texts.push_back(found == loaded_.units.end() ? "" : found->second);
    }
    const bool known = std::any_of(texts.begin(), texts.end(), [](const std::string& text) { return !text.empty(); });
    return known ? fmt::format(", {} = {}", option, lua_texts(texts)) : "";
}

}  // namespace dynlab::inline workflow
