#include "documents/words/sentence_catalogue.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline documents {
namespace {

constexpr std::size_t kLongestWithin = 1000;  // of a sentence within another
constexpr std::size_t kMostNames = 3;         // of functions in front of a sentence

/// A sentence between its places, which are {}, {n} or {s}.
struct Pieces {
    std::vector<std::string> words;
    std::string places;  ///< ' ', 'n' or 's'
};

Pieces sentence_pieces(const std::string& sentence) {
    Pieces pieces;
    std::size_t start = 0;
    for (std::size_t at = 0; (at = sentence.find('{', at)) != sentence.npos; ++at) {
        const std::string_view rest = std::string_view(sentence).substr(at);
        const bool of_kind = rest.starts_with("{n}") || rest.starts_with("{s}");
        if (!of_kind && !rest.starts_with("{}")) continue;
        pieces.words.push_back(sentence.substr(start, at - start));
        pieces.places += of_kind ? rest[1] : ' ';
        start = at + (of_kind ? 3 : 2);
    }
    pieces.words.push_back(sentence.substr(start));
    return pieces;
}

/// "7", "-2", "2.15", "8e+03".
bool is_number(std::string_view text) {
    return text.find_first_of("0123456789") <= 1 && text.find_first_not_of("0123456789.e+-") == text.npos;
}

/// A name in quotation marks is the script's, even where a word of the program is the same.
bool is_script_name(std::string_view text) {
    return text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == text.npos;
}

/// Whether what follows these words of a sentence stands in quotation marks.
bool is_quoted(const std::string& before) {
    return before.ends_with('"') || before.ends_with('\'');
}

/// Initials, as in "A. Martin", end none.
bool holds_sentence_end(std::string_view text) {
    for (std::size_t at = 0; (at = text.find(". ", at)) != text.npos; ++at)
        if (at > 0 && (text[at - 1] < 'A' || text[at - 1] > 'Z')) return true;
    return false;
}

/// Words that stand for themselves only, such as "a vector", are no beginning of a sentence.
bool ends_with_sign(std::string_view text) {
    return text.find_last_of(".?!:;") == text.size() - 1;
}

bool ends_sentence(std::string_view text, std::size_t at) {
    return at == text.size() || text[at] == ' ';
}

/// How much of a text is file and line of a script's message; 0 for other texts.
std::size_t place_in_script(std::string_view text) {
    static const RE2 place(R"([^\s:]+(?::\d+|, cell \d+, line \d+): )", RE2::Latin1);
    re2::StringPiece rest = text;
    RE2::Consume(&rest, place);
    return text.size() - rest.size();
}

/// How much of a text is the name of the function that says the rest: "fit: ..."; 0 where it begins with none.
std::size_t function_name(std::string_view text) {
    constexpr const char* kOfNames = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_.0123456789";
    const std::size_t end = std::min(text.find_first_not_of(kOfNames), text.size());
    const bool begins = end > 0 && text[0] != '.' && (text[0] < '0' || text[0] > '9');
    return begins && text.substr(end).starts_with(": ") ? end + 2 : 0;
}

/// The number that a text begins with gets a comma; what follows it, a unit or an exponent, stays.
std::string with_comma(std::string text) {
    constexpr const char* kDigits = "0123456789";
    const std::size_t begin = text.starts_with('-') ? 1 : 0;
    const std::size_t point = std::min(text.find_first_not_of(kDigits, begin), text.size());
    const std::size_t end = std::min(text.find_first_not_of(kDigits, point + 1), text.size());
    if (point == begin || end <= point + 1 || text[point] != '.') return text;
    const std::string rest = text.substr(end);
    const bool exponent = rest.size() > 1 && rest[0] == 'e' && rest.find_first_of("+-0123456789", 1) == 1;
    if (rest.empty() || rest[0] == ' ' || rest[0] == '%' || exponent) text[point] = ',';
    return text;
}

/// Where the sentence of a program's line begins.
std::size_t behind_program_name(std::string_view line) {
    for (const std::string_view begin : {"dynlab: note: ", "dynlab: "})
        if (line.starts_with(begin)) return begin.size();
    return 0;
}

SentenceCatalogue sentences_of(std::initializer_list<const char*> files) {
    SentenceCatalogue sentences;
    for (const char* file : files) sentences.add(shared_folder() / "report_templates" / file);
    return sentences;
}

}  // namespace

