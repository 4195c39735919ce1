#pragma once
#include <memory>
#include <string>

namespace dynlab::test {

/// An invisible window of a Chromium, driven by chromedriver over HTTP (W3C WebDriver). A Chromium serves Browser
/// objects in sequence: each begins with a new window and without cookies, stored data and cached responses. Two
/// objects that live at the same time have a Chromium each.
class Browser {
  public:
    enum class Kind { kWithoutDesktop, kWhole };  ///< what pages do is the same in both
    /// Width and height of the window in pixels. Throws EnvironmentError.
    explicit Browser(int width = 1280, int height = 900, Kind kind = Kind::kWithoutDesktop);
    ~Browser();
    void open(const std::string& address);
    /// The JSON of what a script returns ("return ..."); throws EnvironmentError with its exception.
    std::string evaluate(const std::string& script);
    /// Whether the expression becomes true within so many seconds.
    bool becomes_true(const std::string& expression, double seconds = 30);
    void click(const std::string& selector);
    void new_tab();
    void prefer_dark();  ///< as a system with a dark desktop does
    /// The user's actions, as WebDriver's "actions" list in JSON: pointers, wheels and keys.
    void act(const std::string& actions);
    /// A command of Chromium's own protocol, its parameters in JSON; gives the JSON of its result.
    std::string devtools(const std::string& command, const std::string& parameters);
    /// Writes the visible page as a PNG picture.
    void photograph(const std::string& file);

    /// Ends the Chromiums that no Browser uses now. A program calls it before it exits, where tests do not: the library
    /// that speaks to chromedriver has static objects that are destroyed before those of this class.
    static void end_idle();

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace dynlab::test
