#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/script_header.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_percent_script {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

PercentScript parse(const std::string& source) {
    return parse_percent_script(source, "lesson.lua");
}

std::string refusal(const std::string& source) {
    try {
        parse(source);
    } catch (const DocumentError& error) {
        return error.what();
    }
    return "";
}

// Oracle of this file: the definition of the format in percent_script.h and solutions.h.

TEST(percent_script, reads_every_key_of_the_header) {
    const PercentScript script = parse(
        "-- ---\n-- title: \"Least squares: lines\"\n-- subtitle: Part 2\n-- lesson: 02\n-- template: lesson\n"
        "-- language: fr\n-- seed: 4294967295\n-- answers:\n--   G1: model\n--   slope: number\n-- ---\nx = 1\n");
    EXPECT_EQ(script.header.title, "Least squares: lines");
    EXPECT_EQ(script.header.subtitle, "Part 2");
    EXPECT_EQ(script.header.lesson, "02");
    EXPECT_EQ(script.header.template_name, "lesson");
    EXPECT_EQ(script.header.language, "fr");
    EXPECT_EQ(script.header.seed, 4294967295u);
    ASSERT_EQ(script.header.answers.size(), 2u);
    EXPECT_EQ(script.header.answers[0].name, "G1");
    EXPECT_EQ(script.header.answers[0].kind, "model");
    EXPECT_EQ(script.header.answers[1].name, "slope");
    ASSERT_EQ(script.cells.size(), 1u);
    EXPECT_EQ(script.cells[0].first_line, 12);
}

TEST(percent_script, a_script_without_header_or_markers_is_one_code_cell) {
    const PercentScript script = parse("\nlocal x = 1\nprint(x)\n\n");
    EXPECT_EQ(script.header.language, "en");
    EXPECT_EQ(script.header.seed, 1u);
    ASSERT_EQ(script.cells.size(), 1u);
    EXPECT_EQ(script.cells[0].id, "cell-1");
    EXPECT_EQ(script.cells[0].content, "local x = 1\nprint(x)\n");
    EXPECT_EQ(script.cells[0].first_line, 2);
    EXPECT_EQ(script.cells[0].last_line(), 3);
}

TEST(percent_script, splits_cells_and_keeps_their_lines) {
    const std::string source =
        "-- %% [markdown]\n-- # Title\n--\n--text\n\n-- %% id=q2 echo=false\n\nlocal x = 1\n--%% output=false\ny = 2\n";
    const PercentScript script = parse(source);
    EXPECT_EQ(script.source, source);
    ASSERT_EQ(script.cells.size(), 3u);
    EXPECT_EQ(script.cells[0].kind, Cell::Kind::kText);
    EXPECT_EQ(script.cells[0].content, "# Title\n\ntext\n");
    EXPECT_EQ(script.cells[0].first_line, 2);
    EXPECT_EQ(script.cells[1].id, "q2");
    EXPECT_EQ(script.cells[1].options.at("echo"), "false");
    EXPECT_EQ(script.cells[1].first_line, 8);
    EXPECT_EQ(script.cells[2].id, "cell-3");
    EXPECT_EQ(script.cell_at_line(3), &script.cells[0]);
    EXPECT_EQ(script.cell_at_line(8), &script.cells[1]);
    EXPECT_EQ(script.cell_at_line(1), nullptr);
}

TEST(percent_script, reads_windows_line_ends) {
    const PercentScript script = parse("-- ---\r\n-- title: A\r\n-- ---\r\n-- %% [markdown]\r\n-- text\r\n");
    EXPECT_EQ(script.header.title, "A");
    ASSERT_EQ(script.cells.size(), 1u);
    EXPECT_EQ(script.cells[0].content, "text\n");
}

