#include "documents/pdf/guarded_pdf.h"

#include <new>

#include "data_io/values/cbor_values.h"
#include "data_io/values/message_values.h"

namespace dynlab::inline documents {
namespace {

/// The first character of an answer: kDone, or this many above kDone a PdfFault, whose message follows.
constexpr char kDone = '0', kFirstFault = '1';

PdfRefusal crash() {
    return {PdfFault::kDamaged, Message("The file is damaged: the reader crashed.")};
}

/// What the copy says may come from the file.
PdfRefusal refusal_in(const std::string& answer) {
    try {
        return {static_cast<PdfFault>(answer.front() - kFirstFault), from_cbor<Message>(answer.substr(1))};
    } catch (const ValueError&) {
        return crash();
    }
}

std::string answer_of(const std::function<std::string()>& work) {
    try {
        return kDone + work();
    } catch (const PdfRefusal& refusal) {
        return static_cast<char>(kFirstFault + static_cast<int>(refusal.fault())) + cbor_of(refusal.message());
    } catch (const std::bad_alloc&) {
        return {};
    }
}

}  // namespace

std::string run_guarded_on_pdf(const std::function<std::string()>& work, const GuardLimits& limits) {
    ChildResult result = run_guarded([&] { return answer_of(work); }, limits);
    if (result.timed_out) {
        throw PdfRefusal(PdfFault::kTooLarge,
                         result.time_limit() == TimeLimit::kProcessor
                             ? Message("The file was not read: reading used more than {} s of processor time.",
                                       limits.time.seconds(TimeLimit::kProcessor))
                             : Message("The file was not read: reading did not finish within {} s.",
                                       limits.time.seconds(TimeLimit::kClock)));
    }
    if (result.output_exceeded || (result.exit_code == 0 && result.output.empty())) {
        throw PdfRefusal(PdfFault::kTooLarge,
                         Message("Reading the file requires more than {} MB of memory.", limits.memory_bytes >> 20));
    }
    if (result.exit_code != 0) throw crash();
    if (result.output.front() != kDone) throw refusal_in(result.output);
    result.output.erase(0, 1);
    return std::move(result.output);
}

}  // namespace dynlab::inline documents
