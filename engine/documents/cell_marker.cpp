#include "documents/cell_marker.h"

namespace dynlab::inline documents {
namespace {

std::string_view without_leading_blanks(std::string_view text) {
    return text.substr(text.find_first_not_of(" \t") == std::string_view::npos ? text.size()
                                                                               : text.find_first_not_of(" \t"));
}

}  // namespace

bool is_cell_marker(std::string_view line) {
    return line.starts_with("--") && without_leading_blanks(line.substr(2)).starts_with("%%");
}

std::string_view cell_marker_options(std::string_view line) {
    return without_leading_blanks(without_leading_blanks(line.substr(2)).substr(2));
}

bool is_text_cell_marker(std::string_view line) {
    return is_cell_marker(line) && cell_marker_options(line).starts_with("[markdown]");
}

}  // namespace dynlab::inline documents
