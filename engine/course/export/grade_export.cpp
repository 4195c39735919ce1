#include "course/export/grade_export.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/reader.h"
#include "course/export/mailing.h"
#include "course/export/platform_sheet.h"
#include "course/grading/feedback.h"
#include "course/grading/grade.h"
#include "course/intake/owners.h"
#include "course/intake/roster.h"
#include "course/issues/lesson_reader.h"
#include "course/office/course_grading.h"
#include "course/office/course_totals.h"
#include "data_io/text_table.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// One row of the gradebook, with the additional fields that the platforms need.
struct MarkedStudent : Recipient {
    std::string submission, points, possible, canvas, language, own_reason;
    std::string number_in_name;  ///< the participant's number in the name of the submission's folder
    fs::path feedback;           ///< empty where there is none
};

std::size_t needed_column(const TextTable& table, const char* name, const fs::path& file) {
    if (const auto column = table.column(name)) return *column;
    throw EnvironmentError("{} has no column \"{}\"; expected a gradebook written by dynlab grade", file.string(),
                           name);
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

/// The course may know more than the last grading: a mark given by command, a withdrawn file, a deadline that passed.
void refuse_changed_marks(Course& course, const std::string& assignment, const TextTable& gradebook,
                          const fs::path& file) {
    auto marks = marks_of_students(course, assignment_named(course, assignment), CourseClock::now());
    const auto id = needed_column(gradebook, "id", file), points = needed_column(gradebook, "points", file);
    std::vector<std::string> changed;
    for (const auto& row : gradebook.rows) {
        const auto& lab = marks[row[id]].lab;
        const std::string now = lab && lab->earned ? points_text(*lab->earned) : "";
        if (marks.erase(row[id]) > 0 && now != row[points]) changed.push_back(row[id]);
    }
    for (const auto& [student, mark] : marks)
        if (mark.percent) changed.push_back(student);  // new since then
    if (changed.empty()) return;
    constexpr std::size_t kShown = 5;
    if (changed.size() > kShown) changed.resize(kShown), changed.emplace_back("others");
    throw EnvironmentError(
        "the marks of {} changed after the last grading. Run dynlab course grade {}, which also updates the feedback",
        listed(changed, Join::kAnd), assignment);
}

std::vector<MarkedStudent> marked_students(const GradeExportRequest& request) {
    const fs::path file = request.marks / "gradebook.csv";
    if (!fs::exists(file))
        throw EnvironmentError("{} contains no gradebook.csv; give the folder that dynlab grade --out wrote",
                               request.marks.string());
    const TextTable table = read_text_table(file);
    const auto column = [&](const char* name) { return needed_column(table, name, file); };
    std::map<std::string, Student> known;
    std::vector<Student> students;
    if (const auto results = course_of_results(request.marks)) {
        Course course(results->folder);
        if (!results->own) refuse_changed_marks(course, results->assignment, table, file);
        students = students_of(course);
        for (Student& student : students)  // the group of a student alone is called by the id
            if (student.group == student.id) student.group.clear();
    }
    if (request.roster) students = Roster(*request.roster).students();
    for (const Student& student : students) known[student.id] = student;
    std::map<std::string, int> senders;  // by submission; one of several students gives no number
    for (const auto& row : table.rows) ++senders[row[column("submission")]];
    std::vector<MarkedStudent> all;
    for (const auto& row : table.rows) {
        MarkedStudent one;
        one.id = row[column("id")], one.name = row[column("name")], one.submission = row[column("submission")];
        one.points = row[column("points")], one.possible = row[column("possible")];
        if (const auto own = table.column("own mark")) one.own_reason = row[*own];
        if (one.name.empty() && one.id.empty()) one.name = one.submission;
        if (const auto found = known.find(one.id); found != known.end())
            one.group = found->second.group, one.mail = found->second.mail, one.moodle = found->second.moodle,
            one.canvas = found->second.canvas, one.language = found->second.language;
        if (const auto participant = moodle_participant(one.submission);
            participant && (senders[one.submission] == 1 || same_person(participant->second, one.name)))
            one.number_in_name = participant->first;
        if (const auto number = canvas_number(one.submission);
            number && one.canvas.empty() && senders[one.submission] == 1)
            one.canvas = *number;
        one.feedback = feedback_of(request.marks, one.submission);
        all.push_back(std::move(one));
    }
    return all;
}

/// Moodle's numbers are those in the names of the folders. Returns how many of them the roster contradicts; then the
/// roster's own are of another assignment.
std::int64_t settle_numbers(std::vector<MarkedStudent>& students) {
    const auto contradicted = std::ranges::count_if(students, [](const MarkedStudent& one) {
        return !one.number_in_name.empty() && !one.moodle.empty() && one.moodle != one.number_in_name;
    });
    for (MarkedStudent& one : students)
        if (!one.number_in_name.empty() || contradicted > 0) one.moodle = one.number_in_name;
    return contradicted;
}

/// Points as a table has them.
Message points_in_cell(const std::string& cell) {
    const std::optional<double> value = number_in_cell(cell);
    return value ? Message("{}", points_number(*value)) : Message::verbatim(cell);
}

/// What Moodle shows beside the grade: a line for each check that lacks points; why there are no marks.
std::string comments_on(const fs::path& marks, const MarkedStudent& student) {
    const fs::path file = marks / "results" / student.submission / "results.json";
    if (student.submission.empty() || !fs::exists(file)) {
        if (student.points.empty()) return "";
        const Message why = number_in_cell(student.points) == 0 && student.own_reason.empty()
                                ? Message("Nothing was submitted before the deadline.")
                                : Message::verbatim(student.own_reason);
        return LessonReader(student.language).text(why);
    }
    std::vector<ShownResult> shown;
    Grade grade;
    try {
        const std::string text = read_file(file);
        shown = shown_results(text);
        grade = from_results_json(text);
    } catch (const EnvironmentError& error) {
        throw EnvironmentError("{}: {}", file.string(), error.message());
    }
    if (student.points.empty()) return LessonReader(grade.language, grade.lesson).text(grade.error_reason);
    MessageList lines{{Message("{} of {} points.", points_in_cell(student.points), points_in_cell(student.possible))},
                      Join::kLines};
    if (!student.own_reason.empty())
        lines.items.push_back(
            Message("Your mark differs from the mark of your group: {}", Message::verbatim(student.own_reason)));
    for (const ShownResult& one : shown) {
        if (one.earned >= one.points) continue;
        const Message line = Message("{}: {} of {}.", one.about, points_number(one.earned), points_number(one.points));
        lines.items.push_back(message_text(one.output).empty() ? line : sentences({line, one.output}));
    }
    return LessonReader(grade.language, grade.lesson).text(Message("{}", lines));
}

/// By student and file: the hash of what was delivered.
using Delivered = std::map<std::string, std::string>;
constexpr char kDelivered[] = "delivered.csv";

std::string delivery_key(const std::string& id, const std::string& files) {
    return id + "\n" + files;
}

Delivered read_deliveries(const fs::path& file) {
    Delivered delivered;
    if (!fs::exists(file)) return delivered;
    const TextTable table = read_text_table(file);
    const auto id = needed_column(table, "id", file), files = needed_column(table, "files", file),
               hash = needed_column(table, "sha256", file);
    for (const auto& row : table.rows) delivered[delivery_key(row[id], row[files])] = row[hash];
    return delivered;
}

/// What is written, into the folder handed_back.
class Outbox {
  public:
    explicit Outbox(const GradeExportRequest& request)
        : request_(request), folder_(request.marks / "handed_back"), students_(marked_students(request)) {
        fs::create_directories(folder_);
        if (request.worksheet)
            read_sheet();
        else if (const std::int64_t contradicted = settle_numbers(students_); contradicted > 0)
            result_.notes.push_back(plural(
                contradicted,
                "{} participant number in the roster's column \"moodle\" differs from the number in the submission's "
                "name. dynlab uses the latter, because Moodle numbers participants for each assignment",
                "{} participant numbers in the roster's column \"moodle\" differ from the numbers in the submissions' "
                "names. dynlab uses the latter, because Moodle numbers participants for each assignment"));
        look_for_news();
    }

    GradeExport fill() {
        if (!sheet_ || sheet_->platform() == PlatformSheet::Platform::kMoodle) moodle();
        if (!sheet_ || sheet_->platform() == PlatformSheet::Platform::kCanvas) canvas();
        write("mail.csv", csv_text(mail_));
        const bool marked = std::ranges::any_of(students_, [](const MarkedStudent& one) { return has_marks(one); });
        if (result_.unwritten.size() == 2 && marked)
            result_.complaints.push_back(Message(
                "no marks could be entered for Moodle or Canvas; mail.csv lists the recipients of the feedback"));
        return std::move(result_);
    }

  private:
    static bool has_marks(const MarkedStudent& student) { return !student.points.empty(); }

    /// Rows of the platform's own table; participant numbers come from that table.
    void read_sheet() {
        sheet_.emplace(*request_.worksheet, request_.assignment);
        const bool moodle = sheet_->platform() == PlatformSheet::Platform::kMoodle;
        result_.notes = sheet_->unrecognized();
        for (MarkedStudent& student : students_)
            if (moodle) student.moodle.clear();
        std::vector<SoughtPerson> sought;
        for (const MarkedStudent& student : students_)
            sought.push_back(
                {student.id, student.mail, student.name, moodle ? student.number_in_name : student.canvas});
        rows_ = rows_of(*sheet_, sought);
        for (const auto& [place, person] : rows_)
            (moodle ? students_[place].moodle : students_[place].canvas) = person.number;
        const auto unknown = std::ssize(sheet_->people()) - std::ssize(rows_);
        note_other_maximum();
        if (unknown > 0)
            result_.notes.push_back(plural(unknown, "{} row of {} matches no submission and was not changed",
                                           "{} rows of {} match no submission and were not changed",
                                           request_.worksheet->string()));
        for (std::size_t i = 0; i < students_.size(); ++i)
            if (has_marks(students_[i]) && !rows_.contains(i))
                result_.complaints.push_back(Message("{} has marks, but no row in {}; enter the marks manually",
                                                     students_[i].shown(), request_.worksheet->string()));
    }

    void note_other_maximum() {
        const std::optional<double> maximum = sheet_->maximum();
        for (const MarkedStudent& student : students_) {
            const std::optional<double> possible = number_in_cell(student.possible);
            if (!maximum || !possible || !has_marks(student) || *possible == *maximum) continue;
            result_.notes.push_back(
                Message("the marks are scaled from {} points to the maximum grade of {}, which is {}",
                        points_number(*possible), request_.worksheet->string(), points_number(*maximum)));
            return;
        }
    }

    /// What dynlab grade --answers left for all; empty where it did not.
    fs::path model_answers() const {
        for (const char* name : {"model_answers.pdf", "model_answers.md"})
            if (fs::exists(request_.marks / name)) return request_.marks / name;
        return {};
    }

    void write(const std::string& name, const std::string& text) {
        write_file_atomically(folder_ / name, text);
        result_.files.push_back(folder_ / name);
    }

    std::string filled_sheet() {
        for (const auto& [index, person] : rows_) {
            const MarkedStudent& student = students_[index];
            const std::optional<double> points = number_in_cell(student.points),
                                        possible = number_in_cell(student.possible);
            if (points) sheet_->set_grade(person, points_in_sheet(*sheet_, *points, possible.value_or(0)));
            if (const std::string comment = comments_on(request_.marks, student); !comment.empty())
                sheet_->set_comment(person, comment);
        }
        return sheet_->text();
    }

    void moodle() {
        MoodleFeedback feedback;
        bool delivered = false;
        for (std::size_t i = 0; i < students_.size(); ++i) {
            const MarkedStudent& student = students_[i];
            if (student.feedback.empty()) continue;
            if (!is_new_[i] && !request_.all) {
                delivered = true;
                continue;
            }
            feedback.add(student, student.feedback.filename().string(), read_file(student.feedback));
            if (const fs::path answers = model_answers(); !answers.empty())
                feedback.add(student, answers.filename().string(), read_file(answers));
        }
        if (sheet_) {
            write("moodle-grades.csv", filled_sheet());
        } else if (!moodle_table()) {
            result_.unwritten.push_back(
                Message("moodle-grades.csv and moodle-feedback.zip were not written: no student with marks has a "
                        "Moodle number, neither in the name of a submission nor in the roster's column \"moodle\"; "
                        "give --worksheet FILE"));
            return;
        }
        const fs::path zip = folder_ / "moodle-feedback.zip";
        if (feedback.empty()) {
            fs::remove(zip);
            result_.notes.push_back(delivered ? Message("moodle-feedback.zip was not written, because all feedback was "
                                                        "already delivered. To write the file again, use --all")
                                              : Message("moodle-feedback.zip was not written, because no student has "
                                                        "both feedback and a known participant number"));
        } else {
            feedback.write(zip);
            result_.files.push_back(zip);
        }
    }

    /// False if no student has a number.
    bool moodle_table() {
        TextTable table;
        table.names = {"Identifier",       "Full name", "Grade", "Maximum Grade", "Last modified (grade)",
                       "Feedback comments"};
        for (const MarkedStudent& student : students_)
            if (!student.moodle.empty() && has_marks(student))
                table.rows.push_back({"Participant " + student.moodle, student.name, student.points, student.possible,
                                      "", comments_on(request_.marks, student)});
        if (table.rows.empty()) return false;
        write("moodle-grades.csv", csv_text(table));
        for (const MarkedStudent& student : students_)
            if (student.moodle.empty() && has_marks(student))
                result_.complaints.push_back(
                    Message("{} is missing from moodle-grades.csv, because the participant's number is unknown. Give "
                            "Moodle's grading worksheet with --worksheet",
                            student.shown()));
        return true;
    }

    void canvas() {
        if (sheet_) return write("canvas-grades.csv", filled_sheet());
        TextTable table;
        table.names = {"Student",      "ID",      "SIS User ID",
                       "SIS Login ID", "Section", request_.assignment.empty() ? "dynlab" : request_.assignment};
        std::string possible;
        for (const MarkedStudent& student : students_) {
            if (student.canvas.empty() || !has_marks(student)) continue;
            table.rows.push_back({student.name, student.canvas, student.id, student.mail, "", student.points});
            possible = student.possible;
        }
        if (table.rows.empty()) {
            result_.unwritten.push_back(
                Message("canvas-grades.csv was not written: no student with marks has a Canvas number, neither in the "
                        "name of a submission nor in the roster's column \"canvas\"; give --worksheet FILE"));
            return;
        }
        table.rows.insert(table.rows.begin(), {"    Points Possible", "", "", "", "", possible});
        write("canvas-grades.csv", csv_text(table));
    }

    /// Feedback that was not delivered yet, with the addresses, for sending by mail.
    void look_for_news() {
        const Delivered delivered = read_deliveries(folder_ / kDelivered);
        is_new_.resize(students_.size());
        std::vector<Mailing> mailings;
        std::vector<std::vector<std::string>> more;
        for (std::size_t i = 0; i < students_.size(); ++i) {
            const MarkedStudent& student = students_[i];
            if (student.feedback.empty()) continue;
            const std::string hash = sha256_of_file(student.feedback);
            std::vector<std::string> files = {fs::relative(student.feedback, request_.marks).string()};
            if (const fs::path answers = model_answers(); !answers.empty())
                files.push_back(answers.filename().string());
            const auto before = delivered.find(delivery_key(student.id, fmt::format("{}", fmt::join(files, "; "))));
            is_new_[i] = before == delivered.end() || before->second != hash;
            mailings.push_back({student, files, is_new_[i]});
            more.push_back({student.points, student.possible, hash});
        }
        mail_ = mailing_list(mailings);
        mail_.names.insert(mail_.names.end(), {"points", "possible", "sha256"});
        for (std::size_t i = 0; i < more.size(); ++i)
            mail_.rows[i].insert(mail_.rows[i].end(), more[i].begin(), more[i].end());
    }

    const GradeExportRequest& request_;
    fs::path folder_;
    std::vector<MarkedStudent> students_;
    std::vector<bool> is_new_;  ///< by student
    TextTable mail_;
    std::optional<PlatformSheet> sheet_;
    std::map<std::size_t, PlatformSheet::Person> rows_;  ///< of the sheet, by place of the student
    GradeExport result_;
};

}  // namespace

GradeExport write_grade_export(const GradeExportRequest& request) {
    return Outbox(request).fill();
}

std::int64_t log_delivery(const fs::path& marks) {
    const fs::path file = marks / "handed_back/mail.csv", delivered_file = marks / "handed_back" / kDelivered;
    if (!fs::exists(file))
        throw EnvironmentError("{} does not exist yet; run dynlab export-grades without --delivered first",
                               file.string());
    Delivered delivered = read_deliveries(delivered_file);
    std::int64_t fresh = 0;
    for (const auto& [key, hash] : read_deliveries(file))
        if (std::string& before = delivered[key]; before != hash) before = hash, ++fresh;
    TextTable table;
    table.names = {"id", "files", "sha256"};
    for (const auto& [key, hash] : delivered) {
        const std::size_t end = key.find('\n');
        table.rows.push_back({key.substr(0, end), key.substr(end + 1), hash});
    }
    write_file_atomically(delivered_file, csv_text(table));
    return fresh;
}

}  // namespace dynlab::inline course
