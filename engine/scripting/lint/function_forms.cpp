#include "scripting/lint/function_forms.h"

#include <re2/re2.h>

#include <algorithm>
#include <set>

#include "documents/text_lines.h"
#include "scripting/conversions/option_words.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/runtime/help.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

/// The items of a page's list of arguments, each in one line.
std::vector<std::string> argument_items(std::string_view page) {
    std::vector<std::string> items;
    bool inside = false;
    for (const std::string& line : lines_of(page)) {
        if (line.starts_with("## ")) inside = line == "## Arguments";
        if (!inside) continue;
        if (line.starts_with("- "))
            items.push_back(line.substr(2));
        else if (!items.empty() && !is_blank(line))
            items.back() += " " + trimmed(line);
    }
    return items;
}

/// "`MaxIter`, `Tol`: words; `NumTd`: words" as names with their words.
void add_described(const std::string& item, std::vector<std::pair<std::string, std::string>>& described) {
    static const RE2 kNames(R"((.*?)(?:^|[;.] |\bor )((?:`\w+`(?:, | and )?)+):)", RE2::Latin1),
        kName(R"(`(\w+)`)", RE2::Latin1);
    re2::StringPiece rest = item, before, names, next;
    for (bool more = RE2::FindAndConsume(&rest, kNames, &before, &names); more; names = next) {
        re2::StringPiece words = rest;
        more = RE2::FindAndConsume(&rest, kNames, &before, &next);
        if (more) words = before;
        std::string name;
        while (RE2::FindAndConsume(&names, kName, &name)) described.emplace_back(name, trimmed(words));
    }
}

void add_names(std::string_view code, std::set<std::string>& names) {
    for (const LuaToken& token : lua_tokens(code))
        if (token.kind == LuaToken::Kind::kName) names.emplace(token.text);
}

/// Every name in code on a page: between backticks and in its examples.
void add_mentioned(std::string_view page, std::set<std::string>& names) {
    bool code = false;
    for (std::size_t begin = 0; begin < page.size(); code = !code) {
        const std::size_t end = std::min(page.find('`', begin), page.size());
        if (code) add_names(page.substr(begin, end - begin), names);
        begin = end + 1;
    }
}

/// The names before = in "{hold = \"zoh\", x0 =}".
void add_written(const std::string& table, std::vector<std::string>& names) {
    const std::vector<LuaToken> tokens = lua_tokens(table);
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i].kind == LuaToken::Kind::kName && tokens[i + 1].is("=")) names.emplace_back(tokens[i].text);
}

}  // namespace

const FunctionEntry* find_function(const std::string& name) {
    for (const FunctionEntry& entry : catalogue_of_functions())
        if (name == entry.name) return &entry;
    return nullptr;
}

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
    return argument.find('=') != std::string::npos;
}

std::vector<std::pair<std::string, std::string>> described_options(const std::string& function) {
    std::vector<std::pair<std::string, std::string>> described;
    if (const auto page = find_help_page(function))
        for (const std::string& item : argument_items(page->text)) add_described(item, described);
    return described;
}

bool FunctionOptions::knows(const std::string& name) const {
    const auto is_mentioned = [this](const std::string& word) { return std::ranges::binary_search(mentioned, word); };
    return is_mentioned(name) || is_mentioned(with_other_case(name));
}

std::optional<FunctionOptions> options_of_function(const std::string& function) {
    const FunctionEntry* const entry = find_function(function);
    const auto page = find_help_page(function);
    if (entry == nullptr || !page) return std::nullopt;
    std::optional<FunctionOptions> options;
    std::set<std::string> positional;
    for (const std::string& form : forms_of(entry->signature)) {
        const std::vector<std::string> arguments = arguments_of(form);
        for (const std::string& argument : arguments)
            if (!is_options(argument)) add_names(argument, positional);
        const auto table = std::ranges::find_if(arguments, is_options);
        if (table == arguments.end()) continue;
        const bool varies = std::find(arguments.begin(), table, "...") != table;
        const std::size_t place = varies ? 1 : static_cast<std::size_t>(table - arguments.begin());
        if (!options) options.emplace().first_place = place;
        options->first_place = std::min(options->first_place, place);
        add_written(*table, options->names);
    }
    if (!options) return std::nullopt;
    std::set<std::string> mentioned(options->names.begin(), options->names.end());
    add_mentioned(page->text, mentioned);
    for (const std::string& item : argument_items(page->text)) {
        std::set<std::string> here;
        add_mentioned(item, here);
        for (const std::string& other : here)
            if (const auto there = find_function(other) ? find_help_page(other) : std::nullopt)
                add_mentioned(there->text, mentioned);
    }
    std::set<std::string> known(options->names.begin(), options->names.end());
    for (const auto& [name, words] : described_options(function))
        if (find_function(name) == nullptr && !positional.contains(name) && known.insert(name).second)
            options->names.push_back(name);
    options->mentioned.assign(mentioned.begin(), mentioned.end());
    return options;
}

}  // namespace dynlab::inline scripting
