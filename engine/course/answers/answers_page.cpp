#include "course/answers/answers_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/reader.h"
#include "course/answers/formulas.h"
#include "course/answers/hidden_names.h"
#include "course/answers/lesson_questions.h"
#include "course/answers/written_answers.h"
#include "course/intake/class_submissions.h"
#include "course/intake/owners.h"
#include "course/intake/staging.h"
#include "data_io/text_table.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/temporary_folder.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

/// "q3", "conclusion": in names of files.
std::string slug_of(const QuestionName& question) {
    if (question.number > 0) return fmt::format("q{}", question.number);
    return replaced(*question.titles.begin(), " ", "-");
}

/// One submission's answer.
struct Answer {
    std::string submission, text;
    int number = 0;
};

/// Reads the answers of a class.
class AnswerCollection {
  public:
    explicit AnswerCollection(const AnswersRequest& request)
        : request_(request),
          lesson_(request.lesson),
          question_(lesson_.question(request.question)),
          asked_(lesson_.asked(question_)) {}

    void read(AnswersOutcome& outcome) {
        const ClassSubmissions submissions(request_.submissions, request_.isolation, request_.program, request_.out);
        const Owners owners(request_.roster);
        const HiddenNames names(request_.roster);
        for (const Submission& submission : submissions.all()) {
            const TemporaryFolder work;
            try {
                const StagedWork staged =
                    stage_submission(submission, work.path(), request_.isolation, request_.program);
                std::vector<Student> authors = members_of(staged.folder / "group.toml");
                if (!submission.person.empty()) authors.emplace_back().name = submission.person;
                for (const std::size_t student : owners.find(submission).students)
                    authors.push_back(request_.roster[student]);
                const std::string text = written_answer(text_parts_in(staged.folder), question_, lesson_.given());
                answers_.push_back({submission.name, names.hidden_in(text, authors)});
            } catch (const SubmissionError& error) {
                outcome.complaints.push_back(Message("\"{}\": {}", submission.name, error.message()));
            } catch (const DocumentError& error) {
                outcome.complaints.push_back(Message("\"{}\": {}", submission.name, error.message()));
            }
        }
        for (const Message& clause : submissions.left_out())
            outcome.complaints.push_back(Message("{}; left out", clause));
        outcome.submissions = submissions.all().size();
        outcome.answers = static_cast<std::size_t>(
            std::ranges::count_if(answers_, [](const Answer& answer) { return !answer.text.empty(); }));
    }

    /// Numbers that do not follow names: by a hash of these. Those of an earlier call stay.
    void number(const std::map<std::string, int>& earlier) {
        int last = 0;
        for (const auto& [submission, number] : earlier) last = std::max(last, number);
        std::ranges::sort(answers_, {}, [](const Answer& answer) { return sha256_of(answer.submission); });
        for (Answer& answer : answers_) {
            const auto found = earlier.find(answer.submission);
            answer.number = found == earlier.end() ? ++last : found->second;
        }
        std::ranges::sort(answers_, {}, &Answer::number);
    }

    const QuestionName& question() const { return question_; }
    const AskedQuestion& asked() const { return asked_; }
    const std::vector<Answer>& answers() const { return answers_; }
    std::vector<AnswerGroup> groups() const {
        std::vector<std::string> texts;
        for (const Answer& answer : answers_) texts.push_back(answer.text);
        return groups_of_answers(texts);
    }

  private:
    const AnswersRequest& request_;
    LessonQuestions lesson_;
    QuestionName question_;
    AskedQuestion asked_;
    std::vector<Answer> answers_;
};

/// answers-q3.csv: which number is which submission, and the marks that are filled in.
class MarkSheet {
  public:
    explicit MarkSheet(fs::path file) : file_(std::move(file)) {
        if (!fs::exists(file_)) return;
        table_ = read_text_table(file_);
        for (const char* name : kColumns)
            if (!table_.column(name))
                throw EnvironmentError(
                    "{}: the column \"{}\" is missing; restore the column, or move the file elsewhere", file_.string(),
                    name);
        for (std::size_t i = 0; i < table_.rows.size(); ++i) {
            const auto number = read_number<int>(cell(i, "number"));
            if (!number || *number < 1)
                throw EnvironmentError(
                    "{}, line {}: the column \"number\" must contain a positive integer, but \"{}\" was given",
                    file_.string(), table_.lines[i], cell(i, "number"));
            numbers_[cell(i, "submission")] = *number;
        }
    }

