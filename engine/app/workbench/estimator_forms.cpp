#include "app/workbench/estimator_forms.h"

#include <re2/re2.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/catalog.h"
#include "numerics/estimators/catalogue.h"
#include "scripting/lint/function_forms.h"

namespace dynlab::inline app {
namespace {

/// The words of an option; where they only point to another page, that page's.
std::string words_of(const std::string& option, const std::string& words) {
    static const RE2 kElsewhere(R"(as for `(\w+)`)", RE2::Latin1);
    std::string elsewhere;
    if (!RE2::PartialMatch(words, kElsewhere, &elsewhere)) return words;
    for (const auto& [name, there] : described_options(elsewhere))
        if (name == option) return words_of(option, there);
    return words;
}

FormField option_field(const std::string& name, const std::string& words) {
    static const RE2 kChoice(R"(`("\w+")`( \([^)]*the default\))?)", RE2::Latin1),
        kNumbers(
            R"(\b(iterations?|change at which|bounds?|between which|seconds|rad/s|grid|number|numbers|delays?|coefficients|bins|samples|gain|frequency)\b)",
            RE2::Latin1);
    FormField field{name, "text", {}, "", words};
    std::string choice, mark;
    for (re2::StringPiece rest = words; RE2::FindAndConsume(&rest, kChoice, &choice, &mark);) {
        field.parts.push_back(choice);
        if (!mark.empty()) field.initial = choice;
    }
    if (field.parts.size() > 1)
        field.kind = "choice";
    else if (words.starts_with("true"))
        field.kind = "flag";
    else if (words.find("{") == std::string::npos && words.find("edges") == std::string::npos &&
             RE2::PartialMatch(words, kNumbers))
        field.kind = "number";
    if (field.kind != "choice") field.parts.clear();
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

/// Equations are written, not chosen: one that works with any record of one input and one output is there to be
/// changed.
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

EstimatorForm form_of(const MethodEntry& method, const FunctionEntry& function) {
    const bool reading = std::string(function.name).starts_with("step_");  // each has another model
    EstimatorForm form{function.name,
                       function.summary,
                       reading ? function.summary : method.structure,
                       method.noise,
                       method.domain == TimeDomain::kContinuous ? "continuous" : "discrete",
                       {},
                       {}};
    std::vector<std::string> written = arguments_of(function.signature);
    std::set<std::string> known = {"data"};
    bool takes_options = false;
    for (std::size_t i = 1; i < written.size(); ++i) {
        takes_options = takes_options || is_options(written[i]);
        if (!is_options(written[i])) form.arguments.push_back(argument_field(written[i], method.domain));
    }
    const auto described = described_options(function.name);
    for (FormField& argument : form.arguments) {
        known.insert(argument.name);
        for (const auto& [name, words] : described)
            if (name == argument.name) argument.words = words;
    }
    for (const auto& [name, words] : described)
        if (takes_options && find_function(name) == nullptr && known.insert(name).second)
            form.options.push_back(option_field(name, words_of(name, words)));
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

std::vector<EstimatorForm> make_forms() {
    std::vector<EstimatorForm> forms;
    for (const MethodEntry& method : method_catalogue())
        for (const std::string& name : method.lua_names) {
            const FunctionEntry* const function = find_function(name);
            if (function == nullptr) continue;
            const std::string signature = function->signature;
            const bool from_record = arguments_of(signature).front() == "data" && signature.ends_with("-> G");
            if (from_record) forms.push_back(form_of(method, *function));
        }
    std::ranges::stable_sort(
        forms, [](const EstimatorForm& one, const EstimatorForm& other) { return rank_of(one) < rank_of(other); });
    return forms;
}

const std::vector<EstimatorForm>& english_forms() {
    static const std::vector<EstimatorForm> kForms = make_forms();
    return kForms;
}

}  // namespace

std::vector<EstimatorForm> estimator_forms(const Reader& reader) {
    std::vector<EstimatorForm> forms = english_forms();
    if (reader.catalog == nullptr) return forms;
    const auto translate = [&reader](std::string& text, const char* context) {
        const std::string_view other = reader.catalog->translation(text, context);
        if (!text.empty() && !other.empty()) text = other;
    };
    for (EstimatorForm& form : forms) {
        for (std::string* const text : {&form.summary, &form.structure, &form.noise}) translate(*text, "estimator");
        for (std::vector<FormField>* const fields : {&form.arguments, &form.options})
            for (FormField& field : *fields) translate(field.words, "");
    }
    return forms;
}

}  // namespace dynlab::inline app
