#include "calibration/learn/slip_kinds.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace plenum::calibration {
namespace {

constexpr double kPaPerPsi = 6894.757;
constexpr double kBelowVacuum = 0.02;  // of the ambient pressure, by which sensors may be off

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
    for (double& uncertainty_s : run.valve_uncertainty_s) uncertainty_s *= commands;
  };
}

// What was written as gauge was absolute; a gauge pressure of a supply is not below 0.
double Gauge(const Run& run, double pressure_pa) { return pressure_pa - run.ambient.pressure_pa; }

void ReadAbsolute(Run& run) {
  for (double& pa : run.pressure_pa) pa = Gauge(run, pa);
}

void SupplyAbsolute(Run& run) {
  if (run.supply == Supply::kRegulated)
    run.source_pressure_pa = std::max(run.ambient.pressure_pa, Gauge(run, run.source_pressure_pa));
  for (double& pa : run.channels.source_pressure_pa) pa = Gauge(run, pa);
  for (double& pa : run.channels.source_setpoint_pa) pa = Gauge(run, pa);
}

void StartAbsolute(Run& run) {
  if (run.initial_pressure_pa) run.initial_pressure_pa = Gauge(run, *run.initial_pressure_pa);
}

void AllAbsolute(Run& run) {
  ReadAbsolute(run);
  SupplyAbsolute(run);
  StartAbsolute(run);
  for (double& pa : run.channels.inlet_pressure_pa) pa = Gauge(run, pa);
}

void ExchangeCommands(Run& run) {
  using enum model::ValveState;
  for (model::ValveCommand& command : run.valve)
    command.state = command.state == kInflate   ? kDeflate
                    : command.state == kDeflate ? kInflate
                                                : command.state;
}

void InLitres(Run& run) { run.chamber.rest_volume_m3 *= 1000.0; }

void OfAMinute(Run& run) {
  for (LinePiece& piece : run.line)
    for (model::FlowElement* pair : {&piece.fill, &piece.exhaust})
      pair->sonic_conductance_m3_per_s_pa /= 60.0;
}

void ExchangeReadings(Run& a, Run& b) {
  std::swap(a.t_s, b.t_s);
  std::swap(a.pressure_pa, b.pressure_pa);
  std::swap(a.channels, b.channels);
}

void ExchangeSources(Run& a, Run& b) { std::swap(a.source_pressure_pa, b.source_pressure_pa); }

// "kPa abs" is kpa_abs.
std::string Plain(std::string_view text) {
  std::string plain;
  for (const char c : text)
    plain += c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<int>(c)));
  return plain;
}

struct Assumption {
  std::string name;
  std::vector<std::string> runs;  // none: all
};

Assumption ReadAssumption(std::string_view text) {
  const std::size_t colon = text.find(':');
  Assumption assumption{Plain(text.substr(0, colon)), {}};
  if (assumption.name == "kpa_gauge") assumption.name = kAsWritten;
  while (colon != std::string_view::npos && !text.empty()) {
    text.remove_prefix(std::min(text.size(), text.find_first_of(":,") + 1));
    if (const std::string_view run = text.substr(0, text.find(',')); !run.empty())
      assumption.runs.emplace_back(run);
    if (text.find(',') == std::string_view::npos) break;
  }
  return assumption;
}

template <class Kind>
const Kind* Find(std::span<const Kind> kinds, std::string_view name) {
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

std::string Known() {
  std::string names(kAsWritten);
  for (const SlipKind& kind : SlipKinds()) names += std::string(", ") + kind.name;
  for (const ExchangeKind& kind : ExchangeKinds())
    names += std::string(", ") + kind.name + ":RUN,RUN";
  return names;
}

}  // namespace

