#include "course/review/score_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/reader.h"
#include "course/review/review_marks.h"
#include "course/store/assignments.h"
#include "course/store/newest_versions.h"
#include "data_io/text_table.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

constexpr char kInstructor[] = "instructor", kComment[] = "comment";

void refuse_other_than_talk(const Assignment& a) {
    if (a.is_report())
        throw InvalidArgument(
            "--sheet creates score sheets only for talks, but {} is a report. Its marks come from reviews", a.name);
    if (a.is_lab())
        throw InvalidArgument(
            "{} is a lab, so its checks determine the points. To change the points, use dynlab course mark", a.name);
}

/// Throws InvalidArgument for a group that cannot have scores for its report of this stage.
void refuse_without_report(Course& course, const Assignment& a, const Group& group, const std::string& stage) {
    if (newest_file(course, a, group.id, stage, "report") || newest_file(course, a, group.id, stage, "pack")) return;
    throw stage == "first"
        ? InvalidArgument("{} has submitted no first version of {}: no scores are needed", group.name, a.name)
        : InvalidArgument("{} has submitted no final version of {}: no scores are needed", group.name, a.name);
}

/// A table of scores on its way into the store.
class ScoreReader {
  public:
    ScoreReader(Course& course, const Assignment& a, const std::string& stage, const std::filesystem::path& file)
        : course_(course), a_(a), stage_(stage), file_(file), table_(read_text_table(file)) {
        const bool reviews = a.is_report() && stage == "first";
        check_columns(reviews       ? std::vector<std::string>{"reviewer"}
                      : a.is_talk() ? std::vector<std::string>{"group", "student"}
                                    : std::vector<std::string>{"group"},
                      reviews       ? std::set<std::string>{"report"}
                      : a.is_talk() ? std::set<std::string>{"name", kComment}
                                    : std::set<std::string>{});
        if (reviews) pairs_ = review_pairs(course, a);
    }

    int read(Instant now) {
        Transaction transaction(course_.database());
        OralComments said = oral_comments(course_, a_);
        int comments = 0;
        for (row_ = 0; row_ < table_.rows.size(); ++row_) {
            const GivenMark owner = owner_of_row();
            for (const Criterion& criterion : a_.criteria) read_cell(criterion, owner);
            if (const std::string comment = cell(kComment); a_.is_talk() && !comment.empty())
                comments += comment_on(owner, comment, said, now);
        }
        const int fresh = enter_marks(course_, a_, marks_, now) + comments;
        if (fresh > 0)
            course_.note(fmt::format("{}: {}", a_.name, message_text(plural(fresh, "{} score read", "{} scores read"))),
                         now);
        transaction.commit();
        return fresh;
    }

  private:
    void check_columns(const std::vector<std::string>& owners, std::set<std::string> others) const {
        const auto has = [&](const std::string& name) { return table_.column(name).has_value(); };
        if (std::ranges::none_of(owners, has))
            fail(1, Message("a column named {} is required; the columns are {}", listed(owners, Join::kOr),
                            listed(table_.names)));
        others.insert(owners.begin(), owners.end());
        std::vector<std::string> criteria, unknown;
        bool any = false;
        for (const Criterion& c : a_.criteria) {
            criteria.push_back(c.name);
            any = any || has(in_small_letters(c.name));
            others.insert(in_small_letters(c.name));
        }
        for (const std::string& name : table_.names)
            if (!others.contains(name)) unknown.push_back(name);
        const Message known = Message("the criteria of {} are {}", a_.name, listed(criteria));
        if (!unknown.empty()) fail(1, Message("unknown columns: {}; {}", listed(unknown), known));
        if (!any) fail(1, Message("no column has the name of a criterion; {}", known));
    }

    [[noreturn]] void fail(int line, const Message& what) const {
        throw EnvironmentError("{}, line {}: {}", file_.string(), line, what);
    }

