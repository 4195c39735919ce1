#include "course/names/drawn_letters.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_BBOX_H
#include FT_CID_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include "documents/work_file.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr int kPixelsOfSide = 16;    ///< of the square that an outline is stretched to, in pixels
constexpr double kSlant = 0.21;      ///< of slanted letters, 12 degrees
constexpr double kLike = 0.10;       ///< at most so far from a letter is an outline like it
constexpr double kClearly = 0.03;    ///< by so much it must be nearer to that letter than to the one that is told
constexpr FT_Int kMostTables = 8;    ///< of codes, in a font
constexpr double kOfStretch = 0.06;  ///< what another ratio of height to width counts, an octave

}  // namespace

/// An outline as it covers its square, and its shape before it was stretched.
struct StretchedOutline {
    std::array<std::uint8_t, kPixelsOfSide * kPixelsOfSide> cover{};
    double octaves = 0;  ///< log2 of height over width
};

struct KnownLetter {
    StretchedOutline outline;
    std::string text, folded;
    bool is_digit = false;
};

/// FreeType, which reads fonts from memory.
class FontReader {
  public:
    FontReader() {
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) == 0) library_.reset(library);
    }

    /// Nothing for what is no font. `bytes` must outlive it.
    using Face = std::unique_ptr<FT_FaceRec, FT_Error (*)(FT_Face)>;
    Face face(const std::string& bytes) const {
        FT_Face face = nullptr;
        const auto* const data = reinterpret_cast<const FT_Byte*>(bytes.data());
        const bool read =
            library_ && FT_New_Memory_Face(library_.get(), data, static_cast<FT_Long>(bytes.size()), 0, &face) == 0;
        return {read ? face : nullptr, FT_Done_Face};
    }

    /// Upright, where letters lean to the right by `slant`, a tangent. Nothing for a glyph that draws nothing.
    std::optional<StretchedOutline> outline(FT_Face face, FT_UInt glyph, double slant = 0) const {
        if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0) return std::nullopt;
        if (face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return std::nullopt;
        FT_Outline& outline = face->glyph->outline;
        const FT_Matrix upright{0x10000, static_cast<FT_Fixed>(-0x10000 * slant), 0, 0x10000};
        FT_Outline_Transform(&outline, &upright);
        FT_BBox box;
        if (FT_Outline_Get_BBox(&outline, &box) != 0) return std::nullopt;
        const FT_Pos width = box.xMax - box.xMin, height = box.yMax - box.yMin;
        if (width <= 0 || height <= 0 || width > 0x7FFF || height > 0x7FFF) return std::nullopt;
        FT_Outline_Translate(&outline, -box.xMin, -box.yMin);
        constexpr FT_Pos kUnits = kPixelsOfSide * 64;
        const FT_Matrix stretch{FT_DivFix(kUnits, width), 0, 0, FT_DivFix(kUnits, height)};
        FT_Outline_Transform(&outline, &stretch);
        StretchedOutline stretched;
        FT_Bitmap bitmap{};
        bitmap.rows = bitmap.width = kPixelsOfSide;
        bitmap.pitch = kPixelsOfSide;
        bitmap.buffer = stretched.cover.data();
        bitmap.num_grays = 256;
        bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
        if (FT_Outline_Get_Bitmap(library_.get(), &outline, &bitmap) != 0) return std::nullopt;
        stretched.octaves = std::log2(static_cast<double>(height) / static_cast<double>(width));
        return stretched;
    }

  private:
    std::unique_ptr<FT_LibraryRec_, FT_Error (*)(FT_Library)> library_{nullptr, FT_Done_FreeType};
};

