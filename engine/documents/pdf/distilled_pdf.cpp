#include "documents/pdf/distilled_pdf.h"

#include <csignal>
#include <map>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>
#include <set>

#include "documents/work_file.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;
using Object = QPDFObjectHandle;

constexpr const char *kGhostscript = "gs", *kPackage = "ghostscript";
constexpr std::uint64_t kMaxFile = 200ull << 20;
constexpr const char* kMaxMemory = "-K2000000";  ///< kilobytes

/// JPEG with little loss, without subsampling of colors.
constexpr const char* kPictureSettings =
    "<< /ColorACSImageDict << /QFactor 0.15 /Blend 1 /HSamples [1 1 1 1] /VSamples [1 1 1 1] >> "
    "/GrayACSImageDict << /QFactor 0.15 /Blend 1 /HSamples [1 1 1 1] /VSamples [1 1 1 1] >> >> setdistillerparams";

/// Undamaged and decrypted, so that Ghostscript is given a PDF and nothing else; and how many pages it has.
std::pair<std::string, std::size_t> rewritten(const fs::path& file, const PdfObjectLimits& limits) {
    std::string answer = work_on_pdf_objects(file, limits, [&](QPDF& pdf, const std::string&) {
        const std::size_t pages = pdf.getAllPages().size();
        return std::to_string(pages) + "\n" + written_pdf(pdf, limits.bytes_inside);
    });
    const std::size_t line = answer.find('\n');
    const std::size_t pages = std::stoul(answer.substr(0, line));
    answer.erase(0, line + 1);
    return {std::move(answer), pages};
}

Message reason_of(const ChildResult& child, const DistillSetup& setup) {
    if (child.timed_out) return Message("printing takes longer than {} s", setup.time.seconds(child.time_limit()));
    if (child.exit_code == 128 + SIGXFSZ) return Message("the result is larger than {} MB", kMaxFile >> 20);
    const std::string& said = child.output.empty() ? child.error_output : child.output;
    return Message::verbatim(terminal_text(said.substr(0, said.find('\n'))));
}

void print(const fs::path& file, const fs::path& folder, const DistillSetup& setup) {
    if (!find_program(kGhostscript)) throw MissingProgram(kGhostscript, kPackage);
    Sandbox sandbox(setup.isolation);
    sandbox.add_document_programs();
    for (const char* resources : {"/etc/ghostscript", "/var/lib/ghostscript"})  // fonts and tables of characters
        if (fs::exists(resources)) sandbox.add(resources, resources);
    const fs::path in = sandbox.add(file, "/box/in.pdf"), out = sandbox.add_writable(folder, "/box/out");
    Sandbox::Limits limits;
    limits.time = setup.time;
    limits.file_bytes = kMaxFile;
    const ChildResult child = sandbox.run(
        {kGhostscript, "-q", "-dSAFER", "-dBATCH", "-dNOPAUSE", kMaxMemory, "-sDEVICE=pdfwrite",
         "-dCompatibilityLevel=1.7", "-dMaxInlineImageSize=0", "-dPassThroughJPEGImages=false",
         "-dPassThroughJPXImages=false", "-o", (out / "copy.pdf").string(), "-c", kPictureSettings, "-f", in.string()},
        {}, "", limits);
    if (child.exit_code == 0 && fs::is_regular_file(folder / "copy.pdf")) return;
    refuse_full_disk(folder, 2 * fs::file_size(file));
    throw PdfRefusal(PdfFault::kDamaged, Message("Ghostscript cannot print the file: {}.", reason_of(child, setup)));
}

std::size_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
    std::size_t number = 0;
    for (std::size_t i = at; i < at + count; ++i)
        number = number << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0);
    return number;
}

void overwrite(std::string& bytes, std::size_t begin, std::size_t count, char with) {
    if (begin < bytes.size())
        bytes.replace(begin, std::min(count, bytes.size() - begin), std::min(count, bytes.size() - begin), with);
}

/// A font's file without its names: those of its table "name" (OpenType), or of its name index (Adobe's Technical Note
/// 5176, section 7).
std::string without_names(std::string font) {
    const bool compact = font.size() > 4 && font[0] == 1 && font[1] == 0 && font[2] != 0;
    if (compact) {
        const std::size_t index = number_at(font, 2, 1), names = number_at(font, index, 2);
        const std::size_t size = number_at(font, index + 2, 1), offsets = index + 3;
        const std::size_t data = offsets + (names + 1) * size, end = number_at(font, offsets + names * size, size);
        if (names > 0 && end > 0) overwrite(font, data, end - 1, 'X');
        return font;
    }
    for (std::size_t i = 0, tables = number_at(font, 4, 2); i < tables; ++i) {
        const std::size_t entry = 12 + 16 * i;
        if (font.compare(std::min(entry, font.size()), 4, "name") == 0)
            overwrite(font, number_at(font, entry + 8, 4), number_at(font, entry + 12, 4), '\0');
    }
    return font;
}

/// What Ghostscript wrote, reduced to what a reader needs.
class Pruning {
  public:
    Pruning(QPDF& pdf, std::uint64_t max_bytes) : pdf_(pdf), max_bytes_(max_bytes) {}

