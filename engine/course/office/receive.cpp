#include "course/office/receive.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/reader.h"
#include "course/office/packed_document.h"
#include "course/office/recognized_file.h"
#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/inspection.h"
#include "course/store/marks.h"
#include "course/store/receipts.h"
#include "course/store/senders.h"
#include "course/store/side_by_side.h"
#include "course/store/versions.h"
#include "documents/pdf/pdf_layout.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxByteCount = 200u << 20;

/// A file on its way into the store.
struct Candidate {
    const IncomingFile* file = nullptr;
    Group group;
    std::string part, name, hash;
    std::int64_t bytes = 0;
    Instant at = 0;      ///< when it was submitted
    bool timed = false;  ///< whether `time_of` returned the time
    std::optional<ReviewPair> pair;
    bool from_pack = false, made = false;  ///< a PDF that was taken out of the group's pack; made of it
    bool unreadable = false;               ///< no PDF, but the document all the same
    bool refused = false;                  ///< a link, too large: unreadable where its sender gave nothing else
    bool silent = false;                   ///< kept as a trace only: not taken, or beside the file that counts
    Message missing;                       ///< of a pack without the PDF that is wanted
    Message remark;                        ///< name and content differ
    Inspection inspection;
    std::map<std::string, double> scores;  ///< of a review's pack, by criterion
};

class SubmissionReceiver {
  public:
    SubmissionReceiver(Course& course, const ReceiveRequest& request)
        : course_(course),
          request_(request),
          outcome_{assignment_named(course, request.assignment), {}, {}, {}},
          senders_(course, outcome_.assignment, request.stage, request.numbers),
          incoming_(way()) {
        due_for(course, outcome_.assignment, 0, request.stage);  // a talk has no reviews
        if (request.of.size() > 1 && request.of.size() != request.files.size())
            throw InvalidArgument(
                "{} and {} values of --of were given; give --of once for each file, in the same order",
                plural(request.files.size(), "{} file", "{} files"), request.of.size());
        if (!request.from.empty()) from_ = group_named(course, request.from);
        if (request.stage != "final") pairs_ = review_pairs(course, outcome_.assignment);
    }

    ReceiveOutcome run() {
        for (const fs::path& file : request_.files) incoming_.add(file);
        for (const IncomingFile& file : incoming_.files()) candidates_.push_back(candidate_of(file));
        mark_what_lies_beside();
        settle_doubles();
        open_packs();
        // Traces are numbered behind the files that their senders read of.
        std::stable_partition(candidates_.begin(), candidates_.end(), [](const Candidate& c) { return !c.silent; });
        keep_all();
        write();
        outcome_.receipts = course_.folder() / "receipts" / outcome_.assignment.name;
        if (!outcome_.received.empty()) course_.publish_key();
        std::vector<std::int64_t> versions;
        for (const Received& one : outcome_.received) versions.push_back(one.id);
        try {
            write_receipts(course_, versions);
        } catch (const std::runtime_error& error) {
            throw EnvironmentError("the files are stored, but the receipts were not written: {}. Run the command again",
                                   message_of(error));
        }
        return std::move(outcome_);
    }

  private:
    IncomingFiles::Way way() {
        return {request_.level, request_.program, !request_.from.empty(), outcome_.assignment.is_lab(),
                [this](const Submission& submission) { return senders_.knows(submission); }};
    }

    /// What cannot be taken is kept all the same. Throws for a file that was given alone.
    Candidate candidate_of(const IncomingFile& file) {
        Candidate candidate;
        candidate.file = &file, candidate.at = request_.at;
        try {
            if (!file.sender.name.empty()) identify(candidate);
            if (!file.left_out.empty()) throw EnvironmentError(file.left_out);
        } catch (const std::runtime_error& error) {
            if (!incoming_.batch()) throw EnvironmentError("{}: {}", file.source, message_of(error));
            outcome_.refused.push_back(Message("{}: {}", file.source, message_of(error)));
            const bool too_large = static_cast<std::uintmax_t>(candidate.bytes) > kMaxByteCount;
            candidate.refused = candidate.group.id != 0 && (too_large || !file.left_out.empty());
            make_trace(candidate,
                       !candidate.refused ? kNotTaken
                       : too_large        ? "too-large"
                                          : "other-kind",
                       message_of(error));
            candidate.silent = !candidate.refused;
        }
        return candidate;
    }

