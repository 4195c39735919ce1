#include "course/store/assignments.h"

#include <fmt/format.h>

#include <set>

#include "course/intake/lateness.h"
#include "course/store/exceptions.h"
#include "numerics/error.h"
#include "platform/spelling.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

void refuse_odd_name(const std::string& what, const std::string& name) {
    const bool odd = name.empty() || name.size() > 60 || name.front() == '.' || name.front() == '-' ||
                     name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.") !=
                         std::string::npos;
    if (odd)
        throw InvalidArgument("{} \"{}\" must be a short word of letters, digits, - _ and . such as crane-report", what,
                              name);
}

void refuse_bad_deadlines(const Assignment& a, const CourseClock& clock) {
    if (!a.is_report()) {
        if (a.review_due || a.final_due)
            throw a.is_talk() ? InvalidArgument("a talk has one deadline: leave --review and --final out")
                              : InvalidArgument("a lab has one deadline: leave --review and --final out");
        if (a.is_talk() && a.first_due == kNoDeadline) throw InvalidArgument("a talk needs a deadline: --first");
        return;
    }
    if (!a.review_due || !a.final_due || a.first_due == kNoDeadline)
        throw InvalidArgument("a report needs three deadlines: --first, --review and --final");
    const auto in_order = [&](Instant before, Instant after, const char* first, const char* second) {
        if (before < after) return;
        throw InvalidArgument("the deadline of the {} ({}) must come after that of the {} ({})", second,
                              clock.show(after), first, clock.show(before));
    };
    in_order(a.first_due, *a.review_due, "first version", "reviews");
    in_order(*a.review_due, *a.final_due, "reviews", "final version");
    if (a.reviews < 1) throw InvalidArgument("each group must write at least one review: --reviews 1");
}

constexpr std::pair<const char*, double Costs::*> kCosts[] = {{"late-day", &Costs::late_day},
                                                              {"late-most", &Costs::late_most},
                                                              {"missing-final", &Costs::missing_final},
                                                              {"late-review", &Costs::late_review},
                                                              {"missing-review", &Costs::missing_review}};

std::string costs_text(const Costs& costs) {
    std::vector<std::string> items;
    for (const auto& [name, cost] : kCosts)
        if (costs.*cost != Costs().*cost) items.push_back(fmt::format("{}:{}", name, costs.*cost));
    return fmt::format("{}", fmt::join(items, ","));
}

bool same(const Assignment& a, const Assignment& b) {
    const auto words = [](const Assignment& x) {
        std::string all =
            fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", x.kind, x.lesson, x.first_due,
                        x.review_due.value_or(0), x.final_due.value_or(0), x.grace, x.reviews, costs_text(x.costs),
                        x.final_weight, x.weight, x.reviews_weight, x.checks, x.secret, x.keep);
        for (const Criterion& c : x.criteria) all += fmt::format("|{}:{}", c.name, c.most);
        return all;
    };
    return words(a) == words(b);
}

/// Whether `b` only gives more time than `a`.
bool only_later(Assignment a, const Assignment& b) {
    const bool later = b.first_due >= a.first_due && b.review_due.value_or(0) >= a.review_due.value_or(0) &&
                       b.final_due.value_or(0) >= a.final_due.value_or(0) && b.grace >= a.grace;
    a.first_due = b.first_due, a.review_due = b.review_due, a.final_due = b.final_due, a.grace = b.grace;
    return later && same(a, b);
}

void write_criteria(Database& db, const Assignment& assignment) {
    int position = 0;
    for (const Criterion& c : assignment.criteria)
        db.run(
            "INSERT INTO criteria VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE SET name = excluded.name, most = "
            "excluded.most",
            assignment.id, position++, c.name, c.most);
    db.run("DELETE FROM criteria WHERE assignment = ? AND place >= ?", assignment.id, position);
}

/// "a:5, b" as {a, 5}, {b, ""}.
std::vector<std::pair<std::string, std::string>> named_numbers(const std::string& text) {
    std::vector<std::pair<std::string, std::string>> items;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        std::string item = text.substr(at, end - at);
        std::erase(item, ' ');
        at = end + 1;
        const auto colon = item.find(':');
        items.emplace_back(item.substr(0, colon), colon == std::string::npos ? "" : item.substr(colon + 1));
    }
    return items;
}

}  // namespace

