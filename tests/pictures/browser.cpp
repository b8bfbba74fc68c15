// WebGL is drawn by SwiftShader, in software: the same on a machine without a graphics card.
#include "tests/pictures/browser.h"
#include "tests/support/folder.h"

#include <sstream>

namespace hopmesh::pictures {

bool browser_present() {
  return std::system("command -v chromium > /dev/null 2>&1") == 0;
}

BrowserVisit visit(const std::filesystem::path& page, const std::string& more_flags, int budget_ms) {
  const tests::Folder profile;
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --use-angle=swiftshader"
      " --enable-unsafe-swiftshader --disable-quic --no-first-run --disable-background-networking"
      " --disable-component-update --disable-sync --disable-dev-shm-usage --window-size=1200,900"
      " --enable-logging=stderr --v=0 --dump-dom --virtual-time-budget=" +
      std::to_string(budget_ms) + " " + more_flags + " --user-data-dir='" + (profile / "profile").string() +
      "' 'file://" + page.string() + "' > '" + (profile / "dom").string() + "' 2> '" +
      (profile / "log").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << tests::content_of(profile / "log");
  BrowserVisit result{tests::content_of(profile / "dom"), {}};
  std::istringstream log(tests::content_of(profile / "log"));
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos && line.find("GL Driver Message") == std::string::npos)
      result.console.push_back(line);
  return result;
}

} // namespace hopmesh::pictures
