// Which reviews and scores count, for whom, and what is sent to whom.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "course/corrections/corrections.h"
#include "course/course_bench.h"
#include "course/office/course_export.h"
#include "course/office/course_status.h"
#include "course/office/receive.h"
#include "course/review/peer_review.h"
#include "course/review/review_marks.h"
#include "course/review/score_sheet.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"

namespace dynlab::test {
namespace test_review_rules {
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A course and what instructors and groups do in it.
class Term {
  public:
    explicit Term(const CourseBench& begun)
        : bench_(begun), course_(bench_.bench().path() / "k"), crane_(assignment_named(course_, "crane")) {}

    Instant at(const std::string& text) const { return course_.clock().parse(text, "time"); }
    std::int64_t id(const std::string& group) { return group_named(course_, group).id; }
    std::filesystem::path file(const std::string& name, const std::string& text) {
        bench_.bench().write(name, text);
        return bench_.bench().path() / name;
    }

    ReceiveOutcome submit(const std::string& stage, const std::string& group, const std::string& time,
                          const std::string& of = "", const std::string& text = "") {
        ReceiveRequest request;
        request.files = {file("work.pdf", small_pdf(text + " " + stage + " of " + group + " " + of))};
        request.assignment = "crane", request.stage = stage, request.from = group, request.at = at(time);
        if (!of.empty()) request.of = {of};
        request.checks = false;
        return receive(course_, request);
    }
    void submit_pack(const std::string& group, const std::string& time) {
        const std::string content = "pack of " + group + time, hash = course_.keep(content);
        course_.settle({hash});
        course_.register_file(hash, static_cast<std::int64_t>(content.size()), at(time));
        course_.database().run(
            "INSERT INTO versions (assignment, group_id, stage, part, number, hash, name, received_at, due_at, late, "
            "findings, signature) VALUES (?, ?, 'first', 'pack', 1, ?, 'work.zip', ?, ?, 0, '', '')",
            crane_.id, id(group), hash, at(time), crane_.first_due);
    }

    /// Sends copies that contain no name, except the copies of `stopped` groups.
    SendOutcome send(Way way, const std::string& time, const std::set<std::string>& stopped = {}) {
        return send_copies(
            course_, crane_, way, at(time),
            [&](const CopyRequest& request) {
                sources_[request.group] = request.pack.empty() ? "pdf" : "pack";
                if (stopped.contains(request.group)) return CopyOutcome{false, {Message("a name")}, {}};
                std::ofstream(request.copy) << "copy " << request.pdf;
                return CopyOutcome{true, {}, {}};
            },
            true);
    }

    std::vector<ReviewPair> pairs() { return review_pairs(course_, crane_); }
    /// The first pair with this reviewer.
    ReviewPair pair_of(const std::string& reviewer, bool ended = false) {
        for (const ReviewPair& pair : pairs())
            if (pair.reviewer_name == reviewer && pair.ended == ended) return pair;
        ADD_FAILURE() << "no pair of " << reviewer;
        return {};
    }
    int score(const ReviewPair& pair, const std::string& points, const std::string& time) {
        return import_scores(course_, crane_, "first",
                             file("s.csv", "reviewer,report,data\n" + pair.reviewer_name + "," +
                                               pair.report_pseudonym() + "," + points + "\n"),
                             at(time));
    }
    std::optional<double> work_of(std::int64_t group, const std::string& time = "2026-03-10 10:00") {
        for (const GroupMark& mark : course_marks(course_, crane_, at(time)).groups)
            if (mark.group == group) return mark.work;
        return {};
    }
    void withdraw_review(const ReviewPair& pair, bool withdrawn, const std::string& time) {
        withdraw(course_, crane_, {pair.reviewer_name, "review", "", pair.report_pseudonym(), {}}, withdrawn, "reason",
                 at(time));
    }
    template <class Work>
    static std::string refusal(const Work& work) {
        try {
            work();
        } catch (const std::runtime_error& error) {
            return message_text(message_of(error));
        } catch (const std::logic_error& error) {
            return message_text(message_of(error));
        }
        return "";
    }

    CourseBench bench_;
    Course course_;
    Assignment crane_;
    std::map<std::string, std::string> sources_;  ///< what the copies were made from, by group
};

/// Four groups with a report each, who review two reports each; the pairs are drawn and sent. Made once and copied.
class review_rules : public testing::Test, protected Term {
  protected:
    review_rules() : Term(sent()) {}