    static void make_trace(Candidate& candidate, const char* error_reason, const Message& reason) {
        candidate.part = kUnreadable, candidate.name = terminal_line(candidate.file->name);
        candidate.inspection = unreadable_inspection(error_reason, reason);
        candidate.silent = true, candidate.unreadable = false, candidate.pair = {};
    }

    void identify(Candidate& candidate) {
        const IncomingFile& file = *candidate.file;
        const std::optional<Instant> time = request_.time_of ? request_.time_of(file) : std::nullopt;
        candidate.at = time.value_or(request_.at), candidate.timed = time.has_value();
        candidate.bytes = static_cast<std::int64_t>(fs::file_size(file.file));
        const std::optional<Group> group = from_ ? from_ : senders_.find(file.sender);
        if (!group) throw EnvironmentError(senders_.complaint(file.sender));
        candidate.group = *group;
        if (!file.left_out.empty()) return;
        if (static_cast<std::uintmax_t>(candidate.bytes) > kMaxByteCount)
            throw EnvironmentError("the file is larger than {} MB", kMaxByteCount >> 20);
        RecognizedFile found = recognize(file, outcome_.assignment, request_.stage);
        candidate.part = found.part, candidate.name = terminal_line(found.name), candidate.remark = found.remark;
        candidate.unreadable = found.text;
        if (!found.error_reason.empty()) candidate.inspection = unreadable_inspection(found.error_reason, found.reason);
        if (request_.stage == "first" && !request_.take_as_first) refuse_after_reviews(candidate);
        if (request_.stage == "review") candidate.pair = reviewed_pair(pairs_, *group, report_of(file));
    }

    /// The report that a review belongs to, according to the request.
    const std::string& report_of(const IncomingFile& file) const {
        if (request_.of.empty()) return file.name;
        return request_.of.size() == 1 ? request_.of.front() : request_.of[file.given];
    }

    /// Refuses a report whose reviews are released, or whose review deadline is over after it was sent to reviewers.
    /// Such a report is the final version, unless the file is already known.
    void refuse_after_reviews(const Candidate& candidate) const {
        bool sent = false, released = false;
        for (const ReviewPair& pair : pairs_) {
            if (pair.author != candidate.group.id) continue;
            sent = sent || pair.sent;
            released = released || pair.released;
        }
        const Assignment& a = outcome_.assignment;
        const bool over = a.review_due && candidate.at > *a.review_due + a.grace;
        if (!released && !(sent && over)) return;
        if (has_any(candidate, candidate.part, sha256_of_file(candidate.file->file))) return;
        throw released ? EnvironmentError(
                             "the reviews of the report of {} are already released: did you mean dynlab course submit "
                             "--stage final? To submit a first version anyway, give --first",
                             candidate.group.name)
                       : EnvironmentError(
                             "the reviews of the report of {} are already due: did you mean dynlab course submit "
                             "--stage final? To submit a first version anyway, give --first",
                             candidate.group.name);
    }

    /// For what a candidate is; of two only one can hold.
    static std::string slot_of(const Candidate& c, const std::string& part) {
        return fmt::format("{}/{}/{}", c.group.id, part, c.pair ? c.pair->id : 0);
    }

    /// What cannot be read beside what can, in the same folder, or beside the PDF that was made of it, or beside a
    /// pack: it is not complained of.
    void mark_what_lies_beside() {
        std::set<std::string> readable, anything, folders, others;
        for (const Candidate& c : candidates_) {
            if (!c.refused) others.insert(slot_of(c, ""));
            if (c.unreadable || c.part == kUnreadable) continue;
            readable.insert(slot_of(c, c.part == "pack" ? document_part() : c.part));
            anything.insert(slot_of(c, ""));
            if (!c.file->folder.empty()) folders.insert(c.file->folder);
        }
        for (Candidate& c : candidates_)
            if (c.refused && others.contains(slot_of(c, "")))
                make_trace(c, kBeside, Message(c.inspection.reason));
            else if (!c.silent && ((c.unreadable && readable.contains(slot_of(c, c.part))) ||
                                   (c.part == kUnreadable &&
                                    (anything.contains(slot_of(c, "")) || folders.contains(c.file->folder)))))
                make_trace(c, kBeside, Message("The file was submitted together with the file that counts."));
    }

