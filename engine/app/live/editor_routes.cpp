#include "app/live/editor_routes.h"

#include <optional>

#include "data_io/values/json_values.h"
#include "scripting/lint/lint.h"

namespace dynlab::inline app {
namespace {

constexpr const char* kJsonType = "application/json";

/// A name in a text.
struct EditorQuestion {
    std::string text;
    std::size_t cursor = 0;  ///< in bytes
};
DYNLAB_DESCRIBE(EditorQuestion, text, cursor)

struct LintedText {
    std::string name, text;
};
DYNLAB_DESCRIBE(LintedText, name, text)

struct ShownMistake {
    int line = 1, column = 1;
    std::string kind, text;
};
DYNLAB_DESCRIBE(ShownMistake, line, column, kind, text)

/// The cell at a place runs, once the text is saved, where one is given.
struct SavedRun {
    std::optional<SourceText> source;
    RunPlace place;
};

template <Is<SavedRun> T, class V>
void describe(T& object, V& member) {
    auto& [source, place] = object;
    member.unless_empty("source", source);
    member("place", place);
}

std::vector<ShownMistake> mistakes_in(const LintedText& script, const LivePage& page) {
    std::vector<ShownMistake> mistakes;
    for (const LintIssue& found : lint_script(script.text, script.name))
        mistakes.push_back({found.line, found.column, found.kind, page.translated(found.message)});
    return mistakes;
}

}  // namespace

void serve_editor(WebServer& server, ScriptRunner& runner, LiveDocument& document, LivePage& page,
                  SourceFiles& sources) {
    for (const char* const question : {"complete", "help", "variables"})
        server.on_post("/" + std::string(question), [&runner, question](const PageRequest& asked) {
            RunOrder order;
            order.question = question;
            if (!asked.body.empty()) {
                const auto [text, cursor] = from_json<EditorQuestion>(asked.body);
                order.text = text, order.cursor = cursor;
            }
            const std::string answer = runner.ask(order);
            return PageReply{answer.empty() ? "null" : answer, kJsonType};
        });
    server.on_post("/lint", [&page](const PageRequest& asked) {
        return PageReply{json_of(mistakes_in(from_json<LintedText>(asked.body), page)), kJsonType};
    });
    server.on_post("/run", [&](const PageRequest& asked) {
        constexpr int kConflict = 409;
        const auto [source, place] = from_json<SavedRun>(asked.body);
        SourceFiles::Outcome outcome{true, {}};
        if (source) outcome = sources.save(*source);
        if (outcome.written) document.run_at(place);  // before the folder watch reports the save
        page.set_sources(sources.digests());
        return PageReply{json_of(outcome.now), kJsonType, outcome.written ? 200 : kConflict};
    });
}

}  // namespace dynlab::inline app
