#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/message.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {

/// Creates files of a document in the background: the PDF and, for a folder, the findings of `dynlab check`, while the
/// user does not type; other files when the user requests them. Separate dynlab processes do the work. If the document
/// changes, unfinished work on PDF and findings is canceled.
class BackgroundWork {
  public:
    explicit BackgroundWork(std::string document);
    ~BackgroundWork() { stop(); }
    /// `notify` is called in a thread of this object after each new result.
    void start(std::function<void()> notify);
    void stop();  ///< cancels all work; a request that waits for a PDF gets none

    void document_changed(std::map<std::string, double> slider_values);
    /// Whether work may start a second after the last change without a request: the document has run and a browser tab
    /// shows it.
    void want(bool requested);

    struct Pdf {
        std::string bytes;  ///< empty where it cannot be made
        Message error;      ///< then why
    };
    Pdf pdf();  ///< of the document as it is now; waits until it is made

    /// Result of work that only starts on request, as `dynlab report` and `dynlab pack`.
    struct Made {
        bool done = false;
        Message words;  ///< what the command says, for a reader
    };
    bool can_submit() const;  ///< whether the document is a folder with a report
    Made make_report();       ///< into the folder, as the script says, wherever sliders were moved to
    Made make_pack();         ///< FOLDER.zip beside it

    /// JSON as `dynlab check --json` prints it; empty before it was made, and for a single script.
    std::string findings();
    std::optional<double> checking();  ///< the part of `dynlab check` that is done, from 0 to 1, while it runs
    bool pdf_is_ready();

  private:
    using Clock = std::chrono::steady_clock;
    enum class Task { kNone, kPdf, kFindings };
    void work();
    Made make(std::vector<std::string> command);
    Task next_task(Clock::time_point now) const;
    void do_task(Task task, std::unique_lock<std::mutex>& lock);
    Pdf made_pdf(const std::map<std::string, double>& slider_values, const std::function<bool()>& give_up);
    std::string made_findings(const std::function<bool()>& give_up);
    void set_checking(std::optional<double> done);

    const std::string document_;
    const bool is_folder_;
    std::function<void()> notify_;
    TemporaryFolder folder_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, double> slider_values_;
    std::uint64_t version_ = 1, pdf_version_ = 0, issues_version_ = 0;  ///< what was made is of these
    Clock::time_point change_time_ = Clock::now();
    Pdf pdf_;
    std::string issues_;
    std::optional<double> checking_;
    int waiting_for_pdf_ = 0;
    bool requested_ = false, end_ = false;
    std::mutex making_;
    std::thread thread_;
};

}  // namespace dynlab::inline app
