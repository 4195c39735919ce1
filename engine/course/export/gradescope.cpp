#include "course/export/gradescope.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "course/sandbox_jobs/graded_run.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/files/zip_file.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

constexpr char kSetup[] = R"sh(#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the container: installs dynlab from this zip.
set -eu
prefix=${PREFIX:-/usr/local}
libraries=${LIBRARIES:-/usr/lib/$(uname -m)-linux-gnu}
cd "$(dirname "${BASH_SOURCE[0]}")"
install -D -m 755 -t "$prefix/bin" program/*
if [ -d own ]; then mkdir -p "$prefix/lib/dynlab" && cp -r own/. "$prefix/lib/dynlab"; fi
mkdir -p "$prefix/share/dynlab"
cp -r share/. "$prefix/share/dynlab"
known=$(ldconfig -p || true)
for library in libraries/*; do
  name=$(basename "$library")
  case "$known" in *"$name "*) continue ;; esac
  [ -e "$libraries/$name" ] || install -m 644 "$library" "$libraries/$name"
done
[ -n "${PREFIX:-}" ] || ldconfig
if ! "$prefix/bin/dynlab" --version || ! "$prefix/bin/dynlab" grade --help > /dev/null; then
  echo "dynlab does not run in this image: choose a newer one (its C library must be as new as the machine's that made the zip)" >&2
  exit 1
fi
# Boxes of their own for students' scripts, where the container allows them.
[ -n "${PREFIX:-}" ] || command -v bwrap > /dev/null || { apt-get update && apt-get install -y bubblewrap; } || true
)sh";

constexpr char kRun[] = R"sh(#!/usr/bin/env bash
# Gradescope runs this for each submission.
set -u
prefix=${{PREFIX:-/usr/local}}
autograder=${{AUTOGRADER:-/autograder}}
source=$autograder/source
work=$(mktemp -d)
mkdir -p "$work/in" "$autograder/results"
cp -rL "$autograder/submission" "$work/in/submission"
for isolation in full process; do
  "$prefix/bin/dynlab" grade "$work/in" --lesson "$prefix/share/dynlab/lessons/{slug}" --out "$work/out" \
    --isolation "$isolation" --timeout {timeout} --jobs 2 --no-pdf --secret "$source/secret"{checks}
  [ -e "$work/out/results/submission/results.json" ] && break
done
if ! cp "$work/out/results/submission/results.json" "$autograder/results/results.json"; then
  echo "the submission could not be graded; that is no mark" >&2
  exit 1
fi
rm -rf "$work"
)sh";

/// Files below a folder, by their path in the zip.
void add_folder(const fs::path& folder, const std::string& inside, Contents& contents) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            contents[inside + "/" + entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path());
}

/// Whether every Linux has it, in a version that fits its own C library only.
bool of_the_c_library(const std::string& name) {
    for (const char* beginning : {"libc.so", "libm.so", "libpthread.so", "libdl.so", "librt.so", "libresolv.so",
                                  "ld-linux", "linux-vdso", "libmvec.so", "libutil.so"})
        if (name.starts_with(beginning)) return true;
    return false;
}

/// Shared libraries of others that a program or library is linked with, and where they are: the lines "NAME => PATH
/// (...)".
std::map<std::string, fs::path> libraries_of(const fs::path& program) {
    ChildOptions ldd;
    ldd.command = {"ldd", program.string()};
    std::map<std::string, fs::path> found;
    for (const std::string& line : lines_of(run_child(ldd, "libc-bin").output)) {
        std::istringstream words(line);
        std::string name, arrow, path;
        const bool is_there = words >> name >> arrow >> path && arrow == "=>" && fs::exists(path);
        if (is_there && !of_the_c_library(name) && !name.starts_with("libdynlab_")) found[name] = path;
    }
    return found;
}

void add_libraries(const fs::path& program, Contents& contents) {
    std::map<std::string, fs::path> all = libraries_of(program);
    // The library that reads MAT files is loaded by name with the first such file.
    std::set<fs::path> folders;
    for (const auto& [name, path] : all) folders.insert(path.parent_path());
    for (const fs::path& folder : folders)
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (!name.starts_with("libmatio.so.") || !entry.is_regular_file()) continue;
            all[name] = entry.path();
            all.merge(libraries_of(entry.path()));
        }
    for (const auto& [name, path] : all) contents["libraries/" + name] = read_file(path);
}

}  // namespace

std::uintmax_t write_autograder(const AutograderRequest& request, const fs::path& zip) {
    Contents contents;
    contents["setup.sh"] = kSetup;
    contents["run_autograder"] =
        fmt::format(kRun, fmt::arg("slug", request.lesson.slug), fmt::arg("timeout", request.timeout_seconds),
                    fmt::arg("checks", request.more_checks ? " --checks \"$source/checks\"" : ""));
    contents["secret"] = request.secret;
    for (const fs::path& program : programs_next_to(request.program)) {
        contents["program/" + program.filename().string()] = read_file(program);
        add_libraries(program, contents);
    }
    if (const auto own = library_folder_of(request.program)) add_folder(*own, "own", contents);
    for (const char* name : {"data", "report_templates"})
        add_folder(shared_folder() / name, std::string("share/") + name, contents);
    add_folder(request.lesson.folder, "share/lessons/" + request.lesson.slug, contents);
    if (request.more_checks) add_folder(*request.more_checks, "checks", contents);
    write_zip(zip, contents);
    return fs::file_size(zip);
}

}  // namespace dynlab::inline course
