#pragma once
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "app/live/folder_watch.h"
#include "app/live/page_content.h"
#include "app/live/script_runner.h"
#include "app/workbench/session_text.h"
#include "app/workbench/view_cells.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {

/// A session: a script that is run as it is changed, and views of what it computed. One thread works (`work`); orders
/// come from any.
class WorkbenchSession {
  public:
    /// `runner` has workbench_prelude(), and was made before the program had threads.
    WorkbenchSession(std::filesystem::path file, ScriptRunner& runner);

    /// With the text that an order of the page made, once it may run.
    void on_saving(std::function<void(const std::string&)> notify) { notify_saving_ = std::move(notify); }
    void on_change(std::function<void()> notify) { notify_ = std::move(notify); }
    /// Until end() or Ctrl-C. What is not on disk then is saved; throws EnvironmentError where it cannot be.
    void work();

    std::optional<std::size_t> change(const ScriptOrder& order);  ///< as SessionText::obey(); the revision then
    void put(const std::function<std::string(const std::string&)>& make);  ///< from the current script
    void undo();
    void redo();
    std::size_t look(const ViewOrder& order);  ///< the number of the order
    void stop();                               ///< the running part; the text before it is still shown
    void again();                              ///< runs what was stopped
    void allow_runs();                         ///< nothing is run before
    void end();
    /// What a run saved (workbench.show "saved"), by its name. Throws EnvironmentError where there is none.
    std::string saved(const std::string& name) const;

    std::optional<Message> mistake() const;                ///< at which the script stops, as the last run reported
    std::string translated(const Message& message) const;  ///< in the script's language
    std::string script() const;
    std::filesystem::path file() const;
    std::string whole() const;             ///< what a page shows, JSON
    std::optional<std::string> changes();  ///< since the last call; nothing when there are none

  private:
    void wake();
    void text_is_ours();
    void follow();
    void save_rest();
    void take_file_changes();
    void take_orders();
    void clear_other_cells();
    void run();
    std::optional<ViewOrder> stale_views();
    void leave_out(std::size_t part);
    std::string text_to_run() const;
    bool ends_early(const std::string& text) const;
    void take(RunnerNews news);
    void take_record(const RunnerNews& news);
    std::string json(bool all) const;
    std::string language() const;  ///< that of the script

    ScriptRunner& runner_;
    std::function<void()> notify_ = [] {};
    std::function<void(const std::string&)> notify_saving_ = [](const std::string&) {};
    TemporaryFolder figures_;
    FolderWatch watch_;
    FileDescriptor wake_;
    std::set<std::filesystem::path> data_;          ///< places of files that the script read
    std::set<std::filesystem::path> changed_data_;  ///< of them, and no run knows of it

    mutable std::mutex mutex_;
    SessionText text_;
    ViewOrder looked_at_;
    std::size_t looks_ = 0, run_looks_ = 0;  ///< orders of views; those that the run knows
    using MadeFrom = std::map<std::string, std::string>;
    MadeFrom seen_, under_way_;  ///< by view: the text and the settings that it was made from, or is being made from
    bool old_ = true, stop_ = false, may_run_ = false, stopped_ = false;
    std::atomic<bool> end_ = false;

    std::size_t run_revision_ = 0;             ///< of the text that runs, or ran last
    std::optional<std::size_t> lines_to_run_;  ///< those before a part that failed or was stopped; all when empty
    std::map<std::string, CellState> states_;
    std::map<std::string, std::string> printed_;  ///< by cell
    std::optional<RecordedError> error_;
    Message unread_;  ///< why what another program wrote into the script's file is not taken; else empty
    struct View {
        std::string json;
        bool fresh = true;
    };
    std::map<std::string, View> views_;
    std::size_t sent_revision_ = 0;
    std::string sent_language_;  ///< of what is said of the estimators
    bool changed_ = true;
};

}  // namespace dynlab::inline app
