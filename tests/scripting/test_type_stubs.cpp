// The stubs that editors read. Oracles: Lua itself, which reads and runs them; the catalog of functions; the tags
// that LuaLS documents.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <lua.hpp>
#include <regex>

#include "documents/text_lines.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/lint/function_forms.h"
#include "scripting/lint/lint.h"
#include "scripting/lint/type_stubs.h"

namespace dynlab::test {
namespace test_type_stubs {
using testing::HasSubstr;
using testing::StartsWith;

TEST(type_stubs, define_every_function_once_and_nothing_else) {
    const std::string stubs = type_stubs();
    const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
    lua_State* const L = state.get();
    luaL_openlibs(L);
    ASSERT_EQ(luaL_dostring(L, stubs.c_str()), LUA_OK) << lua_tostring(L, -1);
    std::size_t functions = 0;
    for (const FunctionEntry& entry : catalog_of_functions()) {
        ++functions;
        const std::string gives = std::string("return type(") + entry.name + ")";
        ASSERT_EQ(luaL_dostring(L, gives.c_str()), LUA_OK) << entry.name;
        EXPECT_STREQ(lua_tostring(L, -1), "function") << entry.name;
        EXPECT_THAT(stubs, HasSubstr("\n---`" + signature_text(entry) + "`\n")) << entry.name;
        lua_settop(L, 0);
    }
    const std::regex definition("\nfunction ([\\w.]+)\\(");
    EXPECT_EQ(static_cast<std::size_t>(
                  std::distance(std::sregex_iterator(stubs.begin(), stubs.end(), definition), std::sregex_iterator())),
              functions);
}

TEST(type_stubs, use_the_documented_tags_and_name_the_parameters_in_order) {
    const std::string stubs = type_stubs();
    EXPECT_THAT(stubs, StartsWith("---@meta\n"));
    const std::regex tag("^---@(meta|class|field|param|return|overload)\\b.*");
    const std::regex parameter("---@param (\\.\\.\\.|[A-Za-z_]\\w*)([?]?) (any|table|dynlab\\.\\w+\\.options)");
    const std::regex field("---@field [A-Za-z_]\\w*\\? (any|number|integer|boolean|string) .+");
    std::string named;
    for (const std::string& line : lines_of(stubs)) {
        EXPECT_EQ(line.starts_with("---@"), std::regex_match(line, tag)) << line;
        std::smatch found;
        if (line.starts_with("---@param")) {
            ASSERT_TRUE(std::regex_match(line, found, parameter)) << line;
            named += (named.empty() ? "" : ", ") + found[1].str();
        }
        EXPECT_EQ(line.starts_with("---@field"), std::regex_match(line, field)) << line;
        if (!line.starts_with("function ")) continue;
        EXPECT_EQ(line.substr(line.find('(')), "(" + named + ") end");
        named.clear();
    }
}

TEST(type_stubs, document_options_with_the_words_of_the_page) {
    const std::string stubs = type_stubs();
    EXPECT_THAT(stubs,
                HasSubstr("---@class dynlab.srivc.options\n---@field lambda? number cutoff frequency of the filter"));
    EXPECT_THAT(stubs,
                HasSubstr("---@param data any\n---@param nb_nf_nk? table\n---@param options? "
                          "dynlab.srivc.options\n---@return any G\nfunction srivc(data, nb_nf_nk, options) end"));
}

TEST(function_forms, takes_signatures_apart) {
    EXPECT_THAT(forms_of("f(a) -> x; f(b, {c =})"), testing::ElementsAre("f(a) -> x", "f(b, {c =})"));
    EXPECT_THAT(arguments_of("f(data, {na, nb}, x, {options}) -> G"),
                testing::ElementsAre("data", "{na, nb}", "x", "{options}"));
    EXPECT_EQ(place_of_options(*find_function("srivc")), 2u);
    EXPECT_FALSE(place_of_options(*find_function("mean")));
}

TEST(function_forms, options_are_found_by_their_names) {
    const OptionTables options = find_function("srivc")->options;
    for (const char* name : {"MaxIter", "maxIter", "Lambda", "OutputWeights"})
        EXPECT_NE(find_option(options, name), nullptr) << name;
    EXPECT_EQ(find_option(options, "Lamda"), nullptr);
    EXPECT_THAT(option_names(options), testing::Not(testing::Contains("data")));
    EXPECT_THAT(option_names(find_function("load")->options),
                testing::UnorderedElementsAre("skip", "names", "delimiter", "units", "time", "time_unit", "sheet"));
}

}  // namespace test_type_stubs
}  // namespace dynlab::test
