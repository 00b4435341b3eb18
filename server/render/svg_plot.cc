#include "server/render/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plenum::server {
namespace {

constexpr double kWidth = 860, kLeft = 64, kRight = 12, kBottom = 46;
constexpr double kTop = 66, kHeight = 330;  // title and legend above the frame
constexpr int kColumns = 700;

struct Axis {
  double low, high, at_low, at_high;  // pixels
  double operator()(double value) const {
    return at_low + (value - low) / (high - low) * (at_high - at_low);
  }
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void Add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Never empty.
  void Widen(double share) {
    if (low > high) low = 0.0, high = 1.0;
    const double width = high > low ? high - low : std::max(1.0, std::abs(low));
    low -= share * width;
    high += share * width;
  }
};

std::string Label(double value) {
  return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

std::string Text(double x, double y, std::string_view anchor, std::string_view text,
                 std::string_view extra = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, extra, Escaped(text));
}

std::string Open(const std::string& title) {
  return fmt::format(
             "<svg viewBox=\"0 0 {:g} {:g}\" role=\"img\" "
             "xmlns=\"http://www.w3.org/2000/svg\">\n<title>{}</title>\n",
             kWidth, kHeight, Escaped(title)) +
         Text(kLeft, 18, "start", title, " class=\"title\"");
}

std::string YAxis(const Axis& y, const std::string& title) {
  std::string svg;
  for (const double tick : Ticks(y.low, y.high, 6)) {
    svg +=
        fmt::format("<line class=\"grid\" x1=\"{:g}\" x2=\"{:g}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                    kLeft, kWidth - kRight, y(tick), y(tick));
    svg += Text(kLeft - 6, y(tick) + 4, "end", Label(tick));
  }
  const double middle = 0.5 * (kTop + kHeight - kBottom);
  return svg + Text(16, middle, "middle", title,
                    fmt::format(" transform=\"rotate(-90 16 {:.1f})\"", middle));
}

// One line of keys below the title; `keys` are class, label and whether it is an area.
struct Key {
  std::string css_class, label;
  bool area = false;
};
std::string Legend(const std::vector<Key>& keys) {
  std::string svg;
  double x = kLeft;
  for (const Key& key : keys) {
    svg +=
        key.area
            ? fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"32\" width=\"22\" height=\"10\"/>\n",
                          key.css_class, x)
            : fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"37\" y2=\"37\"/>\n",
                          key.css_class, x, x + 22);
    svg += Text(x + 28, 41, "start", key.label);
    x += 28 + 6.6 * static_cast<double>(key.label.size()) + 22;
  }
  return svg;
}

std::string Path(const Curve& curve, const Axis& x, const Axis& y) {
  std::string points;
  bool pen = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!std::isfinite(curve.y[i]) || !std::isfinite(curve.x[i])) {
      pen = false;
      continue;
    }
    points += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x(curve.x[i]), y(curve.y[i]));
    pen = true;
  }
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", curve.css_class, points);
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::vector<double> Ticks(double low, double high, int count) {
  std::vector<double> ticks;
  if (!(high > low) || !std::isfinite(high - low)) return ticks;
  const double raw = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw / power < 1.5   ? 1.0
                               : raw / power < 3.5 ? 2.0
                               : raw / power < 7.5 ? 5.0
                                                   : 10.0);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1.0)
    ticks.push_back(k * step);
  return ticks;
}

Curve Thinned(const Curve& curve, int columns) {
  if (curve.x.size() <= 2 * static_cast<std::size_t>(columns)) return curve;
  Curve thin{curve.label, curve.css_class, {}, {}};
  const double width = (curve.x.back() - curve.x.front()) / columns;
  const auto keep = [&](std::size_t i) {
    thin.x.push_back(curve.x[i]);
    thin.y.push_back(curve.y[i]);
  };
  for (std::size_t i = 0; i < curve.x.size();) {
    const double end = curve.x[i] + width;
    std::size_t low = i, high = i, gap = curve.x.size(), next = i;
    for (; next < curve.x.size() && (next == i || curve.x[next] < end); ++next) {
      if (!std::isfinite(curve.y[next])) gap = next;
      if (curve.y[next] < curve.y[low] || !std::isfinite(curve.y[low])) low = next;
      if (curve.y[next] > curve.y[high] || !std::isfinite(curve.y[high])) high = next;
    }
    keep(std::min(low, high));
    if (low != high) keep(std::max(low, high));
    if (gap < curve.x.size() && std::isfinite(curve.y[low])) keep(gap);
    i = next;
  }
  return thin;
}

