#include <re2/re2.h>

#include "course/anonymity/identity_matcher.h"
#include "platform/atomic_file.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// The value of a BibTeX field, without inner braces and accents: "No{\"e}l" becomes "Noel".
std::string field_value(std::string_view text, char closing) {
    std::string value;
    int depth = 0;
    for (const char c : text) {
        if (depth == 0 && c == closing) break;
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        const bool accent = !value.empty() && value.back() == '\\';
        if (accent) value.pop_back();
        if (c == '{' || c == '}' || accent) continue;
        value += c == '\n' ? ' ' : c;
    }
    return value;
}

void add_authors(const std::string& bibliography, std::vector<CitedAuthor>& authors) {
    static const re2::RE2 people(R"re((?i)\b(?:author|editor)\s*=\s*([{"]))re");
    constexpr std::string_view kBetween = " and ";
    re2::StringPiece rest(bibliography);
    std::string opening;
    while (re2::RE2::FindAndConsume(&rest, people, &opening)) {
        const char closing = opening == "{" ? '}' : '"';
        const std::string list = field_value({rest.data(), rest.size()}, closing) + std::string(kBetween);
        for (std::size_t begin = 0, end = 0; (end = list.find(kBetween, begin)) != std::string::npos;
             begin = end + kBetween.size())
            authors.push_back(cited_author(list.substr(begin, end - begin)));
    }
}

}  // namespace

const std::vector<CitedAuthor>& cited_authors() {
    static const std::vector<CitedAuthor> read = [] {
        std::vector<CitedAuthor> authors;
        for (const Lesson& lesson : lessons())
            if (const fs::path file = lesson.folder / "references.bib"; fs::is_regular_file(file))
                add_authors(read_file(file), authors);
        return authors;
    }();
    return read;
}

}  // namespace dynlab::inline course
