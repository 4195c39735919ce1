#pragma once
#include <atomic>
#include <mutex>
#include <optional>
#include <string>

#include "app/live/folder_watch.h"
#include "app/live/script_runner.h"
#include "app/workbench/bench_state.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {

/// The Lua that runs before a session's script: the functions that look at its variables.
std::string workbench_prelude();

/// The processes that run a session's script.
class ProcessPartRunner : public PartRunner {
  public:
    explicit ProcessPartRunner(ScriptRunner& runner) : runner_(runner) {}
    std::size_t run(const PercentScript& script, const std::set<std::filesystem::path>& changed) override;
    const std::vector<ScriptPart>& parts() const override { return runner_.parts(); }
    bool running() const override { return runner_.running(); }
    const std::filesystem::path& figures() const { return figures_.path(); }

  private:
    ScriptRunner& runner_;
    TemporaryFolder figures_;
};

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

    // The orders of BenchState.
    std::optional<std::size_t> change(const ScriptOrder& order);
    void put(const std::function<std::string(const std::string&)>& make);
    void undo();
    void redo();
    std::size_t look(const ViewOrder& order);
    void again();
    void allow_runs();
    void stop();  ///< the running part; the text before it is still shown
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
    void take_news();

    ScriptRunner& runner_;
    ProcessPartRunner parts_;
    std::function<void()> notify_ = [] {};
    std::function<void(const std::string&)> notify_saving_ = [](const std::string&) {};
    FolderWatch watch_;
    FileDescriptor wake_;
    std::set<std::filesystem::path> data_;  ///< places of files that the script read

    mutable std::mutex mutex_;
    BenchState state_;
    bool stop_ = false;
    std::atomic<bool> end_ = false;
};

}  // namespace dynlab::inline app
