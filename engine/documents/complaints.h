#pragma once
#include <string>
#include <vector>

#include "documents/weave.h"

namespace dynlab::inline documents {

/// Collects what is wrong with a document, so that its author sees everything at once.
class Complaints {
  public:
    void add(const Place& where, const Message& sentence);
    void add_all(const Complaints& others);
    bool empty() const { return messages_.empty(); }
    const std::vector<Message>& messages() const { return messages_; }  ///< each with its place
    void throw_if_any() const;  ///< DocumentError with the first ten, one a line

  private:
    std::vector<Message> messages_;
};

/// The origin of the `occurrence`-th line (1-based) of `markdown` that contains `text`, or of the last such line if
/// there are fewer; `fallback` without line if there is none. Comments, code, and longer names that begin with `text`
/// count only if `text` occurs nowhere else.
Place find_in(const MarkdownText& markdown, const std::string& text, const std::filesystem::path& fallback,
              int occurrence = 1);

}  // namespace dynlab::inline documents