bool add_assignment(Course& course, Assignment wanted) {
    refuse_odd_name("the assignment's name", wanted.name);
    refuse_bad_deadlines(wanted, course.clock());
    Database& db = course.database();
    Transaction transaction(db);
    for (const Assignment& known : assignments_of(course)) {
        if (::strcasecmp(known.name.c_str(), wanted.name.c_str()) != 0) continue;
        if (same(known, wanted)) return false;
        const bool used = db.query("SELECT 1 FROM versions WHERE assignment = ?", known.id).next();
        if (used && !only_later(known, wanted))
            throw InvalidArgument(
                "work was submitted for {} already: only deadlines may move, to later ones, and the grace grow; give "
                "--reason to change more",
                known.name);
        db.run(
            "UPDATE assignments SET kind = ?, lesson = ?, first_due = ?, review_due = ?, final_due = ?, grace = ?, "
            "reviews = ?, costs = ?, final_weight = ?, weight = ?, reviews_weight = ?, checks = ?, secret = ?, keep = "
            "? WHERE id = ?",
            wanted.kind, wanted.lesson, wanted.first_due, wanted.review_due, wanted.final_due, wanted.grace,
            wanted.reviews, costs_text(wanted.costs), wanted.final_weight, wanted.weight, wanted.reviews_weight,
            wanted.checks, wanted.secret, wanted.keep, known.id);
        wanted.id = known.id;
        write_criteria(db, wanted);
        course.note(fmt::format("assignment {} changed", known.name));
        transaction.commit();
        return true;
    }
    db.run(
        "INSERT INTO assignments (name, kind, lesson, first_due, review_due, final_due, grace, reviews, made_at, "
        "costs, final_weight, weight, reviews_weight, checks, secret, keep) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
        "?, "
        "?, ?, ?, ?)",
        wanted.name, wanted.kind, wanted.lesson, wanted.first_due, wanted.review_due, wanted.final_due, wanted.grace,
        wanted.is_report() ? wanted.reviews : 0, CourseClock::now(), costs_text(wanted.costs), wanted.final_weight,
        wanted.weight, wanted.reviews_weight, wanted.checks, wanted.secret, wanted.keep);
    wanted.id = db.getLastInsertRowid();
    write_criteria(db, wanted);
    course.note(fmt::format("assignment {} added", wanted.name));
    transaction.commit();
    return true;
}

bool change_assignment(Course& course, const Assignment& wanted, const std::string& reason) {
    refuse_without_reason(reason);
    refuse_bad_deadlines(wanted, course.clock());
    Transaction transaction(course.database());
    const Assignment known = assignment_named(course, wanted.name);
    std::vector<std::string> changes;
    const auto compare = [&changes](const char* what, const std::string& before, const std::string& now) {
        if (before != now) changes.push_back(fmt::format("{} {} instead of {}", what, now, before));
    };
    const auto time = [&course](std::optional<Instant> due) {
        return due && *due != kNoDeadline ? course.clock().show_exactly(*due) : std::string("none");
    };
    const auto named = [](const std::string& text) { return text.empty() ? std::string("none") : text; };
    compare("lesson", named(known.lesson), named(wanted.lesson));
    compare("first", time(known.first_due), time(wanted.first_due));
    compare("review", time(known.review_due), time(wanted.review_due));
    compare("final", time(known.final_due), time(wanted.final_due));
    compare("grace", duration_text(known.grace), duration_text(wanted.grace));
    compare("costs", named(costs_text(known.costs)), named(costs_text(wanted.costs)));
    compare("final weight", fmt::format("{}", known.final_weight), fmt::format("{}", wanted.final_weight));
    const auto number = [](double value) { return fmt::format("{}", value); };
    compare("weight", number(known.weight), number(wanted.weight));
    compare("reviews weight", number(known.reviews_weight), number(wanted.reviews_weight));
    compare("checks", named(known.checks), named(wanted.checks));
    compare("secret", named(known.secret), named(wanted.secret));
    compare("keep", known.keep, wanted.keep);
    if (changes.empty()) return false;
    course.database().run(
        "UPDATE assignments SET lesson = ?, first_due = ?, review_due = ?, final_due = ?, grace = ?, costs = ?, "
        "final_weight = ?, weight = ?, reviews_weight = ?, checks = ?, secret = ?, keep = ? WHERE id = ?",
        wanted.lesson, wanted.first_due, wanted.review_due, wanted.final_due, wanted.grace, costs_text(wanted.costs),
        wanted.final_weight, wanted.weight, wanted.reviews_weight, wanted.checks, wanted.secret, wanted.keep, known.id);
    course.note(fmt::format("assignment {} changed: {}; reason: {}", known.name, fmt::join(changes, ", "), reason));
    transaction.commit();
    return true;
}

void remove_assignment(Course& course, const Assignment& assignment, const std::string& reason) {
    refuse_without_reason(reason);
    Database& db = course.database();
    Transaction transaction(db);
    for (const char* table : {"versions", "pairs", "oral_scores", "student_scores", "oral_comments",
                              "instructor_scores", "overrides", "extensions", "marks"})
        if (db.query(fmt::format("SELECT 1 FROM {} WHERE assignment = ?", table), assignment.id).next())
            throw InvalidArgument("{} cannot be removed: something hangs on it (its {}); nothing was changed",
                                  assignment.name, table);
    for (const char* table : {"criteria", "pair_wishes", "holds", "pseudonyms", "allocations", "refusals"})
        db.run(fmt::format("DELETE FROM {} WHERE assignment = ?", table), assignment.id);
    db.run("DELETE FROM assignments WHERE id = ?", assignment.id);
    course.note(
        fmt::format("assignment {} removed, before anything was handed in; reason: {}", assignment.name, reason));
    transaction.commit();
}

