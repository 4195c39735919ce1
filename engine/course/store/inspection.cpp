#include "course/store/inspection.h"

#include <nlohmann/json.hpp>
#include <set>

#include "course/findings/findings_report.h"

namespace dynlab::inline course {

Inspector::Inspector(std::shared_ptr<const SoughtNames> names) {
    const auto hold_against = [this](const char* part, const char* template_name) {
        wishes_[part].standard = standard_of(template_name);
    };
    hold_against("report", "lab_report");
    hold_against("slides", "slides");
    hold_against("review", "peer_review");
    wishes_["review"].names = std::move(names);
}

Inspection Inspector::inspect(const std::filesystem::path& pdf, const std::string& part) const {
    CheckResult result = check_pdf(pdf, wishes_.at(part));
    result.subject = part + ".pdf";
    return inspection_from(findings_as_json(result));
}

Inspection inspection_from(const std::string& json) {
    static const std::set<std::string> unreadable = {"not-pdf", "encrypted", "damaged", "too-large", "scanned"};
    Inspection inspection;
    if (json.empty()) return inspection;
    inspection.json = json;
    const nlohmann::json report = nlohmann::json::parse(json);
    if (report.at("pages").is_number()) inspection.pages = report.at("pages");
    for (const auto& finding : report.at("findings")) {
        if (finding.at("severity") != "rule") continue;
        ++inspection.rules_broken;
        const std::string id = finding.at("id");
        if (unreadable.contains(id)) inspection.trouble = id;
        inspection.names = inspection.names || id.starts_with("name-");
    }
    return inspection;
}

}  // namespace dynlab::inline course
