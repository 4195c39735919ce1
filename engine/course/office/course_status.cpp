#include "course/office/course_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/reader.h"
#include "course/grading/manual_marks.h"
#include "course/office/course_grading.h"
#include "course/office/marks_join.h"
#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/inspection.h"
#include "course/store/marks.h"
#include "course/store/newest_versions.h"
#include "platform/terminal/aligned_table.h"

namespace dynlab::inline course {
namespace {

std::string when(const CourseClock& clock, Instant due, Instant now) {
    const std::string distance = duration_text(std::abs(due - now));
    return fmt::format("{} ({})", clock.show(due), due >= now ? "in " + distance : distance + " ago");
}

/// "v2", "v1 late 2 h 5 min", "v2 (v1 in time)", "v1, 3 rules broken", "v1 damaged", "-".
std::string cell_of(const SubmittedParts& parts, const std::string& main) {
    const auto found = parts.find(main);
    if (const auto unread = parts.find(kUnreadable); found == parts.end() && unread != parts.end())
        return fmt::format("came, cannot be read ({})", unread->second.error_reason);
    if (found == parts.end()) return parts.empty() ? "-" : fmt::format("only the {}", parts.begin()->first);
    const SubmittedFile& h = found->second;
    std::string cell = fmt::format("v{}", h.version);
    if (h.late > 0 && h.in_time > 0)
        cell += fmt::format(" (v{} on time)", h.in_time);
    else if (h.late > 0)
        cell += " late " + duration_text(h.late);
    if (!h.error_reason.empty())
        cell += " " + h.error_reason;
    else if (h.rules_broken > 0)
        cell += ", " + message_text(plural(h.rules_broken, "{} rule violated", "{} rules violated"));
    return cell;
}

/// By group: other groups that submitted a file with the same bytes.
std::map<std::int64_t, std::vector<std::string>> groups_with_the_same_file(Course& course,
                                                                           const Assignment& assignment) {
    std::map<std::int64_t, std::vector<std::string>> twins;
    for (Rows rows = course.database().query(
             "SELECT DISTINCT v.group_id, g.name FROM versions v JOIN versions w ON w.hash = v.hash AND w.assignment = "
             "v.assignment AND w.group_id <> v.group_id JOIN groups g ON g.id = w.group_id WHERE v.assignment = ? AND "
             "v.stage <> 'review' AND w.stage <> 'review' AND EXISTS (SELECT 1 FROM standing s WHERE s.id = v.id) AND "
             "EXISTS (SELECT 1 FROM standing s WHERE s.id = w.id) ORDER BY 1, 2",
             assignment.id);
         rows.next();)
        twins[rows.integer(0)].push_back(rows.text(1));
    return twins;
}

/// "group-01 and group-02"; of many the first two and how many others.
std::string shortened(std::vector<std::string> names) {
    constexpr std::size_t kMax = 3;
    if (names.size() > kMax) {
        names[2] = fmt::format("{} others", names.size() - 2);
        names.resize(kMax);
    }
    return fmt::format("{}", fmt::join(names, " and "));
}

class Status {
  public:
    Status(Course& course, const Assignment& assignment, Instant now)
        : course_(course),
          assignment_(assignment),
          now_(now),
          main_(assignment.document()),
          versions_(newest_versions(course, assignment)),
          pairs_(review_pairs(course, assignment)),
          twins_(groups_with_the_same_file(course, assignment)),
          labs_(assignment.is_lab() ? lab_marks(course, assignment) : std::vector<LabMark>()) {
        for (const auto& pair : kindred_groups(course)) kindred_.insert(pair);
    }

    AssignmentState state() {
        for (const Group& group : groups_of(course_)) add(group);
        return {std::move(states_), present_, late_, unreadable_, missing_, next_step()};
    }

    std::string text() {
        for (const Group& group : groups_of(course_)) add(group);
        std::string text = heading() + '\n' + aligned_table(header(), rows_) + '\n' + sums();
        const std::string next = next_step();
        return text + not_taken() + (next.empty() ? "" : "Next: " + next + '\n');
    }

