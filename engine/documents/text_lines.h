#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline documents {

/// The lines of a text without their ends (\n or \r\n). A last line without an end counts; after a last \n
/// there is no further line.
std::vector<std::string> lines_of(std::string_view text);
/// The lines of a text, each with the end it has: joined, they give the text back byte for byte.
std::vector<std::string_view> lines_with_ends(std::string_view text);
/// A script or template has at most so many bytes: what is larger is something else.
inline constexpr std::uintmax_t kMaxSourceSize = std::uintmax_t{4} << 20;
/// The text of a script or template, without a byte order mark. Throws EnvironmentError where it cannot be read,
/// DocumentError for more than kMaxSourceSize.
std::string text_of_source(const std::filesystem::path& file);
std::string trimmed(std::string_view text);  ///< without spaces, tabs and line ends at both sides
bool is_blank(std::string_view text);
std::vector<std::string> words_between_spaces(std::string_view text);  ///< spaces, tabs and line ends
bool is_name(std::string_view text);  ///< a letter or underscore, then letters, digits, underscores, hyphens
std::string replaced(std::string text, std::string_view from, std::string_view to);  ///< every occurrence

/// Which lines of Markdown belong to fenced code: asked of every line in turn.
class FencedCode {
  public:
    bool holds(const std::string& line);

  private:
    std::size_t open_ = 0;  ///< the fence's backticks
};

}  // namespace dynlab::inline documents