std::span<const SlipKind> SlipKinds() {
  static const std::vector<SlipKind> kKinds = {
      {"bar", "the readings are in bar, not kPa", Scaled(100.0), true},
      {"mpa", "the readings are in MPa, not kPa", Scaled(1000.0), true},
      {"psi", "the readings are in psi, not kPa", Scaled(kPaPerPsi / 1000.0), true},
      {"mbar", "the readings are in mbar, not kPa", Scaled(0.1), true},
      {"pa", "the readings are in Pa, not kPa", Scaled(0.001), true},
      {"negative", "the readings have the wrong sign", Scaled(-1.0)},
      {"kpa_abs", "the readings are absolute, not gauge", ReadAbsolute},
      {"source_kpa_abs", "the source pressure is absolute, not gauge", SupplyAbsolute},
      {"initial_kpa_abs", "the initial pressure is absolute, not gauge", StartAbsolute},
      {"all_kpa_abs", "all pressures of the runs are absolute, not gauge", AllAbsolute},
      {"valve_exchanged", "inflate and deflate are exchanged", ExchangeCommands},
      {"ms", "the times of the readings are in ms, not s", Times(1e-3, 1.0)},
      {"valve_ms", "the times of the commands are in ms, not s", Times(1.0, 1e-3)},
      {"volume_l", "the rest volume is in litres, not ml, or all times are in ms, not s", InLitres},
      {"conductance_per_min", "the line's sonic conductance is of a minute, not of a second",
       OfAMinute},
      {kAllMs, "all times, of readings and commands, are in ms, not s", Times(1e-3, 1e-3)},
  };
  return kKinds;
}

std::span<const ExchangeKind> ExchangeKinds() {
  static const std::vector<ExchangeKind> kKinds = {
      {"exchanged", "readings", ExchangeReadings},
      {"sources_exchanged", "source pressures", ExchangeSources},
  };
  return kKinds;
}

bool IsPossible(const Run& run) {
  const double lowest_pa = -kBelowVacuum * run.ambient.pressure_pa;
  const auto above = [&](double pa) { return !(pa < lowest_pa); };
  return above(run.initial_pressure_pa.value_or(0.0)) && above(run.source_pressure_pa) &&
         std::all_of(run.pressure_pa.begin(), run.pressure_pa.end(), above);
}

std::string Settle(std::string_view text, Dataset& dataset) {
  const Assumption assumption = ReadAssumption(text);
  if (assumption.name == kAsWritten) {
    dataset.as_written = true;
    return "";
  }
  std::vector<Run*> runs;
  for (const std::string& id : assumption.runs) {
    const auto run = std::find_if(dataset.runs.begin(), dataset.runs.end(),
                                  [&](const Run& one) { return one.id == id; });
    if (run == dataset.runs.end()) return "names the run " + id + ", which is not there";
    runs.push_back(&*run);
  }
  if (const SlipKind* kind = Find(SlipKinds(), assumption.name)) {
    for (Run& run : dataset.runs)
      if (runs.empty() || std::find(runs.begin(), runs.end(), &run) != runs.end()) kind->undo(run);
    const bool possible = std::all_of(dataset.runs.begin(), dataset.runs.end(), IsPossible);
    return possible ? "" : "cannot be: a pressure would be below vacuum";
  }
  const ExchangeKind* exchange = Find(ExchangeKinds(), assumption.name);
  if (!exchange) return "must be one of " + Known() + "; of some runs only: NAME:RUN,RUN";
  if (runs.size() != 2u || runs[0] == runs[1])
    return "must name two runs: " + assumption.name + ":RUN,RUN";
  exchange->undo(*runs[0], *runs[1]);
  return "";
}

std::string InWords(std::string_view text) {
  const Assumption assumption = ReadAssumption(text);
  std::string runs;
  for (const std::string& id : assumption.runs) runs += (runs.empty() ? "" : ", ") + id;
  if (assumption.name == kAsWritten) return "the record is as it was meant";
  if (const SlipKind* kind = Find(SlipKinds(), assumption.name))
    return kind->what + (runs.empty() ? "" : " (" + runs + ")");
  const ExchangeKind* exchange = Find(ExchangeKinds(), assumption.name);
  return exchange ? exchange->what + (" of the runs " + runs) + " are exchanged" : "";
}

}  // namespace plenum::calibration
