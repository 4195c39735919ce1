#include "workflow/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "platform/error.h"
#include "platform/spelling.h"
#include "scripting/runtime/lua_text.h"

namespace dynlab::inline workflow {
namespace {

constexpr double kStepTolerance = 1e-3;  // relative; instants are often rounded when they are written

bool is_time(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name == "t" || name == "time";
}

}  // namespace

Recording::Recording(const std::string& name, const std::string& input, const std::vector<std::string>& outputs,
                     std::optional<double> Ts)
    : name_(name), input_(input), loaded_(load_data(name, ".")) {
    const Index samples = signal(input).size();
    for (const std::string& output : outputs) {
        if (signal(output).size() != samples)
            throw EnvironmentError(fmt::format("{}: the output '{}' has {} samples, but the input '{}' has {}", name_,
                                               output, signal(output).size(), input, samples));
    }
    find_sampling(Ts);
}

void Recording::find_sampling(std::optional<double> given) {
    if (given) {
        sampling_ = fmt::format("{}", *given);
        return;
    }
    for (const std::string& column : signals()) {
        if (is_time(column) && signal(column).size() == signal(input_).size()) time_ = column;
    }
    if (!time_.empty()) look_at_instants();
    const auto stated = loaded_.variables.find("Ts");
    const bool states_Ts = stated != loaded_.variables.end() && std::holds_alternative<double>(stated->second.value);
    if (even_ && states_Ts) {
        time_.clear();
        sampling_ = "{0}.Ts";
    } else if (time_.empty()) {
        throw EnvironmentError(name_ +
                               " states no sampling time and has no column t or time; give --Ts SECONDS, or write "
                               "'# Ts: 0.01' into the first line of a CSV file");
    }
}

void Recording::look_at_instants() {
    const Vector& t = signal(time_);
    if (t.size() < 2) throw EnvironmentError(name_ + " has fewer than two samples");
    const Vector steps = t.tail(t.size() - 1) - t.head(t.size() - 1);
    even_ = (steps.array() - steps.mean()).abs().maxCoeff() <= kStepTolerance * steps.mean();
    sampling_ = even_ ? "({0}_t[#{0}_t] - {0}_t[1])/(#{0}_t - 1)" : "nil";
}

std::string Recording::loading(const std::string& variable) const {
    const std::string code = fmt::format("local {} = load({})\n", variable, lua_text(name_));
    return time_.empty() ? code : code + fmt::format("local {0}_t = {0}[{1}]\n", variable, lua_text(time_));
}

std::string Recording::data(const std::string& variable, const std::string& output) const {
    std::string options = fmt::format("InputName = {}, OutputName = {}{}{}", lua_text(input_), lua_text(output),
                                      unit("InputUnit", input_), unit("OutputUnit", output));
    if (!even_) options = fmt::format("SamplingInstants = {}_t, {}", variable, options);
    return fmt::format("iddata({0}[{1}], {0}[{2}], {3},\n  {{{4}}})", variable, lua_text(output), lua_text(input_),
                       fmt::format(fmt::runtime(sampling_), variable), options);
}

const Vector& Recording::signal(const std::string& name) const {
    const auto found = loaded_.variables.find(name);
    const Vector* values = found == loaded_.variables.end() ? nullptr : std::get_if<Vector>(&found->second.value);
    if (values != nullptr) return *values;
    const auto near = nearest_word(name, signals());
    throw EnvironmentError(fmt::format("{} has no column of numbers '{}'{}; there are {}", name_, name,
                                       near ? fmt::format(" (did you mean '{}'?)", *near) : "",
                                       fmt::join(signals(), ", ")));
}

std::vector<std::string> Recording::signals() const {
    std::vector<std::string> names;
    for (const auto& [name, variable] : loaded_.variables)
        if (std::holds_alternative<Vector>(variable.value)) names.push_back(name);
    return names;
}

std::string Recording::unit(const char* option, const std::string& column) const {
    const auto found = loaded_.units.find(column);
    return found == loaded_.units.end() ? "" : fmt::format(", {} = {}", option, lua_text(found->second));
}

}  // namespace dynlab::inline workflow
