// The texts that French groups read about their work. Oracles: sentences written here by hand; the sentences in the
// lessons' checks; the English words that no French sentence contains.
#include "course/issues/lesson_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "course/grading/feedback.h"
#include "course/grading/folder_check.h"
#include "documents/text_lines.h"
#include "french_text.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "support/environment_variable.h"
#include "support/program.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::test {
namespace test_lesson_reader {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// The texts of a checks.lua that students read.
std::set<std::string> texts_of_checks(const std::string& checks) {
    std::set<std::string> reported;
    const std::regex text(R"re((?:\b(?:say|hint|about|message)\s*=\s*|judge\()"((?:[^"\\]|\\.)*)")re");
    for (std::sregex_iterator at(checks.begin(), checks.end(), text), end; at != end; ++at)
        reported.insert(replaced((*at)[1].str(), "\\\"", "\""));
    return reported;
}

TEST(lesson_catalogs, have_all_messages_of_lesson_checks_and_nothing_else) {
    int lessons_seen = 0;
    for (const Lesson& lesson : lessons()) {
        if (!fs::exists(lesson.folder / "checks.lua")) continue;
        ++lessons_seen;
        const std::set<std::string> reported = texts_of_checks(read_text(lesson.folder / "checks.lua"));
        EXPECT_GT(reported.size(), 20u);
        const Catalog authors(read_text(lesson.checks_in("fr")));
        for (const std::string& sentence : reported) EXPECT_NE(authors.translation(sentence), "") << sentence;
        EXPECT_EQ(authors.size(), reported.size()) << lesson.slug << ": a translation of what no check tells";
    }
    EXPECT_EQ(lessons_seen, 8);
}

class lesson_reader : public testing::Test {
  protected:
    void add_lesson(const std::string& slug, const std::string& words) const {
        bench_.write("lessons/" + slug + "/lesson.lua", "-- ---\n-- title: A lesson\n-- ---\n\nprint(1)\n");
        bench_.write("lessons/" + slug + "/checks.fr.po", words);
    }
    Workbench bench_;
    EnvironmentVariable lessons_{"DYNLAB_LESSONS", bench_.path("lessons")};
};

TEST_F(lesson_reader, knows_what_authors_wrote_and_what_the_program_says) {
    add_lesson("91_first", "msgid \"quuxes abound here\"\nmsgstr \"c'est deux\"\n");
    const Message message = Message("The report cannot be built from a clean copy of the folder: {}",
                                    Message::verbatim("quuxes abound here"));
    EXPECT_EQ(LessonReader("fr", "91_first").text(message),
              "Le rapport ne peut pas être construit à partir d'une copie propre du dossier\u202F: c'est deux");
    EXPECT_EQ(LessonReader("fr").text(message),
              "Le rapport ne peut pas être construit à partir d'une copie propre du dossier\u202F: quuxes abound here");
    EXPECT_EQ(LessonReader("en", "91_first").text(message), message_text(message));
    for (const char* language : {"", "klingon", "../fr", "fr/../fr"})
        EXPECT_EQ(LessonReader(language, "91_first").text(message), message_text(message)) << language;
}

TEST_F(lesson_reader, names_file_and_line_of_a_catalog_that_cannot_be_read) {
    add_lesson("92_second", "msgid \"a\"\nmsgstr b\n");
    try {
        LessonReader("fr", "92_second");
        ADD_FAILURE();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("92_second/checks.fr.po, line 2: "));
    }
}

/// Expects French texts for a folder of French work. Returns the ids of its issues.
std::set<std::string> reported_ids(const Workbench& bench, const FolderLimits& limits = {},
                                   bool lesson_checks = false) {
    CheckOptions check_options;
    check_options.lesson_checks = lesson_checks;
    const CheckResult result = check_folder(bench.path("mine"), DYNLAB_PROGRAM, check_options, limits);
    std::set<std::string> ids;
    for (const Message& part : result.checked)
        if (!message_text(part).ends_with(".pdf")) expect_french_text(part);
    for (const Issue& issue : result.findings) ids.insert(issue.id);
    expect_french_text(result.findings);
    return ids;
}

void write_french_folder(const Workbench& bench, const std::string& script, const std::string& header = "") {
    bench.write("mine/analysis.lua", "-- ---\n-- title: A\n-- language: fr\n" + header + "-- ---\n" + script);
    bench.write("mine/report.md", "---\ntitle: A\nlang: fr\npages: 1\n---\n\nLa somme est `sum`{.value}.\n");
}

// oracle: the ids that folder_check.h lists, and the words of English that no French sentence has
TEST(findings_in_french, of_folders_are_french_throughout) {
    const Workbench bench;
    std::set<std::string> reported;
    const auto collect_ids = [&](const FolderLimits& limits = {}, bool lesson_checks = false) {
        const std::set<std::string> ids = reported_ids(bench, limits, lesson_checks);
        EXPECT_FALSE(ids.empty());
        reported.insert(ids.begin(), ids.end());
    };
    bench.write("mine/notes.txt", "");
    collect_ids();
    write_french_folder(bench,
                        "report.value('sum', 1)\n-- **Question 1.**\n-- VOTRE CODE ICI\n-- *Votre réponse :*\n"
                        "-- **Question 2.**\n-- VOTRE CODE ICI\n-- # Et\n-- VOTRE CODE ICI\n"
                        "report.value('one', 1)\nreport.text('a', 'x')\nreport.text('b', 'x')\n"
                        "report.table('models', {{'a', 'b'}, {1, 2}})\n"
                        "report.figure('line', plot({0, 1}, {0, 1}), 'A line')\n",
                        "-- answers:\n--   gain: number\n");
    bench.write("mine/group.toml", "members = []\n");
    bench.write("mine/checks.lua",
                "check{id = 'gain', points = 3, about = 'Le gain', test = function(a) return "
                "near(a.gain, 2) end}\n");
    bench.write("elsewhere.csv", "y\n1\n");
    fs::create_symlink(bench.path("elsewhere.csv"), bench.path("mine/values.csv"));
    bench.write("mine/report.pdf", "%PDF-1.4\n");
    collect_ids({}, true);
    bench.shell("touch -d 2020-01-01 mine/report.pdf");
    collect_ids();
    FolderLimits limits;
    limits.files = 2;
    collect_ids(limits);
    limits = {};
    limits.time.processor = std::chrono::seconds(1);
    write_french_folder(bench, "while true do end\n");
    collect_ids(limits);
    write_french_folder(bench, "local y = load('nosuch').y\n");
    collect_ids();
    write_french_folder(bench, "local y = load('../elsewhere.csv').y\n");
    collect_ids();
    write_french_folder(bench, "print(1)\n");  // the value has no entry: the text of the report stops it
    collect_ids();
    EXPECT_THAT(reported,
                testing::IsSupersetOf({"analysis-missing", "folder-too-large", "analysis-fails", "answer-open",
                                       "answer-missing", "not-shown", "members-missing", "pdf-outdated", "pdf-differs",
                                       "link-left-out", "check-failed", "file-outside"}));
}

TEST(findings_in_french, are_printed_by_check_and_stay_english_for_programs) {
    const Workbench bench;
    bench.write("mine/analysis.lua",
                "-- ---\n-- title: A\n-- language: fr\n-- template: lab_report\n-- ---\nreport.value('x', 1)\n");
    bench.write("mine/report.md",
                "---\ntitle: A\nlang: fr\nsections: |\n  Process | Procédé\npages: 1\n---\n\n# Données\n\nLa valeur "
                "est `x`{.value} et c'est ce que nous avons trouvé dans les données de la grue. TODO\n");
    const std::string reported = bench.dynlab({"check", "mine", "--document-only"}).output;
    EXPECT_THAT(reported, AllOf(HasSubstr("Règles enfreintes ("), HasSubstr("La section «\u00a0Procédé\u00a0» manque"),
                                HasSubstr("-> Ajoutez ce titre et écrivez"), HasSubstr("Une note pour vous-même")));
    for (const char* word : {" the ", " is ", " are ", " was ", "Write", "Hints", "Rules", " pages of"})
        EXPECT_THAT(reported, Not(HasSubstr(word)));
    EXPECT_THAT(bench.dynlab({"check", "mine", "--document-only", "--json"}).output,
                HasSubstr("The section \\\"Procédé\\\" is missing"))
        << "programs read one language";
}

TEST(findings_in_french, of_a_script_that_stops_quote_its_error_in_french) {
    const Workbench bench;
    write_french_folder(bench, "local y = yy\n");
    EXPECT_THAT(bench.dynlab({"check", "mine", "--document-only"}).output,
                AllOf(HasSubstr("Le rapport ne peut pas être construit à partir d'une copie propre du dossier"),
                      HasSubstr("analysis.lua:5: fonction ou"), HasSubstr("variable")));
}

TEST(feedback_in_french, has_the_authors_sentences_of_the_lesson) {
    Grade grade;
    grade.lesson = "03_crane";
    grade.language = "fr";
    const Message far =
        Message("The error is {}; the largest allowed error is {}.", significant(3.25, 3), significant(0.1, 3));
    CheckGrade check;
    check.id = "free_swing";
    check.about = Message::verbatim("The swing frequency of the load while the motor is off");
    check.hint = Message::verbatim("Count the swings of free_swing, multiply by 2 pi, and divide by their duration.");
    check.message = sentences({far, Message::verbatim("This is in Hz; use rad/s.")});
    check.points = 2;
    grade.checks.push_back(check);
    EXPECT_THAT(feedback_markdown(grade),
                AllOf(HasSubstr("La pulsation de la charge quand le moteur est au repos** – 0 sur 2"),
                      HasSubstr("L'erreur est de 3,25\u202F; la plus grande erreur admise est de 0,1. "
                                "C'est en Hz\u202F; on demande des rad/s."),
                      HasSubstr("Comptez les oscillations")));
}

}  // namespace test_lesson_reader
}  // namespace dynlab::test
