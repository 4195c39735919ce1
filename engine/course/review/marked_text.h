#pragma once
#include <memory>
#include <string>

#include "course/review/text_changes.h"

namespace dynlab::inline course {

/// Texts of anybody's as Markdown that means nothing but itself and can be printed: characters that LaTeX lacks become
/// ?, long words may be broken.
class MarkedText {
  public:
    MarkedText();
    ~MarkedText();
    MarkedText(const MarkedText&) = delete;
    MarkedText& operator=(const MarkedText&) = delete;

    std::string plain(const std::string& text) const;
    std::string emphasised(const std::string& text) const;
    /// Removed words struck out, added ones bold, long unchanged stretches shortened; about `most_words` words at most.
    std::string marked(const Passage& passage, std::size_t most_words) const;
    /// For the cell of a table: not escaped, at most `most` characters, words not longer than `longest`.
    std::string cell(const std::string& text, std::size_t most, std::size_t longest) const;

  private:
    struct Printable;
    std::string printable_words(const std::string& text) const;
    std::unique_ptr<Printable> printable_;
};

/// The last `count` words of a text, after "…" where there are more.
std::string last_words(const std::string& text, std::size_t count);

}  // namespace dynlab::inline course
