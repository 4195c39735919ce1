#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "app/live/folder_watch.h"
#include "app/live/live_page.h"
#include "app/live/page_cache.h"
#include "app/live/script_runner.h"
#include "documents/chunks/chunk_setter.h"
#include "platform/temporary_folder.h"
#include "workflow/make_report.h"

namespace dynlab::inline app {

/// A line of a document's script.
struct RunPlace {
    std::string file;
    int line = 0;
    bool again = false;  ///< its cell runs, changed or not
};
DYNLAB_DESCRIBE(RunPlace, file, line, again)

/// A document that follows its script, its template, the data it reads, the pictures it shows and its literature. One
/// thread works (`work`); orders come from others.
class LiveDocument {
  public:
    /// `read` gives the document as it is now, and may throw; `runner` was made before the program had threads.
    LiveDocument(std::function<ReportRequest()> read, ScriptRunner& runner, LivePage& page);

    /// Called after each change of the page, in the thread that works.
    void on_change(std::function<void()> notify) { notify_ = std::move(notify); }
    /// Called after each reading of the document, in the same thread.
    void on_reading(std::function<void(const std::map<std::string, double>& slider_values)> notify) {
        notify_reading_ = std::move(notify);
    }
    /// Works until `end` or Ctrl-C. Nothing is run before `allow_runs`.
    void work();

    void allow_runs();
    void stop_run();
    /// Runs to the cell there, what has changed; with `again` from that cell on to the end.
    void run_at(const RunPlace& place);
    void run_again_from_start();                                    ///< from the first cell
    void set_sliders(const std::map<std::string, double>& values);  ///< by their names
    void end();

  private:
    using Clock = std::chrono::steady_clock;
    void follow();
    void wait_for_something();
    void take_orders();
    bool is_ours(const std::filesystem::path& changed) const;
    void or_complain(const std::function<void()>& act);
    void read_again(const std::set<std::filesystem::path>& changed, const RunPlace& place = {});
    void run(const std::set<std::filesystem::path>& changed_data, const RunPlace& place = {});
    void take_news();
    void take(RunnerNews news);
    void set_page();
    bool load_saved_page();
    void save_page();
    void show_states();
    void settle_sliders();
    void watch_inputs();
    void wake();

    std::function<ReportRequest()> read_;
    ScriptRunner& runner_;
    LivePage& page_;
    std::function<void()> notify_ = [] {};
    std::function<void(const std::map<std::string, double>&)> notify_reading_ = [](const auto&) {};
    TemporaryFolder figures_;
    FolderWatch watch_;
    ChunkSetter setter_;
    PageMemory memory_;
    std::optional<ReportRequest> request_;
    RunRecord shown_;                          ///< what the page shows: of this run, below it of the one before
    std::string until_;                        ///< the last cell that was asked for, while the script stays; empty: all
    std::map<std::string, CellState> states_;  ///< by cell
    std::set<std::filesystem::path> inputs_;   ///< canonical files that the document is made of
    std::map<std::filesystem::path, std::string> pictures_;  ///< of the page, not figures: canonical file -> digest
    std::set<std::filesystem::path> data_;                   ///< of inputs_, those that the script read
    std::set<std::filesystem::path> changed_;                ///< of inputs_, and not yet looked at
    Clock::time_point last_change_;
    bool page_is_old_ = false;
    Clock::time_point set_from_;       ///< while a run is under way the page is not set before: its end may be near
    bool page_is_unfinished_ = false;  ///< it was set while the run was under way
    std::optional<Clock::time_point> save_at_;    ///< when the page is kept for the next time, where it is whole
    bool opened_ = false;                         ///< a first run was allowed
    std::optional<Clock::time_point> first_run_;  ///< when it begins, where the page is that of a run before
    bool page_is_from_cache_ = false;  ///< it shows a run of before, and stays until this first run has ended

    FileDescriptor wake_;
    std::mutex orders_mutex_;
    bool may_run_ = false, stop_ = false, restart_ = false;  ///< orders
    RunPlace place_;                                         ///< an order, where it names a file
    std::map<std::string, double> sliders_;                  ///< where they were moved to
    std::atomic<bool> end_ = false;
};

}  // namespace dynlab::inline app
