#include <algorithm>
#include <array>

#include "course/checks/check_functions.h"
#include "course/checks/check_session.h"
#include "platform/spelling.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline course {
namespace {

constexpr double kMostPoints = 1000;

bool plain_id(const std::string& id) {
    return !id.empty() && std::ranges::all_of(id, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// The option's place in Lua's registry; 0 where it is not given and need not be.
int kept_option(const Options& options, const char* name, int type, const Message& owner, const Message& wanted,
                bool needed) {
    lua_State* L = options.call().state();
    const int index = options.push(name);
    if (lua_isnil(L, index) && !needed) return 0;
    if (lua_type(L, index) != type) throw InvalidArgument("\"{}\" of {} must be {}", name, owner, wanted);
    lua_pushvalue(L, index);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

double points_option(const Options& options, const std::string& id, double fallback) {
    const double points = options.number("points", fallback);
    if (!(points > 0) || points > kMostPoints)
        throw InvalidArgument("the points of \"{}\" must be a number above 0, at most 1000", id);
    return points;
}

int check(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(
        call, 1, {"id", "points", "about", "test", "hint", "rerun", "document", "mistakes", "by_hand", "rubric"});
    DeclaredCheck check;
    check.id = options.text("id", "");
    if (!plain_id(check.id)) throw InvalidArgument("a check needs an id of letters, digits and _");
    for (const DeclaredCheck& other : session.checks)
        if (other.id == check.id) throw InvalidArgument("there are two checks \"{}\"", check.id);
    check.points = points_option(options, check.id, 1);
    check.about = options.text("about", check.id);
    check.hint = options.text("hint", "");
    check.rerun = options.text("rerun", "");
    check.document = options.flag("document", false);
    check.by_hand = options.flag("by_hand", false);
    check.rubric = options.text("rubric", "");
    check.visible = session.visible_file;
    if (check.by_hand && (options.has("test") || options.has("rerun") || options.has("mistakes")))
        throw InvalidArgument("\"{}\" is marked by hand: it has no test, rerun or mistakes", check.id);
    if (!check.by_hand && options.has("rubric"))
        throw InvalidArgument("\"{}\" has a rubric: it needs by_hand = true", check.id);
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
    if (near) throw InvalidArgument("there is no check \"{}\"; did you mean \"{}\"?", id, *near);
    throw InvalidArgument("there is no check \"{}\"; there are {}", id, listed(ids));
}

int change_check(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(call, 1, {"id", "points", "about", "hint"});
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

int declare_rig(Call& call) {
    call.at_most(1);
    CheckSession& session = call.owner<CheckSession>();
    const Options options(call, 1, {"name", "record", "truth"});
    const std::string name = options.text("name", "");
    if (!plain_id(name)) throw InvalidArgument("a rig needs a name of letters, digits and _: that of its data set");
    if (session.rigs.contains(name)) throw InvalidArgument("there are two rigs \"{}\"", name);
    const Message owner = Message("the rig \"{}\"", name);
    session.rigs[name] = {kept_option(options, "record", LUA_TFUNCTION, owner, Message("a function"), true),
                          kept_option(options, "truth", LUA_TFUNCTION, owner, Message("a function"), false)};
    return 0;
}

constexpr const char* kDeclarations = "checks";
constexpr std::array kDeclarationFunctions = {
    FunctionEntry{
        "check", kDeclarations,
        "check{id =, points =, about =, test =, hint =, rerun =, document =, mistakes =, by_hand =, rubric =}",
        "declares a check", guarded<check>},
    FunctionEntry{"change_check", kDeclarations, "change_check{id =, points =, about =, hint =}",
                  "gives a check that was declared before other points or words", guarded<change_check>},
    FunctionEntry{"drop_check", kDeclarations, "drop_check(id)", "takes a check away that was declared before",
                  guarded<drop_check>},
    FunctionEntry{"declare_rig", kDeclarations, "declare_rig{name =, record =, truth =}",
                  "declares an apparatus for hidden records and reruns", guarded<declare_rig>},
};

}  // namespace

FunctionEntries check_declarations() {
    return kDeclarationFunctions;
}

}  // namespace dynlab::inline course
