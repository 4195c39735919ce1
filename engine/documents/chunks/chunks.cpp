#include "documents/chunks/chunks.h"

#include <re2/re2.h>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

/// Follows fences, comments and tables with empty lines through the text.
class OpenBlocks {
  public:
    void read(const std::string& line) {
        if (!code_fence_.empty()) {
            static const RE2 kClosing(R"( {0,3}(`{3,}|~{3,})\s*)", RE2::Latin1);
            std::string closing;
            if (RE2::FullMatch(line, kClosing, &closing) && closing.starts_with(code_fence_)) code_fence_.clear();
            return;
        }
        if (in_comment_) {
            in_comment_ = line.find("-->") == std::string::npos;
            return;
        }
        static const RE2 kCode(R"(^ {0,3}(`{3,}|~{3,}))", RE2::Latin1), kBlock(R"(^ {0,3}:{3,}\s*(\S?))", RE2::Latin1),
            kRule(R"(\s*-{3,}[ -]*)", RE2::Latin1);
        const bool rule = RE2::FullMatch(line, kRule);
        std::string begin_of_words;
        if (RE2::PartialMatch(line, kCode, &code_fence_)) {
            // The code ends in a later line.
        } else if (RE2::PartialMatch(line, kBlock, &begin_of_words)) {
            depth_ += begin_of_words.empty() ? -1 : 1;
        } else if (const std::size_t begin = line.find("<!--");
                   begin != std::string::npos && line.find("-->", begin) == std::string::npos) {
            in_comment_ = true;
        } else if (rule && after_empty_line_ && !in_table_) {
            in_table_ = true;
        } else if (in_table_ && is_blank(line) && after_rule_) {
            in_table_ = false;
        }
        after_rule_ = rule;
        after_empty_line_ = is_blank(line);
    }
    bool any() const { return !code_fence_.empty() || in_comment_ || in_table_ || depth_ > 0; }

  private:
    std::string code_fence_;
    int depth_ = 0;
    bool in_comment_ = false, in_table_ = false, after_rule_ = false, after_empty_line_ = true;
};

/// Whether a line that follows an empty one belongs to the block before it.
bool goes_on(const std::string& line) {
    static const RE2 kGoesOn(R"(^(\s|[-*+] |\(?[0-9A-Za-z]{1,4}[.)] |\(@|:\s|~\s|[Tt]able:))", RE2::Latin1);
    return RE2::PartialMatch(line, kGoesOn);
}

/// Whether what follows belongs to this: the caption above a table.
bool is_caption(const std::string& line) {
    static const RE2 kCaption(R"(^([Tt]able)?:\s)", RE2::Latin1);
    return RE2::PartialMatch(line, kCaption);
}

}  // namespace

std::vector<Chunk> chunks_of(const MarkdownText& markdown) {
    std::vector<Chunk> chunks;
    OpenBlocks open;
    bool after_empty_line = true, caption = false;
    int number = 0;
    for (const std::string& line : lines_of(markdown.text)) {
        ++number;
        const bool begins = !open.any() && after_empty_line && !is_blank(line) && !goes_on(line) && !caption;
        if (chunks.empty() || begins) chunks.push_back({"", markdown.origin_of(number), number, number});
        Chunk& chunk = chunks.back();
        if (begins || chunk.first_line == number)
            caption = is_caption(line);
        else if (!is_blank(line))
            caption = false;
        chunk.markdown += line + "\n";
        chunk.last_line = number;
        open.read(line);
        after_empty_line = is_blank(line);
    }
    return chunks;
}

}  // namespace dynlab::inline documents