    const std::map<std::string, int>& numbers() const { return numbers_; }

    /// Adds rows for those who have none, and says which answers are the same; nothing else changes.
    void write(const std::vector<Answer>& answers, const std::vector<AnswerGroup>& groups, const std::string& check) {
        if (table_.names.empty()) table_.names.assign(std::begin(kColumns), std::end(kColumns));
        for (const Answer& answer : answers) {
            if (numbers_.contains(answer.submission)) continue;
            std::vector<std::string> row(table_.names.size());
            row[*table_.column("number")] = std::to_string(answer.number);
            row[*table_.column("submission")] = answer.submission;
            row[*table_.column("check")] = check;
            table_.rows.push_back(std::move(row));
        }
        std::map<std::string, std::string> same_as;
        for (const AnswerGroup& group : groups)
            for (const std::size_t member : group.members)
                if (group.members.size() > 1)
                    same_as[answers[member].submission] = std::to_string(answers[group.members[0]].number);
        for (std::vector<std::string>& row : table_.rows)
            row[*table_.column("same_as")] = same_as[row[*table_.column("submission")]];
        write_file_atomically(file_, csv_text(table_));
    }

  private:
    static constexpr const char* kColumns[] = {"number", "points", "reason", "same_as", "submission", "check"};

    const std::string& cell(std::size_t row, const char* column) const {
        return table_.rows[row][*table_.column(column)];
    }

    fs::path file_;
    TextTable table_;
    std::map<std::string, int> numbers_;
};

/// The page in two formats.
class AnswersPage {
  public:
    AnswersPage(const AnswerCollection& collection, const std::vector<AnswerGroup>& groups, const Lesson& lesson,
                const fs::path& marks, Isolation isolation)
        : answers_(collection.answers()),
          groups_(groups),
          asked_(collection.asked()),
          marks_(marks),
          formulas_(texts_of(collection), isolation) {
        const QuestionName& question = collection.question();
        title_ = question.number > 0 ? message_text(Message("{}: answers to question {}", lesson.slug, question.number))
                                     : fmt::format("{}: {}", lesson.slug, *question.titles.begin());
        for (const Answer& answer : answers_)
            if (answer.text.empty()) empty_.push_back(std::to_string(answer.number));
    }

    std::string markdown() const {
        std::string text = fmt::format("# {}\n\n{}\n\n", title_, message_text(explanation()));
        if (!asked_.text.empty()) text += quoted(asked_.text);
        if (!asked_.solution.empty())
            text += fmt::format("## {}\n\n{}", message_text(Message("Reference solution")), quoted(asked_.solution));
        for (const AnswerGroup& group : groups_) {
            text += fmt::format("## {}\n\n{}", message_text(heading(group)), quoted(answers_[group.members[0]].text));
            for (const std::string& note : notes(group)) text += "- " + note + "\n";
            text += fmt::format("\n{}\n\n", message_text(Message("Points: ____  Reason: ____")));
        }
        if (!empty_.empty()) text += message_text(without_answer()) + "\n";
        return text;
    }

    std::string html() const {
        std::string rows;
        for (const AnswerGroup& group : groups_) {
            std::string list;
            for (const std::string& note : notes(group)) list += "<li>" + escaped_html(note) + "</li>";
            if (!list.empty()) list = "<ul>" + list + "</ul>";
            rows += fmt::format(
                "<tr><th scope=\"row\">{}</th><td><div class=\"answer\">{}</div>{}</td><td></td></tr>\n",
                escaped_html(message_text(heading(group))), formulas_.html(answers_[group.members[0]].text), list);
        }
        std::string intro;
        if (!asked_.text.empty()) intro = fmt::format("<div class=\"answer\">{}</div>\n", formulas_.html(asked_.text));
        if (!asked_.solution.empty())
            intro +=
                fmt::format("<details><summary>{}</summary><div class=\"answer\">{}</div></details>\n",
                            escaped_html(message_text(Message("Reference solution"))), formulas_.html(asked_.solution));
        return fmt::format(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n"
            "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
            "<title>{}</title>\n<style>\nbody{{font-family:sans-serif;max-width:70em;margin:1em auto;padding:0 1em}}\n"
            "table{{border-collapse:collapse;width:100%}}\nth,td{{border:1px solid;padding:.5em;vertical-align:top;"
            "text-align:left}}\nth[scope=row]{{width:9em}}\n.answer{{white-space:pre-wrap;overflow-wrap:anywhere}}\n"
            "</style></head>\n<body>\n<h1>{}</h1>\n<p>{}</p>\n{}<table>\n<thead><tr><th>{}</th><th>{}</th>"
            "<th>{}</th></tr></thead>\n<tbody>\n{}</tbody>\n</table>\n<p>{}</p>\n</body>\n</html>\n",
            escaped_html(title_), escaped_html(title_), escaped_html(message_text(explanation())), intro,
            escaped_html(message_text(Message("number"))), escaped_html(message_text(Message("answer"))),
            escaped_html(message_text(Message("points, reason"))), rows,
            empty_.empty() ? "" : escaped_html(message_text(without_answer())));
    }

