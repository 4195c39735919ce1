#include "course/grading/class_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/reader.h"
#include "course/grading/class_statistics.h"
#include "course/grading/feedback.h"
#include "course/grading/manual_marks.h"
#include "data_io/text_table.h"
#include "figures/gnuplot_renderer.h"
#include "figures/histogram.h"
#include "numerics/signals/robust_statistics.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "platform/text/plain_words.h"
#include "workflow/run_script.h"

namespace dynlab::inline course {
namespace {

const std::string kNothingSubmitted = "nothing submitted";  ///< the state of a student without a submission

using Entry = ClassResults::Entry;

std::string state_of(const Entry& entry) {
    if (!entry.grade) return "not graded yet";
    if (entry.grade->without_marks()) return "unreadable";
    return entry.grade->whole() ? "graded" : "partly ungraded";
}

/// The ids of all checks, in their order.
std::vector<std::string> check_ids(const ClassResults& results) {
    std::vector<std::string> ids;
    for (const Entry& entry : results.entries) {
        if (!entry.grade) continue;
        for (const CheckGrade& check : entry.grade->checks) ids.push_back(check.id);
        break;
    }
    return ids;
}

/// A row of the gradebook.
struct MarkRow {
    std::string id, name;
    const Entry* entry = nullptr;  ///< the submission that counts; null where nothing was submitted
    CountedMark mark;
};

/// One submission where students are not known.
CountedMark mark_of(const Entry& entry) {
    CountedMark mark;
    if (!entry.grade) return mark;
    const Grade& grade = *entry.grade;
    if (grade.whole()) mark.points = grade.earned();
    mark.possible = grade.possible(), mark.penalty = grade.penalty;
    for (const CheckGrade& check : grade.checks)
        mark.checks.emplace_back(check.id, check.graded ? std::optional(check.earned) : std::nullopt);
    return mark;
}

std::vector<MarkRow> mark_rows(const ClassResults& results) {
    std::vector<MarkRow> rows;
    if (!results.work->roster)
        for (const Entry& entry : results.entries)
            rows.push_back({entry.item->submission.lms_id, entry.item->submission.person, &entry, mark_of(entry)});
    for (std::size_t i = 0; i < results.marks.size() && results.work->roster; ++i) {
        const Student& student = results.work->students[i];
        const CountedMark& mark = results.marks[i];
        rows.push_back({student.id, student.name, mark.item ? &results.entries[*mark.item] : nullptr, mark});
    }
    return rows;
}

std::string points_cell(const std::optional<double>& points) {
    return points ? points_text(*points) : "";
}

/// For sentences: who it is where a platform says so, which is shorter than the platform's own names.
std::string shown_name(const Submission& submission) {
    if (submission.person.empty() || submission.lms_id.empty()) return submission.name;
    return fmt::format("{} ({})", submission.person, submission.lms_id);
}

/// The entry that counts for a student.
const Entry* counting_for(const ClassResults& results, std::size_t student) {
    const std::optional<std::size_t> item = results.marks[student].item;
    return item ? &results.entries[*item] : nullptr;
}

/// A sentence for each owner with several submissions.
std::vector<Message> several_of_one(const ClassResults& results) {
    if (!results.work->roster) return {};
    std::map<std::pair<std::string, bool>, std::vector<const Entry*>> by_owner;  // a group may have a student's id
    for (const Entry& entry : results.entries)
        if (!entry.item->students.empty())
            by_owner[entry.item->group.empty()
                         ? std::pair(results.work->students[entry.item->students.front()].id, false)
                         : std::pair(entry.item->group, true)]
                .push_back(&entry);
    std::vector<Message> sentences;
    for (const auto& [key, entries] : by_owner) {
        if (entries.size() < 2) continue;
        const std::string& owner = key.first;
        const Entry* counts = nullptr;
        std::vector<std::string> names;
        for (const Entry* entry : entries) {
            names.push_back(fmt::format("\"{}\"", shown_name(entry->item->submission)));
            for (const std::size_t student : entry->item->students)
                if (counting_for(results, student) == entry) counts = entry;
        }
        if (counts == nullptr) continue;
        const std::string counting_name = shown_name(counts->item->submission);
        sentences.push_back(
            results.work->newest_counts
                ? Message("{} has several submissions. The newest submission, \"{}\", counts. All submissions: {}",
                          owner, counting_name, listed(names))
                : Message("{} has several submissions. The best submission, \"{}\", counts. All submissions: {}", owner,
                          counting_name, listed(names)));
    }
    return sentences;
}

TextTable gradebook_of(const ClassResults& results) {
    const std::vector<std::string> ids = check_ids(results);
    TextTable table;
    table.names = {"id", "name", "submission", "state", "points", "possible", "penalty", "late_hours"};
    table.names.insert(table.names.end(), ids.begin(), ids.end());
    if (results.work->deadlines) table.names.push_back("lateness");
    const std::vector<MarkRow> rows = mark_rows(results);
    const bool own = std::ranges::any_of(rows, [](const MarkRow& row) { return !row.mark.own_reason.empty(); });
    if (own) table.names.push_back("own mark");
    for (const auto& [id, name, entry, mark] : rows) {
        const Grade* const grade = entry && entry->grade ? &*entry->grade : nullptr;
        std::vector<std::string> row = {id,
                                        name,
                                        entry ? entry->item->submission.name : "",
                                        entry ? state_of(*entry) : kNothingSubmitted,
                                        points_cell(mark.points),
                                        points_cell(mark.possible)};
        row.push_back(entry ? points_text(mark.penalty) : "");
        row.push_back(entry ? points_text(grade ? grade->late_hours : 0) : "");
        for (const std::string& check_id : ids) {
            const auto found = std::ranges::find(mark.checks, check_id, [](const auto& check) { return check.first; });
            row.push_back(found == mark.checks.end() ? "" : points_cell(found->second));
        }
        if (results.work->deadlines) row.push_back(grade ? message_text(grade->lateness) : "");
        if (own) row.push_back(mark.own_reason);
        table.rows.push_back(std::move(row));
    }
    return table;
}

bool waits_for_a_hand(const Grade& grade) {
    return !grade.whole_mark &&
           std::ranges::any_of(grade.checks, [](const CheckGrade& check) { return check.by_hand && !check.graded; });
}

/// Adds rows for missing marks by hand to the instructor's file.
void ask_for_marks(const ClassResults& results) {
    std::vector<MarksFile::Row> rows;
    std::vector<std::vector<std::string>> more;  // of, about, rubric
    for (const Entry& entry : results.entries) {
        if (!entry.grade || entry.grade->without_marks() || !waits_for_a_hand(*entry.grade)) continue;
        for (const CheckGrade& check : entry.grade->checks) {
            if (!check.by_hand || check.graded) continue;
            rows.push_back({0, entry.item->submission.name, check.id, {}, ""});
            more.push_back({points_text(check.points), message_text(check.about), check.rubric});
        }
    }
    MarksFile(results.out).add(rows, more);
}

std::vector<Grade> grades_of(const ClassResults& results) {
    std::vector<Grade> grades;
    for (const Entry& entry : results.entries)
        if (entry.grade && !entry.grade->without_marks()) grades.push_back(*entry.grade);
    return grades;
}

/// How each check went: passed by how many, mean share, and whether those who are good pass it.
RecordedTable success_of(const std::vector<CheckStatistics>& checks) {
    RecordedTable table{{"check", "points", "passed", "mean share (%)", "discrimination"}, {}};
    for (const CheckStatistics& check : checks)
        table.rows.push_back({check.about, points_text(check.points),
                              fmt::format("{} of {}", check.passed, check.graded),
                              check.graded > 0 ? fmt::format("{:.0f}", 100 * check.mean_share) : "ungraded",
                              std::isfinite(check.discrimination) ? fmt::format("{:.2f}", check.discrimination) : "–"});
    return table;
}

/// A row for each student of the roster, or each submission where there is none.
RecordedTable marks_of(const ClassResults& results) {
    RecordedTable table{{"name", "group", "state", "points", "penalty"}, {}};
    constexpr std::size_t kMaxNameCharacters = 42;  // longer ones without a space would run over the margin
    std::map<std::string, std::string> groups;
    for (const Student& student : results.work->students) groups[student.id] = student.group;
    for (const auto& [id, name, entry, mark] : mark_rows(results)) {
        const std::string shown = !results.work->roster ? shown_name(entry->item->submission)
                                  : name.empty()        ? id
                                                        : name,
                          group = results.work->roster ? groups[id] : "";
        table.rows.push_back(
            {printable(shown, kMaxNameCharacters), group.empty() ? "–" : printable(group, kMaxNameCharacters),
             entry ? state_of(*entry) : kNothingSubmitted, mark.points ? points_text(*mark.points) : "–",
             mark.penalty > 0 ? points_text(mark.penalty) : "–"});
    }
    return table;
}

/// What was said more than once where points are missing.
std::string mistakes_of(const std::vector<CheckStatistics>& checks) {
    std::string list;
    for (const CheckStatistics& check : checks)
        for (const auto& [said, count] : check.mistakes)
            if (count > 1)
                list +=
                    fmt::format("- {}: {} ({} times)\n", escaped_markdown(check.about), escaped_markdown(said), count);
    return list.empty() ? "No identical submissions.\n" : list;
}

std::string attention_of(const ClassResults& results, const Attention& found) {
    std::string attention;
    const auto add = [&](const Message& sentence) {
        attention += "- " + escaped_markdown(message_text(sentence)) + "\n";
    };
    for (const Message& complaint : results.complaints) add(complaint);
    for (const Message& sentence : found.sentences) add(sentence);
    return attention.empty() ? "Nothing.\n" : attention;
}

/// The points of those graded whole, sorted.
Vector points_by_group(const ClassResults& results) {
    std::vector<double> points;
    for (const Entry& entry : results.entries)
        if (entry.grade && entry.grade->whole()) points.push_back(entry.grade->earned());
    std::ranges::sort(points);
    return Eigen::Map<const Vector>(points.data(), static_cast<Index>(points.size()));
}

void add_numbers(const ClassResults& results, const Vector& points, double possible, RunRecord& record) {
    const auto value = [&record](const char* name, const std::string& text) { record.values[name] = {{}, text}; };
    const auto not_whole = std::ranges::count_if(results.entries, [](const Entry& entry) {
        return entry.grade && !entry.grade->whole() && !entry.grade->unreadable;
    });
    const auto unreadable = std::ranges::count_if(
        results.entries, [](const Entry& entry) { return entry.grade && entry.grade->without_marks(); });
    const Index n = points.size();
    value("lesson", results.setup->lesson.slug);
    value("isolation", isolation_name(results.setup->isolation));
    value("submissions",
          message_text(plural(static_cast<std::int64_t>(results.entries.size()), "{} submission", "{} submissions")));
    value("graded", std::to_string(n));
    value("not_whole", std::to_string(not_whole));
    value("unreadable", std::to_string(unreadable));
    value("possible", points_text(possible));
    value("mean", n == 0 ? "–" : points_text(points.mean()));
    value("median", n == 0 ? "–" : points_text(median(points)));
}

/// A bar for each point, around it; for each several where there are many.
RecordedFigure histogram_of(const Vector& points, double possible) {
    constexpr double kMaxBars = 40;
    const double width = std::max(1.0, std::ceil(possible / kMaxBars)), bars = std::ceil(possible / width) + 1;
    HistogramOptions options;
    options.edges = Vector::LinSpaced(static_cast<Index>(bars) + 1, -0.5 * width, (bars - 0.5) * width);
    options.x_label = Message("points out of {}", points_text(possible));
    options.y_label = Message("submissions");
    RecordedFigure figure;
    figure.figure = std::make_shared<const Figure>(histogram(points, options));
    figure.caption = "Points";
    return figure;
}

}  // namespace

Attention what_needs_attention(const ClassResults& results) {
    Attention attention;
    const auto add = [&](Message sentence) { attention.sentences.push_back(std::move(sentence)); };
    // A broken check is reported once; it is not the fault of any submission.
    const auto whole = [](const Grade& grade) { return grade.unreadable || grade.whole(); };
    const bool some_whole =
        std::ranges::any_of(results.entries, [&](const Entry& entry) { return entry.grade && whole(*entry.grade); });
    std::map<std::string, std::vector<const Entry*>> by_content;
    std::vector<std::string> by_hand;
    for (const Entry& entry : results.entries) {
        const std::string name = shown_name(entry.item->submission);
        if (results.work->roster && !entry.item->unmatched.empty()) {
            add(Message("\"{}\" matches no student in the roster: {}. Add the submission to the CSV file for --owners",
                        name, entry.item->unmatched));
            ++attention.unowned;
        }
        if (!entry.grade) continue;
        const Grade& grade = *entry.grade;
        if (grade.without_marks()) {
            add(Message("\"{}\" cannot be read: {}", name, grade.error_reason));
            ++attention.unreadable;
        } else {
            if (waits_for_a_hand(grade))
                by_hand.push_back(fmt::format("\"{}\"", name));
            else if (!whole(grade) && some_whole)
                add(Message("\"{}\" is not fully graded: some checks have no points yet", name));
            if (grade.error_reason.empty() && grade.silent)
                add(Message("\"{}\" ran to completion but submitted no answer", name));
            if (!grade.error_reason.empty())
                add(grade.began ? Message("the script of \"{}\" stopped: {}", name, grade.error_reason)
                                : Message("the script of \"{}\" could not be started: {}", name, grade.error_reason));
            if (!grade.remark.empty()) add(Message("\"{}\": {}", name, grade.remark));
            if (grade.penalty > 0)
                add(Message("\"{}\" was late; points deducted: {} ({})", name, points_text(grade.penalty),
                            grade.lateness));
        }
        if (entry.item->version == 0) continue;
        by_content[entry.item->content].push_back(&entry);
    }
    if (!by_hand.empty()) add(Message("manual marks are missing from marks.csv: {}", listed(by_hand, Join::kAnd)));
    for (const auto& [content, entries] : by_content) {
        const auto of_others = [&of_content = entries](const Entry* entry) {
            return entry->item->students != of_content.front()->item->students;
        };
        if (!results.work->roster || std::ranges::none_of(entries, of_others)) continue;
        std::vector<std::string> names;
        for (const Entry* entry : entries) names.push_back(fmt::format("\"{}\"", shown_name(entry->item->submission)));
        add(Message("{} are identical byte for byte", listed(names, Join::kAnd)));
    }
    for (Message& sentence : several_of_one(results)) add(std::move(sentence));
    for (const Message& sentence : results.work->attention) add(sentence);
    return attention;
}

std::vector<std::string> counted_instead(const ClassResults& results) {
    std::vector<std::string> names(results.entries.size());
    if (!results.work->roster) return names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Entry& entry = results.entries[i];
        const auto& owners = entry.item->students;
        if (std::ranges::any_of(owners, [&](std::size_t owner) { return counting_for(results, owner) == &entry; }))
            continue;
        for (const std::size_t owner : owners)
            if (const Entry* const counts = counting_for(results, owner))
                names[i] = shown_name(counts->item->submission);
    }
    return names;
}

