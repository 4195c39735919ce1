#include "course/answers/written_answers.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <map>

#include "course/intake/owners.h"
#include "documents/percent_script.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "platform/text/read_number.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kShortLine = 12;  // characters: "$$", "---" and the like are in every text
constexpr std::size_t kMinWords = 8;    // of answers that may be nearly the same
constexpr double kNearlySame = 0.9;     // of the words of the longer one

std::string in_one_line(const std::string& text) {
    return fmt::format("{}", fmt::join(words_between_spaces(text), " "));
}

bool is_heading(const std::string& line) {
    static const RE2 kHeading(R"(#{1,6}\s+\S.*)", RE2::Latin1);
    return RE2::FullMatch(line, kHeading);
}

std::size_t level_of(const std::string& heading) {
    return heading.find_first_not_of('#');
}

/// The number of the question that a line begins; 0 for other lines.
int question_begun_by(const std::string& line) {
    static const RE2 kQuestion(R"(\s*(?:\*\*|#{1,6}\s+\**)Question\s+(\d{1,4})\b.*)", RE2::Latin1);
    int number = 0;
    RE2::FullMatch(line, kQuestion, &number);
    return number;
}

/// Whether a text cell is called after a question: q3, question-3, question_3.
bool is_cell_of(const std::string& id, int number) {
    static const RE2 kId(R"((?i)q(?:uestion)?[-_]?(\d{1,4})(?:[-_].*)?)", RE2::Latin1);
    int named = 0;
    return number > 0 && RE2::FullMatch(id, kId, &named) && named == number;
}

/// "Your answer:" of the line "-- *Your answer:*", in every language.
const std::vector<std::string>& answer_requests() {
    static const std::vector<std::string> kRequests = [] {
        std::vector<std::string> all;
        for (const char* language : {"en", "fr"}) {
            std::string mark = answer_marks(language).text;
            std::erase_if(mark, [](char c) { return c == '*' || c == '-'; });
            all.push_back(trimmed(mark));
        }
        return all;
    }();
    return kRequests;
}

/// The line without the request that the starter has there: an answer may follow it.
std::string without_request(const std::string& line) {
    const std::string text = trimmed(line);
    for (const std::string& request : answer_requests())
        for (const std::string& mark : {"*" + request + "*", "**" + request + "**", request})
            if (text.starts_with(mark)) return trimmed(std::string_view(text).substr(mark.size()));
    return line;
}

/// The paragraphs of a text, each with its lines.
std::vector<std::vector<std::string>> paragraphs_of(const std::vector<std::string>& lines) {
    std::vector<std::vector<std::string>> paragraphs;
    bool open = false;
    FencedCode code;
    for (const std::string& line : lines) {
        const bool fenced = code.holds(line);
        if (is_blank(line) && !fenced) {
            open = false;
            continue;
        }
        if (!open) paragraphs.emplace_back();
        paragraphs.back().push_back(line);
        open = true;
    }
    return paragraphs;
}

std::string joined(const std::vector<std::string>& lines, const char* between) {
    return fmt::format("{}", fmt::join(lines, between));
}

/// Collects the lines that belong to one question.
class AnswerReader {
  public:
    AnswerReader(const QuestionName& question, const GivenText& given) : question_(question), given_(given) {}

    std::vector<std::string> read(const std::vector<TextPart>& parts) {
        for (const TextPart& part : parts) {
            const bool own_cell = is_cell_of(part.id, question_.number);
            if (own_cell) collecting_ = true;
            FencedCode code;
            for (const std::string& line : part.lines) {
                const bool fenced = code.holds(line);
                if (!fenced && turns(line)) continue;
                if (collecting_) lines_.push_back(line);
            }
            if (collecting_) lines_.emplace_back();
            if (own_cell && !begun_by_line_) collecting_ = false;
        }
        return std::move(lines_);
    }

  private:
    /// Whether the line is one at which the question, or another one, begins or ends, and no part of the answer.
    bool turns(const std::string& line) {
        const bool heading = is_heading(line);
        if (question_.number == 0) return heading && turns_section(line);
        if (const int number = question_begun_by(line); number > 0) {
            collecting_ = begun_by_line_ = number == question_.number;
            return heading;  // else the question's own line, which is given
        }
        if (!heading || !given_.has_heading(line)) return false;
        collecting_ = false;
        return true;
    }

    bool turns_section(const std::string& heading) {
        if (question_.titles.contains(folded_title(heading))) {
            collecting_ = true;
            level_ = level_of(heading);
            return true;
        }
        if (!collecting_ || level_of(heading) > level_) return false;
        collecting_ = false;
        return true;
    }

    const QuestionName& question_;
    const GivenText& given_;
    bool collecting_ = false, begun_by_line_ = false;  // else by the name of its cell, with which it ends
    std::size_t level_ = 0;
    std::vector<std::string> lines_;
};

/// What must be equal in answers that are nearly the same: formulas, code and numbers, in their order.
std::string exact_parts_of(const std::string& text) {
    static const RE2 kExact(R"((\$[^$]*\$|`[^`]*`|\d+(?:[.,]\d+)?))", RE2::Latin1);
    std::string parts, part;
    re2::StringPiece rest(text);
    while (RE2::FindAndConsume(&rest, kExact, &part)) {
        std::erase_if(part, [](char c) { return c == ' ' || c == '\n'; });
        parts += part + '\n';
    }
    return parts;
}

/// An answer as it is compared.
struct ComparedAnswer {
    std::string text, exact;  ///< text: in one line
    std::vector<std::string> words;
    std::map<std::string, int> counts;

    explicit ComparedAnswer(const std::string& answer)
        : text(in_one_line(answer)), exact(exact_parts_of(answer)), words(name_words(answer)) {
        for (const std::string& word : words) ++counts[word];
    }
};

