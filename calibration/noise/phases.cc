#include "calibration/noise/phases.h"

#include <algorithm>
#include <cmath>

namespace plenum::calibration {
namespace {

constexpr double kPressurised = 0.05;  // of the operating gauge pressure

double StartPressure(const Run& run) {
  if (run.initial_pressure_pa) return *run.initial_pressure_pa;
  const auto first = std::find_if(run.pressure_pa.begin(), run.pressure_pa.end(),
                                  [](double p) { return std::isfinite(p); });
  return first == run.pressure_pa.end() ? run.ambient.pressure_pa : *first;
}

// Of a closed valve, by what came before.
Phase ClosedPhase(const std::vector<PhaseSpan>& before, bool pressurised) {
  for (auto span = before.rbegin(); span != before.rend(); ++span) {
    if (span->phase == Phase::kRise) return Phase::kHold;
    if (span->phase == Phase::kFall) return Phase::kRest;
  }
  return pressurised ? Phase::kHold : Phase::kRest;
}

}  // namespace

const char* Name(Phase phase) {
  switch (phase) {
    case Phase::kRise:
      return "rise";
    case Phase::kHold:
      return "hold";
    case Phase::kFall:
      return "fall";
    case Phase::kRest:
      break;
  }
  return "rest";
}

std::vector<PhaseSpan> PhasesOf(const Run& run) {
  if (run.t_s.empty()) return {};
  const double ambient_pa = run.ambient.pressure_pa;
  const bool pressurised =
      (StartPressure(run) - ambient_pa) / (run.chamber.operating_pressure_pa - ambient_pa) >
      kPressurised;
  std::vector<PhaseSpan> spans;
  int inflations = 0;
  model::ValveState state = model::ValveState::kHold;
  const auto begin = [&](model::ValveState next, double t_s) {
    Phase phase = Phase::kRise;
    if (next == model::ValveState::kHold) phase = ClosedPhase(spans, pressurised);
    if (next == model::ValveState::kDeflate) phase = Phase::kFall;
    if (phase == Phase::kRise) ++inflations;
    if (!spans.empty()) spans.back().end_s = t_s;
    spans.push_back({phase, std::max(0, inflations - 1), t_s, run.t_s.back()});
    state = next;
  };
  begin(model::ValveState::kHold, -std::numeric_limits<double>::infinity());
  for (const model::ValveCommand& command : run.valve)
    if (command.state != state) begin(command.state, command.time_s);

  std::vector<PhaseSpan> seen;
  for (PhaseSpan span : spans) {
    span.start_s = std::max(span.start_s, run.t_s.front());
    span.end_s = std::min(span.end_s, run.t_s.back());
    if (span.end_s > span.start_s) seen.push_back(span);
  }
  if (seen.empty()) {  // all samples at one instant
    PhaseSpan only = spans.back();
    for (const PhaseSpan& span : spans)
      if (span.start_s <= run.t_s.front()) only = span;
    seen.push_back({only.phase, only.cycle, run.t_s.front(), run.t_s.back()});
  }
  return seen;
}

std::size_t PhaseAt(const std::vector<PhaseSpan>& phases, double t_s) {
  const auto after =
      std::upper_bound(phases.begin(), phases.end(), t_s,
                       [](double time, const PhaseSpan& span) { return time < span.start_s; });
  return after == phases.begin() ? 0 : static_cast<std::size_t>(after - phases.begin()) - 1;
}

}  // namespace plenum::calibration