    void prune() {
        keep_only(pdf_.getTrailer(), {"/Root", "/Size"});
        Object root = pdf_.getRoot();
        keep_only(root, {"/Type", "/Pages", "/Outlines", "/Dests", "/Names", "/PageMode", "/Lang"});
        if (root.hasKey("/Names")) keep_only(root.getKey("/Names"), {"/Dests"});
        prune_bookmarks(root.getKey("/Outlines"));
        for (Object page : pdf_.getAllPages()) {
            keep_only(page, {"/Type", "/Parent", "/MediaBox", "/CropBox", "/Rotate", "/Resources", "/Contents",
                             "/Annots", "/Group"});
            prune_annotations(page);
        }
        for (Object object : pdf_.getAllObjects()) {
            if (object.isStream()) object.getDict().removeKey("/Metadata");
            rename_embedded(object);
        }
        for (Object object : pdf_.getAllObjects()) rename_font(object);
    }

  private:
    static void keep_only(Object dictionary, const std::set<std::string>& keys) {
        if (!dictionary.isDictionary()) return;
        for (const std::string& key : dictionary.getKeys())
            if (!keys.contains(key)) dictionary.removeKey(key);
    }

    /// Addresses of the web and of mail only: no files, scripts or other machines.
    static bool is_plain_address(Object address) {
        if (!address.isString()) return false;
        const std::string text = in_small_letters(address.getUTF8Value());
        return text.starts_with("http://") || text.starts_with("https://") || text.starts_with("mailto:");
    }

    static void prune_action(Object owner) {
        Object action = owner.getKey("/A");
        keep_only(action, {"/S", "/D", "/URI"});
        const bool plain = action.isDictionary() &&
                           (action.getKey("/S").isNameAndEquals("/GoTo") ||
                            (action.getKey("/S").isNameAndEquals("/URI") && is_plain_address(action.getKey("/URI"))));
        if (!plain) owner.removeKey("/A");
    }

    void prune_bookmarks(Object bookmark) {
        for (; bookmark.isDictionary(); bookmark = bookmark.getKey("/Next")) {
            keep_only(bookmark,
                      {"/Type", "/Title", "/Parent", "/Prev", "/Next", "/First", "/Last", "/Count", "/Dest", "/A"});
            prune_action(bookmark);
            prune_bookmarks(bookmark.getKey("/First"));
        }
    }

    static void prune_annotations(Object page) {
        Object links = Object::newArray();
        if (Object annotations = page.getKey("/Annots"); annotations.isArray())
            for (Object annotation : annotations.getArrayAsVector()) {
                if (!annotation.isDictionaryOfType("", "/Link")) continue;
                keep_only(annotation, {"/Type", "/Subtype", "/Rect", "/Border", "/C", "/H", "/F", "/Dest", "/A"});
                prune_action(annotation);
                links.appendItem(annotation);
            }
        page.removeKey("/Annots");
        if (links.getArrayNItems() > 0) page.replaceKey("/Annots", links);
    }

    void rename_embedded(Object descriptor) {
        if (!descriptor.isDictionary() || !descriptor.getKey("/FontName").isName()) return;
        for (const char* key : {"/FontFile", "/FontFile2", "/FontFile3"}) {
            Object file = descriptor.getKey(key);
            if (!file.isStream()) continue;
            const std::string number = std::to_string(names_.size() + 1);
            const auto& [entry, added] =
                names_.emplace(descriptor.getKey("/FontName").getName(), "/AAAAAA+Font" + number);
            descriptor.replaceKey("/FontName", Object::newName(entry->second));
            descriptor.removeKey("/FontFamily");
            const StreamContent content = stream_content(file, max_bytes_);
            if (content.decoded)
                file.replaceStreamData(without_names(content.bytes), Object::newNull(), Object::newNull());
        }
    }

    /// A composite font has the name of its descendant, which may come later.
    void rename_font(Object font) {
        if (!font.isDictionary() || !font.getKey("/BaseFont").isName()) return;
        Object named = font;
        if (Object parts = font.getKey("/DescendantFonts"); parts.isArray() && parts.getArrayNItems() > 0)
            named = parts.getArrayItem(0);
        if (Object descriptor = named.getKey("/FontDescriptor"); descriptor.isDictionary())
            font.replaceKey("/BaseFont", descriptor.getKey("/FontName"));
    }

    QPDF& pdf_;
    std::uint64_t max_bytes_;  ///< bytes of a stream
    std::map<std::string, std::string> names_;
};

}  // namespace

void refuse_full_disk(const fs::path& folder, std::uintmax_t bytes) {
    std::error_code unknown;
    if (const fs::space_info disk = fs::space(folder, unknown); !unknown && disk.available < bytes)
        throw EnvironmentError("no space is left in {}: free some space, or set TMPDIR to another folder",
                               folder.string());
}

std::string distilled_pdf(const fs::path& file, const DistillSetup& setup) {
    const TemporaryFolder work;
    const fs::path plain = work.path() / "plain.pdf", out = work.path() / "out";
    fs::create_directory(out);
    const auto [bytes, pages] = rewritten(file, setup.objects);
    write_work_file(plain, bytes);
    print(plain, out, setup);
    return work_on_pdf_objects(out / "copy.pdf", setup.objects, [&, pages = pages](QPDF& pdf, const std::string&) {
        if (pdf.getAllPages().size() != pages)
            throw PdfRefusal(PdfFault::kDamaged, Message("The file is damaged: Ghostscript prints {} of its {} pages.",
                                                         pdf.getAllPages().size(), pages));
        Pruning(pdf, setup.objects.bytes_inside).prune();
        return written_pdf(pdf, setup.objects.bytes_inside,
                           [](QPDFWriter& writer) { writer.setObjectStreamMode(qpdf_o_generate); });
    });
}

}  // namespace dynlab::inline documents
