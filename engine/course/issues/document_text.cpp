#include "course/issues/document_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr double kHeadingSize = 1.12;  ///< a heading's size over that of the prose when it is not bold
constexpr double kWordGap = 0.2;       ///< of the size: more is a space, whether the file says so or not
constexpr std::size_t kMaxHeadingWords = 14;

std::size_t letters_in(const std::string& text) {
    const std::string plain = folded(text);
    return static_cast<std::size_t>(std::ranges::count_if(plain, [](unsigned char c) { return std::isalpha(c); }));
}

/// Collects the words of one line.
class LineMaker {
  public:
    bool takes(const PdfWord& word) const {
        if (line_.words.empty()) return true;
        const double height = std::max(line_.bottom - line_.top, word.bottom - word.top);
        const double center = (word.top + word.bottom) / 2, line_center = (line_.top + line_.bottom) / 2;
        const double gap = word.left - line_.right, size = std::max(word.size, line_.size);
        return std::abs(center - line_center) < 0.5 * height && gap > -size && gap < 2.5 * size;
    }

    void add(const PdfWord& word, const std::string& text, int page) {
        const bool first = line_.words.empty();
        const bool apart = first || space_before_ || word.left - line_.right > kWordGap * word.size;
        if (first) {
            line_.page = page;
            line_.left = word.left;
            line_.top = word.top;
            line_.bottom = word.bottom;
        }
        line_.left = std::min(line_.left, word.left);
        line_.right = std::max(line_.right, word.right);
        line_.top = std::min(line_.top, word.top);
        line_.bottom = std::max(line_.bottom, word.bottom);
        if (apart)
            line_.words.push_back(text);
        else
            line_.words.back() += text;
        space_before_ = word.space_after;
        const double letters = static_cast<double>(text.size());
        letters_ += letters;
        sizes_ += letters * word.size;
        bold_ += word.bold ? letters : 0;
        fixed_ += word.fixed_width ? letters : 0;
        line_.size = sizes_ / letters_;
    }

    void finish(std::vector<TextLine>& lines) {
        if (!line_.words.empty()) {
            line_.bold = bold_ > 0.8 * letters_;
            line_.fixed_width = fixed_ > 0.5 * letters_;
            lines.push_back(std::move(line_));
        }
        *this = LineMaker();
    }

  private:
    TextLine line_;
    bool space_before_ = true;
    double letters_ = 0, sizes_ = 0, bold_ = 0, fixed_ = 0;
};

bool is_page_number(const TextLine& line, const PdfPage& page) {
    if (line.bottom > 0.08 * page.height && line.top < 0.87 * page.height) return false;
    const std::string text = folded(line.text());
    return std::ranges::all_of(text, [](unsigned char c) { return !std::isalpha(c); });
}

/// A word that holds no-break spaces is several.
std::vector<std::string> parts_of_word(const std::string& text) {
    std::vector<std::string> parts(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "\u00A0") == 0) {
            parts.emplace_back();
            ++i;
        } else {
            parts.back() += text[i];
        }
    }
    std::erase(parts, "");
    return parts;
}

std::vector<TextLine> lines_of_page(const PdfPage& page, int number) {
    std::vector<TextLine> lines;
    LineMaker line;
    for (const PdfWord& word : page.words) {
        if (word.rotated) continue;
        if (!line.takes(word)) line.finish(lines);
        const std::vector<std::string> parts = parts_of_word(word.text);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            PdfWord part = word;
            part.space_after = word.space_after || i + 1 < parts.size();
            line.add(part, parts[i], number);
        }
    }
    line.finish(lines);
    std::erase_if(lines, [&page](const TextLine& one) { return is_page_number(one, page); });
    return lines;
}

/// The smallest size: the size of the prose if the document contains only headings.
double smallest_size(const std::vector<TextLine>& lines) {
    const auto smaller = [](const TextLine& a, const TextLine& b) { return a.size < b.size; };
    const auto smallest = std::ranges::min_element(lines, smaller);
    return smallest == lines.end() ? 0 : smallest->size;
}

