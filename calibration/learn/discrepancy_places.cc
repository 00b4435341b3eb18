// Where the residual lives.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "calibration/learn/discrepancy.h"
#include "calibration/noise/phases.h"

namespace plenum::calibration {
namespace {

constexpr int kPressureBins = 5;
constexpr int kTimeBins = 4;

struct Part {
  double energy = 0.0;  // Pa², above the noise
  int readings = 0;
};
using Parts = std::map<std::string, Part>;

std::string Range(double low, double high, const char* unit) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.3g to %.3g %s", low, high, unit);
  return text.data();
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void Add(double x) { low = std::min(low, x), high = std::max(high, x); }
  // The range of the bin, of so many, that holds x.
  std::string BinOf(double x, int bins, double unit, const char* name) const {
    const double width = (high - low) / bins;
    const int bin = width > 0.0 ? std::min(bins - 1, static_cast<int>((x - low) / width)) : 0;
    return Range((low + bin * width) / unit, (low + (bin + 1) * width) / unit, name);
  }
};

}  // namespace

std::vector<Discrepancy::Place> PlacesOf(const FitData& data, const ModelState& state,
                                         const FitOptions& options) {
  const std::vector<Run>& runs = data.forward->dataset().runs;
  std::map<std::size_t, Reading> readings;
  Extent pressure, time;
  for (const std::size_t i : data.runs) {
    readings[i] = Predicted(data, state, i, options);
    for (const double p : readings[i].pressure_pa) pressure.Add(p - runs[i].ambient.pressure_pa);
    for (const double t : runs[i].t_s) time.Add(t - StartOf(runs[i]));
  }
  std::map<std::string, Parts> by_axis;
  double energy = 0.0;
  int count = 0;
  for (const std::size_t i : data.runs) {
    const Run& run = runs[i];
    const Reading& reading = readings[i];
    if (reading.pressure_pa.empty()) continue;
    const std::vector<PhaseSpan> phases = PhasesOf(run);
    const std::vector<double> residual = PressureResidual(run, (*data.observed)[i], reading);
    const double noise = std::pow((*data.observed)[i].signals.front().sigma, 2);
    for (std::size_t k = 0; k < residual.size(); ++k) {
      if (std::isnan(residual[k])) continue;
      const double above = residual[k] * residual[k] - noise;
      energy += above;
      ++count;
      const PhaseSpan& phase = phases[PhaseAt(phases, run.t_s[k])];
      const double gauge_pa = reading.pressure_pa[k] - run.ambient.pressure_pa;
      const auto add = [&](const std::string& axis, const std::string& where) {
        Part& part = by_axis[axis][where];
        part.energy += above;
        ++part.readings;
      };
      add("run", run.id);
      add("phase", Name(phase.phase));
      add("cycle", phase.cycle == 0 ? "first" : "later");
      add("pressure", pressure.BinOf(gauge_pa, kPressureBins, 1e3, "kPa"));
      add("time", time.BinOf(run.t_s[k] - StartOf(run), kTimeBins, 1.0, "s"));
      const double next = reading.pressure_pa[std::min(k + 1, residual.size() - 1)];
      const double before = reading.pressure_pa[k > 0 ? k - 1 : 0];
      add("rate", next > before ? "rising" : next < before ? "falling" : "still");
    }
  }
  std::vector<Discrepancy::Place> places;
  if (!(energy > 0.0)) return places;
  for (const auto& [axis, parts] : by_axis) {
    const auto most = std::max_element(
        parts.begin(), parts.end(),
        [](const auto& a, const auto& b) { return a.second.energy < b.second.energy; });
    const double share = std::min(1.0, most->second.energy / energy);
    const double usual = static_cast<double>(most->second.readings) / count;
    if (share > usual) places.push_back({axis, most->first, share});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return places;
}

}  // namespace plenum::calibration