  private:
    /// Files that were not taken and after which nothing came that was.
    std::string not_taken() const {
        std::string text;
        for (const FileNotTaken& file : files_not_taken(course_, assignment_))
            text += message_text(Message("Not accepted: {}, {}: {}", file.name, course_.clock().show(file.received_at),
                                         file.reason)) +
                    "\n";
        return text;
    }

    std::vector<std::string> header() const {
        if (assignment_.is_lab()) return {"group", "members", "submission", "points", "to do"};
        if (!assignment_.is_report()) return {"group", "members", "slides", "script", "to do"};
        return {"group", "members", "first version", "reviews written", "reviews received", "final version", "to do"};
    }

    std::string heading() const {
        const auto& clock = course_.clock();
        std::string text = fmt::format(
            "{}: {}{}, {}\n", assignment_.name, assignment_.kind,
            assignment_.lesson.empty() ? "" : " of lesson " + assignment_.lesson,
            assignment_.grace > 0 ? duration_text(assignment_.grace) + " of grace" : std::string("no grace"));
        const auto line = [&](const char* what, Instant due) {
            text += fmt::format("  {:<14} {}\n", what, when(clock, due, now_));
        };
        if (assignment_.first_due != kNoDeadline)
            line(assignment_.is_report() ? "first version"
                 : assignment_.is_lab()  ? "deadline"
                                         : "slides, script",
                 assignment_.first_due);
        if (assignment_.review_due) line("reviews", *assignment_.review_due);
        if (assignment_.final_due) line("final version", *assignment_.final_due);
        for (Rows rows = course_.database().query(
                 "SELECT g.name, e.stage, e.due_at FROM extensions e JOIN groups g ON g.id = e.group_id WHERE "
                 "e.assignment = ? AND e.due_at IS NOT NULL AND e.id = (SELECT max(n.id) FROM extensions n WHERE "
                 "n.assignment = e.assignment AND n.group_id = e.group_id AND n.stage = e.stage) ORDER BY 1, 2",
                 assignment_.id);
             rows.next();)
            text += fmt::format("  extended       {}, {}: {}\n", rows.text(0),
                                rows.text(1) == "first"    ? "first version"
                                : rows.text(1) == "review" ? "reviews"
                                                           : "final version",
                                when(clock, rows.integer(2), now_));
        return text + fmt::format("  times in {}\n", clock.zone());
    }

    void add(const Group& group) {
        const auto& stages = versions_[group.id];
        const auto parts = [&](const char* stage) {
            const auto found = stages.find(stage);
            return found == stages.end() ? SubmittedParts() : found->second;
        };
        const SubmittedParts first = parts("first"), last = parts("final");
        if (group.dropped_out && first.empty() && last.empty()) return;
        ++groups_;
        const std::vector<ToDo> things = to_do(group, first, last);
        states_.push_back({group, first, last, things});
        const std::string members = fmt::format("{}", group.members.size());
        if (assignment_.is_lab()) {
            const auto mark = std::ranges::find(labs_, group.id, &LabMark::group);
            const bool known = mark != labs_.end() && mark->earned;
            rows_.push_back({group.name, members, cell_of(first, main_),
                             known ? fmt::format("{:.4g} of {:.4g}", *mark->earned, mark->possible) : "-",
                             text_of(things)});
            count(group, first, last);
            return;
        }
        if (!assignment_.is_report()) {
            const std::string script =
                first.contains("pack") ? cell_of(first, "pack") + " (pack)" : cell_of(first, "script");
            rows_.push_back({group.name, members, first.contains("slides") ? cell_of(first, "slides") : "-",
                             first.contains("script") || first.contains("pack") ? script : "-", text_of(things)});
            count(group, first, last);
            return;
        }
        int to_write = 0, written = 0, late = 0, to_get = 0, got = 0, voluntary = 0;
        for (const ReviewPair& pair : pairs_) {
            voluntary += pair.reviewer == group.id && pair.voluntary();
            if (pair.ended) continue;
            if (pair.reviewer == group.id) ++to_write, written += pair.written, late += pair.late > 0;
            if (pair.author == group.id) ++to_get, got += pair.written;
        }
        const auto share = [](int part, int whole) {
            return whole == 0 ? std::string("-") : fmt::format("{} of {}", part, whole);
        };
        open_reviews_ += group.dropped_out ? 0 : to_write - written;
        rows_.push_back({group.name, members, cell_of(first, main_),
                         share(written, to_write) + (late > 0 ? fmt::format(", {} late", late) : "") +
                             (voluntary > 0 ? fmt::format(", {} voluntary", voluntary) : ""),
                         share(got, to_get), cell_of(last, main_), text_of(things)});
        count(group, first, last);
    }

