#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "course/names/content_text.h"

namespace dynlab::inline course {

/// Fonts whose letters are known, as bytes: what letters look like. They come with the packages dynlab needs; those
/// that are not installed are left out.
struct KnownFonts {
    std::vector<std::string> files;
};
const KnownFonts& known_fonts();  ///< read once

/// How the codes of a font lead to its glyphs.
struct GlyphCodes {
    std::size_t bytes = 2;              ///< of a code
    std::vector<std::uint16_t> glyphs;  ///< by code; empty: codes are glyphs, or what the font itself numbers them by
    bool by_own_table = false;          ///< of a simple font: codes lead through a table (cmap) of the font's file
};

/// What composite fonts (ISO 32000-1, 9.7) and simple TrueType fonts (9.6.3) show, where their outlines are clearly
/// those of other letters than their tables say.
class DrawnLetters {
  public:
    explicit DrawnLetters(const KnownFonts& known);
    ~DrawnLetters();

    /// The `told` map of a font with the letters that it draws instead, and one with digits instead, as a 0 may be an
    /// O. Each outline, stretched to a square, is held against the Latin letters and the digits of the known fonts;
    /// what is like none of them there, such as letters with accents, stays as told. Each table that codes may lead
    /// through gives its own. Empty where everything is as told, or where the font (TrueType, OpenType or CFF, as PDFs
    /// embed them) cannot be read.
    std::vector<CodeMap> read(const std::string& font_file, const GlyphCodes& codes, const CodeMap& told);

  private:
    struct Letters;
    const KnownFonts& known_;
    std::unique_ptr<Letters> letters_;  ///< of the known fonts, once they are asked for
};

}  // namespace dynlab::inline course
