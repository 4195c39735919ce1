#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "base/reader.h"
#include "cli/course/course_commands.h"
#include "course/corrections/corrections.h"
#include "course/export/returned_files.h"
#include "course/intake/arrival_times.h"
#include "course/office/receive.h"
#include "course/store/newest_versions.h"
#include "course/store/receipts.h"
#include "course/store/store_check.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/aligned_table.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct ReceiveArguments {
    std::vector<std::string> files;
    std::vector<std::string> of;
    std::string assignment, from, at, times, isolation = "full", stage = "first";
    bool no_checks = false, first = false, accept_late = false, kept = false;
};

Message remark(const Received& r) {
    if (!r.error_reason.empty() && r.part == "pack")
        return Message("{}: ask the group for a pack that can be opened", r.error_reason);
    if (!r.error_reason.empty()) return Message("{}: ask the group for a readable file", r.error_reason);
    if (!r.missing.empty()) return Message("{}: ask the group for this file", r.missing);
    if (r.withdrawn) return Message("already received and withdrawn; to reinstate the file, run dynlab course restore");
    if (!r.other_time.empty())
        return Message(
            "already received; according to --times, the file arrived on {}; to correct the recorded time, run dynlab "
            "course set-received",
            r.other_time);
    if (r.known) return Message("already received; nothing changed");
    MessageList clauses{{}, Join::kSemicolon};
    if (r.voluntary)
        clauses.items.push_back(Message("voluntary: the author withdrew the report, so the review receives no marks"));
    if (!r.remark.empty()) clauses.items.push_back(r.remark);
    if (!r.twin.empty()) clauses.items.push_back(Message("the same file as {}", r.twin));
    if (!r.earlier.empty()) clauses.items.push_back(Message("the same file as {}", r.earlier));
    if (r.marked_late)
        clauses.items.push_back(Message("marked late by the platform: enter the time of receipt with --times"));
    if (r.made) clauses.items.push_back(Message("created by dynlab, because the pack contains no PDF"));
    if (r.scores > 0) clauses.items.push_back(plural(r.scores, "{} score read", "{} scores read"));
    if (r.rules_broken > 0)
        clauses.items.push_back(r.names ? plural(r.rules_broken, "{} rule violated: a name was found",
                                                 "{} rules violated: a name was found")
                                        : plural(r.rules_broken, "{} rule violated", "{} rules violated"));
    return Message("{}", clauses);
}

std::string what(const Received& r) {
    if (r.about.empty()) return r.from_pack ? r.part + " (from the pack)" : r.part;
    return r.about + (r.part == "pack" ? " (pack)" : r.from_pack ? " (from the pack)" : "");
}

void show(const ReceiveOutcome& outcome, const std::string& stage, bool timed) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::int64_t> late_by;
    int fresh = 0, late = 0;
    for (const Received& r : outcome.received) {
        rows.push_back({r.group, what(r), fmt::format("v{}", r.version),
                        r.late > 0 ? "late by " + duration_text(r.late) : "on time", message_text(remark(r))});
        fresh += !r.known;
        late += !r.known && r.late > 0;
        if (!r.known && r.late > 0) late_by.push_back(r.late);
    }
    std::cout << fmt::format("{}, {}: {} accepted, {} late{}\n", outcome.assignment.name,
                             stage == "first"    ? "first version"
                             : stage == "review" ? "reviews"
                                                 : "final version",
                             message_text(plural(fresh, "{} file", "{} files")), late,
                             rows.size() > static_cast<std::size_t>(fresh)
                                 ? fmt::format(", {} already received", rows.size() - static_cast<std::size_t>(fresh))
                                 : "");
    if (!rows.empty())
        std::cout << terminal_text(aligned_table(
                         {"group", stage == "review" ? "review of" : "part", "version", "when", "remark"}, rows))
                  << "Receipts: " << outcome.receipts.string() << '\n';
    if (const Message doubt = doubt_about_zone(late_by, static_cast<std::size_t>(fresh)); timed && !doubt.empty())
        std::cerr << "dynlab: " << terminal_text(message_text(doubt)) << '\n';
    for (const Message& refused : outcome.refused)
        std::cerr << "dynlab: " << terminal_text(message_text(refused)) << '\n';
}