    /// Several files of a group for the same purpose are ambiguous. They are kept as unreadable, unless their contents
    /// are equal, because platforms export a team's file once for each member. For a lab each file is a version: the
    /// best or the newest one counts, as when both partners submit.
    void settle_doubles() {
        std::map<std::string, std::map<std::string, const IncomingFile*>> contents;  // by slot and hash, the first one
        std::map<std::string, int> files;
        for (const Candidate& c : candidates_)
            if (c.part != kUnreadable) ++files[slot_of(c, c.part)];
        for (Candidate& c : candidates_)
            if (c.part != kUnreadable && files[slot_of(c, c.part)] > 1) {
                c.hash = sha256_of_file(c.file->file);
                contents[slot_of(c, c.part)].try_emplace(c.hash, c.file);
            }
        std::erase_if(candidates_, [&](const Candidate& c) {
            return !c.hash.empty() && contents[slot_of(c, c.part)][c.hash] != c.file;
        });
        if (outcome_.assignment.is_lab()) return;
        for (Candidate& c : candidates_) {
            if (c.hash.empty() || contents[slot_of(c, c.part)].size() == 1) continue;
            outcome_.refused.push_back(
                Message("{}: {} submitted several files that could be the {}; submit only the correct file",
                        c.file->source, c.group.name, c.part));
            make_trace(c, "several", Message("The file is one of several files that could be the {}.", c.part));
            c.silent = false;
        }
    }

    std::string document_part() const { return parts_of(outcome_.assignment, request_.stage).front(); }

    /// A pack's PDF counts as if it had come beside it, unless one did.
    void open_packs() {
        if (outcome_.assignment.is_lab()) return;  // its pack is graded as it is
        const std::string part = document_part();
        std::set<std::string> present;
        for (const Candidate& c : candidates_) present.insert(slot_of(c, c.part));
        std::vector<std::size_t> packs;
        for (std::size_t i = 0; i < candidates_.size(); ++i)
            if (candidates_[i].part == "pack" && !present.contains(slot_of(candidates_[i], part))) packs.push_back(i);
        std::vector<OpenedPack> found(packs.size());
        side_by_side(packs.size(), [&](std::size_t i) {
            Candidate& pack = candidates_[packs[i]];
            try {
                found[i] = open_pack(pack.file->file, part, opened_.path() / std::to_string(i), request_.level,
                                     request_.program);
                pack.missing = found[i].missing;
                if (request_.stage == "review") pack.scores = scores_in_pack(opened_.path() / std::to_string(i));
            } catch (const SubmissionError&) {
                pack.inspection.error_reason = "damaged";
            }
        });
        for (std::size_t i = 0; i < packs.size(); ++i)
            if (found[i].document) add_packed(candidates_[packs[i]], *found[i].document, part);
    }

    void add_packed(const Candidate& pack, const PackedDocument& document, const std::string& part) {
        const IncomingFile& whole = *pack.file;
        packed_.push_back({document.file, whole.name + "/" + document.name, whole.source + "/" + document.name,
                           whole.sender, whole.folder});
        Candidate candidate;
        candidate.name = terminal_line(packed_.back().name);
        candidate.file = &packed_.back(), candidate.group = pack.group, candidate.pair = pack.pair;
        candidate.at = pack.at, candidate.timed = pack.timed;
        candidate.part = part, candidate.from_pack = true, candidate.made = document.made;
        candidates_.push_back(std::move(candidate));
    }

    void keep_all() {
        std::optional<Inspector> inspector;
        if (request_.checks)
            inspector.emplace(request_.stage == "review" ? everybody() : nullptr, outcome_.assignment.lesson);
        if (inspector && candidates_.size() > 1) prepare_to_read_pdfs();
        std::vector<fs::path> files;
        for (const Candidate& candidate : candidates_)
            files.push_back(static_cast<std::uintmax_t>(candidate.bytes) > kMaxByteCount ? nothing()
                                                                                         : candidate.file->file);
        const auto look = [&](std::size_t i, const StoredFile& kept) {
            candidates_[i].hash = kept.hash, candidates_[i].bytes = kept.bytes;
            inspect(candidates_[i], inspector);
        };
        course_.keep_files(files, look, request_.progress);
    }

