#include "scripting/lint/type_stubs.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/reader.h"
#include "documents/text_lines.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/lint/function_forms.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

struct Parameter {
    std::string name, type;
    bool optional = false;
};

/// Options of anybody, as they are called in the stubs: "report.value" -> "dynlab.report_value.options".
std::string class_of_options(const std::string& function) {
    return "dynlab." + replaced(function, ".", "_") + ".options";
}

/// "{nb, nf, nk}" becomes the name nb_nf_nk, "x | data" x_or_data.
std::string name_of(const std::string& argument) {
    std::string name;
    bool gap = false;
    for (const char c : replaced(argument, " | ", " or ")) {
        if (!is_name_character(c)) {
            gap = !name.empty();
            continue;
        }
        if (gap) name += '_';
        gap = false;
        name += c;
    }
    return is_variable_name(name) ? name : "value_" + name;
}

std::vector<Parameter> parameters_of(const std::string& function, const std::string& form) {
    std::vector<Parameter> parameters;
    std::set<std::string> used;
    for (const std::string& argument : arguments_of(form)) {
        if (argument.empty()) continue;
        const bool first = parameters.empty();
        if (argument.find("...") != std::string::npos && !is_options(argument) && argument != "{...}") {
            parameters.push_back({"...", "any", false});
            break;
        }
        if (is_options(argument) || argument == "{...}") {
            parameters.push_back({"options", class_of_options(function), !first});
        } else {
            std::string name = name_of(argument);
            while (!used.insert(name).second) name += "_";
            parameters.push_back({name, argument.front() == '{' ? "table" : "any", !first});
        }
    }
    return parameters;
}

/// "-> y, t, sd": the names of what is given back.
std::vector<std::string> results_of(const std::string& form) {
    std::vector<std::string> names;
    const std::size_t arrow = form.find("-> ");
    if (arrow != std::string::npos)
        for (const std::string& one : arguments_of("(" + form.substr(arrow + 3) + ")")) names.push_back(name_of(one));
    return names;
}

std::string overload(const std::string& function, const std::string& form) {
    std::string parameters, results;
    for (const Parameter& one : parameters_of(function, form))
        parameters +=
            fmt::format("{}{}{}: {}", parameters.empty() ? "" : ", ", one.name, one.optional ? "?" : "", one.type);
    for (std::size_t i = 0; i < results_of(form).size(); ++i) results += results.empty() ? ": any" : ", any";
    return fmt::format("---@overload fun({}){}\n", parameters, results);
}

const char* type_of(ValueKind kind) {
    switch (kind) {
        case ValueKind::kNumber:
            return "number";
        case ValueKind::kCount:
            return "integer";
        case ValueKind::kFlag:
            return "boolean";
        case ValueKind::kChoice:
        case ValueKind::kText:
            return "string";
        default:
            return "any";
    }
}

std::string options_class(const FunctionEntry& function) {
    std::string text = fmt::format("---@class {}\n", class_of_options(function.name));
    for (const OptionTable& table : function.options)
        for (const OptionEntry& option : table)
            text += fmt::format("---@field {}? {} {}\n", option.name, type_of(option.kind),
                                message_text(Message(option.description)));
    return text;
}

std::string stub_of(const FunctionEntry& entry) {
    const std::string function = entry.name;
    const std::vector<std::string> forms = forms_of(entry.signature);
    const bool braces = forms.front().find('(') == std::string::npos;  // figure{...}
    const std::string form = braces ? replaced(replaced(forms.front(), "{", "({"), "}", "})") : forms.front();
    const std::vector<Parameter> parameters = parameters_of(function, form);
    const bool with_options =
        std::ranges::any_of(forms, [](const std::string& one) { return one.find('{') != std::string::npos; });
    std::string text = with_options ? options_class(entry) + "\n" : "";
    text += fmt::format("---{}\n---\n---`{}`\n", entry.summary, signature_text(entry));
    std::string names;
    for (const Parameter& one : parameters) {
        text += fmt::format("---@param {}{} {}\n", one.name, one.optional ? "?" : "", one.type);
        names += (names.empty() ? "" : ", ") + one.name;
    }
    for (const std::string& result : results_of(form)) text += fmt::format("---@return any {}\n", result);
    for (std::size_t i = 1; i < forms.size(); ++i) text += overload(function, forms[i]);
    return text + fmt::format("function {}({}) end\n\n", function, names);
}

}  // namespace

std::string type_stubs() {
    std::string text =
        "---@meta\n-- The functions of dynlab, for editors that complete Lua; made by `dynlab new`, never run.\n\n";
    std::set<std::string> tables;
    for (const FunctionEntry& entry : catalog_of_functions()) {
        const std::string name = entry.name;
        if (const std::size_t dot = name.find('.'); dot != std::string::npos) tables.insert(name.substr(0, dot));
    }
    for (const std::string& table : tables) text += fmt::format("{} = {{}}\n\n", table);
    text += "---Every function under one name: dynlab.tf is tf.\ndynlab = _G\n\n";
    for (const FunctionEntry& entry : catalog_of_functions()) text += stub_of(entry);
    return text;
}

}  // namespace dynlab::inline scripting
