#include "scripting/prompt/line_editor.h"

#include <histedit.h>
#include <langinfo.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cwchar>
#include <string_view>

#include "numerics/error.h"
#include "platform/system_call.h"
#include "platform/terminal/terminal_output.h"

namespace dynlab::inline scripting {
namespace {

constexpr wchar_t kControlC = 3, kReplacement = 0xFFFD;
constexpr const char* kIndent = "    ";

/// Lines are UTF-8, also where the environment names no language.
void use_utf8() {
    std::setlocale(LC_CTYPE, "");
    if (std::string_view(nl_langinfo(CODESET)) != "UTF-8") std::setlocale(LC_CTYPE, "C.UTF-8");
}

/// Words in columns from top to bottom, as ls shows them.
void show_in_columns(const std::vector<std::string>& words) {
    std::size_t width = 0;
    for (const std::string& word : words) width = std::max(width, word.size() + 2);
    const std::size_t columns = std::max<std::size_t>(1, terminal_columns(STDOUT_FILENO, 80) / width);
    const std::size_t rows = (words.size() + columns - 1) / columns;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = row; i < words.size(); i += rows)
            std::printf("%-*s", i + rows < words.size() ? static_cast<int>(width) : 0, words[i].c_str());
        std::putchar('\n');
    }
}

}  // namespace

struct LineEditor::State {
    State(CommandHistory& kept_history, std::function<Completion(const std::string&)> completer);
    ~State();

    static State& of(EditLine* editor);
    static char* show_prompt(EditLine* editor) { return of(editor).prompt.data(); }
    static int next_character(EditLine* editor, wchar_t* character);
    static unsigned char complete_at_cursor(EditLine* editor, int);
    static unsigned char stop_program(EditLine*, int);

    void bind_keys();
    void save_entry(const std::string& line);
    int decode(char byte, wchar_t* character);
    bool more_waits() const;

    CommandHistory& kept;
    std::function<Completion(const std::string&)> complete;
    History* history = history_init();
    EditLine* editor = nullptr;
    std::string prompt;
    std::mbstate_t decoding{};
    bool given_up = false, more_follows = false;
};

LineEditor::State::State(CommandHistory& kept_history, std::function<Completion(const std::string&)> completer)
    : kept(kept_history), complete(std::move(completer)) {
    use_utf8();
    editor = el_init("dynlab", stdin, stdout, stderr);
    if (editor == nullptr || history == nullptr) throw InvalidArgument("the terminal does not support line editing");
    HistEvent event;
    ::history(history, &event, H_SETSIZE, static_cast<int>(CommandHistory::kMaxLineCount));
    for (const std::string& line : kept.lines()) ::history(history, &event, H_ENTER, line.c_str());
    el_set(editor, EL_CLIENTDATA, this);
    el_set(editor, EL_PROMPT, show_prompt);
    el_set(editor, EL_HIST, ::history, history);
    el_set(editor, EL_SIGNAL, 1);
    el_set(editor, EL_GETCFN, next_character);
    bind_keys();
}

LineEditor::State::~State() {
    if (editor != nullptr) el_end(editor);  // gives the terminal back its modes
    if (history != nullptr) history_end(history);
}

LineEditor::State& LineEditor::State::of(EditLine* editor) {
    void* state = nullptr;
    el_get(editor, EL_CLIENTDATA, &state);
    return *static_cast<State*>(state);
}

void LineEditor::State::bind_keys() {
    el_set(editor, EL_EDITOR, "emacs");
    el_set(editor, EL_ADDFN, "dynlab-complete", "complete the word before the cursor", complete_at_cursor);
    el_set(editor, EL_ADDFN, "dynlab-stop", "return the terminal to the shell", stop_program);
    constexpr const char* kKeys[][2] = {
        {"^I", "dynlab-complete"},           {"^Z", "dynlab-stop"},
        {"^R", "em-inc-search-prev"},        {"\\e[A", "ed-search-prev-history"},
        {"\\eOA", "ed-search-prev-history"}, {"\\e[B", "ed-search-next-history"},
        {"\\eOB", "ed-search-next-history"}, {"\\e[H", "ed-move-to-beg"},
        {"\\e[1~", "ed-move-to-beg"},        {"\\e[F", "ed-move-to-end"},
        {"\\e[4~", "ed-move-to-end"},        {"\\e[3~", "ed-delete-next-char"},
        {"\\e[1;5C", "em-next-word"},        {"\\e[1;5D", "ed-prev-word"},
    };
    for (const auto& [key, action] : kKeys) el_set(editor, EL_BIND, key, action, nullptr);
    el_set(editor, EL_SETTY, "-d", "-isig", nullptr);  // while a line is edited, Ctrl-C and Ctrl-Z are keys like others
    el_source(editor, nullptr);                        // the user's own ~/.editrc
}

