#include "course/export/handed_back.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/reader.h"
#include "course/export/mailing.h"
#include "course/findings/lesson_reader.h"
#include "course/grading/feedback.h"
#include "course/grading/grade.h"
#include "course/intake/roster.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// One row of the gradebook, with what the platforms want to know besides.
struct MarkedStudent : Recipient {
    std::string submission, points, possible, canvas;
    fs::path feedback;  ///< empty where there is none
};

std::size_t needed_column(const TextTable& table, const char* name, const fs::path& file) {
    if (const auto column = table.column(name)) return *column;
    throw EnvironmentError("{} has no column {}; it is not what dynlab grade writes", file.string(), name);
}

/// The participant's number and name in "Anna Müller_900000_assignsubmission_file_".
std::optional<std::pair<std::string, std::string>> moodle_participant(const std::string& submission) {
    static const RE2 form(R"((.+?)_(\d+)_assignsubmission_file_?.*)", RE2::Latin1);
    std::string name, number;
    if (!RE2::FullMatch(submission, form, &name, &number)) return {};
    return std::pair(number, name);
}

std::optional<std::string> canvas_number(const std::string& submission) {
    static const RE2 form(R"([^_]+(?:_LATE)?_(\d+)_\d+_.*)", RE2::Latin1);
    std::string number;
    if (!RE2::FullMatch(submission, form, &number)) return {};
    return number;
}

fs::path feedback_of(const fs::path& marks, const std::string& submission) {
    for (const char* name : {"feedback.pdf", "feedback.md"}) {
        const fs::path file = marks / "results" / submission / name;
        if (!submission.empty() && fs::exists(file)) return file;
    }
    return {};
}

std::vector<MarkedStudent> marked_students(const HandBackRequest& request) {
    const fs::path file = request.marks / "gradebook.csv";
    if (!fs::exists(file))
        throw EnvironmentError("{} holds no gradebook.csv; name the folder that dynlab grade --out wrote",
                               request.marks.string());
    const TextTable table = read_text_table(file);
    const auto column = [&](const char* name) { return needed_column(table, name, file); };
    std::map<std::string, Student> known;
    if (request.roster)
        for (const Roster roster(*request.roster); const Student& student : roster.students())
            known[student.id] = student;
    std::map<std::string, int> senders;  // of each submission; one that several have tells nobody's number
    for (const auto& row : table.rows) ++senders[row[column("submission")]];
    std::vector<MarkedStudent> all;
    for (const auto& row : table.rows) {
        MarkedStudent one;
        one.id = row[column("id")], one.name = row[column("name")], one.submission = row[column("submission")];
        one.points = row[column("points")], one.possible = row[column("possible")];
        if (one.name.empty() && one.id.empty()) one.name = one.submission;
        if (const auto found = known.find(one.id); found != known.end())
            one.group = found->second.group, one.mail = found->second.mail, one.moodle = found->second.moodle,
            one.canvas = found->second.canvas;
        if (const auto participant = moodle_participant(one.submission);
            participant && one.moodle.empty() && (senders[one.submission] == 1 || participant->second == one.name))
            one.moodle = participant->first;
        if (const auto number = canvas_number(one.submission);
            number && one.canvas.empty() && senders[one.submission] == 1)
            one.canvas = *number;
        one.feedback = feedback_of(request.marks, one.submission);
        all.push_back(std::move(one));
    }
    return all;
}

/// Points as a table has them.
Message points_in_cell(const std::string& cell) {
    const std::optional<double> value = number_in_cell(cell);
    return value ? Message("{}", points_number(*value)) : Message::verbatim(cell);
}

/// What Moodle shows beside the grade: a line for each check that lacks points.
std::string comments_on(const fs::path& marks, const MarkedStudent& student) {
    const fs::path file = marks / "results" / student.submission / "results.json";
    if (student.submission.empty() || !fs::exists(file)) return "";
    std::vector<ShownResult> shown;
    Grade grade;
    try {
        const std::string text = read_file(file);
        shown = shown_results(text);
        grade = from_results_json(text);
    } catch (const EnvironmentError& error) {
        throw EnvironmentError("{}: {}", file.string(), error.message());
    }
    MessageList lines{{Message("{} of {} points.", points_in_cell(student.points), points_in_cell(student.possible))},
                      Join::kLines};
    for (const ShownResult& one : shown) {
        if (one.earned >= one.points) continue;
        const Message line = Message("{}: {} of {}.", one.about, points_number(one.earned), points_number(one.points));
        lines.items.push_back(message_text(one.output).empty() ? line : sentences({line, one.output}));
    }
    return LessonReader(grade.language, grade.lesson).text(Message("{}", lines));
}

/// What is written, into the folder handed_back.
class Outbox {
  public:
    explicit Outbox(const HandBackRequest& request)
        : request_(request), folder_(request.marks / "handed_back"), students_(marked_students(request)) {
        fs::create_directories(folder_);
    }