/// Penalties of half the points or more wait for the instructor; returns whether any still does.
bool confirm_penalties(Course& course, const ReceiveOutcome& outcome, bool accept, Instant now) {
    std::vector<std::int64_t> waiting;
    for (const Received& r : outcome.received) {
        if (r.waiting <= 0) continue;
        waiting.push_back(r.id);
        if (!accept)
            std::cerr << "dynlab: "
                      << terminal_text(message_text(Message(
                             "{} is late by {}; the penalty of {} % is not applied until you confirm it. Repeat the "
                             "command with --accept-late, or correct the time with dynlab course set-received",
                             r.group, duration_message(r.late), significant(r.waiting, 4))))
                      << '\n';
    }
    if (waiting.empty() || !accept) return !waiting.empty();
    confirm_arrivals(course, outcome.assignment, waiting, now);
    for (const fs::path& file : write_receipts(course, waiting))
        std::cout << terminal_text(fmt::format("Confirmed receipt: {}\n", file.string()));
    return false;
}

/// A file that was not taken, by its name or the beginning of its SHA-256, as a file again.
fs::path file_not_taken(Course& course, const Assignment& assignment, const std::string& name, const fs::path& folder,
                        Instant& at) {
    constexpr std::size_t kMinDigits = 8;  // digits
    std::vector<FileNotTaken> found = files_not_taken(course, assignment);
    std::erase_if(found, [&](const FileNotTaken& one) {
        return one.name != name && (name.size() < kMinDigits || !one.hash.starts_with(name));
    });
    if (found.size() != 1)
        throw found.empty()
            ? InvalidArgument(
                  "{}: none of the files that were not accepted has the name \"{}\"; dynlab course status "
                  "lists these files",
                  assignment.name, name)
            : InvalidArgument(
                  "{}: {} files that were not accepted have the name \"{}\"; give at least the first 8 digits of the "
                  "SHA-256 hash instead of the name",
                  assignment.name, found.size(), name);
    at = found.front().received_at;
    fs::path file = folder / fs::path(found.front().name).filename();
    fs::copy_file(course.file(found.front().hash), file, fs::copy_options::overwrite_existing);
    return file;
}

int receive_files(const CourseArguments& where, const ReceiveArguments& args, const std::string& stage) {
    Course course(where.folder);
    ReceiveRequest request;
    request.assignment = args.assignment, request.from = args.from, request.of = args.of, request.stage = stage;
    request.at = time_of(course, args.at);
    const TemporaryFolder kept;
    for (const std::string& file : args.files) {
        if (!args.kept) {
            request.files.emplace_back(file);
            continue;
        }
        Instant came = 0;
        request.files.push_back(
            file_not_taken(course, assignment_named(course, args.assignment), file, kept.path(), came));
        if (args.at.empty()) request.at = came;
    }
    if (args.times == "archive") {
        request.time_of = [](const IncomingFile& file) { return time_in_archive(file.file); };
    } else if (!args.times.empty()) {
        request.time_of = [times = ArrivalTimes(args.times)](const IncomingFile& file) {
            return times.of(file.sender);
        };
    }
    request.numbers =
        participants_for(course, assignment_named(course, args.assignment), args.times == "archive" ? "" : args.times);
    request.level = args.isolation == "full" ? Isolation::kFull : Isolation::kProcess;
    request.program = running_program();
    request.take_as_first = args.first;
    request.checks = !args.no_checks;
    WorkBar bar("checking the files");
    request.progress = bar.progress();
    const ReceiveOutcome outcome = receive(course, request);
    bar.finish();
    show(outcome, stage, !args.times.empty());
    const bool waiting = confirm_penalties(course, outcome, args.accept_late, request.at);
    return outcome.refused.empty() && !waiting ? kDone : kFailed;
}

