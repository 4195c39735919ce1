#include "documents/pdf/plain_streams.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "documents/pdf/inflate.h"
#include "documents/pdf/pdf_scanner.h"

namespace dynlab::inline documents {
namespace {

constexpr std::size_t kMostInside = 64u << 20, kLastBytes = 1024, kMostEntries = 1u << 20;

/// A stream as it stands in the file.
struct Stream {
    PdfEntries entries;
    std::string_view data;
    bool has(std::string_view key) const { return entries.contains(key); }
    bool is(std::string_view key, std::string_view value) const {
        const auto found = entries.find(key);
        return found != entries.end() && found->second == value;
    }
};

class PlainStreams {
  public:
    explicit PlainStreams(std::string_view pdf) : pdf_(pdf) {
        if (!pdf.starts_with("%PDF-")) throw UnusualPdf();
        const std::size_t last = pdf.rfind("startxref");
        if (last == pdf.npos || pdf.size() - last > kLastBytes) throw UnusualPdf();
        PdfScanner scanner(pdf, last);
        scanner.expect("startxref");
        table_ = scanner.number();
        PdfScanner at_table(pdf, table_);
        trailer_ = at_table.takes("xref") ? read_table(at_table) : read_table_stream();
        for (const char* unusual : {"/Prev", "/Encrypt", "/XRefStm"})
            if (trailer_.contains(unusual)) throw UnusualPdf();
        // A reader that finds a wrong place searches the file for its objects; the new table must not keep it from
        // that.
        for (std::size_t number = 0; number < rows_.size(); ++number)
            if (rows_[number].kind == Row::kPlaced) object_at(number, rows_[number]);
    }

    /// What must stand behind the file: objects unpacked, streams written out, and a table of all.
    std::string update() {
        objects_ = "\n";
        std::map<std::size_t, std::vector<std::size_t>> packed;  // by the stream that holds them
        std::vector<std::size_t> placed;
        for (std::size_t number = 0; number < rows_.size(); ++number) {
            if (rows_[number].kind == Row::kPlaced) placed.push_back(number);
            if (rows_[number].kind == Row::kPacked) packed[rows_[number].first].push_back(number);
        }
        for (const auto& [stream, numbers] : packed) unpack(stream, numbers);
        for (const std::size_t number : placed)
            if (!unpacked_.contains(number)) write_out(number);
        const std::size_t start = pdf_.size() + objects_.size();
        rows_.push_back({Row::kPlaced, start, 0});
        return objects_ + table() + fmt::format("startxref\n{}\n%%EOF\n", start);
    }

  private:
    /// Of the table: an object's place and generation, or the packed stream that holds it and its place in there.
    struct Row {
        enum Kind : std::size_t { kFree = 0, kPlaced = 1, kPacked = 2 };
        std::size_t kind = kFree, first = 0, second = 0;
    };

    void note(std::size_t number, const Row& row) {
        if (number >= kMostEntries || row.second > 0xFFFF) throw UnusualPdf();
        if (number >= rows_.size()) rows_.resize(number + 1);
        if (rows_[number].kind != Row::kFree) throw UnusualPdf();
        rows_[number] = row;
    }

    PdfEntries read_table(PdfScanner& scanner) {
        for (bool first = true; !scanner.takes("trailer"); first = false) {
            const std::size_t start = scanner.number(), count = scanner.number();
            if (first && start != 0) throw UnusualPdf();
            for (std::size_t i = 0; i < count; ++i) {
                Row row;
                row.first = scanner.number(), row.second = scanner.number();
                row.kind = scanner.takes("n") ? Row::kPlaced : Row::kFree;
                if (row.kind == Row::kFree) scanner.expect("f");
                note(start + i, row);
            }
        }
        return scanner.dictionary();
    }

