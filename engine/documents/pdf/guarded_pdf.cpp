#include "documents/pdf/guarded_pdf.h"

#include <fmt/format.h>

#include <new>

namespace dynlab::inline documents {
namespace {

/// The first character of an answer: kDone, or this many above kDone a PdfFault, whose sentence follows.
constexpr char kDone = '0', kFirstFault = '1';

std::string answer_of(const std::function<std::string()>& work) {
    try {
        return kDone + work();
    } catch (const PdfRefusal& refusal) {
        return static_cast<char>(kFirstFault + static_cast<int>(refusal.fault())) + std::string(refusal.what());
    } catch (const std::bad_alloc&) {
        return {};
    }
}

}  // namespace

std::string run_guarded_on_pdf(const std::function<std::string()>& work, const GuardLimits& limits) {
    ChildResult result = run_guarded([&] { return answer_of(work); }, limits);
    if (result.timed_out) {
        throw PdfRefusal(PdfFault::kTooLarge,
                         fmt::format("The file is not read: reading it {}.", limits.time.told(result.time_limit())));
    }
    if (result.output_exceeded || (result.exit_code == 0 && result.output.empty())) {
        throw PdfRefusal(PdfFault::kTooLarge,
                         fmt::format("Reading the file takes more than {} MB of memory.", limits.memory_bytes >> 20));
    }
    if (result.exit_code != 0) throw PdfRefusal(PdfFault::kDamaged, "The file is damaged: reading it ends in a crash.");
    const char sign = result.output.front();
    result.output.erase(0, 1);
    if (sign != kDone) throw PdfRefusal(static_cast<PdfFault>(sign - kFirstFault), result.output);
    return std::move(result.output);
}

}  // namespace dynlab::inline documents
