#include "course/review/review_pairs.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

/// The numbers behind "report" or "review" in a file's name, however they are joined: "review-report-07.pdf",
/// "Review 68.pdf", "report_07.PDF", "Report47".
std::vector<std::int64_t> report_numbers(const std::string& name) {
    constexpr std::size_t kMaxDigits = 6;
    static const RE2 form("(?i)(?:report|review)[ _.#-]*([0-9]+)", RE2::Latin1);
    std::vector<std::int64_t> numbers;
    std::string digits;
    for (re2::StringPiece rest = name; RE2::FindAndConsume(&rest, form, &digits);)
        if (digits.size() <= kMaxDigits) numbers.push_back(std::stoll(digits));
    return numbers;
}

}  // namespace

std::string ReviewPair::report_pseudonym() const {
    return fmt::format("report-{:02}", report_number);
}
std::string ReviewPair::reviewer_pseudonym() const {
    return fmt::format("reviewer-{:02}", reviewer_number);
}

std::vector<ReviewPair> review_pairs(Course& course, const Assignment& assignment) {
    std::vector<ReviewPair> pairs;
    for (Rows rows = course.database().query(
             "SELECT p.id, p.reviewer, p.author, r.name, w.name, pw.number, pr.number, p.ended_at IS NOT NULL, EXISTS "
             "(SELECT 1 FROM sendings WHERE pair = p.id AND way = 'to reviewer'), EXISTS (SELECT 1 FROM standing WHERE "
             "pair = p.id AND part = 'review'), EXISTS (SELECT 1 FROM sendings WHERE pair = p.id AND way = 'to "
             "author'), (SELECT min(late) FROM standing WHERE pair = p.id AND part = 'review'), (SELECT id "
             "FROM standing WHERE pair = p.id AND part = 'review' ORDER BY number DESC LIMIT 1), (SELECT version FROM "
             "sendings WHERE pair = p.id AND way = 'to author' ORDER BY id DESC LIMIT 1), (SELECT id FROM standing v "
             "WHERE v.assignment = p.assignment AND v.group_id = p.author AND v.stage = 'first' AND v.part = 'report' "
             "ORDER BY number DESC LIMIT 1), (SELECT version FROM sendings WHERE pair = p.id AND way = 'to reviewer' "
             "ORDER BY id DESC LIMIT 1), EXISTS (SELECT 1 FROM standing WHERE pair = p.id AND part = 'pack'), EXISTS "
             "(SELECT 1 FROM versions WHERE pair = p.id), (SELECT max(version) FROM stops WHERE pair = p.id AND way = "
             "'to reviewer'), (SELECT max(version) FROM stops WHERE pair = p.id AND way = 'to author') FROM "
             "pairs p JOIN groups r ON r.id = p.reviewer JOIN groups w ON w.id = p.author JOIN pseudonyms pw ON "
             "pw.assignment = p.assignment AND pw.group_id = p.author AND pw.role = 'author' JOIN pseudonyms pr ON "
             "pr.assignment = p.assignment AND pr.group_id = p.reviewer AND pr.role = 'reviewer' WHERE p.assignment = "
             "? ORDER BY r.name, w.name, p.id",
             assignment.id);
         rows.next();) {
        ReviewPair pair;
        pair.id = rows.integer(0), pair.reviewer = rows.integer(1), pair.author = rows.integer(2);
        pair.reviewer_name = rows.text(3), pair.author_name = rows.text(4);
        pair.report_number = rows.integer(5), pair.reviewer_number = rows.integer(6);
        pair.ended = rows.integer(7) != 0, pair.sent = rows.integer(8) != 0;
        pair.written = rows.integer(9) != 0, pair.released = rows.integer(10) != 0;
        pair.only_pack = !pair.written && rows.integer(16) != 0;
        pair.withdrawn = !pair.written && !pair.only_pack && rows.integer(17) != 0;
        pair.late = pair.written ? rows.integer(11) : 0;
        pair.stopped_report = !rows.isColumnNull(18) && rows.integer(18) == rows.integer(14);
        pair.stopped_review = !rows.isColumnNull(19) && rows.integer(19) == rows.integer(12);
        pair.newer_review = pair.released && pair.written && rows.integer(12) != rows.integer(13);
        pair.newer_report = pair.sent && !pair.written && !pair.released && !rows.isColumnNull(14) &&
                            rows.integer(14) != rows.integer(15);
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

std::int64_t newest_review(Course& course, std::int64_t pair) {
    Rows rows = course.database().query(
        "SELECT id FROM standing WHERE pair = ? AND part IN ('review', 'pack') ORDER BY part = 'review' DESC, number "
        "DESC LIMIT 1",
        pair);
    return rows.next() ? rows.integer(0) : 0;
}

ReviewPair reviewed_pair(const std::vector<ReviewPair>& pairs, const Group& reviewer, const std::string& name) {
    std::vector<const ReviewPair*> given, taken_back;
    for (const ReviewPair& pair : pairs) {
        if (pair.reviewer != reviewer.id || (pair.ended && !pair.sent)) continue;
        (pair.ended ? taken_back : given).push_back(&pair);
    }
    if (given.empty() && taken_back.empty())
        throw EnvironmentError(
            "{} received no report to review. To assign the reviews, run dynlab course review assign", reviewer.name);
    const std::vector<std::int64_t> named = report_numbers(name);
    for (const auto* list : {&given, &taken_back})
        for (const ReviewPair* pair : *list)
            if (std::find(named.begin(), named.end(), pair->report_number) != named.end()) return *pair;
    const auto& open = given.empty() ? taken_back : given;
    if (open.size() == 1 && named.empty()) return *open.front();
    std::vector<std::string> reports;
    for (const ReviewPair* pair : open) reports.push_back(pair->report_pseudonym());
    if (!named.empty())
        throw EnvironmentError("the file is a review of {}, which {} did not receive; the reports to review are {}",
                               fmt::format("report-{:02}", named.front()), reviewer.name, listed(reports, Join::kAnd));
    throw EnvironmentError(
        "the review does not name the reviewed report. {} received {}: rename the file to review-{}.pdf, or give --of "
        "{}",
        reviewer.name, listed(reports, Join::kAnd), reports.front(), reports.front());
}

}  // namespace dynlab::inline course
