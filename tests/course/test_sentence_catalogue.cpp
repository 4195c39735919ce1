// What is told in French. Oracles: sentences written here by hand; those that the lessons' checks hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "course/findings/sentence_catalogue.h"
#include "course/grading/feedback.h"
#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/text_file.h"
#include "support/program.h"
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
    EXPECT_EQ(known.translated("Something else. Hz is wanted."), "Something else. On demande des Hz.");
    EXPECT_EQ(known.translated("Hz is wanted"), "Hz is wanted");
    EXPECT_EQ(known.translated("The name of A. B. stands there: \"x. y\"."), "Le nom de A. B. est là : « x. y ».")
        << "the entry with most letters, and points within";
    EXPECT_EQ(known.translated("The figure."), "la figure ?");
    EXPECT_EQ(known.translated(""), "");
    EXPECT_EQ(SentenceCatalogue().translated("It is 0.25 away."), "It is 0.25 away.");
    EXPECT_TRUE(known.knows("It is 1 away."));
    EXPECT_FALSE(known.knows("It is 1 away. Hz is wanted."));
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
    EXPECT_EQ(lessons_seen, 2);
}

// oracle: the program's own sources
TEST(sentence_catalogue, holds_no_sentence_that_the_program_does_not_write) {
    std::string sources;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/course"))
        if (entry.path().extension() == ".cpp") sources += read_text(entry.path());
    sources = std::regex_replace(sources, std::regex("\"\\s*\n\\s*\""), "");
    sources = replaced(sources, "\\\"", "\"");
    const fs::path file = fs::path(DYNLAB_SOURCE_DIR) / "report_templates/sentences.fr.txt";
    // numbers and their nouns are put together by the program, so that words are what can be looked for
    const std::regex word("[A-Za-z]{5,}");
    for (const std::string& sentence : english_of(file))
        for (std::sregex_iterator at(sentence.begin(), sentence.end(), word), end; at != end; ++at)
            EXPECT_NE(sources.find(at->str()), sources.npos) << at->str() << " in: " << sentence;
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
                            "It is 3.25 away from what was expected; at most 0.1 was wanted. This is in Hz; rad/s are "
                            "wanted.",
                            2, 0});
    const std::string feedback = feedback_markdown(grade);
    EXPECT_THAT(feedback, AllOf(HasSubstr("La fréquence de la charge quand le moteur est au repos"),
                                HasSubstr("L'écart à ce qui était attendu est de 3,25\u00a0; on demandait 0,1 au plus. "
                                          "C'est en Hz\u00a0; on demande des rad/s."),
                                HasSubstr("Comptez les balancements")));
}

}  // namespace test_sentence_catalogue
}  // namespace dynlab::test
