#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/export/course_worksheet.h"
#include "course/office/course_export.h"
#include "course/office/course_totals.h"
#include "course/review/review_marks.h"
#include "course/review/score_sheet.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

struct MarkArguments {
    std::string assignment, file, at, out, stage = "first", worksheet, column, reason;
    std::vector<std::string> dropped;  ///< reviewer and report
    bool json = false, make_sheet = false;
    OralSheetOptions sheet;
};
using Run = int (*)(const CourseArguments&, const MarkArguments&);

int give_out(const std::string& text, const std::string& file) {
    if (file.empty()) {
        // A file gets what the text is, line ends of CSV included.
        std::cout << (::isatty(STDOUT_FILENO) != 0 ? terminal_text(text) : text);
    } else {
        write_file_atomically(file, text);
        std::cout << file << '\n';
    }
    return kDone;
}

int sheet(const CourseArguments& where, const MarkArguments& args) {
    Course course(where.folder);
    return give_out(oral_sheet(course, assignment_named(course, args.assignment), args.sheet), args.out);
}

int drop(const CourseArguments& where, const MarkArguments& args) {
    Course course(where.folder);
    const Assignment a = assignment_named(course, args.assignment);
    drop_scores(course, a, args.dropped[0], args.dropped[1], args.reason, time_of(course, args.at));
    std::cout << terminal_text(
        fmt::format("{}: the scores of {} for {} are withdrawn.\n", a.name, args.dropped[0], args.dropped[1]));
    return kDone;
}

int scores(const CourseArguments& where, const MarkArguments& args) {
    if (args.make_sheet) return sheet(where, args);
    if (!args.dropped.empty()) return drop(where, args);
    if (args.file.empty())
        throw InvalidArgument("give the CSV file with the scores, or --sheet to create a score sheet");
    Course course(where.folder);
    const Assignment a = assignment_named(course, args.assignment);
    const Instant now = time_of(course, args.at);
    const int fresh = import_scores(course, a, args.stage, args.file, now);
    std::cout << message_text(Message("{}: {}.", a.name, plural(fresh, "{} new score", "{} new scores"))) << '\n';
    return kDone;
}

std::string percent(const FinalMark& mark) {
    return mark.percent ? fmt::format("{:.1f}{}", *mark.percent, mark.given != nullptr ? " (yours)" : "") : "-";
}

/// What was taken off marks, and criteria that were forgotten: a mark without them is of the others only.
void print_penalties_and_gaps(Course& course, const Assignment& a, const Marks& all) {
    for (const Group& group : groups_of(course))
        for (const GroupMark& mark : all.groups) {
            if (mark.group != group.id) continue;
            if (const std::vector<Message> costs = all.costs_of(mark); !costs.empty())
                std::cout << terminal_text(message_text(Message("{}: {}.", group.name, MessageList{costs}))) << '\n';
            if (mark.final_version)
                std::cout << terminal_text(
                    fmt::format("{}: the final version has {:.1f} percent, {:g} percent of the work's mark.\n",
                                group.name, *mark.final_version, a.final_weight));
            const auto print_zeros = [&](const std::string& whose, const std::vector<std::string>& zeros) {
                if (!zeros.empty())
                    std::cout << terminal_text(message_text(Message("{}: the points for {} are missing and count as 0.",
                                                                    whose, listed(zeros, Join::kAnd))))
                              << '\n';
            };
            print_zeros(group.name, mark.zeros);
            for (const StudentMark& own : mark.students) print_zeros(group.name + ", " + own.student, own.zeros);
            if (a.is_report() && mark.scored == 1 && a.reviews > 1)
                std::cout << terminal_text(
                                 message_text(Message("The mark of {} is based on only one review.", group.name)))
                          << '\n';
            std::vector<std::string> forgotten;
            for (std::size_t c = 0; c < a.criteria.size(); ++c)
                if (!mark.medians[c]) forgotten.push_back(a.criteria[c].name);
            if (!forgotten.empty() && forgotten.size() < a.criteria.size())
                std::cout << terminal_text(
                    fmt::format("{}: no points for {}; its mark depends on the other criteria only.\n", group.name,
                                fmt::join(forgotten, " and ")));
        }
}

