#include "course/grading/class_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "course/grading/feedback.h"
#include "data_io/text_table.h"
#include "figures/gnuplot_renderer.h"
#include "figures/histogram.h"
#include "numerics/number_text.h"
#include "numerics/signals/robust_statistics.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "workflow/run_script.h"

namespace dynlab::inline course {
namespace {

using Entry = ClassResults::Entry;

std::string state_of(const Entry& entry) {
    if (!entry.grade) return "not graded yet";
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

std::vector<std::string> row_of(const std::string& id, const std::string& name, const Entry* entry,
                                const std::vector<std::string>& ids) {
    std::vector<std::string> row = {id, name};
    if (!entry) {
        row.insert(row.end(), {"", "nothing handed in"});
        row.resize(8 + ids.size());
        return row;
    }
    row.insert(row.end(), {entry->submission.name, state_of(*entry)});
    const Grade empty;
    const Grade& grade = entry->grade ? *entry->grade : empty;
    const bool whole = entry->grade && grade.whole();
    row.push_back(whole ? points_text(grade.earned()) : "");
    row.push_back(entry->grade ? points_text(grade.possible()) : "");
    row.push_back(points_text(grade.penalty));
    row.push_back(points_text(grade.late_hours));
    for (const std::string& check_id : ids) {
        const auto found = std::find_if(grade.checks.begin(), grade.checks.end(),
                                        [&](const CheckGrade& check) { return check.id == check_id; });
        row.push_back(found == grade.checks.end() || !found->graded ? "" : points_text(found->earned));
    }
    return row;
}

/// Of several submissions of one student, the better one.
const Entry* better(const Entry* a, const Entry* b) {
    const auto points = [](const Entry* entry) { return entry->grade ? entry->grade->earned() : -1; };
    return a == nullptr || points(b) > points(a) ? b : a;
}

TextTable gradebook_of(const ClassResults& results, std::vector<std::string>& remarks) {
    const std::vector<std::string> ids = check_ids(results);
    TextTable table;
    table.names = {"id", "name", "submission", "state", "points", "possible", "penalty", "late_hours"};
    table.names.insert(table.names.end(), ids.begin(), ids.end());
    if (!results.roster) {
        for (const Entry& entry : results.entries)
            table.rows.push_back(row_of(entry.submission.lms_id, entry.submission.person, &entry, ids));
        return table;
    }
    const auto& students = results.roster->students();
    std::vector<const Entry*> work(students.size(), nullptr);
    for (const Entry& entry : results.entries) {
        const auto owners = results.roster->owners(entry.submission);
        if (owners.empty())
            remarks.push_back(
                fmt::format("the submission \"{}\" belongs to nobody in the roster", entry.submission.name));
        for (const std::size_t owner : owners) {
            if (work[owner] != nullptr)
                remarks.push_back(
                    fmt::format("{} has several submissions, of which the better one counts: \"{}\", \"{}\"",
                                students[owner].id, work[owner]->submission.name, entry.submission.name));
            work[owner] = better(work[owner], &entry);
        }
    }
    for (std::size_t i = 0; i < students.size(); ++i)
        table.rows.push_back(row_of(students[i].id, students[i].name, work[i], ids));
    return table;
}

/// What is to be marked by hand and is not yet: a table to be filled in and put into manual.csv.
TextTable open_marks(const ClassResults& results) {
    TextTable table;
    table.names = {"submission", "check", "points", "comment", "of", "about", "rubric"};
    for (const Entry& entry : results.entries) {
        if (!entry.grade) continue;
        for (const CheckGrade& check : entry.grade->checks)
            if (check.by_hand && !check.graded)
                table.rows.push_back(
                    {entry.submission.name, check.id, "", "", points_text(check.points), check.about, check.rubric});
    }
    return table;
}

/// How each check went: passed by how many, mean share.
RecordedTable success_of(const ClassResults& results) {
    RecordedTable table{{"check", "points", "passed", "mean share (%)"}, {}};
    const std::vector<std::string> ids = check_ids(results);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        int graded = 0, passed = 0;
        double shares = 0, points = 0;
        std::string about;
        for (const Entry& entry : results.entries) {
            if (!entry.grade || k >= entry.grade->checks.size()) continue;
            const CheckGrade& check = entry.grade->checks[k];
            points = check.points;
            about = check.about;
            if (!check.graded) continue;
            ++graded;
            passed += check.earned >= check.points;
            shares += check.earned / check.points;
        }
        table.rows.push_back({about, points_text(points), fmt::format("{} of {}", passed, graded),
                              graded > 0 ? fmt::format("{:.0f}", 100 * shares / graded) : "ungraded"});
    }
    return table;
}

std::string attention_of(const ClassResults& results, const std::vector<std::string>& remarks) {
    std::string attention;
    const auto add = [&](const std::string& sentence) { attention += "- " + escaped_markdown(sentence) + "\n"; };
    for (const std::string& complaint : results.complaints) add(complaint);
    for (const std::string& remark : remarks) add(remark);
    for (const Entry& entry : results.entries) {
        if (!entry.grade) continue;
        const std::string& name = entry.submission.name;
        const auto& checks = entry.grade->checks;
        const bool waits = std::any_of(checks.begin(), checks.end(),
                                       [](const CheckGrade& check) { return check.by_hand && !check.graded; });
        if (waits)
            add(fmt::format("\"{}\" is to be marked by hand: by_hand.csv", name));
        else if (!entry.grade->whole())
            add(fmt::format("\"{}\" is not graded completely", name));
        if (!entry.grade->trouble.empty())
            add(fmt::format("the script of \"{}\" did not run to its end: {}", name, entry.grade->trouble));
        if (entry.grade->penalty > 0)
            add(fmt::format("\"{}\" was {:.1f} hours late, which costs {} points", name, entry.grade->late_hours,
                            points_text(entry.grade->penalty)));
    }
    return attention.empty() ? "Nothing.\n" : attention;
}

/// The points of those graded whole, sorted.
Vector points_of(const ClassResults& results) {
    std::vector<double> points;
    for (const Entry& entry : results.entries)
        if (entry.grade && entry.grade->whole()) points.push_back(entry.grade->earned());
    std::sort(points.begin(), points.end());
    return Eigen::Map<const Vector>(points.data(), static_cast<Index>(points.size()));
}

void add_numbers(const ClassResults& results, const Vector& points, double possible, RunRecord& record) {
    const auto value = [&record](const char* name, const std::string& text) { record.values[name] = {{}, text}; };
    const auto not_whole = std::count_if(results.entries.begin(), results.entries.end(),
                                         [](const Entry& entry) { return entry.grade && !entry.grade->whole(); });
    const Index n = points.size();
    value("lesson", results.setup->lesson.slug);
    value("isolation", isolation_name(results.setup->isolation));
    value("submissions", counted(results.entries.size(), "submission"));
    value("graded", std::to_string(n));
    value("not_whole", std::to_string(not_whole));
    value("possible", points_text(possible));
    value("mean", n == 0 ? "–" : points_text(points.mean()));
    value("median", n == 0 ? "–" : points_text(median(points)));
}

/// A bar for each point, around it; for each several where there are many.
RecordedFigure histogram_of(const Vector& points, double possible) {
    constexpr double kMostBars = 40;
    const double width = std::max(1.0, std::ceil(possible / kMostBars)), bars = std::ceil(possible / width) + 1;
    HistogramOptions options;
    options.edges = Vector::LinSpaced(static_cast<Index>(bars) + 1, -0.5 * width, (bars - 0.5) * width);
    options.x_label = fmt::format("points of {}", points_text(possible));
    options.y_label = "submissions";
    RecordedFigure figure;
    figure.figure = histogram(points, options);
    figure.caption = "Points";
    return figure;
}

}  // namespace

void write_class_results(const ClassResults& results) {
    std::vector<std::string> remarks;
    write_file_atomically(results.out / "gradebook.csv", csv_text(gradebook_of(results, remarks)));
    const TextTable open = open_marks(results);
    if (open.rows.empty())
        std::filesystem::remove(results.out / "by_hand.csv");
    else
        write_file_atomically(results.out / "by_hand.csv", csv_text(open));
    double possible = 0;
    for (const Entry& entry : results.entries)
        if (entry.grade) possible = std::max(possible, entry.grade->possible());
    const Vector points = points_of(results);
    RunRecord record;
    add_numbers(results, points, possible, record);
    record.tables["success"] = success_of(results);
    record.texts["attention"] = {attention_of(results, remarks)};
    record.figures["points"] = histogram_of(points, possible);
    GnuplotRenderer renderer;
    const TemporaryFolder drawn;
    draw_figures(record, renderer, drawn.path(), results.pdf ? FigureFormat::kPdf : FigureFormat::kSvg);
    renderer.finish();
    results.documents->make("class_summary.md", record, results.out / (results.pdf ? "summary.pdf" : "summary.md"));
    std::filesystem::remove(results.out / (results.pdf ? "summary.md" : "summary.pdf"));  // of an earlier run
}

}  // namespace dynlab::inline course
