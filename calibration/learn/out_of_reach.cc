#include "calibration/learn/out_of_reach.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "calibration/values/crossing.h"

namespace plenum::calibration {
namespace {

double LowestOf(std::span<const double> series, double lowest_pa) {
  for (const double pa : series)
    if (!std::isnan(pa)) lowest_pa = std::min(lowest_pa, pa);
  return lowest_pa;
}

double LowestReach(const Run& run) {
  double lowest_pa =
      std::min(run.initial_pressure_pa.value_or(FirstReading(run)), ExhaustPressure(run, 0.0));
  lowest_pa = std::min(lowest_pa, run.ambient.pressure_pa);
  if (run.supply == Supply::kRegulated) lowest_pa = std::min(lowest_pa, run.source_pressure_pa);
  lowest_pa = LowestOf(run.channels.source_pressure_pa, lowest_pa);
  return LowestOf(run.channels.source_setpoint_pa, lowest_pa);
}

bool Deflates(const Run& run) {
  return std::any_of(run.valve.begin(), run.valve.end(), [](const model::ValveCommand& command) {
    return command.state == model::ValveState::kDeflate;
  });
}

std::string Kpa(const char* format, double pa) {
  char text[64];
  std::snprintf(text, sizeof text, format, pa / 1000.0);
  return text;
}

}  // namespace

std::vector<std::string> OutOfReach(const Dataset& dataset) {
  std::vector<std::string> sentences;
  for (const Run& run : dataset.runs) {
    if (run.volume_imposed) continue;
    const double ambient_pa = run.ambient.pressure_pa, reach_pa = LowestReach(run);
    const double span_pa = model::Span(run.chamber);
    const auto below = std::count_if(run.pressure_pa.begin(), run.pressure_pa.end(),
                                     [&](double pa) { return pa < reach_pa - kBelow * span_pa; });
    if (below < kReadingsBelow) continue;
    sentences.push_back("the readings of " + run.id + " fall to " +
                        Kpa("%.4g kPa gauge", LowestOf(run.pressure_pa, ambient_pa) - ambient_pa) +
                        ", and nothing in the rig as declared is below " +
                        Kpa("%.4g kPa", reach_pa - ambient_pa) + ": " +
                        (Deflates(run) && !Evacuates(run)
                             ? "if the line opens into less than the ambient pressure, declare "
                               "exhaust_pressure_kpa_gauge"
                             : "check the ambient pressure and the gauge's zero"));
  }
  return sentences;
}

}  // namespace plenum::calibration
