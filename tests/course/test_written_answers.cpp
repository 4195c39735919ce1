// All answers to one question on one page.
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "base/reader.h"
#include "course/answers/answers_page.h"
#include "course/answers/formulas.h"
#include "course/answers/hidden_names.h"
#include "course/answers/written_answers.h"
#include "course/course_bench.h"
#include "data_io/text_table.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/lesson_list.h"

namespace dynlab::test {
namespace test_written_answers {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

const std::string kStarter = R"(-- %% [markdown]
-- # The system
--
-- **Question 1.** Which structure does the system have, and
-- how do you know it?
--
-- *Your answer:*
--
-- **Question 2.** What is its gain?

-- %% id=gain
-- YOUR CODE HERE

-- %% [markdown]
-- *Your answer:*
--
-- ## The record
--
-- The input is a binary sequence.
)";

std::string answered(const std::string& script, const std::string& first, const std::string& second) {
    std::string text = script;
    const std::string mark = "-- *Your answer:*";
    std::size_t at = 0;
    for (const std::string& answer : {first, second}) {
        at = text.find(mark, at);
        text.replace(at, mark.size(), answer);
        at += answer.size();
    }
    return text;
}

GivenText given_of(const std::string& script) {
    GivenText given;
    given.add(text_parts_of_script(script));
    return given;
}

std::string answer_to(int number, const std::string& script) {
    return written_answer(text_parts_of_script(script), {number}, given_of(kStarter));
}

// oracle: the answers that were written into the starter
TEST(written_answers, are_what_students_write_between_questions) {
    const std::string script = answered(kStarter, "-- COE.\n--\n-- $$\n-- y = x + e\n-- $$", "-- Gain `k`{.value}.");
    EXPECT_EQ(answer_to(1, script), "COE.\n\n$$\ny = x + e\n$$");
    EXPECT_EQ(answer_to(2, script), "Gain `k`{.value}.");  // behind the code, up to the next heading
    EXPECT_EQ(answer_to(1, kStarter), "");
    EXPECT_EQ(answer_to(2, kStarter), "");
    EXPECT_EQ(answer_to(3, script), "");
    EXPECT_EQ(given_of(kStarter).questions(), (std::set<int>{1, 2}));
}

TEST(written_answers, survive_what_editors_and_students_do) {
    const std::string kept =
        answered(kStarter, "-- *Your answer:* COE, as\n--   e is white.", "-- *Votre réponse :*\n-- 2/3");
    EXPECT_EQ(answer_to(1, kept), "COE, as\n  e is white.");
    EXPECT_EQ(answer_to(2, kept), "2/3");
    // Answers directly below the question, with a heading of the student, and with other line ends.
    const std::string close = std::regex_replace(answered(kStarter, "", "-- ### My reasons\n-- The poles."),
                                                 std::regex("know it\\?\n--\n"), "know it?\n-- COE.\n");
    EXPECT_EQ(answer_to(1, close), "COE.");
    EXPECT_EQ(answer_to(2, std::regex_replace(close, std::regex("\n"), "\r\n")), "### My reasons\nThe poles.");
    // In a cell of that name, and in a report under a heading.
    EXPECT_EQ(answer_to(2, "-- %% [markdown] id=q2\n-- Two thirds.\n\n-- %% [markdown]\n-- Else.\n"), "Two thirds.");
    const auto report = text_parts_of_report(
        "---\ntitle: A\n---\n# Question 1 {#sec:q}\n\nCOE.<!-- how\nlong? -->\n\n# Question 2\n\n```\n# Question "
        "1\n```\n");
    EXPECT_EQ(written_answer(report, {1}, GivenText()), "COE.");
    EXPECT_EQ(written_answer(report, {2}, GivenText()), "```\n# Question 1\n```");
}

TEST(written_answers, of_a_section_end_with_the_next_of_its_level) {
    const auto parts = text_parts_of_report(
        "# 1 Raw data\n\nA.\n\n## Noise\n\nB.\n\n# Conclusion {#sec:end}\n\nC.\n\n# Annexe : commande\n\nD.\n");
    const auto of = [&](const char* title) { return written_answer(parts, {0, {folded_title(title)}}, GivenText()); };
    EXPECT_EQ(of("raw data"), "A.\n\n## Noise\n\nB.");
    EXPECT_EQ(of("Conclusion"), "C.");
    EXPECT_EQ(of("annexe: commande"), "D.");
    EXPECT_EQ(of("data"), "");
}

// oracle: answers that were copied, changed in one word, or in a number, a formula, a short text
TEST(written_answers, that_say_the_same_are_one_group) {
    const std::string text = "The estimate is biased because the noise enters the regressors as well as $y$ and 0.5";
    const std::vector<std::string> answers = {
        text,
        "",
        "The  estimate is biased because the\nnoise enters the regressors as well as $y$ and 0.5",
        "The estimate is wrong because the noise enters the regressors as well as $y$ and 0.5",
        "The estimate is biased because the noise enters the regressors as well as $y$ and 0.6",
        "The estimate is biased because the noise enters the regressors as well as $x$ and 0.5",
        "COE",
        "CARX",
        "COE"};
    const std::vector<AnswerGroup> groups = groups_of_answers(answers);
    ASSERT_EQ(groups.size(), 5u);
    EXPECT_THAT(groups[0].members, ElementsAre(0, 2, 3));
    EXPECT_THAT(groups[0].differences, ElementsAre("", "", "+wrong -biased"));
    EXPECT_THAT(groups[3].members, ElementsAre(6, 8));
}

// Oracle: MathML's own elements, by hand; what is no formula stays as it is written.
TEST(written_answers, formulas_are_typeset_on_the_page) {
    const std::vector<std::string> texts = {"With $a_1 = \\frac{1}{2}$ & <b>, $$ y = x^2\n$$ and `$code$`.",
                                            "Costs $3 and $4, \\$x and $ y$.",
                                            "Broken $\\frac{1$ and $\\nosuch{<script>}$.", ""};
    const TypesetFormulas formulas(texts, strongest_isolation());
    const std::string page = formulas.html(texts[0]);
    EXPECT_THAT(page,
                AllOf(HasSubstr("With <math display=\"inline\""), HasSubstr("<mfrac><mn>1</mn><mn>2</mn></mfrac>"),
                      HasSubstr("</math> &amp; &lt;b&gt;, <math display=\"block\""),
                      HasSubstr("<msup><mi>x</mi><mn>2</mn></msup>"), HasSubstr("and `$code$`.")));
    EXPECT_EQ(formulas.html(texts[1]), texts[1]);
    EXPECT_THAT(formulas.html(texts[2]), AllOf(Not(HasSubstr("<script")), HasSubstr("Broken $\\frac{1$")));
    EXPECT_EQ(formulas.html(""), "");
}

// oracle: the roster
TEST(written_answers, hide_every_name_at_every_place) {
    const std::vector<Student> roster = {{"20214711", "Ada Lovelace", "group-01", {}, "", "", ""},
                                         {"20214712", "Grace Hopper", "group-02", {}, "", "", ""}};
    const HiddenNames names(roster);
    EXPECT_EQ(names.hidden_in("Lovelace says 2. Ada Lovelace (20214711) and Lovelace agree with Grace Hopper.", {}),
              "[name] says 2. [name] ([name]) and [name] agree with [name].");
    EXPECT_EQ(names.hidden_in("Ada found the pole at 3.", {roster[0]}), "[name] found the pole at 3.");
    EXPECT_EQ(names.hidden_in("The gain is 0.667.", roster), "The gain is 0.667.");
}

/// A lesson, and submissions to it as folders.
class AnswersBench {
  public:
    AnswersBench() {
        write("99_words/lesson.lua", "-- ---\n-- title: Words\n-- lesson: 99_words\n-- ---\n\n" +
                                         std::regex_replace(kStarter, std::regex("-- \\*Your answer:\\*"),
                                                            "-- BEGIN SOLUTION\n-- The reference.\n-- END SOLUTION"));
        request_.lesson = lesson_in(path("99_words")).value();
        request_.submissions = path("in");
        request_.out = path("out");
        request_.question = "1";
        request_.program = DYNLAB_PROGRAM;
        request_.isolation = Isolation::kProcess;
    }
    fs::path path(const std::string& name) const { return folder_.path() / name; }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories(path(name).parent_path());
        write_file_atomically(path(name), text);
    }
    void submit(const std::string& name, const std::string& first) const {
        write("in/" + name + "/analysis.lua", answered(kStarter, "-- " + first, "-- 2/3"));
    }
    TextTable marks() const { return read_text_table(path("out/answers-q1.csv")); }
    std::string mark(const std::string& submission, const std::string& column) const {
        const TextTable table = marks();
        for (const auto& row : table.rows)
            if (row[*table.column("submission")] == submission) return row[*table.column(column)];
        return "no row";
    }
    AnswersRequest& request() { return request_; }