/// Median size, each line counting with its letters; of prose, or of all text when there is next to no prose (slides).
/// Bold lines are headings.
double median_size(const std::vector<TextLine>& lines) {
    std::vector<std::pair<double, double>> prose, all;
    double prose_letters = 0, all_letters = 0;
    for (const TextLine& line : lines) {
        if (line.fixed_width || line.bold) continue;
        const double letters = static_cast<double>(line.text().size());
        all.emplace_back(line.size, letters);
        all_letters += letters;
        if (!line.is_prose()) continue;
        prose.emplace_back(line.size, letters);
        prose_letters += letters;
    }
    const bool enough = prose_letters > 0.3 * all_letters;
    std::vector<std::pair<double, double>>& sizes = enough ? prose : all;
    std::ranges::sort(sizes);
    double passed = 0;
    for (const auto& [size, letters] : sizes) {
        passed += letters;
        if (2 * passed >= (enough ? prose_letters : all_letters)) return size;
    }
    return smallest_size(lines);
}

bool looks_like_heading(const TextLine& line, double body_size) {
    if (line.fixed_width || line.words.size() > kMaxHeadingWords || letters_in(line.text()) < 3) return false;
    return line.size > kHeadingSize * body_size || (line.bold && line.size > 0.95 * body_size);
}

std::vector<Heading> find_headings(const std::vector<TextLine>& lines, double body_size) {
    std::vector<Heading> headings;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const TextLine& line = lines[i];
        if (!looks_like_heading(line, body_size)) continue;
        const bool goes_on = !headings.empty() && headings.back().last_line + 1 == i &&
                             headings.back().page == line.page && std::abs(headings.back().size - line.size) < 0.3 &&
                             line.top - lines[i - 1].bottom < 0.6 * line.size;
        if (goes_on) {
            headings.back().text += " " + line.text();
            headings.back().last_line = i;
        } else {
            headings.push_back({line.page, line.size, line.text(), i, i});
        }
    }
    return headings;
}

/// The first heading of the document is its title when it is larger than all others.
void drop_title(std::vector<Heading>& headings) {
    if (headings.size() < 2) return;
    const bool largest = std::all_of(headings.begin() + 1, headings.end(),
                                     [&](const Heading& other) { return other.size < headings.front().size - 0.5; });
    if (largest) headings.erase(headings.begin());
}

std::vector<TextWord> running_text(const std::vector<TextLine>& lines) {
    std::vector<TextWord> words;
    bool hyphenated = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const TextLine& line = lines[i];
        if (line.fixed_width) continue;
        for (std::size_t k = 0; k < line.words.size(); ++k) {
            if (hyphenated)
                words.back().text += line.words[k];
            else
                words.push_back({line.words[k], line.page, i, k == 0});
            std::string& text = words.back().text;
            hyphenated = k + 1 == line.words.size() && text.size() > 2 && text.back() == '-';
            if (hyphenated) text.pop_back();
        }
    }
    return words;
}

}  // namespace

std::string TextLine::text() const {
    std::string joined;
    for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
    return joined;
}

DocumentText text_of_layout(const PdfLayout& layout) {
    DocumentText document;
    if (layout.pages.empty()) return document;
    document.width = layout.pages.front().width;
    document.height = layout.pages.front().height;
    int number = 0;
    for (const PdfPage& page : layout.pages) {
        std::vector<TextLine> lines = lines_of_page(page, ++number);
        std::move(lines.begin(), lines.end(), std::back_inserter(document.lines));
    }
    document.body_size = median_size(document.lines);
    document.headings = find_headings(document.lines, document.body_size);
    drop_title(document.headings);
    document.words = running_text(document.lines);
    return document;
}

}  // namespace dynlab::inline course
