#include "app/live/page_cache.h"

#include "data_io/values/cbor_values.h"
#include "workflow/inputs_read.h"
#include "workflow/report_cache.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

/// A page, what it was made from, and what its run read.
struct KnownPage {
    std::string origins;
    InputsRead inputs;
    PageContent content;
};
DYNLAB_DESCRIBE(KnownPage, origins, inputs, content)

/// The same for every version of a document, whatever the program: the last page takes the place of the one before.
std::string page_entry_of(const ReportRequest& request) {
    EntryName name("pages", "1");
    for (const fs::path& file : {request.script.file, request.template_file})
        name.add(fs::absolute(file).lexically_normal().string());
    return name.text();
}

}  // namespace

std::optional<PageContent> PageMemory::load_entry(const ReportRequest& request) const {
    if (!cache_.lasting()) return {};
    try {
        const auto entry = cache_.load_entry(page_entry_of(request));
        if (!entry) return {};
        KnownPage known = from_cbor<KnownPage>(*entry, ValueLimits::own());
        if (known.origins != digest_of_origins(request) || !unchanged(known.inputs)) return {};
        return std::move(known.content);
    } catch (const std::exception&) {  // corrupt, or a file cannot be read: the page is then made again
        return {};
    }
}

void PageMemory::save_entry(const ReportRequest& request, const std::vector<fs::path>& files,
                            const PageContent& content) const {
    if (!cache_.lasting()) return;
    try {
        const InputsRead inputs = inputs_read(files, fs::absolute(request.script.file).parent_path());
        cache_.save_entry(page_entry_of(request), cbor_of(KnownPage{digest_of_origins(request), inputs, content}));
    } catch (const std::exception&) {  // a file cannot be read: then it will be made again
    }
}

}  // namespace dynlab::inline app
