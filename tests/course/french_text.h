#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>

#include "course/issues/document_issues.h"
#include "course/issues/lesson_reader.h"

namespace dynlab {

/// A message as a group that writes in French reads it.
inline std::string in_french(const Message& message) {
    static const LessonReader reader("fr");
    return reader.text(message);
}

/// The text without quotations, whose words belong to the document.
inline std::string without_quotations(std::string french) {
    const std::string open = "«", close = "»";
    for (std::size_t at; (at = french.find(open)) != french.npos;) {
        const std::size_t end = french.find(close, at);
        if (end == french.npos) break;
        french.erase(at, end + close.size() - at);
    }
    return french;
}

inline void expect_french_text(const Message& message) {
    static const std::regex kEnglish(
        "(^|[^A-Za-z'-])(the|The|this|This|of|is|are|was|it|It|its|be|been|to|not|that|with|for|from|by|in|and|or|"
        "Write|Make|Take|Put|Give)($|[^A-Za-z'-])");
    const std::string english = message_text(message), french = in_french(message);
    EXPECT_NE(french, english);
    std::string words = without_quotations(french);
    std::ranges::replace_if(
        words, [](unsigned char c) { return c >= 0x80; }, 'x');  // é is a letter
    EXPECT_FALSE(std::regex_search(words, kEnglish)) << english << "\nis told as\n" << french;
}

inline void expect_french_text(const Issues& findings) {
    for (const Issue& issue : findings) {
        expect_french_text(issue.what);
        expect_french_text(issue.remedy);
    }
}

}  // namespace dynlab
