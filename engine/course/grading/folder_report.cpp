#include "course/grading/folder_report.h"

#include <csignal>
#include <string>
#include <utility>
#include <variant>

#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "data_io/values/command_messages.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr int kMissingProgramCode = 3;  ///< dynlab's exit code when pandoc or the like is not installed
constexpr std::uint64_t kMaxCheckOutput = 16u << 20, kMaxMadeBytes = 200u << 20;
constexpr char kFolderInSandbox[] = "/box/submission", kRecord[] = "record.json", kMessages[] = "messages";

ChildResult run_report(const fs::path& folder, const fs::path& out, const fs::path& program, Isolation isolation,
                       const TimeLimits& time) {
    Sandbox sandbox(isolation);
    sandbox.add_document_home(shared_folder() / "data");
    const fs::path inside = sandbox.add(folder, kFolderInSandbox), made = sandbox.add_writable(out, "/box/made");
    const fs::path dynlab = sandbox.add_program(program);
    sandbox.set_environment(kFileOfCommandMessages, (made / kMessages).string());
    Sandbox::Limits limits;
    limits.time = time;
    limits.output_bytes = kMaxCheckOutput;
    limits.file_bytes = kMaxMadeBytes;
    return sandbox.run({dynlab.string(), "report", inside.string(), "-o", (made / "report.pdf").string(), "--record",
                        (made / kRecord).string(), "--stay-in-folder"},
                       made, "", limits);
}

std::optional<RecordedError> error_of_run(const fs::path& record) {
    try {
        if (fs::is_regular_file(fs::symlink_status(record))) return record_from_json(read_file(record)).error;
    } catch (const ValueError&) {  // the sandbox was ended during its output
    }
    return {};
}

/// What the program said before it ended without a report.
Message complaint(const ChildResult& made, const fs::path& messages, const fs::path& folder) {
    MessageList said{{}, Join::kSentences};
    for (const Message& one : read_command_messages(messages).complaints) {
        const auto* const lines = one.id() == "{}" ? std::get_if<MessageList>(&one.arguments().front()) : nullptr;
        if (lines == nullptr)
            said.items.push_back(one);
        else
            said.items.insert(said.items.end(), lines->items.begin(), lines->items.end());
    }
    const Message all =
        said.items.empty() ? Message::verbatim(trimmed(replaced(made.error_output, "\n", " "))) : Message("{}", said);
    return with_changed_text(all, [&folder](std::string text) {
        for (const std::string& place : {folder.string() + "/", std::string(kFolderInSandbox) + "/",
                                         std::string("../folder/"), std::string("../submission/")})
            text = replaced(text, place, "");
        return text;
    });
}

}  // namespace

FolderReport make_folder_report(const fs::path& folder, const fs::path& out, const fs::path& program,
                                Isolation isolation, const TimeLimits& time) {
    for (const auto& [name, package] : {std::pair("pandoc", "pandoc"), std::pair("pdflatex", "texlive-latex-base")})
        if (!find_program(name)) throw MissingProgram(name, package);
    const ChildResult made = run_report(folder, out, program, isolation, time);
    if (made.exit_code == 0) return {true, {}, {}};
    const Message said = complaint(made, out / kMessages, folder);
    if (made.exit_code == kMissingProgramCode) throw MissingProgram(said);
    FolderReport none;
    none.stopped = error_of_run(out / kRecord);
    if (made.timed_out)
        none.failure = Message("{}.", reason_of_end(made, time));
    else if (made.output_exceeded)
        none.failure = Message("the script prints more than 16 MB.");
    else if (made.exit_code == 128 + SIGXFSZ)
        none.failure = Message("the script writes a file larger than {} MB.", kMaxMadeBytes >> 20);
    else if (made.error_output.empty())
        none.failure = Message("the script exits with code {} without a message.", made.exit_code);
    else
        none.failure = said;
    return none;
}

}  // namespace dynlab::inline course
