#include "course/review/version_changes.h"

#include <algorithm>

#include "course/review/review_pairs.h"
#include "course/review/version_reading.h"
#include "course/store/side_by_side.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

struct Task {
    GroupChanges changes;
    VersionFiles first, final;
    std::vector<fs::path> reviews;  ///< of changes.reviews
};

/// The newest version of which copies were sent to reviewers, and which is not withdrawn.
std::optional<ValidFile> reviewed_version(Course& course, const Assignment& assignment, std::int64_t group) {
    Rows rows = course.database().query(
        "SELECT max(s.version) FROM sendings s JOIN pairs p ON p.id = s.pair WHERE p.assignment = ? AND p.author = ? "
        "AND s.way = 'to reviewer'",
        assignment.id, group);
    return rows.next() && !rows.isColumnNull(0) ? standing_file(course, rows.integer(0)) : std::nullopt;
}

/// The report of a stage and its source.
VersionFiles files_of(Course& course, const Assignment& assignment, std::int64_t group, const std::string& stage,
                      std::optional<ValidFile> report, std::vector<ValidFile>& compared) {
    if (!report) report = newest_file(course, assignment, group, stage, "report");
    const auto pack =
        report ? pack_of_document(course, report->id) : newest_file(course, assignment, group, stage, "pack");
    VersionFiles files;
    if (report) files.pdf = course.file(report->hash), compared.push_back(*report);
    if (pack) files.pack = course.file(pack->hash), compared.push_back(*pack);
    return files;
}

std::optional<Task> task_of(Course& course, const Assignment& assignment, const Group& group,
                            const std::vector<ReviewPair>& pairs) {
    Task task;
    GroupChanges& changes = task.changes;
    changes.group = group.name;
    changes.dropped_out = group.dropped_out;
    task.first =
        files_of(course, assignment, group.id, "first", reviewed_version(course, assignment, group.id), changes.first);
    task.final = files_of(course, assignment, group.id, "final", {}, changes.final);
    if (changes.first.empty() && changes.final.empty()) return {};
    changes.same_files = std::ranges::equal(changes.first, changes.final, {}, &ValidFile::hash, &ValidFile::hash);
    for (const ReviewPair& pair : pairs) {
        if (pair.author != group.id || !pair.released) continue;
        Rows rows = course.database().query(
            "SELECT hash, made_at FROM sendings WHERE pair = ? AND way = 'to author' ORDER BY id DESC LIMIT 1",
            pair.id);
        if (!rows.next()) continue;
        task.reviews.push_back(course.file(rows.text(0)));
        changes.reviews.push_back({pair.reviewer_pseudonym(), rows.integer(1), {}, {}});
    }
    return task;
}

void read_review(const fs::path& file, ReleasedReview& review) {
    try {
        review.blocks = blocks_of_review(text_of_layout(read_pdf_layout(file)));
        if (review.blocks.empty()) review.problem = Message("The file contains no readable text.");
    } catch (const PdfRefusal& refusal) {
        review.problem = Message("The file cannot be read: {}", refusal.message());
    }
}

/// Compares the sources where both versions have one, otherwise the PDFs: a source and a PDF differ in formulas and
/// tables even where nothing changed.
void compare(Task& task, Isolation level, const fs::path& program) {
    GroupChanges& changes = task.changes;
    for (std::size_t i = 0; i < task.reviews.size(); ++i) read_review(task.reviews[i], changes.reviews[i]);
    if (changes.first.empty() || changes.final.empty()) return;
    const ReadVersion first = read_version(task.first, level, program),
                      final = changes.same_files ? first : read_version(task.final, level, program);
    for (const Message& problem : first.problems) changes.problems.push_back(Message("First version: {}", problem));
    for (const Message& problem : final.problems) changes.problems.push_back(Message("Final version: {}", problem));
    changes.pages_before = first.pages, changes.pages_after = final.pages;
    if (first.record && final.record) changes.values = value_changes(*first.record, *final.record);
    if (first.source && final.source) {
        changes.text = word_diff(*first.source, *final.source);
        changes.compared = Message("Compared: report.md of both packs, with the values of their analyses.");
    } else if (first.printed && final.printed) {
        changes.text = word_diff(*first.printed, *final.printed);
        changes.compared = Message("Compared: the text of both PDFs.");
    }
}

}  // namespace

std::vector<GroupChanges> version_changes(Course& course, const Assignment& assignment, const ChangesRequest& request) {
    if (assignment.is_talk()) throw InvalidArgument("{} is a talk and has no final version", assignment.name);
    if (assignment.is_lab()) throw InvalidArgument("{} is a lab and has no final version", assignment.name);
    std::vector<Group> groups;
    for (const std::string& name : request.groups) groups.push_back(group_named(course, name));
    if (request.groups.empty()) groups = groups_of(course);
    std::vector<ReviewPair> pairs = review_pairs(course, assignment);
    std::ranges::sort(pairs, {}, &ReviewPair::reviewer_number);
    std::vector<Task> tasks;
    for (const Group& group : groups)
        if (auto task = task_of(course, assignment, group, pairs)) tasks.push_back(*std::move(task));
    side_by_side(
        tasks.size(), [&](std::size_t i) { compare(tasks[i], request.level, request.program); }, request.progress);
    std::vector<GroupChanges> all;
    for (Task& task : tasks) all.push_back(std::move(task.changes));
    return all;
}

}  // namespace dynlab::inline course
