#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/office/answer_book.h"
#include "base/reader.h"
#include "course/store/assignments.h"
#include "course/store/course_store.h"

namespace dynlab::inline app {

/// What the instructor's page shows of a course, as JSON. Everything is read from the store when it is asked for, by
/// one thread at a time: the store has one connection, and the course's time zone is the process's. Texts of messages
/// are in the language that is asked for.
class OfficeViews {
  public:
    /// `more` is called by another thread when more answers have been read. Throws EnvironmentError.
    OfficeViews(const std::filesystem::path& folder, std::function<void()> more);

    /// Changes whenever another process has changed the store.
    std::int64_t revision();
    std::filesystem::path folder() const { return course_.folder(); }

    std::string course();  ///< name, zone, assignments, names of all groups and students
    std::string today(const std::string& language);
    std::string student(const std::string& name, const std::string& language);
    std::string reviews(const std::string& assignment);
    std::string marks();
    /// Answers to one question of a lab, under names that do not identify their authors. An empty or unknown argument
    /// is chosen automatically: the first lab, a question, and the check of that question.
    std::string marking(const std::string& assignment, const std::string& question, const std::string& check,
                        const std::string& language);
    std::string answer(const std::string& assignment, const std::string& question, const std::string& name);
    /// The newest entry of the mark of these answers.
    std::string entry(const std::string& assignment, const std::string& name, const std::string& check);

  private:
    std::vector<SubmittedWork> work_of(const Assignment& lab);
    const LessonQuestions& questions_of(const std::string& lesson);
    std::string shown(Instant instant) const;  ///< without the weekday, which is English

    std::mutex mutex_;
    Course course_;
    std::map<std::string, LessonQuestions> lessons_;
    AnswerBook answers_;
};

}  // namespace dynlab::inline app
