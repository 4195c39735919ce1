#pragma once
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/live/page_content.h"
#include "course/issues/lesson_reader.h"
#include "documents/chunks/chunk_setter.h"
#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline app {

/// Content of a page for its browser tabs. A new tab gets the complete content, other tabs get the changes since their
/// version. Thread-safe.
class LivePage {
  public:
    /// Shows a cached page as the next version. The page is marked as cached until a document is shown.
    void show(PageContent saved_entry);
    /// Makes the next version of a document that was set. Figures are read from their files now.
    void show(const SetDocument& document, const PercentScript& script, const RunRecord& record);
    /// In which the page speaks, and all that is said of the document, what is wrong with it by now, too. What authors
    /// of the lesson's checks wrote is read as the lesson has it when it is first needed.
    void speak(const std::string& language, const std::string& lesson);
    /// Text above the page: what is wrong. The document stays as it is.
    void complain(const std::vector<Message>& sentences);
    void set_states(std::map<std::string, CellState> states, bool running);
    void set_running(bool running);
    void ask_whether_to_run(bool asking);
    void set_made_here(bool made_here);  ///< `dynlab new` made the document's folder on this computer
    /// Answers that the script does not give yet, "G1 (model), gain (number)".
    void set_open_answers(std::string answers);
    void set_sources(std::map<std::string, std::string> digests);  ///< of the files that the page may change
    void set_can_submit(bool can_submit);                          ///< whether report and zip can be asked for
    /// Findings: JSON, in English, or empty; `checking`: the part of dynlab check that is done while it runs, else
    /// none.
    void set_work(std::string findings, bool pdf_is_ready, std::optional<double> checking = {});
    std::string translated(const Message& message) const;  ///< in the page's language

    PageContent content() const;  ///< of the last version alone
    bool settled() const;  ///< the run came to its end, or to a mistake; not one that was stopped, nor one of before

    /// Everything, JSON.
    std::string whole() const;
    /// What has changed since the last call; nothing when nothing has.
    std::optional<std::string> changes();
    /// A picture that the page shows: type and bytes.
    std::optional<std::pair<std::string, std::string>> picture(const std::string& name) const;

  private:
    void add_unseen_cells(const PercentScript& script, std::map<std::string, std::string>& html);
    std::string with_pictures(const SetChunk& chunk, const RunRecord& record);
    std::string keep_picture(const std::filesystem::path& file);
    const LessonReader& reader() const;
    std::string json(bool all) const;

    mutable std::mutex mutex_;
    PageContent content_;
    std::vector<std::string> fresh_;  ///< ids that the last version did not have
    std::map<std::string, std::string> sources_;
    std::optional<RecordedError> error_;  ///< of the run that the page shows
    std::string issues_;
    std::string language_ = "en", lesson_;
    mutable std::optional<LessonReader> reader_;  ///< once it was needed
    std::optional<double> checking_;
    bool pdf_is_ready_ = false, can_submit_ = false, made_here_ = false;
    bool running_ = false, from_cache_ = false, asking_ = false;
    bool changed_ = false, text_changed_ = false, issues_changed_ = false;
    std::uint64_t version_ = 0;
};

}  // namespace dynlab::inline app
