#include "course/review/final_changes.h"

#include <algorithm>

#include "course/review/review_pairs.h"
#include "course/review/version_reading.h"
#include "course/store/side_by_side.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// What one group's comparison needs from the store.
struct Task {
    GroupChanges changes;
    VersionFiles first, final;
    std::vector<fs::path> reviews;  ///< of changes.reviews
};

class TaskMaker {
  public:
    TaskMaker(Course& course, const Assignment& assignment)
        : course_(course), assignment_(assignment), pairs_(review_pairs(course, assignment)) {
        std::ranges::sort(pairs_, {}, &ReviewPair::reviewer_number);
    }

    /// Nothing where the group handed in neither version.
    std::optional<Task> make(const Group& group) {
        Task task;
        GroupChanges& changes = task.changes;
        changes.group = group.name;
        changes.dropped_out = group.dropped_out;
        read_versions(group, changes.received);
        if (changes.received.empty()) return {};
        const std::string first_pdf = choose(changes.received, "first", "report", version_that_was_read(group)),
                          first_pack = choose(changes.received, "first", "pack", 0),
                          final_pdf = choose(changes.received, "final", "report", 0),
                          final_pack = choose(changes.received, "final", "pack", 0);
        task.first = {stored_file(first_pdf), stored_file(first_pack)};
        task.final = {stored_file(final_pdf), stored_file(final_pack)};
        changes.has_first = task.first.pdf || task.first.pack;
        changes.has_final = task.final.pdf || task.final.pack;
        changes.same_files = changes.has_first && first_pdf == final_pdf && first_pack == final_pack;
        read_reviews(group, task);
        return task;
    }

  private:
    void read_versions(const Group& group, std::vector<ReceivedFile>& received) {
        for (Rows rows = course_.database().query(
                 "SELECT id, stage, part, number, name, hash, received_at, late FROM standing WHERE assignment = ? AND "
                 "group_id = ? AND stage <> 'review' ORDER BY stage = 'final', received_at, id",
                 assignment_.id, group.id);
             rows.next();) {
            ReceivedFile file;
            file.id = rows.integer(0), file.stage = rows.text(1), file.part = rows.text(2);
            file.number = rows.integer(3), file.name = rows.text(4), file.hash = rows.text(5);
            file.at = rows.integer(6), file.late = rows.integer(7);
            received.push_back(std::move(file));
        }
    }

    /// The id of the newest version of which copies went to reviewers; 0 where none did.
    std::int64_t version_that_was_read(const Group& group) {
        Rows rows = course_.database().query(
            "SELECT max(s.version) FROM sendings s JOIN pairs p ON p.id = s.pair WHERE p.assignment = ? AND p.author = "
            "? AND s.way = 'to reviewer'",
            assignment_.id, group.id);
        return rows.next() && !rows.isColumnNull(0) ? rows.integer(0) : 0;
    }

    /// Marks the wanted version of a part, else its newest; returns its hash.
    static std::string choose(std::vector<ReceivedFile>& received, const std::string& stage, const std::string& part,
                              std::int64_t wanted) {
        ReceivedFile* chosen = nullptr;
        for (ReceivedFile& file : received) {
            if (file.stage != stage || file.part != part) continue;
            if (chosen == nullptr || chosen->id != wanted) chosen = &file;
        }
        if (chosen == nullptr) return {};
        chosen->compared = true;
        return chosen->hash;
    }

    std::optional<fs::path> stored_file(const std::string& hash) const {
        return hash.empty() ? std::nullopt : std::optional(course_.file(hash));
    }

    void read_reviews(const Group& group, Task& task) {
        for (const ReviewPair& pair : pairs_) {
            if (pair.author != group.id || !pair.released) continue;
            Rows rows = course_.database().query(
                "SELECT hash, made_at FROM sendings WHERE pair = ? AND way = 'to author' ORDER BY id DESC LIMIT 1",
                pair.id);
            if (!rows.next()) continue;
            task.reviews.push_back(course_.file(rows.text(0)));
            AnsweredReview review;
            review.reviewer = pair.reviewer_pseudonym(), review.released = rows.integer(1);
            task.changes.reviews.push_back(std::move(review));
        }
    }

    Course& course_;
    const Assignment& assignment_;
    std::vector<ReviewPair> pairs_;
};

void gather_troubles(const ReadVersion& version, const Message& which, std::vector<Message>& troubles) {
    for (const Message& trouble : version.troubles) troubles.push_back(Message("{}: {}", which, trouble));
    if (version.record_found)
        troubles.push_back(Message("{}: the values are those of the pack's own record.json.", which));
}

void read_remarks(const fs::path& file, AnsweredReview& review) {
    try {
        for (Remark& remark : remarks_in(text_of_layout(read_pdf_layout(file)), review_form()))
            review.remarks.push_back({std::move(remark), {}});
        if (review.remarks.empty()) review.trouble = Message("It holds no text that can be read.");
    } catch (const PdfRefusal& refusal) {
        review.trouble = Message("It cannot be read: {}", refusal.message());
    }
}

/// Sources are compared with sources where both versions have them, else printed text with printed text.
void compare(Task& task, Isolation level, const fs::path& program) {
    GroupChanges& changes = task.changes;
    for (std::size_t i = 0; i < task.reviews.size(); ++i) read_remarks(task.reviews[i], changes.reviews[i]);
    if (!changes.has_first || !changes.has_final) return;
    const ReadVersion first = read_version(task.first, level, program),
                      final = changes.same_files ? first : read_version(task.final, level, program);
    gather_troubles(first, Message("First version"), changes.troubles);
    gather_troubles(final, Message("Final version"), changes.troubles);
    changes.pages_before = first.pages, changes.pages_after = final.pages;
    if (first.record && final.record) changes.values = value_changes(*first.record, *final.record);
    const bool sources = first.source && final.source;
    const std::optional<ReportText>&before = sources || !first.printed ? first.source : first.printed,
          &after = sources || !final.printed ? final.source : final.printed;
    if (!before || !after) return;
    changes.compared =
        sources ? Message("Compared: the sources in both packs, their slots filled.")
        : first.printed && final.printed
            ? Message("Compared: the text of both PDFs.")
            : Message(
                  "Compared: a pack's source with a PDF's text, which differ in formulas and tables although nothing "
                  "changed.");
    changes.text = text_changes(*before, *after);
    const RemarkMatcher finder(*before, *changes.text);
    for (AnsweredReview& review : changes.reviews)
        for (AnsweredRemark& answered : review.remarks)
            if (answered.remark.wants_answer) answered.traces = finder.traces(answered.remark);
}

}  // namespace

std::vector<GroupChanges> final_changes(Course& course, const Assignment& assignment,
                                        const FinalChangesRequest& request) {
    if (!assignment.is_report()) throw InvalidArgument("{} is a talk: it has no final version", assignment.name);
    std::vector<Group> groups;
    for (const std::string& name : request.groups) groups.push_back(group_named(course, name));
    if (request.groups.empty()) groups = groups_of(course);
    TaskMaker maker(course, assignment);
    std::vector<Task> tasks;
    for (const Group& group : groups)
        if (auto task = maker.make(group)) tasks.push_back(*std::move(task));
    side_by_side(
        tasks.size(), [&](std::size_t i) { compare(tasks[i], request.level, request.program); }, request.progress);
    std::vector<GroupChanges> all;
    for (Task& task : tasks) all.push_back(std::move(task.changes));
    return all;
}

}  // namespace dynlab::inline course
