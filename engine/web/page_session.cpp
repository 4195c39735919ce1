#include <memory>

#include "app/live/state_questions.h"
#include "base/languages.h"
#include "data_io/values/json_values.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/lint/lint.h"
#include "web/page_bench.h"
#include "web/page_checks.h"
#include "web/page_world.h"

// The engine of a page: a worker calls the functions at the end of this file with JSON and passes on the JSON that
// send() gives it.
namespace dynlab::inline web {
namespace {

constexpr std::uint64_t kMaxKeptBytes = 64u << 20;  // bytes of results of long calls

struct PageSession {
    Cache cache{kMaxKeptBytes};
    CallCache calls{cache};
    std::unique_ptr<RunEnvironment> world;
};

PageSession& session() {
    static PageSession the_one;
    return the_one;
}

/// What the caller gets; it stays until the next call.
const char* answer(std::string text) {
    static std::string kept;
    kept = std::move(text);
    return kept.c_str();
}

/// The world of the last run; before one, that of an empty script.
RunEnvironment& world() {
    PageSession& page = session();
    if (!page.world)
        page.world =
            std::make_unique<RunEnvironment>(page.calls, parse_percent_script("", "script.lua"), PageRunOrder());
    return *page.world;
}

struct Linted {
    int line = 1, column = 1;
    std::string kind, text;
};
DYNLAB_DESCRIBE(Linted, line, column, kind, text)

struct Question {
    std::string question, text;
    std::size_t cursor = 0;
};
DYNLAB_DESCRIBE(Question, question, text, cursor)

template <class Work>
void carry_out(Work work) {
    try {
        work();
    } catch (const std::bad_alloc&) {
        send({.kind = "failed",
              .error = PageError{message_text(Message("the browser does not provide more memory for this page; use "
                                                      "less data, or run the script with the installed dynlab"))}});
    } catch (const std::exception& error) {
        send({.kind = "failed", .error = PageError{error.what()}});
    }
}

}  // namespace
}  // namespace dynlab::inline web

using namespace dynlab;

extern "C" {

/// For a web::PageRunOrder, the most parts of the script behind which it can begin where memory of the last run is put
/// back; -1 where it goes on from the memory as it is.
int dynlab_lasting_parts(const char* order_json) {
    const auto& last = session().world;
    try {
        if (!last) return 0;
        const auto order = from_json<web::PageRunOrder>(order_json);
        const PercentScript script = parse_percent_script(order.source, order.file);
        return last->goes_on(script, order) ? -1 : static_cast<int>(last->lasting_parts(script, order));
    } catch (const std::exception&) {
        return 0;  // dynlab_begin_run() says why
    }
}

/// web::PageRunOrder; `put_back`: in memory of the last run. Then dynlab_run_part() runs it; false where it cannot.
bool dynlab_begin_run(const char* order_json, bool put_back) {
    bool can_run = false;
    carry_out([&] {
        const auto order = from_json<web::PageRunOrder>(order_json);
        PercentScript script = parse_percent_script(order.source, order.file);
        PageSession& page = session();
        if (!page.world || !page.world->goes_on(script, order)) {
            page.world.reset();  // before the next: memory for one
            page.world = std::make_unique<RunEnvironment>(page.calls, script, order);
        }
        if (put_back) page.world->forget_drawn();
        page.world->begin(std::move(script), order);
        can_run = true;
    });
    return can_run;
}

/// Runs the next part of the script: the number of parts that have run; 0 when the run has ended. Everything else is
/// news.
int dynlab_run_part() {
    std::size_t parts = 0;
    carry_out([&] { parts = world().run_part(); });
    return static_cast<int>(parts);
}

/// web::ChecksOrder. What comes of it is news.
void dynlab_check(const char* order_json) {
    carry_out([&] { web::try_checks_of_page(from_json<web::ChecksOrder>(order_json)); });
}

/// Makes the pack of a folder as a file.
void dynlab_pack(const char* folder, const char* file) {
    carry_out([&] { web::pack_of_page(folder, file); });
}

/// An answer of app/live/state_questions.h, from the state behind the last run.
const char* dynlab_ask(const char* question_json) {
    const auto asked = from_json<web::Question>(question_json);
    app::RunOrder question;
    question.question = asked.question, question.text = asked.text, question.cursor = asked.cursor;
    return answer(app::answer_about_state(world().runtime().state(), question));
}

/// web::BenchOpening: a session of the workbench.
void dynlab_open_bench(const char* opening_json) {
    carry_out([&] { web::open_bench(from_json<web::BenchOpening>(opening_json), session().calls); });
}

/// The web::BenchReply to a web::BenchOrder.
const char* dynlab_ask_bench(const char* order_json) {
    return answer(json_of(web::answer_bench(from_json<web::BenchOrder>(order_json))));
}

/// web::work_for_bench(). Everything is news.
bool dynlab_work_for_bench() {
    bool goes_on = false;
    carry_out([&] { goes_on = web::work_for_bench(); });
    return goes_on;
}

/// The catalog of a language other than English, before anything is said in it.
void dynlab_add_language(const char* code, const char* po_text) {
    carry_out([&] { add_language(code, po_text); });
}

/// What will not work in a script, in the words of this language.
const char* dynlab_lint(const char* source, const char* file, const char* language) {
    const Reader reader{catalog_of(language), &option_name};
    std::vector<Linted> found;
    for (const LintIssue& issue : lint_script(source, file))
        found.push_back({issue.line, issue.column, issue.kind, message_text(issue.message, reader)});
    return answer(json_of(found));
}
}
