#pragma once
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "base/reader.h"
#include "course/findings/document_findings.h"
#include "course/findings/french_sentences.h"

namespace dynlab {

/// A sentence as a group that writes in French reads it.
inline std::string in_french(const std::string& sentence) {
    static const SentenceCatalogue sentences = french_sentences();
    return sentences.translated(sentence);
}

/// Without what stands in quotation marks, which is the document's own.
inline std::string without_quotations(std::string french) {
    const std::string open = "«", close = "»";
    for (std::size_t at; (at = french.find(open)) != french.npos;) {
        const std::size_t end = french.find(close, at);
        if (end == french.npos) break;
        french.erase(at, end + close.size() - at);
    }
    return french;
}

inline void expect_told_in_french(const std::string& english) {
    static const std::regex kEnglish(
        "(^|[^A-Za-z'-])(the|The|this|This|of|is|are|was|it|It|its|be|been|to|not|that|with|for|from|by|in|and|or|"
        "Write|Make|Take|Put|Give)($|[^A-Za-z'-])");
    const std::string french = in_french(english);
    EXPECT_NE(french, english);
    EXPECT_FALSE(std::regex_search(without_quotations(french), kEnglish)) << english << "\nis told as\n" << french;
}

inline void expect_told_in_french(const Findings& findings) {
    for (const Finding& finding : findings) {
        expect_told_in_french(message_text(finding.what));
        expect_told_in_french(message_text(finding.remedy));
    }
}

}  // namespace dynlab
