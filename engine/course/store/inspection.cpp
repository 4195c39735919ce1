#include "course/store/inspection.h"

#include <set>

#include "course/issues/document_issues.h"
#include "course/issues/issues_report.h"

namespace dynlab::inline course {
namespace {

Inspection summary_of(const CheckResult& result, const std::string& json_text) {
    static const std::set<std::string> unreadable = {"not-pdf", "encrypted",      "damaged",    "too-large",
                                                     "scanned", "closed-archive", "other-kind", "several",
                                                     "empty",   kNotTaken,        kBeside};
    Inspection inspection;
    inspection.json = json_text;
    for (const Issue& issue : result.findings) {
        if (issue.severity != Severity::kRule) continue;
        ++inspection.rules_broken;
        if (unreadable.contains(issue.id)) inspection.error_reason = issue.id, inspection.reason = issue.what;
        inspection.names = inspection.names || issue.id.starts_with("name-");
    }
    return inspection;
}

DocumentStandard standard_of_reports(const std::string& lesson) {
    try {
        if (!lesson.empty()) return standard_of_lesson(find_lesson(lesson));
    } catch (const std::runtime_error&) {
        // A course may be older than the lessons that are installed, and its hand-ins are received all the same.
    }
    return standard_of("lab_report");
}

}  // namespace

Inspector::Inspector(std::shared_ptr<const IdentityMatcher> names, const std::string& lesson) {
    const auto hold_against = [this](const char* part, const char* template_name) {
        options_by_part_[part].standard = standard_of(template_name);
    };
    options_by_part_["report"].standard = standard_of_reports(lesson);
    hold_against("slides", "slides");
    hold_against("review", "peer_review");
    options_by_part_["review"].names = std::move(names);
}

Inspection Inspector::inspect(const std::filesystem::path& pdf, const std::string& part) const {
    CheckResult result = check_pdf(pdf, options_by_part_.at(part));
    result.subject = part + ".pdf";
    return summary_of(result, issues_as_json(result));
}

Inspection unreadable_inspection(const std::string& error_reason, const Message& reason) {
    CheckResult result;
    result.subject = kUnreadable;
    result.findings.push_back({error_reason, Severity::kRule, 0, "", reason, Message("Submit a readable file.")});
    return inspection_from(issues_as_json(result));
}

Inspection inspection_from(const std::string& json) {
    return json.empty() ? Inspection() : summary_of(issues_from_json(json), json);
}

}  // namespace dynlab::inline course
