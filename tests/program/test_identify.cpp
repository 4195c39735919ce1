// The command that makes a model and a report from a data file. Oracles: the same script run by hand, poppler, the
// README's exit codes. Models and messages: tests/unit/workflow/test_identification_script.cpp, words:
// tests/unit/cli/test_usage_message.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_identify {
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Data of 2/(s^2 + 4s + 3) (x) and (s + 2)/(s^2 + 0.8s + 4) (theta).
constexpr const char* kDataSets = R"lua(
local u, Ts = prbs(7, 8), 0.05
local t = linspace(0, (#u - 1)*Ts, #u)
local x, theta = lsim(tf({2}, {1, 4, 3}), u, Ts), lsim(tf({1, 2}, {1, 0.8, 4}), u, Ts)
save_csv("even.csv", {t = t, u = u, x = x, theta = theta}, {units = {x = "m", theta = "rad"}})
save_csv("stated.csv", {u = u, x = x}, {Ts = Ts})
)lua";

class identify : public testing::Test {
  protected:
    void SetUp() override {
        bench_.write("make.lua", kDataSets);
        const ChildResult made = bench_.dynlab({"run", "make.lua"});
        ASSERT_EQ(made.exit_code, 0) << made.error_output;
    }
    ChildResult run(std::vector<std::string> words) const {
        words.insert(words.begin(), "identify");
        return bench_.dynlab(words);
    }
    /// What is printed when it goes well.
    std::string report(const std::vector<std::string>& words) const {
        const ChildResult result = run(words);
        EXPECT_EQ(result.exit_code, 0) << result.error_output;
        EXPECT_THAT(result.error_output, IsEmpty());
        return result.output;
    }
    /// What is said when it does not.
    std::string complaint(const std::vector<std::string>& words, int exit_code) const {
        const ChildResult result = run(words);
        EXPECT_EQ(result.exit_code, exit_code) << result.output << result.error_output;
        EXPECT_FALSE(std::filesystem::exists(bench_.path("even_model.pdf")));
        return result.error_output;
    }
    Workbench bench_;
};

TEST_F(identify, report_has_two_pages_for_each_output_and_its_path_is_printed_last) {
    const std::string text = report(
        {"even.csv", "--input", "u", "--output", "x,theta", "--poles", "2", "--zeros", "1", "--validate", "even.csv"});
    EXPECT_THAT(text, AllOf(HasSubstr("s^2 + 0.8 s + 4"), HasSubstr("fit to the validation data: 100.00 %"),
                            testing::EndsWith(bench_.path("even_model.pdf").string() + "\n")));
    EXPECT_THAT(bench_.shell("pdfinfo even_model.pdf").output, testing::ContainsRegex("Pages: +4\n"));
    EXPECT_THAT(bench_.shell("pdftotext even_model.pdf -").output, AllOf(HasSubstr("From u to x"), HasSubstr("x (m)")));
}

TEST_F(identify, printed_script_gives_the_same_numbers_and_the_same_report) {
    const std::vector<std::string> words = {"even.csv", "--input", "u",    "--output",   "x",         "--poles",
                                            "2",        "--delay", "auto", "--validate", "stated.csv"};
    std::vector<std::string> for_report = words, for_script = words;
    for_report.insert(for_report.end(), {"-o", "a.md"});
    for_script.push_back("--script");
    std::string numbers = report(for_report);
    numbers.erase(numbers.rfind(bench_.path("a.md").string()));

    bench_.write("b.lua", report(for_script));
    EXPECT_THAT(bench_.dynlab({"run", "b.lua"}).output, StartsWith(numbers));
    EXPECT_EQ(bench_.dynlab({"weave", "b.lua", "-o", "b.md"}).exit_code, 0);
    EXPECT_EQ(bench_.shell("sed s/b_files/a_files/ b.md | diff a.md - && diff -r a_files b_files").output, "");
}

TEST_F(identify, what_is_printed_on_a_terminal_begins_on_a_line_of_its_own) {
    Terminal terminal(bench_, {"identify", "even.csv", "--input", "u", "--output", "x", "--poles", "2"});
    EXPECT_THAT(terminal.until("The input u"),
                AllOf(HasSubstr("running the script ..."), testing::EndsWith("\x1b[K- The input u")));
    terminal.until("even_model.pdf");
    EXPECT_EQ(terminal.wait_for_end(), 0);
}

TEST_F(identify, errors_have_their_exit_code_and_make_no_report) {
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x,teta", "--poles", "2"}, 1),
                AllOf(StartsWith("dynlab: "), HasSubstr("did you mean 'theta'?")));
    bench_.write("silent.csv", "u,x\n0,1\n1,2\n");
    EXPECT_THAT(complaint({"silent.csv", "--input", "u", "--output", "x", "--poles", "2"}, 1), HasSubstr("--Ts"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--delay", "1e6"}, 1),
                HasSubstr("delay"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "a.docx"}, 1),
                HasSubstr(".pdf"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "0"}, 2), HasSubstr("at least 1"));
}

}  // namespace test_identify
}  // namespace dynlab::test
