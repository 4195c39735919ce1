#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/live/page_content.h"
#include "app/live/runner_messages.h"
#include "app/workbench/session_text.h"
#include "app/workbench/view_cells.h"
#include "base/reader.h"
#include "scripting/runtime/script_parts.h"

namespace dynlab::inline app {

/// What runs the parts of a session's script: processes on a machine with dynlab, the engine of the page in a browser.
class PartRunner {
  public:
    virtual ~PartRunner() = default;
    /// Begins with the first part that differs from what ran before or reads a file in `changed`, and returns its
    /// number. News of the parts follow. Throws EnvironmentError if nothing can run any more.
    virtual std::size_t run(const PercentScript& script, const std::set<std::filesystem::path>& changed) = 0;
    virtual const std::vector<ScriptPart>& parts() const = 0;
    virtual bool running() const = 0;
};

/// A workbench session without threads and processes: a script, what its last run computed, and what a page shows of
/// both. The caller runs it again (`run`) after orders and passes on the runner's news (`take`). For one thread at a
/// time.
class BenchState {
  public:
    /// `past`: as for SessionText.
    BenchState(std::filesystem::path file, PartRunner& runner, std::vector<std::string> past = {});

    std::optional<std::size_t> change(const ScriptOrder& order);  ///< as SessionText::obey(); the revision then
    void put(const std::function<std::string(const std::string&)>& make);  ///< from the current script
    void undo();
    void redo();
    std::size_t look(const ViewOrder& order);  ///< the number of the order
    void again();                              ///< runs what was stopped
    void allow_runs();                         ///< nothing is run before
    /// The text before the stopped part, that with a cell or the first that has not finished, is still shown.
    void run_was_stopped(const std::string& cell = "");
    void read_changed_file();                              ///< what another program wrote into the script's file
    void data_changed(const std::filesystem::path& file);  ///< that the script reads

    bool may_run() const { return may_run_; }
    bool must_run() const { return may_run_ && (old_ || run_revision_ != text_.revision()); }
    void run();
    void take(RunnerNews news);

    const SessionText& text() const { return text_; }
    bool save() { return text_.save(); }     ///< as SessionText::save()
    std::optional<Message> mistake() const;  ///< at which the script stops, as the last run reported
    Reader reader() const;                   ///< of messages in the script's language
    std::string json(bool all) const;        ///< what a page shows, or of it what has changed since changes()
    std::optional<std::string> changes();    ///< since the last call; nothing when there are none

  private:
    void clear_other_cells();
    std::optional<ViewOrder> stale_views();
    void leave_out(std::size_t part);
    std::string text_to_run() const;
    bool ends_early(const std::string& text) const;
    void take_record(const RunnerNews& news);
    std::string language() const;  ///< that of the script

    PartRunner& runner_;
    std::set<std::filesystem::path> changed_data_;  ///< and no run knows of it
    SessionText text_;
    ViewOrder looked_at_;
    std::size_t looks_ = 0, run_looks_ = 0;  ///< orders of views; those that the run knows
    using MadeFrom = std::map<std::string, std::string>;
    MadeFrom seen_, under_way_;  ///< by view: the text and the settings that it was made from, or is being made from
    bool old_ = true, may_run_ = false, stopped_ = false;

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
