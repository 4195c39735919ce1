#include "course/issues/text_issues.h"

#include <algorithm>
#include <optional>
#include <set>

#include "base/message.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kEmptySectionWords = 5, kShortSectionWords = 25, kShortSlideWords = 8;  ///< words below a heading
constexpr double kMarginOfPage = 0.25;  ///< what a page may stay short of

bool is_filler(const std::string& word) {
    static const std::set<std::string> fillers = {"the", "of", "and", "a",   "an", "in", "on", "for", "de",  "du",
                                                  "des", "la", "le",  "les", "l",  "d",  "et", "un",  "une", "en"};
    return fillers.contains(word);
}

/// Words that carry the meaning of a heading; a number before it does not.
std::vector<std::string> key_words(const std::string& title) {
    std::vector<std::string> words = plain_words(title);
    std::erase_if(words, [](const std::string& word) {
        return is_filler(word) || word.find_first_not_of("0123456789") == std::string::npos;
    });
    return words;
}

/// "conclusion" and "conclusions", "data" and "dataset".
bool same_word(const std::string& requested, const std::string& given) {
    for (const char* ending : {"", "s", "es", "x", "set", "sets"}) {
        if (given == requested + ending || requested == given + ending) return true;
    }
    return false;
}

/// How well a heading fits a title, 0 to 1: most of the title's words must be there, the fewer others the better.
double likeness(const std::string& title, const std::string& heading) {
    const std::vector<std::string> requested = key_words(title), given = key_words(heading);
    const auto found = std::ranges::count_if(requested, [&](const std::string& word) {
        return std::ranges::any_of(given, [&](const std::string& other) { return same_word(word, other); });
    });
    if (2 * found <= static_cast<std::ptrdiff_t>(requested.size())) return 0;
    return 2 * static_cast<double>(found) / static_cast<double>(requested.size() + given.size());
}

double likeness(const SectionRule& section, const std::string& heading) {
    return std::max(likeness(section.english, heading), likeness(section.french, heading));
}

std::optional<std::size_t> find_section(const SectionRule& section, const std::vector<Heading>& headings) {
    std::optional<std::size_t> found;
    double best = 0;
    for (std::size_t i = 0; i < headings.size(); ++i) {
        const double like = likeness(section, headings[i].text);
        if (like > best) {
            best = like;
            found = i;
        }
    }
    return found;
}

/// Words below a heading, down to the next one that is not smaller.
std::size_t words_below(const DocumentText& text, std::size_t index) {
    const Heading& heading = text.headings[index];
    std::size_t end = text.lines.size();
    for (std::size_t i = index + 1; i < text.headings.size(); ++i) {
        if (text.headings[i].size > heading.size - 0.3) {
            end = text.headings[i].first_line;
            break;
        }
    }
    std::size_t words = 0;
    for (std::size_t i = heading.last_line + 1; i < end; ++i) {
        for (const std::string& word : text.lines[i].words) words += !plain_words(word).empty();
    }
    return words;
}

bool opens_appendix(const Heading& heading, const DocumentRules& rules) {
    const std::vector<std::string> words = plain_words(heading.text);
    for (const char* sign : {"appendix", "appendices", "annex", "annexe", "annexes"}) {
        if (std::ranges::find(words, sign) != words.end()) return true;
    }
    return std::ranges::any_of(rules.sections, [&](const SectionRule& section) {
        return section.optional && likeness(section, heading.text) > 0.6;
    });
}

/// Pages that the text fills, the last one up to its lowest line.
double filled_pages(const DocumentText& text, int pages) {
    double lowest = 0;
    for (const TextLine& line : text.lines)
        if (line.page == pages) lowest = std::max(lowest, line.bottom);
    return pages - 1 + (text.height > 0 ? lowest / text.height : 1);
}

Issues too_few_pages(const DocumentText& text, int pages, const DocumentRules& rules) {
    if (!rules.least_pages || filled_pages(text, pages) > *rules.least_pages - kMarginOfPage) return {};
    const Number filled = decimals(filled_pages(text, pages), 1);
    return {{"pages-few", Severity::kHint, pages, "",
             *rules.least_pages == 1
                 ? Message("The text fills {} pages; at least {} page is required.", filled, 1)
                 : Message("The text fills {} pages; at least {} pages are required.", filled, *rules.least_pages),
             Message("Give reasons and locations in the report, and suggest a remedy for each weakness.")}};
}

Message pages_of_paper(int count) {
    return plural(count, "{} page", "{} pages");
}

Message slides(int count) {
    return plural(count, "{} slide", "{} slides");
}

Message too_many(Message (*counted)(int), int pages, int allowed, int in_appendix) {
    if (in_appendix > 0)
        return Message("The document has {}; at most {}, and {} in the appendix, are allowed.", counted(pages),
                       counted(allowed), counted(in_appendix));
    return allowed == 1 ? Message("The document has {}; at most {} is allowed.", counted(pages), counted(allowed))
                        : Message("The document has {}; at most {} are allowed.", counted(pages), counted(allowed));
}

}  // namespace

Issues section_findings(const DocumentText& text, const DocumentRules& rules, const std::string& language) {
    Issues findings;
    for (const SectionRule& section : rules.sections) {
        const std::string title = section.title(language);
        const auto found = find_section(section, text.headings);
        if (!found) {
            if (section.optional) continue;
            findings.push_back({"section-missing", Severity::kRule, 0, "",
                                Message("The section \"{}\" is missing: no heading has this text.", title),
                                Message("Add this heading and write your text below it.")});
            continue;
        }
        const Heading& heading = text.headings[*found];
        const std::string shown = printable(heading.text, 60);
        const std::size_t words = words_below(text, *found);
        const auto expected = text.is_slides() ? kShortSlideWords : kShortSectionWords;
        if (words < kEmptySectionWords) {
            findings.push_back({"section-empty", Severity::kRule, heading.page, "",
                                Message("The section \"{}\" is empty or nearly empty.", shown),
                                section.optional
                                    ? Message("Write the section, or remove its heading: the section is optional.")
                                    : Message("Describe your work and your results.")});
        } else if (words < expected) {
            findings.push_back(
                {"section-short", Severity::kHint, heading.page, "",
                 Message("The section \"{}\" has {} words, but at least {} are expected.", shown, words, expected),
                 Message("Describe your work, the reasons for it, and the result.")});
        }
    }
    return findings;
}

Issues page_findings(const DocumentText& text, int pages, const DocumentRules& rules) {
    if (!rules.pages) return {};
    const int allowed = *rules.pages, in_appendix = rules.appendix_pages.value_or(0);
    int appendix = 0;  // the page on which it begins
    for (const Heading& heading : text.headings) {
        if (appendix == 0 && in_appendix > 0 && opens_appendix(heading, rules)) appendix = heading.page;
    }
    const int max_pages = allowed + (appendix > 0 ? in_appendix : 0);
    if (pages <= max_pages) return too_few_pages(text, pages, rules);
    return {{"pages", Severity::kRule, max_pages + 1, "",
             too_many(text.is_slides() ? slides : pages_of_paper, pages, allowed, in_appendix),
             in_appendix > 0 && appendix == 0
                 ? Message("Shorten the text, or move the excess parts to a section with the heading \"Appendix\".")
                 : Message("Shorten the text, or remove figures that add no information.")}};
}

}  // namespace dynlab::inline course
