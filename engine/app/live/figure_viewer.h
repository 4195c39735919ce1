#pragma once
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "app/server/web_server.h"
#include "figures/gnuplot_renderer.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline app {

/// A page on which figures appear as they are made, the newest first.
class FigureViewer {
  public:
    /// `late` receives a new address when a visitor opened an expired or used address. Throws EnvironmentError.
    explicit FigureViewer(std::function<void(const std::string& address)> late = [](const std::string&) {});
    ~FigureViewer();
    std::string address() const { return server_.address(); }
    /// Throws as GnuplotRenderer does.
    void show(const std::string& name, const Figure& figure);

  private:
    struct Shown {
        std::size_t number;
        std::string name, picture;
        std::string plot;  ///< documents/html/plot_data.h
    };
    std::string list() const;
    /// What the page asks for by its number, as this member of it and of this type.
    void serve(const std::string& path, std::string Shown::*member, const std::string& type);

    TemporaryFolder folder_;
    mutable std::mutex mutex_;
    std::deque<Shown> shown_;  ///< the newest first
    std::size_t count_ = 0;
    WebServer server_;
};

}  // namespace dynlab::inline app
