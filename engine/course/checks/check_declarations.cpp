#include <algorithm>
#include <array>

#include "course/checks/check_functions.h"
#include "course/checks/check_session.h"
#include "platform/spelling.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/kind_phrases.h"

namespace dynlab::inline course {
namespace {

constexpr double kMaxPointCount = 1000;

/// Those that an instructor's own file can change.
constexpr std::array kChangedOptions = {
    OptionEntry{"id", ValueKind::kText, about("id of the check: letters, digits and _")},
    OptionEntry{"points",
                ValueKind::kNumber,
                about("maximum number of points for the check, greater than 0 and at most 1000"),
                {.initial = "1"}},
    OptionEntry{"about", ValueKind::kText, about("title of the check for students. Default: the id")},
    OptionEntry{"hint", ValueKind::kText, about("text shown to students who do not get all points of the check")}};
constexpr std::array kOwnOptions = {
    OptionEntry{"test", ValueKind::kAny, about("function(a, b) that checks the answers")},
    OptionEntry{
        "rerun", ValueKind::kText,
        about("data set on which the script is run again, or \"seed\" to run the script again with another seed")},
    OptionEntry{"document", ValueKind::kFlag, about("whether the check examines the report"), {.initial = "false"}},
    OptionEntry{"mistakes", ValueKind::kAny, about("list of {when = function, say = text}")},
    OptionEntry{"by_hand", ValueKind::kFlag, about("whether the instructor awards the points"), {.initial = "false"}},
    OptionEntry{"rubric", ValueKind::kText, about("guidance for the instructor who awards the points")}};
constexpr std::array kDeclaredPlantOptions = {
    OptionEntry{"name", ValueKind::kText, about("name of the data set")},
    OptionEntry{"record", ValueKind::kAny, about("function that simulates a data set")},
    OptionEntry{"truth", ValueKind::kAny, about("function that returns the true values of a data set")}};
constexpr OptionTable kChange[] = {kChangedOptions};
constexpr OptionTable kCheck[] = {kChangedOptions, kOwnOptions};
constexpr OptionTable kDeclaredPlantTables[] = {kDeclaredPlantOptions};

bool plain_id(const std::string& id) {
    return !id.empty() && std::ranges::all_of(id, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// The option's place in Lua's registry; 0 where it is not given and need not be.
int kept_option(const Options& options, const char* name, int type, const Message& owner, const Message& requested,
                bool needed) {
    lua_State* L = options.call().state();
    const int index = options.push(name);
    if (lua_isnil(L, index) && !needed) return 0;
    if (lua_type(L, index) != type)
        throw InvalidArgument("\"{}\" of {} must be {}, but it is {}", name, owner, requested,
                              what_it_is(lua_typename(L, lua_type(L, index))));
    lua_pushvalue(L, index);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

double points_option(const Options& options, const std::string& id, double fallback) {
    const double points = options.number("points", fallback);
    if (!(points > 0) || points > kMaxPointCount)
        throw InvalidArgument("the points of \"{}\" must be a number greater than 0 and at most 1000, but {} was given",
                              id, points);
    return points;
}

int check(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(call, 1, kCheck);
    DeclaredCheck check;
    check.id = options.text("id", "");
    if (!plain_id(check.id))
        throw InvalidArgument("the id of a check must consist of letters, digits and _, but \"{}\" was given",
                              check.id);
    for (const DeclaredCheck& other : session.checks)
        if (other.id == check.id)
            throw InvalidArgument("the check \"{}\" is declared twice; give each check a different id", check.id);
    check.points = points_option(options, check.id, 1);
    check.about = options.text("about", check.id);
    check.hint = options.text("hint", "");
    check.rerun = options.text("rerun", "");
    check.document = options.flag("document", false);
    check.by_hand = options.flag("by_hand", false);
    check.rubric = options.text("rubric", "");
    check.visible = session.visible_file;
    if (check.by_hand && (options.has("test") || options.has("rerun") || options.has("mistakes")))
        throw InvalidArgument("\"{}\" is marked manually and cannot have the fields 'test', 'rerun' or 'mistakes'",
                              check.id);
    if (!check.by_hand && options.has("rubric"))
        throw InvalidArgument("the check \"{}\" has a rubric and therefore needs by_hand = true", check.id);
    const Message owner = Message("the check \"{}\"", check.id);
    check.test = kept_option(options, "test", LUA_TFUNCTION, owner, Message("a function"), !check.by_hand);
    check.mistakes =
        kept_option(options, "mistakes", LUA_TTABLE, owner, Message("a list of {when = function, say = text}"), false);
    session.checks.push_back(std::move(check));
    return 0;
}

/// The check of that id, declared before.
std::vector<DeclaredCheck>::iterator declared(CheckSession& session, const std::string& id) {
    const auto found = std::ranges::find(session.checks, id, &DeclaredCheck::id);
    if (found != session.checks.end()) return found;
    std::vector<std::string> ids;
    for (const DeclaredCheck& check : session.checks) ids.push_back(check.id);
    const auto near = nearest_word(id, ids);
    if (near) throw InvalidArgument("unknown check \"{}\"; did you mean \"{}\"?", id, *near);
    throw InvalidArgument("unknown check \"{}\"; the checks are {}", id, listed(ids));
}

int change_check(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(call, 1, kChange);
    DeclaredCheck& check = *declared(session, options.text("id", ""));
    check.points = points_option(options, check.id, check.points);
    check.about = options.text("about", check.about);
    check.hint = options.text("hint", check.hint);
    return 0;
}

int drop_check(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    session.checks.erase(declared(session, call.text(1, "id")));
    return 0;
}

int declare_plant(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(call, 1, kDeclaredPlantTables);
    const std::string name = options.text("name", "");
    if (!plain_id(name))
        throw InvalidArgument(
            "the name of a simulated plant and of its data set must consist of letters, digits and _, but \"{}\" "
            "was given",
            name);
    if (session.plants.contains(name))
        throw InvalidArgument("the simulated plant \"{}\" is declared twice; give each plant a different name", name);
    const Message owner = Message("the simulated plant \"{}\"", name);
    session.plants[name] = {kept_option(options, "record", LUA_TFUNCTION, owner, Message("a function"), true),
                            kept_option(options, "truth", LUA_TFUNCTION, owner, Message("a function"), false)};
    return 0;
}

constexpr const char* kDeclarations = "checks";
constexpr std::array kDeclarationFunctions = {
    FunctionEntry{"check", kDeclarations, "check{options}", "declares a check", guarded<check>, kCheck},
    FunctionEntry{"change_check", kDeclarations, "change_check{options}",
                  "changes points or words of a check that was declared before", guarded<change_check>, kChange},
    FunctionEntry{"drop_check", kDeclarations, "drop_check(id)", "removes a check that was declared before",
                  guarded<drop_check>},
    FunctionEntry{"declare_plant", kDeclarations, "declare_plant{options}",
                  "declares a simulated plant for hidden data sets and reruns", guarded<declare_plant>,
                  kDeclaredPlantTables},
};

}  // namespace

FunctionEntries check_declarations() {
    return kDeclarationFunctions;
}

}  // namespace dynlab::inline course
