// A model from a data file without Lua. Oracles: the system that made the record, the same script run by hand, the
// README's exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_identify {
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// Records of 2/(s^2 + 4s + 3) (x, with a delay of 0.33 s in late) and (s + 2)/(s^2 + 0.8s + 4) (theta), in files that
/// state their sampling in different ways.
constexpr const char* kRecords = R"lua(
local u, Ts = prbs(7, 8), 0.05
local t = linspace(0, (#u - 1)*Ts, #u)
local x, theta = lsim(tf({2}, {1, 4, 3}), u, Ts), lsim(tf({1, 2}, {1, 0.8, 4}), u, Ts)
local late = lsim(tf({2}, {1, 4, 3}, {IODelay = 0.33}), u, Ts)
save_csv("even.csv", {t = t, u = u, x = x, theta = theta, late = late}, {units = {x = "m", theta = "rad"}})
save_csv("stated.csv", {u = u, x = x}, {Ts = Ts})
save_csv("silent.csv", {u = u, x = x})
save_mat("stated.mat", {u = u, x = x, Ts = Ts, short = u:range(1, 5), A = eye(2)})
local instants = cumsum(0.02 + 0.06*rand(800))
local w = sin(0.7*instants) + sin(1.9*instants)
save_csv("headers.csv", {["Time (ms)"] = 1000*t, ["voltage [V]"] = u, x = x
}, {columns = {"Time (ms)", "voltage [V]", "x"}})
save_csv("clock.csv", {clock = t/60, u = u, x = x}, {units = {clock = "min"}})
save_mat("matrix.mat", {y = matrix{theta, x}, u = u, Ts = Ts})
save_csv("uneven.csv", {time = instants, u = w, x = lsim(tf({2}, {1, 4, 3}), w, instants)})
)lua";

class identify : public testing::Test {
  protected:
    void SetUp() override {
        bench_.write("make.lua", kRecords);
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

TEST_F(identify, finds_the_system_in_files_that_state_their_sampling_in_any_way) {
    for (const char* file : {"even.csv", "stated.csv", "stated.mat"}) {
        const std::string text = report({file, "--input", "u", "--output", "x", "--poles", "2", "-o", "x.md"});
        EXPECT_THAT(text, AllOf(HasSubstr("s^2 + 4 s + 3"), HasSubstr("fit to the estimation data: 100.00 %"))) << file;
    }
    EXPECT_THAT(report({"silent.csv", "--input", "u", "--output", "x", "--poles", "2", "--Ts", "0.05", "-o", "x.md"}),
                HasSubstr("s^2 + 4 s + 3"));
}

TEST_F(identify, finds_the_time_by_name_unit_or_as_it_is_told) {
    const auto system = HasSubstr("s^2 + 4 s + 3");
    for (const char* input : {"voltage", "voltage [V]"})
        EXPECT_THAT(report({"headers.csv", "--input", input, "--output", "x", "--poles", "2", "-o", "x.md"}), system);
    EXPECT_THAT(report({"clock.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "x.md"}), system);
    EXPECT_THAT(report({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--time", "t", "-o", "x.md"}),
                system);
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--time", "late"}, 1),
                HasSubstr("the time 'late' must increase, but sample"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--time", "t", "--Ts", "1"}, 2),
                HasSubstr("not both"));
}

TEST_F(identify, reads_a_column_of_a_matrix) {
    EXPECT_THAT(report({"matrix.mat", "--input", "u", "--output", "y2", "--poles", "2", "-o", "x.md"}),
                HasSubstr("s^2 + 4 s + 3"));
    EXPECT_THAT(complaint({"matrix.mat", "--input", "u", "--output", "y3", "--poles", "2"}, 1), HasSubstr("u, y1, y2"));
}

// Oracle: the two systems whose outputs add up.
TEST_F(identify, takes_several_inputs) {
    bench_.write("two.lua",
                 "local u, w, Ts = prbs(8, 4), rbs(1020, 4), 0.05\n"
                 "local x = lsim(tf({2}, {1, 4, 3}), u, Ts)\nlocal z = lsim(tf({5}, {1, 1, 5}), w, Ts)\n"
                 "save_csv('two.csv', {valve = u, heat = w, x = x + z}, {Ts = Ts, units = {valve = 'V'}})\n");
    ASSERT_EQ(bench_.dynlab({"run", "two.lua"}).exit_code, 0);
    for (const std::vector<std::string>& inputs :
         {std::vector<std::string>{"--input", "valve,heat"}, {"--input", "valve", "--input", "heat"}}) {
        std::vector<std::string> words = {"two.csv", "--output", "x", "--poles", "2", "-o", "x.pdf"};
        words.insert(words.end(), inputs.begin(), inputs.end());
        EXPECT_THAT(report(words), AllOf(HasSubstr("s^2 + 4 s + 3"), HasSubstr("s^2 + s + 5"),
                                         HasSubstr("fit to the estimation data: 100.00 %")));
        EXPECT_THAT(bench_.shell("pdftotext -layout x.pdf -").output,
                    AllOf(HasSubstr("From valve, heat to x"), HasSubstr("Step and frequency response from heat")));
    }
    const std::vector<std::string> both = {"two.csv", "--input", "valve,heat", "--output", "x"};
    const auto with = [&](std::vector<std::string> options) {
        options.insert(options.begin(), both.begin(), both.end());
        return complaint(options, 2);
    };
    EXPECT_THAT(with({"--poles", "auto"}), HasSubstr("with several give the number"));
    EXPECT_THAT(with({"--poles", "2", "--input", "heat"}), HasSubstr("the input 'heat' is given twice"));
    EXPECT_THAT(complaint({"two.csv", "--input", "valve,cold", "--output", "x", "--poles", "2"}, 1),
                HasSubstr("'cold'"));
}

TEST_F(identify, fills_missing_samples_and_says_so) {
    bench_.shell("awk -F, -v OFS=, 'NR > 100 && NR % 97 == 0 { $5 = \"\" } { print }' even.csv > holes.csv");
    EXPECT_THAT(report({"holes.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "x.md"}),
                AllOf(HasSubstr("holes.csv: numbers are missing"), HasSubstr("fit to the estimation data: 9")));
}

TEST_F(identify, takes_uneven_instants_as_they_are) {
    const std::vector<std::string> words = {"uneven.csv", "--input", "u",  "--output", "x",
                                            "--poles",    "2",       "-o", "x.md"};
    EXPECT_THAT(report(words), HasSubstr("fit to the estimation data: 100.00 %"));
    std::vector<std::string> script = words;
    script.resize(script.size() - 2);
    script.push_back("--script");
    EXPECT_THAT(report(script), HasSubstr("SamplingInstants = record_t"));
}

TEST_F(identify, estimates_a_delay_or_takes_the_given_one) {
    for (const char* delay : {"auto", "0.33"}) {
        const std::string text =
            report({"even.csv", "--input", "u", "--output", "late", "--poles", "2", "--delay", delay, "-o", "l.md"});
        EXPECT_THAT(text, AllOf(HasSubstr("Delay: 0.33 s"), HasSubstr("s^2 + 4 s + 3"))) << delay;
    }
}

TEST_F(identify, finds_the_number_of_poles) {
    const std::string text = report({"even.csv", "--input", "u", "--output", "theta", "--poles", "auto", "-o", "x.md"});
    EXPECT_THAT(text, AllOf(HasSubstr("2 poles"), HasSubstr("s^2 + 0.8 s + 4")));
    EXPECT_THAT(bench_.read("x.md"), HasSubstr("Number of poles: 2, of zeros: 1,"));
    EXPECT_THAT(report({"even.csv", "--input", "u", "--output", "late", "--poles", "auto", "--zeros", "0", "--delay",
                        "auto", "-o", "x.md"}),
                AllOf(HasSubstr("Delay: 0.33 s"), HasSubstr("s^2 + 4 s + 3")));
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--delay", "0.3"}, {"--zeros", "4"}, {"--zeros", "-1"}}) {
        std::vector<std::string> words = {"even.csv", "--input", "u", "--output", "x", "--poles", "auto"};
        words.insert(words.end(), options.begin(), options.end());
        complaint(words, 2);
    }
}

// oracle: the page of advice, by the defect put in
TEST_F(identify, prints_what_stands_against_the_record) {
    bench_.shell("awk -F, -v OFS=, 'NR > 1 && $5 ~ /[0-9]/ { if ($5 > 0.2) $5 = 0.2 } { print }' even.csv > cut.csv");
    EXPECT_THAT(report({"cut.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "x.md"}), HasSubstr("\n! "));
    EXPECT_THAT(bench_.read("x.md"), Not(HasSubstr("\n! ")));
}

TEST_F(identify, report_has_two_pages_for_each_output_and_its_path_is_printed_last) {
    const std::string text = report(
        {"even.csv", "--input", "u", "--output", "x,theta", "--poles", "2", "--zeros", "1", "--validate", "even.csv"});
    EXPECT_THAT(text, AllOf(HasSubstr("s^2 + 0.8 s + 4"), HasSubstr("fit to the validation data: 100.00 %"),
                            testing::EndsWith(bench_.path("even_model.pdf").string() + "\n")));
    EXPECT_THAT(bench_.shell("pdfinfo even_model.pdf").output, testing::ContainsRegex("Pages: +4\n"));
    EXPECT_THAT(bench_.shell("pdftotext even_model.pdf -").output, AllOf(HasSubstr("From u to x"), HasSubstr("x (m)")));
    report({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "one.pdf"});
    EXPECT_THAT(bench_.shell("pdfinfo one.pdf").output, testing::ContainsRegex("Pages: +2\n"));
}

TEST_F(identify, printed_script_gives_the_same_numbers_and_the_same_report) {
    const std::vector<std::string> words = {"even.csv", "--input", "u",    "--output",   "x",         "--poles",
                                            "2",        "--delay", "auto", "--validate", "stated.csv"};
    std::vector<std::string> for_report = words, for_script = words;
    for_report.insert(for_report.end(), {"-o", "a.pdf"});
    for_script.push_back("--script");
    std::string numbers = report(for_report);
    numbers.erase(numbers.rfind(bench_.path("a.pdf").string()));

    bench_.write("b.lua", report(for_script));
    EXPECT_THAT(bench_.dynlab({"run", "b.lua"}).output, StartsWith(numbers));
    EXPECT_EQ(bench_.dynlab({"weave", "b.lua", "-o", "b.pdf"}).exit_code, 0);
    EXPECT_TRUE(bench_.read("a.pdf") == bench_.read("b.pdf"));
}

TEST_F(identify, what_is_printed_on_a_terminal_begins_on_a_line_of_its_own) {
    Terminal terminal(bench_, {"identify", "even.csv", "--input", "u", "--output", "x", "--poles", "2"});
    EXPECT_THAT(terminal.until("The input u"),
                AllOf(HasSubstr("running the script ..."), testing::EndsWith("\x1b[K- The input u")));
    terminal.until("even_model.pdf");
    EXPECT_EQ(terminal.wait_for_end(), 0);
}

TEST_F(identify, names_cannot_act_as_code) {
    const std::string name = "a\"]] .. os.exit(7) --`{b}$x.csv";
    bench_.write(name, bench_.read("stated.csv"));
    EXPECT_THAT(report({name, "--input", "u", "--output", "x", "--poles", "2", "-o", "a.pdf"}),
                HasSubstr("s^2 + 4 s + 3"));
}

TEST_F(identify, what_the_file_lacks_is_told_with_what_it_has) {
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x,teta", "--poles", "2"}, 1),
                AllOf(HasSubstr("'teta'"), HasSubstr("did you mean 'theta'?"), HasSubstr("late, t, theta, u, x")));
    EXPECT_THAT(complaint({"even.csv", "--input", "v", "--output", "x", "--poles", "2"}, 1), HasSubstr("'v'"));
    EXPECT_THAT(complaint({"silent.csv", "--input", "u", "--output", "x", "--poles", "2"}, 1),
                AllOf(HasSubstr("silent.csv"), HasSubstr("--Ts")));
    EXPECT_THAT(complaint({"stated.mat", "--input", "u", "--output", "short", "--poles", "2"}, 1),
                AllOf(HasSubstr("'short' has 5"), HasSubstr("'u' has")));
    EXPECT_THAT(complaint({"stated.mat", "--input", "A", "--output", "x", "--poles", "2"}, 1), HasSubstr("'A'"));
    EXPECT_THAT(
        complaint({"even.csv", "--input", "u", "--output", "theta", "--poles", "2", "--validate", "stated.mat"}, 1),
        HasSubstr("stated.mat has no column of numbers 'theta'"));
    EXPECT_THAT(complaint({"crane", "--input", "u", "--output", "y", "--poles", "2"}, 1),
                AllOf(HasSubstr("'u'"), HasSubstr("estimation.t, estimation.theta, estimation.u, estimation.x")));
    EXPECT_THAT(complaint({"nowhere.csv", "--input", "u", "--output", "x", "--poles", "2"}, 1),
                HasSubstr("nowhere.csv"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--validate", "none.csv"}, 1),
                HasSubstr("none.csv"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--delay", "1e6"}, 1),
                HasSubstr("delay"));
}

TEST_F(identify, wrong_options_are_wrong_usage) {
    const std::vector<std::vector<std::string>> wrong = {{},
                                                         {"--poles", "0"},
                                                         {"--poles", "two"},
                                                         {"--poles", "2", "--zeros", "3"},
                                                         {"--poles", "2", "--zeros", "-1"},
                                                         {"--poles", "2", "--delay", "soon"},
                                                         {"--poles", "2", "--delay=-1"},
                                                         {"--poles", "2", "--delay", "nan"},
                                                         {"--poles", "2", "--Ts", "0"},
                                                         {"--poles", "2", "--wrong", "1"},
                                                         {"--poles", "2", "--output", "u"},
                                                         {"--poles", "2", "-o", "a.pdf", "--script"}};
    for (const auto& options : wrong) {
        std::vector<std::string> words = {"even.csv", "--input", "u", "--output", "x"};
        words.insert(words.end(), options.begin(), options.end());
        EXPECT_THAT(complaint(words, 2), Not(IsEmpty()));
    }
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x,x", "--poles", "2"}, 2), HasSubstr("twice"));
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "--zeros", "a"}, 2),
                StartsWith("dynlab: --zeros wants a number, but 'a' was given\n"));
    EXPECT_THAT(
        complaint({"even.csv", "--input", "u", "--output", "x", "--time", "t", "--time", "u", "--poles", "2"}, 2),
        StartsWith("dynlab: --time can be given once only\n"));
    EXPECT_THAT(complaint({"even.csv", "extra", "--input", "u", "--output", "x", "--poles", "2"}, 2),
                StartsWith("dynlab: nothing is known of extra here\n"));
    EXPECT_EQ(bench_.dynlab({"mine.lua"}).error_output,
              "dynlab: a script is run by its command: dynlab run mine.lua\nRun with --help for more information.\n");
    EXPECT_THAT(complaint({"even.csv", "--input", "u", "--output", "x", "--poles", "2", "-o", "a.docx"}, 1),
                HasSubstr(".pdf"));
}

}  // namespace test_identify
}  // namespace dynlab::test
