#include "documents/pdf/pdf_objects.h"

#include <fmt/format.h>

#include "documents/work_file.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;

constexpr char kProgram[] = "qpdf";
constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Runs qpdf in the box; warnings about damage that it mended are no failure.
std::string run_qpdf(const Box& box, std::vector<std::string> words, const PdfObjectLimits& limits) {
    if (!find_program(kProgram))
        throw MissingProgram("qpdf is not installed; names are looked for inside PDFs with it (sudo apt install qpdf)");
    std::vector<std::string> command = {"prlimit", fmt::format("--as={}", limits.memory_bytes), kProgram,
                                        "--warning-exit-0", "--no-warn"};
    command.insert(command.end(), words.begin(), words.end());
    Box::Limits box_limits;
    box_limits.timeout = limits.time;
    box_limits.output_bytes = limits.output_bytes;
    ChildResult child = box.run(command, {}, "", box_limits);
    if (child.timed_out)
        throw PdfRefusal(PdfFault::kTooLarge,
                         fmt::format("Looking inside the file takes more than {} s.", limits.time.count() / 1000));
    if (child.output_exceeded)
        throw PdfRefusal(PdfFault::kTooLarge,
                         fmt::format("The file has more than {} MB inside.", limits.output_bytes >> 20));
    if (child.exit_code != 0)
        throw PdfRefusal(PdfFault::kDamaged, "The file is damaged: what is inside it cannot be read.");
    return std::move(child.output);
}

int digit_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::string pdf_objects(const fs::path& file, StreamForm form, const PdfObjectLimits& limits) {
    Box box(limits.isolation);
    const std::string inside = box.add(file, "/box/document.pdf").string();
    return run_qpdf(box,
                    {"--json=2", "--json-key=qpdf", "--json-key=pages", "--json-stream-data=inline",
                     form == StreamForm::kDecoded ? "--decode-level=specialized" : "--decode-level=none", inside},
                    limits);
}

std::string pdf_with_objects(const fs::path& file, const std::string& objects, const PdfObjectLimits& limits) {
    const TemporaryFolder folder;
    write_work_file(folder.path() / "objects.json", objects);
    Box box(limits.isolation);
    const std::string json = box.add(folder.path() / "objects.json", "/box/objects.json").string();
    if (file.empty())
        return run_qpdf(box, {"--json-input", json, "--deterministic-id", "--object-streams=generate", "-"}, limits);
    const std::string inside = box.add(file, "/box/document.pdf").string();
    return run_qpdf(box, {"--decrypt", inside, "--update-from-json=" + json, "--deterministic-id", "-"}, limits);
}

std::string bytes_of_base64(const std::string& text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t collected = 0;
    int bits = 0;
    for (const char c : text) {
        const int value = digit_value(c);
        if (value < 0) break;
        collected = collected << 6 | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(collected >> bits & 0xFF);
    }
    return bytes;
}

std::string base64_of(const std::string& bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace dynlab::inline documents