    /// An empty file that replaces a file too large to be kept.
    fs::path nothing() const {
        write_file_atomically(opened_.path() / "nothing", "");
        return opened_.path() / "nothing";
    }

    std::shared_ptr<const IdentityMatcher> everybody() const {
        IdentityMatcher names(students_of(course_));
        names.add_cited(cited_authors());
        return std::make_shared<const IdentityMatcher>(std::move(names));
    }

    void inspect(Candidate& candidate, const std::optional<Inspector>& inspector) const {
        if (candidate.unreadable && !inspector)
            candidate.inspection =
                Inspector(nullptr, outcome_.assignment.lesson).inspect(course_.file(candidate.hash), candidate.part);
        else if (inspector && inspector->looks_at(candidate.part))
            candidate.inspection = inspector->inspect(course_.file(candidate.hash), candidate.part);
    }

    void write() {
        std::stable_sort(candidates_.begin(), candidates_.end(),  // a pack stays before what it held
                         [](const Candidate& a, const Candidate& b) {
                             return std::tie(a.group.name, a.at) < std::tie(b.group.name, b.at);
                         });
        Transaction transaction(course_.database());
        int fresh = 0;
        std::set<std::string> known_packs;
        for (const Candidate& candidate : candidates_) {
            // An earlier pack does not bring back what a newer PDF has replaced.
            if (candidate.from_pack && known_packs.contains(slot_of(candidate, "pack")) &&
                has_any(candidate, candidate.part))
                continue;
            Received received = take(candidate);
            if (!candidate.pair && candidate.part != kUnreadable) received.waiting = waiting_percent(received);
            if (candidate.silent) {
                if (!received.known && received.error_reason == kNotTaken)
                    course_.note(fmt::format("{}: {} was not taken: {}", outcome_.assignment.name, candidate.name,
                                             message_text(candidate.inspection.reason)),
                                 request_.at);
                continue;
            }
            keep_participant(course_, outcome_.assignment.id, candidate.file->sender, candidate.group);
            fresh += !received.known;
            if (received.known && candidate.part == "pack") known_packs.insert(slot_of(candidate, "pack"));
            outcome_.received.push_back(std::move(received));
        }
        for (GivenMark& score : scores_) score.version = newest_review(course_, score.pair);
        enter_marks(course_, outcome_.assignment, scores_, request_.at);
        if (fresh > 0)
            course_.note(fmt::format("{}: {} received, {}", outcome_.assignment.name, fresh, request_.stage),
                         request_.at);
        transaction.commit();
    }

    double waiting_percent(const Received& received) const {
        const Costs& costs = outcome_.assignment.costs;
        const bool confirmed = course_.database().query("SELECT 1 FROM arrivals WHERE version = ?", received.id).next();
        return waits_for_confirmation(costs, received.late, confirmed) ? late_percent(costs, received.late) : 0;
    }

    /// Whether an earlier version may count as well as the newest one.
    bool each_counts() const { return outcome_.assignment.is_lab() && outcome_.assignment.keep != "newest"; }

    bool has_any(const Candidate& c, const std::string& part, const std::string& hash = "") const {
        return course_.database()
            .query(
                "SELECT 1 FROM versions WHERE assignment = ? AND group_id = ? AND stage = ? AND ifnull(pair, 0) = ? "
                "AND part = ? AND hash = ifnull(nullif(?, ''), hash)",
                outcome_.assignment.id, c.group.id, request_.stage, c.pair ? c.pair->id : 0, part, hash)
            .next();
    }

    /// Whose these very bytes are, too, which is worth a look: another group's, or a review.
    std::string same_as(const Candidate& c) const {
        if (c.pair) return "";
        Rows rows = course_.database().query(
            "SELECT g.name, v.stage = 'review' FROM versions v JOIN groups g ON g.id = v.group_id WHERE v.assignment = "
            "? AND v.hash = ? AND (v.group_id <> ? OR v.stage = 'review') AND EXISTS (SELECT 1 FROM standing s WHERE "
            "s.id = v.id) ORDER BY 2 DESC LIMIT 1",
            outcome_.assignment.id, c.hash, c.group.id);
        if (!rows.next()) return "";
        return rows.integer(1) != 0 ? "a review by " + rows.text(0) : rows.text(0) + "'s";
    }

