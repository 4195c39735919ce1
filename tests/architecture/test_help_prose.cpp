// The language of the help pages of functions and subjects, with the texts of the function tables: the words of the
// glossary and short sentences. Oracle: the lists below.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "documents/text_lines.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/runtime/help.h"

namespace test_help_prose {
using namespace dynlab;

/// The left column of the glossary, and phrases that a native reader has to translate back.
constexpr std::array kRefused = {
    "told",        "tells",       "tell",         "mend",         "mended",        "hand in",      "handed in",
    "hands in",    "hand-in",     "hand back",    "handed back",  "need your eye", "nobody",       "somebody",
    "whoever",     "stranger",    "boxed",        "specimen",     "rig",           "rigs",         "guess",
    "guesses",     "record",      "records",      "remembered",   "recalled",      "spoilt",       "trouble",
    "judge",       "judged",      "verdict",      "stands",       "stand",         "holds good",   "straight lines",
    "anew",        "afresh",      "besides",      "beforehand",   "hardly",        "likewise",     "by itself",
    "one by one",  "of its own",  "of their own", "of your own",  "of one's own",  "as far as",    "in the place of",
    "in place of", "in front of", "unless given", "unless told",  "for good",      "coloured",     "behaviour",
    "neighbour",   "neighbours",  "realisation",  "realisations", "minimises",     "factorisation"};

constexpr std::size_t kLongest = 25;           ///< words in a sentence
constexpr double kShareOfLongSentences = 1.0;  ///< percent; lower it when the share has fallen, never raise it

/// The sentences as lists of words in lower case. A cell, an item and a paragraph end a sentence. Code is the word `x`;
/// code blocks, formulas, headings and references are left out.
std::vector<std::vector<std::string>> sentences_of(const std::string& page) {
    std::vector<std::vector<std::string>> sentences(1);
    const auto end_sentence = [&] {
        if (!sentences.back().empty()) sentences.emplace_back();
    };
    bool block = false, references = false, code = false;
    for (const std::string& line : lines_of(page)) {
        const bool fence = line.starts_with("```");
        if (line.starts_with("#")) references = line == "## References";
        if (fence || line.starts_with("#") || line.starts_with("|") || line.starts_with("- ") || line.empty()) {
            end_sentence();
            code = false;
        }
        if (fence) block = !block;
        if (fence || block || references || line.starts_with("#") || line.starts_with("    ") || line.starts_with("$$"))
            continue;
        std::string text;
        for (const char c : line) {
            if (c == '`') code = !code;
            if (c == '`' && code) text += 'x';
            if (c == '|' && !code) text += " . ";
            if (c != '`' && c != '|' && !code) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            const bool last = std::string_view(".:!?").find(word.back()) != std::string_view::npos;
            const auto letter = [](unsigned char c) { return std::isalnum(c) != 0; };
            const auto begin = std::ranges::find_if(word, letter);
            const auto end = std::find_if(word.rbegin(), word.rend(), letter).base();
            if (begin < end) sentences.back().emplace_back(begin, end);
            if (last) end_sentence();
        }
    }
    return sentences;
}

TEST(help_prose, uses_the_words_of_the_glossary_and_short_sentences) {
    const std::filesystem::path folder = std::filesystem::path(DYNLAB_SOURCE_DIR) / "engine/scripting/reference";
    std::size_t count = 0, too_long = 0;
    for (const HelpPage& page : help_pages()) {
        if (!std::filesystem::exists(folder / (std::string(page.name) + ".md"))) continue;  // a guide
        std::string words = " ";
        for (const auto& sentence : sentences_of(page_text(page, find_function(std::string(page.name))))) {
            for (const std::string& word : sentence) words += word + " ";
            words += ". ";
            count += sentence.size() > 1;
            too_long += sentence.size() > kLongest;
        }
        for (const std::string phrase : kRefused)
            EXPECT_EQ(words.find(" " + phrase + " "), words.npos) << page.name << ": " << phrase;
    }
    EXPECT_GT(count, 3000u);
    EXPECT_LE(100.0 * static_cast<double>(too_long), kShareOfLongSentences * static_cast<double>(count))
        << too_long << " of " << count << " sentences have more than " << kLongest << " words";
}

}  // namespace test_help_prose
