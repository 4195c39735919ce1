#include "cli/pages/figure_view.h"

#include <iostream>
#include <memory>

#include "app/live/figure_viewer.h"
#include "cli/pages/browser.h"

namespace dynlab::inline cli {

FigureListener view_in_browser() {
    const auto viewer = std::make_shared<FigureViewer>();
    std::cerr << "figures: " << viewer->address() << std::endl;
    open_browser(viewer->address());
    return [viewer](const std::string& name, const Figure& figure) { viewer->show(name, figure); };
}

}  // namespace dynlab::inline cli