  private:
    static std::vector<std::string> texts_of(const AnswerCollection& collection) {
        std::vector<std::string> texts = {collection.asked().text, collection.asked().solution};
        for (const Answer& answer : collection.answers()) texts.push_back(answer.text);
        return texts;
    }

    Message explanation() const {
        return Message(
            "Submissions have numbers instead of names. Enter points and reasons in {}. Then copy the columns "
            "\"submission\" (as \"who\"), \"check\", \"points\" and \"reason\" into marks.csv of the results folder.",
            marks_.filename().string());
    }

    Message heading(const AnswerGroup& group) const {
        const int number = answers_[group.members[0]].number;
        if (group.members.size() == 1) return Message("Answer {}", number);
        const auto others = static_cast<std::int64_t>(group.members.size() - 1);
        return Message("Answer {} ({})", number,
                       plural(others, "identical in {} other submission", "identical in {} other submissions"));
    }

    /// The further members of a group, and by what they differ.
    std::vector<std::string> notes(const AnswerGroup& group) const {
        std::vector<std::string> notes, equal;
        for (std::size_t i = 1; i < group.members.size(); ++i) {
            const std::string number = std::to_string(answers_[group.members[i]].number);
            if (group.differences[i].empty())
                equal.push_back(number);
            else
                notes.push_back(message_text(Message("nearly identical: {} ({})", number, group.differences[i])));
        }
        if (!equal.empty()) notes.insert(notes.begin(), message_text(Message("identical: {}", listed(equal))));
        return notes;
    }

    Message without_answer() const { return Message("No answer from: {}.", listed(empty_)); }

    /// As a block of code, so that nothing in it is markup.
    static std::string quoted(const std::string& text) {
        std::size_t longest = 2, run = 0;
        for (const char c : text) {
            run = c == '`' ? run + 1 : 0;
            longest = std::max(longest, run);
        }
        const std::string fence(longest + 1, '`');
        return fmt::format("{0}text\n{1}\n{0}\n\n", fence, text);
    }

    const std::vector<Answer>& answers_;
    const std::vector<AnswerGroup>& groups_;
    const AskedQuestion& asked_;
    fs::path marks_;
    TypesetFormulas formulas_;
    std::string title_;
    std::vector<std::string> empty_;  ///< numbers
};

}  // namespace

AnswersOutcome collect_answers(const AnswersRequest& request) {
    AnswersOutcome outcome;
    AnswerCollection collection(request);
    const std::string stem = "answers-" + slug_of(collection.question());
    outcome.page = request.out / (stem + ".html");
    outcome.text = request.out / (stem + ".md");
    outcome.marks = request.out / (stem + ".csv");
    MarkSheet sheet(outcome.marks);
    collection.read(outcome);
    collection.number(sheet.numbers());
    const std::vector<AnswerGroup> groups = collection.groups();
    outcome.groups = groups.size();
    fs::create_directories(request.out);
    sheet.write(collection.answers(), groups, request.check.empty() ? slug_of(collection.question()) : request.check);
    const AnswersPage page(collection, groups, request.lesson, outcome.marks, request.isolation);
    write_file_atomically(outcome.text, page.markdown());
    write_file_atomically(outcome.page, page.html());
    return outcome;
}

}  // namespace dynlab::inline course
