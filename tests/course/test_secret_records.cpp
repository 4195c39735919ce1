#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/reader.h"
#include "course/checks/check_descriptions.h"
#include "course/grading/grading_rules.h"
#include "course/grading_bench.h"
#include "data_io/values/cbor_values.h"

namespace dynlab::test {
namespace test_secret_records {
namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kDigits = "0123456789";
constexpr const char* kOfficialMat = "/data/suspension/suspension.mat";

/// Isolation levels that this machine can have.
std::vector<std::string> levels() {
    std::vector<std::string> all = {"process"};
    if (!obstacle_to(Isolation::kFull)) all.push_back("full");
    return all;
}

// oracle: numbers in a file that the script must not read, and in the data of this and the other run
TEST(secret_records, a_data_set_that_was_submitted_names_no_files_of_others) {
    for (const std::string& level : levels()) {
        GradingBench bench("--   x: number\n",
                           "check{id = 'x', rerun = 'suspension', test = function(a, b) return b.x == 42 end}\n",
                           "local d = load('suspension')\nanswer('x', 42)\n");
        const Workbench& work = bench.bench();
        work.write("secret.csv", "y\n4711\n");
        const std::pair<const char*, std::string> places[] = {
            {"of_the_instructor", work.path("secret.csv").string()},
            {"of_the_rerun", "/box/suspension" + std::string(kOfficialMat)},
            {"of_this_run", "/box/home" + std::string(kOfficialMat)},
            {"upwards", "../../../home" + std::string(kOfficialMat)},
        };
        for (const auto& [name, place] : places) {
            bench.submit_file(name, "error('it was read: ' .. load('mine').y[1])\n");
            work.write("in/" + std::string(name) + "/data/mine/SOURCE.md", "Mine.\nCourse file: " + place + "\n");
        }
        const ChildResult graded =
            work.dynlab({"grade", "in", "--lesson", "99", "--out", "out", "--isolation", level, "--no-pdf"});
        ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
        for (const auto& [name, place] : places) {
            const std::string error_reason = GradingBench::error_reason(bench.result(name));
            EXPECT_THAT(error_reason, Not(HasSubstr("dynlab read"))) << level;
            EXPECT_THAT(error_reason, HasSubstr("mine/SOURCE.md: \"Course file:\" must be followed by names of files "
                                                "in the folder of the data set, but the path \"" +
                                                place + "\" was given"))
                << level;
        }
    }
}

// oracle: digits, of which a message that gives nothing away has none, and words that only the answers hold
TEST(secret_records, messages_quote_neither_hidden_records_nor_answers_of_reruns) {
    const std::string computes = "local d = load('suspension')\nlocal text = string.format('sample %.4f', d.y[9])\n";
    const std::string solution = computes + "answer('t', {right = true})\n";
    GradingBench bench(
        "--   t: table\n",
        "check{id = 'error', rerun = 'suspension', test = function(a, b)\n"
        "  return b.t.right or near(dcgain(b.t.text), 1) end}\n"
        "check{id = 'joined', rerun = 'suspension', test = function(a, b)\n"
        "  if b.t.right then return true end return false, 'This is no model: ' .. b.t.text end}\n"
        "check{id = 'returned', rerun = 'suspension', test = function(a, b) return b.t.right or b.t.judgement end}\n"
        "check{id = 'hidden', test = function(a)\n"
        "  return a.t.right or near(dcgain('sample ' .. hidden('suspension').y[9]), 1) end}\n"
        "check{id = 'missing', rerun = 'suspension', test = function(a, b) return b.t.right or b.u end}\n",
        solution);
    bench.submit_file("quoting", computes + "answer('t', {text = text, judgement = {share = 0, message = text}})\n");
    const ChildResult graded = bench.grade();
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    const auto result = bench.result("quoting");
    EXPECT_EQ(GradingBench::score(result), 0);
    const auto& checks = result.at("extra_data").at("dynlab").at("checks");
    ASSERT_EQ(checks.size(), 5u);
    for (const auto& check : checks) {
        const std::string message = check.at("message");
        EXPECT_FALSE(message.empty()) << check;
        EXPECT_EQ(message.find_first_of(kDigits), std::string::npos) << check;
    }
    EXPECT_EQ(checks[4].at("message"), "The answer \"u\" was not submitted.");
    const Workbench& work = bench.bench();
    EXPECT_EQ(work.shell("grep -rl 'sample' out/results out/summary.md out/gradebook.csv").output, "");
    // The instructor reads what it was.
    const std::string log = work.read("out/logs/quoting/log.txt");
    EXPECT_THAT(log, HasSubstr(" s in the sandbox"));
    for (const char* where : {"error: checks.lua:2", "hidden: checks.lua:7"})
        EXPECT_THAT(log, HasSubstr("check " + std::string(where) +
                                   ": dcgain: argument 1 (G) must be a model, but the string \"sample "));
}

// oracle: the rule that what is secret is known to be so
TEST(secret_records, are_asked_for_inside_the_test_that_looks_at_them) {
    for (const char* use : {"hidden('suspension')", "truth('suspension')"}) {
        GradingBench bench("--   x: number\n",
                           "local secret = " + std::string(use) + "\ncheck{id = 'x', test = function() end}\n", "");
        bench.submit_file("a", "answer('x', 42)\n");
        const ChildResult graded = bench.grade();
        EXPECT_EQ(graded.exit_code, 1);
        EXPECT_THAT(graded.error_output, HasSubstr("inside the test")) << use;
    }
}

/// Grading by a program that reports the content of its sandbox and leaves a file there.
class secret_records_box : public ::testing::Test {
  protected:
    /// Bytes as the shell's printf takes them.
    static std::string octal(const std::string& bytes) {
        std::string text;
        for (const char c : bytes) text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
        return text;
    }

