#include "course/review/report_text.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "platform/text/plain_words.h"
#include "course/review/text_blocks.h"
#include "documents/text_lines.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMostSentences = 20'000;

bool is_decimal_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c));
}

constexpr std::string_view kSpaces[] = {" ", "\t", ".", "\u00A0", "\u2002"};

std::string without_space_before(std::string_view text) {
    for (bool more = true; more;) {
        more = false;
        for (const std::string_view space : kSpaces) {
            if (!text.starts_with(space)) continue;
            text.remove_prefix(space.size());
            more = true;
        }
    }
    return std::string(text);
}

/// "2.1" of "2.1 Raw data"; empty where the title begins with no number.
std::string number_before_title(const std::string& line) {
    std::size_t end = 0;
    while (end < line.size() && (is_decimal_digit(line[end]) || (end > 0 && line[end] == '.'))) ++end;
    while (end > 0 && line[end - 1] == '.') --end;
    const std::string rest = without_space_before(std::string_view(line).substr(end));
    const bool parted = rest.size() < line.size() - end;
    return end > 0 && end < 12 && parted && !rest.empty() ? line.substr(0, end) : "";
}

/// Builds a ReportText from headings and paragraphs in their order.
class TextMaker {
  public:
    TextMaker() { text_.sections.emplace_back(); }

    void heading(const std::string& line, int page) {
        ReportSection section;
        section.number = number_before_title(line);
        section.title = line.substr(section.number.size());
        if (!section.number.empty()) section.title = without_space_before(section.title);
        text_.sections.push_back(section);
        add({section.title, text_.sections.size() - 1, page, true, {}});
    }

    void paragraph(const std::string& words, int page) {
        for (std::string& sentence : sentences_of(words)) unit(std::move(sentence), page);
    }

    void unit(std::string sentence, int page) {
        text_.sections.back().words += static_cast<int>(words_between_spaces(sentence).size());
        add({std::move(sentence), text_.sections.size() - 1, page, false, {}});
    }

    std::size_t count() const { return text_.sentences.size(); }

    void set_part_of(const std::string& caption, std::size_t from) {
        for (std::size_t i = from; i < text_.sentences.size(); ++i) text_.sentences[i].part_of = caption;
    }

    /// Without a first section that holds nothing.
    ReportText finished() {
        const bool empty = text_.sections.size() > 1 &&
                           std::none_of(text_.sentences.begin(), text_.sentences.end(),
                                        [](const ReportSentence& sentence) { return sentence.section == 0; });
        if (empty) {
            text_.sections.erase(text_.sections.begin());
            for (ReportSentence& sentence : text_.sentences) --sentence.section;
        }
        return std::move(text_);
    }

  private:
    void add(ReportSentence sentence) {
        if (text_.sentences.size() < kMostSentences && !is_blank(sentence.text))
            text_.sentences.push_back(std::move(sentence));
    }
    ReportText text_;
};

/// Markdown without its marks: emphasis, code, escapes. Formulas stay as they are.
std::string without_marks(const std::string& markdown) {
    std::string text;
    bool in_formula = false;
    for (std::size_t i = 0; i < markdown.size(); ++i) {
        const char c = markdown[i];
        if (c == '\\' && !in_formula && i + 1 < markdown.size() &&
            std::ispunct(static_cast<unsigned char>(markdown[i + 1]))) {
            text += markdown[++i];
            continue;
        }
        if (c == '$') in_formula = !in_formula || (i + 1 < markdown.size() && markdown[i + 1] == '$');
        if (in_formula && c == '$' && i + 1 < markdown.size() && markdown[i + 1] == '$') {
            const std::size_t end = markdown.find("$$", i + 2);
            const std::size_t stop = end == std::string::npos ? markdown.size() : end + 2;
            text += markdown.substr(i, stop - i);
            i = stop - 1;
            in_formula = false;
            continue;
        }
        if (in_formula || (c != '*' && c != '`')) text += c;
    }
    return replaced(text, "\u00A0", " ");
}

