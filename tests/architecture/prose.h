#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "documents/text_lines.h"

namespace dynlab::test {

/// The left column of the glossary, and phrases that a native reader has to translate back.
constexpr std::array kRefusedPhrases = {
    "told",        "tells",       "tell",         "mend",         "mended",        "hand in",      "handed in",
    "hands in",    "hand-in",     "hand back",    "handed back",  "need your eye", "nobody",       "somebody",
    "whoever",     "stranger",    "boxed",        "specimen",     "rig",           "rigs",         "guess",
    "guesses",     "record",      "records",      "remembered",   "recalled",      "spoilt",       "trouble",
    "judge",       "judged",      "verdict",      "stands",       "stand",         "holds good",   "straight lines",
    "anew",        "afresh",      "besides",      "beforehand",   "hardly",        "likewise",     "by itself",
    "one by one",  "of its own",  "of their own", "of your own",  "of one's own",  "as far as",    "in the place of",
    "in place of", "in front of", "unless given", "unless told",  "for good",      "coloured",     "behaviour",
    "neighbour",   "neighbours",  "realisation",  "realisations", "minimises",     "factorisation"};

/// Further phrases that messages and the help of commands do without.
constexpr std::array kRefusedInMessages = {
    "is no",     "are no",   "there is no", "there are no", "no such",         "such a",  "whose",    "those that",
    "is said",   "as it is", "is told",     "so many",      "at work",         "alike",   "beside",   "wanted",
    "asked for", "begins",   "began",       "lies",         "worked solution", "is none", "of before"};

constexpr std::size_t kLongestSentence = 25;  ///< words

/// The sentences as lists of words in lower case. A cell, an item and a paragraph end a sentence. Code is the word `x`;
/// code blocks, formulas, headings and references are left out.
inline std::vector<std::vector<std::string>> sentences_of(const std::string& page) {
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

/// " a sentence . the next one . ", for searches of phrases.
inline std::string spaced(const std::vector<std::vector<std::string>>& sentences) {
    std::string words = " ";
    for (const auto& sentence : sentences) {
        for (const std::string& word : sentence) words += word + " ";
        words += ". ";
    }
    return words;
}

}  // namespace dynlab::test