void SentenceCatalogue::add(const std::filesystem::path& file) {
    std::string sentence;
    int number = 0;
    const auto fail = [&](const char* what) {
        throw EnvironmentError(fmt::format("{}:{}: {}", file.string(), number, what));
    };
    for (const std::string& line : lines_of(read_text(file))) {
        ++number;
        if (trimmed(line).empty() || line.starts_with('#')) continue;
        const bool other = line.starts_with(' ');
        if (other && sentence.empty()) fail("no sentence stands above this one");
        if (!other && !sentence.empty()) fail("the sentence above has no other language's below it");
        if (!other) {
            sentence = trimmed(line);
            continue;
        }
        Pieces from = sentence_pieces(sentence);
        Entry entry{std::move(from.words), sentence_pieces(trimmed(line)).words, std::move(from.places), 0};
        if (entry.from.size() != entry.to.size()) fail("as many {} are wanted as in the sentence above");
        for (const std::string& piece : entry.from) entry.letters += piece.size();
        entries_.push_back(std::move(entry));
        sentence.clear();
    }
    if (!sentence.empty()) fail("the last sentence has no other language's below it");
}

bool SentenceCatalogue::may_stand_for(char place, std::string_view text) const {
    if (place == 'n') return is_number(text);
    return place != 's' ||
           (text.size() <= kLongestWithin && behind_names(text.substr(place_in_script(text))).sentence.has_value());
}

std::optional<SentenceCatalogue::Fit> SentenceCatalogue::fit(const Entry& entry, std::string_view text) const {
    if (!text.starts_with(entry.from.front())) return {};
    Fit found{&entry, {}, entry.from.front().size()};
    for (std::size_t i = 1; i < entry.from.size(); ++i) {
        const std::string& piece = entry.from[i];
        const bool last = i + 1 == entry.from.size();
        std::size_t at = last && piece.empty() ? text.size() : text.find(piece, found.end);
        while (last && at != text.npos && !ends_sentence(text, at + piece.size())) at = text.find(piece, at + 1);
        if (at == text.npos) return {};
        const std::string_view between = text.substr(found.end, at - found.end);
        const bool open_end = last && piece.empty();
        if (!open_end && !is_quoted(entry.from[i - 1]) && holds_sentence_end(between)) return {};
        if (!may_stand_for(entry.places[i - 1], between)) return {};
        found.between.push_back(between);
        found.end = at + piece.size();
    }
    if (!ends_sentence(text, found.end)) return {};
    return found;
}

std::optional<SentenceCatalogue::Fit> SentenceCatalogue::fitting(std::string_view text, Extent extent) const {
    std::optional<Fit> best;
    for (const Entry& entry : entries_) {
        if (best && entry.letters <= best->entry->letters) continue;
        auto found = fit(entry, text);
        if (!found) continue;
        const bool is_all = found->end == text.size();
        if (is_all || (extent == Extent::kFirstSentence && ends_with_sign(text.substr(0, found->end))))
            best = std::move(found);
    }
    return best;
}

bool SentenceCatalogue::knows(std::string_view sentence) const {
    return fitting(sentence, Extent::kAll).has_value();
}

/// The sentence behind the names of functions that say it, of which the first is never a part of it: behind all of
/// them, or else fewer, as "roots: ..." is an entry.
SentenceCatalogue::Named SentenceCatalogue::behind_names(std::string_view text) const {
    std::vector<std::size_t> ends;
    for (std::size_t end = 0, name; ends.size() < kMostNames && (name = function_name(text.substr(end))) > 0;)
        ends.push_back(end += name);
    if (ends.empty()) return {0, fitting(text, Extent::kAll)};
    for (; !ends.empty(); ends.pop_back())
        if (std::optional<Fit> found = fitting(text.substr(ends.back()), Extent::kAll)) return {ends.back(), found};
    return {};
}

