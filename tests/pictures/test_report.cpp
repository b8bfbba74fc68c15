// The report as a reader's browser sees it: with WebGL, without, without three.js, and with names that mean
// harm.
#include "sim/files/output_file.h"
#include "sim/pictures/report.h"
#include "tests/pictures/browser.h"
#include "tests/pictures/sample_run.h"
#include "tests/support/files.h"

#include <gmock/gmock.h>
#include <limits>

namespace hopmesh::tests {
namespace {

using namespace pictures;

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

#define NEED_BROWSER                                                                                         \
  if (!browser_present()) GTEST_SKIP() << "chromium is not installed"

RunView small_run() {
  return sample_run(8, 24, 60);
}

/// Writes the page, opens it, and after it is ready runs `script` in it (which may note things on the html
/// element). On a busy machine drawing in software may outlast the page's time: then it gets more.
BrowserVisit opened(const RunView& view, const std::string& flags = "", const std::string& script = "",
                    const std::filesystem::path& three = debian_three_folder) {
  const Folder folder;
  write_report(view, folder / "report.html", three);
  std::string page = content_of(folder / "report.html");
  const std::string watch =
      "<script>addEventListener('load', () => { const wait = setInterval(() => { const html = "
      "document.documentElement; if (html.dataset.ready !== 'true') return; "
      "clearInterval(wait); " +
      script + " html.dataset.told = true; }, 50); });</script></body>";
  page.replace(page.rfind("</body>"), 7, watch);
  files::write_file(folder / "report.html", page);
  BrowserVisit page_seen;
  for (int budget_ms = 4000; budget_ms <= 32000; budget_ms *= 2) {
    page_seen = visit(folder / "report.html", flags, budget_ms);
    if (page_seen.dom.find("data-told=\"true\"") != std::string::npos) break;
  }
  return page_seen;
}

/// The opening tag of the page, which carries what the page and the tests note.
std::string html_tag(const BrowserVisit& page) {
  const auto at = page.dom.find("<html");
  return page.dom.substr(at, page.dom.find('>', at) - at);
}

bool three_present() {
  return std::filesystem::exists(std::string(debian_three_folder) + "/three.min.js");
}

TEST(Report, DrawsWithWebgl) {
  NEED_BROWSER;
  if (!three_present()) GTEST_SKIP() << "libjs-three is not installed";
  const auto page = opened(small_run());
  EXPECT_THAT(page.console, IsEmpty());
  EXPECT_THAT(html_tag(page), HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(html_tag(page), HasSubstr("data-renderer=\"webgl\""));
}

TEST(Report, DrawsOnACanvasWhereThereIsNoWebgl) {
  NEED_BROWSER;
  const auto page = opened(small_run(), "--disable-3d-apis");
  EXPECT_THAT(page.console, IsEmpty());
  EXPECT_THAT(html_tag(page), HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(html_tag(page), HasSubstr("data-renderer=\"canvas\""));
}

TEST(Report, DrawsOnACanvasWhereThreeWasNotInstalled) {
  NEED_BROWSER;
  const auto page = opened(small_run(), "", "", "/nonexistent");
  EXPECT_THAT(page.console, IsEmpty());
  EXPECT_THAT(html_tag(page), HasSubstr("data-renderer=\"canvas\""));
  EXPECT_THAT(page.dom, HasSubstr("three.js was not at hand"));
}

TEST(Report, PictureIsNotBlank) {
  NEED_BROWSER;
  const auto page = opened(small_run(), "--disable-3d-apis", R"(
    const c = document.querySelector('#view canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    const seen = new Set();
    for (let i = 0; i < d.length; i += 4) if (d[i + 3]) seen.add(d[i] * 65536 + d[i + 1] * 256 + d[i + 2]);
    html.dataset.colours = seen.size > 200 ? 'many' : String(seen.size);)");
  EXPECT_THAT(html_tag(page), HasSubstr("data-colours=\"many\""));
}

TEST(Report, PictureOfWebglIsNotBlank) {
  NEED_BROWSER;
  if (!three_present()) GTEST_SKIP() << "libjs-three is not installed";
  const auto page = opened(small_run(), "", R"(
    hopmesh.frame(6); // draws at once, so that the picture can be read back before it is shown
    const c = document.querySelector('#view canvas'), gl = c.getContext('webgl'), d = new Uint8Array(c.width * c.height * 4);
    gl.readPixels(0, 0, c.width, c.height, gl.RGBA, gl.UNSIGNED_BYTE, d);
    const seen = new Set();
    for (let i = 0; i < d.length; i += 4) if (d[i + 3]) seen.add(d[i] * 65536 + d[i + 1] * 256 + d[i + 2]);
    html.dataset.colours = seen.size > 200 ? 'many' : String(seen.size);)");
  EXPECT_THAT(html_tag(page), HasSubstr("data-colours=\"many\""));
}

TEST(Report, HoveringAChartMovesTheViewAndTheOtherCharts) {
  NEED_BROWSER;
  const auto page = opened(small_run(), "", R"(
    hopmesh.frame(6);
    html.dataset.frame = document.querySelector('#clock b').textContent;
    const charts = document.querySelectorAll('.chart svg'), box = charts[0].getBoundingClientRect();
    charts[0].dispatchEvent(new PointerEvent('pointermove', { clientX: box.right - 10, clientY: box.top + 50 }));
    html.dataset.hover = document.querySelector('#clock b').textContent;
    html.dataset.same = new Set([...document.querySelectorAll('.cursor')].map((c) => c.getAttribute('x1'))).size;)");
  EXPECT_THAT(page.console, IsEmpty());
  EXPECT_THAT(html_tag(page), HasSubstr("data-frame=\"5.22 s\"")) << "frame 6 of 24 over 20 s";
  EXPECT_THAT(html_tag(page), HasSubstr("data-hover=\"3.00 s\"")) << "the series end at step 60 of 0.05 s";
  EXPECT_THAT(html_tag(page), HasSubstr("data-same=\"1\""));
}

TEST(Report, EveryButtonWorksInBothRenderers) {
  NEED_BROWSER;
  for (const char* flags : {"", "--disable-3d-apis"}) {
    const auto page = opened(small_run(), flags, R"(
      for (const id of ['play', 'springs', 'pins', 'home']) document.getElementById(id).click();
      document.getElementsByName('paint')[1].click();
      document.getElementById('view').dispatchEvent(new WheelEvent('wheel', { deltaY: 120, cancelable: true }));
      hopmesh.frame(0);
      hopmesh.frame(1000);
      html.dataset.legend = !document.getElementById('legend').hidden;)");
    EXPECT_THAT(page.console, IsEmpty());
    EXPECT_THAT(html_tag(page), HasSubstr("data-legend=\"true\""));
  }
}

TEST(Report, DivergedMotionIsStillDrawn) {
  NEED_BROWSER;
  RunView view = small_run();
  view.good = false;
  for (std::size_t f = 12; f < 24; ++f)
    for (std::size_t i = 0; i < view.frames[f].size(); ++i)
      view.frames[f][i] = f < 16 ? 1e30f : std::numeric_limits<float>::quiet_NaN();
  view.series[2].values[40] = std::numeric_limits<double>::infinity();
  view.series[3].values.assign(60, std::numeric_limits<double>::quiet_NaN());
  for (const char* flags : {"", "--disable-3d-apis"}) {
    const auto page = opened(view, flags, "for (let k = 0; k < 24; ++k) hopmesh.frame(k);");
    EXPECT_THAT(page.console, IsEmpty());
    EXPECT_THAT(html_tag(page), HasSubstr("data-ready=\"true\""));
    EXPECT_THAT(page.dom, HasSubstr("class=\"bad\""));
  }
}

TEST(Report, EmptyRunsAndMeshesWithoutSurfaceAreShown) {
  NEED_BROWSER;
  RunView bare = small_run();
  bare.triangles.clear();
  for (const RunView& view : {RunView{}, bare, sample_run(3, 1, 1)}) {
    const auto page = opened(view);
    EXPECT_THAT(page.console, IsEmpty());
    EXPECT_THAT(html_tag(page), HasSubstr("data-ready=\"true\""));
  }
}

TEST(Report, HostileNamesStayText) {
  const std::string evil = "</script><script>document.documentElement.dataset.owned=1</script>"
                           "<img src=x onerror=\"document.documentElement.dataset.owned=2\">"
                           "{{css}} ${1} \\u003c \xe2\x80\xa8 \xff '\"&amp; <!-- ]]>";
  RunView view = small_run();
  view.title = view.subtitle = view.outcome = view.manifest = evil;
  view.series[0].name = view.series[0].unit = evil;
  view.tables[0] = {evil, {{evil, evil}}};
  const Folder folder;
  write_report(view, folder / "report.html");
  EXPECT_THAT(content_of(folder / "report.html"), Not(HasSubstr("<script>document")));
  NEED_BROWSER;
  const auto page = opened(view);
  EXPECT_THAT(page.console, IsEmpty());
  EXPECT_THAT(html_tag(page), HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(html_tag(page), Not(HasSubstr("owned")));
  EXPECT_THAT(page.dom, HasSubstr("&lt;/script&gt;&lt;script&gt;document"));
}

TEST(Report, AsksNobodyForAnything) {
  const Folder folder;
  write_report(small_run(), folder / "report.html");
  const std::string page = content_of(folder / "report.html");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* outside : {"src=\"http", "href=\"http", "url(http", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST(Report, SameRunSameBytes) {
  const Folder folder;
  write_report(small_run(), folder / "a.html");
  write_report(small_run(), folder / "b.html");
  EXPECT_EQ(content_of(folder / "a.html"), content_of(folder / "b.html"));
}

TEST(Report, BrowserTestsWouldSeeAnError) {
  NEED_BROWSER;
  const Folder folder;
  files::write_file(folder / "bad.html", "<!DOCTYPE html><script>undefinedFunction();</script>");
  EXPECT_THAT(visit(folder / "bad.html").console, Not(IsEmpty()));
}

} // namespace
} // namespace hopmesh::tests