std::vector<Assignment> assignments_of(Course& course) {
    std::vector<Assignment> all;
    for (Rows rows = course.database().query(
             "SELECT id, name, kind, lesson, first_due, review_due, final_due, grace, reviews, costs, "
             "final_weight, weight, reviews_weight, checks, secret, keep FROM assignments ORDER BY first_due, name");
         rows.next();) {
        Assignment a;
        a.id = rows.integer(0), a.name = rows.text(1), a.kind = rows.text(2), a.lesson = rows.text(3);
        a.first_due = rows.integer(4), a.review_due = rows.optional_integer(5), a.final_due = rows.optional_integer(6);
        a.grace = rows.integer(7), a.reviews = static_cast<int>(rows.integer(8));
        a.costs = costs_of(rows.text(9)), a.final_weight = rows.number(10);
        a.weight = rows.number(11), a.reviews_weight = rows.number(12);
        a.checks = rows.text(13), a.secret = rows.text(14), a.keep = rows.text(15);
        for (Rows criteria =
                 course.database().query("SELECT name, most FROM criteria WHERE assignment = ? ORDER BY place", a.id);
             criteria.next();)
            a.criteria.push_back({criteria.text(0), criteria.number(1)});
        all.push_back(std::move(a));
    }
    return all;
}

Assignment assignment_named(Course& course, const std::string& name) {
    const std::vector<Assignment> all = assignments_of(course);
    if (all.empty()) throw InvalidArgument("the course has no assignments yet; add one with dynlab course assignment");
    if (name.empty() && all.size() == 1) return all.front();
    std::vector<std::string> names;
    for (const Assignment& assignment : all) {
        if (::strcasecmp(assignment.name.c_str(), name.c_str()) == 0) return assignment;
        names.push_back(assignment.name);
    }
    if (name.empty()) throw InvalidArgument("say which assignment: {}", listed(names));
    const auto near = nearest_word(name, names);
    const MessageList known = listed(names);
    if (names.size() == 1)
        throw near ? InvalidArgument("there is no assignment \"{}\"; there is {}; did you mean {}?", name, known, *near)
                   : InvalidArgument("there is no assignment \"{}\"; there is {}", name, known);
    throw near ? InvalidArgument("there is no assignment \"{}\"; there are {}; did you mean {}?", name, known, *near)
               : InvalidArgument("there is no assignment \"{}\"; there are {}", name, known);
}

void refuse_without_reviews(const Assignment& assignment) {
    if (assignment.is_talk()) throw InvalidArgument("{} is a talk: it has no reviews", assignment.name);
    if (assignment.is_lab()) throw InvalidArgument("{} is a lab: it has no reviews", assignment.name);
}

std::vector<Criterion> criteria_of(const std::string& text) {
    std::vector<Criterion> criteria;
    std::set<std::string> seen;
    for (const auto& [name, points] : named_numbers(text)) {
        refuse_odd_name("the criterion", name);
        const std::optional<double> given = points.empty() ? 5.0 : read_number<double>(points);
        if (!given || !(*given > 0 && *given <= 1000))
            throw InvalidArgument("the points of criterion {} must be a number from 0 to 1000, but \"{}\" was given",
                                  name, points);
        const double most = *given;
        if (!seen.insert(name).second) throw InvalidArgument("the criterion {} occurs twice", name);
        criteria.push_back({name, most});
    }
    if (criteria.empty()) throw InvalidArgument("give at least one criterion, such as clarity:5,methods:10");
    return criteria;
}

std::vector<Criterion> usual_criteria(const std::string& kind) {
    if (kind == "lab") return {};
    return criteria_of(kind == "talk" ? "content:5,slides:5,delivery:5,answers:5"
                                      : "data:5,steps:5,conclusions:5,strength:5,suggestions:5");
}

Costs costs_of(const std::string& text) {
    Costs costs;
    for (const auto& [name, points] : named_numbers(text)) {
        const auto is_named = [&wanted = name](const auto& cost) { return cost.first == wanted; };
        const auto known = std::find_if(std::begin(kCosts), std::end(kCosts), is_named);
        const auto value = read_number<double>(points);
        if (known == std::end(kCosts) || !value || !(*value >= 0 && *value <= 100))
            throw InvalidArgument(
                "costs are late-day, late-most, missing-final, late-review and missing-review with percent points from "
                "0 to 100, "
                "such as late-day:10,missing-review:25, but \"{}:{}\" was given",
                name, points);
        costs.*(known->second) = *value;
    }
    return costs;
}

double late_percent(const Costs& costs, std::int64_t late) {
    return late_percent(costs.late_day, costs.late_most, late);
}

}  // namespace dynlab::inline course