/// Reads the Markdown that our own writer makes, line by line.
class MarkdownReader {
  public:
    explicit MarkdownReader(const std::string& markdown) : lines_(lines_of(markdown)) {
        int top = 0, others = 0;
        bool in_code = false;
        for (const std::string& line : lines_) {
            if (line.starts_with("```")) in_code = !in_code;
            if (!in_code && line.starts_with('#')) ++(line.starts_with("# ") ? top : others);
        }
        has_title_ = top == 1 && others > 0;
    }

    ReportText run() {
        bool in_code = false;
        for (const std::string& line : lines_) {
            if (line.starts_with("```")) {
                flush();
                in_code = !in_code;
            } else if (in_code) {
                if (!is_blank(line)) maker_.unit(trimmed(line), 0);
            } else {
                take(line);
            }
        }
        flush();
        return maker_.finished();
    }

  private:
    void take(const std::string& line) {
        const bool picture = line.starts_with("![") && line.ends_with(')');
        if (line.find_first_not_of(" \t|:+=-") == std::string::npos || picture) {  // blank, or a rule
            flush();
        } else if (line.starts_with('#')) {
            flush();
            const std::string title = trimmed(line.substr(std::min(line.find_first_not_of('#'), line.size())));
            if (!title.empty() && !(has_title_ && line.starts_with("# "))) maker_.heading(without_marks(title), 0);
        } else if (trimmed(line).starts_with('|')) {
            flush();
            if (!in_table_) first_row_ = maker_.count();
            in_table_ = true;
            row(trimmed(line));
        } else if (in_table_ && line.starts_with(": ")) {
            flush();
            paragraph_ = trimmed(line.substr(2));
            maker_.set_part_of(without_marks(paragraph_), first_row_);
            in_table_ = false;
        } else if (const std::size_t mark = item_mark(trimmed(line)); mark > 0) {
            flush();
            paragraph_ = trimmed(trimmed(line).substr(mark));
        } else {
            std::string words = trimmed(line);
            while (words.starts_with('>')) words = trimmed(words.substr(1));
            in_table_ = false;
            paragraph_ += (paragraph_.empty() ? "" : " ") + words;
        }
    }

    /// Length of "-", "*", "12." before an item; 0 where there is none.
    static std::size_t item_mark(const std::string& line) {
        if (line.starts_with("- ") || line.starts_with("* ") || line.starts_with("+ ")) return 1;
        std::size_t end = 0;
        while (end < line.size() && is_decimal_digit(line[end])) ++end;
        const bool number = end > 0 && end + 1 < line.size() && (line[end] == '.' || line[end] == ')');
        return number && line[end + 1] == ' ' ? end + 1 : 0;
    }

    void row(const std::string& line) {
        std::string cells;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '|' && (i == 0 || line[i - 1] != '\\'))
                cells += " | ";
            else
                cells += line[i];
        }
        std::string text;
        for (const std::string& word : words_between_spaces(without_marks(cells)))
            text += (text.empty() ? "" : " ") + word;
        maker_.unit(text, 0);
    }

    void flush() {
        if (!paragraph_.empty()) maker_.paragraph(without_marks(paragraph_), 0);
        paragraph_.clear();
    }

    std::vector<std::string> lines_;
    bool has_title_ = false;
    TextMaker maker_;
    std::string paragraph_;
    bool in_table_ = false;  ///< rows were read, and their caption may follow
    std::size_t first_row_ = 0;
};

/// Scales of figures and other scraps: hardly a word among numbers and signs, and no equation.
bool is_scrap(const std::string& text) {
    if (text.find('=') != std::string::npos) return false;
    const std::vector<std::string> words = plain_words(text);
    const auto real = std::count_if(words.begin(), words.end(), [](const std::string& word) {
        return word.size() >= 3 && std::none_of(word.begin(), word.end(), is_decimal_digit);
    });
    return 4 * real < static_cast<long>(words_between_spaces(text).size());
}

