#include "course/names/jpeg_parts.h"

#include <algorithm>

#include "course/names/byte_text.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kEndOfScan = 4096;  ///< bytes behind the last block that decoders pass over
constexpr unsigned kScan = 0xDA, kEnd = 0xD9, kComment = 0xFE, kHuffman = 0xC4, kQuantisation = 0xDB;

/// One walk over the segments.
class JpegWalk {
  public:
    explicit JpegWalk(std::string_view bytes) : bytes_(bytes) {}

    JpegParts parts() {
        parts_.picture = bytes_.substr(0, 2);
        at_ = 2;
        while (at_ < bytes_.size() && take_segment()) {
        }
        if (!scanned_) return {std::string(bytes_), text_in(bytes_), ""};
        if (at_ < bytes_.size()) parts_.words += text_in(bytes_.substr(at_)) + '\n';
        return std::move(parts_);
    }

  private:
    unsigned byte(std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }

    /// False at the end of the picture.
    bool take_segment() {
        const std::size_t mark = std::min(bytes_.find('\xFF', at_), bytes_.size());
        if (mark > at_) parts_.words += text_in(bytes_.substr(at_, mark - at_)) + '\n';  // belongs to no segment
        at_ = mark;
        while (at_ + 1 < bytes_.size() && byte(at_ + 1) == 0xFF) ++at_;  // fill bytes, B.1.1.2
        if (at_ + 1 >= bytes_.size()) return false;
        const unsigned kind = byte(at_ + 1);
        if (kind == kEnd) {
            parts_.picture += "\xFF\xD9";
            at_ += 2;
            return false;
        }
        const bool bare = kind <= 0x01 || (kind >= 0xD0 && kind <= 0xD8);
        if (bare || at_ + 4 > bytes_.size()) {
            at_ += 2;
            return true;
        }
        const std::size_t length = std::max<std::size_t>(2, byte(at_ + 2) << 8 | byte(at_ + 3));
        const std::string_view content = bytes_.substr(std::min(at_ + 4, bytes_.size()), length - 2);
        at_ = std::min(at_ + 2 + length, bytes_.size());
        sort(kind, content);
        if (kind == kScan) take_scan();
        return true;
    }

    void sort(unsigned kind, std::string_view content) {
        const bool application = kind >= 0xE0 && kind <= 0xEF;
        const bool shown = (kind == 0xE0 && content.starts_with(std::string_view("JFIF\0", 5))) ||
                           (kind == 0xE2 && content.starts_with(std::string_view("ICC_PROFILE\0", 12))) ||
                           (kind == 0xEE && content.starts_with("Adobe"));
        const bool frame = kind >= 0xC0 && kind <= 0xDF && kind != 0xC8 && kind != 0xDE && kind != 0xDF;
        if (application || kind == kComment)
            parts_.words += text_in(content) + '\n';
        else
            parts_.tables += text_in(content) + '\n';
        if (shown || frame)
            keep(kind, kind == kQuantisation || kind == kHuffman ? whole_tables(kind, content) : content);
    }

    void keep(unsigned kind, std::string_view content) {
        const std::size_t length = content.size() + 2;
        for (const std::size_t part : {std::size_t{0xFF}, std::size_t{kind}, length >> 8, length & 0xFF})
            parts_.picture += static_cast<char>(part);
        parts_.picture += content;
    }

    /// Without what follows the last table, B.2.4.1 and B.2.4.2.
    static std::string_view whole_tables(unsigned kind, std::string_view content) {
        const auto byte_of = [content](std::size_t i) {
            return static_cast<std::size_t>(static_cast<unsigned char>(content[i]));
        };
        std::size_t end = 0;
        for (;;) {
            if (end >= content.size() || (byte_of(end) & 15) > 3 || byte_of(end) >> 4 > 1) break;
            std::size_t size = 1;
            if (kind == kQuantisation) {
                size += 64 * (1 + (byte_of(end) >> 4));
            } else {
                size += 16;
                for (std::size_t i = 1; i <= 16 && end + i < content.size(); ++i) size += byte_of(end + i);
            }
            if (end + size > content.size()) break;
            end += size;
        }
        return content.substr(0, end);
    }

    /// Coded blocks up to the next mark: FF 00 is a byte of theirs, RST a mark among them.
    void take_scan() {
        scanned_ = true;
        const std::size_t begin = at_;
        while (at_ < bytes_.size()) {
            at_ = std::min(bytes_.find('\xFF', at_), bytes_.size());
            const unsigned next = at_ + 1 < bytes_.size() ? byte(at_ + 1) : kEnd;
            if (next != 0 && !(next >= 0xD0 && next <= 0xD7)) break;
            at_ += 2;
        }
        at_ = std::min(at_, bytes_.size());
        const std::string_view blocks = bytes_.substr(begin, at_ - begin);
        parts_.picture += blocks;
        parts_.tables += text_in(blocks.substr(blocks.size() - std::min(blocks.size(), kEndOfScan))) + '\n';
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    bool scanned_ = false;
    JpegParts parts_;
};

}  // namespace

JpegParts parts_of_jpeg(std::string_view bytes) {
    return JpegWalk(bytes).parts();
}

}  // namespace dynlab::inline course
