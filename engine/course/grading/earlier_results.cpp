#include "course/grading/earlier_results.h"

#include <fmt/format.h>

#include "course/grading/grading_memory.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {

namespace fs = std::filesystem;

std::optional<Grade> earlier_grade(const fs::path& folder) {
    const fs::path file = folder / "results.json";
    if (!fs::exists(file)) return {};
    try {
        return from_results_json(read_file(file));
    } catch (const EnvironmentError&) {
        return {};
    }
}

void refuse_other_lessons(const GradingRequest& request) {
    const fs::path results = request.out / "results";
    fs::create_directories(results);
    for (const auto& entry : fs::directory_iterator(results)) {
        const std::optional<Grade> grade = earlier_grade(entry.path());
        if (!grade) continue;
        if (grade->lesson == request.setup.lesson.slug) return;  // as are all others, which were put beside it
        throw EnvironmentError(fmt::format("{} holds the results of lesson {}; name another folder with --out",
                                           request.out.string(), grade->lesson));
    }
}

void remember_inputs(const GradingRequest& request) {
    GradingMemory now;
    now.lesson = request.setup.lesson.slug;
    now.lesson_checks = remembered_file(request.setup.lesson.folder / "checks.lua");
    now.lesson_checks.name = request.setup.lesson.slug + "/checks.lua";  // wherever it is installed
    now.checks = remembered_folder(request.setup.more_checks);
    now.secret = remembered_text("--secret", request.setup.secret);
    now.roster = remembered_file(request.roster);
    now.owners = remembered_file(request.owners);
    now.deadlines = remembered_file(request.deadlines);
    now.keep = request.newest_counts ? "newest" : "best";
    now.timezone = request.timezone;
    const std::optional<GradingMemory> then = read_grading_memory(request.out);
    if (request.again && !request.only.empty())
        throw EnvironmentError("--again grades all of the class anew; leave --only out");
    if (then && !request.again)
        if (const auto differences = differences_of(*then, now, request.only.empty()); !differences.empty())
            throw EnvironmentError(
                fmt::format("the marks in {} were made with other inputs: {}. Give the same again{}, or another --out",
                            request.out.string(), fmt::join(differences, ", "),
                            request.only.empty() ? ", or --again to grade all with these" : ""));
    write_grading_memory(request.out, now);
}

}  // namespace dynlab::inline course
