#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/message.h"
#include "course/answers/lesson_questions.h"
#include "course/intake/roster.h"

namespace dynlab::inline app {

/// A script or a pack of a lab, as the course keeps it.
struct SubmittedWork {
    std::int64_t group = 0;
    std::string part, hash, name;
    std::filesystem::path file;
    std::vector<Student> authors;
};

/// The written answers of a class, without names. Each submission is read once: scripts at once; packs, which are
/// unpacked in a sandbox, by a separate thread.
class AnswerBook {
  public:
    /// `more` is called by that thread when it has read some.
    explicit AnswerBook(std::function<void()> more);
    ~AnswerBook();

    struct Answer {
        std::string text;         ///< Markdown, with "[name]" for names; empty where there is no answer
        Message error_reason;     ///< why the submission cannot be read; else empty
        bool is_reading = false;  ///< it will be there later
    };
    /// The answers of these submissions to a question of a lesson. `roster`: whose names are hidden.
    std::vector<Answer> answers(const std::vector<SubmittedWork>& work, const LessonQuestions& lesson,
                                const QuestionName& question, const std::vector<Student>& roster);

  private:
    struct Read {
        std::vector<TextPart> parts;
        Message error_reason;
    };
    const Read* read(const SubmittedWork& work);
    void read_packs(const std::stop_token& stop);

    std::function<void()> more_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::map<std::string, Read> read_;           ///< by hash
    std::map<std::string, std::string> hidden_;  ///< answers without names
    std::string roster_;                         ///< the names that were hidden
    std::deque<SubmittedWork> waiting_;
    std::set<std::string> requested_;  ///< hashes that are waiting or being read
    std::jthread reader_;              ///< last: it ends before what it uses
};

}  // namespace dynlab::inline app
