#include "documents/text_lines.h"

#include <algorithm>
#include <cctype>

#include "documents/error.h"
#include "platform/atomic_file.h"

namespace dynlab::inline documents {

std::string text_of_source(const std::filesystem::path& file) {
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
    if (!unknown && bytes > kMaxSourceSize)
        throw DocumentError(
            Place{file}, Message("the size limit of a script or template is {} MB, but the size of this file is {} MB",
                                 kMaxSourceSize >> 20, (bytes + (1 << 20) - 1) >> 20));
    return read_text(file);
}

std::vector<std::string_view> lines_with_ends(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    for (std::string_view line : lines_with_ends(text)) {
        if (line.ends_with('\n')) line.remove_suffix(1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.emplace_back(line);
    }
    return lines;
}

std::string trimmed(std::string_view text) {
    const char* const blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

std::vector<std::string> words_between_spaces(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text) {
        if (!std::isspace(static_cast<unsigned char>(c))) {
            word += c;
        } else if (!word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    if (!word.empty()) words.push_back(std::move(word));
    return words;
}

bool is_name(std::string_view text) {
    const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
    return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), [&](char c) {
        return letter(c) || c == '-' || std::isdigit(static_cast<unsigned char>(c));
    });
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

bool FencedCode::holds(const std::string& line) {
    const std::string text = trimmed(line);
    const std::size_t length = std::min(text.find_first_not_of('`'), text.size());
    if (open_ == 0) {
        if (length >= 3) open_ = length;
        return length >= 3;
    }
    if (length >= open_ && length == text.size()) open_ = 0;
    return true;
}

}  // namespace dynlab::inline documents