namespace {

double outline_distance(const StretchedOutline& a, const StretchedOutline& b) {
    int squares = 0;
    for (std::size_t i = 0; i < a.cover.size(); ++i) {
        const int difference = a.cover[i] - b.cover[i];
        squares += difference * difference;
    }
    const double octaves = a.octaves - b.octaves;
    return squares / (255.0 * 255.0 * kPixelsOfSide * kPixelsOfSide) + kOfStretch * octaves * octaves;
}

/// A text as letters are compared; letters that differ in their size only are one.
std::string folded_text(const std::string& text) {
    std::string folded;
    for (const char32_t character : characters_in(text)) folded += folded_letter(character);
    return folded;
}

std::vector<KnownLetter> known_letters(const FontReader& reader, const KnownFonts& known) {
    constexpr std::string_view kSought = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
    std::vector<KnownLetter> letters;
    for (const std::string& file : known.files) {
        const FontReader::Face face = reader.face(file);
        if (!face || FT_Select_Charmap(face.get(), FT_ENCODING_UNICODE) != 0) continue;
        for (const char letter : kSought) {
            const FT_UInt glyph = FT_Get_Char_Index(face.get(), static_cast<FT_ULong>(letter));
            const auto outline = glyph == 0 ? std::nullopt : reader.outline(face.get(), glyph);
            const std::string text(1, letter);
            if (outline) letters.push_back({*outline, text, folded_text(text), letter <= '9'});
        }
    }
    return letters;
}

/// How far an outline is from the nearest letter, the nearest digit, and from each text.
struct Likeness {
    std::array<const KnownLetter*, 2> nearest{};  ///< letter, digit
    std::array<double, 2> away = {kNowhere, kNowhere};
    std::map<std::string, double> of_text;  ///< by folded text
    static constexpr double kNowhere = std::numeric_limits<double>::infinity();

    double away_from(const std::string& folded) const {
        const auto found = of_text.find(folded);
        return found == of_text.end() ? kNowhere : found->second;
    }
};

void hold_against(const StretchedOutline& outline, const std::vector<KnownLetter>& letters, Likeness& found) {
    for (const KnownLetter& letter : letters) {
        const double away = outline_distance(outline, letter.outline);
        const std::size_t kind = letter.is_digit ? 1 : 0;
        if (away < found.away[kind]) found.away[kind] = away, found.nearest[kind] = &letter;
        double& nearest = found.of_text.try_emplace(letter.folded, Likeness::kNowhere).first->second;
        nearest = std::min(nearest, away);
    }
}

using GlyphByCode = std::map<std::uint32_t, std::uint32_t>;

/// By one of the font's tables; those of symbols have their codes at 0xF000, too (ISO 32000-1, 9.6.6.4).
GlyphByCode glyph_by_table(FT_Face face, FT_CharMap table) {
    GlyphByCode glyphs;
    if (FT_Set_Charmap(face, table) != 0) return glyphs;
    for (std::uint32_t code = 0; code < 0x100; ++code) {
        const FT_UInt plain = FT_Get_Char_Index(face, code),
                      glyph = plain != 0 ? plain : FT_Get_Char_Index(face, 0xF000 + code);
        if (glyph != 0) glyphs[code] = glyph;
    }
    return glyphs;
}

/// By code, the glyph that it shows. Those of CFF fonts with numbers of their own (CIDs) are these.
GlyphByCode glyph_by_code(FT_Face face, const GlyphCodes& codes) {
    GlyphByCode glyphs;
    const auto count = static_cast<std::uint32_t>(std::clamp<FT_Long>(face->num_glyphs, 0, 0xFFFF));
    if (!codes.glyphs.empty()) {
        for (std::uint32_t code = 0; code < codes.glyphs.size(); ++code)
            if (codes.glyphs[code] < count) glyphs[code] = codes.glyphs[code];
        return glyphs;
    }
    FT_Bool numbered = 0;
    if (FT_Get_CID_Is_Internally_CID_Keyed(face, &numbered) != 0) numbered = 0;
    for (std::uint32_t glyph = 0; glyph < count; ++glyph) {
        FT_UInt code = glyph;
        if (numbered != 0 && FT_Get_CID_From_Glyph_Index(face, glyph, &code) != 0) continue;
        glyphs.emplace(code, glyph);
    }
    return glyphs;
}

/// All ways in which viewers may come from codes to glyphs.
std::vector<GlyphByCode> ways_of_codes(FT_Face face, const GlyphCodes& codes) {
    if (!codes.by_own_table) return {glyph_by_code(face, codes)};
    std::vector<GlyphByCode> ways;
    for (FT_Int i = 0; i < std::min<FT_Int>(face->num_charmaps, kMostTables); ++i)
        ways.push_back(glyph_by_table(face, face->charmaps[i]));
    return ways;
}

}  // namespace

