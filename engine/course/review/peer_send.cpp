#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/reader.h"
#include "course/review/peer_review.h"
#include "course/store/assignments.h"
#include "course/store/newest_versions.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/keys/secure_random.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

class CopySender {
  public:
    CopySender(Course& course, const Assignment& assignment, Way way, Instant now, const AnonymousCopier& copier,
               const AcceptedHits& accepted)
        : course_(course),
          assignment_(assignment),
          way_(way),
          now_(now),
          copier_(copier),
          reason_(accepted.reason),
          people_(students_of(course)) {
        if (!accepted.groups.empty() && reason_.empty())
            throw InvalidArgument(
                "give a reason for accepting the names with --reason \"...\"; the history shows the reason");
        for (const std::string& name : accepted.groups) accepted_.insert(group_named(course, name).name);
        outcome_.folder = course.folder() / "outbox" / assignment.name / (to_reviewers() ? "to-review" : "reviews");
    }

    SendOutcome run() {
        while (send_pairs_not_seen()) {
        }
        empty_outbox_of_others();
        if (outcome_.sent > 0) note_copies();
        if (!to_reviewers()) count_reviews();
        for (std::vector<Message>* const list : {&outcome_.hits, &outcome_.hints})
            std::ranges::sort(*list, {}, [](const Message& message) { return message_text(message); });
        return std::move(outcome_);
    }

  private:
    /// Sends pairs that were not processed yet and returns whether there was one. Pairs may change while copies are
    /// made. The order is random, so that neither times nor places of the files in the outbox reveal the authors.
    bool send_pairs_not_seen() {
        std::vector<ReviewPair> pairs = review_pairs(course_, assignment_);
        shuffle_items(pairs, secure_below);
        bool any = false;
        for (const ReviewPair& pair : pairs) {
            if (pair.ended || !seen_.insert(pair.id).second) continue;
            send(pair);
            any = true;
        }
        return any;
    }

    bool has_ended(const ReviewPair& pair) const {
        return course_.database().query("SELECT 1 FROM pairs WHERE id = ? AND ended_at IS NOT NULL", pair.id).next();
    }

    bool to_reviewers() const { return way_ == Way::kToReviewers; }
    const char* way_name() const { return to_reviewers() ? "to reviewer" : "to author"; }

    fs::path outgoing_file(const ReviewPair& pair) const {
        if (to_reviewers()) return outcome_.folder / pair.reviewer_name / (pair.report_pseudonym() + ".pdf");
        return outcome_.folder / pair.author_name / fmt::format("review-by-{}.pdf", pair.reviewer_pseudonym());
    }

    void put(const ReviewPair& pair, const std::string& hash) {
        const fs::path file = outgoing_file(pair);
        const std::string copy = read_file(course_.file(hash));
        const bool named = course_.database()
                               .query("SELECT 1 FROM versions WHERE hash = ? AND group_id = ?", hash,
                                      to_reviewers() ? pair.author : pair.reviewer)
                               .next();
        if (named || sha256_of(copy) != hash)
            throw EnvironmentError(
                "the copy for {} was altered after dynlab created it; no further copies were sent. Run dynlab course "
                "verify",
                file.string());
        kept_[file] = pair.id;
        fs::create_directories(file.parent_path());
        if (!fs::exists(file) || read_file(file) != copy) course_.write({{file, copy}});
    }

    /// What was taken back, withdrawn or held after it was laid there.
    void empty_outbox_of_others() {
        if (!fs::exists(outcome_.folder)) return;
        const Transaction nobody_changes_pairs(course_.database());
        for (const ReviewPair& pair : review_pairs(course_, assignment_))
            if (pair.ended) std::erase_if(kept_, [&pair](const auto& kept) { return kept.second == pair.id; });
        std::vector<fs::path> others;
        for (const auto& entry : fs::recursive_directory_iterator(outcome_.folder))
            if (entry.is_regular_file() && !kept_.contains(entry.path())) others.push_back(entry.path());
        for (const fs::path& file : others) {
            fs::remove(file);
            outcome_.removed.push_back(file.lexically_relative(outcome_.folder).string());
        }
        std::sort(outcome_.removed.begin(), outcome_.removed.end());
    }

    /// Reports whose mark would rest on one review, or on none.
    void count_reviews() {
        std::map<std::int64_t, int> written;
        for (const ReviewPair& pair : review_pairs(course_, assignment_))
            written[pair.author] += pair.written && !pair.ended;
        for (const Group& group : groups_of(course_)) {
            if (group.dropped_out || !newest_file(course_, assignment_, group.id, "first", "report")) continue;
            if (written[group.id] == 0) outcome_.unreviewed.push_back(group.name);
            if (written[group.id] == 1 && assignment_.reviews > 1) outcome_.reviewed_once.push_back(group.name);
        }
    }

    std::optional<std::string> sent_before(const ReviewPair& pair) const {
        Rows rows = course_.database().query("SELECT hash FROM sendings WHERE pair = ? AND way = ? ORDER BY id DESC",
                                             pair.id, way_name());
        return rows.next() ? std::optional(rows.text(0)) : std::nullopt;
    }

