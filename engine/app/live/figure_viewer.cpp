#include "app/live/figure_viewer.h"

#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/page/page_routes.h"
#include "documents/html/plot_data.h"
#include "platform/atomic_file.h"

namespace dynlab::inline app {
namespace {

/// Older ones are forgotten; their files stay where the prompt put them.
constexpr std::size_t kMaxFigures = 100;

}  // namespace

FigureViewer::FigureViewer(std::function<void(const std::string& address)> late) : server_({}) {
    serve_page_files(server_, "view.html");
    server_.on_stream([this] { return list(); });
    serve("/picture/*", &Shown::picture, "image/svg+xml");
    serve("/plot/*", &Shown::plot, "application/json");
    server_.on_late_visit([this, late] { late(server_.address()); });
    server_.start();
}

void FigureViewer::serve(const std::string& path, std::string Shown::*member, const std::string& type) {
    server_.on_get(path, [this, member, type](const PageRequest& asked) {
        const std::string number = asked.path.substr(asked.path.rfind('/') + 1);
        std::size_t requested = 0;
        std::from_chars(number.data(), number.data() + number.size(), requested);
        const std::lock_guard lock(mutex_);
        for (const Shown& shown : shown_)
            if (shown.number == requested) return PageReply{shown.*member, type};
        return PageReply{"This figure is no longer shown.", kPlainText, 404};
    });
}

FigureViewer::~FigureViewer() {
    server_.send("over", "{}");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // so that tabs hear of it
}

std::string FigureViewer::list() const {
    const std::lock_guard lock(mutex_);
    nlohmann::json figures = nlohmann::json::array();
    for (const Shown& shown : shown_) figures.push_back({{"number", shown.number}, {"name", shown.name}});
    return nlohmann::json{{"figures", figures}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void FigureViewer::show(const std::string& name, const Figure& figure) {
    const std::filesystem::path file = folder_.path() / "figure.svg";
    GnuplotRenderer renderer;
    renderer.draw(figure, file, FigureFormat::kSvg);
    renderer.finish();
    const std::string plot = plot_data(figure);
    {
        const std::lock_guard lock(mutex_);
        shown_.push_front({++count_, name, read_text(file), plot});
        if (shown_.size() > kMaxFigures) shown_.pop_back();
    }
    server_.send("page", list());
}

}  // namespace dynlab::inline app
