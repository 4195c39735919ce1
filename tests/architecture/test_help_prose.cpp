// The language of the help pages of functions and subjects, with the texts of the function tables: the words of the
// glossary, short sentences, American spelling. Oracles: the lists in support/prose.h, hunspell.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "support/prose.h"

namespace dynlab::test {
namespace test_help_prose {

constexpr double kShareOfLongSentences = 1.0;  ///< percent; lower it when the share has fallen, never raise it

bool is_guide(const HelpPage& page) {
    return std::filesystem::exists(DYNLAB_SOURCE_DIR "/engine/scripting/reference/guides/" + std::string(page.name) +
                                   ".md");
}

TEST(help_prose, uses_the_words_of_the_glossary_and_short_sentences) {
    std::size_t count = 0, too_long = 0;
    for (const HelpPage& page : help_pages()) {
        if (is_guide(page)) continue;  // see test_text_prose.cpp
        const auto sentences = sentences_of(page_text(page, find_function(std::string(page.name))));
        for (const auto& sentence : sentences) {
            count += sentence.size() > 1;
            too_long += sentence.size() > kMaxSentenceLength;
        }
        for (const std::string& phrase : refused_in(sentences)) ADD_FAILURE() << page.name << ": " << phrase;
    }
    EXPECT_GT(count, 3000u);
    EXPECT_LE(100.0 * static_cast<double>(too_long), kShareOfLongSentences * static_cast<double>(count))
        << too_long << " of " << count << " sentences have more than " << kMaxSentenceLength << " words";
}

TEST(help_prose, has_american_spelling) {
    if (!can_spell()) GTEST_SKIP() << "hunspell with hunspell-en-us is not installed";
    std::map<std::string, std::string> pages;
    for (const HelpPage& page : help_pages())
        if (!is_guide(page)) {
            const std::string text = page_text(page, find_function(std::string(page.name)));
            pages[std::string(page.name)] = text.substr(std::min(text.find('\n'), text.size()));  // without the name
        }
    for (const std::string& page_and_word : misspelled_in(pages)) {
        const std::string word = page_and_word.substr(page_and_word.find(": ") + 2);
        const bool is_name =
            word == "color" || find_function(word) != nullptr;  // an option or a function, outside of code
        if (!is_name) ADD_FAILURE() << page_and_word;
    }
}

// Such a line within a sentence is typeset as an empty item of a numbered list.
TEST(help_prose, no_line_is_a_number_and_a_period) {
    for (const HelpPage& page : help_pages()) {
        std::istringstream text{std::string(page.text)};
        for (std::string line; std::getline(text, line);) {
            const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
            const std::size_t after = std::min(line.find_first_not_of("0123456789", first), line.size());
            EXPECT_FALSE(after > first && line.substr(after) == ".") << page.name << ": " << line;
        }
    }
}

}  // namespace test_help_prose
}  // namespace dynlab::test
