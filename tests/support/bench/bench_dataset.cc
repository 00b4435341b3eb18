#include "tests/support/bench/bench_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "api/simulate/effects.h"
#include "tests/support/bench/bench_json.h"

namespace plenum::test {
namespace {

model::FlowElement ElementOf(const MassElement& e) {
  model::FlowElement element;
  element.sonic_conductance_m3_per_s_pa = e.conductance;
  element.critical_ratio = e.critical_ratio;
  return element;
}

std::vector<calibration::LinePiece> LineOf(const BenchRig& rig) {
  std::vector<calibration::LinePiece> line;
  line.push_back({ElementOf(rig.fill), ElementOf(rig.exhaust), std::nullopt});
  if (rig.tube) {
    const model::FlowElement tube = ElementOf(TubeAsElement(*rig.tube));
    line.push_back({tube, tube, {{rig.tube->inner_diameter_m, rig.tube->length_m}}});
  }
  return line;
}

model::CompressorCurve CurveOf(const BenchRig& rig) {
  model::CompressorCurve curve;
  if (rig.delivery.empty()) return curve;
  std::vector<double> pressures_pa, flows;
  for (const auto& [pressure_pa, flow] : rig.delivery) {
    pressures_pa.push_back(pressure_pa);
    flows.push_back(flow);
  }
  curve.pressure_max_pa = pressures_pa.back();
  curve.free_air_m3_per_s = model::MonotoneCurve(pressures_pa, flows);
  return curve;
}

calibration::Supply SupplyOf(BenchSupply supply) {
  switch (supply) {
    case BenchSupply::kNone:
      return calibration::Supply::kNone;
    case BenchSupply::kRegulated:
      return calibration::Supply::kRegulated;
    case BenchSupply::kMeasured:
      return calibration::Supply::kMeasured;
    case BenchSupply::kCompressor:
      break;
  }
  return calibration::Supply::kCompressor;
}

std::vector<double> Absolute(const BenchRig& rig, std::vector<double> gauge_pa) {
  for (double& p : gauge_pa) p += rig.ambient_pa;
  return gauge_pa;
}

calibration::Dataset WithoutRuns(const BenchCase& bench) {
  calibration::Dataset dataset;
  dataset.name = "bench";
  std::copy(bench.uncertainty.begin(), bench.uncertainty.end(),
            dataset.relative_uncertainty.begin());
  dataset.holdout = {bench.runs.back().id};
  return dataset;
}

}  // namespace

calibration::Run ToRun(const BenchCase& bench, const BenchRun& from, const Record& record) {
  const BenchRig& rig = bench.declared;
  calibration::Run run;
  run.id = from.id;
  run.ambient.pressure_pa = rig.ambient_pa;
  run.ambient.temperature_k = rig.ambient_k;
  run.chamber.rest_volume_m3 = rig.rest_volume_m3;
  run.chamber.expansion_ratio = rig.expansion_ratio;
  run.chamber.operating_pressure_pa = rig.ambient_pa + rig.operating_gauge_pa;
  run.chamber.ambient_pressure_pa = rig.ambient_pa;
  run.line = LineOf(rig);
  run.supply = SupplyOf(rig.supply);
  run.source_pressure_pa = rig.ambient_pa + from.source_gauge_pa;
  run.compressor = CurveOf(rig);
  run.reservoir_volume_m3 = rig.reservoir_m3;
  run.blocked = from.blocked;
  if (bench.initial_declared) run.initial_pressure_pa = rig.ambient_pa + from.initial_gauge_pa;
  for (const MassCommand& c : from.schedule) {
    run.valve.push_back({c.time_s, c.direction > 0   ? model::ValveState::kInflate
                                   : c.direction < 0 ? model::ValveState::kDeflate
                                                     : model::ValveState::kHold});
  }
  run.t_s = record.t_s;
  run.pressure_pa = Absolute(rig, record.reading_gauge_pa);
  run.channels.source_pressure_pa = Absolute(rig, record.source_gauge_pa);
  return run;
}

calibration::Dataset ToDataset(const BenchCase& bench) {
  calibration::Dataset dataset = WithoutRuns(bench);
  for (std::size_t r = 0; r < bench.runs.size(); ++r) {
    dataset.runs.push_back(ToRun(bench, bench.runs[r], bench.records[r]));
  }
  return dataset;
}

calibration::Dataset NoiseFree(const BenchCase& bench) { return ToDataset(WithoutFaults(bench)); }

std::vector<model::Effect> ListedOf(const BenchCase& bench) { return ListedOf(TruthJson(bench)); }

std::vector<model::Effect> ListedOf(const api::Json& truth) {
  if (truth["kind"] == NameOf(CaseKind::kOutside)) return {};
  const api::Json owner = {{"effects", truth["effects"]}};
  api::Errors errors;
  api::Reader reader(owner, "", errors);
  std::vector<model::Effect> effects = api::ReadEffects(reader);
  if (!errors.empty()) throw std::runtime_error(errors[0].pointer + ": " + errors[0].detail);
  return effects;
}

}  // namespace plenum::test
