#pragma once
#include <optional>
#include <string>

#include "platform/temporary_folder.h"

namespace dynlab::inline cli {

/// The browser of the desktop, where there is one. It gets a file that only the user can read and that leads to the
/// address: all users of the machine can see the arguments of a command.
class DesktopBrowser {
  public:
    /// Failures are ignored: the address is on the terminal.
    void open(const std::string& address);

  private:
    std::optional<TemporaryFolder> folder_;
};

}  // namespace dynlab::inline cli
