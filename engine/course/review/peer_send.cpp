#include <fmt/format.h>

#include <set>

#include "course/review/peer_review.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

struct Version {
    std::int64_t id = 0;
    std::string hash, name;
};

std::optional<Version> newest(Course& course, const Assignment& assignment, std::int64_t group, const char* stage,
                              std::int64_t pair, const char* part) {
    Rows rows = course.database().query(
        "SELECT id, hash, name FROM versions WHERE assignment = ? AND group_id = ? AND stage = ? AND ifnull(pair, 0) = "
        "? "
        "AND part = ? ORDER BY number DESC LIMIT 1",
        assignment.id, group, stage, pair, part);
    if (!rows.next()) return {};
    return Version{rows.integer(0), rows.text(1), rows.text(2)};
}

class CopySender {
  public:
    CopySender(Course& course, const Assignment& assignment, Way way, Instant now, const AnonymousCopier& copier)
        : course_(course),
          assignment_(assignment),
          way_(way),
          now_(now),
          copier_(copier),
          people_(students_of(course)) {
        outcome_.folder = course.folder() / "outbox" / assignment.name / (to_reviewers() ? "to-review" : "reviews");
    }

    SendOutcome run() {
        for (const ReviewPair& pair : review_pairs(course_, assignment_))
            if (!pair.ended) send(pair);
        return std::move(outcome_);
    }

  private:
    bool to_reviewers() const { return way_ == Way::kToReviewers; }
    const char* way_name() const { return to_reviewers() ? "to reviewer" : "to author"; }

    fs::path outgoing_file(const ReviewPair& pair) const {
        if (to_reviewers()) return outcome_.folder / pair.reviewer_name / (pair.report_pseudonym() + ".pdf");
        return outcome_.folder / pair.author_name / fmt::format("review-by-{}.pdf", pair.reviewer_pseudonym());
    }

    void put(const ReviewPair& pair, const std::string& hash) const {
        fs::create_directories(outgoing_file(pair).parent_path());
        if (!fs::exists(outgoing_file(pair))) write_file_atomically(outgoing_file(pair), read_file(course_.file(hash)));
    }

    void send(const ReviewPair& pair) {
        if (to_reviewers() ? pair.sent : pair.released) {
            Rows rows = course_.database().query(
                "SELECT hash FROM sendings WHERE pair = ? AND way = ? ORDER BY id DESC", pair.id, way_name());
            if (rows.next()) put(pair, rows.text(0));  // a crash may have come before the file
            ++outcome_.before;
            return;
        }
        const std::int64_t group = to_reviewers() ? pair.author : pair.reviewer;
        const char *const stage = to_reviewers() ? "first" : "review", *const part =
                                                                           to_reviewers() ? "report" : "review";
        const auto version = newest(course_, assignment_, group, stage, to_reviewers() ? 0 : pair.id, part);
        if (!version) {
            ++outcome_.waiting;
            return;
        }
        if (stopped_.contains(version->id)) {  // for another reviewer
            ++outcome_.stopped;
            return;
        }
        const std::string& author = to_reviewers() ? pair.author_name : pair.reviewer_name;
        const TemporaryFolder scratch;
        const auto under_its_name = [&](const Version& v) {  // the store's own names tell no kind
            const fs::path file = scratch.path() / fs::path(v.name).filename();
            fs::copy_file(course_.file(v.hash), file);
            return file;
        };
        CopyRequest request{under_its_name(*version),
                            {},
                            scratch.path() / ".copy" / "copy.pdf",
                            to_reviewers() ? pair.report_pseudonym() : pair.reviewer_pseudonym(),
                            people_,
                            author};
        if (const auto pack = newest(course_, assignment_, group, stage, to_reviewers() ? 0 : pair.id, "pack"))
            request.pack = under_its_name(*pack);
        fs::create_directories(request.copy.parent_path());
        const CopyOutcome copy = copier_(request);
        if (!copy.made) {
            stopped_.insert(version->id);
            ++outcome_.stopped;
            outcome_.hits.push_back(fmt::format("{} of {} was not sent: {}", part, author, fmt::join(copy.hits, " ")));
            return;
        }
        if (!copy.hints.empty() && doubted_.insert(version->id).second)
            outcome_.hints.push_back(
                fmt::format("{} of {} was sent, but look at it: {}", part, author, fmt::join(copy.hints, " ")));
        record(pair, *version, read_file(request.copy));
    }

    void record(const ReviewPair& pair, const Version& version, const std::string& content) {
        const std::string hash = course_.keep(content);
        course_.settle({hash});
        Transaction transaction(course_.database());
        course_.record_file(hash, static_cast<std::int64_t>(content.size()), now_);
        course_.database().run("INSERT INTO sendings (pair, way, version, hash, made_at) VALUES (?, ?, ?, ?, ?)",
                               pair.id, way_name(), version.id, hash, now_);
        transaction.commit();
        put(pair, hash);
        ++outcome_.sent;
    }

    Course& course_;
    const Assignment& assignment_;
    Way way_;
    Instant now_;
    const AnonymousCopier& copier_;
    std::vector<Student> people_;
    std::set<std::int64_t> stopped_, doubted_;  ///< versions
    SendOutcome outcome_;
};

}  // namespace

SendOutcome send_copies(Course& course, const Assignment& assignment, Way way, Instant now,
                        const AnonymousCopier& copier, bool early) {
    refuse_without_reviews(assignment);
    if (way == Way::kToAuthors && !early && now <= assignment.review_due.value_or(0) + assignment.grace)
        throw InvalidArgument(fmt::format("the reviews of {} may still come until {}; wait, or say --early",
                                          assignment.name,
                                          course.clock().show(assignment.review_due.value_or(0) + assignment.grace)));
    return CopySender(course, assignment, way, now, copier).run();
}

}  // namespace dynlab::inline course
