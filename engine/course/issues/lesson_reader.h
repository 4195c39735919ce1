#pragma once
#include <memory>
#include <string>

#include "base/catalog.h"
#include "base/reader.h"

namespace dynlab::inline course {

/// Who reads what is said of work on a lesson: in a language, English where it has no catalog, with the names that
/// scripts have for options. What the authors of the lesson's checks wrote is read as checks.LANGUAGE.po beside
/// checks.lua translates it, where the lesson is installed and has that file.
class LessonReader {
  public:
    /// Throws EnvironmentError for a checks.LANGUAGE.po that cannot be read.
    explicit LessonReader(const std::string& language, const std::string& lesson = "");

    const Reader& reader() const { return reader_; }
    std::string text(const Message& message) const { return message_text(message, reader_); }

  private:
    std::shared_ptr<const Catalog> authors_;
    Reader reader_;
};

}  // namespace dynlab::inline course
