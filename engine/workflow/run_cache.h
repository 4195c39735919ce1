#pragma once
#include <optional>
#include <string>

#include "documents/run_record.h"
#include "figures/gnuplot_renderer.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline workflow {

/// Keeps what runs produced, figures drawn, so that a script is not run again when only its prose or its template
/// was edited. A run is known by the script's code (all its code cells), its folder, the seed, the
/// sliders, the program and what it read. Runs that failed are not remembered, nor those whose output names lines of
/// the script, which an edit moves.
class RunCache {
  public:
    /// `cache` must outlive it.
    RunCache(const ReportRequest& request, FigureFormat format, const Cache& cache);

    /// The record of an equal run, its figures' files in the cache.
    std::optional<RunRecord> load_entry() const;
    /// All figures of the record must have been drawn. Where it cannot be kept, nothing is.
    void save_entry(const RunRecord& record) const;

  private:
    void keep(const RunRecord& record) const;

    const Cache& cache_;
    std::filesystem::path script_;
    std::string entry_;  ///< of everything that is known before the run: holds what the run read; empty where nothing
                         ///< lasts
};

}  // namespace dynlab::inline workflow
