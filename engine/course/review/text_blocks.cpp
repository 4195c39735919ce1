#include "course/review/text_blocks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace dynlab::inline course {
namespace {

constexpr double kParagraphGap = 0.4;  ///< of the size: more between two lines parts paragraphs
constexpr double kIndent = 0.8;        ///< of the size
constexpr double kShortLine = 0.75;    ///< of the text's width: a sentence that ends before it ends a paragraph
constexpr double kTitleSize = 1.12;    ///< of the prose's
constexpr double kSameSize = 0.03;     ///< of the size: sizes that differ by less are one

bool is_bullet(const std::string& word) {
    static const std::set<std::string> bullets = {"•", "◦", "▪", "‣", "·", "●", "○", "■", "–", "—", "-", "*", "+", "∙"};
    return bullets.contains(word);
}

/// "1.", "(2)", "b)": what numbers an item.
bool is_item_number(const std::string& word) {
    std::string inner = word;
    if (inner.starts_with('(')) inner.erase(0, 1);
    if (inner.size() < 2 || (inner.back() != '.' && inner.back() != ')')) return false;
    inner.pop_back();
    const bool digits =
        inner.size() <= 2 && std::ranges::all_of(inner, [](unsigned char c) { return std::isdigit(c); });
    return digits || (inner.size() == 1 && std::islower(static_cast<unsigned char>(inner.front())));
}

/// "Figure 3." and its like: what begins a caption.
bool begins_caption(const TextLine& line) {
    static const std::set<std::string> labels = {"Figure", "Fig.", "Table", "Tableau"};
    if (line.words.size() < 2 || !labels.contains(line.words[0])) return false;
    const std::string& number = line.words[1];
    return std::isdigit(static_cast<unsigned char>(number.front())) && (number.back() == '.' || number.back() == ':');
}

bool ends_sentence(const std::string& text) {
    return text.ends_with('.') || text.ends_with('!') || text.ends_with('?') || text.ends_with(':') ||
           text.ends_with("…");
}

class BlockMaker {
  public:
    explicit BlockMaker(const DocumentText& text) : text_(text) {
        for (const TextLine& line : text.lines) {
            if (!line.is_prose()) continue;
            left_ = std::min(left_, line.left);
            right_ = std::max(right_, line.right);
        }
    }

    std::vector<TextBlock> run() {
        std::size_t next_heading = 0;
        for (std::size_t i = 0; i < text_.lines.size(); ++i) {
            while (next_heading < text_.headings.size() && text_.headings[next_heading].last_line < i) ++next_heading;
            const bool in_heading =
                next_heading < text_.headings.size() && text_.headings[next_heading].first_line <= i;
            const TextLine& line = text_.lines[i];
            if (in_heading || is_title(line))
                add_heading(line, in_heading && text_.headings[next_heading].first_line < i);
            else
                add(line);
            last_ = &line;
        }
        return std::move(blocks_);
    }

  private:
    bool is_title(const TextLine& line) const {
        const bool at_start = std::ranges::all_of(blocks_, [](const TextBlock& b) { return b.heading; });
        return at_start && !line.fixed_width && line.size > kTitleSize * text_.body_size;
    }

    void add_heading(const TextLine& line, bool goes_on) {
        if (goes_on && !blocks_.empty() && blocks_.back().heading)
            blocks_.back().text += " " + line.text();
        else
            blocks_.push_back({line.text(), line.page, true, false});
    }

    void add(const TextLine& line) {
        const bool item =
            line.words.size() > 1 && (is_bullet(line.words.front()) || is_item_number(line.words.front()));
        if (item || begins_block(line)) {
            const std::size_t from = item && is_bullet(line.words.front()) ? 1 : 0;
            std::string text;
            for (std::size_t i = from; i < line.words.size(); ++i) text += (text.empty() ? "" : " ") + line.words[i];
            blocks_.push_back({std::move(text), line.page, false, item});
            return;
        }
        std::string& text = blocks_.back().text;
        const std::string& last_word = last_->words.back();
        if (last_word.size() > 2 && last_word.back() == '-') {
            text.pop_back();
            text += line.text();
        } else {
            text += " " + line.text();
        }
    }

    bool begins_block(const TextLine& line) const {
        if (blocks_.empty() || blocks_.back().heading || line.fixed_width || last_->fixed_width) return true;
        const bool whole = ends_sentence(blocks_.back().text);
        if (begins_caption(line) && !leads_on(line)) return true;
        if (line.page != last_->page) {
            const unsigned char first = static_cast<unsigned char>(line.words.front().front());
            return whole || std::isupper(first);
        }
        if (line.top - last_->bottom > kParagraphGap * line.size) return true;
        if (line.bottom < last_->top) return true;  // another column
        const bool indented = line.left > last_->left + kIndent * line.size && !blocks_.back().item;
        const bool short_before = last_->right < left_ + kShortLine * (right_ - left_);
        return whole && (indented || short_before);
    }

    /// "... beside the position in / Figure 1.": the line before is a sentence without its end, set as this one.
    bool leads_on(const TextLine& line) const {
        const std::string& word = last_->words.back();
        const bool plain = std::ranges::all_of(word, [](unsigned char c) { return std::islower(c) || c >= 0x80; });
        return plain && last_->is_prose() && std::abs(line.size - last_->size) < kSameSize * line.size;
    }

    const DocumentText& text_;
    std::vector<TextBlock> blocks_;
    const TextLine* last_ = nullptr;
    double left_ = 1e9, right_ = 0;
};

}  // namespace

std::vector<TextBlock> text_blocks(const DocumentText& text) {
    return BlockMaker(text).run();
}

}  // namespace dynlab::inline course
