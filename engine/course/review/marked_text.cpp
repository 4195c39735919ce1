#include "course/review/marked_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/grading/feedback.h"
#include "platform/text/plain_words.h"
#include "documents/text_lines.h"
#include "documents/words/characters.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kLongestUnbrokenWord = 24;  ///< characters of the longest word that is kept in one piece
constexpr std::size_t kBreakDistance = 4;         ///< characters between the breaks of a longer one
constexpr std::size_t kShownEndWords = 10;        ///< words that are shown of each end of a long unchanged stretch
constexpr char kBreak[] = "\u200B";               ///< a line may break here
constexpr std::size_t kNoLimit = static_cast<std::size_t>(-1);

std::vector<std::string> characters_of(std::string_view text) {
    std::vector<std::string> characters;
    while (!text.empty()) {
        const std::string_view before = text;
        next_character(text);
        characters.emplace_back(before.substr(0, before.size() - text.size()));
    }
    return characters;
}

/// A word in pieces between which a line may break.
std::vector<std::string> pieces_of(const std::string& word) {
    const std::vector<std::string> characters = characters_of(word);
    if (characters.size() <= kLongestUnbrokenWord) return {word};
    std::vector<std::string> pieces(1);
    for (std::size_t i = 0; i < characters.size(); ++i) {
        if (i > 0 && i % kBreakDistance == 0) pieces.emplace_back();
        pieces.back() += characters[i];
    }
    return pieces;
}

std::string joined(const std::vector<std::string>& words, std::size_t from, std::size_t to) {
    std::string text;
    for (std::size_t i = from; i < std::min(to, words.size()); ++i) text += (i == from ? "" : " ") + words[i];
    return text;
}

}  // namespace

struct MarkedText::Printable {
    PrintableCharacters characters = PrintableCharacters::of_html();
};

MarkedText::MarkedText() : printable_(std::make_unique<Printable>()) {}
MarkedText::~MarkedText() = default;

std::string MarkedText::printable_words(const std::string& text) const {
    std::string result;
    for (const std::string& character : characters_of(printable(text, kNoLimit)))
        result += character.size() > 1 && printable_->characters.complaint(character) ? "?" : character;
    return result;
}

std::string MarkedText::plain(const std::string& text) const {
    std::string result;
    for (const std::string& word : words_between_spaces(printable_words(text))) {
        result += result.empty() ? "" : " ";
        const std::vector<std::string> pieces = pieces_of(word);
        for (std::size_t i = 0; i < pieces.size(); ++i) result += (i > 0 ? kBreak : "") + escaped_markdown(pieces[i]);
    }
    return result;
}

std::string MarkedText::emphasised(const std::string& text) const {
    const std::string inner = plain(text);
    return inner.empty() ? "" : "*" + inner + "*";
}

std::string MarkedText::marked(const Passage& passage, std::size_t most_words) const {
    std::string result;
    std::size_t shown = 0;
    for (const MarkedWords& piece : passage.pieces) {
        std::vector<std::string> words = words_between_spaces(printable_words(piece.text));
        if (words.empty()) continue;
        const std::size_t room = most_words - std::min(shown, most_words);
        if (room == 0) return result + " [… more has changed here]";
        result += result.empty() ? "" : " ";
        if (piece.mark == '=') {
            const bool shortened = words.size() > 2 * kShownEndWords + 4;
            result += shortened ? plain(joined(words, 0, kShownEndWords)) + " … " +
                                      plain(joined(words, words.size() - kShownEndWords, words.size()))
                                : plain(piece.text);
            shown += std::min(words.size(), 2 * kShownEndWords);
            continue;
        }
        const std::size_t left_out = words.size() > room ? words.size() - room : 0;
        words.resize(words.size() - left_out);
        shown += words.size();
        const char* const sign = piece.mark == '-' ? "~~" : "**";
        // What is struck out cannot be broken inside of a word: its pieces are struck out one by one.
        if (piece.mark == '+') {
            result += sign + plain(joined(words, 0, words.size())) + sign;
        } else {
            result += sign;
            for (std::size_t i = 0; i < words.size(); ++i) {
                const std::vector<std::string> pieces = pieces_of(words[i]);
                for (std::size_t k = 0; k < pieces.size(); ++k)
                    result += (k > 0   ? std::string(sign) + kBreak + sign
                               : i > 0 ? std::string(" ")
                                       : std::string()) +
                              escaped_markdown(pieces[k]);
            }
            result += sign;
        }
        if (left_out > 0) result += fmt::format(" [… {} more words {}]", left_out, piece.mark == '-' ? "gone" : "new");
    }
    return result;
}

std::string MarkedText::cell(const std::string& text, std::size_t most, std::size_t longest) const {
    std::string result;
    for (const std::string& word : words_between_spaces(printable(printable_words(text), most))) {
        const std::vector<std::string> characters = characters_of(word);
        result += result.empty() ? "" : " ";
        for (std::size_t i = 0; i < std::min(characters.size(), longest); ++i) result += characters[i];
        if (characters.size() > longest) result += "…";
    }
    return result;
}

std::string last_words(const std::string& text, std::size_t count) {
    const std::vector<std::string> words = words_between_spaces(text);
    if (words.size() <= count) return joined(words, 0, words.size());
    return "… " + joined(words, words.size() - count, words.size());
}

}  // namespace dynlab::inline course