    /// The table as a stream (7.5.8), also when each row holds the difference to the one before.
    PdfEntries read_table_stream() {
        PdfScanner scanner(pdf_, table_);
        const std::size_t number = scanner.number(), generation = scanner.number();
        const Stream stream = stream_at(number, {Row::kPlaced, table_, generation});
        const std::vector<std::size_t> widths = numbers_of(stream, "/W");
        if (!stream.is("/Type", "/XRef") || !stream.is("/Filter", "/FlateDecode") || widths.size() != 3)
            throw UnusualPdf();
        for (const std::size_t width : widths)
            if (width > 8) throw UnusualPdf();
        const std::size_t row = widths[0] + widths[1] + widths[2];
        std::string rows = inflated(stream.data);
        if (stream.has("/DecodeParms")) rows = summed(stream, rows, row);
        std::size_t at = 0;
        const auto field = [&](std::size_t width) {
            std::size_t value = 0;
            for (std::size_t i = 0; i < width; ++i) value = value << 8 | static_cast<unsigned char>(rows[at++]);
            return value;
        };
        for (std::size_t i = 0; at + row <= rows.size() && row > 0; ++i) {
            Row found;
            found.kind = widths[0] == 0 ? Row::kPlaced : field(widths[0]);
            found.first = field(widths[1]), found.second = field(widths[2]);
            if (found.kind > Row::kPacked) throw UnusualPdf();
            note(i, found);
        }
        check_index(stream, row == 0 ? 0 : rows.size() / row);
        return stream.entries;
    }

    /// All objects from 0 on.
    static void check_index(const Stream& stream, std::size_t rows) {
        if (stream.has("/Index") && numbers_of(stream, "/Index") != std::vector<std::size_t>{0, rows})
            throw UnusualPdf();
        if (numbers_of(stream, "/Size") != std::vector<std::size_t>{rows}) throw UnusualPdf();
    }

    static std::string summed(const Stream& stream, const std::string& rows, std::size_t width) {
        const PdfEntries how = PdfScanner(stream.entries.at("/DecodeParms"), 0).dictionary();
        const auto predictor = how.find("/Predictor"), columns = how.find("/Columns");
        if (how.size() != 2 || predictor == how.end() || predictor->second != "12" || columns == how.end() ||
            columns->second != std::to_string(width))
            throw UnusualPdf();
        std::string sums, above(width, '\0');
        for (std::size_t at = 0; at + width < rows.size(); at += width + 1) {
            if (rows[at] != 2) throw UnusualPdf();
            for (std::size_t i = 0; i < width; ++i) above[i] = static_cast<char>(above[i] + rows[at + 1 + i]);
            sums += above;
        }
        return sums;
    }

    static std::size_t number_of(const Stream& stream, std::string_view key) { return numbers_of(stream, key).front(); }

    static std::vector<std::size_t> numbers_of(const Stream& stream, std::string_view key) {
        const auto found = stream.entries.find(key);
        if (found == stream.entries.end()) throw UnusualPdf();
        const bool list = found->second.starts_with('[');
        PdfScanner scanner(found->second, list ? 1 : 0);
        std::vector<std::size_t> numbers;
        do numbers.push_back(scanner.number());
        while (list && !scanner.takes("]"));
        return numbers;
    }

    /// At the beginning of what an object holds.
    PdfScanner object_at(std::size_t number, const Row& row) const {
        PdfScanner scanner(pdf_, row.first);
        if (scanner.number() != number || scanner.number() != row.second) throw UnusualPdf();
        scanner.expect("obj");
        return scanner;
    }

    Stream stream_at(std::size_t number, const Row& row) const {
        PdfScanner scanner = object_at(number, row);
        Stream stream;
        stream.entries = scanner.dictionary();
        if (!scanner.takes("stream")) throw UnusualPdf();
        scanner.end_line();
        stream.data = pdf_.substr(scanner.at(), length_of(stream));
        PdfScanner(pdf_, scanner.at() + stream.data.size()).expect("endstream");
        return stream;
    }

    std::size_t length_of(const Stream& stream) const {
        const auto found = stream.entries.find("/Length");
        if (found == stream.entries.end()) throw UnusualPdf();
        PdfScanner scanner(found->second, 0);
        const std::size_t first = scanner.number();
        if (scanner.at() == found->second.size()) return first;
        if (first >= rows_.size() || rows_[first].kind != Row::kPlaced) throw UnusualPdf();
        return object_at(first, rows_[first]).number();
    }

    std::string inflated(std::string_view data) {
        if (inside_ >= kMostInside) throw UnusualPdf();
        Inflated result = inflate(data, kMostInside - inside_);
        inside_ += result.bytes.size();
        if (!result.whole) throw UnusualPdf();
        return std::move(result.bytes);
    }

    static bool is_plainly_compressed(const Stream& stream) {
        const bool plainly = stream.is("/Filter", "/FlateDecode") || stream.is("/Filter", "[/FlateDecode]") ||
                             stream.is("/Filter", "[ /FlateDecode ]");
        return plainly && !stream.has("/DecodeParms") && !stream.has("/DP") && !stream.has("/F");
    }

