#include "calibration/fit/rig/run_rig.h"

#include <algorithm>
#include <utility>

#include "calibration/fit/rig/rig_effects.h"
#include "calibration/values/crossing.h"
#include "calibration/values/measured_place.h"
#include "model/effects/learned/learned.h"
#include "model/flow/tube.h"

namespace plenum::calibration {
namespace {

using model::FlowElement;

FlowElement Scaled(FlowElement element, const ModelState& state) {
  element.sonic_conductance_m3_per_s_pa *= FactorOf(state, Declared::kSonicConductance);
  element.critical_ratio = std::clamp(
      element.critical_ratio * FactorOf(state, Declared::kCriticalRatio), 0.0, kCriticalRatioMax);
  return element;
}

// An actuator's table of volumes; empty where it has none.
model::MonotoneCurve Scaled(const model::MonotoneCurve& table, double factor) {
  if (table.empty() || factor == 1.0) return table;
  std::vector<double> volume_m3(table.y().begin(), table.y().end());
  for (double& m3 : volume_m3) m3 *= factor;
  return {{table.x().begin(), table.x().end()}, std::move(volume_m3)};
}

model::Chamber Scaled(model::Chamber chamber, const Run& run, const Factors& factors,
                      double shift_pa) {
  const auto factor = [&](Declared number) { return factors[static_cast<std::size_t>(number)]; };
  const auto [least, most] = ExpansionRange(run, chamber);
  chamber.rest_volume_m3 *= factor(Declared::kRestVolume);
  chamber.volume_curve = Scaled(chamber.volume_curve, factor(Declared::kRestVolume));
  chamber.expansion_ratio =
      std::clamp(chamber.expansion_ratio * factor(Declared::kExpansionRatio), least, most);
  chamber.operating_pressure_pa += (factor(Declared::kOperatingPressure) - 1.0) *
                                       (chamber.operating_pressure_pa - run.ambient.pressure_pa) +
                                   shift_pa;
  chamber.ambient_pressure_pa += shift_pa;
  return chamber;
}

// Elements between source and inlet sensor.
std::size_t InletAfter(const Run& run) {
  const auto tube = std::find_if(run.line.begin(), run.line.end(),
                                 [](const LinePiece& piece) { return piece.tube.has_value(); });
  return tube == run.line.end() ? 0 : static_cast<std::size_t>(tube - run.line.begin());
}

model::Source SourceOf(const Run& run, std::size_t index, const ModelState& state,
                       const DrivingRecords& driving) {
  const double factor = FactorOf(state, Declared::kSourcePressure);
  const double shift_pa = AmbientShift(run, state);
  const double pressure_pa = SourcePressure(run, factor, shift_pa);
  if (Evacuates(run)) return model::RegulatedSource{.pressure_pa = ExhaustPressure(run, shift_pa)};
  if (const model::TimeCourse& told = driving.source_pa; !told.empty())
    return model::DrivenSource{told.time_s, told.value, factor};
  switch (run.supply) {
    case Supply::kRegulated:
      return model::RegulatedSource{.pressure_pa = pressure_pa};
    case Supply::kCompressor:
      return model::ReservoirSource{
          .volume_m3 = run.reservoir_volume_m3 * FactorOf(state, Declared::kReservoirVolume),
          .initial_pressure_pa = pressure_pa - state.clock_s[index] * PumpingRate(run),
          .compressor = run.compressor};
    case Supply::kFlow:
      return model::PumpSource{.compressor = run.compressor};
    case Supply::kMeasured:
    case Supply::kNone:
      break;
  }
  return model::NoSource{};
}

// Elements in the order from the source and back, and the volume of their tubes.
struct Ways {
  std::vector<FlowElement> fill, back;
  double bore_m3 = 0.0;
};
Ways WaysThrough(const std::vector<LinePiece>& line, const ModelState& state) {
  Ways ways;
  for (const LinePiece& piece : line) {
    FlowElement fill = Scaled(piece.fill, state), back = Scaled(piece.exhaust, state);
    if (piece.tube) {
      fill = back = model::TubeElement(BoreOf(piece, state), piece.tube->length_m);
      ways.bore_m3 += model::BoreVolume(BoreOf(piece, state), piece.tube->length_m);
    }
    ways.fill.push_back(fill);
    ways.back.insert(ways.back.begin(), back);
  }
  return ways;
}

// Its chamber and what acts on it, without a line.
model::GroupRig GroupOf(const Run& run, std::size_t index, const ModelState& state,
                        std::size_t at) {
  const Several& several = run.several;
  const bool piece = at >= several.first();
  const std::size_t specimen = several.empty() ? run.specimen : piece ? at - several.first() : 0;
  Factors factors = FactorsOf(run, state, specimen);
  if (!piece) std::fill_n(factors.begin(), kOfActuator, 1.0);  // a junction is no actuator
  const double shift_pa = AmbientShift(run, state);
  model::GroupRig group;
  group.name = several.empty() || !piece ? run.id : several.all[at].name;
  group.chamber =
      Scaled(several.empty() ? run.chamber : several.all[at].chamber, run, factors, shift_pa);
  group.initial_pressure_pa = state.initial_pressure_pa[index] + shift_pa;
  if (!several.empty()) group.initial_pressure_pa += several.all[at].start_above_pa;
  group.initial_temperature_k = state.initial_temperature_k[index];
  group.blocked = run.blocked;
  group.effects = EffectsOn(state.effects, run, at);
  for (model::Effect& effect : group.effects)
    if (double* phase_rad = NumberNamed(effect, model::kPhaseSpec.name))
      *phase_rad = state.phase_rad[index];
  return group;
}

// The valve's commands, with what makes them late.
void TakeSchedule(const Run& run, std::size_t index, const ModelState& state,
                  model::GroupRig& group) {
  for (const model::ValveCommand& command : run.valve)
    group.schedule.push_back(
        {command.time_s - StartOf(run) + state.clock_s[index], AsCrossed(command.state, run)});
  for (std::size_t k = 0; k < group.schedule.size(); ++k)
    group.schedule[k].time_s += MovedBy(run, index, k, state);
  for (model::Effect& effect : group.effects) {
    double* lateness_s = NumberNamed(effect, model::kLatenessName);
    if (!lateness_s || state.late_s[index].empty()) continue;
    *lateness_s = 0.0;
    for (std::size_t k = 0; k < group.schedule.size(); ++k)
      group.schedule[k].time_s += state.late_s[index][k];
  }
}

}  // namespace

double FactorOf(const ModelState& state, Declared number) {
  return state.factor[static_cast<std::size_t>(number)];
}

double BoreOf(const LinePiece& piece, const ModelState& state) {
  return piece.tube->inner_diameter_m * FactorOf(state, Declared::kTubeInnerDiameter);
}

double PumpingRate(const Run& run) {
  if (run.supply != Supply::kCompressor) return 0.0;
  const double kelvin_ratio = run.ambient.temperature_k / model::kReferenceTemperatureK;
  return model::FreeAirDelivery(run.compressor, run.source_pressure_pa) *
         model::kReferencePressurePa * kelvin_ratio / run.reservoir_volume_m3;
}

model::Rig RigOfRun(const Run& run, std::size_t index, const ModelState& state,
                    const DrivingRecords& driving) {
  model::Rig rig;
  const double shift_pa = AmbientShift(run, state);
  rig.ambient = {run.ambient.pressure_pa + shift_pa, run.ambient.temperature_k};
  rig.gas = run.gas;
  rig.dense = driving.dense;
  rig.source = SourceOf(run, index, state, driving);
  if (Evacuates(run))
    rig.exhaust_pressure_pa =
        SourcePressure(run, FactorOf(state, Declared::kSourcePressure), shift_pa);
  else if (run.exhaust_pressure_pa > 0.0)
    rig.exhaust_pressure_pa = ExhaustPressure(run, shift_pa);
  std::vector<LinePiece> line;
  for (const LinePiece& piece : run.line) line.push_back(AsCrossed(piece, run));
  for (std::size_t at = 0; at < std::max(run.several.all.size(), std::size_t{1}); ++at) {
    rig.groups.push_back(GroupOf(run, index, state, at));
    model::GroupRig& group = rig.groups.back();
    Ways ways = WaysThrough(at == 0 ? line : run.several.all[at].line, state);
    group.chamber.dead_volume_m3 += ways.bore_m3;
    if (at > 0)
      rig.links.push_back(
          {run.several.all[at].from, at, std::move(ways.fill), std::move(ways.back)});
    else
      group.fill = std::move(ways.fill), group.exhaust = std::move(ways.back);
  }
  model::GroupRig& valved = rig.groups.front();
  valved.inlet_after = InletAfter(run);
  valved.told = {driving.opening, driving.volume_m3};
  TakeSchedule(run, index, state, valved);
  PutMeasured(run, state.measured, rig);
  return rig;
}

}  // namespace plenum::calibration