void LineEditor::State::save_entry(const std::string& line) {
    HistEvent event;
    if (kept.add(line)) ::history(history, &event, H_ENTER, kept.lines().back().c_str());
}

bool LineEditor::State::more_waits() const {
    pollfd terminal{STDIN_FILENO, POLLIN, 0};
    return ::poll(&terminal, 1, 0) > 0 && (terminal.revents & POLLIN) != 0;
}

/// 1 when the byte ends a character, 0 when more bytes must follow; bytes that are not UTF-8 give U+FFFD.
int LineEditor::State::decode(char byte, wchar_t* character) {
    const std::size_t length = std::mbrtowc(character, &byte, 1, &decoding);
    if (length == static_cast<std::size_t>(-2)) return 0;
    if (length != static_cast<std::size_t>(-1)) return 1;
    decoding = {};
    *character = kReplacement;
    return 1;
}

int LineEditor::State::next_character(EditLine* editor, wchar_t* character) {
    State& self = of(editor);
    for (char byte = 0;;) {
        const ssize_t count = retry_interrupted([&] { return ::read(STDIN_FILENO, &byte, 1); });
        if (count <= 0) return static_cast<int>(count);
        if (self.decode(byte, character) == 1) break;
    }
    self.given_up = *character == kControlC;
    self.more_follows = self.more_waits();
    return self.given_up ? -1 : 1;
}

unsigned char LineEditor::State::complete_at_cursor(EditLine* editor, int) {
    State& self = of(editor);
    const LineInfo* line = el_line(editor);
    const std::string before(line->buffer, line->cursor);
    if (self.more_follows || before.find_first_not_of(' ') == std::string::npos)
        return el_insertstr(editor, kIndent) == 0 ? CC_REFRESH : CC_ERROR;
    const Completion completion = self.complete(before);
    const std::string rest = completion.common_rest();
    if (!rest.empty()) return el_insertstr(editor, rest.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
    if (completion.candidates.size() < 2 && completion.note.empty()) return CC_REFRESH_BEEP;
    std::putchar('\n');
    if (!completion.note.empty()) std::printf("%s\n", completion.note.c_str());
    if (!completion.candidates.empty()) show_in_columns(completion.candidates);
    return CC_REDISPLAY;
}

unsigned char LineEditor::State::stop_program(EditLine*, int) {
    ::raise(SIGTSTP);  // libedit gives the terminal back meanwhile
    return CC_REDISPLAY;
}

LineEditor::LineEditor(CommandHistory& history, std::function<Completion(const std::string&)> complete)
    : state_(std::make_unique<State>(history, std::move(complete))) {}

LineEditor::~LineEditor() = default;

LineEditor::Line LineEditor::read(const std::string& prompt) {
    State& state = *state_;
    state.prompt = prompt;
    state.given_up = false;
    // Before the prompt is seen: a key pressed at once must find the terminal ready for it.
    el_set(state.editor, EL_PREP_TERM, 1);
    int count = 0;
    const char* typed = el_gets(state.editor, &count);
    if (state.given_up) {
        el_reset(state.editor);
        return {Line::Ending::kGivenUp, {}};
    }
    if (typed == nullptr || count <= 0) return {Line::Ending::kLeft, {}};
    std::string text(typed, static_cast<std::size_t>(count));
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    state.save_entry(text);
    return {Line::Ending::kEntered, std::move(text), state.more_follows};
}

}  // namespace dynlab::inline scripting
