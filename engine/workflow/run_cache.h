#pragma once
#include <optional>
#include <string>

#include "documents/run_record.h"
#include "figures/gnuplot_renderer.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline workflow {

/// Keeps the results of runs, with figures drawn, so that a script is not run again when only its prose or its template
/// was edited. The key of a run consists of the script's code (all its code cells), its folder, the seed, the sliders,
/// the program and the files it read. The cache keeps neither failed runs nor runs whose output names lines of the
/// script, which an edit moves.
class RunCache {
  public:
    /// `cache` must outlive it.
    RunCache(const ReportRequest& request, FigureFormat format, const Cache& cache);

    /// The results of an equal run, with the figures' files in the cache.
    std::optional<RunRecord> load_entry() const;
    /// All figures of the run results must have been drawn. If the results cannot be kept, nothing is stored.
    void save_entry(const RunRecord& record) const;

  private:
    void keep(const RunRecord& record) const;

    const Cache& cache_;
    std::filesystem::path script_;
    std::string entry_;  ///< of everything that is known before the run: holds what the run read; empty where nothing
                         ///< lasts
};

}  // namespace dynlab::inline workflow