bool is_abbreviation(const std::string& word) {
    static const std::set<std::string> known = {"fig.",    "figs.", "eq.",  "eqs.", "e.g.", "i.e.", "cf.",  "vs.",
                                                "no.",     "resp.", "sec.", "ex.",  "p.",   "pp.",  "tab.", "al.",
                                                "approx.", "min.",  "max.", "env.", "réf.", "ref.", "dr.",  "éq."};
    std::string lower = in_small_letters(word);
    while (lower.starts_with('(')) lower.erase(0, 1);
    return known.contains(lower);
}

/// "K." in a name; "V." behind a number is a unit.
bool is_initial(const std::string& word, const std::string& before) {
    const bool unit = !before.empty() && (is_decimal_digit(before.back()) || before.back() == '$');
    return word.size() == 2 && std::isupper(static_cast<unsigned char>(word.front())) && !unit;
}

/// How often $ or $$ stands in a text: each begins or ends a formula.
int formula_signs(const std::string& text) {
    int signs = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '$') continue;
        ++signs;
        if (i + 1 < text.size() && text[i + 1] == '$') ++i;
    }
    return signs;
}

/// "Figure 3." before a caption.
bool is_caption_label(const std::string& sentence) {
    const std::vector<std::string> words = plain_words(sentence);
    return words.size() == 2 && (words[0] == "figure" || words[0] == "table" || words[0] == "tableau") &&
           is_decimal_digit(words[1].front());
}

bool word_ends_sentence(std::string word) {
    while (!word.empty() && (word.back() == ')' || word.back() == '"' || word.back() == '\'')) word.pop_back();
    if (word.ends_with("”") || word.ends_with("’") || word.ends_with("»")) return true;
    if (word.empty() || (word.back() != '.' && word.back() != '!' && word.back() != '?')) return false;
    return !is_abbreviation(word);
}

/// "1." at the beginning of an item.
bool is_list_number(const std::string& word) {
    return word.size() <= 3 && std::all_of(word.begin(), word.end() - 1, is_decimal_digit);
}

bool may_begin_sentence(const std::string& word) {
    const auto first = static_cast<unsigned char>(word.front());
    return !std::islower(first);
}

}  // namespace

int ReportText::words() const {
    int sum = 0;
    for (const ReportSection& section : sections) sum += section.words;
    return sum;
}

std::vector<std::string> sentences_of(const std::string& paragraph) {
    std::vector<std::string> sentences;
    std::string sentence;
    int dollars = 0;
    const int all_dollars = formula_signs(paragraph);
    const std::vector<std::string> words = words_between_spaces(paragraph);
    for (std::size_t i = 0; i < words.size(); ++i) {
        sentence += (sentence.empty() ? "" : " ") + words[i];
        dollars += formula_signs(words[i]);
        const bool number = sentence == words[i] && is_list_number(words[i]);
        const bool open = dollars % 2 != 0 && dollars < all_dollars;
        const bool ends = !open && !number && i + 1 < words.size() && word_ends_sentence(words[i]) &&
                          !is_initial(words[i], i > 0 ? words[i - 1] : "") && !is_caption_label(sentence);
        if (ends && may_begin_sentence(words[i + 1])) {
            sentences.push_back(std::move(sentence));
            sentence.clear();
        }
    }
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
    return sentences;
}

ReportText report_text_of_markdown(const std::string& markdown) {
    return MarkdownReader(markdown).run();
}

ReportText report_text_of_pdf(const DocumentText& text) {
    TextMaker maker;
    bool begun = false;
    for (const TextBlock& block : text_blocks(text)) {
        if (block.heading) {
            // The title of the document is not a section.
            const bool known = std::any_of(text.headings.begin(), text.headings.end(),
                                           [&](const Heading& h) { return h.text == block.text; });
            if (known || begun) maker.heading(block.text, block.page);
        } else if (!is_scrap(block.text)) {
            maker.paragraph(block.text, block.page);
        }
        begun = begun || !block.heading;
    }
    return maker.finished();
}

}  // namespace dynlab::inline course
