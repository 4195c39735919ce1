#include "cli/pages/figure_view.h"

#include <iostream>
#include <memory>

#include "app/live/figure_viewer.h"
#include "cli/pages/browser.h"

namespace dynlab::inline cli {

FigureListener view_in_browser() {
    const auto tell = [](const std::string& address) { std::cerr << "figures: " << address << std::endl; };
    const auto viewer = std::make_shared<FigureViewer>(tell);
    const auto browser = std::make_shared<DesktopBrowser>();
    tell(viewer->address());
    browser->open(viewer->address());
    return [viewer, browser](const std::string& name, const Figure& figure) { viewer->show(name, figure); };
}

}  // namespace dynlab::inline cli
