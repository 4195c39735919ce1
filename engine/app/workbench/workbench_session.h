#pragma once
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/live/folder_watch.h"
#include "app/live/page_content.h"
#include "app/live/script_runner.h"
#include "app/workbench/session_text.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {

/// What the page wants to see besides the script: handed to draw_workbench of views.lua.
struct ViewOrder {
    std::vector<std::string> variables;  ///< of the script, whose values are looked at
    std::string settings;                ///< JSON: which views, of which variables, and how
    int data_until = 0;                  ///< the last line of the script on which the records that are looked at depend
};
DYNLAB_DESCRIBE(ViewOrder, variables, settings, data_until)

/// The Lua that runs before a session's script: the functions that look at its variables.
std::string workbench_prelude();
/// Cells that stand behind a session's script: they hand its variables and the settings to the prelude, what is quick
/// first. Throws ValueError for names that are none and for settings that are no JSON.
std::string view_cells(const ViewOrder& order);

/// A session: a script that is run as it is changed, and views of what it computed. One thread works (`work`); orders
/// come from any.
class WorkbenchSession {
  public:
    /// `runner` has workbench_prelude(), and was made before the program had threads.
    WorkbenchSession(std::filesystem::path file, ScriptRunner& runner);

    void on_change(std::function<void()> tell) { tell_ = std::move(tell); }
    void work();  ///< until end() or Ctrl-C

    std::optional<std::size_t> change(const ScriptOrder& order);  ///< as SessionText::obey(); the revision then
    void put(const std::string& text);
    void undo();
    void redo();
    std::size_t look(const ViewOrder& order);  ///< the number of the order
    void stop();                               ///< the part that runs; what stands before it is still looked at
    void again();                              ///< runs what was stopped
    void allow_runs();                         ///< nothing is run before
    void end();
    /// What a run saved (workbench.show "saved"), by its name. Throws EnvironmentError where there is none.
    std::string saved(const std::string& name) const;

    std::optional<std::string> mistake() const;  ///< at which the script stops, as the last run told it
    std::string script() const;
    std::filesystem::path file() const;
    std::string whole() const;             ///< what a page shows, JSON
    std::optional<std::string> changes();  ///< since the last call; nothing when there are none

  private:
    void wake();
    void take_orders();
    void run();
    std::optional<ViewOrder> stale_views();
    void leave_out(std::size_t part);
    std::string text_to_run() const;
    bool ends_early(const std::string& text) const;
    void take(RunnerNews news);
    void take_record(const RunnerNews& news);
    std::string json(bool all) const;
    std::string language() const;  ///< that of the script, "en" or "fr"

    ScriptRunner& runner_;
    std::function<void()> tell_ = [] {};
    TemporaryFolder figures_;
    FolderWatch watch_;
    FileDescriptor wake_;
    std::set<std::filesystem::path> data_;  ///< files that the script read
    std::set<std::filesystem::path> changed_data_;

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
    struct View {
        std::string json;
        bool fresh = true;
    };
    std::map<std::string, View> views_;
    std::size_t sent_revision_ = 0;
    bool changed_ = true;
};

}  // namespace dynlab::inline app
