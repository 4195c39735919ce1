#include "course/grading/grading_memory.h"

#include <vector>

#include "course/grading/grade_folder.h"
#include "course/grading/kept_stages.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kMemoryFile[] = "grading.json";

/// An input that marks depend on: as it was named, a hash of its content, and where it is; empty where it was not
/// given.
struct RememberedInput {
    std::string name, hash, path;
};

/// What a folder of results was made with.
struct GradingMemory {
    std::string lesson;
    RememberedInput lesson_checks, checks, secret, roster, owners, deadlines;
    std::string keep, timezone, isolation;
    int timeout = 0;
    std::string times;  ///< where the times of receipt are; they may change, as all penalties are computed each time
};

DYNLAB_DESCRIBE(RememberedInput, name, hash, path)

template <Is<GradingMemory> T, class V>
void describe(T& object, V& member) {
    auto& [lesson, lesson_checks, checks, secret, roster, owners, deadlines, keep, timezone, isolation, timeout,
           times] = object;
    member("lesson", lesson), member("lesson_checks", lesson_checks), member("checks", checks);
    member("secret", secret), member("roster", roster), member("owners", owners), member("deadlines", deadlines);
    member("keep", keep), member("timezone", timezone), member("isolation", isolation), member("timeout", timeout);
    member.unless_empty("times", times);
}

RememberedInput remembered_file(const std::optional<fs::path>& file) {
    if (!file) return {};
    return {file->string(), sha256_of_file(*file), fs::absolute(*file).lexically_normal().string()};
}

/// Of all files in a folder and below it.
RememberedInput remembered_folder(const std::optional<fs::path>& folder) {
    if (!folder || !fs::is_directory(*folder)) return {};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(*folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    return {folder->string(), hash_of_files(std::move(files), *folder),
            fs::absolute(*folder).lexically_normal().string()};
}

/// Its file's own hash would help to guess it.
RememberedInput remembered_secret(const fs::path& file, const std::string& text) {
    if (text.empty()) return {};
    return {"--secret", sha256_of("dynlab grade:" + text), fs::absolute(file).lexically_normal().string()};
}

/// Nothing where there is none, or where it cannot be read.
std::optional<GradingMemory> read_memory(const fs::path& out) {
    if (!fs::exists(out / kMemoryFile)) return {};
    try {
        return from_json<GradingMemory>(read_file(out / kMemoryFile));
    } catch (const EnvironmentError&) {
        return {};
    }
}

Message shown_input(const RememberedInput& input) {
    return input.hash.empty() ? Message("none") : Message("{}", input.name);
}

Message shown_zone(const std::string& zone) {
    return zone.empty() ? Message("this machine's") : Message("{}", zone);
}

Message difference(const Message& what, const RememberedInput& then, const RememberedInput& now) {
    if (then.name == now.name && !then.hash.empty() && !now.hash.empty())
        return Message("{} ({} has changed)", what, now.name);
    return Message("{} ({} then, {} now)", what, shown_input(then), shown_input(now));
}

/// What differs so that marks of both kinds would stand side by side, a clause each: "the checks (own1 then, none
/// now)".
std::vector<Message> differences_of(const GradingMemory& then, const GradingMemory& now, bool all_of_the_class) {
    std::vector<Message> clauses;
    const auto compare = [&](const Message& what, const RememberedInput& a, const RememberedInput& b, bool always) {
        const bool gone = !a.hash.empty() && b.hash.empty();
        if (a.hash != b.hash && (always || gone || !all_of_the_class)) clauses.push_back(difference(what, a, b));
    };
    compare(Message("the lesson's checks"), then.lesson_checks, now.lesson_checks, true);
    compare(Message("your own checks"), then.checks, now.checks, true);
    compare(Message("the secret"), then.secret, now.secret, true);
    compare(Message("the roster"), then.roster, now.roster, false);
    compare(Message("the list of owners"), then.owners, now.owners, false);
    compare(Message("the deadlines"), then.deadlines, now.deadlines, true);
    if (then.keep != now.keep)
        clauses.push_back(Message("which hand-in counts ({} then, {} now)", then.keep, now.keep));
    if (then.timezone != now.timezone)
        clauses.push_back(
            Message("the time zone ({} then, {} now)", shown_zone(then.timezone), shown_zone(now.timezone)));
    return clauses;
}

/// Seen from here.
std::string path_from_here(const RememberedInput& input) {
    return input.path.empty() ? std::string() : fs::proximate(input.path).string();
}

}  // namespace

std::optional<RememberedOptions> remembered_options(const fs::path& out) {
    const std::optional<GradingMemory> then = read_memory(out);
    if (!then) return {};
    return RememberedOptions{then->lesson,
                             path_from_here(then->checks),
                             path_from_here(then->secret),
                             path_from_here(then->roster),
                             path_from_here(then->owners),
                             path_from_here(then->deadlines),
                             then->keep,
                             then->timezone,
                             then->isolation,
                             then->times.empty() ? "" : fs::proximate(then->times).string(),
                             then->timeout};
}

void remember_inputs(const FolderRequest& request) {
    GradingMemory now;
    now.lesson = request.options.setup.lesson.slug;
    now.lesson_checks = remembered_file(request.options.setup.lesson.folder / "checks.lua");
    now.lesson_checks.name = request.options.setup.lesson.slug + "/checks.lua";  // wherever it is installed
    now.checks = remembered_folder(request.options.setup.more_checks);
    now.secret = remembered_secret(request.secret, request.options.setup.secret);
    now.roster = remembered_file(request.sources.roster);
    now.owners = remembered_file(request.sources.owners);
    now.deadlines = remembered_file(request.sources.deadlines);
    now.keep = request.sources.newest_counts ? "newest" : "best";
    now.timezone = request.sources.timezone;
    now.isolation = isolation_name(request.options.setup.isolation);
    now.timeout = static_cast<int>(
        std::chrono::duration_cast<std::chrono::seconds>(request.options.setup.time.processor).count());
    if (request.sources.times) now.times = fs::absolute(*request.sources.times).lexically_normal().string();
    const std::optional<GradingMemory> then = read_memory(request.options.out);
    if (request.again && !request.sources.only.empty())
        throw EnvironmentError("--again grades all of the class again; leave --only out");
    if (then && !request.again)
        if (auto differences = differences_of(*then, now, request.sources.only.empty()); !differences.empty()) {
            const MessageList all{std::move(differences)};
            if (request.sources.only.empty())
                throw EnvironmentError(
                    "the marks in {} were made with other inputs: {}. Leave them out to go on with those, or give "
                    "--again "
                    "to grade all with these, or another --out",
                    request.options.out.string(), all);
            throw EnvironmentError(
                "the marks in {} were made with other inputs: {}. Leave them out to go on with those, or give another "
                "--out",
                request.options.out.string(), all);
        }
    const fs::path file = request.options.out / kMemoryFile;
    const std::string text = json_of(now, 2) + "\n";
    if (!fs::exists(file) || read_file(file) != text) write_file_atomically(file, text);
}

}  // namespace dynlab::inline course