    void count(const Group& group, const SubmittedParts& first, const SubmittedParts& last) {
        if (group.dropped_out) return;
        const auto found = first.find(main_);
        if (found == first.end()) {
            ++(first.contains(kUnreadable) ? unreadable_ : missing_);
        } else {
            ++present_;
            if (found->second.is_late()) ++late_;
            if (!found->second.error_reason.empty()) ++unreadable_;
            unassigned_ += !in_allocation(group.id);
        }
        finals_ += last.contains(main_);
    }

    /// Of those that are not taken back.
    template <class Condition>
    bool any_pair(const Condition& fits) const {
        return std::any_of(pairs_.begin(), pairs_.end(), [&](const ReviewPair& p) { return !p.ended && fits(p); });
    }
    bool in_allocation(std::int64_t group) const {
        return any_pair([group](const ReviewPair& p) { return p.reviewer == group || p.author == group; });
    }

    /// What the instructor may want to do about this group.
    std::vector<ToDo> to_do(const Group& group, const SubmittedParts& first, const SubmittedParts& last) const {
        if (group.dropped_out) return {{"dropped", "", "", "dropped out"}};
        std::vector<ToDo> things;
        const auto due_over = [&](const char* stage) {
            const bool given = assignment_.is_report() || std::string_view(stage) == "first";
            return given && now_ > due_for(course_, assignment_, group.id, stage) + assignment_.grace;
        };
        const auto found = first.find(main_);
        const auto only_pack = [&](const SubmittedParts& parts, const char* stage, const char* of) {
            if (parts.contains("pack") && !parts.contains(main_))
                things.push_back(
                    {"no-pdf", stage, "", fmt::format("the pack contains no PDF{}: ask the group for this file", of)});
        };
        const auto ask_for_readable = [&](const char* stage, const std::string& error_reason) {
            const char* const what = std::string_view(stage) == "final" ? "final version"
                                     : assignment_.is_report()          ? "first version"
                                                                        : "file";
            things.push_back(
                {"unreadable", stage, error_reason, fmt::format("ask for a readable {} ({})", what, error_reason)});
        };
        const auto unread = [&](const SubmittedParts& parts, const char* stage) {
            const auto there = parts.find(kUnreadable), readable = parts.find(main_);
            if (there != parts.end() &&
                (readable == parts.end() || readable->second.received_at < there->second.received_at))
                ask_for_readable(stage, there->second.error_reason);
        };
        unread(first, "first");
        unread(last, "final");
        if (found == first.end()) {
            only_pack(first, "first", "");
            if (things.empty() && due_over("first"))
                things.push_back({"missing", "first", "",
                                  assignment_.is_lab()      ? "ask for the submission, or drop"
                                  : assignment_.is_report() ? "ask for the first version, or drop"
                                                            : "ask for the slides, or drop"});
            return things;
        }
        if (assignment_.is_talk()) {
            if (!first.contains("script") && !first.contains("pack") && due_over("first"))
                things.push_back({"missing-script", "first", "", "ask for the script"});
        }
        const auto readable = [&](const SubmittedParts& parts, const char* stage) {
            const auto there = parts.find(main_);
            if (there != parts.end() && !there->second.error_reason.empty())
                ask_for_readable(stage, there->second.error_reason);
        };
        readable(first, "first");
        readable(last, "final");
        const auto id = group.id;
        if (const auto twin = twins_.find(id); twin != twins_.end())
            things.push_back({"same-file", "first", shortened(twin->second),
                              fmt::format("submitted the same file as {}", shortened(twin->second))});
        if (any_pair([&](const ReviewPair& p) {
                return p.reviewer == id &&
                       kindred_.contains(std::pair(std::min(p.reviewer, p.author), std::max(p.reviewer, p.author)));
            }))
            things.push_back(
                {"kin", "review", "", "reviews a report by a current or former group member: review assign"});
        if (is_held(course_, assignment_, id, {})) things.push_back({"held", "first", "", "its report is withheld"});
        if (any_pair([id](const ReviewPair& p) { return p.author == id && p.newer_report; }) &&
            !is_held(course_, assignment_, id, {}))
            things.push_back({"newer-report", "first", "", "a newer version than was sent: review send"});
        if (any_pair([&](const ReviewPair& p) {
                return p.reviewer == id && p.newer_review && !is_held(course_, assignment_, id, p.id);
            }))
            things.push_back({"newer-review", "review", "", "a newer review than was released: review release"});
        if (any_pair([&](const ReviewPair& p) { return p.reviewer == id && is_held(course_, assignment_, id, p.id); }))
            things.push_back({"held", "review", "", "a review by it is withheld"});
        if (any_pair([](const ReviewPair& p) { return p.sent; }) &&
            any_pair([id](const ReviewPair& p) { return p.author == id && !p.sent && !p.written; }) &&
            !is_held(course_, assignment_, id, {}))
            things.push_back(any_pair([id](const ReviewPair& p) { return p.author == id && p.stopped_report; })
                                 ? ToDo{"stopped", "first", "", "its copy was not sent: see review send"}
                                 : ToDo{"unsent", "first", "", "its report is not sent yet: review send"});
        const auto unreleased = [&](const ReviewPair& p) {
            return p.reviewer == id && p.written && !p.released && !is_held(course_, assignment_, id, p.id);
        };
        if (any_pair([](const ReviewPair& p) { return p.released; }) && any_pair(unreleased))
            things.push_back(
                any_pair([&](const ReviewPair& p) { return unreleased(p) && p.stopped_review; })
                    ? ToDo{"stopped", "review", "", "a review by it was not released: see review release"}
                    : ToDo{"unreleased", "review", "", "a review by it is not released yet: review release"});
        if (!pairs_.empty() && !in_allocation(group.id))
            things.push_back({"unassigned", "first", "", "arrived after the allocation: review assign"});
        int open = 0;
        for (const ReviewPair& pair : pairs_) {
            if (pair.reviewer != group.id || pair.ended || pair.written) continue;
            if (pair.only_pack)
                things.push_back(
                    {"no-pdf", "review", pair.report_pseudonym(),
                     fmt::format("the pack contains no PDF with its review of {}: ask the group for this file",
                                 pair.report_pseudonym())});
            else
                ++open;
        }
        if (open > 0 && due_over("review"))
            things.push_back(
                {"missing", "review", std::to_string(open),
                 message_text(plural(open, "send a reminder about {} review", "send a reminder about {} reviews"))});
        only_pack(last, "final", " of the final version");
        if (last.empty() && due_over("final")) things.push_back({"missing", "final", "", "ask for the final version"});
        return things;
    }