    static bool need_not_be_read(const Stream& stream) {
        return stream.is("/Subtype", "/Image") || stream.is("/Type", "/EmbeddedFile") || stream.is("/Type", "/XRef") ||
               stream.is("/Type", "/Metadata");
    }

    void begin_object(std::size_t number) {
        rows_[number] = {Row::kPlaced, pdf_.size() + objects_.size(),
                         rows_[number].kind == Row::kPlaced ? rows_[number].second : 0};
        objects_ += fmt::format("{} {} obj\n", number, rows_[number].second);
    }

    struct Held {
        std::size_t number = 0;
        std::string_view text;
    };

    /// In their order; `data` begins with the number and place of each.
    static std::vector<Held> held_in(const Stream& stream, std::string_view data) {
        const std::size_t count = number_of(stream, "/N"), first = number_of(stream, "/First");
        if (count > kMostEntries || first > data.size()) throw UnusualPdf();
        PdfScanner header(data.substr(0, first), 0);
        const std::string_view texts = data.substr(first);
        std::vector<Held> held;
        for (std::size_t i = 0, before = 0; i < count; ++i) {
            const std::size_t number = header.number(), begin = header.number();
            if (begin < before || begin > texts.size()) throw UnusualPdf();
            if (i > 0) held.back().text = held.back().text.substr(0, begin - before);
            held.push_back({number, texts.substr(begin)});
            before = begin;
        }
        return held;
    }

    /// Writes the objects that a stream holds (7.5.7) as objects of their own: all or none.
    void unpack(std::size_t holder, const std::vector<std::size_t>& numbers) {
        if (holder >= rows_.size() || rows_[holder].kind != Row::kPlaced) return;
        std::vector<std::string> values;
        try {
            const Stream stream = stream_at(holder, rows_[holder]);
            if (!stream.is("/Type", "/ObjStm") || !is_plainly_compressed(stream)) return;
            const std::string data = inflated(stream.data);
            const std::vector<Held> held = held_in(stream, data);
            for (const std::size_t number : numbers) {
                const std::size_t place = rows_[number].second;
                if (place >= held.size() || held[place].number != number) return;
                values.emplace_back(PdfScanner(held[place].text, 0).value());
            }
        } catch (const UnusualPdf&) {
            return;
        }
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            begin_object(numbers[i]);
            objects_ += values[i] + "\nendobj\n";
        }
        unpacked_.insert(holder);
    }

    /// A compressed stream without its compression; nothing for any other object and for what need not be read.
    void write_out(std::size_t number) {
        try {
            const Stream stream = stream_at(number, rows_[number]);
            if (!is_plainly_compressed(stream) || need_not_be_read(stream)) return;
            const std::string data = inflated(stream.data);
            begin_object(number);
            objects_ += "<<";
            for (const auto& [key, entry] : stream.entries)
                if (key != "/Filter" && key != "/Length") objects_ += fmt::format("{} {}\n", key, entry);
            objects_ += fmt::format("/Length {}>>\nstream\n", data.size()) + data + "\nendstream\nendobj\n";
        } catch (const UnusualPdf&) {
            // It stays as it is.
        }
    }

    /// As a stream of its own, the last object.
    std::string table() const {
        std::string text = fmt::format("{} 0 obj\n<</Type /XRef /W [1 8 2] /Size {}\n", rows_.size() - 1, rows_.size());
        for (const char* key : {"/Root", "/Info", "/ID"})
            if (const auto found = trailer_.find(key); found != trailer_.end())
                text += fmt::format("{} {}\n", key, found->second);
        text += fmt::format("/Length {}>>\nstream\n", 11 * rows_.size());
        for (const Row& row : rows_) {
            text += static_cast<char>(row.kind);
            for (int shift = 56; shift >= 0; shift -= 8) text += static_cast<char>(row.first >> shift & 0xFF);
            for (int shift = 8; shift >= 0; shift -= 8) text += static_cast<char>(row.second >> shift & 0xFF);
        }
        return text + "\nendstream\nendobj\n";
    }

    std::string_view pdf_;
    std::size_t table_ = 0, inside_ = 0;
    std::string objects_;
    std::set<std::size_t> unpacked_;
    std::vector<Row> rows_;  ///< by the objects' numbers
    PdfEntries trailer_;
};

}  // namespace

std::string with_plain_streams(std::string pdf) {
    std::string update;
    try {
        update = PlainStreams(pdf).update();
    } catch (const UnusualPdf&) {
        return pdf;
    }
    return pdf += update;
}

}  // namespace dynlab::inline documents
