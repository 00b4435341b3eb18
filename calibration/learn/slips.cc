#include "calibration/learn/slips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/fit/forward.h"

namespace plenum::calibration {
namespace {

constexpr double kTolerance = 1e-3;  // of the simulations
constexpr std::size_t kStepsMax = 20'000;
constexpr std::size_t kExchangedAmong = 12;  // runs that are astray

struct Slip {
  const char* what;  // "… fit the declared model far better if <what>"
  std::function<void(Run&)> undo;
};

std::function<void(Run&)> Scaled(double factor) {
  return [factor](Run& run) {
    const double ambient_pa = run.ambient.pressure_pa;
    for (double& pa : run.pressure_pa) pa = ambient_pa + factor * (pa - ambient_pa);
  };
}

std::function<void(Run&)> Times(double readings, double commands) {
  return [=](Run& run) {
    for (double& t_s : run.t_s) t_s *= readings;
    for (model::ValveCommand& command : run.valve) command.time_s *= commands;
  };
}

void ReadAbsolute(Run& run) {
  for (double& pa : run.pressure_pa) pa -= run.ambient.pressure_pa;
}

void SupplyAbsolute(Run& run) {
  if (run.supply == Supply::kRegulated)
    run.source_pressure_pa =
        std::max(run.ambient.pressure_pa, run.source_pressure_pa - run.ambient.pressure_pa);
}

void ExchangeCommands(Run& run) {
  using enum model::ValveState;
  for (model::ValveCommand& command : run.valve)
    command.state = command.state == kInflate   ? kDeflate
                    : command.state == kDeflate ? kInflate
                                                : command.state;
}

// Strokes take as long as the volume over the conductance.
std::function<void(Run&)> Volume(double factor) {
  return [factor](Run& run) { run.chamber.rest_volume_m3 *= factor; };
}

const std::vector<Slip>& Slips() {
  static const std::vector<Slip> kSlips = {
      {"the readings are in bar, not kPa", Scaled(100.0)},
      {"the readings are in MPa, not kPa", Scaled(1000.0)},
      {"the readings are in psi, not kPa", Scaled(6.894757)},
      {"the readings are in mbar, not kPa", Scaled(0.1)},
      {"the readings are in Pa, not kPa", Scaled(0.001)},
      {"the readings have the wrong sign", Scaled(-1.0)},
      {"the readings are absolute, not gauge", ReadAbsolute},
      {"the source pressure is absolute, not gauge", SupplyAbsolute},
      {"inflate and deflate are exchanged", ExchangeCommands},
      {"the times of the readings are in ms, not s", Times(1e-3, 1.0)},
      {"the times of the commands are in ms, not s", Times(1.0, 1e-3)},
      {"the rest volume is in litres, not ml, or all times are in ms, not s", Volume(1000.0)},
      {"the line's sonic conductance is of a minute, not of a second", Volume(60.0)},
  };
  return kSlips;
}

double Mismatch(const Run& run, const std::vector<double>& model_pa) {
  const double ambient_pa = run.ambient.pressure_pa;
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < model_pa.size(); ++i) {
    if (std::isnan(run.pressure_pa[i])) continue;
    apart += std::pow(model_pa[i] - run.pressure_pa[i], 2);
    size += std::pow(model_pa[i] - ambient_pa, 2) + std::pow(run.pressure_pa[i] - ambient_pa, 2);
  }
  return size > 0.0 ? apart / size : 0.0;
}

// E of every run; infinite where it cannot be simulated.
std::vector<double> Mismatches(const Dataset& dataset, const std::function<bool()>& cancelled) {
  const ForwardModel forward(dataset);
  const ModelState declared = forward.Declared();
  PredictOptions options;
  options.relative_tolerance = kTolerance;
  options.steps_max = kStepsMax;
  options.cancelled = cancelled;
  std::vector<double> mismatches;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction prediction = forward.Predict(i, declared, {}, options);
    mismatches.push_back(prediction.status == model::SimulateStatus::kDone
                             ? Mismatch(dataset.runs[i], prediction.reading.pressure_pa)
                             : std::numeric_limits<double>::infinity());
  }
  return mismatches;
}

std::string Names(const Dataset& astray, const std::vector<std::size_t>& some) {
  std::string text = some.size() == 1 ? "run " : "runs ";
  for (std::size_t k = 0; k < some.size(); ++k)
    text += (k == 0 ? "" : k + 1 < some.size() ? ", " : " and ") + astray.runs[some[k]].id;
  return text;
}

// The slip that undoes most runs, of those the one that leaves least.
std::vector<std::string> OfSingleRuns(const Dataset& astray, const std::vector<double>& before,
                                      bool all, const std::function<bool()>& cancelled) {
  const Slip* likeliest = nullptr;
  std::vector<std::size_t> most;
  double least = std::numeric_limits<double>::infinity();
  for (const Slip& slip : Slips()) {
    Dataset undone = astray;
    for (Run& run : undone.runs) slip.undo(run);
    const std::vector<double> after = Mismatches(undone, cancelled);
    std::vector<std::size_t> runs;
    double left = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i)
      if (after[i] < kUndone * before[i]) runs.push_back(i), left += after[i];
    if (runs.empty() || runs.size() < most.size()) continue;
    if (runs.size() == most.size() && left >= least) continue;
    likeliest = &slip;
    most = std::move(runs);
    least = left;
  }
  if (!likeliest) return {};
  all = all && most.size() == astray.runs.size();
  return {(all ? "the runs" : Names(astray, most)) + (most.size() == 1 && !all ? " fits" : " fit") +
          " the declared model far better if " + likeliest->what + ": check the record"};
}

void ExchangeReadings(Run& a, Run& b) {
  std::swap(a.t_s, b.t_s);
  std::swap(a.pressure_pa, b.pressure_pa);
  std::swap(a.channels, b.channels);
}

std::vector<std::string> OfPairs(const Dataset& astray, const std::vector<double>& before,
                                 const std::function<bool()>& cancelled) {
  std::vector<std::string> sentences;
  const std::size_t count = astray.runs.size();
  for (std::size_t i = 0; i < count && count <= kExchangedAmong; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      Dataset pair = astray;
      pair.runs = {astray.runs[i], astray.runs[j]};
      ExchangeReadings(pair.runs[0], pair.runs[1]);
      const std::vector<double> after = Mismatches(pair, cancelled);
      if (after[0] < kUndone * before[i] && after[1] < kUndone * before[j])
        sentences.push_back("runs " + astray.runs[i].id + " and " + astray.runs[j].id +
                            " fit the declared model far better with their readings exchanged: "
                            "check the record");
    }
  }
  return sentences;
}

}  // namespace

std::vector<std::string> SuspectedSlips(const Dataset& dataset,
                                        const std::function<bool()>& cancelled) {
  const std::vector<double> all = Mismatches(dataset, cancelled);
  Dataset astray = dataset;
  astray.runs.clear();
  std::vector<double> before;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] > kAstray && std::isfinite(all[i]))
      astray.runs.push_back(dataset.runs[i]), before.push_back(all[i]);
  if (before.empty()) return {};
  std::vector<std::string> sentences =
      OfSingleRuns(astray, before, before.size() == all.size(), cancelled);
  return sentences.empty() ? OfPairs(astray, before, cancelled) : sentences;
}

}  // namespace plenum::calibration