  private:
    TemporaryFolder folder_;
    AnswersRequest request_;
};

// oracle: what was submitted
TEST(written_answers, of_a_class_are_on_one_page_without_names) {
    AnswersBench bench;
    bench.submit("Ada Lovelace_4711", "COE, says Ada <b>Lovelace</b>.");
    bench.submit("Grace Hopper_4712", "CARX");
    bench.submit("Max Mustermann_4713", "CARX");
    bench.submit("Emil Post_4714", "*Your answer:*");
    bench.write("in/Kurt Gödel_4715/notes.txt", "no script");
    bench.request().roster = {{"1", "Ada Lovelace", "", {}, "", "", ""}, {"2", "Grace Hopper", "", {}, "", "", ""}};
    const AnswersOutcome outcome = collect_answers(bench.request());
    EXPECT_EQ(outcome.submissions, 5u);
    EXPECT_EQ(outcome.answers, 3u);
    EXPECT_EQ(outcome.groups, 2u);
    ASSERT_EQ(outcome.complaints.size(), 1u);
    EXPECT_THAT(message_text(outcome.complaints[0]), HasSubstr("The submission contains no analysis.lua"));
    for (const fs::path& file : {outcome.page, outcome.text}) {
        const std::string page = read_file(file);
        EXPECT_THAT(page, AllOf(HasSubstr("how do you know it?"), HasSubstr("The reference."), HasSubstr("CARX"),
                                HasSubstr("identical in 1 other submission"), HasSubstr("No answer from:")));
        for (const char* name : {"Lovelace", "Ada", "Hopper", "Mustermann", "4711", "Post"})
            EXPECT_THAT(page, Not(HasSubstr(name))) << file;
    }
    EXPECT_THAT(read_file(outcome.page), AllOf(HasSubstr("&lt;b&gt;[name]&lt;/b&gt;"), Not(HasSubstr("<b>"))));
    EXPECT_EQ(bench.mark("Ada Lovelace_4711", "check"), "q1");
    EXPECT_EQ(bench.mark("Ada Lovelace_4711", "points"), "");
    const std::string shown = bench.mark("Grace Hopper_4712", "same_as");
    EXPECT_EQ(bench.mark("Max Mustermann_4713", "same_as"), shown);
    EXPECT_THAT(read_file(outcome.text), HasSubstr("Answer " + shown + " (identical in 1 other submission)"));
}

