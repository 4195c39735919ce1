#include "course/store/assignments.h"

#include <fmt/format.h>
#include <set>

#include "course/intake/lateness.h"
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
        throw InvalidArgument(
            "{} \"{}\" must consist of at most 60 letters, digits, hyphens, underscores and periods. The first "
            "character must be a letter, a digit or an underscore, as in crane-report",
            what, name);
}

void refuse_bad_deadlines(const Assignment& a, const CourseClock& clock) {
    if (!a.is_report()) {
        if (a.review_due || a.final_due)
            throw a.is_talk() ? InvalidArgument("a talk has one deadline: omit --review and --final")
                              : InvalidArgument("a lab has one deadline: omit --review and --final");
        if (a.is_talk() && a.first_due == kNoDeadline) throw InvalidArgument("a talk needs a deadline: give --first");
        return;
    }
    if (!a.review_due || !a.final_due || a.first_due == kNoDeadline)
        throw InvalidArgument("a report needs three deadlines: give --first, --review and --final");
    const auto in_order = [&](Instant before, Instant after, const char* first, const char* second) {
        if (before < after) return;
        throw InvalidArgument("the deadline of the {} ({}) must be after the deadline of the {} ({})", second,
                              clock.show(after), first, clock.show(before));
    };
    in_order(a.first_due, *a.review_due, "first version", "reviews");
    in_order(*a.review_due, *a.final_due, "reviews", "final version");
    if (a.reviews < 1) throw InvalidArgument("each group must write at least one review: give --reviews 1 or more");
}

constexpr std::pair<const char*, double Costs::*> kCosts[] = {{"late-day", &Costs::late_day},
                                                              {"late-most", &Costs::late_max},
                                                              {"missing-final", &Costs::missing_final},
                                                              {"late-review", &Costs::late_review},
                                                              {"missing-review", &Costs::missing_review}};

std::string costs_text(const Costs& costs) {
    std::vector<std::string> items;
    for (const auto& [name, cost] : kCosts)
        if (costs.*cost != Costs().*cost) items.push_back(fmt::format("{}:{}", name, costs.*cost));
    return fmt::format("{}", fmt::join(items, ","));
}

std::string criteria_text(const std::vector<Criterion>& criteria) {
    std::vector<std::string> items;
    for (const Criterion& c : criteria) items.push_back(fmt::format("{}:{}", c.name, c.max_points));
    return fmt::format("{}", fmt::join(items, ","));
}

/// Everything that can change about an assignment, by name.
std::vector<std::pair<const char*, std::string>> facts_of(const Assignment& a, const CourseClock& clock) {
    const auto time = [&clock](std::optional<Instant> due) {
        return due && *due != kNoDeadline ? clock.show_exactly(*due) : std::string();
    };
    const auto number = [](double value) { return fmt::format("{}", value); };
    return {{"kind", a.kind},
            {"lesson", a.lesson},
            {"first", time(a.first_due)},
            {"review", time(a.review_due)},
            {"final", time(a.final_due)},
            {"grace", duration_text(a.grace)},
            {"reviews", number(a.reviews)},
            {"criteria", criteria_text(a.criteria)},
            {"costs", costs_text(a.costs)},
            {"final weight", number(a.final_weight)},
            {"weight", number(a.weight)},
            {"reviews weight", number(a.reviews_weight)},
            {"checks", a.checks},
            {"secret", a.secret},
            {"keep", a.keep}};
}

/// "first B instead of A" for each difference.
std::vector<std::string> differences(const Assignment& before, const Assignment& now, const CourseClock& clock) {
    const auto old_facts = facts_of(before, clock), new_facts = facts_of(now, clock);
    const auto shown = [](const std::string& text) { return text.empty() ? "none" : text; };
    std::vector<std::string> all;
    for (std::size_t i = 0; i < old_facts.size(); ++i)
        if (const auto& [name, text] = new_facts[i]; text != old_facts[i].second)
            all.push_back(fmt::format("{} {} instead of {}", name, shown(text), shown(old_facts[i].second)));
    return all;
}

/// Whether `b` only gives more time than `a`.
bool only_later(Assignment a, const Assignment& b, const CourseClock& clock) {
    const bool later = b.first_due >= a.first_due && b.review_due.value_or(0) >= a.review_due.value_or(0) &&
                       b.final_due.value_or(0) >= a.final_due.value_or(0) && b.grace >= a.grace;
    a.first_due = b.first_due, a.review_due = b.review_due, a.final_due = b.final_due, a.grace = b.grace;
    return later && differences(a, b, clock).empty();
}

