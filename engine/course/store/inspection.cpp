#include "course/store/inspection.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "course/findings_report.h"

namespace dynlab {
namespace {

constexpr int kPagesOfReview = 2;

Inspection inspect(const InspectionJob& job) {
    CheckWishes wishes;
    if (job.part == "review") {
        wishes.standard.emplace();
        wishes.pages = kPagesOfReview;
    } else {
        wishes.standard = standard_of(job.part == "slides" ? "slides" : "lab_report");
    }
    CheckResult result = check_pdf(job.file, wishes);
    result.subject = job.part + ".pdf";
    return inspection_from(findings_as_json(result));
}

}  // namespace

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

std::vector<Inspection> inspect_all(const std::vector<InspectionJob>& jobs,
                                    const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<Inspection> found(jobs.size());
    std::vector<std::exception_ptr> failures(jobs.size());
    std::atomic<std::size_t> next = 0, done = 0;
    const auto work = [&](bool shows) {
        for (std::size_t i = next++; i < jobs.size(); i = next++) {
            try {
                found[i] = inspect(jobs[i]);
            } catch (...) {
                failures[i] = std::current_exception();
            }
            ++done;
            if (shows && progress) progress(done, jobs.size());
        }
    };
    {
        std::vector<std::jthread> others;
        const std::size_t workers =
            std::min<std::size_t>(jobs.size(), std::max(1u, std::thread::hardware_concurrency()));
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back(work, false);
        work(true);
    }
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
    return found;
}

}  // namespace dynlab