std::optional<Message> write_class_results(const ClassResults& results, const Attention& attention) {
    write_file_atomically(results.out / "gradebook.csv", csv_text(gradebook_of(results)));
    ask_for_marks(results);
    double possible = 0;
    for (const Entry& entry : results.entries)
        if (entry.grade) possible = std::max(possible, entry.grade->possible());
    const Vector points = points_by_group(results);
    RunRecord record;
    add_numbers(results, points, possible, record);
    const std::vector<Grade> grades = grades_of(results);
    const std::vector<CheckStatistics> checks = statistics_of_checks(grades);
    write_file_atomically(results.out / "summary.json", class_statistics_json(results.setup->lesson.slug, grades));
    record.tables["success"] = success_of(checks);
    record.tables["marks"] = marks_of(results);
    record.texts["mistakes"] = {mistakes_of(checks)};
    record.texts["attention"] = {attention_of(results, attention)};
    record.figures["points"] = histogram_of(points, possible);
    const auto summarize = [&](bool pdf) {
        GnuplotRenderer renderer;
        const TemporaryFolder drawn;
        draw_figures(record, renderer, drawn.path(), pdf ? FigureFormat::kPdf : FigureFormat::kSvg, "en");
        renderer.finish();
        results.documents->make("class_summary.md", record, results.out / (pdf ? "summary.pdf" : "summary.md"));
        std::filesystem::remove(results.out / (pdf ? "summary.md" : "summary.pdf"));  // of an earlier run
    };
    try {
        summarize(results.pdf);
    } catch (const EnvironmentError& error) {
        if (!results.pdf) throw;
        summarize(false);
        return Message("the summary is in summary.md, because its PDF cannot be created: {}", error.message());
    }
    return std::nullopt;
}

}  // namespace dynlab::inline course
