#pragma once
#include <string>

#include "documents/run_record.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline workflow {

/// Remembers what a report was made from, so that it is not made again when nothing changed: script, template, all of
/// report_templates/, seed, program, what the script read, and the output file itself, all by content.
class ReportCache {
  public:
    explicit ReportCache(const ReportRequest& request);

    bool unchanged() const;
    void remember(const RunRecord& record) const;

  private:
    Cache cache_;
    std::filesystem::path output_, script_folder_;
    std::string key_;  ///< of everything that is known before the run
};

}  // namespace dynlab::inline workflow
