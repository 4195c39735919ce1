#include "course/issues/document_issues.h"

#include <algorithm>
#include <tuple>

#include "base/message.h"
#include "course/anonymity/anonymity_issues.h"
#include "course/issues/document_text.h"
#include "course/issues/text_issues.h"
#include "documents/percent_script.h"
#include "documents/template_file.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

Issue file_finding(const PdfRefusal& refusal) {
    switch (refusal.fault()) {
        case PdfFault::kNotPdf:
            return {"not-pdf", Severity::kRule,   0,
                    "",        refusal.message(), Message("Submit the PDF that dynlab report creates.")};
        case PdfFault::kEncrypted:
            return {"encrypted", Severity::kRule,   0,
                    "",          refusal.message(), Message("Save the PDF again without a password.")};
        case PdfFault::kTooLarge:
            return {"too-large",
                    Severity::kRule,
                    0,
                    "",
                    refusal.message(),
                    Message("Reduce the file size: use vector graphics instead of screenshots.")};
        case PdfFault::kNotThere:
        case PdfFault::kDamaged:
            break;
    }
    return {"damaged", Severity::kRule,   0,
            "",        refusal.message(), Message("Create the file again, or copy it again from the original.")};
}

/// Without those that are others in another language, such as slides.fr.md.
std::vector<std::string> installed_templates() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(shared_folder() / "report_templates")) {
        const fs::path stem = entry.path().stem();
        if (entry.path().extension() == ".md" && !stem.has_extension()) names.push_back(stem);
    }
    std::ranges::sort(names);
    return names;
}

/// Of a template that may not be installed.
DocumentStandard known_standard(const char* name) {
    const std::vector<std::string> known = installed_templates();
    return std::ranges::find(known, name) == known.end() ? DocumentStandard() : standard_of(name);
}

/// How many of the demanded sections a document has.
std::ptrdiff_t sections_in(const DocumentText& text, const DocumentStandard& standard) {
    const Issues found = section_findings(text, standard.rules, "en");
    const auto demanded = [](const SectionRule& section) { return !section.optional; };
    return std::ranges::count_if(standard.rules.sections, demanded) -
           std::ranges::count_if(found, [](const Issue& f) { return f.id == "section-missing"; });
}

DocumentStandard usual_standard(const DocumentText& text) {
    if (text.is_slides()) return known_standard("slides");
    DocumentStandard report = known_standard("lab_report"), review = known_standard("peer_review");
    return sections_in(text, review) > sections_in(text, report) ? review : report;
}

DocumentStandard standard_for(const DocumentText& text, const CheckOptions& check_options) {
    DocumentStandard standard = check_options.standard ? *check_options.standard : usual_standard(text);
    if (check_options.pages) {
        standard.rules.pages = *check_options.pages;
        standard.rules.appendix_pages.reset();
    }
    return standard;
}

Message page_summary(const DocumentText& text, int pages, const DocumentRules& rules) {
    const bool slides = text.is_slides();
    if (!rules.pages) return slides ? plural(pages, "{} slide", "{} slides") : plural(pages, "{} page", "{} pages");
    const int max_pages = *rules.pages;
    if (!rules.appendix_pages)
        return slides ? plural(pages, "{} slide (limit: {})", "{} slides (limit: {})", max_pages)
                      : plural(pages, "{} page (limit: {})", "{} pages (limit: {})", max_pages);
    const int more = *rules.appendix_pages;
    return slides ? plural(pages, "{} slide (limit: {}, plus {} in the appendix)",
                           "{} slides (limit: {}, plus {} in the appendix)", max_pages, more)
                  : plural(pages, "{} page (limit: {}, plus {} in the appendix)",
                           "{} pages (limit: {}, plus {} in the appendix)", max_pages, more);
}

