#pragma once
#include <sys/types.h>

#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "app/live/channel.h"
#include "app/live/runner_messages.h"
#include "scripting/runtime/script_parts.h"
#include "workflow/make_report.h"

namespace dynlab::inline app {

/// Runs a script repeatedly while the user writes it: parts before the first changed part are not run again. The script
/// runs in separate processes (app/live/runner_process.h), so that a run can always be stopped and a failure affects
/// nothing else. Only one thread may use the object, except for `ask`.
class ScriptRunner {
  public:
    /// Which cells of the script a run is about, by their ids; empty: all of them.
    struct RunExtent {
        std::string again;  ///< runs again, changed or not
        std::string until;  ///< the last that runs
    };

    /// Starts the first process. To be made before the program has threads.
    explicit ScriptRunner(RunnerEnvironment world = {});
    ~ScriptRunner();  ///< ends all of them
    ScriptRunner(const ScriptRunner&) = delete;
    ScriptRunner& operator=(const ScriptRunner&) = delete;

    /// Runs the script of `request`, with its seed and sliders, from the first part that differs from what ran before,
    /// asks for a slider that was moved or reads a file whose place_of() is in `changed`; a run that is under way is
    /// given up, but not for a change of text alone. Where a process that kept a state has died, it begins from the one
    /// before. Returns the part with which it begins; throws EnvironmentError when there is none any more.
    std::size_t run(const ReportRequest& request, const std::filesystem::path& figure_folder,
                    const std::set<std::filesystem::path>& changed, const RunExtent& extent = {});
    /// The answer to a question about the state of the executed part of the script, as JSON; empty if there is no
    /// answer within two seconds. Any thread may call it.
    std::string ask(RunOrder question);
    void stop();                          ///< gives the run up; the next begins behind the last part that was kept
    void forget() { settings_.clear(); }  ///< the next run begins with the first part
    bool running() const { return running_; }
    bool finished() const { return done_ == parts_.size(); }  ///< every part has run

    /// To be polled for reading; -1 when nothing runs.
    int descriptor() const;
    /// The next message of the run; waits for it. A process that died is reported as a failure of its part.
    RunnerNews next();

    const std::vector<ScriptPart>& parts() const { return parts_; }

  private:
    /// A process that waits with the state behind so many parts.
    struct Kept {
        std::size_t parts;
        Channel line;
        pid_t process;
    };
    bool is_as_it_ran(std::size_t part, const std::vector<ScriptPart>& parts, const ReportRequest& request,
                      const std::set<std::filesystem::path>& changed) const;
    bool send_order();
    void go_back_to(std::size_t parts);
    void end_last();

    std::vector<Kept> kept_;  ///< by the number of parts; the last one is the process that runs, where one does
    RunOrder order_;          ///< the last
    std::vector<ScriptPart> parts_;
    struct Used {
        std::set<std::filesystem::path> files;  ///< their places
        std::map<std::string, RecordedSlider> sliders;
    };
    std::vector<Used> used_;                       ///< by each part: what had been used behind it
    std::string settings_;                         ///< file, seed and header of the run
    std::map<std::string, double> slider_values_;  ///< of the run
    std::size_t done_ = 0;                         ///< parts that are over
    std::size_t under_way_ = 0;
    bool keeps_end_ = true;
    std::recursive_mutex mutex_;
    std::size_t questions_ = 0;
    bool running_ = false, split_ = false;  ///< split: the process that got the order has made the one that runs
};

}  // namespace dynlab::inline app