    /// An earlier version of the same content: where another came between, it may be the one that is meant.
    std::string earlier_with_the_same(const Candidate& c) const {
        Rows rows = course_.database().query(
            "SELECT number, received_at FROM versions WHERE assignment = ? AND group_id = ? AND stage = ? AND "
            "ifnull(pair, 0) = ? AND part = ? AND hash = ? ORDER BY number LIMIT 1",
            outcome_.assignment.id, c.group.id, request_.stage, c.pair ? c.pair->id : 0, c.part, c.hash);
        return rows.next() ? fmt::format("v{} of {}", rows.integer(0), course_.clock().show(rows.integer(1))) : "";
    }

    Received take(const Candidate& c) {
        Database& db = course_.database();
        std::optional<std::int64_t> pair;
        if (c.pair) pair = c.pair->id;
        Received received;
        received.group = c.group.name, received.part = c.part;
        received.rules_broken = c.inspection.rules_broken, received.error_reason = c.inspection.error_reason;
        received.names = c.inspection.names, received.remark = c.remark;
        received.from_pack = c.from_pack, received.made = c.made;
        if (!has_any(c, document_part())) received.missing = c.missing;
        if (c.pair) received.about = c.pair->report_pseudonym(), received.voluntary = c.pair->ended;
        Rows before = db.query(
            "SELECT v.id, v.number, v.hash, s.late, s.id IS NULL, v.name FROM versions v LEFT JOIN standing s ON s.id "
            "= v.id WHERE v.assignment = ? AND v.group_id IS nullif(?, 0) AND v.stage = ? AND ifnull(v.pair, 0) = ? "
            "AND v.part = ? ORDER BY v.hash = ? AND ((v.part = ? AND v.name = ?) OR ?) DESC, v.number DESC LIMIT 1",
            outcome_.assignment.id, c.group.id, request_.stage, pair.value_or(0), c.part, c.hash, kUnreadable, c.name,
            each_counts());
        const bool any = before.next();
        if (any && before.text(2) == c.hash && (c.part != kUnreadable || before.text(5) == c.name)) {
            received.known = true, received.id = before.integer(0), received.version = before.integer(1);
            received.late = before.integer(3), received.withdrawn = before.integer(4) != 0;
            Rows arrived = db.query("SELECT received_at FROM arrived WHERE id = ?", received.id);
            if (c.timed && arrived.next() && arrived.integer(0) != c.at)
                received.other_time = course_.clock().show(c.at);
            return received;
        }
        received.version = any ? before.integer(1) + 1 : 1;
        const Assignment& a = outcome_.assignment;
        received.twin = same_as(c);
        received.earlier = earlier_with_the_same(c);
        const AddedVersion added = add_version(course_, a,
                                               {c.group.id, c.group.name, request_.stage, c.part, pair,
                                                received.version, c.hash, c.name, c.bytes, c.at, c.inspection.json},
                                               request_.at);
        received.id = added.id;
        received.late = added.late;
        received.marked_late = c.file->sender.late && received.late == 0;
        // The receipt shows when this version arrived; the time when its content first arrived counts.
        if (Rows standing = db.query("SELECT late FROM standing WHERE id = ?", received.id); standing.next())
            received.late = standing.integer(0);
        for (std::size_t i = 0; i < a.criteria.size(); ++i) {
            const auto points = c.scores.find(a.criteria[i].name);
            if (points == c.scores.end() || points->second > a.criteria[i].max_points) continue;
            GivenMark& score = scores_.emplace_back();
            score.group = c.pair->author, score.pair = c.pair->id;
            score.item = a.criteria[i].name, score.points = points->second;
            ++received.scores;
        }
        return received;
    }

    Course& course_;
    const ReceiveRequest& request_;
    ReceiveOutcome outcome_;
    Senders senders_;
    IncomingFiles incoming_;
    std::optional<Group> from_;
    std::vector<ReviewPair> pairs_;
    std::vector<Candidate> candidates_;
    TemporaryFolder opened_;           ///< what packs held
    std::deque<IncomingFile> packed_;  ///< candidates point to them
    std::vector<GivenMark> scores_;    ///< in packs of reviews
};

}  // namespace

ReceiveOutcome receive(Course& course, const ReceiveRequest& request) {
    return SubmissionReceiver(course, request).run();
}

}  // namespace dynlab::inline course
