#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "base/reader.h"
#include "platform/cache.h"
#include "platform/error.h"

namespace dynlab::inline figures {

struct Figure;

/// A figure could not be drawn: names its file and says what gnuplot complained of.
class FigureError : public EnvironmentError {
  public:
    using EnvironmentError::EnvironmentError;
};

enum class FigureFormat { kPdf, kSvg, kPng };
std::optional<FigureFormat> known_figure_format(const std::filesystem::path& file);  ///< by extension
FigureFormat figure_format(
    const std::filesystem::path& file);  ///< by extension; throws InvalidArgument naming the three

/// One gnuplot process that draws any number of figures in the house style. Starts with the first figure that must be
/// drawn: with a `cache`, which must outlive it, figures drawn before are taken from there. All
/// data go through the pipe; all text is quoted so that none of it can become gnuplot code or a shell
/// command. Files appear whole (temporary name, then rename) once finish() returns.
class GnuplotRenderer {
  public:
    explicit GnuplotRenderer(const Cache* cache = nullptr);
    ~GnuplotRenderer();  ///< ends the process; files not finished are removed

    /// Queues `figure` for `file`; returns at once. Throws MissingProgram when gnuplot is not installed.
    /// Texts and numbers are the reader's.
    void draw(const Figure& figure, const std::filesystem::path& file, FigureFormat format, const Reader& reader = {});
    /// Waits until all queued files are whole. Throws FigureError with gnuplot's first complaint.
    void finish();

    CacheUse use() const;  ///< figures drawn and taken from the cache so far

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace dynlab::inline figures
