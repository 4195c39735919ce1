#include "figures/figure_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <string_view>

#include "figures/style.h"
#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/system_call.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline figures {

std::optional<FigureFormat> known_figure_format(const std::filesystem::path& file) {
    const std::string extension = ending_of(file);
    if (extension == ".pdf") return FigureFormat::kPdf;
    if (extension == ".svg") return FigureFormat::kSvg;
    if (extension == ".png") return FigureFormat::kPng;
    return std::nullopt;
}

FigureFormat figure_format(const std::filesystem::path& file) {
    if (const auto format = known_figure_format(file)) return *format;
    throw InvalidArgument("a figure must be saved as .pdf, .svg or .png, but the file name is \"{}\"",
                          file.filename().string());
}

bool is_complete(const std::filesystem::path& file, FigureFormat format) {
    struct Ends {
        std::string_view begin, end;
    };
    using namespace std::string_view_literals;
    const Ends ends = format == FigureFormat::kPdf   ? Ends{"%PDF"sv, "%%EOF"sv}
                      : format == FigureFormat::kSvg ? Ends{"<?xml"sv, "</svg>"sv}
                                                     : Ends{"\x89PNG"sv, "IEND\xAE\x42\x60\x82"sv};
    std::ifstream in(file, std::ios::binary);
    std::string head(ends.begin.size(), '\0'), tail(64, '\0');
    if (!in.read(head.data(), static_cast<std::streamsize>(head.size())) || head != ends.begin) return false;
    in.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
    return in.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail.find(ends.end) != std::string::npos;
}

namespace {

/// Nothing is drawn by a group that gnuplot opened and closed at once.
std::string without_empty_groups(const std::string& content) {
    constexpr std::string_view kOpen = "<g ", kClose = ">\n</g>\n";
    std::string changed;
    std::size_t copied = 0;
    for (std::size_t at = content.find(kOpen); at != std::string::npos; at = content.find(kOpen, at + 1)) {
        const std::size_t end = content.find('>', at);
        if (end == std::string::npos || content.compare(end, kClose.size(), kClose) != 0) continue;
        changed.append(content, copied, at - copied);
        copied = end + kClose.size();
    }
    return changed.append(content, copied, std::string::npos);
}

std::string with_fallback_fonts(const std::string& content) {
    const std::string text_font = fmt::format("font-family=\"{}\"", style::kTextFont);
    const std::string math_font = fmt::format("font-family=\"{}\"", style::kMathFont);
    std::string changed;
    changed.reserve(content.size() + content.size() / 8);
    std::size_t copied = 0;
    for (std::size_t at = content.find("font-family=\""); at != std::string::npos;
         at = content.find("font-family=\"", at + 1)) {
        changed.append(content, copied, at - copied);
        copied = at;
        for (const std::string* font : {&text_font, &math_font}) {
            if (content.compare(at, font->size(), *font) != 0) continue;
            changed += font->substr(0, font->size() - 1) + ", 'LM Roman 10', 'CMU Serif', 'STIX Two Text', serif\"";
            copied = at + font->size();
        }
    }
    return changed.append(content, copied, std::string::npos);
}

}  // namespace

void finish_svg(const std::filesystem::path& svg) {
    const std::string changed = with_fallback_fonts(without_empty_groups(read_file(svg)));
    std::ofstream out(svg, std::ios::binary | std::ios::trunc);
    if (!(out << changed << std::flush))
        throw EnvironmentError("cannot write \"{}\": {}", svg.string(), system_reason(errno));
}

void blank_creation_date(const std::filesystem::path& pdf) {
    const std::string content = read_file(pdf);
    const std::size_t start = content.rfind("/CreationDate (");
    const std::size_t end = start == std::string::npos ? start : content.find(')', start);
    if (end == std::string::npos) return;
    std::fstream file(pdf, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(start));
    if (!(file << std::string(end + 1 - start, ' ') << std::flush))
        throw EnvironmentError("cannot write \"{}\": {}", pdf.string(), system_reason(errno));
}

TemporaryFile make_temporary_next_to(const std::filesystem::path& target) {
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    TemporaryFile made = make_temporary_file(folder, target.filename().string(), 0666);
    if (!made.file)
        throw EnvironmentError("cannot write the figure \"{}\" into the folder \"{}\": {}", target.filename().string(),
                               target.parent_path().string(), system_reason(errno));
    return made;
}

}  // namespace dynlab::inline figures