    std::string cell(const std::string& name) const {
        const auto column = table_.column(name);
        return column ? table_.rows[row_][*column] : "";
    }

    void read_cell(const Criterion& criterion, GivenMark mark) {
        const std::string text = cell(in_small_letters(criterion.name));
        if (text.empty()) return;
        mark.item = criterion.name;
        if (text != "-") {
            mark.points = number_in_cell(text);
            if (!mark.points || !(*mark.points >= 0 && *mark.points <= criterion.max_points))
                fail(table_.lines[row_], Message("{} must be a number from 0 to {}, but \"{}\" was given",
                                                 criterion.name, criterion.max_points, text));
        }
        marks_.push_back(std::move(mark));
    }

    bool has_points() const {
        return std::ranges::any_of(a_.criteria, [this](const Criterion& criterion) {
            const std::string text = cell(in_small_letters(criterion.name));
            return !text.empty() && text != "-";
        });
    }

    /// What is wrong with the owner gets the place of the row.
    GivenMark owner_of_row() const {
        try {
            GivenMark owner = a_.is_talk() ? presenter() : stage_ == "final" ? author(cell("group")) : reviewed();
            owner.stage = stage_;
            return owner;
        } catch (const std::runtime_error& error) {
            fail(table_.lines[row_], message_of(error));
        } catch (const std::logic_error& error) {
            fail(table_.lines[row_], message_of(error));
        }
    }

    GivenMark of_group(const Group& group) const {
        if (has_points() && group.dropped_out)
            throw InvalidArgument("{} dropped out and cannot have scores; delete the scores in this row", group.name);
        GivenMark owner;
        owner.group = group.id;
        return owner;
    }

    GivenMark author(const std::string& name) const {
        const Group group = group_named(course_, name);
        GivenMark owner = of_group(group);
        if (has_points()) refuse_without_report(course_, a_, group, stage_);
        return owner;
    }

    GivenMark reviewed() const {
        const std::string report = cell("report");
        if (cell("reviewer") == kInstructor) {
            for (const ReviewPair& pair : pairs_)
                if (pair.report_pseudonym() == report) return author(pair.author_name);
            return author(report);
        }
        const ReviewPair pair = reviewed_pair(pairs_, group_named(course_, cell("reviewer")), report);
        if (has_points() && pair.withdrawn)
            throw InvalidArgument(
                "the review of {} by {} is withdrawn, so its scores do not count; to reinstate the review, run dynlab "
                "course restore",
                pair.report_pseudonym(), pair.reviewer_name);
        GivenMark owner;
        owner.group = pair.author, owner.pair = pair.id, owner.version = newest_review(course_, pair.id);
        return owner;
    }

    GivenMark presenter() const {
        const std::string name = cell("student"), group = cell("group");
        if (name.empty()) return of_group(group_named(course_, group));
        const Student student = student_named(course_, name);
        if (student.group.empty())
            throw InvalidArgument("the student {} is not in a group; enter the group in the roster", student.id);
        const Group own = group_named(course_, student.group);
        if (!group.empty() && group_named(course_, group).id != own.id)
            throw InvalidArgument("the student {} is in {}, not in {}; correct the group in this row", student.id,
                                  own.name, group);
        GivenMark owner = of_group(own);
        owner.student = student.id;
        return owner;
    }

    int comment_on(const GivenMark& owner, const std::string& comment, OralComments& said, Instant now) {
        std::string& before = owner.student.empty() ? said.groups[owner.group] : said.students[owner.student];
        if (before == comment) return 0;
        before = comment;
        course_.database().run(
            "INSERT INTO marks (assignment, group_id, student, item, reason, made_at) VALUES (?, ?, nullif(?, ''), ?, "
            "?, ?)",
            a_.id, owner.group, owner.student, kComment, comment, now);
        return 1;
    }

    Course& course_;
    const Assignment& a_;
    std::string stage_;
    std::filesystem::path file_;
    TextTable table_;
    std::vector<ReviewPair> pairs_;
    std::size_t row_ = 0;
    std::vector<GivenMark> marks_;
};

}  // namespace

