// SPDX-License-Identifier: Apache-2.0
#include "report/html_page.h"

#include <algorithm>
#include <utility>

#include "base/printable.h"

namespace navcal::report {
namespace {

/// Colours that colour-blind readers can tell apart, blue and orange (Okabe and Ito), each with a word beside it.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ink:#1b2733; --soft:#5a6775; --line:#dfe4ea; --strong:#aeb8c3; --page:#ffffff;
  --card:#f6f8fa; --before:#c2571a; --after:#0b6fa8; --fit:#1b2733; --second:#c2571a; --third:#1d7f58;
  --fourth:#8a4f9e; --good:#17693f; --good-back:#dff3e6; --bad:#a3261c; --bad-back:#fbe4e1;
  --heat0:#e9edf1; --heat1:#fbe0ce; --heat2:#f5c29e; --heat3:#eb9c69; --heat4:#dd7a3c; }
@media (prefers-color-scheme: dark) {
  :root { --ink:#e4e9ef; --soft:#9aa7b5; --line:#2c3641; --strong:#566372; --page:#12181f; --card:#19212a;
    --before:#f0965a; --after:#5db4ea; --fit:#e4e9ef; --second:#f0965a; --third:#5fc79a; --fourth:#c795da;
    --good:#8be0b0; --good-back:#173d2a; --bad:#ffaea5; --bad-back:#4a201c;
    --heat0:#222c36; --heat1:#3f2d22; --heat2:#5c3822; --heat3:#7a4522; --heat4:#96521f; }
}
@media print {
  :root { color-scheme: light; --ink:#000; --soft:#444; --line:#ddd; --strong:#999; --page:#fff; --card:#fff;
    --before:#c2571a; --after:#0b6fa8; --fit:#000; --second:#c2571a; --third:#1d7f58; --fourth:#8a4f9e;
    --good:#17693f; --good-back:#fff; --bad:#a3261c; --bad-back:#fff;
    --heat0:#e9edf1; --heat1:#fbe0ce; --heat2:#f5c29e; --heat3:#eb9c69; --heat4:#dd7a3c; }
  figure, tr, .fact { break-inside: avoid; }
  h2 { break-after: avoid; }
  main { max-width: none; padding: 0; }
}
body { margin:0; background:var(--page); color:var(--ink); font:15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width:1180px; margin:0 auto; padding:28px 24px 48px; }
h1 { font-size:26px; margin:0 0 4px; }
h2 { font-size:18px; margin:34px 0 10px; padding-top:14px; border-top:1px solid var(--line); }
p { margin:6px 0 10px; max-width:85ch; }
.fact { display:flex; gap:12px; align-items:baseline; margin:7px 0; }
.fact b { flex:0 0 92px; text-align:center; font-size:12px; font-weight:600; border-radius:4px; padding:2px 0;
  color:var(--soft); background:var(--card); border:1px solid var(--line); }
.fact b.good { color:var(--good); background:var(--good-back); border-color:transparent; }
.fact b.bad { color:var(--bad); background:var(--bad-back); border-color:transparent; }
h1, h3, p, .fact span, .detail { overflow-wrap:anywhere; }
.fact span { min-width:0; }
.figures { display:grid; grid-template-columns:repeat(auto-fit, minmax(min(100%, 480px), 1fr)); gap:18px; }
figure { margin:0; padding:14px 16px 10px; background:var(--card); border:1px solid var(--line); border-radius:8px; }
.figures figure:last-child:nth-child(odd):not(:first-child) { grid-column:1/-1; }
.wide { display:grid; grid-template-columns:minmax(0, 1fr); gap:18px; }
.panels { display:grid; grid-template-columns:repeat(auto-fit, minmax(min(100%, 330px), 1fr)); gap:10px 14px; }
.panels.pair { grid-template-columns:repeat(auto-fit, minmax(min(100%, 480px), 1fr)); }
.scroll + .wide { margin-top:18px; }
.panels h4 { margin:4px 0 0; font-size:13px; font-weight:600; color:var(--soft); text-align:center; }
.index { margin:4px 0; line-height:1.9; } .index b { display:inline-block; min-width:5em; }
.index a { margin-right:4px; }
a { color:var(--after); }
section h3 { font-size:15px; margin:22px 0 8px; }
figure h3 { margin:0 0 8px; font-size:15px; }
figcaption { color:var(--soft); font-size:13px; margin-top:6px; }
svg { max-width:100%; height:auto; display:block; margin:0 auto; font-size:12px; fill:var(--soft); }
svg svg { overflow:hidden; }
svg text.tick { font-size:11px; }
svg text.halo { fill:var(--ink); stroke:var(--card); stroke-width:3px; paint-order:stroke; }
.grid { stroke:var(--line); fill:none; stroke-width:1; }
.grid.strong { stroke:var(--strong); stroke-dasharray:4 3; }
.frame { stroke:var(--strong); fill:none; stroke-width:1; }
.cut { fill:var(--strong); stroke:none; }
.line { fill:none; stroke-width:2; stroke-linejoin:round; }
.dots { fill:none; stroke-width:3.2; stroke-linecap:round; stroke-opacity:.55; }
.area { fill-opacity:.2; stroke:none; }
.sector { fill:var(--after); stroke:var(--card); stroke-width:1; }
.line.before, .dots.before { stroke:var(--before); }
.line.after, .dots.after, .line.first, .dots.first { stroke:var(--after); }
.line.fit, .dots.fit { stroke:var(--fit); }
.dots.second { stroke:var(--second); } .dots.third { stroke:var(--third); } .dots.fourth { stroke:var(--fourth); }
.line.second { stroke:var(--second); } .line.third { stroke:var(--third); } .line.fourth { stroke:var(--fourth); }
.area.before, .area.second { fill:var(--second); } .area.after, .area.first { fill:var(--after); }
.area.fit { fill:var(--fit); } .area.third { fill:var(--third); } .area.fourth { fill:var(--fourth); }
.scroll { overflow-x:auto; }
table { border-collapse:collapse; font-size:14px; font-variant-numeric:tabular-nums; }
th, td { text-align:left; vertical-align:top; padding:5px 18px 5px 0; border-bottom:1px solid var(--line); }
td.long { min-width:12em; overflow-wrap:anywhere; }
th { color:var(--soft); font-weight:600; font-size:13px; }
.scroll + .figures, .figures + .figures, .figures + p { margin-top:18px; }
.map { width:100%; }
.map th, .map td { padding:0; border:1px solid var(--card); font-size:12px; text-align:center; vertical-align:middle; }
.map thead th { vertical-align:bottom; font-weight:400; }
.map thead span { display:inline-block; writing-mode:vertical-rl; transform:rotate(180deg); padding:6px 0; max-height:170px;
  overflow:hidden; white-space:nowrap; }
.map tbody th { position:sticky; left:0; width:1px; padding-right:8px; background:var(--card); text-align:right; font-weight:400; white-space:nowrap; }
.map td { min-width:42px; height:26px; }
.heat0 { background:var(--heat0); } .heat1 { background:var(--heat1); } .heat2 { background:var(--heat2); }
.heat3 { background:var(--heat3); } .heat4 { background:var(--heat4); }
.clear { box-shadow:inset 0 0 0 2px var(--ink); font-weight:700; }
.map, .legend, .bar { print-color-adjust:exact; -webkit-print-color-adjust:exact; }
.legend { display:flex; flex-wrap:wrap; gap:4px 16px; margin:10px 0 0; font-size:12px; color:var(--soft); }
.legend i { display:inline-block; width:16px; height:12px; margin-right:6px; vertical-align:-1px; }
.ranks { display:grid; grid-template-columns:minmax(7em, auto) minmax(60px, 1fr) auto; gap:7px 14px; align-items:center; font-size:14px; }
.ranks b { font-weight:600; overflow-wrap:anywhere; }
.ranks .value { font-variant-numeric:tabular-nums; }
.ranks .detail { grid-column:2/-1; margin:-6px 0 3px; font-size:13px; color:var(--soft); }
.bar { position:relative; height:14px; background:var(--line); border-radius:2px; overflow:hidden; }
.bar i { position:absolute; top:0; bottom:0; }
.bar .fill { background:var(--after); } .bar .weak { background:var(--strong); } .bar .worse { background:var(--before); }
.bar .line-at { border-left:1px solid var(--ink); }
.bar .whisker { top:4px; bottom:4px; border:solid var(--ink); border-width:0 2px; background:linear-gradient(var(--ink), var(--ink)) center/100% 2px no-repeat; }
summary { margin:14px 0; color:var(--soft); cursor:pointer; }
@media (max-width:900px) { th, td { padding-right:9px; } }
@media (max-width:600px) { .ranks .detail { grid-column:1/-1; margin-top:-4px; } main { padding:20px 14px 36px; } }
@media print { body, table, th, td, figcaption, .fact { font-size:11px; line-height:1.35; } th, td { padding:1px 9px 1px 0; }
  h2, section h3 { margin:10px 0 4px; padding-top:6px; } figure { padding:6px; } svg { max-height:6cm; } }
)";

/// Long cells break anywhere: digests and file names have no spaces.
constexpr std::size_t kLongCell = 40;

std::string id_attribute(std::string_view id) {
  return id.empty() ? std::string() : " id=\"" + escaped(id) + "\"";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = base::utf8_length(text);
    if (length != 1) {
      out += length == 0 ? "?" : text.substr(0, length);
      text.remove_prefix(std::max<std::size_t>(length, 1));
      continue;
    }
    const char c = text.front();
    text.remove_prefix(1);
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return out;
}

HtmlPage::HtmlPage(std::string_view title) {
  const std::string name = escaped(title);
  html_ =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      name + "</title>\n<style>";
  html_.append(kStyle).append("</style>\n</head>\n<body>\n<main>\n<h1>").append(name).append("</h1>\n");
}

void HtmlPage::section(std::string_view title) {
  if (std::exchange(in_section_, true)) html_ += "</section>\n";
  html_ += "<section>\n<h2>" + escaped(title) + "</h2>\n";
}

void HtmlPage::index(std::string_view title, const std::vector<Link>& links) {
  html_ += "<nav class=\"index\"><b>" + escaped(title) + "</b>";
  for (const Link& link : links) html_ += " <a href=\"#" + escaped(link.id) + "\">" + escaped(link.text) + "</a>";
  html_ += "</nav>\n";
}

void HtmlPage::heading(std::string_view title, std::string_view id) {
  html_ += "<h3" + id_attribute(id) + ">" + escaped(title) + "</h3>\n";
}

void HtmlPage::paragraph(std::string_view text) { html_ += "<p>" + escaped(text) + "</p>\n"; }

void HtmlPage::fact(std::string_view kind, std::string_view word, std::string_view sentence) {
  html_ += "<div class=\"fact\"><b class=\"" + escaped(kind) + "\">" + escaped(word) + "</b><span>" +
           escaped(sentence) + "</span></div>\n";
}

void HtmlPage::figures(const std::vector<Figure>& figures) {
  html_ += "<div class=\"figures\">\n";
  for (const Figure& figure : figures) append(figure);
  html_ += "</div>\n";
}

void HtmlPage::wide_figures(const std::vector<Figure>& figures) {
  html_ += "<div class=\"wide\">\n";
  for (const Figure& figure : figures) append(figure);
  html_ += "</div>\n";
}

void HtmlPage::append(const Figure& figure) {
  html_ += "<figure" + id_attribute(figure.id) + ">\n<h3>" + escaped(figure.title) + "</h3>\n" + figure.html +
           "<figcaption>" + escaped(figure.caption) + "</figcaption>\n</figure>\n";
}

void HtmlPage::folded_figures(std::string_view title, const std::vector<Figure>& hidden) {
  html_ += "<details>\n<summary>" + escaped(title) + "</summary>\n";
  figures(hidden);
  html_ += "</details>\n";
}

void HtmlPage::table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  html_ += "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const auto& head : heads) html_ += "<th>" + escaped(head) + "</th>";
  html_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html_ += "<tr>";
    for (const auto& cell : row)
      html_ += (cell.size() > kLongCell ? "<td class=\"long\">" : "<td>") + escaped(cell) + "</td>";
    html_ += "</tr>\n";
  }
  html_ += "</tbody>\n</table></div>\n";
}

std::string HtmlPage::finish() && {
  if (in_section_) html_ += "</section>\n";
  html_ += "</main>\n</body>\n</html>\n";
  return std::move(html_);
}

}  // namespace navcal::report