const KnownFonts& known_fonts() {
    static const KnownFonts known = [] {
        namespace fs = std::filesystem;
        const fs::path tex = "/usr/share/texlive/texmf-dist/fonts/type1/urw",
                       modern = "/usr/share/texmf/fonts/type1/public/lm";
        const fs::path screen = "/usr/share/fonts/truetype/dejavu";
        KnownFonts read;
        for (const fs::path& file :
             {tex / "helvetic/uhvr8a.pfb", tex / "helvetic/uhvb8a.pfb", tex / "times/utmr8a.pfb",
              tex / "times/utmri8a.pfb", tex / "times/utmb8a.pfb", tex / "courier/ucrr8a.pfb", modern / "lmr10.pfb",
              modern / "lmri10.pfb", modern / "lmbx10.pfb", modern / "lmss10.pfb", modern / "lmtt10.pfb",
              screen / "DejaVuSans.ttf", screen / "DejaVuSans-Bold.ttf", screen / "DejaVuSansMono.ttf",
              screen / "DejaVuSerif.ttf"})
            if (std::string bytes = read_work_file(file); !bytes.empty()) read.files.push_back(std::move(bytes));
        return read;
    }();
    return known;
}

struct DrawnLetters::Letters {
    FontReader reader;
    std::vector<KnownLetter> all;
};

DrawnLetters::DrawnLetters(const KnownFonts& known) : known_(known) {}
DrawnLetters::~DrawnLetters() = default;

std::vector<CodeMap> DrawnLetters::read(const std::string& font_file, const GlyphCodes& codes, const CodeMap& told) {
    if (!letters_) {
        letters_ = std::make_unique<Letters>();
        letters_->all = known_letters(letters_->reader, known_);
    }
    const FontReader& reader = letters_->reader;
    const FontReader::Face face = reader.face(font_file);
    if (!face) return {};
    std::map<std::uint32_t, Likeness> of_glyphs;  // many codes may lead to one glyph, such as that of what is missing
    std::vector<CodeMap> otherwise;
    for (const GlyphByCode& glyphs : ways_of_codes(face.get(), codes)) {
        std::array<CodeMap, 2> drawn = {told, told};  // as letters, as digits
        for (const auto& [code, glyph] : glyphs) {
            const auto claim = told.text.find(code);
            const std::string claimed = claim == told.text.end() ? "" : folded_text(claim->second);
            const auto [known, is_new] = of_glyphs.try_emplace(glyph);
            Likeness& like = known->second;
            for (const double slant : {0.0, kSlant})
                if (const auto outline = is_new ? reader.outline(face.get(), glyph, slant) : std::nullopt)
                    hold_against(*outline, letters_->all, like);
            for (std::size_t kind = 0; kind < drawn.size(); ++kind)
                if (like.away[kind] < kLike && like.away_from(claimed) - like.away[kind] > kClearly)
                    drawn[kind].text[code] = like.nearest[kind]->text;
        }
        for (CodeMap& map : drawn) {
            map.bytes = codes.bytes;
            if (map.text != told.text) otherwise.push_back(std::move(map));
        }
    }
    return otherwise;
}

}  // namespace dynlab::inline course
