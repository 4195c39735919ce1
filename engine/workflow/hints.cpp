#include "workflow/hints.h"

#include <optional>

#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/text/read_number.h"

namespace dynlab::inline workflow {
namespace {

class HintsReader {
  public:
    explicit HintsReader(const std::filesystem::path& file) : file_(file) {}

    Hints read(const std::string& text) {
        for (const std::string& line : lines_of(text)) {
            ++number_;
            if (is_blank(line)) continue;
            if (line.starts_with('#'))
                read_heading(line);
            else if (line.starts_with(' '))
                read_more(line);
            else
                read_stage(line);
        }
        return std::move(hints_);
    }

  private:
    [[noreturn]] void fail(const Message& what) const { throw DocumentError(Place{file_, number_}, what); }

    void read_heading(const std::string& line) {
        const std::string begin = "# Question ";
        const auto question =
            line.starts_with(begin) ? read_number<int>(trimmed(line.substr(begin.size()))) : std::nullopt;
        if (!question) fail(Message("write the heading of hints as \"# Question 4\", not \"{}\"", trimmed(line)));
        const auto [place, is_new] = hints_.try_emplace(*question);
        if (!is_new)
            fail(Message("question {} already has hints; put all hints of the question below one heading", *question));
        stages_ = &place->second;
    }

    void read_stage(const std::string& line) {
        if (!stages_) fail(Message("hints must be below a heading such as \"# Question 4\""));
        const std::size_t point = line.find(". ");
        const std::size_t next = stages_->size() + 1;
        if (point == std::string::npos || read_number<int>(line.substr(0, point)) != static_cast<int>(next))
            fail(Message(
                "expected hint {}, starting with \"{}. \", not \"{}\" (indent the continuation lines of a hint)", next,
                next, trimmed(line).substr(0, 30)));
        stages_->push_back(trimmed(line.substr(point + 2)));
    }

    void read_more(const std::string& line) {
        if (!stages_ || stages_->empty())
            fail(Message(
                "this line is indented, but no hint starts before it; start a hint with \"1. \", or remove the line"));
        stages_->back() += " " + trimmed(line);
    }

    std::filesystem::path file_;
    Hints hints_;
    std::vector<std::string>* stages_ = nullptr;
    int number_ = 0;
};

}  // namespace

Hints hints_in(const std::string& text, const std::filesystem::path& name) {
    return HintsReader(name).read(text);
}

Hints read_hints(const std::filesystem::path& file) {
    return hints_in(read_text(file), file);
}

HintsSeen::HintsSeen(std::string lesson, int question)
    : entry_(EntryName("hints", "hints seen").add(lesson).add(std::to_string(question)).text()) {}

bool HintsSeen::lasting() const {
    return Cache().lasting();
}

std::size_t HintsSeen::count() const {
    const auto known = Cache().load_entry(entry_);
    const auto number = known ? read_number<int>(*known) : std::nullopt;
    return number && *number > 0 ? static_cast<std::size_t>(*number) : 0;
}

void HintsSeen::save_entry(std::size_t count) const {
    Cache().save_entry(entry_, std::to_string(count));
}

}  // namespace dynlab::inline workflow