/// Prints students with individual points, and the comments of the oral.
void print_students_and_comments(Course& course, const Assignment& a, const Marks& all) {
    std::map<std::string, std::string> names;
    for (const Student& student : students_of(course)) names[student.id] = student.name;
    std::vector<std::string> header = {"group", "student", "name"};
    for (const Criterion& c : a.criteria) header.push_back(fmt::format("{} /{}", c.name, c.max_points));
    header.emplace_back("work %");
    std::vector<std::vector<std::string>> rows;
    OralComments said = oral_comments(course, a);
    std::string comments;
    for (const Group& group : groups_of(course)) {
        if (const std::string& comment = said.groups[group.id]; !comment.empty())
            comments += fmt::format("{}: {}\n", group.name, comment);
        for (const std::string& id : group.members)
            if (const std::string& comment = said.students[id]; !comment.empty())
                comments += fmt::format("{}, {} ({}): {}\n", group.name, names[id], id, comment);
        for (const GroupMark& mark : all.groups) {
            if (mark.group != group.id) continue;
            for (const StudentMark& own : mark.students) {
                std::vector<std::string> row = {group.name, own.student, names[own.student]};
                for (const auto& points : own.points) row.push_back(points ? fmt::format("{}", *points) : "-");
                row.push_back(percent(all.work_of(mark, own.student)));
                rows.push_back(row);
            }
        }
    }
    if (!rows.empty()) std::cout << "\nStudents with separate points:\n" << terminal_text(aligned_table(header, rows));
    if (!comments.empty()) std::cout << "\nComments:\n" << terminal_text(comments);
}

int show_lab_marks(Course& course, const Assignment& a) {
    std::map<std::int64_t, std::string> names;
    for (const Group& group : groups_of(course)) names[group.id] = group.name;
    std::vector<std::vector<std::string>> rows;
    for (const LabMark& mark : lab_marks(course, a))
        rows.push_back({names[mark.group], mark.number > 0 ? fmt::format("v{}", mark.number) : "-",
                        mark.earned ? fmt::format("{:.4g} of {:.4g}", *mark.earned, mark.possible) : "-",
                        mark.penalty > 0 ? fmt::format("{:.4g}", mark.penalty) : "-",
                        mark.by_hand ? "yours: " + mark.reason : ""});
    std::ranges::sort(rows);
    std::cout << terminal_text(aligned_table({"group", "version", "points", "penalty", "remark"}, rows));
    return kDone;
}

int marks(const CourseArguments& where, const MarkArguments& args) {
    Course course(where.folder);
    const Assignment a = assignment_named(course, args.assignment);
    if (a.is_lab()) return show_lab_marks(course, a);
    const Marks all = course_marks(course, a, time_of(course, args.at));
    std::vector<std::string> header = {"group"};
    for (const Criterion& c : a.criteria) header.push_back(fmt::format("{} /{}", c.name, c.max_points));
    header.insert(header.end(), {"work %", "reviews %"});
    std::vector<std::vector<std::string>> rows;
    for (const Group& group : groups_of(course))
        for (const GroupMark& mark : all.groups) {
            if (mark.group != group.id) continue;
            std::vector<std::string> row = {group.name};
            for (const auto& median : mark.medians) row.push_back(median ? fmt::format("{}", *median) : "-");
            row.push_back(percent(all.work_of(mark)));
            row.push_back(percent(all.reviews_of(mark)));
            rows.push_back(row);
        }
    std::cout << terminal_text(aligned_table(header, rows));
    print_penalties_and_gaps(course, a, all);
    for (const ReviewPair& pair : review_pairs(course, a))
        for (const ReviewMark& mark : all.reviews)
            if (mark.pair == pair.id && mark.outlier)
                std::cout << terminal_text(fmt::format(
                    "Check the review of {} by {}: its scores are far below the others{}.\n", pair.author_name,
                    pair.reviewer_name,
                    mark.retaliation ? fmt::format("; {} had given {} few points", pair.author_name, pair.reviewer_name)
                                     : ""));
    if (!a.is_report()) print_students_and_comments(course, a, all);
    return kDone;
}

/// Fills in the platform's own table.
int fill_in(Course& course, const std::optional<Assignment>& a, const MarkArguments& args, Instant now) {
    const FilledWorksheet filled = fill_worksheet(course, a, args.worksheet, args.column, now);
    for (const Message& complaint : filled.complaints)
        std::cerr << "dynlab: " << terminal_text(message_text(complaint)) << '\n';
    const int code = give_out(filled.text, args.out);
    if (!args.out.empty()) {
        note_export(course, a ? a->name : "", args.out, "", now);
        std::cout << message_text(plural(static_cast<std::int64_t>(filled.marks), "{} mark", "{} marks")) << '\n';
    }
    return filled.complaints.empty() ? code : kFailed;
}

int export_course(const CourseArguments& where, const MarkArguments& args) {
    Course course(where.folder);
    const Instant now = time_of(course, args.at);
    if (args.json) return give_out(course_json(course), args.out);
    std::optional<Assignment> a;
    if (!args.assignment.empty()) a = assignment_named(course, args.assignment);
    if (!args.worksheet.empty()) return fill_in(course, a, args, now);
    const std::string csv = a ? marks_csv(course, *a, now) : totals_csv(course_totals(course, now));
    const int code = give_out(csv, args.out);
    if (!args.out.empty()) note_export(course, args.assignment, args.out, a ? "" : csv, now);
    return code;
}

struct MarkCommand {
    CLI::App* app;
    std::shared_ptr<MarkArguments> args;
};

