// The tables of functions, from which signatures, help, completion, stubs and forms are made. Oracles: Lua, which reads
// the defaults; the help pages; sentences and signatures written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <lua.hpp>
#include <memory>
#include <set>

#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace dynlab::test {
namespace test_function_tables {
using testing::HasSubstr;
using testing::StartsWith;

/// Calls `check` with every option of every function and the function's name.
template <class Check>
void for_each_option(const Check& check) {
    for (const FunctionEntry& function : catalog_of_functions())
        for (const OptionTable& table : function.options)
            for (const OptionEntry& option : table) check(option, std::string(function.name) + ": " + option.name);
}

TEST(function_tables, name_every_option_once) {
    for (const FunctionEntry& function : catalog_of_functions()) {
        std::set<std::string> names;
        for (const std::string& name : option_names(function.options)) {
            EXPECT_FALSE(names.contains(other_spelling(name))) << function.name << ": " << name;
            EXPECT_TRUE(names.insert(name).second) << function.name << ": " << name;
        }
    }
}

TEST(function_tables, have_options_where_the_signature_says_so) {
    int with_options = 0;
    for (const FunctionEntry& function : catalog_of_functions()) {
        with_options += function.options.empty() ? 0 : 1;
        const bool written = std::string(function.signature).find("{options}") != std::string::npos;
        EXPECT_EQ(written, !function.options.empty()) << function.name;
    }
    EXPECT_GT(with_options, 25);
}

void expect_phrase(const MessageId<>& description, const std::string& where) {
    const std::string phrase = description.english();
    ASSERT_FALSE(phrase.empty()) << where;
    EXPECT_FALSE(phrase.ends_with('.') || phrase.ends_with(' ') || phrase.starts_with(' ')) << where;  // help adds it
}

TEST(function_tables, describe_options_and_arguments_by_a_phrase) {
    for_each_option(
        [](const OptionEntry& option, const std::string& where) { expect_phrase(option.description, where); });
    for (const FunctionEntry& function : catalog_of_functions())
        for (const ArgumentEntry& argument : function.arguments)
            expect_phrase(argument.description, std::string(function.name) + ": " + argument.name);
}

/// Lua's type of what an option of this kind is; LUA_TNONE where it may be of several.
int type_of(ValueKind kind) {
    switch (kind) {
        case ValueKind::kNumber:
        case ValueKind::kCount:
            return LUA_TNUMBER;
        case ValueKind::kFlag:
            return LUA_TBOOLEAN;
        case ValueKind::kChoice:
        case ValueKind::kText:
            return LUA_TSTRING;
        default:
            return LUA_TNONE;
    }
}

TEST(function_tables, give_defaults_that_lua_reads) {
    const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
    lua_State* const L = state.get();
    luaL_openlibs(L);
    int defaults = 0;
    for_each_option([&](const OptionEntry& option, const std::string& where) {
        const std::string initial = initial_text(option);
        if (initial.empty()) return;
        ++defaults;
        ASSERT_EQ(luaL_dostring(L, ("return " + initial).c_str()), LUA_OK) << where << " = " << initial;
        const int type = type_of(option.kind);
        EXPECT_TRUE(type == LUA_TNONE || type == lua_type(L, -1)) << where << " = " << initial;
        const double number = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : option.facts.minimum;
        EXPECT_TRUE(number >= option.facts.minimum && number <= option.facts.maximum) << where << " = " << initial;
        lua_settop(L, 0);
    });
    EXPECT_GT(defaults, 30);
}

TEST(function_tables, choose_the_default_among_the_choices) {
    for_each_option([](const OptionEntry& option, const std::string& where) {
        const std::span<const char* const> choices = option.facts.choices;
        if (option.kind == ValueKind::kChoice) {
            EXPECT_GT(choices.size(), 1u) << where;
        }
        const std::string initial = initial_text(option);
        if (choices.empty() || initial.empty()) return;
        EXPECT_TRUE(std::ranges::any_of(choices, [&](const std::string& c) { return '"' + c + '"' == initial; }))
            << where << " = " << initial;
    });
}

TEST(function_tables, show_their_signature_on_the_help_page) {
    for (const FunctionEntry& function : catalog_of_functions()) {
        const auto page = find_help_page(function.name);
        ASSERT_TRUE(page) << function.name;
        const std::string text = page_text(*page, &function), signature = signature_text(function);
        EXPECT_THAT(text, StartsWith("# " + std::string(function.name) + "\n\n")) << function.name;
        // Each form of the call is on a separate line.
        EXPECT_THAT(text, HasSubstr("\n\n## Syntax\n\n`" + signature.substr(0, signature.find("; ")))) << function.name;
    }
    EXPECT_THAT(page_text(*find_help_page("lsim"), find_function("lsim")),
                HasSubstr("\n\n## Syntax\n\n`lsim(G, u, t_or_Ts, {hold =, x0 =}) -> y`\n\n## Description\n\n"));
}

TEST(function_tables, name_up_to_four_options_in_a_signature) {
    const auto signature = [](const std::string& name) {
        const auto& all = catalog_of_functions();
        return signature_text(
            *std::ranges::find(all, name, [](const FunctionEntry& e) { return std::string(e.name); }));
    };
    EXPECT_EQ(signature("norm"), "norm(v) -> x");
    EXPECT_EQ(signature("lsim"), "lsim(G, u, t_or_Ts, {hold =, x0 =}) -> y");
    EXPECT_EQ(signature("slider"), "slider(name, x, from, to, {step =, log =, unit =, label =}) -> x");
    EXPECT_EQ(signature("histogram"), "histogram(values, {bins =, truth =, xlabel =, ...}) -> fig");
    EXPECT_EQ(signature("figure"), "figure{title =, xlabel =, ylabel =, ...} -> fig; figure(n)");
}

TEST(function_tables, refuse_an_unknown_option_with_the_nearest_name) {
    const std::string data = "local data = iddata({0, 0.1, 0.2, 0.3}, {1, 1, 1, 1}, 0.1)\n";
    for (const auto& [call, said] : std::vector<std::pair<std::string, std::string>>{
             {"srivc(data, {1, 1, 0}, {MaxIters = 3})", "unknown option 'MaxIters'; did you mean 'MaxIter'?"},
             {"compare(data, tf({1}, {1, 1}), {label = 'x'})", "unknown option 'label'; did you mean 'labels'?"},
             {"lsim(tf({1}, {1, 1}), {1, 1}, 0.1, {hodl = 'foh'})", "unknown option 'hodl'; did you mean 'hold'?"},
             {"plot({1, 2}, {1, 2}, {titel = 'x'})", "unknown option 'titel'; did you mean 'title'?"},
             {"multisine(64, {line = {1}})", "unknown option 'line'; did you mean 'lines'?"},
             {"slider('gain', 1, 0, 2, {lable = 'x'})", "unknown option 'lable'; did you mean 'label'?"},
             {"plant('crane', {sed = 3})", "unknown option 'sed'; did you mean 'seed'?"}})
        EXPECT_THAT(error_of(data + call), HasSubstr(said)) << call;
}

TEST(function_tables, refuse_values_beyond_the_bounds_and_choices) {
    for (const auto& [call, said] : std::vector<std::pair<std::string, std::string>>{
             {"multisine(64, {periods = 0})", "option 'periods' must be at least 1, but 0 was given"},
             {"plant('crane', {seed = 2^33})",
              "option 'seed' must be between 0 and 4294967295, but 8589934592 was given"},
             {"chirp(0.1, 1, 10, 0.01, {shape = 'saw'})",
              R"(option 'shape' must be one of "sine", "square", but "saw" was given)"},
             {"plot({1, 2}, {1, 2}, {legend = 'left'})",
              "option 'legend' must be one of \"automatic\", \"above\", \"right\", \"none\", \"direct\", but \"left\" "
              "was "
              "given"}})
        EXPECT_THAT(error_of(call), HasSubstr(said)) << call;
}

}  // namespace test_function_tables
}  // namespace dynlab::test