// oracle: what the instructor filled in
TEST(written_answers, marks_and_numbers_survive_a_further_call) {
    AnswersBench bench;
    for (const char* name : {"a", "b", "c"}) bench.submit(name, std::string("COE ") + name);
    collect_answers(bench.request());
    TextTable table = bench.marks();
    for (auto& row : table.rows) row[*table.column("points")] = "2", row[*table.column("reason")] = "=2 of 3";
    write_file_atomically(bench.path("out/answers-q1.csv"), csv_text(table));
    const std::string number = bench.mark("b", "number");
    bench.submit("aa", "late");
    bench.request().check = "structure";
    collect_answers(bench.request());
    collect_answers(bench.request());
    EXPECT_EQ(bench.marks().rows.size(), 4u);
    EXPECT_EQ(bench.mark("b", "number"), number);
    EXPECT_EQ(bench.mark("b", "points"), "2");
    EXPECT_EQ(bench.mark("b", "reason"), "'=2 of 3");
    EXPECT_EQ(bench.mark("aa", "number"), "4");
    EXPECT_EQ(bench.mark("aa", "check"), "structure");
    bench.write("out/answers-q1.csv", "number,submission\n1,a\n");
    EXPECT_THROW(collect_answers(bench.request()), EnvironmentError);
    EXPECT_EQ(read_file(bench.path("out/answers-q1.csv")), "number,submission\n1,a\n");
}

