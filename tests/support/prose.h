#pragma once
// English text taken apart for tests: blocks, sentences, refused words, spelling.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "documents/text_lines.h"

namespace dynlab::test {

/// The left column of the glossary, and phrases that a native reader has to translate back.
inline constexpr std::array kRefusedPhrases = {
    "told",        "tells",       "tell",         "mend",         "mended",        "hand in",      "handed in",
    "hands in",    "hand-in",     "hand back",    "handed back",  "need your eye", "nobody",       "somebody",
    "whoever",     "stranger",    "boxed",        "specimen",     "rig",           "rigs",         "guess",
    "guesses",     "record",      "records",      "remembered",   "recalled",      "spoilt",       "trouble",
    "judge",       "judged",      "verdict",      "stands",       "stand",         "holds good",   "straight lines",
    "anew",        "afresh",      "besides",      "beforehand",   "hardly",        "likewise",     "by itself",
    "one by one",  "of its own",  "of their own", "of your own",  "of one's own",  "as far as",    "in the place of",
    "in place of", "in front of", "unless given", "unless told",  "for good",      "coloured",     "behaviour",
    "neighbour",   "neighbours",  "realisation",  "realisations", "minimises",     "factorisation"};

inline constexpr std::size_t kMaxSentenceLength = 25;  ///< words

/// A paragraph, a list item, a cell of a table or a heading, in plain words.
struct ProseBlock {
    std::string text;
    bool heading = false;
};

/// Markdown in words: code, formulas, references and slots are "x"; attributes, addresses and citations are left out.
inline std::string in_plain_words(const std::string& markdown) {
    std::string text;
    const auto after = [&](std::string_view end, std::size_t from) {
        const std::size_t at = markdown.find(end, from);
        return at == markdown.npos ? markdown.size() : at + end.size();
    };
    const auto is_next = [&](std::string_view what, std::size_t at) {
        return std::string_view(markdown).substr(at).starts_with(what);
    };
    const auto letter = [&](std::size_t at) {
        return at < markdown.size() && std::isalnum(static_cast<unsigned char>(markdown[at])) != 0;
    };
    for (std::size_t i = 0; i < markdown.size();) {
        const char c = markdown[i];
        if (c == '`' || c == '$') {
            const std::size_t ticks = std::min(markdown.find_first_not_of(c, i), markdown.size()) - i;
            i = after(std::string(ticks, c), i + ticks);
            text += 'x';
        } else if (is_next("{.", i) || is_next("{#", i) || is_next("{width", i)) {
            i = after("}", i);
        } else if (is_next("](", i)) {
            i = after(")", i);
        } else if (is_next("[@", i)) {
            i = after("]", i);
        } else if (c == '@' && letter(i + 1)) {
            for (++i; letter(i) || (i + 1 < markdown.size() && letter(i + 1) && !std::isspace(markdown[i]));) ++i;
            text += 'x';
        } else if (is_next("http", i)) {
            while (i < markdown.size() && !std::isspace(static_cast<unsigned char>(markdown[i]))) ++i;
        } else if (is_next("<!--", i) || is_next("-->", i)) {
            i += c == '<' ? 4 : 3;
        } else if (c == '\\') {
            for (++i; letter(i);) ++i;
            text += ' ';
        } else {
            text += c;
            ++i;
        }
    }
    return text;
}

/// The blocks of a page in Markdown. Code blocks, displayed formulas and references are left out.
inline std::vector<ProseBlock> blocks_of_prose(const std::string& page) {
    std::vector<ProseBlock> blocks(1);
    const auto end_block = [&] {
        if (!blocks.back().text.empty()) blocks.emplace_back();
    };
    bool fence = false, formula = false, references = false, header = page.starts_with("---\n");
    int number = 0;
    for (const std::string& line : lines_of(page)) {
        ++number;
        if (header) {
            header = number == 1 || line != "---";
            continue;
        }
        const std::string text = trimmed(line);
        const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
        const bool item = text.starts_with("- ") || text.starts_with("* ") ||
                          (digits > 0 && std::string_view(text).substr(digits).starts_with(". "));
        const bool code = text.starts_with("```"), div = text.starts_with(":::"), cells = text.starts_with("|");
        const bool heading = text.starts_with("#"), display = formula || text.starts_with("$$");
        for (std::size_t at = 0; !fence && (at = text.find("$$", at)) != text.npos; at += 2) formula = !formula;
        if (code) fence = !fence;
        if (heading && !fence) references = text == "## References";
        if (text.empty() || item || code || div || cells || heading || display || text.starts_with("![")) end_block();
        const bool indented_code = line.starts_with("    ") && blocks.back().text.empty();
        if (text.empty() || fence || code || div || display || references || indented_code) continue;
        if (cells) {
            std::istringstream row(in_plain_words(text));
            for (std::string cell; std::getline(row, cell, '|'); end_block()) blocks.back().text = trimmed(cell);
            continue;
        }
        blocks.back().heading = heading;
        blocks.back().text += (blocks.back().text.empty() ? "" : " ") + text.substr(item ? text.find(' ') + 1 : 0);
        if (heading) end_block();
    }
    for (ProseBlock& block : blocks) block.text = in_plain_words(block.text);
    return blocks;
}

/// The sentences of a page as lists of words in lower case, without headings.
inline std::vector<std::vector<std::string>> sentences_of(const std::string& page) {
    std::vector<std::vector<std::string>> sentences(1);
    const auto end_sentence = [&] {
        if (!sentences.back().empty()) sentences.emplace_back();
    };
    const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80; };
    for (const ProseBlock& block : blocks_of_prose(page)) {
        if (block.heading) continue;
        std::istringstream words(block.text);
        for (std::string word; words >> word;) {
            const std::size_t last = word.find_last_not_of(")]*_\"'");
            const bool ends = last != word.npos && std::string_view(".:!?").find(word[last]) != std::string_view::npos;
            const auto begin = std::ranges::find_if(word, letter);
            const auto end = std::find_if(word.rbegin(), word.rend(), letter).base();
            if (begin < end) {
                sentences.back().emplace_back(begin, end);
                for (char& c : sentences.back().back())
                    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            }
            if (ends) end_sentence();
        }
        end_sentence();
    }
    if (sentences.back().empty()) sentences.pop_back();
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

/// The refused phrases in the sentences.
inline std::vector<std::string> refused_in(const std::vector<std::vector<std::string>>& sentences) {
    const std::string words = spaced(sentences);
    std::vector<std::string> found;
    for (const std::string phrase : kRefusedPhrases)
        if (words.find(" " + phrase + " ") != words.npos) found.push_back(phrase);
    return found;
}

inline bool has_word(const std::string& text, const std::string& word) {
    const auto letter = [&](std::size_t at) {
        return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at]));
    };
    for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; ++at)
        if ((at == 0 || !letter(at - 1)) && !letter(at + word.size())) return true;
    return false;
}

