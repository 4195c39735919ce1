#pragma once
#include <string>

#include "documents/run_record.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline workflow {

/// A digest of everything that a document is made from and that is known before its run: script, template, all of
/// report_templates/, seed, sliders, program. Where it is written to is not part of it. Throws EnvironmentError for a
/// file that cannot be read.
std::string digest_of_origins(const ReportRequest& request);

/// Knows what a report was made from, so that it is not made again when nothing changed: script, template, all of
/// report_templates/, seed, program, what the script read, and the output file itself, all by content.
class ReportCache {
  public:
    /// `cache` must outlive it.
    ReportCache(const ReportRequest& request, const Cache& cache);

    bool unchanged() const;
    void save_entry(const RunRecord& record) const;

  private:
    const Cache& cache_;
    std::filesystem::path output_, script_folder_;
    std::string entry_;  ///< of everything that is known before the run; empty where nothing lasts
};

}  // namespace dynlab::inline workflow