TEST(written_answers, of_an_unknown_question_are_refused_with_those_that_are_known) {
    AnswersBench bench;
    bench.submit("a", "COE");
    bench.request().question = "3";
    try {
        collect_answers(bench.request());
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("99_words has no question \"3\"; the questions are 1, 2"));
    }
    bench.request().question = "Conclusion";
    EXPECT_THROW(collect_answers(bench.request()), EnvironmentError);
}

// oracle: the lessons, whose questions are numbered from 1 without a gap
TEST(written_answers, questions_of_all_lessons_are_found_and_their_solutions) {
    for (const Lesson& lesson : lessons()) {
        if (lesson.slug.starts_with("03") || lesson.slug.starts_with("05")) continue;  // answered in a report
        const std::string source = read_file(lesson.script());
        const GivenText given = given_of(source);
        ASSERT_FALSE(given.questions().empty()) << lesson.slug;
        EXPECT_EQ(*given.questions().rbegin(), static_cast<int>(given.questions().size())) << lesson.slug;
        for (const int number : given.questions())
            EXPECT_THAT(written_answer(text_parts_of_script(source), {number}, GivenText()), Not(IsEmpty()))
                << lesson.slug << " " << number;
    }
}

// oracle: the pack that a group submitted
TEST(written_answers, the_commands_read_a_course_and_a_folder) {
    CourseBench bench(2, 1);
    const Workbench& work = bench.bench();
    work.shell(
        "$DYNLAB new 04 w && cd w && sed -i '0,/^-- \\*Your answer:\\*/s//-- A COE, says Student 1./' analysis.lua");
    CourseBench::expect_done(bench.course(
        {"assignment", "talk", "--kind", "presentation", "--lesson", "04", "--first", "2026-04-01 12:00"}));
    CourseBench::expect_done(
        bench.submit_file("group-01.lua", work.read("w/analysis.lua"), "2026-03-30 10:00", {"--assignment", "talk"}));
    const ChildResult of_course = bench.course({"answers", "talk", "--question", "1", "-o", "out"});
    EXPECT_EQ(of_course.output,
              "1 submission: 1 answer, 1 of them different\nout/answers-q1.html\nout/answers-q1.csv\n")
        << of_course.error_output;
    EXPECT_THAT(work.read("out/answers-q1.md"), HasSubstr("A COE, says [name]."));
    work.shell("mkdir in && cp -r w in/group-01");
    EXPECT_EQ(work.dynlab({"answers", "in", "--lesson", "04", "--question", "1", "-o", "out2"}).exit_code, 0);
    EXPECT_THAT(work.read("out2/answers-q1.md"), HasSubstr("A COE, says Student 1."));
}

}  // namespace test_written_answers
}  // namespace dynlab::test