int import_scores(Course& course, const Assignment& a, const std::string& stage, const std::filesystem::path& file,
                  Instant now) {
    if (!a.is_report()) refuse_other_than_talk(a);
    due_for(course, a, 0, stage);  // a talk has no final version
    return ScoreReader(course, a, stage, file).read(now);
}

void drop_scores(Course& course, const Assignment& a, const std::string& reviewer, const std::string& report,
                 const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    refuse_without_reviews(a);
    Transaction transaction(course.database());
    const std::vector<ReviewPair> pairs = review_pairs(course, a);
    GivenMark owner;
    if (reviewer == kInstructor) {
        const auto known = std::ranges::find(pairs, report, &ReviewPair::report_pseudonym);
        owner.group = group_named(course, known == pairs.end() ? report : known->author_name).id;
    } else {
        const ReviewPair pair = reviewed_pair(pairs, group_named(course, reviewer), report);
        owner.group = pair.author, owner.pair = pair.id;
    }
    std::vector<GivenMark> dropped;
    for (const GivenMark& mark : marks_in_force(course, a))
        if (mark.pair == owner.pair && mark.group == owner.group && mark.stage == "first" && mark.student.empty() &&
            std::ranges::find(a.criteria, mark.item, &Criterion::name) != a.criteria.end()) {
            dropped.push_back(mark);
            dropped.back().points.reset();
            dropped.back().reason = reason;
        }
    if (enter_marks(course, a, dropped, now) == 0)
        throw InvalidArgument("{} has given no scores for {}", reviewer, report);
    course.note(fmt::format("{}: the scores of {} for {} are withdrawn; reason: {}", a.name, reviewer, report, reason),
                now);
    transaction.commit();
}

OralComments oral_comments(Course& course, const Assignment& a) {
    OralComments said;
    for (Rows rows = course.database().query(
             "SELECT group_id, student, reason FROM marks WHERE assignment = ? AND item = ? ORDER BY id", a.id,
             kComment);
         rows.next();)
        (rows.isColumnNull(1) ? said.groups[rows.integer(0)] : said.students[rows.text(1)]) = rows.text(2);
    return said;
}

std::string oral_sheet(Course& course, const Assignment& a, const OralSheetOptions& options) {
    refuse_other_than_talk(a);
    TextTable table;
    table.names = {"group"};
    if (options.students) table.names.insert(table.names.end(), {"student", "name"});
    for (const Criterion& c : a.criteria) table.names.push_back(c.name);
    table.names.emplace_back(kComment);
    std::vector<Group> groups = groups_of(course);
    const auto lot = [&](const Group& group) {
        return hmac_sha256(course.key(), {"dynlab oral order\n", a.name, "\n", group.name});
    };
    if (options.drawn) std::ranges::sort(groups, [&](const Group& x, const Group& y) { return lot(x) < lot(y); });
    std::map<std::string, std::string> names;
    for (const Student& student : students_of(course)) names[student.id] = student.name;
    GivenPoints given = points_by_owner(a, marks_in_force(course, a));
    OralComments said = oral_comments(course, a);
    const auto add = [&](std::vector<std::string> row, CriterionPoints points, const std::string& comment) {
        points.resize(a.criteria.size());
        for (const auto& p : points) row.push_back(p ? fmt::format("{}", *p) : "");
        row.push_back(comment);
        table.rows.push_back(std::move(row));
    };
    for (const Group& group : groups) {
        if (group.dropped_out) continue;
        std::vector<std::string> row = {group.name};
        if (options.students) row.resize(3);
        add(row, given.groups[group.id], said.groups[group.id]);
        if (!options.students) continue;
        for (const std::string& id : group.members)
            add({group.name, id, names[id]}, given.students[id], said.students[id]);
    }
    return csv_text(table);
}

}  // namespace dynlab::inline course
