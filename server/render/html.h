// Pieces of a self-contained HTML report; all texts are escaped here.
#ifndef PLENUM_SERVER_RENDER_HTML_H_
#define PLENUM_SERVER_RENDER_HTML_H_

#include <string>
#include <string_view>
#include <vector>

namespace plenum::server {

struct Column {
  std::string title;
  bool text = false;
};

// Rows may be shorter than the columns; no rows give no table.
std::string HtmlTable(const std::vector<Column>& columns,
                      const std::vector<std::vector<std::string>>& rows);
std::string Paragraph(std::string_view text, std::string_view css_class = "");
std::string Heading(std::string_view text);

// The whole document around `body`, with the style that its parts and the plots of svg_plot.h use.
std::string HtmlDocument(std::string_view title, std::string_view body);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_HTML_H_
