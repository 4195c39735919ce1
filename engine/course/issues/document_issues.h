#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "course/anonymity/identity_matcher.h"
#include "course/intake/issue.h"
#include "documents/document_rules.h"
#include "documents/pdf/pdf_layout.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline course {

/// What a document is held against.
struct DocumentStandard {
    std::string template_name;            ///< for the summary; empty when nothing is known of the document's kind
    DocumentRules rules;                  ///< pages and sections
    std::vector<std::string> guidance;    ///< sentences of the template, in any language, that must not be printed
    std::optional<std::string> language;  ///< as the header declares it
};

/// The standard of an installed template ("lab_report") or of a template file ("mine.md"). Throws EnvironmentError that
/// lists the templates when there is none of that name, DocumentError for one that cannot be read.
DocumentStandard standard_of(const std::string& template_name_or_file);

/// What a lesson asks of reports: its template where that demands something, else its own report in this language, else
/// the template, which then leaves the form free. Throws EnvironmentError or DocumentError where one of them cannot
/// be read.
DocumentStandard standard_of_lesson(const Lesson& lesson, const std::string& language = "en");

/// What is asked for instead of what the document's kind demands.
/// What the check of a folder does, in this order.
enum class CheckStep { kAnalysis, kLessonChecks, kReport };

struct CheckOptions {
    std::optional<DocumentStandard> standard;
    std::optional<int> pages;   ///< the most that are allowed altogether
    bool lesson_checks = true;  ///< of a folder: try the lesson's checks on its answers too
    /// Names that must not appear; for a folder, the names of its members are added. Null: names in a PDF are not
    /// checked.
    std::shared_ptr<const IdentityMatcher> names = nullptr;
    std::function<void(CheckStep)> begins = [](CheckStep) {};  ///< called as a step begins
};

/// The outcome of a check.
struct CheckResult {
    std::string subject;           ///< the file or folder, as it was named
    std::string template_name;     ///< empty when pages and sections were not checked
    std::string language;          ///< "en", "fr", or empty
    std::string lesson;            ///< of a folder: as analysis.lua names it; empty where it cannot be read
    int pages = 0;                 ///< 0 when the document could not be read
    std::vector<Message> checked;  ///< names of the completed checks
    Issues findings;               ///< in page order, rules first
    bool passed() const;           ///< no rule is broken
};

/// Checks a PDF from anybody. Findings about the file itself: not-pdf, encrypted, damaged, too-large, scanned (rules),
/// protected (hint); further ones in text_issues.h and anonymity/anonymity_issues.h. Without a standard, slides
/// (landscape) are held against the template "slides", documents with more headings of the form "peer_review" than of
/// "lab_report" against that, and others against "lab_report". Throws PdfRefusal when there is no such file or it may
/// not be read.
CheckResult check_pdf(const std::filesystem::path& file, const CheckOptions& check_options = {},
                      const PdfLimits& limits = {});

void sort_issues(Issues& findings);  ///< rules first, then by page

}  // namespace dynlab::inline course
