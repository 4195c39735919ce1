// What a script shows on its page, as JSON. Oracle: the JSON library's reading of values that are written down here.
#include "app/live/page_values.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/runtime.h"

namespace test_page_values {
using namespace dynlab;
using nlohmann::json;

/// The JSON of workbench.show("it", VALUE) in an interpreter of its own.
std::string shown(const std::string& value) {
    GnuplotRenderer renderer;
    PageValues page;
    Runtime runtime({}, renderer);
    runtime.add_functions(page_functions(), page);
    const RunRecord made = runtime.run_library("workbench.show('it', " + value + ")", "page");
    if (made.error) throw std::runtime_error(made.error->text());
    return page.take().at("it");
}

TEST(page_values, values_are_json) {
    EXPECT_EQ(json::parse(shown("{true, 0.1, 0/0, 'a\"b\\n', {1, {2}}, {}}")),
              json({true, 0.1, nullptr, "a\"b\n", json::array({1, json::array({2})}), json::array()}));
    EXPECT_EQ(json::parse(shown("{a = vector{1, 1/0}, b = matrix{{1, 2}, {3, 4}}, c = {d = 'e'}}")),
              json({{"a", {1, nullptr}}, {"b", {{1, 2}, {3, 4}}}, {"c", {{"d", "e"}}}}));
}

/// A page gets only the views that are new: an equal table of another interpreter is none, whatever order Lua has.
TEST(page_values, equal_tables_have_equal_texts) {
    std::string table = "{";
    for (char name = 'a'; name <= 'z'; ++name) table += std::string("name_") + name + " = 1, ";
    table += "}";
    EXPECT_EQ(shown(table), json::parse(shown(table)).dump());
}

}  // namespace test_page_values
