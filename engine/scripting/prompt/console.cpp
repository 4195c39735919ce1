#include "scripting/prompt/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "base/reader.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/terminal/terminal_output.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/prompt/line_editor.h"
#include "scripting/prompt/prompt_session.h"
#include "scripting/runtime/placed_message.h"

namespace dynlab::inline scripting {
namespace {

constexpr const char* kPrompt = "dynlab> ";
constexpr const char* kContinuation = "   ...> ";
constexpr const char* kPipeName = "standard input";
constexpr int kInterruptsToExit =
    5;  // that many Ctrl-C during one statement end the program even if it does not listen

void show_figures(const StatementResult& result) {
    for (const auto& file : result.figures) print_now("figure: " + file.string() + '\n');
}

/// The message, and below it the calls that led to it.
Message with_calls(const RecordedError& error) {
    MessageList lines{{error.message}, Join::kLines};
    for (const RecordedCall& call : error.calls)
        lines.items.push_back(Message("  {}:{}: {}", call.file, call.line, call.what));
    return Message("{}", lines);
}

class Prompt {
  public:
    Prompt(const std::filesystem::path& figure_folder, const FigureListener& see)
        : session_(figure_folder, print_shown, see),
          history_(history_file()),
          editor_(history_, [this](const auto& line) { return session_.complete_end(pending_ + line); }) {}

    void run(const std::string& first) {
        end_when_terminated();
        if (!first.empty()) run(read_statement(first, shown_calls()));
        while (take_line(editor_.read(pending_.empty() ? kPrompt : kContinuation))) {
        }
    }

  private:
    using Ending = LineEditor::Line::Ending;

    /// False when the prompt is to be left.
    bool take_line(const LineEditor::Line& line) {
        if (line.ending != Ending::kEntered) {
            print_now("\n");
            const bool stays = line.ending == Ending::kGivenUp || !pending_.empty();
            pending_.clear();
            return stays;
        }
        const bool blank = line.text.find_first_not_of(" \t") == std::string::npos;
        if (blank && !pending_.empty() && !line.more_follows) {
            give_up();
            return true;
        }
        PromptStatement statement = read_statement(pending_ + line.text, shown_calls());
        if (statement.kind == PromptStatement::Kind::kIncomplete) {
            pending_ += line.text + '\n';
            return true;
        }
        pending_.clear();
        if (statement.kind == PromptStatement::Kind::kLeave) return false;
        if (statement.kind == PromptStatement::Kind::kReady) run(statement);
        return true;
    }

    void give_up() {
        print_now("(discarded: the statement was not complete)\n");
        pending_.clear();
    }

    void run(const PromptStatement& statement) {
        const std::string name = fmt::format("statement {}", ++count_);
        clear_interrupts(kInterruptsToExit);
        const StatementResult result = session_.run(statement, name);
        if (interrupted()) print_now("\n");  // the terminal has shown ^C
        clear_interrupts(kInterruptsToExit);
        show_figures(result);
        if (result.error) show_error(message_text(shown_message(*result.error, name, statement.source)));
    }

    /// With its location where that helps: the line of a longer statement, or that it was an earlier one's.
    static Message shown_message(const RecordedError& error, const std::string& name, const std::string& source) {
        const Message said = with_calls(error);
        if (error.line == 0) return said;
        if (error.file != name) return Message("{} (in line {} of {})", said, error.line, error.file);
        return source.find('\n') == std::string::npos ? said : Message("line {}: {}", error.line, said);
    }

    void show_error(const std::string& message) const {
        const std::string shown = terminal_text(message);
        print_now(in_color_ ? "\033[31m" + shown + "\033[0m\n" : shown + '\n');
    }

    static bool takes_color() {
        const char *no_color = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
        return (no_color == nullptr || *no_color == '\0') && terminal != nullptr && std::string(terminal) != "dumb";
    }

    PromptSession session_;
    CommandHistory history_;
    LineEditor editor_;
    std::string pending_;  ///< lines of a statement that is not complete yet
    unsigned count_ = 0;
    bool in_color_ = takes_color();
};

/// Runs a statement whose text was shifted to its line of the input. False when it failed.
bool run_from_pipe(PromptSession& session, const PromptStatement& statement, int first_line) {
    const StatementResult result = session.run(statement, kPipeName);
    show_figures(result);
    if (interrupted()) throw Interrupted();
    if (!result.error) return true;
    const auto& [message, file, line, calls] = *result.error;
    const PlacedMessage placed{with_calls(*result.error), line > 0 ? file : kPipeName, line > 0 ? line : first_line};
    std::cerr << "dynlab: " << placed.text() << std::endl;
    return false;
}

}  // namespace

void run_prompt(const std::filesystem::path& figure_folder, const std::string& greeting, const std::string& first,
                const FigureListener& see) {
    Prompt prompt(figure_folder, see);
    print_now(greeting);
    prompt.run(first);
}

bool run_statements_of(std::istream& input, const std::filesystem::path& figure_folder, const FigureListener& see) {
    PromptSession session(figure_folder, print_now, see);
    bool all_well = true;
    std::string pending;
    int first_line = 1, line_number = 0;
    for (bool at_end = false; !at_end;) {
        std::string line;
        at_end = !std::getline(input, line);
        ++line_number;
        if (line_number == 1) line = without_byte_order_mark(line);
        if (pending.empty()) {
            first_line = line_number;
            pending.assign(static_cast<std::size_t>(line_number - 1),
                           '\n');  // so that messages count the input's lines
        }
        pending += line + '\n';
        const PromptStatement statement = read_statement(pending, shown_calls());
        if (statement.kind == PromptStatement::Kind::kIncomplete && !at_end) continue;
        pending.clear();
        if (statement.kind == PromptStatement::Kind::kLeave) return all_well;
        if (statement.kind != PromptStatement::Kind::kEmpty)
            all_well = run_from_pipe(session, statement, first_line) && all_well;
    }
    return all_well;
}

}  // namespace dynlab::inline scripting
