#include "documents/script_header.h"

#include <algorithm>
#include <set>

#include "base/languages.h"
#include "documents/bibliography.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/spelling.h"
#include "platform/text/read_number.h"

namespace dynlab::inline documents {
namespace {

const std::vector<std::string> kHeaderKeys = {"title",    "subtitle", "lesson",  "template",
                                              "language", "seed",     "answers", "bibliography"};

/// Lines of the header, their comment signs taken off, read into a ScriptHeader: scalars and one level of names.
class HeaderReader {
  public:
    HeaderReader(const std::filesystem::path& file, ScriptHeader& header) : file_(file), header_(header) {}

    void read_line(const std::string& line, int number) {
        number_ = number;
        if (is_blank(line)) return;
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) fail(Message("\"{}\" does not have the form \"key: value\"", trimmed(line)));
        const std::string written = trimmed(line.substr(0, colon));
        const std::string key = written == "lang" ? "language" : written;  // as report.md has it
        const std::string value = unquoted(trimmed(line.substr(colon + 1)));
        const bool nested = line[0] == ' ' || line[0] == '\t';
        if (nested)
            read_answer(written, value);
        else
            read_key(key, value);
    }

  private:
    [[noreturn]] void fail(const Message& what) const {
        throw DocumentError(Place{file_, number_}, Message("script header: {}", what));
    }

    std::string unquoted(const std::string& value) const {
        if (value.empty() || (value[0] != '"' && value[0] != '\'')) return value;
        if (value.size() < 2 || value.back() != value[0])
            fail(Message("the quotation mark of {} is not closed", value));
        return value.substr(1, value.size() - 2);
    }

    void read_answer(const std::string& name, const std::string& kind) {
        if (!in_answers_) fail(Message("\"{}\" is indented; only names below \"answers:\" may be indented", name));
        if (!is_name(name))
            fail(
                Message("\"{}\" cannot be the name of an answer; a name must start with a letter or _ and contain only "
                        "letters, digits, _ and -",
                        name));
        if (kind.empty()) fail(Message("answer \"{}\" needs a kind, such as \"{}: number\"", name, name));
        if (std::find(answer_kinds().begin(), answer_kinds().end(), kind) == answer_kinds().end())
            fail(Message("answer \"{}\" has the unknown kind \"{}\"; the kinds are {}", name, kind,
                         listed(answer_kinds())));
        if (!declared_.insert(name).second) fail(Message("answer \"{}\" is declared twice", name));
        header_.answers.push_back({name, kind});
    }

    void read_key(const std::string& key, const std::string& value) {
        for (const std::string& known : seen_)
            if (known == key) fail(Message("key \"{}\" occurs twice", key));
        seen_.push_back(key);
        in_answers_ = key == "answers";
        if (in_answers_) {
            if (!value.empty())
                fail(Message("\"answers:\" must be followed by lines \"  name: kind\", not by a value"));
            return;
        }
        std::string* const text = text_field(key);
        if (!text && key != "seed") unknown(key);
        if (value.empty()) fail(Message("key \"{}\" has no value; add a value, or remove the line", key));
        if (!text)
            header_.seed = seed_of(value);
        else
            *text = value;
        if (key == "language" && !is_language(value))
            fail(Message("unknown language \"{}\"; write {}", value, listed(languages(), Join::kOr)));
        if (key == "bibliography")
            if (const Message fault = fault_of_bibliography_name(value); !fault.empty()) fail(fault);
        if (key == "template" && !is_name(value))
            fail(Message("template \"{}\" must be the name of a template, such as lesson, without a folder or .md",
                         value));
    }

    std::string* text_field(const std::string& key) {
        if (key == "title") return &header_.title;
        if (key == "subtitle") return &header_.subtitle;
        if (key == "lesson") return &header_.lesson;
        if (key == "template") return &header_.template_name;
        if (key == "language") return &header_.language;
        if (key == "bibliography") return &header_.bibliography;
        return nullptr;
    }

    std::uint32_t seed_of(const std::string& value) const {
        if (const auto seed = read_number<std::uint32_t>(value)) return *seed;
        fail(Message("the seed \"{}\" must be a whole number from 0 to 4294967295", value));
    }

    [[noreturn]] void unknown(const std::string& key) const {
        const auto near = nearest_word(key, kHeaderKeys);
        fail(near ? Message("unknown key \"{}\"; did you mean \"{}\"?", key, *near)
                  : Message("unknown key \"{}\"; the keys are {}", key, listed(kHeaderKeys)));
    }

    const std::filesystem::path& file_;
    ScriptHeader& header_;
    std::vector<std::string> seen_;
    std::set<std::string> declared_;  // answers
    bool in_answers_ = false;
    int number_ = 0;
};

constexpr std::size_t kMaxMistakes = 10;

bool is_fence(const std::string& line) {
    return line.starts_with("--") && trimmed(line.substr(2)) == "---";
}

}  // namespace

const std::vector<std::string>& answer_kinds() {
    static const std::vector<std::string> kinds = {"number", "text",  "truth",    "vector", "matrix",
                                                   "data",   "model", "response", "table"};
    return kinds;
}

std::size_t read_script_header(const std::vector<std::string>& lines, const std::filesystem::path& file,
                               ScriptHeader& header) {
    const std::size_t first = !lines.empty() && lines[0].starts_with("#!") ? 1 : 0;
    if (lines.size() <= first || !is_fence(lines[first])) return 0;
    HeaderReader reader(file, header);
    MessageList mistakes{{}, Join::kLines};  // reported together, at the place of the first
    Place place;
    for (std::size_t i = first + 1; i < lines.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        if (is_fence(lines[i])) {
            if (!mistakes.items.empty()) throw DocumentError(place, Message("{}", mistakes));
            return i + 1;
        }
        if (!lines[i].starts_with("--"))
            throw DocumentError(Place{file, number},
                                Message("the script header is not closed; add a line \"-- ---\" before this line"));
        std::string content = lines[i].substr(2);
        if (content.starts_with(' ')) content.erase(0, 1);
        try {
            reader.read_line(content, number);
        } catch (const DocumentError& error) {
            if (mistakes.items.empty()) place = error.place();
            if (mistakes.items.size() < kMaxMistakes)
                mistakes.items.push_back(mistakes.items.empty() ? error.sentence() : error.message());
        }
    }
    throw DocumentError(Place{file, static_cast<int>(first) + 1},
                        Message("the script header is not closed; add a line \"-- ---\" after the header"));
}

std::string language_of_script(std::string_view source) {
    constexpr std::string_view kKeys[] = {"language:", "lang:"};
    for (const std::string_view line : lines_with_ends(source)) {
        if (line.starts_with("#!")) continue;
        if (!line.starts_with("--")) break;
        const std::string entry = trimmed(line.substr(2));
        for (const std::string_view key : kKeys) {
            if (!entry.starts_with(key)) continue;
            const std::string language = trimmed(std::string_view(entry).substr(key.size()));
            return is_language(language) ? language : "";
        }
    }
    return "en";
}

}  // namespace dynlab::inline documents
