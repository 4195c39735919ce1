#pragma once
#include "cli/commands.h"
#include "course/store/course_store.h"

namespace dynlab {

/// What all commands of `dynlab course` share.
struct CourseWords {
    std::string folder = ".";
};

void add_time_option(CLI::App& command, std::string& text);      ///< --at TIME
Instant time_of(const Course& course, const std::string& text);  ///< of --at; now when that is empty

/// final changes: below the command final.
void add_final_changes(CLI::App& final, CourseWords& where, Action& action);

/// receive, review receive, final receive, verify.
void add_receive_commands(CLI::App& course, CourseWords& where, Action& action);

/// peer assign, peer send, peer show, release.
void add_peer_commands(CLI::App& course, CourseWords& where, Action& action);

/// findings.
void add_findings_command(CLI::App& course, CourseWords& where, Action& action);

/// scores, oral, marks, override, export, import.
void add_mark_commands(CLI::App& course, CourseWords& where, Action& action);

}  // namespace dynlab
