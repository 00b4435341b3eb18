#include "api/measure/valve/row_instants.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/values/effect_sets.h"

namespace plenum::api {
namespace {

using calibration::Diagnosis;
using calibration::Run;
using calibration::Verdict;

constexpr double kSameTime = 1e-6;  // of the time between two rows
constexpr std::size_t kLeastCommands = 2;

// The time from the row before to that at which the command stands; none where it stands at none, 0
// at the first.
std::optional<double> RowOf(const Run& run, double time_s) {
  const auto next = std::lower_bound(run.t_s.begin(), run.t_s.end(), time_s);
  for (const auto row : {next, next == run.t_s.begin() ? next : std::prev(next)}) {
    if (row == run.t_s.end()) continue;
    const double row_s = row == run.t_s.begin() ? 0.0 : *row - *std::prev(row);
    if (std::abs(*row - time_s) <= kSameTime * row_s || *row == time_s) return row_s;
  }
  return {};
}

const Json* ValveOf(const Json& measurement, std::size_t run) {
  if (!measurement.contains("runs") || run >= measurement["runs"].size()) return nullptr;
  const Json& document = measurement["runs"][run];
  return document.contains("valve") && document["valve"].is_array() ? &document["valve"] : nullptr;
}

std::size_t CausesOf(const Diagnosis& diagnosis) {
  const auto fewer = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  const auto& tied = diagnosis.tied;
  return tied.empty() ? diagnosis.effects.size() + diagnosis.numbers.size()
                      : std::min_element(tied.begin(), tied.end(), fewer)->size();
}

// Causes but those that act in time, which instants take up.
std::size_t TimelessOf(const Diagnosis& diagnosis) {
  if (!diagnosis.tied.empty()) return CausesOf(diagnosis);
  return CausesOf(diagnosis) -
         static_cast<std::size_t>(std::count_if(
             diagnosis.effects.begin(), diagnosis.effects.end(),
             [](const auto& fitted) { return calibration::ActsInTime(*fitted.effect.spec); }));
}

}  // namespace

double UncertaintyOfRow(double row_s) { return row_s / std::sqrt(3.0); }

bool AreOfRows(const Json& measurement, const calibration::Dataset& dataset) {
  std::size_t commands = 0;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Run& run = dataset.runs[i];
    const Json* valve = ValveOf(measurement, i);
    if (valve == nullptr || valve->size() != run.valve.size()) return false;
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      if ((*valve)[k].contains("uncertainty_s") || !std::isfinite(run.valve[k].time_s))
        return false;
      const std::optional<double> row_s = RowOf(run, run.valve[k].time_s);
      const bool before = run.t_s.empty() || run.valve[k].time_s < run.t_s.front();
      if (!row_s && !before) return false;
      commands += row_s && *row_s > 0.0;
    }
  }
  return commands >= kLeastCommands;
}

void SayOfRows(Json& measurement, calibration::Dataset& dataset) {
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    Run& run = dataset.runs[i];
    run.valve_uncertainty_s.assign(run.valve.size(), 0.0);
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      const double row_s = RowOf(run, run.valve[k].time_s).value_or(0.0);
      if (!(row_s > 0.0)) continue;
      run.valve_uncertainty_s[k] = UncertaintyOfRow(row_s);
      measurement["runs"][i]["valve"][k]["uncertainty_s"] = UncertaintyOfRow(row_s);
    }
  }
}

bool AsksForRows(const Diagnosis& exact) {
  if (exact.verdict == Verdict::kUnexplained) return true;
  const bool named = exact.verdict == Verdict::kExplained || exact.verdict == Verdict::kTie;
  return named && CausesOf(exact) >= kManyCauses;
}

bool IsBetterOfRows(const Diagnosis& exact, const Diagnosis& of_rows) {
  if (of_rows.verdict != Verdict::kAdequate && of_rows.verdict != Verdict::kExplained) return false;
  if (CausesOf(exact) == 0) return CausesOf(of_rows) <= 1;
  return TimelessOf(of_rows) < TimelessOf(exact);
}

}  // namespace plenum::api
