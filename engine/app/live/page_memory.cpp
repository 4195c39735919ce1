#include "app/live/page_memory.h"

#include "data_io/values/cbor_values.h"
#include "workflow/inputs_read.h"
#include "workflow/report_cache.h"

namespace dynlab::inline app {
namespace {

/// What the run read, and the page.
using KnownPage = std::pair<InputsRead, PageContent>;

}  // namespace

std::optional<PageContent> PageMemory::recall(const ReportRequest& request) const {
    if (!cache_.lasting()) return {};
    const auto known = cache_.recall(name_of_report(request, "pages"));
    if (!known) return {};
    try {
        auto [inputs, content] = from_cbor<KnownPage>(*known, ValueLimits::own());
        if (!unchanged(inputs)) return {};
        return std::move(content);
    } catch (const ValueError&) {  // spoilt: then the page is made
        return {};
    }
}

void PageMemory::remember(const ReportRequest& request, const RunRecord& record, const PageContent& content) const {
    if (!cache_.lasting()) return;
    const InputsRead inputs = inputs_read(record, std::filesystem::absolute(request.script.file).parent_path());
    cache_.remember(name_of_report(request, "pages"), cbor_of(KnownPage{inputs, content}));
}

}  // namespace dynlab::inline app
