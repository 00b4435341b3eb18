#include "server/render/html.h"

#include <fmt/format.h>

#include "server/render/svg_plot.h"

namespace plenum::server {
namespace {

constexpr std::string_view kStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c2128; --faint: #667080; --paper: #ffffff;
  --line: #d8dde4; --phase: #f1f4f8; --band: #dfe5ec; --measured: #8b95a3; --declared: #8a5fbf;
  --before: #d06a1c; --after: #1f6fc4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --faint: #98a2b0; --paper: #14181d;
  --line: #333b45; --phase: #1c222a; --band: #2b333d; --measured: #8b95a3; --declared: #b08ae0;
  --before: #f0964a; --after: #5ea8f2; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 900px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.3rem; margin-bottom: .2rem; } h2 { font-size: 1.1rem; margin-top: 2.2rem; }
.verdict { font-size: 1.25rem; border-left: 4px solid var(--after); padding: .3rem 0 .3rem 1rem; }
.faint { color: var(--faint); } .wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .6rem 0; }
th, td { padding: .2rem .8rem .2rem 0; text-align: right; border-bottom: 1px solid var(--line); }
th { font-weight: 600; } th.text, td.text { text-align: left; }
code { font-size: .85em; overflow-wrap: anywhere; }
figure { margin: 1rem 0; }
svg { width: 100%; height: auto; margin: .6rem 0; font: 12px system-ui, sans-serif; }
svg text { fill: var(--ink); } svg text.title { font-size: 14px; font-weight: 600; }
svg text.faint { fill: var(--faint); }
svg path { fill: none; stroke-width: 1.4; stroke-linejoin: round; }
svg .grid { stroke: var(--line); stroke-width: .6; } svg .tick { stroke: var(--faint); }
svg .phase { fill: var(--phase); } svg .band { fill: var(--band); }
svg path.measured, svg line.measured { stroke: var(--measured); stroke-width: 3.5; }
svg path.declared, svg line.declared { stroke: var(--declared); stroke-dasharray: 2 3; }
svg path.before, svg line.before { stroke: var(--before); stroke-dasharray: 7 3; }
svg path.after, svg line.after { stroke: var(--after); }
svg path.solid, svg line.solid { stroke-dasharray: none; stroke-width: 1; }
svg line.declared, svg line.before, svg line.after { stroke-width: 2; }
svg rect.before { fill: var(--before); } svg rect.after { fill: var(--after); }
svg line.noise { stroke: var(--ink); stroke-dasharray: 4 3; }
</style>
)";

}  // namespace

std::string HtmlTable(const std::vector<Column>& columns,
                      const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string html = "<div class=\"wide\"><table><tr>";
  const auto cell = [&](std::string_view tag, std::size_t i, const std::string& content) {
    html += fmt::format("<{}{}>{}</{}>", tag, columns[i].text ? " class=\"text\"" : "",
                        Escaped(content), tag);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) cell("th", i, columns[i].title);
  html += "</tr>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) cell("td", i, row[i]);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string Paragraph(std::string_view text, std::string_view css_class) {
  return fmt::format("<p{}>{}</p>\n",
                     css_class.empty() ? "" : fmt::format(" class=\"{}\"", css_class),
                     Escaped(text));
}

std::string Heading(std::string_view text) { return fmt::format("<h2>{}</h2>\n", Escaped(text)); }

std::string HtmlDocument(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n{}</head><body>\n<h1>{}</h1>\n{}</body></html>\n",
      Escaped(title), kStyle, Escaped(title), body);
}

}  // namespace plenum::server