/// What submissions and scores depend on does not change after them.
void refuse_change_of_form(Course& course, const Assignment& known, const Assignment& requested, bool has_work) {
    if (has_work && requested.kind != known.kind)
        throw InvalidArgument("files were already submitted for {}, so its kind must remain {}", known.name,
                              known.kind);
    if (criteria_text(requested.criteria) == criteria_text(known.criteria)) return;
    Rows scored = course.database().query(
        "SELECT 1 FROM marks m JOIN criteria c ON c.assignment = m.assignment AND c.name = m.item WHERE c.assignment = "
        "?",
        known.id);
    if (scored.next())
        throw InvalidArgument("scores were already entered for {}, so its criteria must remain {}", known.name,
                              criteria_text(known.criteria));
}

void write_criteria(Database& db, std::int64_t assignment, const std::vector<Criterion>& criteria) {
    db.run("DELETE FROM criteria WHERE assignment = ?", assignment);
    std::int64_t place = 0;
    for (const Criterion& c : criteria)
        db.run("INSERT INTO criteria VALUES (?, ?, ?, ?)", assignment, place++, c.name, c.max_points);
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

bool set_assignment(Course& course, Assignment requested, const std::string& reason) {
    refuse_odd_name("the assignment's name", requested.name);
    if (!requested.is_report()) requested.reviews = 0;
    refuse_bad_deadlines(requested, course.clock());
    Database& db = course.database();
    Transaction transaction(db);
    std::string note = fmt::format("assignment {} added", requested.name);
    for (const Assignment& known : assignments_of(course)) {
        if (::strcasecmp(known.name.c_str(), requested.name.c_str()) != 0) continue;
        const std::vector<std::string> changes = differences(known, requested, course.clock());
        if (changes.empty()) return false;
        const bool has_work = db.query("SELECT 1 FROM versions WHERE assignment = ?", known.id).next();
        refuse_change_of_form(course, known, requested, has_work);
        if (has_work && reason.empty() && !only_later(known, requested, course.clock()))
            throw InvalidArgument(
                "files were already submitted for {}, so you can only postpone deadlines and increase the grace "
                "period. To make other changes, give --reason",
                known.name);
        requested.name = known.name;
        note = fmt::format("assignment {} changed: {}", known.name, fmt::join(changes, ", "));
    }
    db.run(
        "INSERT INTO assignments (name, kind, lesson, first_due, review_due, final_due, grace, reviews, made_at, "
        "costs, final_weight, weight, reviews_weight, checks, secret, keep) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
        "?, ?, ?, ?, ?) ON CONFLICT (name) DO UPDATE SET kind = excluded.kind, lesson = excluded.lesson, first_due = "
        "excluded.first_due, review_due = excluded.review_due, final_due = excluded.final_due, grace = "
        "excluded.grace, reviews = excluded.reviews, costs = excluded.costs, final_weight = excluded.final_weight, "
        "weight = excluded.weight, reviews_weight = excluded.reviews_weight, checks = excluded.checks, secret = "
        "excluded.secret, keep = excluded.keep",
        requested.name, requested.kind, requested.lesson, requested.first_due, requested.review_due,
        requested.final_due, requested.grace, requested.reviews, CourseClock::now(), costs_text(requested.costs),
        requested.final_weight, requested.weight, requested.reviews_weight, requested.checks, requested.secret,
        requested.keep);
    write_criteria(db, assignment_named(course, requested.name).id, requested.criteria);
    course.note(note + (reason.empty() ? "" : "; reason: " + reason));
    transaction.commit();
    return true;
}

void remove_assignment(Course& course, const Assignment& assignment, const std::string& reason) {
    refuse_without_reason(reason);
    Database& db = course.database();
    Transaction transaction(db);
    const std::pair<const char*, Message> kDependents[] = {{"versions", Message("submitted files")},
                                                           {"pairs", Message("review pairs")},
                                                           {"extensions", Message("extensions")},
                                                           {"marks", Message("marks")}};
    for (const auto& [table, what] : kDependents)
        if (db.query(fmt::format("SELECT 1 FROM {} WHERE assignment = ?", table), assignment.id).next())
            throw InvalidArgument("the assignment {} cannot be removed, because it already has {}; nothing was changed",
                                  assignment.name, what);
    for (const char* table : {"criteria", "pair_wishes", "holds", "pseudonyms", "allocations"})
        db.run(fmt::format("DELETE FROM {} WHERE assignment = ?", table), assignment.id);
    db.run("DELETE FROM assignments WHERE id = ?", assignment.id);
    course.note(fmt::format("assignment {} removed, before any submission; reason: {}", assignment.name, reason));
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
    if (name.empty()) throw InvalidArgument("specify an assignment; the assignments are {}", listed(names));
    const auto near = nearest_word(name, names);
    const MessageList known = listed(names);
    if (names.size() == 1)
        throw near ? InvalidArgument("unknown assignment \"{}\". The only assignment is {}. Did you mean {}?", name,
                                     known, *near)
                   : InvalidArgument("unknown assignment \"{}\"; the only assignment is {}", name, known);
    throw near
        ? InvalidArgument("unknown assignment \"{}\". The assignments are {}. Did you mean {}?", name, known, *near)
        : InvalidArgument("unknown assignment \"{}\"; the assignments are {}", name, known);
}

std::vector<std::string> parts_of(const Assignment& assignment, const std::string& stage) {
    if (stage == "review") return {"review", "pack"};
    if (assignment.is_talk()) return {"slides", "script", "pack"};
    return {assignment.document(), "pack"};
}

void refuse_without_reviews(const Assignment& assignment) {
    if (assignment.is_talk()) throw InvalidArgument("{} is a talk and has no reviews", assignment.name);
    if (assignment.is_lab()) throw InvalidArgument("{} is a lab and has no reviews", assignment.name);
}

std::vector<Criterion> criteria_of(const std::string& text) {
    std::vector<Criterion> criteria;
    std::set<std::string> seen;
    for (const auto& [name, points] : named_numbers(text)) {
        refuse_odd_name("the criterion", name);
        const std::optional<double> given = points.empty() ? 5.0 : read_number<double>(points);
        if (!given || !(*given > 0 && *given <= 1000))
            throw InvalidArgument(
                "the points of the criterion {} must be a number greater than 0 and at most 1000, but \"{}\" was given",
                name, points);
        const double max_points = *given;
        if (!seen.insert(name).second)
            throw InvalidArgument("the criterion {} occurs twice; give each criterion a different name", name);
        criteria.push_back({name, max_points});
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
        const auto is_named = [&requested = name](const auto& cost) { return cost.first == requested; };
        const auto known = std::find_if(std::begin(kCosts), std::end(kCosts), is_named);
        const auto value = read_number<double>(points);
        if (known == std::end(kCosts) || !value || !(*value >= 0 && *value <= 100))
            throw InvalidArgument(
                "\"{}:{}\" is not a valid penalty. The penalties are late-day, late-most, missing-final, late-review "
                "and missing-review, each from 0 to 100 percentage points. An example is late-day:10,missing-review:25",
                name, points);
        costs.*(known->second) = *value;
    }
    return costs;
}

double late_percent(const Costs& costs, std::int64_t late) {
    return late_percent(costs.late_day, costs.late_max, late);
}

bool waits_for_confirmation(const Costs& costs, std::int64_t late, bool confirmed) {
    constexpr double kNeedsConfirmation = 50;
    return !confirmed && late_percent(costs, late) >= kNeedsConfirmation;
}

void refuse_without_reason(const std::string& reason) {
    if (reason.empty()) throw InvalidArgument("give a reason with --reason \"...\"; the history shows the reason");
}

Instant due_of_class(const Assignment& a, const std::string& stage) {
    const std::optional<Instant> common = stage == "first"    ? std::optional(a.first_due)
                                          : stage == "review" ? a.review_due
                                                              : a.final_due;
    if (!common) {
        if (stage == "review") refuse_without_reviews(a);
        throw a.is_talk() ? InvalidArgument("{} is a talk and has no final version", a.name)
                          : InvalidArgument("{} is a lab and has no final version", a.name);
    }
    return *common;
}

Instant due_for(Course& course, const Assignment& a, std::int64_t group, const std::string& stage) {
    const Instant common = due_of_class(a, stage);
    Rows own = course.database().query(
        "SELECT due_at FROM extensions WHERE assignment = ? AND group_id = ? AND stage = ? ORDER BY id DESC LIMIT 1",
        a.id, group, stage);
    return own.next() ? own.optional_integer(0).value_or(common) : common;
}

bool is_held(Course& course, const Assignment& a, std::int64_t group, std::optional<std::int64_t> pair) {
    Rows rows = course.database().query(
        "SELECT held FROM holds WHERE assignment = ? AND group_id = ? AND ifnull(pair, 0) = ? ORDER BY id DESC LIMIT 1",
        a.id, group, pair.value_or(0));
    return rows.next() && rows.integer(0) != 0;
}

}  // namespace dynlab::inline course
