#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline workflow {

/// The hints of a lesson: for each question, by its number, the stages from a nudge to nearly the answer, each a
/// paragraph of Markdown.
using Hints = std::map<int, std::vector<std::string>>;

/// Reads hints.md of a lesson: a heading `# Question N` (in French the same word), then a numbered list, one item a
/// stage, further lines of an item indented. Throws DocumentError with file and line for anything else, a question that
/// occurs twice, and numbers out of order.
Hints read_hints(const std::filesystem::path& file);
Hints hints_in(const std::string& text, const std::filesystem::path& name);

/// How many hints of a question somebody has seen, remembered in the cache under the lesson's name; 0 where it is
/// forgotten. Hints are help and no secret: what is forgotten costs nothing.
class HintsSeen {
  public:
    HintsSeen(std::string lesson, int question);
    bool lasting() const;  ///< whether anything is remembered at all
    std::size_t count() const;
    void remember(std::size_t count) const;

  private:
    std::string entry_;
};

}  // namespace dynlab::inline workflow
