#include "course/issues/issues_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "course/issues/issue_description.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "data_io/values/json_values.h"
#include "platform/text/plain_words.h"

namespace dynlab::inline course {
namespace {

constexpr const char *kBold = "\033[1m", *kRed = "\033[31m", *kYellow = "\033[33m", *kGreen = "\033[32m",
                     *kFaint = "\033[2m", *kPlain = "\033[0m";
constexpr std::size_t kLineWidth = 100;

/// Words of a sentence on lines of at most kLineWidth that begin with `first` and then with as many spaces.
std::string wrapped(const std::string& sentence, const std::string& first) {
    const std::string indent(first.size(), ' ');
    std::string result, line = first;
    bool empty = true;
    for (std::size_t start = 0; start < sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', start), sentence.size());
        const std::string word = sentence.substr(start, end - start);
        if (!empty && line.size() + 1 + word.size() > kLineWidth) {
            result += line + "\n";
            line = indent;
            empty = true;
        }
        line += (empty ? "" : " ") + word;
        empty = false;
        start = end + 1;
    }
    return result + line + "\n";
}

/// As the page of a document counts them (app/page/findings.js).
enum class Counted { kAnswers, kRules, kHints, kChecks };
Counted counted_as(const Issue& issue) {
    if (issue.id == "answer-missing") return Counted::kAnswers;
    if (issue.id == "check-failed") return Counted::kChecks;
    return issue.severity == Severity::kRule ? Counted::kRules : Counted::kHints;
}

class Writer {
  public:
    Writer(bool in_color, const Reader& reader) : in_color_(in_color), reader_(reader) {}

    std::string words(const Message& message) const { return message_text(message, reader_); }

    std::string styled(const char* style, const std::string& text) const {
        return in_color_ ? style + text + kPlain : text;
    }

    /// Formats findings that count alike. Findings of one kind follow each other, and a shared remedy is printed once.
    std::string group(const CheckResult& result, Counted as, const char* style, const Message& title) const {
        std::vector<std::pair<std::string, std::vector<const Issue*>>> kinds;
        std::size_t count = 0;
        for (const Issue& issue : result.findings) {
            if (counted_as(issue) != as) continue;
            ++count;
            const auto same = [&issue](const auto& kind) { return kind.first == issue.id; };
            const auto known = std::find_if(kinds.begin(), kinds.end(), same);
            (known == kinds.end() ? kinds.emplace_back(issue.id, std::vector<const Issue*>()) : *known)
                .second.push_back(&issue);
        }
        if (count == 0) return "";
        std::string text = "\n" + styled(style, fmt::format("{} ({})", words(title), count)) + "\n";
        for (const auto& [id, findings] : kinds) text += "\n  " + styled(kBold, id) + "\n" + all_of(findings);
        return text;
    }

    std::string all_of(const std::vector<const Issue*>& findings) const {
        std::string text;
        for (std::size_t i = 0; i < findings.size(); ++i) {
            text += wrapped(printable(words(placed(*findings[i])), 2000), "    ");
            const bool last = i + 1 == findings.size() || findings[i + 1]->remedy != findings[i]->remedy;
            if (last) text += styled(kFaint, wrapped(printable(words(findings[i]->remedy), 2000), "    -> "));
        }
        return text;
    }

  private:
    static Message placed(const Issue& issue) {
        if (!issue.place.empty()) return Message("{}{}", issue.place + ": ", issue.what);
        return issue.page > 0 ? Message("page {}: {}", issue.page, issue.what) : issue.what;
    }

    bool in_color_;
    Reader reader_;
};

/// The work that is left before submission, in the words of its author: untouched questions are not errors.
std::vector<Message> still_to_do(const CheckResult& result) {
    std::int64_t answers = 0, questions = 0, problems = 0;
    for (const Issue& issue : result.findings) {
        const Counted counted = counted_as(issue);
        if (counted == Counted::kAnswers) ++answers;
        if (counted == Counted::kRules) ++(issue.id == "answer-open" ? questions : problems);
    }
    std::vector<Message> left;
    if (answers > 0) left.push_back(plural(answers, "{} answer to submit", "{} answers to submit"));
    if (questions > 0) left.push_back(plural(questions, "{} text to complete", "{} texts to complete"));
    if (problems > 0) left.push_back(plural(problems, "{} problem to fix", "{} problems to fix"));
    return left;
}

/// The outcome with nothing in its texts that a terminal would obey, and none of them too long.
CheckResult printable_result(CheckResult result) {
    constexpr std::size_t kMaxLength = 4000;
    for (std::string* text : {&result.subject, &result.template_name, &result.language})
        *text = printable(*text, kMaxLength);
    const auto shown = [](const std::string& text) { return printable(text, kMaxLength); };
    for (Message& part : result.checked) part = with_changed_text(part, shown);
    for (Issue& issue : result.findings) {
        issue.place = shown(issue.place);
        issue.what = with_changed_text(issue.what, shown);
        issue.remedy = with_changed_text(issue.remedy, shown);
    }
    return result;
}

}  // namespace

std::string issues_as_text(const CheckResult& result, bool in_color, const Reader& reader) {
    const Writer writer(in_color, reader);
    const std::string subject = printable(result.subject), name = printable(result.template_name);
    const auto with_parts = [&result](const Message& checked) {
        return result.checked.empty() ? checked : Message("{}: {}", checked, MessageList{result.checked});
    };
    const Message checked = with_parts(name.empty() ? Message("checked") : Message("checked as {}", name));
    if (result.findings.empty())
        return writer.words(Message("{}: {}; {}.", subject,
                                    writer.styled(kGreen, writer.words(Message("nothing to fix"))), checked)) +
               "\n";
    const auto rules = std::count_if(result.findings.begin(), result.findings.end(),
                                     [](const Issue& issue) { return issue.severity == Severity::kRule; });
    const std::string bold_subject = writer.styled(kBold, subject);
    std::string text;
    if (const std::vector<Message> left = still_to_do(result); !left.empty()) {
        text = writer.words(Message("{}: still to do: {}", bold_subject, MessageList{left, Join::kAnd})) + "\n";
        if (!result.checked.empty())
            text += writer.words(with_parts(name.empty() ? Message("Checked") : Message("Checked as {}", name))) + "\n";
    } else {
        text = writer.words(result.checked.empty() ? Message::verbatim(bold_subject)
                                                   : Message("{}: {}", bold_subject, checked)) +
               "\n";
    }
    text += writer.group(result, Counted::kAnswers, kRed, Message("Missing answers"));
    text += writer.group(result, Counted::kRules, kRed, Message("Rules violated"));
    text += writer.group(result, Counted::kHints, kYellow, Message("Hints"));
    text += writer.group(result, Counted::kChecks, kYellow, Message("Checks of the lesson"));
    if (rules == 0) text += "\n" + writer.styled(kGreen, writer.words(Message("No rules are violated."))) + "\n";
    return text;
}

std::string issues_as_json(const CheckResult& result) {
    JsonWriter writer;
    writer.begin_object();
    write_members(writer, printable_result(result));
    writer.member("passed");
    writer.truth(result.passed());
    writer.end_object();
    return writer.dump(2) + "\n";
}

CheckResult issues_from_json(const std::string& json) {
    try {
        return from_json<CheckResult>(json);
    } catch (const ValueError& error) {
        throw EnvironmentError("the check results cannot be read: {}. Run dynlab check again", message_of(error));
    }
}

}  // namespace dynlab::inline course
