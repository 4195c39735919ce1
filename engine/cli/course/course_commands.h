#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "course/store/course_store.h"
#include "platform/terminal/progress.h"

namespace dynlab::inline cli {

/// What all commands of `dynlab course` share.
struct CourseArguments {
    std::string folder = ".";
};

void add_time_option(CLI::App& command, std::string& text);  ///< --at TIME
/// --after N
void add_after_option(CLI::App& command, std::optional<std::int64_t>& entry);
Instant time_of(const Course& course, const std::string& text);  ///< of --at; now when that is empty

/// Shows how far work is that says only when it begins how much there is.
class WorkBar {
  public:
    explicit WorkBar(std::string what) : what_(std::move(what)) {}
    std::function<void(std::size_t, std::size_t)> progress() {
        return [this](std::size_t done, std::size_t total) {
            if (!bar_) bar_ = std::make_unique<ProgressBar>(what_, total);
            bar_->advance(done);
        };
    }
    void finish() { bar_.reset(); }

  private:
    std::string what_;
    std::unique_ptr<ProgressBar> bar_;
};

/// changes.
CLI::App* add_changes(CLI::App& course, CourseArguments& where, Action& action);

/// submit, review collect, verify.
void add_receive_commands(CLI::App& course, CourseArguments& where, Action& action);

/// answers.
void add_course_answers(CLI::App& course, CourseArguments& where, Action& action);

/// review assign, review send, review pairs, review release, deliver; after add_receive_commands.
void add_peer_commands(CLI::App& course, CourseArguments& where, Action& action);

/// set-received, withdraw, restore, extend, withhold, history.
void add_correction_commands(CLI::App& course, CourseArguments& where, Action& action);

/// remind.
void add_remind_command(CLI::App& course, CourseArguments& where, Action& action);

/// findings.
void add_issues_command(CLI::App& course, CourseArguments& where, Action& action);

/// grade, mark.
void add_grade_commands(CLI::App& course, CourseArguments& where, Action& action);

/// page; in cli/pages.
void add_course_page(CLI::App& course, CourseArguments& where, Action& action);

/// scores, marks, export.
void add_mark_commands(CLI::App& course, CourseArguments& where, Action& action);

}  // namespace dynlab::inline cli