inline bool can_spell() {
    return std::system("echo word | hunspell -d en_US -i UTF-8 -l >/dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

/// "PAGE: WORD" for words that neither the American dictionary nor the list of the field's words has; one run of
/// hunspell for all pages. Symbols with digits, primes or Greek letters are no words.
inline std::set<std::string> misspelled_in(const std::map<std::string, std::string>& pages) {
    std::map<std::string, std::string> texts;
    for (const auto& [name, page] : pages)
        for (const ProseBlock& block : blocks_of_prose(page)) texts[name] += replaced(block.text, "'s", "") + "\n\n";
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "prose_to_spell.txt";
    {
        std::ofstream out(file);
        for (const auto& [name, text] : texts) out << text;
    }
    const std::string command =
        "hunspell -d en_US -i UTF-8 -p " DYNLAB_SOURCE_DIR "/tests/support/words_of_the_field.txt -l " + file.string();
    const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), pclose);
    std::string words;
    for (int c = std::fgetc(output.get()); c != EOF; c = std::fgetc(output.get())) words += static_cast<char>(c);
    std::filesystem::remove(file);
    std::set<std::string> found;
    for (const std::string& word : words_between_spaces(words)) {
        const bool is_symbol = std::ranges::any_of(word, [](unsigned char b) {
            return std::isdigit(b) != 0 || b == '\'' || b == 0xCE || b == 0xCF;  // Greek letters in UTF-8
        });
        for (const auto& [name, text] : texts)
            if (!is_symbol && has_word(text, word)) found.insert(name + ": " + word);
    }
    return found;
}

}  // namespace dynlab::test
