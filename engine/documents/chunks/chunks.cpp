#include "documents/chunks/chunks.h"

#include <regex>

#include "documents/text_lines.h"
#include "platform/text/regex_limit.h"

namespace dynlab::inline documents {
namespace {

/// Longer lines are prose.
bool matches(const std::string& line, const std::regex& pattern, std::smatch* found = nullptr) {
    std::smatch unused;
    return line.size() <= kLongestForRegex && std::regex_search(line, found ? *found : unused, pattern);
}

/// Follows fences, comments and tables with empty lines through the text.
class OpenBlocks {
  public:
    void read(const std::string& line) {
        if (!code_fence_.empty()) {
            static const std::regex kClosing(R"(^ {0,3}(`{3,}|~{3,})\s*$)");
            std::smatch closing;
            const bool closes = matches(line, kClosing, &closing) && closing.str(1)[0] == code_fence_[0] &&
                                closing.str(1).size() >= code_fence_.size();
            if (closes) code_fence_.clear();
            return;
        }
        if (in_comment_) {
            in_comment_ = line.find("-->") == std::string::npos;
            return;
        }
        static const std::regex kCode(R"(^ {0,3}(`{3,}|~{3,}))"), kBlock(R"(^ {0,3}:{3,}\s*(\S?))"),
            kRule(R"(^\s*-{3,}[ -]*$)");
        std::smatch found;
        if (matches(line, kCode, &found)) {
            code_fence_ = found[1];
        } else if (matches(line, kBlock, &found)) {
            depth_ += found[1].length() > 0 ? 1 : -1;
        } else if (const std::size_t begin = line.find("<!--");
                   begin != std::string::npos && line.find("-->", begin) == std::string::npos) {
            in_comment_ = true;
        } else if (matches(line, kRule) && after_empty_line_ && !in_table_) {
            in_table_ = true;
        } else if (in_table_ && is_blank(line) && after_rule_) {
            in_table_ = false;
        }
        after_rule_ = matches(line, kRule);
        after_empty_line_ = is_blank(line);
    }
    bool any() const { return !code_fence_.empty() || in_comment_ || in_table_ || depth_ > 0; }

  private:
    std::string code_fence_;
    int depth_ = 0;
    bool in_comment_ = false, in_table_ = false, after_rule_ = false, after_empty_line_ = true;
};

/// Whether a line that follows an empty one belongs to what stands before it.
bool goes_on(const std::string& line) {
    static const std::regex kGoesOn(R"(^(\s|[-*+] |\(?[0-9A-Za-z]{1,4}[.)] |\(@|:\s|~\s|[Tt]able:))");
    return matches(line, kGoesOn);
}

/// Whether what follows belongs to this: the caption above a table.
bool is_caption(const std::string& line) {
    static const std::regex kCaption(R"(^([Tt]able)?:\s)");
    return matches(line, kCaption);
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
