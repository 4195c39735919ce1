#include "course/issues/text_issues.h"

#include <algorithm>

#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kMinTextSize = 9.5, kRounding = 0.05;  ///< points
constexpr double kSlideHeight = 96 * kPointsPerMm;
constexpr double kSide = 15 * kPointsPerMm, kTopAndBottom = 12 * kPointsPerMm;
constexpr int kManyAtSides = 5, kManyAtTop = 3;
constexpr std::size_t kEnoughLetters = 300;  ///< of prose on a page, required to check its size

double scale_of(const DocumentText& text) {
    return text.is_slides() && text.height > 0 ? kSlideHeight / text.height : 1;
}

/// Median size of a page's prose; 0 when it has next to none.
double prose_size(const DocumentText& text, int page) {
    std::vector<std::pair<double, std::size_t>> sizes;
    std::size_t letters = 0, passed = 0;
    for (const TextLine& line : text.lines) {
        if (line.page != page || !line.is_prose()) continue;
        sizes.emplace_back(line.size, line.text().size());
        letters += sizes.back().second;
    }
    if (letters < kEnoughLetters) return 0;
    std::sort(sizes.begin(), sizes.end());
    for (const auto& [size, count] : sizes) {
        passed += count;
        if (2 * passed >= letters) return size;
    }
    return 0;
}

MessageList list_of(const std::vector<int>& pages) {
    MessageList list;
    for (const int page : pages) list.items.push_back(Message("{}", page));
    return list;
}

Message too_small(double size, bool slides, const std::vector<int>& pages) {
    const Number found = decimals(size, 1);
    const MessageList where = list_of(pages);
    if (pages.size() == 1)
        return slides ? Message(
                            "The text size, measured on a slide 96 mm high, is only {} pt, but at least {} pt is "
                            "required.",
                            found, kMinTextSize)
                      : Message("The text size is only {} pt, but at least {} pt is required.", found, kMinTextSize);
    return slides ? Message(
                        "The text size, measured on a slide 96 mm high, is only {} pt (pages {}), but at least {} pt "
                        "is required.",
                        found, where, kMinTextSize)
                  : Message("The text size is only {} pt (pages {}), but at least {} pt is required.", found, where,
                            kMinTextSize);
}

void check_size(const DocumentText& text, int pages, Issues& findings) {
    std::vector<int> small;
    double smallest = kMinTextSize;
    for (int page = 1; page <= pages; ++page) {
        const double size = prose_size(text, page) * scale_of(text);
        if (size == 0 || size >= kMinTextSize - kRounding) continue;
        small.push_back(page);
        smallest = std::min(smallest, size);
    }
    if (small.empty()) return;
    findings.push_back(
        {"text-small", Severity::kRule, small.front(), "", too_small(smallest, text.is_slides(), small),
         Message("Use a text size of 11 pt, as in the template. If the document becomes too long, shorten the text.")});
}

struct OutsideLines {
    int at_sides = 0, at_top = 0;
    const TextLine* first = nullptr;
};

OutsideLines lines_outside_margins(const DocumentText& text, const PdfPage& page, int number) {
    OutsideLines unmatched_names;
    for (const TextLine& line : text.lines) {
        if (line.page != number) continue;
        const bool at_side = line.words.size() >= 3 && (line.left < kSide || line.right > page.width - kSide);
        const bool at_top = line.is_prose() && (line.top < kTopAndBottom || line.bottom > page.height - kTopAndBottom);
        unmatched_names.at_sides += at_side;
        unmatched_names.at_top += at_top;
        if (!unmatched_names.first && (at_side || at_top)) unmatched_names.first = &line;
    }
    return unmatched_names;
}

void check_margins(const DocumentText& text, const PdfLayout& layout, Issues& findings) {
    std::vector<int> narrow;
    Issues overflows;
    for (std::size_t i = 0; i < layout.pages.size(); ++i) {
        const int page = static_cast<int>(i) + 1;
        const OutsideLines unmatched_names = lines_outside_margins(text, layout.pages[i], page);
        if (unmatched_names.at_sides >= kManyAtSides || unmatched_names.at_top >= kManyAtTop) {
            narrow.push_back(page);
        } else if (unmatched_names.at_sides > 0) {
            overflows.push_back(
                {"text-overflow", Severity::kHint, page, "",
                 Message("A line extends into the margin: \"{}\".", printable(unmatched_names.first->text(), 60)),
                 Message("Break the formula, the table or the long word.")});
        }
    }
    if (!narrow.empty()) {
        findings.push_back(
            {"margins", Severity::kRule, narrow.front(), "",
             narrow.size() > 1 ? Message("The margins are too narrow (pages {}): the text is closer "
                                         "than 15 mm to the sides or 12 mm to the top or bottom.",
                                         list_of(narrow))
                               : Message("The margins are too narrow: the text is closer than 15 mm to "
                                         "the sides or 12 mm to the top or bottom."),
             Message("Use the template's margins of 25 mm. If the document becomes too long, shorten the text.")});
    }
    findings.insert(findings.end(), overflows.begin(), overflows.end());
}

void check_edges(const PdfLayout& layout, Issues& findings) {
    for (std::size_t i = 0; i < layout.pages.size(); ++i) {
        const PdfPage& page = layout.pages[i];
        const auto cut = std::find_if(page.words.begin(), page.words.end(), [&page](const PdfWord& word) {
            return word.left < -1 || word.top < -1 || word.right > page.width + 1 || word.bottom > page.height + 1;
        });
        if (cut == page.words.end()) continue;
        findings.push_back(
            {"text-cut-off", Severity::kRule, static_cast<int>(i) + 1, "",
             Message("Text extends beyond the edge of the page and is cut off near \"{}\".", printable(cut->text, 40)),
             Message("Break or shorten the long part.")});
    }
}

}  // namespace

Issues layout_findings(const DocumentText& text, const PdfLayout& layout) {
    Issues findings;
    check_size(text, static_cast<int>(layout.pages.size()), findings);
    if (!text.is_slides()) check_margins(text, layout, findings);
    check_edges(layout, findings);
    return findings;
}

}  // namespace dynlab::inline course
