#include "documents/pdf/pdf_objects.h"

#include <qpdf/Pipeline.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFExc.hh>
#include <qpdf/QPDFWriter.hh>

#include <algorithm>

#include "documents/pdf/guarded_pdf.h"
#include "documents/work_file.h"
#include "platform/confinement.h"

namespace dynlab::inline documents {
namespace {

/// Collects bytes up to a limit.
class Collector : public Pipeline {
  public:
    explicit Collector(std::uint64_t max_bytes) : Pipeline("collector", nullptr), max_bytes_(max_bytes) {}

    void write(const unsigned char* data, std::size_t count) override {
        full_ = full_ || count > max_bytes_ - bytes_.size();
        if (full_) throw std::length_error("too many bytes");  // libqpdf takes it for damage of the stream
        bytes_.append(reinterpret_cast<const char*>(data), count);
    }
    void finish() override {}

    /// Takes memory for a usual report at once, rather than moving from place to place; what is not used costs nothing.
    void expect_whole_file() { bytes_.reserve(std::min<std::uint64_t>(max_bytes_, 1u << 20)); }

    std::string take() {
        if (full_)
            throw PdfRefusal(PdfFault::kTooLarge, Message("The file exceeds {} MB when unpacked.", max_bytes_ >> 20));
        return std::move(bytes_);
    }

  private:
    std::uint64_t max_bytes_;
    bool full_ = false;
    std::string bytes_;
};

bool is_piped(QPDFObjectHandle& stream, Collector& into, qpdf_stream_decode_level_e level, bool& decoded) {
    return stream.pipeStreamData(&into, &decoded, 0, level, true, true);
}

}  // namespace

void read_pdf(QPDF& pdf, const std::string& bytes) {
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("PDF", bytes.data(), bytes.size());
}

std::string work_on_pdf_objects(const std::filesystem::path& file, const PdfObjectLimits& limits, const PdfWork& work) {
    const auto guarded = [&] {
        const std::string bytes = read_work_file(file);
        if (is_guarded_copy()) confine_to_memory();
        try {
            QPDF pdf;
            read_pdf(pdf, bytes);
            return work(pdf, bytes);
        } catch (const PdfRefusal&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const QPDFExc& error) {
            if (error.getErrorCode() == qpdf_e_password)
                throw PdfRefusal(PdfFault::kEncrypted,
                                 Message("The file is encrypted: save the PDF without a password."));
        } catch (const std::exception&) {
            // What libqpdf says of objects that are not of the kind they should be.
        }
        throw PdfRefusal(PdfFault::kDamaged, Message("The file is damaged: its contents cannot be read."));
    };
    return run_guarded_on_pdf(guarded, {{limits.time}, limits.memory_bytes, limits.bytes_inside});
}

StreamContent stream_content(QPDFObjectHandle stream, std::uint64_t max_bytes) {
    StreamContent content;
    Collector collector(max_bytes);
    const bool whole = is_piped(stream, collector, qpdf_dl_specialized, content.decoded);
    content.bytes = collector.take();
    if (whole) return content;
    content.decoded = false;
    content.bytes = stored_bytes(stream);
    return content;
}

std::string stored_bytes(QPDFObjectHandle stream) {
    bool decoded = false;
    Collector collector(std::numeric_limits<std::uint64_t>::max());
    is_piped(stream, collector, qpdf_dl_none, decoded);
    return collector.take();
}

std::string written_pdf(QPDF& pdf, std::uint64_t max_bytes, const std::function<void(QPDFWriter&)>& choose) {
    Collector collector(max_bytes);
    collector.expect_whole_file();
    QPDFWriter writer(pdf);
    writer.setOutputPipeline(&collector);
    writer.setDeterministicID(true);
    writer.setPreserveEncryption(false);
    if (choose) choose(writer);
    try {
        writer.write();
    } catch (const std::length_error&) {  // the collector's; take() says so
    }
    return collector.take();
}

}  // namespace dynlab::inline documents
