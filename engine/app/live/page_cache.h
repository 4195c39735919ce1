#pragma once
#include <optional>

#include "app/live/page_content.h"
#include "platform/cache.h"
#include "workflow/make_report.h"

namespace dynlab::inline app {

/// Keeps the page of a document that has run to its end, so that it is whole at once when it is opened again and
/// neither script, template nor data have changed: of each document the last page. It never throws; what cannot be kept
/// is not, and nothing is recalled where that cannot be told.
class PageMemory {
  public:
    std::optional<PageContent> load_entry(const ReportRequest& request) const;
    void save_entry(const ReportRequest& request, const std::vector<std::filesystem::path>& files,
                    const PageContent& content) const;

  private:
    Cache cache_;
};

}  // namespace dynlab::inline app
