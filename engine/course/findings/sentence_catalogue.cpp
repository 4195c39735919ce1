#include "course/findings/sentence_catalogue.h"

#include <fmt/format.h>

#include <algorithm>

#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/text_file.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline course {
namespace {

std::vector<std::string> pieces_between_slots(const std::string& sentence) {
    std::vector<std::string> pieces;
    std::size_t start = 0;
    for (std::size_t slot; (slot = sentence.find("{}", start)) != sentence.npos; start = slot + 2)
        pieces.push_back(sentence.substr(start, slot - start));
    pieces.push_back(sentence.substr(start));
    return pieces;
}

bool ends_sentence(std::string_view text, std::size_t at) {
    return at == text.size() || text[at] == ' ';
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
        Entry entry{pieces_between_slots(sentence), pieces_between_slots(trimmed(line)), 0};
        if (entry.from.size() != entry.to.size()) fail("as many {} are wanted as in the sentence above");
        for (const std::string& piece : entry.from) entry.letters += piece.size();
        entries_.push_back(std::move(entry));
        sentence.clear();
    }
    if (!sentence.empty()) fail("the last sentence has no other language's below it");
}

std::optional<SentenceCatalogue::Fit> SentenceCatalogue::fit(const Entry& entry, std::string_view text) {
    if (!text.starts_with(entry.from.front())) return {};
    Fit found{&entry, {}, entry.from.front().size()};
    for (std::size_t i = 1; i < entry.from.size(); ++i) {
        const std::string& piece = entry.from[i];
        const bool last = i + 1 == entry.from.size();
        std::size_t at = last && piece.empty() ? text.size() : text.find(piece, found.end);
        while (last && at != text.npos && !ends_sentence(text, at + piece.size())) at = text.find(piece, at + 1);
        if (at == text.npos) return {};
        found.between.push_back(text.substr(found.end, at - found.end));
        found.end = at + piece.size();
    }
    if (!ends_sentence(text, found.end)) return {};
    return found;
}

std::optional<SentenceCatalogue::Fit> SentenceCatalogue::fitting(std::string_view text) const {
    std::optional<Fit> best;
    for (const Entry& entry : entries_) {
        if (best && entry.letters <= best->entry->letters) continue;
        if (auto found = fit(entry, text)) best = std::move(found);
    }
    return best;
}

bool SentenceCatalogue::knows(std::string_view sentence) const {
    const std::optional<Fit> found = fitting(sentence);
    return found && found->end == sentence.size();
}

std::string SentenceCatalogue::written(const Fit& found) const {
    std::string text = found.entry->to.front();
    for (std::size_t i = 0; i < found.between.size(); ++i) {
        const std::string_view between = found.between[i];
        const bool quoted = found.entry->from[i].ends_with('"');
        const std::optional<Fit> known = fitting(between);
        if (known && known->end == between.size())
            text += written(*known);
        else
            text += quoted ? std::string(between) : with_comma(std::string(between));
        text += found.entry->to[i + 1];
    }
    return text;
}

std::string SentenceCatalogue::translated(std::string_view text) const {
    std::string result;
    while (!text.empty()) {
        std::size_t end = 0;
        if (const std::optional<Fit> found = fitting(text)) {
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

SentenceCatalogue french_sentences(const std::string& lesson) {
    SentenceCatalogue sentences;
    sentences.add(shared_folder() / "report_templates" / "sentences.fr.txt");
    for (const Lesson& one : lessons()) {
        const std::filesystem::path file = one.folder / "checks.fr.txt";
        if (one.slug == lesson && std::filesystem::is_regular_file(file)) sentences.add(file);
    }
    return sentences;
}

}  // namespace dynlab::inline course
