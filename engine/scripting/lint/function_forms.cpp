#include "scripting/lint/function_forms.h"

#include <algorithm>

#include "documents/text_lines.h"

namespace dynlab::inline scripting {

std::vector<std::string> forms_of(const std::string& signature) {
    std::vector<std::string> forms;
    for (std::size_t begin = 0; begin < signature.size();) {
        const std::size_t end = std::min(signature.find("; ", begin), signature.size());
        forms.push_back(signature.substr(begin, end - begin));
        begin = end + 2;
    }
    return forms;
}

std::vector<std::string> arguments_of(const std::string& form) {
    std::vector<std::string> arguments(1);
    int depth = 0;
    for (const char c : form.substr(form.find('(') + 1)) {
        if (c == ')' && depth == 0) break;
        depth += (c == '{') - (c == '}');
        if (c == ',' && depth == 0)
            arguments.emplace_back();
        else
            arguments.back() += c;
    }
    for (std::string& argument : arguments) argument = trimmed(argument);
    return arguments;
}

bool is_options(const std::string& argument) {
    return argument == "{options}" || argument.find('=') != std::string::npos;
}

std::optional<std::size_t> place_of_options(const FunctionEntry& function) {
    std::optional<std::size_t> first;
    for (const std::string& form : forms_of(function.signature)) {
        if (form.find('{') < form.find('(')) return 0;  // figure{options}: the table is the only argument
        const std::vector<std::string> arguments = arguments_of(form);
        const auto table = std::ranges::find_if(arguments, is_options);
        if (table == arguments.end()) continue;
        const bool varies = std::find(arguments.begin(), table, "...") != table;
        const std::size_t place = varies ? 1 : static_cast<std::size_t>(table - arguments.begin());
        first = std::min(first.value_or(place), place);
    }
    return first;
}

}  // namespace dynlab::inline scripting
