// The language of the help pages of functions and subjects, with the texts of the function tables: the words of the
// glossary and short sentences. Oracle: the lists of prose.h.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "prose.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/runtime/help.h"

namespace dynlab::test {
namespace test_help_prose {

constexpr double kShareOfLongSentences = 1.0;  ///< percent; lower it when the share has fallen, never raise it

TEST(help_prose, uses_the_words_of_the_glossary_and_short_sentences) {
    const std::filesystem::path folder = std::filesystem::path(DYNLAB_SOURCE_DIR) / "engine/scripting/reference";
    std::size_t count = 0, too_long = 0;
    for (const HelpPage& page : help_pages()) {
        if (!std::filesystem::exists(folder / (std::string(page.name) + ".md"))) continue;  // a guide
        const auto sentences = sentences_of(page_text(page, find_function(std::string(page.name))));
        for (const auto& sentence : sentences) {
            count += sentence.size() > 1;
            too_long += sentence.size() > kLongestSentence;
        }
        const std::string words = spaced(sentences);
        for (const std::string phrase : kRefusedPhrases)
            EXPECT_EQ(words.find(" " + phrase + " "), words.npos) << page.name << ": " << phrase;
    }
    EXPECT_GT(count, 3000u);
    EXPECT_LE(100.0 * static_cast<double>(too_long), kShareOfLongSentences * static_cast<double>(count))
        << too_long << " of " << count << " sentences have more than " << kLongestSentence << " words";
}

}  // namespace test_help_prose
}  // namespace dynlab::test
