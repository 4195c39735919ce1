#include "cli/pages/figure_view.h"

#include <iostream>
#include <memory>

#include "app/live/figure_viewer.h"
#include "cli/pages/browser.h"

namespace dynlab::inline cli {

FigureListener view_in_browser() {
    const auto print_address = [](const std::string& address) { std::cerr << "figures: " << address << std::endl; };
    const auto viewer = std::make_shared<FigureViewer>(print_address);
    const auto browser = std::make_shared<DesktopBrowser>();
    print_address(viewer->address());
    browser->open(viewer->address());
    return [viewer, browser](const std::string& name, const Figure& figure) { viewer->show(name, figure); };
}

}  // namespace dynlab::inline cli