std::string SentenceCatalogue::told_line(std::string_view message) const {
    const std::size_t place = place_in_script(message);
    const std::string_view said = message.substr(place);
    const auto [names, found] = behind_names(said);
    std::string told(message.substr(0, place));
    static const RE2 kCell(R"((cell \d+, line \d+))", RE2::Latin1);  // of a notebook
    if (std::string words; RE2::PartialMatch(told, kCell, &words))
        if (const std::optional<Fit> known = fitting(words, Extent::kAll))
            told = replaced(told, words, written(*known));
    return told + std::string(said.substr(0, names)) + (found ? written(*found) : std::string(said.substr(names)));
}

std::string SentenceCatalogue::written(const Fit& found) const {
    std::string text = found.entry->to.front();
    for (std::size_t i = 0; i < found.between.size(); ++i) {
        const std::string_view between = found.between[i];
        const std::string& before = found.entry->from[i];
        const bool quoted = is_quoted(before);
        const bool of_script = place_in_script(between) > 0;
        const bool sentence = found.entry->places[i] == 's';
        const std::optional<Fit> known = of_script || sentence ? std::nullopt : fitting(between, Extent::kAll);
        if (of_script || sentence)
            text += of_script ? translated(between) : told_line(between);
        else if (known && !(quoted && is_script_name(between)))
            text += written(*known);
        else
            text += quoted ? std::string(between) : with_comma(std::string(between));
        text += found.entry->to[i + 1];
    }
    return text;
}

std::string SentenceCatalogue::translated(std::string_view text) const {
    std::string result;
    if (place_in_script(text) > 0) {
        for (const std::string& line : lines_of(text)) result += (result.empty() ? "" : "\n") + told_line(line);
        return result;
    }
    while (!text.empty()) {
        std::size_t end = 0;
        if (const std::optional<Fit> found = fitting(text, Extent::kFirstSentence)) {
            result += written(*found);
            end = found->end;
        } else {
            end = std::min(text.find(". "), text.size() - 1) + 1;
            result += text.substr(0, end);
        }
        if (end < text.size()) result += text[end++];
        text.remove_prefix(end);
    }
    return result;
}

std::string SentenceCatalogue::translated_lines(std::string_view printed) const {
    std::string told;
    for (const std::string& line : lines_of(printed)) {
        const std::size_t sentence = behind_program_name(line);
        told += (told.empty() ? "" : "\n") + line.substr(0, sentence) + translated(line.substr(sentence));
    }
    return told;
}

const SentenceCatalogue& shared_french_sentences() {
    static const SentenceCatalogue sentences = sentences_of({"sentences.fr.txt", "script_errors.fr.txt"});
    return sentences;
}

const SentenceCatalogue& french_option_words() {
    static const SentenceCatalogue words = sentences_of({"option_words.fr.txt"});
    return words;
}

namespace {

std::filesystem::path& given_engine_sentences() {
    static std::filesystem::path file;
    return file;
}

SentenceCatalogue engine_sentences() {
    SentenceCatalogue sentences;
    const std::filesystem::path& given = given_engine_sentences();
    sentences.add(given.empty() ? file_of_french_engine_sentences() : given);
    return sentences;
}

}  // namespace

const SentenceCatalogue& french_engine_sentences() {
    static const SentenceCatalogue sentences = engine_sentences();
    return sentences;
}

void read_french_engine_sentences_from(const std::filesystem::path& file) {
    given_engine_sentences() = file;
}

std::filesystem::path file_of_french_engine_sentences() {
    return shared_folder() / "report_templates" / "engine_sentences.fr.txt";
}

}  // namespace dynlab::inline documents
