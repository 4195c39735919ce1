#pragma once
#include <string>

#include "platform/temporary_folder.h"

namespace dynlab::inline cli {

/// The browser of the desktop, where there is one. It is given a file that the user alone can read and that leads on to
/// the address: all users of the machine see the words of a command.
class DesktopBrowser {
  public:
    /// What fails is passed over, as the address stands on the terminal.
    void open(const std::string& address) const;

  private:
    TemporaryFolder folder_;
};

}  // namespace dynlab::inline cli