    static std::string text_of(const std::vector<ToDo>& things) {
        std::vector<std::string> texts;
        for (const ToDo& thing : things) texts.push_back(thing.text);
        return fmt::format("{}", fmt::join(texts, "; "));
    }

    std::string sums() const {
        MessageList counts{{plural(groups_, "{} group: {} submitted", "{} groups: {} submitted", present_)}};
        if (late_ > 0) counts.items.push_back(Message("{} late", late_));
        if (unreadable_ > 0) counts.items.push_back(Message("{} unreadable", unreadable_));
        if (missing_ > 0) counts.items.push_back(Message("{} missing", missing_));
        const Message sums = assignment_.is_report() && !pairs_.empty()
                                 ? Message("{}; {}; {}.", counts,
                                           plural(open_reviews_, "{} review outstanding", "{} reviews outstanding"),
                                           plural(finals_, "{} final version", "{} final versions"))
                                 : Message("{}.", counts);
        return message_text(sums) + "\n";
    }

    /// Grading is due for files without a result, and for marks that the feedback does not show yet.
    std::string next_for_lab(const std::string& grade) const {
        Rows open = course_.database().query(
            "SELECT EXISTS (SELECT 1 FROM standing s WHERE s.assignment = ?1 AND s.stage = 'first' AND s.part IN "
            "('script', 'pack') AND NOT EXISTS (SELECT 1 FROM results r WHERE r.version = s.id)), (SELECT "
            "ifnull(max(id), 0) FROM marks WHERE assignment = ?1)",
            assignment_.id);
        open.next();
        if (open.integer(0) != 0 || open.integer(1) > newest_joined_mark(course_, assignment_).value_or(0))
            return grade;
        const std::string results = std::filesystem::proximate(results_folder(course_, assignment_)).string();
        if (std::ranges::any_of(labs_, [](const LabMark& mark) { return mark.by_checks && !mark.earned; }))
            return fmt::format("enter the missing marks in {}/{}, then {}", results, kMarksFile, grade);
        return fmt::format("dynlab export-grades {}", results);
    }

