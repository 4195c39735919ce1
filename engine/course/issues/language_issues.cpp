#include "course/issues/text_issues.h"

#include <algorithm>
#include <set>

#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kWindow = 30;      ///< words that are looked at together
constexpr int kForeignPassageWords = 6;  ///< function words of the other language among them that make a passage
constexpr int kKnownLanguageWords = 15;  ///< function words a document needs for its language to be known
constexpr std::size_t kMaxForeignPassages = 5;

// Words that both languages have ("on", "or", "son", "a", "plus"...) are left out.
const std::set<std::string> kEnglishWords = {
    "the",   "of",      "and",  "is",    "are",  "was",    "were",  "to",    "that",  "this",
    "these", "those",   "with", "for",   "by",   "from",   "which", "we",    "it",    "its",
    "be",    "been",    "has",  "have",  "had",  "than",   "then",  "when",  "where", "because",
    "into",  "between", "both", "only",  "our",  "their",  "they",  "there", "not",   "can",
    "does",  "how",     "what", "while", "such", "should", "would", "at",    "more",  "each"};
const std::set<std::string> kFrenchWords = {
    "le",   "la",    "les",  "des",  "du",   "de",   "et",   "est",   "sont",  "etait", "une",   "un",   "dans",
    "pour", "que",   "qui",  "avec", "sur",  "par",  "ce",   "cette", "ces",   "nous",  "aux",   "au",   "il",
    "elle", "ne",    "pas",  "se",   "ses",  "leur", "dont", "comme", "entre", "aussi", "ainsi", "mais", "donc",
    "ete",  "avons", "deux", "etre", "sans", "sous", "ou",   "nos",   "notre", "cela",  "tres",  "meme", "chaque"};

enum class Language { kUnknown, kEnglish, kFrench };

Language language_of(const std::string& word) {
    Language language = Language::kUnknown;
    for (const std::string& part : plain_words(word)) {
        if (kEnglishWords.contains(part)) language = Language::kEnglish;
        if (kFrenchWords.contains(part)) language = Language::kFrench;
    }
    return language;
}

std::string quote(const DocumentText& text, std::size_t from, std::size_t count) {
    std::string words;
    for (std::size_t i = from; i < std::min(from + count, text.words.size()); ++i)
        words += (words.empty() ? "" : " ") + text.words[i].text;
    return printable(words, 80);
}

/// The language of each word. Quotations and titles, « … » or “ … ”, keep the language they are in; what is not closed
/// soon is no quotation.
std::vector<Language> word_languages(const DocumentText& text) {
    constexpr std::size_t kMaxQuotationWords = 60;  // words
    std::vector<Language> languages;
    std::size_t opened = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.words.size(); ++i) {
        const std::string& word = text.words[i].text;
        languages.push_back(language_of(word));
        if (word.find("«") != std::string::npos || word.find("“") != std::string::npos) {
            quoted = true;
            opened = i;
        }
        if (!quoted || (word.find("»") == std::string::npos && word.find("”") == std::string::npos)) continue;
        if (i - opened <= kMaxQuotationWords)
            std::fill(languages.begin() + static_cast<std::ptrdiff_t>(opened), languages.end(), Language::kUnknown);
        quoted = false;
    }
    return languages;
}

/// Passages whose function words are those of `other`, one a page.
Issues passages(const DocumentText& text, const std::vector<Language>& languages, Language other) {
    Issues findings;
    int foreign = 0, own = 0, last_page = 0;
    const auto count = [&](std::size_t i, int change) {
        foreign += languages[i] == other ? change : 0;
        own += languages[i] != other && languages[i] != Language::kUnknown ? change : 0;
    };
    for (std::size_t end = 0; end < languages.size(); ++end) {
        count(end, 1);
        if (end >= kWindow) count(end - kWindow, -1);
        if (foreign < kForeignPassageWords || foreign < 3 * own || findings.size() >= kMaxForeignPassages) continue;
        std::size_t start = end + 1 - std::min(end + 1, kWindow);
        while (languages[start] != other) ++start;
        if (text.words[start].page == last_page) continue;
        last_page = text.words[start].page;
        const std::string passage = quote(text, start, 8) + " …";
        findings.push_back(
            {"language-mixed", Severity::kHint, last_page, "",
             other == Language::kEnglish
                 ? Message("The document is in French, but this passage seems to be in English: \"{}\".", passage)
                 : Message("The document is in English, but this passage seems to be in French: \"{}\".", passage),
             Message("Write the whole report in one language.")});
    }
    return findings;
}

}  // namespace

LanguageFindings language_findings(const DocumentText& text, const std::optional<std::string>& declared) {
    const std::vector<Language> languages = word_languages(text);
    const auto english = std::count(languages.begin(), languages.end(), Language::kEnglish);
    const auto french = std::count(languages.begin(), languages.end(), Language::kFrench);
    if (english + french < kKnownLanguageWords) return {};
    const bool is_french = french > english;
    LanguageFindings result{is_french ? "fr" : "en", {}};
    if (declared && *declared != result.language) {
        result.findings.push_back(
            {"language-differs", Severity::kHint, 0, "",
             is_french ? Message("The header specifies lang: {}, but the text is in French.", *declared)
                       : Message("The header specifies lang: {}, but the text is in English.", *declared),
             Message("Write lang: {} in the header of report.md. The language determines the hyphenation and the words "
                     "for figure and table.",
                     result.language)});
    }
    const Issues mixed = passages(text, languages, is_french ? Language::kEnglish : Language::kFrench);
    result.findings.insert(result.findings.end(), mixed.begin(), mixed.end());
    return result;
}

}  // namespace dynlab::inline course