TEST(percent_script, header_mistakes_name_the_line_and_the_fix) {
    EXPECT_THAT(refusal("-- ---\n-- titel: A\n-- ---\n"), StartsWith("lesson.lua:2: "));
    EXPECT_THAT(refusal("-- ---\n-- titel: A\n-- ---\n"), HasSubstr("did you mean \"title\"?"));
    EXPECT_THAT(refusal("-- ---\n-- color: A\n-- ---\n"), HasSubstr("the keys are title, subtitle"));
    EXPECT_THAT(refusal("-- ---\n-- title\n-- ---\n"), HasSubstr("\"key: value\""));
    EXPECT_THAT(refusal("-- ---\n-- title:\n-- ---\n"), HasSubstr("has no value"));
    EXPECT_THAT(refusal("-- ---\n-- title: \"A\n-- ---\n"), HasSubstr("not closed"));
    EXPECT_THAT(refusal("-- ---\n-- title: A\n-- title: B\n-- ---\n"), HasSubstr("twice"));
    EXPECT_THAT(refusal("-- ---\n-- title: A\nx = 1\n"), StartsWith("lesson.lua:3: the script header is not closed"));
    EXPECT_THAT(refusal("-- ---\n-- title: A\n"), HasSubstr("not closed"));
    EXPECT_THAT(refusal("-- ---\n-- seed: -1\n-- ---\n"), HasSubstr("0 to 4294967295"));
    EXPECT_THAT(refusal("-- ---\n-- seed: 4294967296\n-- ---\n"), HasSubstr("0 to 4294967295"));
    EXPECT_THAT(refusal("-- ---\n-- language: de\n-- ---\n"), HasSubstr("en or fr"));
    EXPECT_THAT(refusal("-- ---\n-- template: ../../x\n-- ---\n"), HasSubstr("without a folder"));
    EXPECT_THAT(refusal("-- ---\n-- answers:\n--   G1:\n-- ---\n"), HasSubstr("needs a kind"));
    EXPECT_THAT(refusal("-- ---\n--   G1: model\n-- ---\n"), HasSubstr("answers:"));
}

TEST(percent_script, all_mistakes_of_a_header_are_reported_at_once) {
    const std::string reported = refusal("-- ---\n-- titel: A\n-- seed: one\n-- language: fr\n-- lessn: 2\n-- ---\n");
    std::vector<std::string> lines = lines_of(reported);
    ASSERT_EQ(lines.size(), 3u) << reported;
    EXPECT_THAT(lines[0], StartsWith("lesson.lua:2: "));
    EXPECT_THAT(lines[1], StartsWith("lesson.lua:3: "));
    EXPECT_THAT(lines[2], StartsWith("lesson.lua:5: "));
}

TEST(percent_script, cell_mistakes_name_the_line_and_the_fix) {
    EXPECT_THAT(refusal("-- %% ecoh=false\n"), StartsWith("lesson.lua:1: "));
    EXPECT_THAT(refusal("-- %% ecoh=false\n"), HasSubstr("did you mean \"echo\"?"));
    EXPECT_THAT(refusal("-- %% echo=no\n"), HasSubstr("true or false"));
    EXPECT_THAT(refusal("-- %% plot\n"), HasSubstr("key=value"));
    EXPECT_THAT(refusal("-- %% [markdown]\n-- text\nlocal x = 1\n"), StartsWith("lesson.lua:3: "));
    EXPECT_THAT(refusal("-- %%\n-- BEGIN SOLUTION\nx = 1\n"), StartsWith("lesson.lua:2: "));
    EXPECT_THAT(refusal("-- %%\n-- BEGIN SOLUTION\nx = 1\n-- %%\n-- END SOLUTION\n"), StartsWith("lesson.lua:2: "));
    EXPECT_THAT(refusal("-- %%\n-- END SOLUTION\n"), StartsWith("lesson.lua:2: "));
    EXPECT_THAT(refusal("-- BEGIN SOLUTION\n-- BEGIN SOLUTION\n-- END SOLUTION\n"), StartsWith("lesson.lua:2: "));
}

// Field case 18: a cell that was copied with its marker.
TEST(percent_script, a_copied_cell_has_an_id_of_its_own_and_names_the_repeated_cell) {
    const PercentScript script = parse("-- %% id=a\nx=1\n-- %% id=a\ny=1\n-- %%\nz=1\n-- %% id=cell-3\nw=1\n");
    std::vector<std::string> ids, repeated;
    for (const Cell& cell : script.cells) ids.push_back(cell.id), repeated.push_back(cell.repeats);
    EXPECT_EQ(ids, (std::vector<std::string>{"a", "cell-2", "cell-3", "cell-4"}));
    EXPECT_EQ(repeated, (std::vector<std::string>{"", "a", "", "cell-3"}));
}

TEST(percent_script, the_language_may_be_written_as_in_reports) {
    EXPECT_EQ(parse("-- ---\n-- lang: fr\n-- ---\n").header.language, "fr");
    EXPECT_EQ(language_of_script("-- ---\n-- lang: fr\n-- ---\n"), "fr");
    EXPECT_THAT(refusal("-- ---\n-- lang: fr\n-- language: fr\n-- ---\n"), HasSubstr("occurs twice"));
    EXPECT_THAT(refusal("-- ---\n-- lang: de\n-- ---\n"), HasSubstr("en or fr"));
}