MarkCommand add_one(CLI::App& course, const char* name, const char* about, CourseArguments& where, Action& action,
                    Run run) {
    auto args = std::make_shared<MarkArguments>();
    CLI::App* command = course.add_subcommand(name, about);
    command->callback([&where, args, run, &action] { action = [&where, args, run] { return run(where, *args); }; });
    return {command, args};
}

}  // namespace

void add_mark_commands(CLI::App& course, CourseArguments& where, Action& action) {
    const auto scored = add_one(course, "scores", "Read scores of reviewers or of a talk, or create a score sheet",
                                where, action, scores);
    scored.app->add_option("ASSIGNMENT", scored.args->assignment)->required();
    scored.app->add_option("CSV", scored.args->file,
                           "Columns reviewer, report (for a talk group, student, comment), and criteria");
    scored.app->add_option("--drop", scored.args->dropped, "Withdraw the scores of this review; needs --reason")
        ->type_name("REVIEWER REPORT")
        ->expected(2)
        ->excludes("CSV");
    scored.app->add_option("--reason", scored.args->reason, "Reason; recorded in the history")->needs("--drop");
    scored.app->add_flag("--sheet", scored.args->make_sheet, "For a talk: create an empty score sheet");
    scored.app->add_option("-o,--out", scored.args->out, "File of the sheet. Default: standard output.")
        ->type_name("CSV");
    scored.app->add_flag("--students", scored.args->sheet.students, "Add a row for each student to the sheet");
    scored.app->add_flag("--drawn", scored.args->sheet.drawn, "Put the groups of the sheet in random order");
    add_time_option(*scored.app, scored.args->at);
    scored.app
        ->add_option("--stage", scored.args->stage, "final: your own scores of final versions; columns group, criteria")
        ->check(CLI::IsMember({"first", "final"}))
        ->capture_default_str();
    scored.app->footer(
        "Each line is a review: reviewer,report,data,... with the reviewing group and the report's pseudonym (see "
        "review\n"
        "pairs). The reviewer \"instructor\" is you. The latest score counts; - withdraws a score, an empty cell "
        "changes\n"
        "nothing. Scores of a withdrawn review do not count until it is restored. dynlab reads the scores in the pack "
        "of a\n"
        "review (dynlab new review) when it receives the review.\n"
        "For a talk, points in a student's row are only for that student; empty cells get the points of the group.\n"
        "Examples:\n"
        "  dynlab course scores final-talk --sheet --students -o sheet.csv\n"
        "  dynlab course scores crane scores.csv\n"
        "  dynlab course scores crane finals.csv --stage final\n"
        "  dynlab course scores crane --drop group-24 report-12 --reason \"zeros everywhere\"");

    const auto shown = add_one(course, "marks", "Show medians, marks of reports and reviewers, and unusual reviews",
                               where, action, marks);
    shown.app->add_option("ASSIGNMENT", shown.args->assignment, "Assignment. Required if there are several.");
    add_time_option(*shown.app, shown.args->at);
    shown.app->footer(
        "Mark of a report: 100 times the sum of the medians over the sum of the maximum points. Mark of a reviewer:\n"
        "100 (1 - 2 d), at least 0, averaged over the reviews; d is the mean of |points - median of the others| / "
        "maximum.\n"
        "A review is far below the others if the average difference exceeds 0.35 of the scale. An example: dynlab "
        "help\n"
        "review_marks");

    const auto given =
        add_one(course, "export", "Export one row for each student as CSV, or the complete store as JSON", where,
                action, export_course);
    given.app->add_option("ASSIGNMENT", given.args->assignment,
                          "Assignment. Default: all assignments, and the weighted total.");
    add_time_option(*given.app, given.args->at);
    given.app->add_option("-o,--out", given.args->out, "Output file. Default: standard output.")->type_name("FILE");
    given.app->add_flag("--json", given.args->json, "Export the complete store, for import");
    given.app
        ->add_option("--worksheet", given.args->worksheet,
                     "Moodle's grading worksheet or Canvas's gradebook, as downloaded: fill in the marks there")
        ->type_name("CSV")
        ->check(CLI::ExistingFile)
        ->excludes("--json");
    given.app->add_option("--column", given.args->column, "Column to fill in, in Canvas, such as \"Lab 4 (1234)\"")
        ->type_name("NAME")
        ->needs("--worksheet");
    given.app->footer(
        "Without an assignment, the CSV contains the percentages of each student and the total, weighted by "
        "assignment. Work\n"
        "that is missing after its deadline counts 0. Unmarked work does not count; dynlab lists it.\n"
        "With --worksheet, dynlab writes the marks into the platform's table, scaled to the maximum points of the "
        "column.\n"
        "Examples:\n"
        "  dynlab course export -o term.csv\n"
        "  dynlab course export crane -o marks.csv\n"
        "  dynlab course export crane --worksheet Grades-crane.csv -o moodle.csv\n"
        "  dynlab course export --json -o course.json");
}

}  // namespace dynlab::inline cli
