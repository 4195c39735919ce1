// The language of text files: README, guides, contributor pages, lessons, templates. Glossary words, short sentences,
// American spelling. Oracles: the lists in support/prose.h, hunspell, and long_sentences.txt, which limits the number
// of long sentences of each page.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "documents/percent_script.h"
#include "support/prose.h"

namespace dynlab::test {
namespace test_text_prose {
namespace fs = std::filesystem;

const fs::path kSource = DYNLAB_SOURCE_DIR;
constexpr double kShareOfLongSentences = 5.0;  ///< percent, over all pages

/// The text cells of a lesson, without the marks of its solution.
std::string text_of_lesson(const fs::path& file) {
    std::string text;
    for (const Cell& cell : read_percent_script(file).cells) {
        if (cell.kind != Cell::Kind::kText) continue;
        for (const std::string& line : lines_of(cell.content))
            if (line != "BEGIN SOLUTION" && line != "END SOLUTION" && !line.starts_with("STARTER:"))
                text += line + "\n";
        text += "\n";
    }
    return text;
}

/// English pages by their place in the project.
std::map<std::string, std::string> pages() {
    std::map<std::string, std::string> found;
    const auto add = [&](const fs::path& file) {
        const std::string name = file.filename().string();
        const std::string place = fs::relative(file, kSource).generic_string();
        if (name == "lesson.lua" || file.parent_path().filename() == "demos")
            found[place] = text_of_lesson(file);
        else if (file.extension() == ".md" && !name.ends_with(".fr.md"))
            found[place] = text_of_source(file);
    };
    add(kSource / "README.md");
    add(kSource / "engine/README.md");
    for (const char* folder : {".github", "engine/scripting/reference/guides", "report_templates"})
        for (const auto& entry : fs::directory_iterator(kSource / folder)) add(entry.path());
    for (const auto& entry : fs::recursive_directory_iterator(kSource / "lessons")) add(entry.path());
    return found;
}

std::map<std::string, std::size_t> recorded_long_sentences() {
    std::map<std::string, std::size_t> recorded;
    std::ifstream file(kSource / "tests/architecture/long_sentences.txt");
    std::string place;
    for (std::size_t number = 0; file >> number >> place;) recorded[place] = number;
    return recorded;
}

std::string beginning_of(const std::vector<std::string>& sentence) {
    std::string words;
    for (std::size_t i = 0; i < 8 && i < sentence.size(); ++i) words += sentence[i] + " ";
    return words + "...";
}

TEST(text_prose, uses_the_words_of_the_glossary_and_short_sentences) {
    std::size_t count = 0, too_long = 0;
    auto recorded = recorded_long_sentences();
    for (const auto& [place, text] : pages()) {
        const auto sentences = sentences_of(text);
        std::size_t here = 0;
        std::string which;
        for (const auto& sentence : sentences) {
            count += sentence.size() > 1;
            if (sentence.size() <= kMaxSentenceLength) continue;
            ++here;
            which += "\n  " + beginning_of(sentence);
        }
        too_long += here;
        EXPECT_LE(here, recorded[place]) << place << " has more sentences of more than " << kMaxSentenceLength
                                         << " words than long_sentences.txt records:" << which;
        recorded.erase(place);
        for (const std::string& phrase : refused_in(sentences)) ADD_FAILURE() << place << ": " << phrase;
    }
    for (const auto& [place, number] : recorded) ADD_FAILURE() << "long_sentences.txt names no page: " << place;
    EXPECT_GT(count, 4000u);
    EXPECT_LE(100.0 * static_cast<double>(too_long), kShareOfLongSentences * static_cast<double>(count))
        << too_long << " of " << count << " sentences have more than " << kMaxSentenceLength << " words";
}

TEST(text_prose, has_american_spelling) {
    if (!can_spell()) GTEST_SKIP() << "hunspell with hunspell-en-us is not installed";
    for (const std::string& place_and_word : misspelled_in(pages())) ADD_FAILURE() << place_and_word;
}

TEST(text_prose, is_measured_by_rules_that_find_what_they_look_for) {
    const std::string page =
        "# Heading told\n\nA sentence with `code told` and $x$ told. Another:\n\n| one colour | two |\n\n"
        "```\ntold\n```\n\n* An item,\n  continued. See @fig:a and [a link](https://told).\n";
    const auto sentences = sentences_of(page);
    ASSERT_EQ(sentences.size(), 6u);
    EXPECT_EQ(sentences[0], (std::vector<std::string>{"a", "sentence", "with", "x", "and", "x", "told"}));
    EXPECT_EQ(sentences[2], (std::vector<std::string>{"one", "colour"}));
    EXPECT_EQ(sentences[4], (std::vector<std::string>{"an", "item", "continued"}));
    EXPECT_EQ(sentences[5], (std::vector<std::string>{"see", "x", "and", "a", "link"}));
    EXPECT_EQ(refused_in(sentences), std::vector<std::string>{"told"});
    if (!can_spell()) GTEST_SKIP() << "hunspell with hunspell-en-us is not installed";
    EXPECT_EQ(misspelled_in({{"page", page}}), std::set<std::string>{"page: colour"});
}

}  // namespace test_text_prose
}  // namespace dynlab::test
