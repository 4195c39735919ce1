#include "documents/bibliography.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include "documents/text_lines.h"
#include "documents/work_file.h"
#include "platform/atomic_file.h"
#include "platform/files/inside_folder.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxByteCount = 1u << 20;

bool is_blank_sign(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// The closing sign of the formula that begins with the dollar sign at `at`, by the rule of Markdown; none of an
/// amount.
std::size_t end_of_formula(std::string_view text, std::size_t at) {
    if (at + 1 >= text.size() || is_blank_sign(text[at + 1])) return text.npos;
    for (std::size_t end = at + 1; end < text.size(); ++end) {
        if (text[end] == '\\')
            ++end;
        else if (text[end] == '$')
            return is_blank_sign(text[end - 1]) || (end + 1 < text.size() && std::isdigit(text[end + 1])) ? text.npos
                                                                                                          : end;
    }
    return text.npos;
}

/// TeX text with a backslash before each sign that TeX would not print and that its author meant to be printed.
std::string with_printed_signs(std::string_view text) {
    std::string result;
    std::size_t behind = 0;  // the formula that was begun
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '\\' && at + 1 < text.size()) {
            result += {c, text[++at]};
            continue;
        }
        if (c == '$' && at >= behind) {
            const std::size_t close = end_of_formula(text, at);
            if (close == text.npos) result += '\\';
            if (close != text.npos) behind = close + 1;
        }
        if (c == '%' || c == '#' || (c == '&' && at >= behind)) result += '\\';
        result += c;
    }
    return result;
}

/// A BibTeX file in which titles and the like print in full: in "50% of C#" TeX would end at the percent sign.
class PrintedBibliography {
  public:
    explicit PrintedBibliography(std::string_view text) : text_(text) {}

    std::string text() {
        while (copy_until("@") && copy_until("{(")) {
            const std::string kind = in_small_letters(trimmed(text_.substr(entry_ + 1, at_ - entry_ - 2)));
            if (kind != "comment" && kind != "preamble") copy_fields(text_[at_ - 1] == '{' ? '}' : ')');
        }
        return result_;
    }

  private:
    /// Up to and with the first of these signs; false where there is none.
    bool copy_until(std::string_view signs) {
        const std::size_t found = text_.find_first_of(signs, at_), end = found == text_.npos ? text_.size() : found + 1;
        if (found != text_.npos && text_[found] == '@') entry_ = found;
        result_ += text_.substr(at_, end - at_);
        at_ = end;
        return found != text_.npos;
    }

    /// The fields of an entry, whose values are between braces or quotes.
    void copy_fields(char close) {
        std::string name, word;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == close) return;
            if (c == '%') {
                copy_until("\n");
                continue;
            }
            if (c == '=') name = word;
            word = std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? word + c : is_blank_sign(c) ? word : "";
            if (c == '{' || c == '"')
                copy_value(in_small_letters(name));
            else
                result_ += text_[at_++];
        }
    }

    void copy_value(const std::string& field) {
        static const std::set<std::string> kVerbatim = {"url", "doi", "eprint", "file", "pdf", "urlraw", "verba"};
        const bool quoted = text_[at_] == '"';
        std::size_t end = at_ + 1;
        for (int depth = 0; end < text_.size(); ++end) {
            const char c = text_[end];
            if (c == '\\')
                ++end;
            else if (depth == 0 && c == (quoted ? '"' : '}'))
                break;
            else
                depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        }
        end = std::min(end, text_.size());
        const std::string_view value = text_.substr(at_ + 1, end - at_ - 1);
        result_ += text_[at_];
        result_ += kVerbatim.contains(field) ? std::string(value) : with_printed_signs(value);
        if (end < text_.size()) result_ += text_[end];
        at_ = std::min(end + 1, text_.size());
    }

    std::string_view text_;
    std::string result_;
    std::size_t at_ = 0, entry_ = 0;
};

}  // namespace

Message fault_of_bibliography_name(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    const bool plain = name.find_first_of("/\\") == std::string::npos && !name.starts_with('.');
    if (plain && (extension == ".bib" || extension == ".json")) return {};
    return Message(
        "\"bibliography\" must be the name of a .bib (BibTeX) or .json (CSL) file in the same folder, such as "
        "references.bib, not \"{}\"",
        name);
}

Message why_no_bibliography(const fs::path& file) {
    if (!is_inside(file, folder_around(file)))
        return Message(
            "the bibliography is outside the folder of the document; copy the bibliography file into that folder");
    if (!fs::is_regular_file(file))
        return Message("the bibliography file is missing; add the file, or remove \"bibliography:\" from the header");
    if (fs::file_size(file) > kMaxByteCount)
        return Message("the bibliography is larger than 1 MB; keep only the works that the document cites");
    return {};
}

std::string place_bibliography(const fs::path& file, const fs::path& work_folder, Complaints& complaints) {
    if (const Message fault = why_no_bibliography(file); !fault.empty()) {
        complaints.add({file, 0}, fault);
        return "";
    }
    const std::string name = "references" + file.extension().string();
    const std::string text = read_text(file);
    write_work_file(work_folder / name, file.extension() == ".bib" ? PrintedBibliography(text).text() : text);
    return name;
}

}  // namespace dynlab::inline documents
