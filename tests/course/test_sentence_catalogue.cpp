// What is told in French. Oracles: sentences written here by hand; those that the lessons' checks hold.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "course/findings/french_sentences.h"
#include "course/grading/feedback.h"
#include "course/grading/folder_check.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "support/message_texts.h"
#include "support/program.h"
#include "told_in_french.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::test {
namespace test_sentence_catalogue {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

SentenceCatalogue catalogue(const Workbench& bench, const std::string& text) {
    bench.write("c.txt", text);
    SentenceCatalogue sentences;
    sentences.add(bench.path("c.txt"));
    return sentences;
}

TEST(sentence_catalogue, tells_sentence_by_sentence_and_keeps_what_it_does_not_know) {
    const Workbench bench;
    const SentenceCatalogue known = catalogue(bench,
                                              "# remark\nIt is {} away.\n  Il s'en faut de {}.\nHz is wanted.\n  On "
                                              "demande des Hz.\n\nThe name of {} stands there: \"{}\".\n  Le nom de "
                                              "{} est là : « {} ».\nThe {}.\n  {} ?\nfigure\n  la figure\n");
    EXPECT_EQ(known.translated("It is 0.25 away. Hz is wanted."), "Il s'en faut de 0,25. On demande des Hz.");
    const std::string endless(1'000'000, 'x');
    EXPECT_EQ(known.translated(endless), endless);
    EXPECT_EQ(known.translated("Something else. Hz is wanted."), "Something else. On demande des Hz.");
    EXPECT_EQ(known.translated("Hz is wanted"), "Hz is wanted");
    EXPECT_EQ(known.translated("The name of A. B. stands there: \"x. y\"."), "Le nom de A. B. est là : « x. y ».")
        << "the entry with most letters, and points within";
    EXPECT_EQ(known.translated("The figure."), "la figure ?");
    EXPECT_EQ(known.translated(""), "");
    EXPECT_EQ(SentenceCatalogue().translated("It is 0.25 away."), "It is 0.25 away.");
    for (const auto& [number, french] : {std::pair("15.9 %", "15,9 %"),
                                         {"15.9%", "15,9%"},
                                         {"-1.5e-05", "-1,5e-05"},
                                         {"0.25 rad/s", "0,25 rad/s"},
                                         {"7", "7"},
                                         {"7.", "7."},
                                         {"1.2.3", "1.2.3"},
                                         {"2.5x", "2.5x"},
                                         {"a 2.5", "a 2.5"}})
        EXPECT_EQ(known.translated(fmt::format("It is {} away.", number)), fmt::format("Il s'en faut de {}.", french));
    EXPECT_EQ(known.translated("The name of A stands there: \"1.1 Data\"."), "Le nom de A est là : « 1.1 Data ».")
        << "what is quoted stays as it is";
    EXPECT_TRUE(known.knows("It is 1 away."));
    EXPECT_FALSE(known.knows("It is 1 away. Hz is wanted."));
}

TEST(sentence_catalogue, tells_what_a_program_prints_line_by_line) {
    const Workbench bench;
    const SentenceCatalogue known = catalogue(bench, "there is no {}\n  il n'y a pas de {}\nup to date\n  à jour\n");
    EXPECT_EQ(
        known.translated_lines("dynlab: note: there is no a.lua\nup to date\ndynlab: there is no b.lua\n  else\n"),
        "dynlab: note: il n'y a pas de a.lua\nà jour\ndynlab: il n'y a pas de b.lua\n  else");
    EXPECT_EQ(known.translated_lines(""), "");
}

TEST(sentence_catalogue, places_for_numbers_and_for_sentences_hold_nothing_else) {
    const Workbench bench;
    const SentenceCatalogue known =
        catalogue(bench,
                  "{n} pole\n  {n} pôle\n{n} GB\n  {n} Go\nit has {}\n  il a {}\nall failed; the first says: {s}\n  "
                  "tout a échoué ; le premier dit : {s}\n");
    EXPECT_EQ(known.translated("it has 1 pole"), "il a 1 pôle");
    EXPECT_EQ(known.translated("it has 2.15 GB"), "il a 2,15 Go");
    EXPECT_EQ(known.translated("it has 8e+03 GB"), "il a 8e+03 Go");
    for (const char* unknown : {"there is 1 pole", "no pole", "all failed; the first says: nothing"})
        EXPECT_EQ(known.translated(unknown), unknown);
    EXPECT_EQ(known.translated("all failed; the first says: it has 1 pole"),
              "tout a échoué ; le premier dit : il a 1 pôle");
    EXPECT_EQ(known.translated("a.lua:1: f: g: all failed; the first says: h: it has 1 pole"),
              "a.lua:1: f: g: tout a échoué ; le premier dit : h: il a 1 pôle");
    std::string deep = "all failed; the first says: ";
    for (int k = 0; k < 12; ++k) deep += deep;
    EXPECT_EQ(known.translated(deep), deep);
}

TEST(sentence_catalogue, refuses_what_is_no_pair) {
    const Workbench bench;
    for (const auto& [text, words] :
         {std::pair("A.\nB.\n", "c.txt:2: the sentence above has no other"),
          std::pair("  B.\n", "c.txt:1: no sentence stands above"), std::pair("A.\n", "the last sentence has no other"),
          std::pair("A {}.\n  B.\n", "c.txt:2: as many {} are wanted")}) {
        try {
            catalogue(bench, text);
            ADD_FAILURE() << text;
        } catch (const EnvironmentError& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }
}

std::vector<std::string> english_of(const fs::path& file) {
    std::vector<std::string> sentences;
    for (const std::string& line : lines_of(read_text(file)))
        if (!line.empty() && !line.starts_with(' ') && !line.starts_with('#')) sentences.push_back(line);
    return sentences;
}

/// The texts that a checks.lua tells to students.
std::vector<std::string> told_by(const std::string& checks) {
    std::vector<std::string> told;
    const std::regex text(R"re((?:\b(?:say|hint|about|message)\s*=\s*|judge\()"((?:[^"\\]|\\.)*)")re");
    for (std::sregex_iterator at(checks.begin(), checks.end(), text), end; at != end; ++at)
        told.push_back(replaced((*at)[1].str(), "\\\"", "\""));
    return told;
}

TEST(sentence_catalogue, knows_all_that_checks_of_lessons_in_french_tell_and_nothing_else) {
    int lessons_seen = 0;
    for (const Lesson& lesson : lessons()) {
        if (!fs::exists(lesson.tasks("fr"))) continue;
        ++lessons_seen;
        const std::string checks = read_text(lesson.folder / "checks.lua");
        const SentenceCatalogue sentences = french_sentences(lesson.slug);
        const std::vector<std::string> told = told_by(checks);
        EXPECT_GT(told.size(), 30u);
        for (const std::string& sentence : told) EXPECT_TRUE(sentences.knows(sentence)) << sentence;
        for (const std::string& sentence : english_of(lesson.folder / "checks.fr.txt"))
            EXPECT_NE(std::find(told.begin(), told.end(), sentence), told.end()) << "told by no check: " << sentence;
    }
    EXPECT_EQ(lessons_seen, 4);
}

// oracle: the program's own sources. Numbers and their nouns are put together by the program, and so are some words
// between; what stands between those is looked for, word by word.
TEST(sentence_catalogue, holds_no_sentence_that_the_program_does_not_write) {
    std::string sources;
    for (const char* layer : {"engine/platform", "engine/course", "engine/documents", "engine/cli", "engine/app"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / layer))
            if (entry.path().extension() == ".cpp") sources += read_text(entry.path());
    sources = std::regex_replace(sources, std::regex("\"\\s*\n\\s*\""), "");
    sources = replaced(sources, "\\\"", "\"");
    const std::regex put_together(
        R"re(\{\}|[.;:,()"+]| -o |\b(pages?|slides?|sections?|figures?|tables?|texts?|values?|French|English|stands)\b|)re"
        R"re(\b(the|there|as|is|are|has|have|it)\b)re");
    const fs::path file = fs::path(DYNLAB_SOURCE_DIR) / "report_templates/sentences.fr.txt";
    for (const std::string& sentence : english_of(file))
        for (const std::string& line : lines_of(std::regex_replace(sentence, put_together, "\n")))
            EXPECT_NE(sources.find(trimmed(line)), sources.npos) << trimmed(line) << " in: " << sentence;
}

/// A folder of French work, its findings told in French; their ids.
std::set<std::string> ids_told(const Workbench& bench, const FolderLimits& limits = {}, bool lesson_checks = false) {
    CheckOptions wishes;
    wishes.lesson_checks = lesson_checks;
    const CheckResult result = check_folder(bench.path("mine"), DYNLAB_PROGRAM, wishes, limits);
    std::set<std::string> ids;
    for (const std::string& part : texts_of(result.checked))
        if (!part.ends_with(".pdf")) expect_told_in_french(part);
    for (const Finding& finding : result.findings) {
        ids.insert(finding.id);
        expect_told_in_french(message_text(finding.what));
        expect_told_in_french(message_text(finding.remedy));
    }
    return ids;
}

void write_french_folder(const Workbench& bench, const std::string& script, const std::string& header = "") {
    bench.write("mine/analysis.lua", "-- ---\n-- title: A\n-- language: fr\n" + header + "-- ---\n" + script);
    bench.write("mine/report.md", "---\ntitle: A\nlang: fr\npages: 1\n---\n\nLa somme est `sum`{.value}.\n");
}

// oracle: the ids that folder_check.h lists, and the words of English that no French sentence has
TEST(sentence_catalogue, tells_what_is_found_in_folders) {
    const Workbench bench;
    std::set<std::string> told;
    const auto tell = [&](const FolderLimits& limits = {}, bool lesson_checks = false) {
        const std::set<std::string> ids = ids_told(bench, limits, lesson_checks);
        EXPECT_FALSE(ids.empty());
        told.insert(ids.begin(), ids.end());
    };
    bench.write("mine/notes.txt", "");
    tell();
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
    tell({}, true);
    bench.shell("touch -d 2020-01-01 mine/report.pdf");
    tell();
    FolderLimits limits;
    limits.files = 2;
    tell(limits);
    limits = {};
    limits.time.processor = std::chrono::seconds(1);
    write_french_folder(bench, "while true do end\n");
    tell(limits);
    EXPECT_THAT(told, testing::IsSupersetOf({"analysis-missing", "folder-too-large", "analysis-fails", "answer-open",
                                             "answer-missing", "not-shown", "members-missing", "pdf-outdated",
                                             "pdf-differs", "link-left-out", "check-failed"}));
}

TEST(sentence_catalogue, is_used_by_check_and_feedback_of_french_work) {
    const Workbench bench;
    bench.write("mine/analysis.lua",
                "-- ---\n-- title: A\n-- language: fr\n-- template: lab_report\n-- ---\nreport.value('x', 1)\n");
    bench.write("mine/report.md",
                "---\ntitle: A\nlang: fr\nsections: |\n  Process | Procédé\npages: 1\n---\n\n# Données\n\nLa valeur "
                "est `x`{.value} et c'est ce que nous avons trouvé dans les données de la grue. TODO\n");
    const std::string told = bench.dynlab({"check", "mine", "--document-only"}).output;
    EXPECT_THAT(told, AllOf(HasSubstr("Règles enfreintes ("), HasSubstr("La section «\u00a0Procédé\u00a0» manque"),
                            HasSubstr("-> Ajoutez un titre avec ces mots"), HasSubstr("Une note pour vous-même")));
    for (const char* word : {" the ", " is ", " are ", " was ", "Write", "Hints", "Rules", " pages of"})
        EXPECT_THAT(told, Not(HasSubstr(word)));
    EXPECT_THAT(bench.dynlab({"check", "mine", "--document-only", "--json"}).output,
                HasSubstr("The section \\\"Procédé\\\" is missing"))
        << "programs read one language";

    Grade grade;
    grade.lesson = "03_crane";
    grade.language = "fr";
    grade.checks.push_back({"free_swing", "The frequency of the load while the motor rests",
                            "Count the swings of free_swing and divide by the time they take; 2 pi in each.",
                            Message("It is 3.25 away from what was expected; at most 0.1 was wanted. This is in Hz; "
                                    "rad/s are wanted."),
                            2, 0});
    const std::string feedback = feedback_markdown(grade);
    EXPECT_THAT(feedback, AllOf(HasSubstr("La fréquence de la charge quand le moteur est au repos"),
                                HasSubstr("L'écart à ce qui était attendu est de 3,25\u00a0; on demandait 0,1 au plus. "
                                          "C'est en Hz\u00a0; on demande des rad/s."),
                                HasSubstr("Comptez les balancements")));
}

}  // namespace test_sentence_catalogue
}  // namespace dynlab::test
