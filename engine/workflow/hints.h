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

/// Number of hints of a question that the user has seen. The cache stores the number under the name of the lesson; it
/// is 0 if the entry is missing. Hints are not secret, so a lost entry does no harm.
class HintsSeen {
  public:
    HintsSeen(std::string lesson, int question);
    bool lasting() const;  ///< whether the cache survives this process
    std::size_t count() const;
    void save_entry(std::size_t count) const;

  private:
    std::string entry_;
};

}  // namespace dynlab::inline workflow
