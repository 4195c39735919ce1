// Every help page: its form, its agreement with the catalog of functions, and its example, which is run. Oracle: the
// catalog.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace dynlab::test {
namespace test_reference_pages {
using testing::HasSubstr;
using testing::StartsWith;

class reference_pages : public testing::TestWithParam<HelpPage> {
  protected:
    static const FunctionEntry* entry() {
        const auto& all = catalog_of_functions();
        const auto found =
            std::find_if(all.begin(), all.end(), [](const FunctionEntry& e) { return e.name == GetParam().name; });
        return found == all.end() ? nullptr : &*found;
    }
};

std::string test_name(const testing::TestParamInfo<HelpPage>& page) {
    std::string name(page.param.name);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(all, reference_pages, testing::ValuesIn(help_pages().begin(), help_pages().end()), test_name);

std::string example_of(std::string_view page) {
    constexpr std::string_view kBegin = "```lua\n";
    const auto begin = page.find(kBegin);
    if (begin == std::string_view::npos) return {};
    const auto code = page.substr(begin + kBegin.size());
    return std::string(code.substr(0, code.find("\n```")));
}

TEST_P(reference_pages, has_the_form_of_a_page) {
    const std::string text = page_text(GetParam(), entry());
    EXPECT_THAT(text, StartsWith("# " + std::string(GetParam().name) + "\n"));
    if (entry() == nullptr) {
        EXPECT_THAT(
            GetParam().name,
            testing::AnyOf("matlab", "checks", "measures", "names", "review_marks", "lua", "guide-report",
                           "guide-first-hour", "guide-contsid", "guide-lab-report", "guide-prompt", "guide-commands",
                           "guide-check", "guide-instructor", "guide-year", "guide-peer-review", "guide-add-lesson",
                           "guide-formats", "guide-security", "guide-trouble", "guide-package", "guide-notebook",
                           "guide-editors", "guide-own-course", "guide-interchange", "guide-cluster", "guide-lessons",
                           "guide-site"))
            << "a page that is neither a function's nor a known subject";
        return;
    }
    std::size_t last = 0;
    for (const char* part : {"Syntax", "Description", "Input Arguments", "Output Arguments", "Errors", "Examples",
                             "Algorithms", "References", "See Also"}) {
        const bool optional = std::string_view(part) == "Algorithms" || std::string_view(part) == "References";
        const std::size_t at = text.find(std::string("\n## ") + part + "\n\n");
        if (at == std::string::npos && optional) continue;
        ASSERT_NE(at, std::string::npos) << part;
        EXPECT_GT(at, last) << part << " is not in its place";
        last = at;
    }
    static const std::regex named("`([^`]+)`");
    int related = 0;
    for (std::sregex_iterator it(text.begin() + static_cast<long>(last), text.end(), named), end; it != end; ++it) {
        const std::string name = (*it)[1];
        EXPECT_TRUE(find_help_page(name) && name != GetParam().name) << name;
        ++related;
    }
    EXPECT_GT(related, 0);
}

TEST_P(reference_pages, example_runs_and_shows_something) {
    if (entry() == nullptr) return;
    const TemporaryFolder folder;
    RunOptions options;
    options.out_folder = options.script_folder = folder.path();
    GnuplotRenderer renderer;
    const RunRecord record = Runtime(options, renderer).run_code(example_of(GetParam().text), "example.lua");
    renderer.finish();
    ASSERT_FALSE(record.error) << record.error->text();
    const bool shows = !record.outputs.empty() || !record.figures.empty() || !record.values.empty() ||
                       !record.tables.empty() || !record.texts.empty() || !record.answers.empty() ||
                       !std::filesystem::is_empty(folder.path());
    EXPECT_TRUE(shows);
}

/// Functions, by their signature, whose first argument is a model: "pole(G) -> ...".
std::vector<std::string> functions_of_models() {
    std::vector<std::string> names;
    for (const FunctionEntry& function : catalog_of_functions()) {
        const std::string signature(function.signature), name(function.name);
        for (const char* model : {"(G)", "(G,", "(G1", "(Gd", "(model"})
            if (signature.compare(0, name.size(), name) == 0 && signature.find(model, name.size()) == name.size())
                names.push_back(name);
    }
    return names;
}

TEST(reference_pages_of_models, state_where_several_inputs_are_refused) {  // oracle: what the functions say to them
    std::string code =
        "local u = {rbs(400, 2), rbs(400, 3)}\n"
        "local data = iddata(lsim(tf({1}, {1, 2}), u[1], 0.1) + lsim(tf({1}, {1, 3}), u[2], 0.1) + 0.1*randn(400),\n"
        "                    matrix{u[1], u[2]}, 0.1)\n"
        "local G = oe(data, {{1, 1}, {1, 1}, {1, 1}})\n"
        "local calls = {{G}, {G, G}, {G, 1}, {G, u[1]}, {G, u[1], 0.1}, {G, data}, {G, G, u[1], 0.1}, {G, data, "
        "'a1'}}\n"
        "local function refuses(f)\n"
        "  for _, arguments in ipairs(calls) do\n"
        "    local ok, message = pcall(f, table.unpack(arguments))\n"
        "    if not ok and tostring(message):find('one input and one output', 1, true) then return true end\n"
        "  end\n"
        "end\n";
    for (const std::string& name : functions_of_models())
        code += "if refuses(" + name + ") then print('refuses: " + name + ";') end\n";
    const std::string reported = printed(code);
    int refusing = 0;
    for (const HelpPage& page : help_pages()) {
        if (reported.find("refuses: " + std::string(page.name) + ";") == std::string::npos) continue;
        ++refusing;
        EXPECT_THAT(page_text(page, find_function(std::string(page.name))), HasSubstr("several inputs")) << page.name;
    }
    EXPECT_GT(refusing, 15) << reported;
}

}  // namespace test_reference_pages
}  // namespace dynlab::test