void add_receive(CLI::App& parent, const char* name, const char* about, const std::string& stage,
                 const std::string& example, CourseArguments& where, Action& action) {
    auto args = std::make_shared<ReceiveArguments>();
    CLI::App* command = parent.add_subcommand(name, about);
    command->add_option("FILE", args->files, "PDFs, packs, folders, or the zip file that Moodle or Canvas exports")
        ->required();
    command->add_option("--assignment", args->assignment, "Assignment. Required if there are several.")
        ->type_name("NAME");
    command
        ->add_option("--from", args->from,
                     "Group that submits the files. Default: determined from the names of files and folders.")
        ->type_name("GROUP");
    args->stage = stage;
    if (stage == "first") {
        command->add_option("--stage", args->stage, "Version")
            ->type_name("first|final")
            ->capture_default_str()
            ->check(CLI::IsMember({"first", "final"}));
        command->add_flag("--accept-late", args->accept_late, "Apply penalties of half the points or more");
        command->add_flag("--kept", args->kept,
                          "FILE is a file that was not accepted before, by name or SHA-256; the course has kept it");
        command->add_flag("--first", args->first,
                          "Submit a first version, even if the reviews of the report are released");
    }
    if (stage == "review")
        command
            ->add_option(
                "--of", args->of,
                "Reviewed report. Default: determined from the file name. Repeat the option for each of several files.")
            ->type_name("report-NN")
            ->allow_extra_args(false);
    add_time_option(*command, args->at);
    command->get_option("--at")->group("Options");
    command
        ->add_option("--times", args->times,
                     "Times of submission: Moodle's grading worksheet or another CSV (column id, identifier, group, "
                     "name or mail, and time), or `archive` for the times in the archive; --at for the other files. "
                     "The worksheet also identifies participant numbers")
        ->type_name("CSV|archive");
    command->add_option("--isolation", args->isolation, "Isolation while archives are unpacked")
        ->type_name("full|process")
        ->capture_default_str()
        ->check(CLI::IsMember({"full", "process"}));
    command->add_flag("--no-checks", args->no_checks, "Do not check the PDFs");
    command->footer(
        "dynlab identifies the owner of a file by the name of the file or its folder: a group, a student's name or id, "
        "or a\nname from the platform. dynlab never uses the content. A pack's report.pdf (slides.pdf, review.pdf), or "
        "its only PDF,\ncounts like a separate PDF; if a pack has no PDF, dynlab creates it. dynlab keeps every "
        "version and signs a receipt\nfor it. It keeps and flags a file that cannot be read. Example:\n  " +
        example);
    command->callback(
        [&where, args, &action] { action = [&where, args] { return receive_files(where, *args, args->stage); }; });
}

int verify_course(const CourseArguments& where, const std::vector<std::string>& receipts) {
    Course course(where.folder);
    bool well = true;
    for (const std::string& file : receipts) {
        const ReceiptCheck receipt_check = verify_receipt(read_file(file), course);
        std::cout << terminal_text(fmt::format("{}: {}\n", file, receipt_check.reason));
        well = well && receipt_check.genuine;
    }
    if (receipts.empty()) {
        const StoreCheck check = check_store(course);
        for (const Message& leftover : check.leftovers) std::cout << terminal_text(message_text(leftover)) << '\n';
        for (const Message& error_reason : check.error_list)
            std::cerr << "dynlab: " << terminal_text(message_text(error_reason)) << '\n';
        const Message files = plural(check.files, "{} file", "{} files"),
                      versions = plural(check.versions, "{} version", "{} versions");
        std::cout << message_text(check.error_list.empty()
                                      ? Message("{}, {}: complete and unaltered", files, versions)
                                      : Message("{}, {}: errors were found, see above", files, versions))
                  << '\n';
        well = check.error_list.empty();
    }
    return well ? kDone : kFailed;
}

/// The file course.pub holds the same. The secret course.key stays with the instructor.
int show_key(const CourseArguments& where) {
    const Course course(where.folder);
    const fs::path file = course.publish_key();
    std::cout << terminal_text(read_file(file)) << "File: " << file.string() << '\n';
    return kDone;
}

void add_course_verify(CLI::App& course, CourseArguments& where, Action& action) {
    auto receipts = std::make_shared<std::vector<std::string>>();
    auto key = std::make_shared<bool>(false);
    CLI::App* command = course.add_subcommand("verify", "Check receipts, or the complete store");
    command->add_flag("--key", *key, "Show the public key that students use to verify receipts");
    command->add_option("RECEIPT", *receipts, "Receipts from students");
    command->footer(
        "Students verify their receipts with dynlab verify, without the course.\nThe command also lists temporary "
        "files and folders of interrupted commands; the next course command removes them.\nExample:  dynlab course "
        "verify 00012-group-07-first-report.txt");
    command->callback([&where, receipts, key, &action] {
        action = [&where, receipts, key] { return *key ? show_key(where) : verify_course(where, *receipts); };
    });
}

}  // namespace

void add_receive_commands(CLI::App& course, CourseArguments& where, Action& action) {
    add_receive(course, "submit", "Submit files, folders, or an export of Moodle or Canvas", "first",
                "dynlab course submit \"Crane-12345.zip\" --assignment crane", where, action);
    CLI::App* review = course.add_subcommand("review", "Run the peer review: assign, send, collect, release");
    review->require_subcommand(1);
    add_receive(*review, "collect", "Submit reviews", "review",
                "dynlab course review collect review-report-07.pdf --from group-02", where, action);
    add_course_verify(course, where, action);
}

}  // namespace dynlab::inline cli
