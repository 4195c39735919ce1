#include "workflow/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// The Lua suffix that selects a table's field: .y, or ["water level"].
std::string field_of(const std::string& name) {
    return is_variable_name(name) ? "." + name : "[" + lua_text(name) + "]";
}

}  // namespace

Recording::Recording(const std::string& name, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& outputs, std::optional<double> Ts, const std::string& time,
                     const std::string& time_unit)
    : name_(name), inputs_(inputs), outputs_(outputs) {
    options_.time_unit = time_unit;
    loaded_ = load_data(name, ".", false, options_);
    const Index samples = signal(inputs.front()).numbers.size();
    const auto length = [this](const std::string& signal_name) {
        return plural(signal(signal_name).numbers.size(), "{} sample", "{} samples");
    };
    for (const std::string& other : inputs)
        if (signal(other).numbers.size() != samples)
            throw EnvironmentError(
                "{}: inputs and outputs must have the same length, but the input '{}' has {} and the input '{}' has {}",
                name_, other, length(other), inputs.front(), samples);
    for (const std::string& other : outputs)
        if (signal(other).numbers.size() != samples)
            throw EnvironmentError(
                "{}: inputs and outputs must have the same length, but the output '{}' has {} and the input '{}' has "
                "{}",
                name_, other, length(other), inputs.front(), samples);
    find_sampling(Ts, time);
}

void Recording::find_sampling(std::optional<double> given, const std::string& time) {
    if (given) {
        sampling_ = fmt::format("{}", *given);
        const auto& clock = loaded_.time.clock;
        constexpr double kClose = 0.01;
        if (clock && clock->spacing.even && std::abs(*given - clock->spacing.step) > kClose * clock->spacing.step)
            doubt_ =
                message_text(Message("The sampling time {} s was given, but according to the time column '{}' it is {} "
                                     "s. dynlab uses the given sampling time.",
                                     significant(*given, 6), clock->name, significant(clock->spacing.step, 6)));
        return;
    }
    const std::string column = time.empty() ? "" : signal(time).name;
    if (!time.empty() && !loaded_.variables.contains(column)) return take_struct_time(column);
    take_clock(column);
    if (!sampling_.empty()) return;
    if (const std::string own = time_of_struct(); !own.empty()) return take_struct_time(own);
    const auto stated = loaded_.variables.find("Ts");
    if (stated == loaded_.variables.end() || !std::holds_alternative<double>(stated->second.value))
        throw UnknownSampling(Message(
            "{} has no sampling time, no column t or time, and no column with a unit of time in its header", name_));
    sampling_ = "{0}.Ts";
}

/// The column `time`, or the one that is the time.
void Recording::take_clock(const std::string& time) {
    expect_one_clock(time);
    const Index samples = signal(inputs_.front()).numbers.size();
    ClockSearch& found = loaded_.time;
    if (!time.empty() && found.name != time) {
        if (signal(time).numbers.size() != samples)
            throw EnvironmentError("{}: the time column '{}' has {}, but the input '{}' has {}", name_, time,
                                   plural(signal(time).numbers.size(), "{} sample", "{} samples"), inputs_.front(),
                                   samples);
        options_.time = time;
        loaded_ = load_data(name_, ".", false, options_);
    } else if (found.clock && found.clock->t.size() != samples) {
        found = find_clock(loaded_, samples, options_);
    }
    if (!found.clock) {
        if (found.question && (found.likely || !time.empty() || !loaded_.variables.contains("Ts")))
            throw EnvironmentError("{}: {}", name_, *found.question);
        return;
    }
    options_.time = found.name;
    use_clock(loaded_);
    sampling_ = found.clock->spacing.even ? "{0}.Ts" : "nil";
    if (!found.clock->spacing.even) instants_ = "{0}" + field_of(found.variable);
}

/// In a table of several clocks a signal belongs to the one before it.
void Recording::expect_one_clock(const std::string& time) const {
    const std::vector<std::string>& clocks = loaded_.time.rivals;
    if (time.empty() || clocks.empty()) return;
    for (const auto* names : {&inputs_, &outputs_})
        for (const std::string& name : *names) {
            std::string own = clocks.front();
            for (const std::string& column : loaded_.columns) {
                if (std::ranges::find(clocks, column) != clocks.end()) own = column;
                if (column == signal(name).name) break;
            }
            if (own != time)
                throw EnvironmentError("{}: the signal '{}' belongs to the time column '{}', not to '{}'. {}", name_,
                                       name, own, time, *loaded_.time.question);
        }
}