    void send(const ReviewPair& pair) {
        if (is_held(course_, assignment_, to_reviewers() ? pair.author : pair.reviewer,
                    to_reviewers() ? std::nullopt : std::optional(pair.id))) {
            ++outcome_.held;
            return;
        }
        const auto before = sent_before(pair);
        const bool is_sendable = to_reviewers() || pair.written;
        if (before && is_sendable) put(pair, *before);  // a crash may have come before the file
        if (before && is_sendable && !(to_reviewers() ? pair.newer_report : pair.newer_review)) {
            ++outcome_.before;
            return;
        }
        const std::int64_t group = to_reviewers() ? pair.author : pair.reviewer;
        const char *const stage = to_reviewers() ? "first" : "review", *const part =
                                                                           to_reviewers() ? "report" : "review";
        const auto version = newest_file(course_, assignment_, group, stage, part, to_reviewers() ? 0 : pair.id);
        if (!version) {
            ++outcome_.waiting;
            return;
        }
        if (stopped_.contains(version->id)) {  // for another reviewer
            ++outcome_.stopped;
            save_stop(pair, version->id);
            return;
        }
        const std::string& author = to_reviewers() ? pair.author_name : pair.reviewer_name;
        const TemporaryFolder scratch;
        const auto under_its_name = [&](const ValidFile& v) {  // the store's own names do not show the file type
            const fs::path file = scratch.path() / fs::path(v.name).filename();
            fs::copy_file(course_.file(v.hash), file);
            return file;
        };
        CopyRequest request{under_its_name(*version), {}, scratch.path() / ".copy" / "copy.pdf", people_, author};
        if (const auto pack = pack_of_document(course_, version->id)) request.pack = under_its_name(*pack);
        fs::create_directories(request.copy.parent_path());
        request.accept = accepted_.contains(author);
        const CopyOutcome copy = copier_(request);
        const Message document = to_reviewers() ? Message("report") : Message("review");
        if (!copy.made) {
            stopped_.insert(version->id);
            ++outcome_.stopped;
            save_stop(pair, version->id);
            outcome_.hits.push_back(Message("the {} of {} was not sent: {}", document, author, sentences(copy.hits)));
            return;
        }
        if (!copy.hints.empty() && doubted_.insert(version->id).second)
            outcome_.hints.push_back(
                Message("the {} of {} was sent, but it may contain a name; inspect these places: {}", document, author,
                        sentences(copy.hints)));
        if (!copy.hits.empty() && doubted_.insert(version->id).second)
            outcome_.hints.push_back(Message("the {} of {} was sent, although it contains names: {}", document, author,
                                             sentences(copy.hits)));
        save_sending(pair, *version, read_file(request.copy), copy.hits.empty() ? "" : author);
    }

    void note_copies() {
        Transaction transaction(course_.database());
        course_.note(to_reviewers()
                         ? fmt::format("{}: copies of reports sent to reviewers: {}", assignment_.name, outcome_.sent)
                         : fmt::format("{}: reviews released: {}", assignment_.name, outcome_.sent),
                     now_);
        transaction.commit();
    }

    /// So that the status stops asking for what cannot be sent.
    void save_stop(const ReviewPair& pair, std::int64_t version) {
        if (to_reviewers() ? pair.stopped_report : pair.stopped_review) return;
        Transaction transaction(course_.database());
        course_.database().run("INSERT INTO stops VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING", pair.id, way_name(),
                               version, now_);
        transaction.commit();
    }

    /// `accepted`: the group whose hits were accepted; else empty.
    void save_sending(const ReviewPair& pair, const ValidFile& version, const std::string& content,
                      const std::string& accepted) {
        if (has_ended(pair)) return;  // while the copy was made
        const std::string hash = course_.keep(content);
        course_.settle({hash});
        Transaction transaction(course_.database());
        if (has_ended(pair)) return;
        course_.register_file(hash, static_cast<std::int64_t>(content.size()), now_);
        course_.database().run("INSERT INTO sendings (pair, way, version, hash, made_at) VALUES (?, ?, ?, ?, ?)",
                               pair.id, way_name(), version.id, hash, now_);
        if (!accepted.empty() && noted_.insert(version.id).second)
            course_.note(fmt::format("{}: the {} of {} was sent, although it contains names; reason: {}",
                                     assignment_.name, to_reviewers() ? "report" : "review", accepted, reason_),
                         now_);
        transaction.commit();
        outcome_.again += to_reviewers() ? pair.sent : pair.released;
        put(pair, hash);
        ++outcome_.sent;
    }

    Course& course_;
    const Assignment& assignment_;
    Way way_;
    Instant now_;
    const AnonymousCopier& copier_;
    std::string reason_;
    std::set<std::string> accepted_;  ///< groups
    std::vector<Student> people_;
    std::set<std::int64_t> stopped_, doubted_, noted_;  ///< versions
    std::set<std::int64_t> seen_;                       ///< pairs
    std::map<fs::path, std::int64_t> kept_;             ///< what is to lie in the outbox, and its pair
    SendOutcome outcome_;
};

}  // namespace

SendOutcome send_copies(Course& course, const Assignment& assignment, Way way, Instant now,
                        const AnonymousCopier& copier, bool early, const AcceptedHits& accepted) {
    refuse_without_reviews(assignment);
    if (way == Way::kToAuthors && !early && now <= assignment.review_due.value_or(0) + assignment.grace)
        throw InvalidArgument("groups can submit reviews of {} until {}; wait, or give --early", assignment.name,
                              course.clock().show(assignment.review_due.value_or(0) + assignment.grace));
    return CopySender(course, assignment, way, now, copier, accepted).run();
}

}  // namespace dynlab::inline course