std::string Svg(const LinePlot& plot) {
  Range xs, ys;
  for (const Curve& curve : plot.curves) {
    for (const double x : curve.x) xs.Add(x);
    for (const double y : curve.y) ys.Add(y);
  }
  if (plot.band) {
    ys.Add(*plot.band);
    ys.Add(-*plot.band);
  }
  xs.Widen(0.0);
  ys.Widen(0.05);
  if (xs.low == xs.high) xs.high += 1.0;
  const Axis x{xs.low, xs.high, kLeft, kWidth - kRight};
  const Axis y{ys.low, ys.high, kHeight - kBottom, kTop};

  std::string svg = Open(plot.title);
  for (const Stretch& stretch : plot.stretches) {
    const double from = x(std::clamp(stretch.from, xs.low, xs.high));
    const double to = x(std::clamp(stretch.to, xs.low, xs.high));
    if (stretch.shaded)
      svg += fmt::format(
          "<rect class=\"phase\" x=\"{:.1f}\" y=\"{:g}\" width=\"{:.1f}\" height=\"{:g}\"/>\n",
          from, kTop, to - from, kHeight - kBottom - kTop);
    if (to - from > 8.0 * static_cast<double>(stretch.label.size()))
      svg += Text(0.5 * (from + to), kTop - 4, "middle", stretch.label, " class=\"faint\"");
  }
  svg += YAxis(y, plot.y_title);
  for (const double tick : Ticks(x.low, x.high, 9)) {
    svg +=
        fmt::format("<line class=\"tick\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:g}\" y2=\"{:g}\"/>\n",
                    x(tick), x(tick), kHeight - kBottom, kHeight - kBottom + 5);
    svg += Text(x(tick), kHeight - kBottom + 18, "middle", Label(tick));
  }
  svg += Text(0.5 * (kLeft + kWidth - kRight), kHeight - 8, "middle", plot.x_title);
  std::vector<Key> keys;
  if (plot.band) {
    svg += fmt::format(
        "<rect class=\"band\" x=\"{:g}\" y=\"{:.1f}\" width=\"{:g}\" height=\"{:.1f}\"/>\n", kLeft,
        y(*plot.band), kWidth - kRight - kLeft, y(-*plot.band) - y(*plot.band));
    keys.push_back({"band", plot.band_label, true});
  }
  for (const Curve& curve : plot.curves) {
    svg += Path(Thinned(curve, kColumns), x, y);
    keys.push_back({curve.css_class, curve.label});
  }
  return svg + Legend(keys) + "</svg>\n";
}

std::string Svg(const BarPlot& plot) {
  Range ys;
  ys.Add(0.0);
  for (const BarPlot::Series& series : plot.series)
    for (const double value : series.values) ys.Add(value);
  if (plot.line) ys.Add(*plot.line);
  const double least = ys.low;
  ys.Widen(0.05);
  if (least == 0.0) ys.low = 0.0;
  const Axis y{ys.low, ys.high, kHeight - kBottom, kTop};
  std::string svg = Open(plot.title) + YAxis(y, plot.y_title);
  std::vector<Key> keys;
  const double group_width =
      (kWidth - kRight - kLeft) / std::max<double>(1.0, static_cast<double>(plot.groups.size()));
  const double bar_width =
      0.7 * group_width / std::max<double>(1.0, static_cast<double>(plot.series.size()));
  for (std::size_t g = 0; g < plot.groups.size(); ++g) {
    const double left = kLeft + group_width * (static_cast<double>(g) + 0.15);
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      const double value = plot.series[s].values[g];
      if (!std::isfinite(value)) continue;
      const double top = std::min(y(value), y(0.0));
      svg += fmt::format(
          "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
          plot.series[s].css_class, left + bar_width * static_cast<double>(s), top,
          0.92 * bar_width, std::abs(y(value) - y(0.0)));
    }
    svg += Text(left + 0.35 * group_width, kHeight - kBottom + 18, "middle", plot.groups[g]);
  }
  for (const BarPlot::Series& series : plot.series)
    keys.push_back({series.css_class, series.label, true});
  if (plot.line) {
    svg +=
        fmt::format("<line class=\"noise\" x1=\"{:g}\" x2=\"{:g}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                    kLeft, kWidth - kRight, y(*plot.line), y(*plot.line));
    keys.push_back({"noise", plot.line_label});
  }
  return svg + Legend(keys) + "</svg>\n";
}

}  // namespace plenum::server
