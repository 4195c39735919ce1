#include "app/workbench/estimator_forms.h"

#include <algorithm>
#include <map>

#include "base/catalog.h"
#include "numerics/estimators/method_catalog.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/lint/function_forms.h"

namespace dynlab::inline app {
namespace {

std::string text_of(const MessageId<>& description, const Reader& reader) {
    return message_text(Message(description), reader);
}

/// A text of the catalogs, which mark it for translation: marked("estimator", ...).
std::string text_of(const std::string& text, const Reader& reader) {
    const std::string_view other = reader.catalog == nullptr ? "" : reader.catalog->translation(text, "estimator");
    return other.empty() ? text : std::string(other);
}

FormField option_field(const OptionEntry& option, const Reader& reader) {
    FormField field{option.name, "text", {}, initial_text(option), text_of(option.description, reader)};
    switch (option.kind) {
        case ValueKind::kNumber:
        case ValueKind::kCount:
            field.kind = "number";
            break;
        case ValueKind::kFlag:
            field.kind = "flag";
            break;
        case ValueKind::kChoice:
            field.kind = "choice";
            for (const char* choice : option.facts.choices) field.parts.push_back('"' + std::string(choice) + '"');
            break;
        default:
            break;
    }
    return field;
}

/// What a new step begins with: two poles, no zero, no delay.
std::string initial_order(const std::string& name, TimeDomain domain) {
    if (name == "nk" && domain == TimeDomain::kDiscrete) return "1";  // of an input that is held between samples
    static const std::map<std::string, std::string> kOrders = {{"na", "2"}, {"nb", "1"}, {"nc", "1"},
                                                               {"nd", "1"}, {"nf", "2"}, {"nk", "0"},
                                                               {"np", "2"}, {"nz", "0"}, {"order", "2"}};
    const auto found = kOrders.find(name);
    return found == kOrders.end() ? "1" : found->second;
}

/// The user writes equations instead of choosing them: the initial text works with any data set of one input and one
/// output, and the user changes it.
constexpr const char* kFirstEquations =
    "idgrey(function(t, x, u, p) return {-p.k1*x[1] + p.k2*u} end, {k1 = 1, k2 = 1}, {states = 1})";

FormField argument_field(const std::string& written, TimeDomain domain) {
    if (written == "m") return {written, "text", {}, kFirstEquations, ""};
    if (written.front() == '"') return {"structure", "process", {}, "\"P2D\"", ""};
    if (written.front() != '{')
        return {written, "number", {}, written == "lambda" ? "" : initial_order(written, domain), ""};
    FormField field{"orders", "orders", {}, "", ""};
    for (const std::string& name : arguments_of("(" + written.substr(1, written.size() - 2) + ")")) {
        field.parts.push_back(name);
        field.initial += (field.initial.empty() ? "" : ", ") + initial_order(name, domain);
    }
    return field;
}

EstimatorForm form_of(const MethodEntry& method, const FunctionEntry& function, const Reader& reader) {
    const std::string summary = text_of(std::string(function.summary), reader);
    const bool reading = std::string_view(function.name).starts_with("step_");  // each has another model
    EstimatorForm form{function.name,
                       summary,
                       reading ? summary : text_of(method.structure, reader),
                       text_of(method.noise, reader),
                       method.domain == TimeDomain::kContinuous ? "continuous" : "discrete",
                       {},
                       {}};
    const std::vector<std::string> written = arguments_of(function.signature);
    for (std::size_t i = 1; i < written.size(); ++i)
        if (!is_options(written[i])) form.arguments.push_back(argument_field(written[i], method.domain));
    for (FormField& field : form.arguments)
        for (const ArgumentEntry& argument : function.arguments)
            if (field.name == argument.name) field.words = text_of(argument.description, reader);
    for (const OptionTable& table : function.options)
        for (const OptionEntry& option : table) form.options.push_back(option_field(option, reader));
    return form;
}

/// Process models and transfer functions come first, readings of a step last.
int rank_of(const EstimatorForm& form) {
    if (form.name.starts_with("step_")) return 2;
    const auto begins = [&](const char* name) {
        return !form.arguments.empty() && form.arguments.front().name == name;
    };
    return begins("process") || begins("structure") || begins("np") ? 0 : 1;
}

}  // namespace

std::vector<EstimatorForm> estimator_forms(const Reader& reader) {
    std::vector<EstimatorForm> forms;
    for (const MethodEntry& method : method_catalog())
        for (const std::string& name : method.lua_names) {
            const FunctionEntry* const function = find_function(name);
            if (function == nullptr) continue;
            const std::string signature = function->signature;
            const bool from_data = arguments_of(signature).front() == "data" && signature.ends_with("-> G");
            if (from_data) forms.push_back(form_of(method, *function, reader));
        }
    std::ranges::stable_sort(
        forms, [](const EstimatorForm& one, const EstimatorForm& other) { return rank_of(one) < rank_of(other); });
    return forms;
}

}  // namespace dynlab::inline app
