#include "server/render/residual_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "server/render/svg_plot.h"

namespace plenum::server {
namespace {

using api::Json;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::vector<double> Numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list)
    values.push_back(value.is_number() ? value.get<double>() : kMissing);
  return values;
}

std::vector<double> Difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

bool Same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double one, double other) {
    return one == other || (std::isnan(one) && std::isnan(other));
  });
}

std::vector<Stretch> Phases(const Json& series, const std::vector<double>& t_s) {
  std::vector<Stretch> stretches;
  const Json& phases = series.at("phase");
  for (std::size_t i = 0; i < phases.size() && i < t_s.size(); ++i) {
    if (!std::isfinite(t_s[i])) continue;
    const std::string phase = phases[i];
    if (!stretches.empty()) stretches.back().to = t_s[i];
    if (stretches.empty() || stretches.back().label != phase)
      stretches.push_back({phase, t_s[i], t_s[i], stretches.size() % 2 == 0});
  }
  return stretches;
}

}  // namespace

std::string RunPlots(const Json& series, double noise_kpa) {
  const std::vector<double> t_s = Numbers(series.at("t_s"));
  const std::vector<double> measured = Numbers(series.at("measured_kpa"));
  const std::vector<double> before = Numbers(series.at("before_kpa"));
  const std::vector<double> after = Numbers(series.at("after_kpa"));
  const std::string run = series.at("run");
  const std::string name =
      "Run " + run + (series.at("held_out") == true ? " (held out of every fit)" : "");
  const bool apart = !Same(before, after);

  LinePlot pressure{
      name + ": measured and model", "time, s", "pressure, kPa gauge", {}, {}, {}, ""};
  pressure.stretches = Phases(series, t_s);
  pressure.curves = {{"measured", "measured", t_s, measured},
                     {"as declared", "declared", t_s, Numbers(series.at("declared_kpa"))},
                     {"before (refitted)", "before", t_s, before}};
  if (apart) pressure.curves.push_back({"after (with effects)", "after", t_s, after});

  LinePlot residual{name + ": measured less model", "time, s", "residual, kPa", {}, {}, {}, ""};
  residual.stretches = pressure.stretches;
  residual.curves = {{"before", "before solid", t_s, Difference(measured, before)}};
  if (apart) residual.curves.push_back({"after", "after solid", t_s, Difference(measured, after)});
  if (std::isfinite(noise_kpa)) {
    residual.band = 2.0 * noise_kpa;
    residual.band_label = "±2 standard deviations of the noise";
  }
  for (LinePlot* plot : {&pressure, &residual})
    for (Curve& curve : plot->curves) {
      curve.x.resize(std::min(curve.x.size(), curve.y.size()));
      curve.y.resize(curve.x.size());
    }
  return "<figure>\n" + Svg(pressure) + Svg(residual) + "</figure>\n";
}

std::string PhasePlot(const Json& answer, double noise_kpa) {
  static constexpr std::array<const char*, 4> kPhases = {"rest", "rise", "hold", "fall"};
  struct Sum {
    double squares = 0.0, count = 0.0;
    double Rms() const { return count > 0.0 ? std::sqrt(squares / count) : kMissing; }
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;  // phase, before or after
  for (const Json& series : answer.at("series")) {
    const std::vector<double> measured = Numbers(series.at("measured_kpa"));
    for (const std::string which : {"before", "after"}) {
      const std::vector<double> off = Difference(measured, Numbers(series.at(which + "_kpa")));
      const Json& phases = series.at("phase");
      for (std::size_t i = 0; i < off.size() && i < phases.size(); ++i) {
        if (!std::isfinite(off[i])) continue;
        Sum& sum = sums[{phases[i].get<std::string>(), which}];
        sum.squares += off[i] * off[i];
        sum.count += 1.0;
      }
    }
  }
  BarPlot plot{"Error by phase, all runs", "residual, RMS, kPa", {}, {}, {}, "noise"};
  plot.series = {{"before", "before", {}}, {"after", "after", {}}};
  for (const char* phase : kPhases) {
    if (!sums.contains({phase, "before"}) && !sums.contains({phase, "after"})) continue;
    plot.groups.emplace_back(phase);
    plot.series[0].values.push_back(sums[{phase, "before"}].Rms());
    plot.series[1].values.push_back(sums[{phase, "after"}].Rms());
  }
  if (plot.groups.empty()) return "";
  if (std::isfinite(noise_kpa)) plot.line = noise_kpa;
  return "<figure>\n" + Svg(plot) + "</figure>\n";
}

}  // namespace plenum::server