TEST(percent_script, a_misspelled_solution_marker_is_refused_before_it_gives_the_solution_away) {
    for (const char* marker : {"-- begin solution", "-- BEGIN SOLUTIONS", "--End Solution", "-- END SOLUTION."})
        EXPECT_THAT(refusal(std::string("x = 1\n") + marker + "\n"), StartsWith("lesson.lua:2: ")) << marker;
    EXPECT_EQ(refusal("-- begin solutions of the equation by substitution\n"), "");
}

TEST(percent_script, the_students_copy_differs_in_the_solutions_only) {
    const std::string source =
        "-- %%\r\nlocal u = 1  \n    -- BEGIN SOLUTION\n    local K = 2\n    -- STARTER: local K = 1\n    -- END "
        "SOLUTION\n"
        "print(K)\n-- %% [markdown]\n-- Why?\n--\n-- BEGIN SOLUTION\n-- Because.\n-- END SOLUTION\n\nlast line";
    EXPECT_EQ(
        without_solutions(source),
        "-- %%\r\nlocal u = 1  \n    -- YOUR CODE HERE\n    local K = 1\nprint(K)\n-- %% [markdown]\n-- Why?\n--\n"
        "-- *Your answer:*\n\nlast line");
    EXPECT_EQ(without_solutions("x = 1\r\n\r\n"), "x = 1\r\n\r\n");
    EXPECT_EQ(without_solutions("-- %%\n-- BEGIN SOLUTION\ny = 1\n-- END SOLUTION\n-- %% [markdown]\n-- BEGIN "
                                "SOLUTION\n-- Car.\n-- END SOLUTION\n",
                                "a.lua", "fr"),
              "-- %%\n-- VOTRE CODE ICI\n-- %% [markdown]\n-- *Votre réponse :*\n");
    const std::string solution = "-- BEGIN SOLUTION\ny = 1\n-- END SOLUTION\n", asked = "-- YOUR CODE HERE\n";
    EXPECT_EQ(without_solutions("-- %%\n" + solution + "\n-- %% id=b\n" + solution),
              "-- %%\n" + asked + "\n-- %% id=b\n")
        << "asked for once";
    for (const std::string between :
         {"z = 2\n", "-- %% [markdown]\n-- Why?\n-- %%\n", "-- BEGIN SOLUTION\n-- STARTER: z = 2\n-- END SOLUTION\n"}) {
        const std::string seen = between.starts_with("-- BEGIN") ? "z = 2\n" : between;
        EXPECT_EQ(without_solutions(solution + between + solution), asked + seen + asked);
    }
    EXPECT_EQ(without_solutions(""), "");
    EXPECT_THROW(without_solutions("-- STARTER: x = 1\n"), DocumentError);
}

TEST(percent_script, the_students_copy_is_in_one_language) {
    const std::string function =
        "local function say(english, french)\n    return report.language() == \"fr\" and french or english\nend\n";
    const std::string calls =
        "local axis = say(\"time (s)\", \"temps (s)\")\npredict_first(say(\"a\",\n          \"b\"), nil)\nessay(\"x\", "
        "\"y\")\n";
    EXPECT_EQ(without_solutions(function + calls, "a.lua", "en"),
              "local axis = \"time (s)\"\npredict_first(\"a\", nil)\nessay(\"x\", \"y\")\n");
    EXPECT_EQ(without_solutions(function + calls, "a.lua", "fr"),
              "local axis = \"temps (s)\"\npredict_first(\"b\", nil)\nessay(\"x\", \"y\")\n");
    EXPECT_EQ(without_solutions(calls), calls) << "another function of this name";
}

TEST(percent_script, a_file_that_is_not_there_is_named) {
    try {
        read_percent_script("/nowhere/lesson.lua");
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("/nowhere/lesson.lua"));
    }
}

TEST(percent_script, a_message_that_quotes_a_zero_byte_goes_on_behind_it) {
    using namespace std::string_literals;
    EXPECT_EQ(refusal("-- ---\n-- \0\0rest\n-- ---\n"s),
              "lesson.lua:2: script header: \"??rest\" does not have the form \"key: value\"");
}

TEST(percent_script, a_file_far_too_large_is_refused) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.lua";
    std::ofstream(file) << std::string(5u << 20, 'a');
    try {
        read_percent_script(file);
        FAIL() << "no error";
    } catch (const DocumentError& error) {
        EXPECT_THAT(
            error.what(),
            HasSubstr("a.lua: the size limit of a script or template is 4 MB, but the size of this file is 5 MB"));
    }
}

}  // namespace test_percent_script
}  // namespace dynlab