    std::string next_step() const {
        const auto command = [&](const char* words) {
            return fmt::format("dynlab course {} {}", words, assignment_.name);
        };
        if (present_ == 0) return fmt::format("dynlab course submit FILE... --assignment {}", assignment_.name);
        if (assignment_.is_lab()) return next_for_lab(command("grade"));
        if (!assignment_.is_report()) return command("scores --sheet");
        if (now_ <= assignment_.first_due + assignment_.grace) return {};
        if (pairs_.empty() || unassigned_ > 0) return command("review assign");
        if (any_pair([this](const ReviewPair& p) {
                return ((!p.sent && !p.written) || p.newer_report) && !p.stopped_report &&
                       !is_held(course_, assignment_, p.author, {});
            }))
            return command("review send");
        if (any_pair([this](const ReviewPair& p) {
                return ((p.written && !p.released) || p.newer_review) && !p.stopped_review &&
                       !is_held(course_, assignment_, p.reviewer, p.id);
            }) &&
            now_ > *assignment_.review_due + assignment_.grace)
            return command("review release");
        const bool released = any_pair([](const ReviewPair& p) { return p.released; });
        if (!released)
            return fmt::format("wait for reviews, dynlab course review collect FILE... --assignment {}",
                               assignment_.name);
        if (now_ > *assignment_.final_due)
            return (finals_ > 0 ? command("changes --assignment") + ", then " : "") + command("export");
        return command("scores") + " FILE.csv, then " + command("marks");
    }

    Course& course_;
    const Assignment& assignment_;
    Instant now_;
    std::string main_;
    std::map<std::int64_t, std::map<std::string, SubmittedParts>> versions_;
    std::vector<ReviewPair> pairs_;
    std::map<std::int64_t, std::vector<std::string>> twins_;
    std::vector<LabMark> labs_;
    std::set<std::pair<std::int64_t, std::int64_t>> kindred_;  ///< groups with a common member, now or before
    std::vector<std::vector<std::string>> rows_;
    std::vector<GroupState> states_;
    int groups_ = 0, present_ = 0, late_ = 0, unreadable_ = 0, missing_ = 0, unassigned_ = 0, open_reviews_ = 0,
        finals_ = 0;
};

}  // namespace

AssignmentState assignment_state(Course& course, const Assignment& assignment, Instant now) {
    return Status(course, assignment, now).state();
}

std::string assignment_status(Course& course, const Assignment& assignment, Instant now) {
    return Status(course, assignment, now).text();
}

std::string course_summary(Course& course, Instant now) {
    int active = 0, dropped_out = 0;
    for (const Group& group : groups_of(course)) ++(group.dropped_out ? dropped_out : active);
    const Message groups = plural(active, "{} group", "{} groups");
    std::string text =
        message_text(dropped_out > 0 ? Message("{}: {}, {} dropped out", course.name(), groups, dropped_out)
                                     : Message("{}: {}", course.name(), groups)) +
        "\n";
    std::vector<std::vector<std::string>> rows;
    for (const Assignment& a : assignments_of(course)) {
        const auto shown = [&](std::optional<Instant> due) {
            return due && *due != kNoDeadline ? when(course.clock(), *due, now) : "-";
        };
        rows.push_back({a.name, a.kind, shown(a.first_due), shown(a.review_due), shown(a.final_due)});
    }
    if (rows.empty()) return text + "No assignments yet: dynlab course assignment NAME --first TIME ...\n";
    return text + aligned_table({"assignment", "kind", "first version", "reviews", "final version"}, rows);
}

}  // namespace dynlab::inline course