    /// Lists one check, fails to try it, and returns for a run an error that lists the content of the sandbox.
    static std::string program() {
        CheckResults listed;
        listed.checks.resize(1);
        listed.checks[0].check.id = listed.checks[0].check.about = "x";
        listed.checks[0].check.rerun = "suspension";
        GradedRun run;
        run.error = Message::verbatim("?");
        const std::string bytes = cbor_of(run);
        // The place of its text: two bytes, the length of the text and "?".
        const std::size_t error = bytes.find("text", bytes.find("error")) + 4;
        return "#!/bin/sh\n"
               "job=$(tr -d '\\000')\n"
               "case $2 in\n"
               "checks)\n"
               "  case $job in *variants*)\n"
               "    echo 'sample 30.78' >&2\n"
               "    exit 1 ;;\n"
               "  esac\n"
               "  printf '" +
               octal(cbor_of(listed)) +
               "' ;;\n"
               "run)\n"
               "  left=$(ls -A \"$TMPDIR\" | tr '\\n' ' ')\n"
               "  records=$(find /box -name 'suspension.*' | sort | while read -r file; do\n"
               "    echo \"$file $(cksum < \"$file\")\"; done | tr '\\n' ';')\n"
               "  touch \"$TMPDIR/was_here\"\n"
               "  text=\"records: $records left: $left.\"\n"
               "  printf '" +
               octal(bytes.substr(0, error)) +
               "\\171'\n"  // a text with its length in two bytes
               "  printf \"\\\\$(printf %03o $((${#text} / 256)))\\\\$(printf %03o $((${#text} % 256)))\"\n"
               "  printf %s \"$text\"\n"
               "  printf '" +
               octal(bytes.substr(error + 2)) +
               "' ;;\n"
               "esac\n";
    }

    Grade graded(Isolation level) {
        const Workbench& work = bench_.bench();
        work.write("dynlab-boxed", program());
        work.shell("chmod +x dynlab-boxed && cp dynlab-boxed dynlab");
        bench_.submit_file("a", "answer('x', 42)\n");
        GradingSetup setup;
        setup.lesson = {"99_small", work.path("home/lessons/99_small")};
        setup.secret = "chosen by a test";
        setup.isolation = level;
        setup.program = work.path("dynlab");
        return GradingRules(setup).grade("a", work.path("in/a"));
    }
    std::string sum_of(const std::string& name) {
        const std::string file = std::string(DYNLAB_SOURCE_DIR) + "/data/suspension/" + name;
        const std::string sum = bench_.bench().shell("cksum < '" + file + "'").output;
        return "/box/home/data/suspension/" + name + " " + sum.substr(0, sum.find('\n')) + ";";
    }

    GradingBench bench_{"--   x: number\n", "", ""};
};

// oracle: the programs inside; the official files' checksums
TEST_F(secret_records_box, holds_the_data_of_its_run_alone) {
    if (const auto obstacle = obstacle_to(Isolation::kFull)) GTEST_SKIP() << message_text(*obstacle);
    const Grade grade = graded(Isolation::kFull);
    EXPECT_EQ(message_text(grade.error_reason),
              "records: " + sum_of("suspension.csv") + sum_of("suspension.mat") + " left: .");
    EXPECT_THAT(grade.log, HasSubstr("  records: /box/home/data/suspension/suspension.mat "));
    EXPECT_THAT(grade.log, Not(HasSubstr("/box/suspension")));
}

TEST_F(secret_records_box, begins_with_an_empty_scratch_folder) {
    for (const std::string& level : levels()) {
        const Grade grade = graded(level == "full" ? Isolation::kFull : Isolation::kProcess);
        EXPECT_THAT(message_text(grade.error_reason), HasSubstr(" left: ."));
        EXPECT_THAT(grade.log, HasSubstr("run suspension: ")) << level;
        EXPECT_THAT(grade.log, Not(HasSubstr("was_here"))) << level;
    }
}

// oracle: digits, of which a message that gives nothing away has none
TEST_F(secret_records_box, whose_checks_fail_altogether_quotes_nothing) {
    const Grade grade = graded(Isolation::kProcess);
    ASSERT_EQ(grade.checks.size(), 1u);
    EXPECT_FALSE(grade.checks[0].graded);
    EXPECT_FALSE(grade.checks[0].message.empty());
    const std::string said = message_text(grade.checks[0].message);
    EXPECT_EQ(said.find_first_of(kDigits), std::string::npos) << said;
    EXPECT_THAT(grade.log, HasSubstr("check x: the run ended with code 1: sample 30.78"));
}

}  // namespace test_secret_records
}  // namespace dynlab::test