void Recording::take_struct_time(const std::string& time) {
    const Vector t = signal(time).numbers;
    if (t.size() < 2) throw EnvironmentError("{} has fewer than two samples", name_);
    if (t.size() != signal(inputs_.front()).numbers.size())
        throw EnvironmentError("{}: the time column '{}' has {}, but the input '{}' has {}", name_, time,
                               plural(t.size(), "{} sample", "{} samples"), inputs_.front(),
                               signal(inputs_.front()).numbers.size());
    const InstantSpacing spacing = spacing_of(t);
    if (spacing.disorder)
        throw EnvironmentError("{}: the time column '{}' must increase, but sample {} is {} and the next sample is {}",
                               name_, time, *spacing.disorder + 1, significant(t[*spacing.disorder], kDigitsOfInstants),
                               significant(t[*spacing.disorder + 1], kDigitsOfInstants));
    if (spacing.even) {
        sampling_ = fmt::format("{}", written_step(spacing.step, t.size()));
        return;
    }
    struct_time_ = time;
    sampling_ = "nil", instants_ = "{0}_t";
}

std::string Recording::loading(const std::string& variable) const {
    std::vector<std::string> options;
    if (!options_.time.empty()) options.push_back("time = " + lua_text(options_.time));
    if (!options_.time.empty() && !options_.time_unit.empty())
        options.push_back("time_unit = " + lua_text(options_.time_unit));
    const std::string table = options.empty() ? "" : fmt::format(", {{{}}}", fmt::join(options, ", "));
    std::string code = fmt::format("local {} = load({}{})\n", variable, lua_text(name_), table);
    if (!struct_time_.empty()) code += fmt::format("local {0}_t = {0}{1}\n", variable, signal(struct_time_).access);
    if (!doubt_.empty()) code += fmt::format("print({})\n", lua_text(doubt_));
    return code + filled();
}

/// Missing samples are filled, as no estimator takes them: inputs are held, outputs interpolated. The script says so.
std::string Recording::filled() const {
    std::string code;
    const auto add_messages = [&](const std::vector<std::string>& names, bool input) {
        for (const std::string& name : names) {
            const Vector numbers = signal(name).numbers;
            const Index missing = numbers.array().isNaN().count();
            if (missing == 0) continue;
            code += fmt::format(
                "print({})\n",
                lua_text(message_text(
                    input
                        ? Message("{}: no value in {} of {} samples; missing input samples are replaced with the "
                                  "previous value.",
                                  name, missing, numbers.size())
                        : Message("{}: no value in {} of {} samples; missing output samples are linearly interpolated.",
                                  name, missing, numbers.size()))));
        }
    };
    add_messages(inputs_, true), add_messages(outputs_, false);
    return code;
}

std::string Recording::samples(const std::string& variable, const std::string& name) const {
    const Signal found = signal(name);
    const std::string read = variable + found.access;
    if (!found.numbers.hasNaN()) return read;
    std::vector<std::string> options;
    if (std::ranges::find(inputs_, name) != inputs_.end())
        options.push_back("method = \"previous\"");
    else if (!instants_.empty())
        options.push_back("t = " + fmt::format(fmt::runtime(instants_), variable));
    return fmt::format("(fillmissing({}{}))", read,
                       options.empty() ? "" : fmt::format(", {{{}}}", fmt::join(options, ", ")));
}

std::string Recording::data(const std::string& variable, const std::vector<std::string>& outputs) const {
    const auto titles = [this](const std::vector<std::string>& names) {
        std::vector<std::string> shown;
        for (const std::string& name : names)
            shown.push_back(struct_member(name) ? name.substr(name.find('.') + 1) : name);
        return lua_texts(shown);
    };
    std::string options = fmt::format("{}InputName = {}, OutputName = {}{}{}", inter_sample_, titles(inputs_),
                                      titles(outputs), units("InputUnit", inputs_), units("OutputUnit", outputs));
    if (!instants_.empty())
        options = fmt::format("SamplingInstants = {}, {}", fmt::format(fmt::runtime(instants_), variable), options);
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
            "{} contains no numeric columns, and therefore no column '{}'; a script can read its tables or strings "
            "with load({}).NAME",
            name_, name, lua_text(name_));
    if (const auto near = nearest_word(name, signals()))
        throw EnvironmentError("{} has no numeric column '{}' (did you mean '{}'?); the columns are {}", name_, name,
                               *near, listed(signals()));
    throw EnvironmentError("{} has no numeric column '{}'; the columns are {}", name_, name, listed(signals()));
}

std::optional<Recording::Signal> Recording::matrix_column(const std::string& name) const {
    const std::size_t last = name.find_last_not_of("0123456789");
    constexpr std::size_t kMaxDigits = 6;
    if (last == std::string::npos || last + 1 == name.size() || name.size() - last > kMaxDigits) return std::nullopt;
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

/// The time in the struct of the first input; empty where there is none.
std::string Recording::time_of_struct() const {
    const std::size_t dot = inputs_.front().find('.');
    if (dot == std::string::npos) return "";
    for (const char* name : {".t", ".time"})
        if (const std::string time = inputs_.front().substr(0, dot) + name; struct_member(time)) return time;
    return "";
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
