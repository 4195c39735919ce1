#pragma once
#include <string>

namespace dynlab::inline cli {

/// Shows an address in the browser of the desktop, where there is one; what fails is passed over, as the address stands
/// on the terminal.
void open_browser(const std::string& address);

}  // namespace dynlab::inline cli
