#include "app/live/background_work.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "data_io/values/command_messages.h"
#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"
#include "platform/terminal/progress.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kLeftAlone = 1s;
constexpr auto kMaxDuration = 10min;

std::string this_program() {
    return running_program().string();
}

}  // namespace

BackgroundWork::BackgroundWork(std::string document)
    : document_(std::move(document)), is_folder_(fs::is_directory(document_)) {}

void BackgroundWork::start(std::function<void()> notify) {
    notify_ = std::move(notify);
    thread_ = std::thread([this] { work(); });
}

void BackgroundWork::stop() {
    {
        const std::lock_guard lock(mutex_);
        end_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void BackgroundWork::document_changed(std::map<std::string, double> slider_values) {
    const std::lock_guard lock(mutex_);
    slider_values_ = std::move(slider_values);
    ++version_;
    change_time_ = Clock::now();
    changed_.notify_all();
}

void BackgroundWork::want(bool requested) {
    const std::lock_guard lock(mutex_);
    if (requested_ == requested) return;
    requested_ = requested;
    changed_.notify_all();
}

BackgroundWork::Pdf BackgroundWork::pdf() {
    std::unique_lock lock(mutex_);
    ++waiting_for_pdf_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return end_ || pdf_version_ == version_; });
    --waiting_for_pdf_;
    return pdf_version_ == version_ ? pdf_ : Pdf{{}, Message("dynlab is shutting down")};
}

bool BackgroundWork::can_submit() const {
    return is_folder_ && fs::exists(fs::path(document_) / "report.md");
}

BackgroundWork::Made BackgroundWork::make_report() {
    return make({this_program(), "report", document_});
}

BackgroundWork::Made BackgroundWork::make_pack() {
    const fs::path folder = fs::canonical(document_);
    return make({this_program(), "pack", document_, "-o", folder.string() + ".zip"});
}

BackgroundWork::Made BackgroundWork::make(std::vector<std::string> command) {
    const std::lock_guard one(making_);
    ChildOptions child;
    child.command = std::move(command);
    child.timeout = kMaxDuration;
    child.give_up = [this] {
        const std::lock_guard guard(mutex_);
        return end_;
    };
    const fs::path messages = folder_.path() / "made.messages";
    fs::remove(messages);
    child.environment = {{kFileOfCommandMessages, messages.string()}};
    Made made;
    try {
        const ChildResult result = run_child(child, "dynlab");
        CommandMessages said = read_command_messages(messages);
        if (result.timed_out)
            said.complaints.push_back(
                Message("dynlab stopped the operation after ten minutes. Shorten the computation, or run dynlab report "
                        "and dynlab pack in a terminal"));
        made = {result.exit_code == 0,
                said.empty() ? Message::verbatim(result.output + result.error_output) : said.all()};
    } catch (const std::exception& error) {
        made.words = message_of(error);
    }
    const std::lock_guard lock(mutex_);
    issues_version_ = 0;  // they speak of what lies in the folder
    changed_.notify_all();
    return made;
}

std::string BackgroundWork::findings() {
    const std::lock_guard lock(mutex_);
    return issues_;
}

std::optional<double> BackgroundWork::checking() {
    const std::lock_guard lock(mutex_);
    return checking_;
}

bool BackgroundWork::pdf_is_ready() {
    const std::lock_guard lock(mutex_);
    return pdf_version_ == version_;
}

BackgroundWork::Task BackgroundWork::next_task(Clock::time_point now) const {
    const bool quiet = requested_ && now - change_time_ >= kLeftAlone;
    if (pdf_version_ != version_ && (waiting_for_pdf_ > 0 || quiet)) return Task::kPdf;
    if (is_folder_ && issues_version_ != version_ && quiet) return Task::kFindings;
    return Task::kNone;
}

void BackgroundWork::work() {
    std::unique_lock lock(mutex_);
    while (!end_) {
        if (const Task task = next_task(Clock::now()); task != Task::kNone) {
            do_task(task, lock);
            continue;
        }
        const bool something_left = pdf_version_ != version_ || (is_folder_ && issues_version_ != version_);
        if (requested_ && something_left)
            changed_.wait_until(lock, change_time_ + kLeftAlone);
        else
            changed_.wait(lock);
    }
}

void BackgroundWork::do_task(Task task, std::unique_lock<std::mutex>& lock) {
    const std::uint64_t version = version_;
    const auto slider_values = slider_values_;
    const auto give_up = [this, version] {
        const std::lock_guard guard(mutex_);
        return end_ || version_ != version || (!requested_ && waiting_for_pdf_ == 0);
    };
    lock.unlock();
    Pdf pdf;
    std::string findings;
    if (task == Task::kPdf)
        pdf = made_pdf(slider_values, give_up);
    else
        findings = made_findings(give_up);
    const bool given_up = give_up();
    lock.lock();
    if (given_up || version_ != version) return;
    if (task == Task::kPdf) {
        pdf_ = std::move(pdf);
        pdf_version_ = version;
    } else {
        issues_ = std::move(findings);
        issues_version_ = version;
    }
    changed_.notify_all();
    lock.unlock();
    notify_();
    lock.lock();
}

BackgroundWork::Pdf BackgroundWork::made_pdf(const std::map<std::string, double>& slider_values,
                                             const std::function<bool()>& give_up) {
    const fs::path file = folder_.path() / "document.pdf";
    fs::remove(file);
    ChildOptions child;
    child.command = {this_program(), fs::is_regular_file(document_) ? "weave" : "report", document_, "-o",
                     file.string()};
    for (const auto& [name, value] : slider_values)
        child.command.insert(child.command.end(), {"--set", fmt::format("{}={}", name, value)});
    const fs::path messages = folder_.path() / "pdf.messages";
    fs::remove(messages);
    child.environment = {{kFileOfCommandMessages, messages.string()}};
    child.timeout = kMaxDuration;
    child.give_up = give_up;
    try {
        const ChildResult made = run_child(child, "dynlab");
        if (fs::exists(file)) return {read_file(file), {}};
        if (made.timed_out)
            return {{},
                    Message("dynlab stopped creating the PDF after ten minutes. Shorten the computation, or run dynlab "
                            "report in a terminal")};
        const CommandMessages said = read_command_messages(messages);
        return {{}, said.empty() ? Message::verbatim(made.error_output) : said.all()};
    } catch (const std::exception& error) {
        return {{}, message_of(error)};
    }
}

std::string BackgroundWork::made_findings(const std::function<bool()>& give_up) {
    ChildOptions child;
    child.command = {this_program(), "check", document_, "--json"};
    child.timeout = kMaxDuration;
    const fs::path progress = folder_.path() / "check.progress";
    fs::remove(progress);
    child.environment = {{kFileOfProgress, progress.string()}};
    child.give_up = [&] {
        set_checking(progress_in(progress).value_or(0));
        return give_up();
    };
    std::string found;
    try {
        found = run_child(child, "dynlab").output;
    } catch (const std::exception&) {  // then there are none to show
    }
    set_checking({});
    return found;
}

void BackgroundWork::set_checking(std::optional<double> done) {
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(checking_, done) == done) return;
    }
    notify_();
}

}  // namespace dynlab::inline app
