// Plots as inline SVG without script: lines over a time axis, and grouped bars. Colours are CSS
// classes, so that the page's style sheet has light and dark.
#ifndef PLENUM_SERVER_RENDER_SVG_PLOT_H_
#define PLENUM_SERVER_RENDER_SVG_PLOT_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::server {

// `&`, `<`, `>` and quotes as HTML wants them.
std::string Escaped(std::string_view text);

struct Curve {
  std::string label, css_class;
  std::vector<double> x, y;  // NaN breaks the line
};

struct Stretch {  // of the x axis, shaded where `shaded`
  std::string label;
  double from = 0.0, to = 0.0;
  bool shaded = false;
};

struct LinePlot {
  std::string title, x_title, y_title;
  std::vector<Curve> curves;  // drawn in this order
  std::vector<Stretch> stretches;
  std::optional<double> band;  // a band of ± this about zero
  std::string band_label;
};

// Of curves with more points than pixels each column keeps its lowest and its highest.
std::string Svg(const LinePlot& plot);

struct BarPlot {
  std::string title, y_title;
  std::vector<std::string> groups;
  struct Series {
    std::string label, css_class;
    std::vector<double> values;  // by group; NaN: none
  };
  std::vector<Series> series;
  std::optional<double> line;  // across the plot
  std::string line_label;
};
std::string Svg(const BarPlot& plot);

// Values 1, 2 or 5 times a power of ten apart that cover [low, high] with about `count`.
std::vector<double> Ticks(double low, double high, int count);

// The lowest and the highest point of each of `columns` equal parts of the x range, in the order of
// x; everything where there are no more points than that. NaN stands where a part holds one.
Curve Thinned(const Curve& curve, int columns);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_SVG_PLOT_H_
