#pragma once
#include <optional>

#include "app/live/page_content.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline app {

/// Caches the last page of each document that has run to its end. The page appears complete at once when the document
/// is opened again and neither script, template nor data have changed. The cache never throws: a page that cannot be
/// cached is not cached, and there is no cache hit if changes cannot be ruled out.
class PageMemory {
  public:
    std::optional<PageContent> load_entry(const ReportRequest& request) const;
    void save_entry(const ReportRequest& request, const std::vector<std::filesystem::path>& files,
                    const PageContent& content) const;

  private:
    Cache cache_;
};

}  // namespace dynlab::inline app
