#include "course/store/inspection.h"

#include <nlohmann/json.hpp>
#include <set>

#include "course/findings_report.h"

namespace dynlab {
namespace {

constexpr int kPagesOfReview = 2;

}  // namespace

Inspection inspect(const std::filesystem::path& pdf, const std::string& part) {
    CheckWishes wishes;
    if (part == "review") {
        wishes.standard.emplace();
        wishes.pages = kPagesOfReview;
    } else {
        wishes.standard = standard_of(part == "slides" ? "slides" : "lab_report");
    }
    CheckResult result = check_pdf(pdf, wishes);
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
        if (unreadable.contains(finding.at("id"))) inspection.trouble = finding.at("id");
    }
    return inspection;
}

}  // namespace dynlab
