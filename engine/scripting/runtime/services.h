#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline platform {
class WrittenFiles;
}

namespace dynlab::inline scripting {

/// The language of the document that is made, for report.language().
struct ReportLanguage {
    std::string code = "en";
};

/// What was chosen instead of the numbers that a script gives its sliders, by their names.
struct SliderValues {
    std::map<std::string, double> chosen;
    bool clamped = false;  ///< what lies outside a slider's range is its nearest end, not an error
};

/// Of programs that show values otherwise than text: hears of each just before it is printed, with its formula in LaTeX
/// where it has one.
struct ValueListener {
    std::function<void(const std::string& latex)> expect;
};

/// Of programs that make a script's montecarlo in parts.
class CallsInParts {
  public:
    using Some = std::function<std::string(std::size_t first, std::size_t count)>;

    virtual ~CallsInParts() = default;
    /// What `some` gives for the pieces of the script's next call, made before or now, in their order. `files`: what
    /// the script has read so far, on which the call may depend. Throws where pieces are missing that others make.
    virtual std::vector<std::string> all(const std::vector<std::filesystem::path>& files, std::size_t pieces,
                                         const Some& some) = 0;
};

/// What a program gives the scripts of a Runtime, which it must outlive; null for what it does not give.
struct Services {
    const ReportLanguage* language = nullptr;  ///< English without
    const SliderValues* sliders = nullptr;     ///< every slider has the script's own number without
    const ValueListener* listener = nullptr;
    WrittenFiles* written = nullptr;  ///< refuses to replace files; all may be replaced without
    CallsInParts* parts = nullptr;    ///< calls are made whole without

    std::string language_code() const { return language != nullptr ? language->code : ReportLanguage().code; }
};

}  // namespace dynlab::inline scripting