/// Checks what can be read; `result` knows the file already.
void check_text(const PdfLayout& layout, const DocumentText& text, const DocumentStandard& standard,
                CheckResult& result) {
    const LanguageFindings language = language_findings(text, standard.language);
    result.language = language.language;
    const bool is_report = !standard.rules.sections.empty() && !text.is_slides();
    const FigureFindings figures = figure_findings(text, is_report ? Severity::kRule : Severity::kHint);
    const std::string titles = standard.language ? *standard.language : language.language == "fr" ? "fr" : "en";
    for (const Issues& found :
         {page_findings(text, result.pages, standard.rules), section_findings(text, standard.rules, titles),
          figures.findings, leftover_findings(text, standard.guidance), language.findings,
          layout_findings(text, layout)}) {
        result.findings.insert(result.findings.end(), found.begin(), found.end());
    }
    result.checked.push_back(page_summary(text, result.pages, standard.rules));
    if (!standard.rules.sections.empty())
        result.checked.push_back(plural(std::ssize(standard.rules.sections), "{} section", "{} sections"));
    result.checked.push_back(
        plural(static_cast<std::int64_t>(figures.figures), "{} numbered figure", "{} numbered figures"));
    result.checked.push_back(Message("placeholder text"));
    if (!result.language.empty())
        result.checked.push_back(result.language == "fr" ? Message("French only") : Message("English only"));
    result.checked.push_back(text.is_slides() ? Message("text size") : Message("text size and margins"));
}

void check_names(const fs::path& file, const PdfLayout& layout, const IdentityMatcher& names, CheckResult& result) {
    result.findings = anonymity_findings(file, layout, names);
    if (names.empty()) return;
    result.checked.push_back(
        plural(static_cast<std::int64_t>(names.people()), "names of {} person", "names of {} people"));
}

}  // namespace

bool CheckResult::passed() const {
    return std::ranges::none_of(findings, [](const Issue& issue) { return issue.severity == Severity::kRule; });
}

void sort_issues(Issues& findings) {
    std::ranges::stable_sort(findings, [](const Issue& a, const Issue& b) {
        return std::tie(a.severity, a.page) < std::tie(b.severity, b.page);
    });
}

DocumentStandard standard_of(const std::string& name) {
    const bool is_file = name.ends_with(".md");
    const fs::path file = is_file ? fs::path(name) : shared_folder() / "report_templates" / (name + ".md");
    const std::vector<std::string> known = installed_templates();
    if (!is_file && std::ranges::find(known, name) == known.end())
        throw EnvironmentError("unknown template '{}'; the templates are {}", name, listed(known));
    std::vector<std::string> guidance = guidance_of(read_text(file));
    const fs::path french = fs::path(file).replace_extension(".fr.md");
    if (!is_file && fs::is_regular_file(french)) {
        const std::vector<std::string> more = guidance_of(read_text(french));
        guidance.insert(guidance.end(), more.begin(), more.end());
    }
    return {fs::path(name).stem(), document_rules(read_template(file)), guidance, std::nullopt};
}

DocumentStandard standard_of_lesson(const Lesson& lesson, const std::string& language) {
    DocumentStandard named = standard_of(read_percent_script(lesson.script()).header.template_name);
    const fs::path report = lesson.report(language);
    const bool demands = named.rules.pages || !named.rules.sections.empty();
    return demands || !fs::exists(report) ? named : standard_of(report.string());
}

CheckResult check_pdf(const fs::path& file, const CheckOptions& check_options, const PdfLimits& limits) {
    CheckResult result;
    result.subject = file.string();
    try {
        const PdfLayout layout = read_pdf_layout(file, limits);
        const DocumentText text = text_of_layout(layout);
        const DocumentStandard standard = standard_for(text, check_options);
        result.template_name = standard.template_name;
        result.pages = static_cast<int>(layout.pages.size());
        if (check_options.names) check_names(file, layout, *check_options.names, result);
        if (text.words.empty()) {
            result.findings.push_back(
                {"scanned", Severity::kRule, 0, "",
                 Message("The document has no text: its pages are pictures, such as a scan or photographs."),
                 Message("Submit the PDF that dynlab report creates, not a scan of a printout.")});
            sort_issues(result.findings);
            return result;
        }
        check_text(layout, text, standard, result);
        if (layout.protected_by_password) {
            result.findings.push_back(
                {"protected", Severity::kHint, 0, "", Message("A password protects the file against changes."),
                 Message("Save the PDF again without protection, so that review copies can be created.")});
        }
    } catch (const PdfRefusal& refusal) {
        if (refusal.fault() == PdfFault::kNotThere) throw;
        result.findings.push_back(file_finding(refusal));
    }
    sort_issues(result.findings);
    return result;
}

}  // namespace dynlab::inline course