    static const CourseBench& sent() {
        static const CourseBench bench = [] {
            Term term(CourseBench(4));
            term.course_.database().run("UPDATE memberships SET since = ?", term.at("2026-01-01 12:00"));
            for (int i = 1; i <= 4; ++i) term.submit("first", CourseBench::group(i), "2026-03-01 10:00");
            assign_reviews(term.course_, term.crane_, term.at("2026-03-02 10:00"), false);
            term.send(Way::kToReviewers, "2026-03-02 11:00");
            return CourseBench(term.bench_);
        }();
        return bench;
    }
};

using Mark = std::optional<double>;

// oracle: the only score, and its absence
TEST_F(review_rules, scores_of_a_withdrawn_review_count_again_once_it_is_restored) {
    const ReviewPair pair = pair_of("group-01");
    submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    score(pair, "0", "2026-03-06 10:00");
    EXPECT_EQ(work_of(pair.author), Mark(0));
    withdraw_review(pair, true, "2026-03-07 10:00");
    EXPECT_EQ(work_of(pair.author), Mark());
    EXPECT_THAT(refusal([&] { score(pair, "3", "2026-03-07 11:00"); }), HasSubstr("is withdrawn"));
    withdraw_review(pair, false, "2026-03-08 10:00");
    EXPECT_EQ(work_of(pair.author), Mark(0));
}

// oracle: the pairs that the course has in the end
TEST_F(review_rules, pairs_that_change_while_copies_are_made_are_sent_as_they_are_in_the_end) {
    Term term(CourseBench(5, 2));
    term.course_.database().run("UPDATE memberships SET since = ?", term.at("2026-01-01 12:00"));
    for (int i = 1; i <= 5; ++i) term.submit("first", CourseBench::group(i), "2026-03-01 10:00");
    assign_reviews(term.course_, term.crane_, term.at("2026-03-02 10:00"), false);
    bool changed = false;
    send_copies(
        term.course_, term.crane_, Way::kToReviewers, term.at("2026-03-02 11:00"),
        [&](const CopyRequest& request) {
            if (!std::exchange(changed, true)) {  // what a second terminal does meanwhile
                const ReviewPair taken = term.pair_of(request.group == "group-01" ? "group-02" : "group-01");
                constrain_pair(term.course_, term.crane_, taken.reviewer_name, taken.author_name, "forbid",
                               "they share a flat", term.at("2026-03-02 11:00"));
                assign_reviews(term.course_, term.crane_, term.at("2026-03-02 11:00"), true);
                EXPECT_TRUE(term.pair_of(taken.reviewer_name, true).ended);
            }
            std::ofstream(request.copy) << "copy " << request.pdf;
            return CopyOutcome{true, {}, {}};
        },
        true);
    std::set<std::string> expected, sent;
    for (const ReviewPair& pair : term.pairs())
        if (!pair.ended) expected.insert(pair.reviewer_name + "/" + pair.report_pseudonym() + ".pdf");
    const std::filesystem::path outbox = term.course_.folder() / "outbox/crane/to-review";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(outbox))
        if (entry.is_regular_file()) sent.insert(entry.path().lexically_relative(outbox).string());
    EXPECT_EQ(sent, expected);
}

// oracle: the next version has no scores until they are given
TEST_F(review_rules, scores_of_a_withdrawn_version_do_not_count_for_the_next_one) {
    const ReviewPair pair = pair_of("group-01");
    submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    score(pair, "0", "2026-03-06 10:00");
    withdraw_review(pair, true, "2026-03-07 10:00");
    submit("review", "group-01", "2026-03-07 11:00", pair.report_pseudonym(), "better");
    EXPECT_EQ(work_of(pair.author), Mark());
    EXPECT_EQ(score(pair, "4", "2026-03-07 12:00"), 1);
    EXPECT_EQ(work_of(pair.author), Mark(80));
    EXPECT_EQ(score(pair, "4", "2026-03-07 13:00"), 0);
}

// oracle: scores before and after; an empty cell changes nothing
TEST_F(review_rules, a_dash_takes_a_score_back) {
    const ReviewPair pair = pair_of("group-01");
    score(pair, "4", "2026-03-06 10:00");
    EXPECT_EQ(score(pair, "", "2026-03-06 11:00"), 0);
    EXPECT_EQ(work_of(pair.author), Mark(80));
    EXPECT_EQ(score(pair, "-", "2026-03-06 12:00"), 1);
    EXPECT_EQ(work_of(pair.author), Mark());
    submit("final", "group-02", "2026-03-14 10:00");
    const auto finals = [&](const std::string& points, const std::string& time) {
        return import_scores(course_, crane_, "final", file("f.csv", "group,data\ngroup-02," + points + "\n"),
                             at(time));
    };
    finals("5", "2026-03-15 10:00");
    EXPECT_EQ(work_of(id("group-02")), Mark(100));
    EXPECT_EQ(finals("-", "2026-03-15 11:00"), 1);
    EXPECT_EQ(work_of(id("group-02")), Mark());
}

// oracle: the rows that are refused; what was given before the group dropped out can be taken back
TEST_F(review_rules, scores_without_a_submission_are_refused) {
    const auto finals = [&](const std::string& row) {
        return refusal([&] {
            import_scores(course_, crane_, "final", file("f.csv", "group,data\n" + row + "\n"), at("2026-03-15 10:00"));
        });
    };
    EXPECT_THAT(finals("group-02,4"), HasSubstr("group-02 has submitted no final version of crane"));
    submit("final", "group-02", "2026-03-14 10:00");
    EXPECT_EQ(finals("group-02,4"), "");
    set_group_dropped_out(course_, "group-02", true, "ill");
    EXPECT_THAT(finals("group-02,5"), AllOf(HasSubstr("f.csv, line 2"), HasSubstr("group-02 dropped out")));
    EXPECT_EQ(finals("group-02,-"), "");
    EXPECT_EQ(work_of(id("group-02")), Mark());
}

// oracle: the mark that was given
TEST_F(review_rules, export_has_the_mark_that_one_student_alone_was_given) {
    Transaction transaction(course_.database());
    give_mark(course_, crane_, {id("group-03"), "s3", kWholeItem, 77, "oral"}, at("2026-03-06 10:00"));
    transaction.commit();
    EXPECT_THAT(marks_csv(course_, crane_), HasSubstr(",77,oral,"));
}

// oracle: the group at the time of the first version; another group has a separate mark
TEST_F(review_rules, marks_follow_the_membership_at_the_submission) {
    const auto mine = [&](const std::string& group, const std::string& points) {
        import_scores(course_, crane_, "first",
                      file("s.csv", "reviewer,report,data\ninstructor," + group + "," + points + "\n"),
                      at("2026-03-06 10:00"));
    };
    mine("group-03", "4"), mine("group-04", "2");
    course_.database().run("UPDATE memberships SET until = ? WHERE student = 's3'", at("2026-03-03 10:00"));
    course_.database().run("INSERT INTO memberships VALUES ('s3', ?, ?, NULL)", id("group-04"), at("2026-03-03 10:00"));
    const auto authors = author_groups(course_, crane_);
    EXPECT_EQ(authors.at("s3"), id("group-03"));
    EXPECT_EQ(authors.at("s4"), id("group-04"));
    const std::string csv = marks_csv(course_, crane_);
    EXPECT_THAT(csv, HasSubstr(",80,"));
    EXPECT_THAT(csv, HasSubstr("marks of group-03, the group at the submission"));
    course_.database().run("UPDATE memberships SET until = ? WHERE student = 's3' AND until IS NOT NULL",
                           at("2026-02-20 10:00"));
    course_.database().run("UPDATE memberships SET since = ? WHERE student = 's3' AND until IS NULL",
                           at("2026-02-20 10:00"));
    EXPECT_EQ(author_groups(course_, crane_).at("s3"), id("group-04"));  // moved before the submission
}

// oracle: the percent that the instructor gave, from which nothing is taken off; a review that nobody was sent
TEST_F(review_rules, deductions_are_of_computed_marks_and_of_reviews_that_were_sent) {
    crane_.costs = costs_of("missing-final:30,missing-review:25");
    set_assignment(course_, crane_, "a test");
    import_scores(course_, crane_, "first", file("s.csv", "reviewer,report,data\ninstructor,group-01,4\n"),
                  at("2026-03-06 10:00"));
    const auto row = [&] {
        const std::string csv = marks_csv(course_, crane_, at("2026-05-01 10:00"));
        return csv.substr(csv.find("s1,"), csv.find("s2,") - csv.find("s1,"));
    };
    EXPECT_THAT(row(), AllOf(HasSubstr("30 % deducted for a missing final version"),
                             HasSubstr("50 % deducted for 2 missing reviews")));
    Transaction transaction(course_.database());
    give_mark(course_, crane_, {id("group-01"), "", "*", 70, "seen"}, at("2026-03-07 10:00"));
    transaction.commit();
    EXPECT_THAT(row(), AllOf(HasSubstr(",70,seen,"), Not(HasSubstr("30 % deducted")), HasSubstr("50 % deducted")));
    course_.database().run("DELETE FROM sendings WHERE pair = ?", pair_of("group-01").id);
    EXPECT_THAT(row(), HasSubstr("25 % deducted for 1 missing review"));
}

// oracle: the remark, and the pair that is taken back
TEST_F(review_rules, a_pair_that_shares_a_member_later_is_taken_back_or_reported) {
    const ReviewPair pair = pair_of("group-01");
    submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    course_.database().run("UPDATE memberships SET group_id = ? WHERE student = 's1'", id("group-01"));
    course_.database().run("INSERT INTO memberships VALUES (?, ?, ?, NULL)", "s" + pair.author_name.substr(7),
                           id("group-01"), at("2026-03-06 10:00"));
    EXPECT_THAT(assignment_status(course_, crane_, at("2026-03-06 11:00")),
                HasSubstr("reviews a report by a current or former group member"));
    const AssignOutcome outcome = assign_reviews(course_, crane_, at("2026-03-06 12:00"), false);
    std::string remarks;
    for (const Message& remark : outcome.remarks) remarks += message_text(remark) + "\n";
    EXPECT_THAT(remarks,
                HasSubstr("group-01 has reviewed " + pair.author_name + ", but the groups share or shared a member"));
    for (const ReviewPair& other : pairs())
        EXPECT_FALSE(!other.ended && other.reviewer == pair.author && other.author == pair.reviewer);
}

// oracle: the times of pack and PDF
TEST_F(review_rules, a_pack_is_a_source_only_of_the_newest_report) {
    submit_pack("group-01", "2026-03-02 12:00");
    submit_pack("group-02", "2026-03-02 12:00");
    submit("first", "group-01", "2026-03-02 13:00", "", "newer");
    submit("first", "group-02", "2026-03-02 12:00", "", "newer");
    send(Way::kToReviewers, "2026-03-02 14:00");
    EXPECT_EQ(sources_["group-01"], "pdf");
    EXPECT_EQ(sources_["group-02"], "pack");
}

// oracle: the reviews that were submitted
TEST_F(review_rules, release_lists_reports_with_one_review_or_none) {
    const ReviewPair pair = pair_of("group-01");
    submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    const SendOutcome outcome = send(Way::kToAuthors, "2026-03-09 10:00");
    EXPECT_THAT(outcome.reviewed_once, ElementsAre(pair.author_name));
    EXPECT_EQ(outcome.unreviewed.size(), 3u);
    score(pair, "4", "2026-03-09 11:00");
    EXPECT_THAT(marks_csv(course_, crane_), AllOf(HasSubstr("is based on one review"), HasSubstr("no scored review")));
}

// oracle: the definition: 0 where any other group has points; by hand
TEST_F(review_rules, missing_points_of_an_oral_count_zero) {
    Assignment talk;
    talk.name = "talk", talk.kind = "talk", talk.first_due = at("2026-04-01 12:00");
    talk.criteria = {{"content", 5}, {"script", 5}, {"answers", 10}};
    set_assignment(course_, talk);
    talk = assignment_named(course_, "talk");
    import_scores(course_, talk, "first",
                  file("o.csv", "group,student,content,script\ngroup-01,,4,5\ngroup-02,,4,\ngroup-03,s3,5,\n"),
                  at("2026-04-02 10:00"));
    std::map<std::int64_t, GroupMark> marks;
    const Marks all = course_marks(course_, talk, at("2026-04-02 11:00"));
    for (const GroupMark& mark : all.groups) marks[mark.group] = mark;
    EXPECT_EQ(marks[id("group-01")].work, Mark(90));  // no group has points for answers yet
    EXPECT_EQ(marks[id("group-02")].work, Mark(40));
    EXPECT_THAT(marks[id("group-02")].zeros, ElementsAre("script"));
    EXPECT_EQ(marks[id("group-03")].work, Mark());
    EXPECT_EQ(all.work_of(marks[id("group-03")], "s3").percent, Mark(50));
    EXPECT_EQ(marks[id("group-04")].work, Mark());
    EXPECT_THAT(marks_csv(course_, talk), HasSubstr("no points for script, counted as 0"));
}

// oracle: the pair was taken back after it was sent; marks do not know the review
TEST_F(review_rules, a_review_of_a_report_that_was_taken_back_is_voluntary) {
    const ReviewPair pair = pair_of("group-01");
    withdraw(course_, crane_, {pair.author_name, "first", "", "", {}}, true, "plagiarism", at("2026-03-03 10:00"));
    assign_reviews(course_, crane_, at("2026-03-03 11:00"), false);
    const ReceiveOutcome outcome = submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    ASSERT_EQ(outcome.received.size(), 1u);
    EXPECT_TRUE(outcome.received.front().voluntary);
    EXPECT_TRUE(pair_of("group-01", true).voluntary());
    EXPECT_FALSE(submit("review", "group-01", "2026-03-05 11:00", pair_of("group-01").report_pseudonym())
                     .received.front()
                     .voluntary);
    score(pair, "4", "2026-03-06 10:00");
    EXPECT_EQ(work_of(pair.author), Mark());
    EXPECT_THAT(assignment_status(course_, crane_, at("2026-03-06 11:00")), HasSubstr("1 voluntary"));
    EXPECT_EQ(send(Way::kToAuthors, "2026-03-09 10:00").sent, 1);
}

// oracle: the next step before and after the copy was stopped, and once another review came
TEST_F(review_rules, status_does_not_ask_to_release_a_stopped_review) {
    const auto status = [&](const std::string& time) { return assignment_status(course_, crane_, at(time)); };
    const ReviewPair pair = pair_of("group-01");
    submit("review", "group-01", "2026-03-05 10:00", pair.report_pseudonym());
    EXPECT_THAT(status("2026-03-09 09:00"), HasSubstr("Next: dynlab course review release"));
    EXPECT_EQ(send(Way::kToAuthors, "2026-03-09 10:00", {"group-01"}).stopped, 1);
    EXPECT_THAT(status("2026-03-09 11:00"), Not(HasSubstr("Next: dynlab course review release")));
    submit("review", "group-01", "2026-03-09 12:00", pair.report_pseudonym(), "without a name");
    EXPECT_THAT(status("2026-03-09 13:00"), HasSubstr("Next: dynlab course review release"));
}

// oracle: the message
TEST_F(review_rules, a_pair_is_not_set_for_a_report_that_does_not_exist) {
    withdraw(course_, crane_, {"group-04", "first", "", "", {}}, true, "wrong file", at("2026-03-03 10:00"));
    const auto set = [&](const std::string& author) {
        return refusal(
            [&] { constrain_pair(course_, crane_, "group-01", author, "set", "agreed", at("2026-03-03 11:00")); });
    };
    EXPECT_THAT(set("group-04"), HasSubstr("group-04 has submitted no report for crane"));
    EXPECT_EQ(set("group-02"), "");
}

// oracle: the times above: a first version in time, a final version 90 minutes late, a review 2 h late
TEST_F(review_rules, export_has_plain_times_and_hours) {
    submit("review", "group-01", "2026-03-08 14:00", pair_of("group-01").report_pseudonym());
    submit("final", "group-01", "2026-03-15 13:30");
    const std::string csv = marks_csv(course_, crane_);
    EXPECT_THAT(csv, HasSubstr("first version,first late (h),reviews written,reviews late (h),final version,final late "
                               "(h),work percent,"));
    EXPECT_THAT(csv, HasSubstr("group-01,2026-03-01 10:00,0,1 of 2,2,2026-03-15 13:30,1.5,"));
    EXPECT_THAT(csv, HasSubstr("group-02,2026-03-01 10:00,0,0 of 2,0,missing,,"));
}

}  // namespace test_review_rules
}  // namespace dynlab::test
