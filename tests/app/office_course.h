#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "course/review/peer_review.h"
#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/marks.h"
#include "course/store/versions.h"
#include "platform/atomic_file.h"
#include "support/preview_program.h"
#include "support/program.h"

namespace dynlab::test {

/// A course "k" of groups group-001, group-002, ... of one student each, to be filled by the store's own functions.
class OfficeCourse {
  public:
    explicit OfficeCourse(int groups) : groups_(groups) {
        Course::create(folder(), "Signals 2026", "UTC");
        std::string roster = "id,name,group,email\n";
        for (int i = 1; i <= groups; ++i)
            roster += id(i) + "," + name(i) + "," + group(i) + "," + id(i) + "@example.org\n";
        bench_.write("roster.csv", roster);
        course_ = std::make_unique<Course>(folder());
        import_roster(*course_, bench_.path("roster.csv"));
        for (int i = 1; i <= groups; ++i) group_ids_.push_back(group_named(*course_, group(i)).id);
    }

    std::filesystem::path folder() const { return bench_.path("k"); }
    Course& course() { return *course_; }
    const Workbench& bench() const { return bench_; }
    ChildResult run(std::vector<std::string> words) const {
        words.insert(words.begin(), {"course", "--course", "k"});
        return bench_.dynlab(words);
    }
    static std::string digits(int i) { return std::string(i < 10 ? "00" : i < 100 ? "0" : "") + std::to_string(i); }
    static std::string group(int i) { return "group-" + digits(i); }
    static std::string id(int i) { return "s" + digits(i); }
    static std::string name(int i) {
        static const std::vector<std::string> given = {"Élise", "Wei", "Nguyễn", "Дмитрий", "Ada", "Björn"};
        return given[static_cast<std::size_t>(i) % given.size()] + " Family" + digits(i);
    }
    std::int64_t group_id(int i) const { return group_ids_[static_cast<std::size_t>(i)]; }
    Instant at(const std::string& time) const { return course_->clock().parse(time, "time"); }

    Assignment add(const std::string& assignment, const std::string& kind, const std::string& lesson = "") {
        Assignment a;
        a.name = assignment, a.kind = kind, a.lesson = lesson, a.weight = 10;
        a.first_due = at("2026-03-01 12:00");
        if (a.is_report()) a.review_due = at("2026-03-08 12:00"), a.final_due = at("2026-03-15 12:00");
        if (!a.is_lab()) a.criteria = usual_criteria(kind);
        a.costs = costs_of("late-day:10,late-most:100");
        set_assignment(*course_, a);
        return assignment_named(*course_, assignment);
    }

    /// A file of a group as the store has it once it was received.
    std::int64_t submit(const Assignment& a, int i, const std::string& part, const std::string& text,
                        const std::string& time = "2026-03-01 11:00") {
        Transaction transaction(course_->database());
        const std::int64_t version = enter_file(a, i, part, text, time);
        transaction.commit();
        return version;
    }

    /// A lab of lesson 04 that every group submitted, with this answer to question 3, and was graded.
    Assignment add_lab(const std::string& name, const std::function<std::string(int)>& answer) {
        const Assignment lab = add(name, "lab", "04");
        Transaction transaction(course_->database());
        for (int i = 1; i <= groups_; ++i) {
            const std::int64_t version = enter_file(
                lab, i, "script",
                "-- ---\n-- title: Mine\n-- ---\n\n-- %% [markdown]\n-- **Question 3.** Write the model for the "
                "$N$ samples as a linear regression in matrix form, and state the sizes of the matrices. What is "
                "the\n-- least-squares solution?\n--\n" +
                    answer(i) + "\n\n-- %% id=q4\nprint(" + std::to_string(i) + ")\n",
                "2026-03-01 11:00");
            save_result(*course_, {version, {{"q3", 4, 0, false}, {"gain", 6, 5, true}}, "f"}, at("2026-03-02 12:00"));
        }
        transaction.commit();
        return lab;
    }
    /// A report with two reviews of each, scored by their reviewers but for group-001, who gave zeros.
    Assignment add_report(const std::string& name) {
        const Assignment report = add(name, "report");
        {
            Transaction transaction(course_->database());
            for (int i = 1; i <= groups_; ++i)
                enter_file(report, i, "report", name + " of " + group(i), "2026-03-01 11:00");
            transaction.commit();
        }
        assign_reviews(*course_, report, at("2026-03-02 12:00"), false);
        Transaction transaction(course_->database());
        std::vector<GivenMark> scores;
        for (const ReviewPair& pair : review_pairs(*course_, report)) {
            const int reviewer = std::stoi(pair.reviewer_name.substr(6));
            const std::int64_t version = enter_file(
                report, reviewer, "review", "review of " + pair.report_pseudonym() + " by " + pair.reviewer_name,
                "2026-03-05 12:00", pair.id);
            for (const Criterion& criterion : report.criteria) {
                GivenMark score;
                score.group = pair.author, score.pair = pair.id, score.version = version, score.item = criterion.name;
                score.points = reviewer == 1 ? 0 : static_cast<double>(4 + (reviewer + pair.author) % 2);
                scores.push_back(score);
            }
        }
        enter_marks(*course_, report, scores, at("2026-03-06 12:00"));
        transaction.commit();
        return report;
    }

    std::unique_ptr<PageProgram> page() const {
        return std::make_unique<PageProgram>(std::vector<std::string>{"course", "--course", folder(), "page"});
    }

  private:
    /// Within a transaction.
    std::int64_t enter_file(const Assignment& a, int i, const std::string& part, const std::string& text,
                            const std::string& time, std::optional<std::int64_t> pair = {}) {
        NewVersion version;
        version.hash = course_->keep(text);
        version.group = group_ids_[static_cast<std::size_t>(i)];
        version.group_name = group(i), version.part = part;
        version.stage = pair ? "review" : "first", version.pair = pair;
        version.name = part == "script" ? "analysis.lua" : part + ".pdf";
        version.bytes = std::ssize(text), version.at = at(time);
        course_->register_file(version.hash, version.bytes, version.at);
        return add_version(*course_, a, version, version.at).id;
    }

    int groups_;
    Workbench bench_;
    std::unique_ptr<Course> course_;
    std::vector<std::int64_t> group_ids_ = {0};  ///< by number
};

}  // namespace dynlab::test
