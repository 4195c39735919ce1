#include "platform/sandbox.h"

#include <algorithm>

#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr char kBubblewrap[] = "bwrap";
constexpr char kPackage[] = "bubblewrap";
constexpr char kScratch[] = "/tmp";

using Words = std::vector<std::string>;

void append(Words& words, std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
}

/// run_child starts a session for the sandbox; all of its processes stay in the group that it leads, and end with it.
/// The sandbox has a separate file system that contains /usr and nothing else of the machine. A caller with root rights
/// has no more rights inside than other users: with root's rights, read-only mounts could be mounted again as writable.
Words bare_sandbox() {
    Words words = {kBubblewrap,  "--unshare-all", "--die-with-parent",
                   "--clearenv", "--cap-drop",    "ALL",
                   "--ro-bind",  "/usr",          "/usr",
                   "--proc",     "/proc",         "--dev",
                   "/dev"};
    for (const char* name : {"lib", "lib32", "lib64", "bin", "sbin"}) {
        const fs::path at_root = fs::path("/") / name;
        if (fs::is_symlink(at_root)) append(words, {"--symlink", fs::read_symlink(at_root).string(), at_root.string()});
        if (!fs::is_symlink(at_root) && fs::is_directory(at_root))
            append(words, {"--ro-bind", at_root.string(), at_root.string()});
    }
    return words;
}

}  // namespace

std::string isolation_name(Isolation level) {
    return level == Isolation::kFull ? "full" : "process";
}

std::optional<Message> obstacle_to(Isolation level) {
    if (level == Isolation::kProcess) return {};
    if (!find_program(kBubblewrap))
        return Message(
            "full isolation needs bubblewrap. Use --isolation process, or install bubblewrap with: sudo apt install "
            "bubblewrap");
    Words words = bare_sandbox();
    words.push_back("/usr/bin/true");
    ChildOptions child;
    child.command = std::move(words);
    child.timeout = std::chrono::seconds(5);
    const ChildResult tried = run_child(child, kPackage);
    if (tried.exit_code == 0) return {};
    const std::string reason = tried.error_output.substr(0, tried.error_output.find('\n'));
    return Message(
        "full isolation is not available: bubblewrap reports \"{}\". Allow user namespaces (sudo sysctl "
        "kernel.unprivileged_userns_clone=1), or use --isolation process",
        reason);
}

Isolation strongest_isolation() {
    static const Isolation strongest = obstacle_to(Isolation::kFull) ? Isolation::kProcess : Isolation::kFull;
    return strongest;
}

fs::path Sandbox::mount(const fs::path& outside, const std::string& inside, bool writable) {
    const fs::path whole = fs::absolute(outside);
    mounts_.push_back({whole, inside, writable});
    return level_ == Isolation::kFull ? fs::path(inside) : whole;
}

fs::path Sandbox::add(const fs::path& outside, const std::string& inside) {
    return mount(outside, inside, false);
}

fs::path Sandbox::add_writable(const fs::path& outside, const std::string& inside) {
    return mount(outside, inside, true);
}

fs::path Sandbox::add_program(const fs::path& program) {
    // It looks for its own libraries in ../lib/dynlab.
    if (const auto libraries = library_folder_of(program)) add(*libraries, "/box/lib/dynlab");
    if (const fs::path other = program.parent_path() / kCourseProgram;
        program.filename() == kProgram && fs::exists(other))
        add(other, std::string("/box/bin/") + kCourseProgram);
    return add(program, std::string("/box/bin/") + kProgram);
}

void Sandbox::add_document_programs() {
    for (const char* folder : {"/etc/alternatives", "/etc/fonts", "/etc/texmf", "/var/lib/texmf",
                               "/var/cache/fontconfig", "/etc/papersize", "/etc/localtime"})
        if (fs::exists(folder)) add(folder, folder);
}

void Sandbox::add_document_home(const fs::path& data) {
    add_document_programs();
    const fs::path home = add(data, "/box/home/data").parent_path();
    add(shared_folder() / "report_templates", "/box/home/report_templates");
    set_environment("DYNLAB_HOME", home.string());
}

ChildResult Sandbox::run(const Words& command, const fs::path& folder, const std::string& input,
                         const Limits& limits) const {
    ChildOptions child;
    child.input = input;
    child.timeout = limits.time.clock();
    child.processor_time = limits.time.processor;
    child.output_bytes = limits.output_bytes;
    child.file_bytes = limits.file_bytes;
    child.memory_bytes = limits.memory_bytes;
    auto environment = environment_;
    const auto set = [&environment](const char* name, const std::string& value) {
        const bool given = std::ranges::any_of(environment, [name](const auto& entry) { return entry.first == name; });
        if (!given) environment.emplace_back(name, value);
    };
    set("PATH", "/usr/bin:/bin");
    set("LC_ALL", "C.UTF-8");
    if (level_ == Isolation::kProcess) {
        const TemporaryFolder scratch;
        set("TMPDIR", scratch.path().string());
        set("HOME", scratch.path().string());
        child.command = {"env", "-i"};
        for (const auto& [name, value] : environment) child.command.push_back(name + "=" + value);
        child.command.insert(child.command.end(), command.begin(), command.end());
        child.folder = folder.empty() ? scratch.path() : folder;
        return run_child(child, "coreutils");
    }
    set("TMPDIR", kScratch);
    set("HOME", kScratch);
    child.command = bare_sandbox();
    append(child.command, {"--size", std::to_string(limits.scratch_bytes), "--tmpfs", kScratch});
    for (const Mount& mount : mounts_)
        append(child.command, {mount.writable ? "--bind" : "--ro-bind", mount.outside.string(), mount.inside});
    for (const auto& [name, value] : environment) append(child.command, {"--setenv", name, value});
    append(child.command, {"--chdir", folder.empty() ? kScratch : folder.string(), "--"});
    child.command.insert(child.command.end(), command.begin(), command.end());
    return run_child(child, kPackage);
}

}  // namespace dynlab::inline platform
