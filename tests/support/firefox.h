#pragma once
#include "support/browser.h"

namespace dynlab::test {

/// A window of a Firefox that nobody sees, driven by Marionette, its own remote protocol: Debian has no geckodriver. It
/// starts with a new profile. Attacks by pages are tried in it, too; what our pages show is tested in Chromium.
class Firefox : public BrowserWindow {
  public:
    static bool is_installed();
    Firefox();  ///< throws EnvironmentError
    ~Firefox() override;
    std::string evaluate(const std::string& script) override;

  private:
    void visit(const std::string& address) override;
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace dynlab::test