bool are_nearly_same(const ComparedAnswer& a, const ComparedAnswer& b) {
    const std::size_t longer = std::max(a.words.size(), b.words.size());
    if (std::min(a.words.size(), b.words.size()) < kMinWords || a.exact != b.exact) return false;
    std::size_t common = 0;
    for (const auto& [word, count] : a.counts)
        if (const auto found = b.counts.find(word); found != b.counts.end())
            common += static_cast<std::size_t>(std::min(count, found->second));
    return static_cast<double>(common) >= kNearlySame * static_cast<double>(longer);
}

/// "+very -quite": words that one has and the other has not.
std::string difference(const ComparedAnswer& first, const ComparedAnswer& other) {
    if (first.text == other.text) return "";
    const auto excess = [](const ComparedAnswer& a, const ComparedAnswer& b, const char* sign) {
        std::vector<std::string> words;
        for (const auto& [word, count] : a.counts) {
            const auto found = b.counts.find(word);
            if (count > (found == b.counts.end() ? 0 : found->second)) words.push_back(sign + word);
        }
        return words;
    };
    std::vector<std::string> words = excess(other, first, "+");
    for (std::string& word : excess(first, other, "-")) words.push_back(std::move(word));
    return words.empty() ? "±" : joined(words, " ");  // punctuation, or the order of words
}

}  // namespace

std::vector<TextPart> text_parts_of_script(const std::string& source) {
    static const RE2 kId(R"((?:^|\s)id=([\w-]+))", RE2::Latin1);
    std::vector<TextPart> parts;
    bool text = false;
    for (const std::string& line : lines_of(source)) {
        if (is_cell_marker(line)) {
            text = is_text_cell_marker(line);
            if (!text) continue;
            std::string id;
            RE2::PartialMatch(std::string(cell_marker_options(line)), kId, &id);
            parts.push_back({id, {}});
        } else if (text) {
            std::string content = trimmed(line);
            if (content == "-- BEGIN SOLUTION" || content == "-- END SOLUTION" || content.starts_with("-- STARTER:"))
                continue;
            if (content.starts_with("--")) content.erase(0, content.starts_with("-- ") ? 3 : 2);
            parts.back().lines.push_back(content);
        }
    }
    return parts;
}

std::vector<TextPart> text_parts_of_report(const std::string& markdown) {
    static const RE2 kHeader(R"((?s)^---\r?\n.*?\n(?:---|\.\.\.)[ \t]*(?:\r?\n|$))", RE2::Latin1),
        kComment(R"((?s)<!--.*?(?:-->|$))", RE2::Latin1);
    std::string text = markdown;
    RE2::Replace(&text, kHeader, "");
    RE2::GlobalReplace(&text, kComment, "");
    return {{"", lines_of(text)}};
}

void GivenText::add(const std::vector<TextPart>& parts) {
    for (const TextPart& part : parts) {
        for (const std::string& line : part.lines) {
            if (line.size() >= kShortLine) lines_.insert(in_one_line(line));
            if (is_heading(line) && headings_.insert(folded_title(line)).second) headings_list_.push_back(line);
            if (const int number = question_begun_by(line); number > 0) questions_.insert(number);
        }
        for (const std::vector<std::string>& paragraph : paragraphs_of(part.lines))
            paragraphs_.insert(in_one_line(joined(paragraph, "\n")));
    }
}

bool GivenText::has_line(const std::string& line) const {
    return line.size() >= kShortLine && lines_.contains(in_one_line(line));
}

bool GivenText::has_paragraph(const std::string& paragraph) const {
    return paragraphs_.contains(in_one_line(paragraph));
}

bool GivenText::has_heading(const std::string& line) const {
    return headings_.contains(folded_title(line));
}

std::string written_answer(const std::vector<TextPart>& parts, const QuestionName& question, const GivenText& given) {
    std::vector<std::string> kept;
    for (std::vector<std::string>& lines : paragraphs_of(AnswerReader(question, given).read(parts))) {
        if (given.has_paragraph(joined(lines, "\n"))) continue;
        // An answer may follow the question directly, without a blank line.
        while (!lines.empty() && given.has_line(lines.front())) lines.erase(lines.begin());
        for (std::string& line : lines) line = without_request(line);
        const std::string paragraph = trimmed(joined(lines, "\n"));
        if (!paragraph.empty()) kept.push_back(paragraph);
    }
    return joined(kept, "\n\n");
}

std::string folded_title(const std::string& heading) {
    static const RE2 kAttributes(R"(\s*\{[^{}]*\}\s*$)", RE2::Latin1), kNumber(R"(^#*\s*(?:\d+(?:\.\d+)*\.?\s+)?)");
    std::string title = heading;
    RE2::Replace(&title, kAttributes, "");
    RE2::Replace(&title, kNumber, "");
    return joined(name_words(title), " ");
}

std::vector<AnswerGroup> groups_of_answers(const std::vector<std::string>& answers) {
    std::vector<AnswerGroup> groups;
    std::vector<ComparedAnswer> firsts;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const ComparedAnswer answer(answers[i]);
        if (answer.text.empty()) continue;
        const auto same = [&](const auto& compare) {
            return static_cast<std::size_t>(std::ranges::find_if(firsts, compare) - firsts.begin());
        };
        std::size_t place = same([&](const ComparedAnswer& first) { return first.text == answer.text; });
        if (place == firsts.size())
            place = same([&](const ComparedAnswer& first) { return are_nearly_same(first, answer); });
        if (place == firsts.size()) {
            firsts.push_back(answer);
            groups.emplace_back();
        }
        groups[place].members.push_back(i);
        groups[place].differences.push_back(difference(firsts[place], answer));
    }
    return groups;
}

}  // namespace dynlab::inline course
