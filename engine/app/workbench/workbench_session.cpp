#include "app/workbench/workbench_session.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "app/page/page_files.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

constexpr int kLookForInterrupt = 1000;  // ms

}  // namespace

std::string workbench_prelude() {
    for (const PageFile& file : page_files())
        if (file.name == std::string_view("views.lua")) return std::string(file.text);
    throw EnvironmentError("the program was built without views.lua");
}

std::size_t ProcessPartRunner::run(const PercentScript& script, const std::set<fs::path>& changed) {
    return runner_.run(report_of_script(script, "session.html"), figures_.path(), changed);
}

WorkbenchSession::WorkbenchSession(fs::path file, ScriptRunner& runner)
    : runner_(runner),
      parts_(runner),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      state_(std::move(file), parts_) {
    const fs::path folder = state_.text().file().parent_path();
    watch_.add(folder.empty() ? "." : folder);
}

void WorkbenchSession::wake() {
    const std::uint64_t one = 1;
    write_all(wake_.get(), reinterpret_cast<const char*>(&one), sizeof one);
}

std::optional<std::size_t> WorkbenchSession::change(const ScriptOrder& order) {
    const std::lock_guard lock(mutex_);
    const auto revision = state_.change(order);
    revision && !order.unsaved ? text_is_ours()
                               : wake();  // without a revision the page hears of another program's text
    return revision;
}

void WorkbenchSession::put(const std::function<std::string(const std::string&)>& make) {
    const std::lock_guard lock(mutex_);
    state_.put(make);
    text_is_ours();
}

void WorkbenchSession::undo() {
    const std::lock_guard lock(mutex_);
    state_.undo();
    text_is_ours();
}

void WorkbenchSession::redo() {
    const std::lock_guard lock(mutex_);
    state_.redo();
    text_is_ours();
}

/// The text comes from the user of the page.
void WorkbenchSession::text_is_ours() {
    if (state_.may_run()) notify_saving_(state_.text().text());
    wake();
}

std::size_t WorkbenchSession::look(const ViewOrder& order) {
    const std::lock_guard lock(mutex_);
    const std::size_t number = state_.look(order);
    wake();
    return number;
}

void WorkbenchSession::stop() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    wake();
}

void WorkbenchSession::again() {
    const std::lock_guard lock(mutex_);
    state_.again();
    wake();
}

void WorkbenchSession::allow_runs() {
    const std::lock_guard lock(mutex_);
    state_.allow_runs();
    wake();
}

std::string WorkbenchSession::saved(const std::string& name) const {
    return read_file(parts_.figures() / fs::path(name).filename());
}

void WorkbenchSession::end() {
    end_ = true;
    wake();
}

std::string WorkbenchSession::script() const {
    const std::lock_guard lock(mutex_);
    return state_.text().text();
}

fs::path WorkbenchSession::file() const {
    const std::lock_guard lock(mutex_);
    return state_.text().file();
}

void WorkbenchSession::work() {
    try {
        follow();
    } catch (...) {
        save_rest();
        throw;
    }
    save_rest();
}

/// The file of a slider that was held to the last.
void WorkbenchSession::save_rest() {
    const std::lock_guard lock(mutex_);
    if (state_.save() && state_.may_run()) notify_saving_(state_.text().text());
    if (!state_.text().unsaved().empty())
        throw EnvironmentError("the last changes to the script are lost: {}", state_.text().unsaved());
}

void WorkbenchSession::take_file_changes() {
    const std::lock_guard lock(mutex_);
    for (const fs::path& file : watch_.changes()) {
        if (file.filename() == state_.text().file().filename()) {
            state_.read_changed_file();
            continue;
        }
        for (const fs::path& data : data_) {
            if (!concerns(place_of(file), data)) continue;
            state_.data_changed(data);
            watch_.add_around(data);
        }
    }
}

void WorkbenchSession::follow() {
    while (!end_) {
        take_orders();
        pollfd waiting[3] = {
            {watch_.descriptor(), POLLIN, 0}, {wake_.get(), POLLIN, 0}, {runner_.descriptor(), POLLIN, 0}};
        ::poll(waiting, 3, kLookForInterrupt);
        throw_if_interrupted();
        if (waiting[0].revents != 0) take_file_changes();
        while (runner_.running()) {
            pollfd news{runner_.descriptor(), POLLIN, 0};
            if (::poll(&news, 1, 0) <= 0) break;
            take_news();
        }
    }
}

void WorkbenchSession::take_orders() {
    std::uint64_t count = 0;
    while (::read(wake_.get(), &count, sizeof count) > 0) {
    }
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(stop_, false) && runner_.running()) {
            runner_.stop();
            state_.run_was_stopped();
        }
        if (state_.must_run()) state_.run();
    }
    notify_();
}

void WorkbenchSession::take_news() {
    RunnerNews news = runner_.next();
    for (const fs::path& file : news.record.files_read) {
        const fs::path place = place_of(file);
        data_.insert(place);
        watch_.add_around(place);
    }
    const std::lock_guard lock(mutex_);
    state_.take(std::move(news));
}

std::optional<Message> WorkbenchSession::mistake() const {
    const std::lock_guard lock(mutex_);
    return state_.mistake();
}

std::string WorkbenchSession::translated(const Message& message) const {
    const std::lock_guard lock(mutex_);
    return message_text(message, state_.reader());
}

std::string WorkbenchSession::whole() const {
    const std::lock_guard lock(mutex_);
    return state_.json(true);
}

std::optional<std::string> WorkbenchSession::changes() {
    const std::lock_guard lock(mutex_);
    return state_.changes();
}

}  // namespace dynlab::inline app
