#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "documents/pictures.h"

namespace dynlab::inline documents {

/// "image/svg+xml" for ".svg"; empty for what browsers do not show.
std::string media_type(const std::string& extension);

/// What follows the picture of a figure in a page, for plot.js to draw it from; empty without a plot.
std::string plot_element(const std::string& plot);

/// HTML with the pictures themselves (RFC 2397 data URL) for every `src="WRITTEN_NAME"`, followed by their plots; a
/// picture without a file is left empty.
std::string with_inlined_pictures(const std::string& html, const std::vector<PlacedPicture>& pictures);

/// What Pandoc made with html/document.html as one file that needs nothing else: style, scripts and
/// pictures are put in. The page's policy lets exactly these scripts run, by their hash (Content Security Policy
/// Level 3).
std::string whole_web_page(const std::string& html, const std::filesystem::path& shared_templates,
                           const std::vector<PlacedPicture>& pictures);

/// The scripts of every page that shows documents, in their order. script_catalogs() must precede them.
std::string shown_scripts(const std::filesystem::path& shared_templates);
/// All scripts of a self-contained page, with the translations into its language, which may name a region.
std::string scripts_of_pages(const std::filesystem::path& shared_templates, const std::string& language);

}  // namespace dynlab::inline documents
