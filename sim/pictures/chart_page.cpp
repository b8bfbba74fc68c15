#include "sim/pictures/chart_page.h"

#include "sim/pictures/svg_canvas.h"

#include <fmt/format.h>

namespace hopmesh::pictures {

namespace {

constexpr const char* style =
    R"(body{font:15px/1.5 system-ui,"DejaVu Sans",sans-serif;margin:0;color:#222;background:#f5f5f3}
main{max-width:1140px;margin:24px auto;padding:0 20px}figure{margin:0;background:#fff;border:1px solid #ddd;border-radius:8px;overflow:hidden}
svg{display:block;width:100%;height:auto}.point,.cell{cursor:pointer}.point:hover{r:8px}
#tip{min-height:7.5em;margin:14px 0;padding:12px 16px;background:#fff;border:1px solid #ddd;border-radius:8px;white-space:pre-wrap}
#tip code{display:block;margin-top:6px;font:13px/1.5 ui-monospace,"DejaVu Sans Mono",monospace;color:#0b5394;word-break:break-all}
.table{overflow:auto;max-height:480px;background:#fff;border:1px solid #ddd;border-radius:8px}
table{border-collapse:collapse;font-size:12px;white-space:nowrap}th,td{padding:4px 10px;border-bottom:1px solid #eee;text-align:left}
th{position:sticky;top:0;background:#fafafa})";

// textContent only: what a study says is never markup.
constexpr const char* script = R"(const tip=document.getElementById('tip');let kept=false;
function tell(mark){const lines=mark.querySelector('title').textContent.split('\n');const command=mark.dataset.command;
tip.textContent=lines.filter(line=>line!==command).join('\n');const code=document.createElement('code');code.textContent=command;tip.append(code);}
for(const mark of document.querySelectorAll('[data-command]')){mark.addEventListener('mouseenter',()=>{if(!kept)tell(mark);});
mark.addEventListener('click',event=>{kept=true;tell(mark);event.stopPropagation();});}
document.addEventListener('click',event=>{if(!tip.contains(event.target))kept=false;});)";

std::string row_of(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return row + "</tr>\n";
}

} // namespace

std::string chart_page(const std::string& title, const std::string& svg, const files::CsvTable& table) {
  std::string rows;
  for (const auto& row : table.rows) rows += row_of(row, "td");
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>{}"
      "</style></head>\n<body><main><figure>\n{}</figure>\n<div id=\"tip\">Point at a mark: its settings "
      "and the command that repeats it. A click keeps them for copying.</div>\n<div "
      "class=\"table\"><table><thead>{}</thead><tbody>\n{}</tbody></table></div></main>\n"
      "<script>{}</script></body></html>\n",
      escaped(title), style, svg, row_of(table.header, "th"), rows, script);
}

} // namespace hopmesh::pictures
