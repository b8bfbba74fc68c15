// WebGL is drawn by SwiftShader, in software: the same on a machine without a graphics card.
#include "tests/pictures/browser.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {

bool browser_present() {
  return run_shell("command -v chromium").exit_code == 0;
}

BrowserVisit visit(const std::filesystem::path& page, const std::string& more_flags, int budget_ms) {
  const Folder profile;
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --use-angle=swiftshader"
      " --enable-unsafe-swiftshader --disable-quic --no-first-run --disable-background-networking"
      " --disable-component-update --disable-sync --disable-dev-shm-usage --window-size=1200,900"
      " --enable-logging=stderr --v=0 --dump-dom --virtual-time-budget=" +
      std::to_string(budget_ms) + " " + more_flags + " --user-data-dir='" + (profile / "profile").string() +
      "' 'file://" + page.string() + "' > '" + (profile / "dom").string() + "' 2> '" +
      (profile / "log").string() + "'";
  EXPECT_EQ(run_shell(command).exit_code, 0) << content_of(profile / "log");
  BrowserVisit result{content_of(profile / "dom"), {}};
  for (const std::string& line : lines_of(content_of(profile / "log")))
    if (line.find("CONSOLE") != std::string::npos && line.find("GL Driver Message") == std::string::npos)
      result.console.push_back(line);
  return result;
}

} // namespace hopmesh::tests
