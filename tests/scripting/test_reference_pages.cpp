// Every help page: its form, its agreement with the catalogue of functions, and its example, which is run. Oracle: the
// catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "platform/temporary_folder.h"
#include "script_run.h"
#include "scripting/runtime/help.h"

namespace dynlab::test {
namespace test_reference_pages {
using testing::HasSubstr;
using testing::StartsWith;

class reference_pages : public testing::TestWithParam<HelpPage> {
  protected:
    static const FunctionEntry* entry() {
        const auto& all = catalogue_of_functions();
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
    const std::string text(GetParam().text);
    EXPECT_THAT(text, StartsWith("# " + std::string(GetParam().name) + "\n"));
    if (entry() == nullptr) {
        EXPECT_THAT(
            GetParam().name,
            testing::AnyOf("matlab", "checks", "measures", "names", "review_marks", "lua", "guide-report",
                           "guide-first-hour", "guide-contsid", "guide-lab-report", "guide-prompt", "guide-commands",
                           "guide-check", "guide-instructor", "guide-year", "guide-peer-review", "guide-add-lesson",
                           "guide-formats", "guide-security", "guide-trouble", "guide-package", "guide-notebook",
                           "guide-editors", "guide-own-course", "guide-interchange", "guide-cluster"))
            << "a page that is neither a function's nor a known subject";
        return;
    }
    EXPECT_THAT(text, HasSubstr(std::string("\n") + entry()->area + ": `" + entry()->signature + "`\n"));
    for (const char* section : {"## Arguments", "## Returns", "## Errors", "## Example"}) {
        EXPECT_THAT(text, HasSubstr(std::string("\n") + section + "\n\n"));
    }
}

TEST_P(reference_pages, example_runs_and_shows_something) {
    if (entry() == nullptr) return;
    const TemporaryFolder folder;
    RunOptions options;
    options.out_folder = options.script_folder = folder.path();
    GnuplotRenderer renderer;
    const RunRecord record = Runtime(options, renderer).run_code(example_of(GetParam().text), "example.lua");
    renderer.finish();
    ASSERT_FALSE(record.error) << record.error->message;
    const bool shows = !record.outputs.empty() || !record.figures.empty() || !record.values.empty() ||
                       !record.tables.empty() || !record.texts.empty() || !record.answers.empty() ||
                       !std::filesystem::is_empty(folder.path());
    EXPECT_TRUE(shows);
}

}  // namespace test_reference_pages
}  // namespace dynlab::test
