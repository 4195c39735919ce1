#include "course/grading/manual_marks.h"

#include "course/grading/feedback.h"
#include "data_io/text_table.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {

ManualMarks::ManualMarks(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file))
        write_file_atomically(file, csv_text({{"submission", "check", "points", "reason"}, {}, {}}));
    const TextTable table = read_text_table(file);
    const auto submission = table.column("submission"), check = table.column("check"), points = table.column("points"),
               reason = table.column("reason") ? table.column("reason") : table.column("comment");
    if (!submission || !check || !points)
        throw EnvironmentError("{}: the columns submission, check and points are needed", file.string());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        // A decimal comma, as a spreadsheet writes it in much of Europe.
        const std::string text = replaced(row[*points], ",", ".");
        if (text.empty()) continue;  // not marked yet
        const auto given = read_number<double>(text);
        if (!given || !(*given >= 0 && *given <= 1000))
            throw EnvironmentError("{}, line {}: points must be a number from 0 to 1000, but \"{}\" was given",
                                   file.string(), table.lines[i], text);
        marks_[{row[*submission], row[*check]}] = {*given, reason ? row[*reason] : ""};
    }
}

Grade ManualMarks::applied(Grade grade) const {
    for (CheckGrade& check : grade.checks) {
        const auto found = marks_.find({grade.submission, check.id});
        if (found == marks_.end()) continue;
        check.earned = found->second.points;
        check.graded = true;
        check.message = found->second.reason.empty() ? Message("Marked by the instructor.")
                                                     : Message::verbatim(found->second.reason);
        check.visible = true;
    }
    return grade;
}

std::vector<Message> ManualMarks::strays(const std::set<std::string>& submissions,
                                         const std::map<std::string, double>& checks) const {
    std::vector<Message> sentences;
    for (const auto& [key, mark] : marks_) {
        const auto& [submission, check] = key;
        if (!submissions.contains(submission))
            sentences.push_back(Message("manual.csv: there is no submission \"{}\"", submission));
        else if (!checks.contains(check))
            sentences.push_back(Message("manual.csv: there is no check \"{}\" (for \"{}\")", check, submission));
        else if (mark.points > checks.at(check))
            sentences.push_back(Message("manual.csv: \"{}\" gets {} points for the check \"{}\", which has {}",
                                        submission, points_text(mark.points), check, points_text(checks.at(check))));
    }
    return sentences;
}

}  // namespace dynlab::inline course