    HandedBack fill() {
        moodle();
        canvas();
        mail();
        const bool marked = std::any_of(students_.begin(), students_.end(),
                                        [](const MarkedStudent& student) { return !student.points.empty(); });
        if (result_.unwritten.size() == 2 && marked)
            result_.complaints.push_back(
                Message("no marks could be entered for Moodle or Canvas; mail.csv tells whom the feedback belongs to"));
        return std::move(result_);
    }

  private:
    /// What dynlab grade --answers left for all; empty where it did not.
    fs::path model_answers() const {
        for (const char* name : {"model_answers.pdf", "model_answers.md"})
            if (fs::exists(request_.marks / name)) return request_.marks / name;
        return {};
    }

    void write(const std::string& name, const TextTable& table) {
        write_file_atomically(folder_ / name, csv_text(table));
        result_.files.push_back(folder_ / name);
    }

    void moodle() {
        TextTable table;
        table.names = {"Identifier",       "Full name", "Grade", "Maximum Grade", "Last modified (grade)",
                       "Feedback comments"};
        MoodleFeedback feedback;
        for (const MarkedStudent& student : students_) {
            if (student.moodle.empty() || student.points.empty()) continue;
            table.rows.push_back({"Participant " + student.moodle, student.name, student.points, student.possible, "",
                                  comments_on(request_.marks, student)});
            if (!student.feedback.empty())
                feedback.add(student, student.feedback.filename().string(), read_file(student.feedback));
            if (const fs::path answers = model_answers(); !student.feedback.empty() && !answers.empty())
                feedback.add(student, answers.filename().string(), read_file(answers));
        }
        if (table.rows.empty()) {
            result_.unwritten.push_back(Message(
                "without moodle-grades.csv and moodle-feedback.zip: of nobody with marks is a number there known, "
                "neither from the name of a submission nor from the roster's column moodle"));
            return;
        }
        write("moodle-grades.csv", table);
        if (!feedback.empty()) {
            feedback.write(folder_ / "moodle-feedback.zip");
            result_.files.push_back(folder_ / "moodle-feedback.zip");
        }
        for (const MarkedStudent& student : students_)
            if (student.moodle.empty() && !student.points.empty())
                result_.complaints.push_back(Message(
                    "{} is missing in moodle-grades.csv: the participant's number is not known; write it into the "
                    "roster's column moodle",
                    student.shown()));
    }

    void canvas() {
        TextTable table;
        table.names = {"Student", "ID", "SIS User ID", "SIS Login ID", "Section", request_.assignment};
        std::string possible;
        for (const MarkedStudent& student : students_) {
            if (student.canvas.empty() || student.points.empty()) continue;
            table.rows.push_back({student.name, student.canvas, student.id, student.mail, "", student.points});
            possible = student.possible;
        }
        if (table.rows.empty()) {
            result_.unwritten.push_back(Message(
                "without canvas-grades.csv: of nobody with marks is a number there known, neither from the name of "
                "a submission nor from the roster's column canvas"));
            return;
        }
        table.rows.insert(table.rows.begin(), {"    Points Possible", "", "", "", "", possible});
        write("canvas-grades.csv", table);
    }

    /// Whose feedback is new since the last time, with the address: for whoever sends by mail.
    void mail() {
        const fs::path file = folder_ / "mail.csv";
        std::map<std::string, std::string> sent;
        if (fs::exists(file)) {
            const TextTable before = read_text_table(file);
            const auto id = needed_column(before, "id", file), name = needed_column(before, "files", file),
                       hash = needed_column(before, "sha256", file);
            for (const auto& row : before.rows) sent[row[id] + "\n" + row[name]] = row[hash];
        }
        std::vector<Mailing> mailings;
        std::vector<std::vector<std::string>> more;
        for (const MarkedStudent& student : students_) {
            if (student.feedback.empty()) continue;
            const std::string hash = sha256_of_file(student.feedback);
            std::vector<std::string> files = {fs::relative(student.feedback, request_.marks).string()};
            if (const fs::path answers = model_answers(); !answers.empty())
                files.push_back(answers.filename().string());
            const auto before = sent.find(fmt::format("{}\n{}", student.id, fmt::join(files, "; ")));
            mailings.push_back({student, files, before == sent.end() || before->second != hash});
            more.push_back({student.points, student.possible, hash});
        }
        TextTable table = mailing_list(mailings);
        table.names.insert(table.names.end(), {"points", "possible", "sha256"});
        for (std::size_t i = 0; i < more.size(); ++i)
            table.rows[i].insert(table.rows[i].end(), more[i].begin(), more[i].end());
        write("mail.csv", table);
    }

    const HandBackRequest& request_;
    fs::path folder_;
    std::vector<MarkedStudent> students_;
    HandedBack result_;
};

}  // namespace

HandedBack hand_back(const HandBackRequest& request) {
    return Outbox(request).fill();
}

}  // namespace dynlab::inline course
