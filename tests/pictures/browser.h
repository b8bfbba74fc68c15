// Opens a page in headless Chromium, as a user's browser would, and tells what came of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hopmesh::tests {

struct BrowserVisit {
  std::string dom; ///< the page after its scripts have run
  std::vector<std::string>
      console; ///< everything said on the console but the graphics driver's remarks on speed
};

bool browser_present();
/// `budget_ms`: of the page's own time, after which it is looked at.
BrowserVisit visit(const std::filesystem::path& page, const std::string& more_flags = "",
                   int budget_ms = 4000);

} // namespace hopmesh::tests
