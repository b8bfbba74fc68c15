// Writes the sample run's report and animation for looking at: picture_samples FOLDER. Not a test.
#include "sim/files/output_file.h"
#include "sim/pictures/gltf.h"
#include "sim/pictures/report.h"
#include "tests/pictures/sample_run.h"

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) try {
  using namespace hopmesh::pictures;
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  hopmesh::files::check_writable(folder, 20'000'000);
  RunView view = sample_run();
  write_report(view, folder / "report.html");
  write_report(view, folder / "report-without-three.html", "/nonexistent");
  write_glb(view, folder / "mesh.glb");
  view.good = false;
  view.crest = false;
  view.outcome = "LostMotion at step 212: node 57 left the range of the positions' format.";
  write_report(view, folder / "report-diverged.html");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
