#include "calibration/fit/forward.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/recorded/gauge.h"
#include "calibration/values/crossing.h"
#include "calibration/values/measured_place.h"
#include "calibration/values/specimens.h"
#include "model/effects/learned/learned.h"
#include "model/flow/tube.h"
#include "model/simulate/sensitivity.h"

namespace plenum::calibration {
namespace {

using model::FlowElement;

constexpr double kBoreStep = 1e-5;  // relative, of a central difference

double Factor(const ModelState& state, Declared number) {
  return state.factor[static_cast<std::size_t>(number)];
}

FlowElement Scaled(FlowElement element, const ModelState& state) {
  element.sonic_conductance_m3_per_s_pa *= Factor(state, Declared::kSonicConductance);
  element.critical_ratio = std::clamp(
      element.critical_ratio * Factor(state, Declared::kCriticalRatio), 0.0, kCriticalRatioMax);
  return element;
}

// An actuator's table of volumes; empty where it has none.
model::MonotoneCurve Scaled(const model::MonotoneCurve& table, double factor) {
  if (table.empty() || factor == 1.0) return table;
  std::vector<double> volume_m3(table.y().begin(), table.y().end());
  for (double& m3 : volume_m3) m3 *= factor;
  return {{table.x().begin(), table.x().end()}, std::move(volume_m3)};
}

model::Chamber ChamberOf(const Run& run, const Factors& factors, double shift_pa) {
  const auto factor = [&](Declared number) { return factors[static_cast<std::size_t>(number)]; };
  model::Chamber chamber = run.chamber;
  chamber.rest_volume_m3 *= factor(Declared::kRestVolume);
  chamber.volume_curve = Scaled(chamber.volume_curve, factor(Declared::kRestVolume));
  chamber.expansion_ratio =
      std::max(1.0, chamber.expansion_ratio * factor(Declared::kExpansionRatio));
  chamber.operating_pressure_pa +=
      (factor(Declared::kOperatingPressure) - 1.0) *
          (run.chamber.operating_pressure_pa - run.ambient.pressure_pa) +
      shift_pa;
  chamber.ambient_pressure_pa += shift_pa;
  return chamber;
}

double Bore(const LinePiece& piece, const ModelState& state) {
  return piece.tube->inner_diameter_m * Factor(state, Declared::kTubeInnerDiameter);
}

// Elements between source and inlet sensor.
std::size_t InletAfter(const Run& run) {
  const auto tube = std::find_if(run.line.begin(), run.line.end(),
                                 [](const LinePiece& piece) { return piece.tube.has_value(); });
  return tube == run.line.end() ? 0 : static_cast<std::size_t>(tube - run.line.begin());
}

// By how much the declared compressor raises its reservoir's pressure when the run begins, Pa/s.
double PumpingRate(const Run& run) {
  if (run.supply != Supply::kCompressor) return 0.0;
  const double kelvin_ratio = run.ambient.temperature_k / model::kReferenceTemperatureK;
  return model::FreeAirDelivery(run.compressor, run.source_pressure_pa) *
         model::kReferencePressurePa * kelvin_ratio / run.reservoir_volume_m3;
}

// Null where the effect has no such parameter.
double* NumberNamed(model::Effect& effect, std::string_view name) {
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (effect.spec->parameters[i].name == name) return &effect.parameters[i];
  return nullptr;
}

// The numbers of the rig that a parameter moves, and how much of each per unit of it.
class DirectionOf {
 public:
  DirectionOf(const Run& run, const ModelState& state, model::Rig& rig)
      : run_(run), state_(state), rig_(rig), group_(rig.groups.front()) {}

  model::Direction operator()(const Parameter& parameter, std::size_t run_index) {
    direction_.clear();
    switch (parameter.kind) {
      case Parameter::Kind::kDeclared:
        if (Concerns(parameter, run_, state_)) OfFactor(parameter.declared);
        for (const MeasuredPlace& place : run_.measured.places)
          std::erase_if(direction_, [&](const model::WeightedNumber& moved) {
            return moved.number == &NumberAt(rig_, place);
          });
        break;
      case Parameter::Kind::kMeasured:
        for (const MeasuredPlace& place : run_.measured.places)
          if (place.number == parameter.number) Add(NumberAt(rig_, place), 1.0);
        break;
      case Parameter::Kind::kEffect:
        Add(group_.effects[parameter.effect].parameters[parameter.number], 1.0);
        break;
      case Parameter::Kind::kInitialPressure:
        if (parameter.run == run_index) Add(group_.initial_pressure_pa, 1.0);
        break;
      case Parameter::Kind::kInitialTemperature:
        if (parameter.run == run_index) Add(group_.initial_temperature_k, 1.0);
        break;
      case Parameter::Kind::kClock:
        if (parameter.run != run_index) break;
        for (const model::ValveCommand& command : group_.schedule) Add(command.time_s, 1.0);
        if (auto* reservoir = std::get_if<model::ReservoirSource>(&rig_.source))
          Add(reservoir->initial_pressure_pa, -PumpingRate(run_));
        break;
      case Parameter::Kind::kPhase:
        if (parameter.run != run_index) break;
        for (model::Effect& effect : group_.effects)
          if (double* phase_rad = NumberNamed(effect, model::kPhaseSpec.name)) Add(*phase_rad, 1.0);
        break;
      case Parameter::Kind::kLateness:
      case Parameter::Kind::kInstant:
        if (parameter.run == run_index) Add(group_.schedule[parameter.number].time_s, 1.0);
        break;
    }
    return direction_;
  }

 private:
  void Add(const double& number, double weight) { direction_.push_back({&number, weight}); }

  void OfFactor(Declared number) {
    model::Chamber& chamber = group_.chamber;
    switch (number) {
      case Declared::kRestVolume:
        if (chamber.volume_curve.empty()) Add(chamber.rest_volume_m3, run_.chamber.rest_volume_m3);
        break;
      case Declared::kExpansionRatio:
        if (chamber.expansion_ratio > 1.0)
          Add(chamber.expansion_ratio, run_.chamber.expansion_ratio);
        break;
      case Declared::kOperatingPressure:
        Add(chamber.operating_pressure_pa,
            run_.chamber.operating_pressure_pa - run_.ambient.pressure_pa);
        break;
      case Declared::kSourcePressure:
        OfSource();
        break;
      case Declared::kReservoirVolume:
        if (auto* reservoir = std::get_if<model::ReservoirSource>(&rig_.source))
          Add(reservoir->volume_m3, run_.reservoir_volume_m3);
        break;
      case Declared::kAmbientPressure:
        OfAmbient();
        break;
      case Declared::kSensorZero:  // of the readings alone
      case Declared::kSensorGain:
        break;
      case Declared::kSonicConductance:
      case Declared::kCriticalRatio:
      case Declared::kTubeInnerDiameter:
        for (std::size_t i = 0; i < run_.line.size(); ++i) OfPiece(number, i);
        break;
    }
  }

  // All that was declared as gauge moves with it.
  void OfAmbient() {
    if (!Has(run_, Declared::kAmbientPressure)) return;
    const double ambient_pa = run_.ambient.pressure_pa;
    for (const double* number : {&rig_.ambient.pressure_pa, &group_.initial_pressure_pa,
                                 &group_.chamber.operating_pressure_pa})
      Add(*number, ambient_pa);
    if (rig_.exhaust_pressure_pa > 0.0) Add(rig_.exhaust_pressure_pa, ambient_pa);
    if (auto* regulated = std::get_if<model::RegulatedSource>(&rig_.source))
      Add(regulated->pressure_pa, ambient_pa);
  }

  void OfSource() {
    const double gauge_pa = run_.source_pressure_pa - run_.ambient.pressure_pa;
    if (Evacuates(run_)) {
      Add(rig_.exhaust_pressure_pa, gauge_pa);
    } else if (auto* regulated = std::get_if<model::RegulatedSource>(&rig_.source)) {
      Add(regulated->pressure_pa, gauge_pa);
    } else if (auto* reservoir = std::get_if<model::ReservoirSource>(&rig_.source)) {
      Add(reservoir->initial_pressure_pa, gauge_pa);
    } else if (auto* driven = std::get_if<model::DrivenSource>(&rig_.source)) {
      Add(driven->factor, 1.0);
    }
  }

  void OfPiece(Declared number, std::size_t i) {
    const LinePiece piece = AsCrossed(run_.line[i], run_);
    FlowElement& fill = group_.fill[i];
    FlowElement& exhaust = group_.exhaust[group_.exhaust.size() - 1 - i];
    if (piece.tube) {
      if (number == Declared::kTubeInnerDiameter) OfBore(piece, fill, exhaust);
    } else if (number == Declared::kSonicConductance) {
      Add(fill.sonic_conductance_m3_per_s_pa, piece.fill.sonic_conductance_m3_per_s_pa);
      Add(exhaust.sonic_conductance_m3_per_s_pa, piece.exhaust.sonic_conductance_m3_per_s_pa);
    } else if (number == Declared::kCriticalRatio) {
      if (fill.critical_ratio < kCriticalRatioMax)
        Add(fill.critical_ratio, piece.fill.critical_ratio);
      if (exhaust.critical_ratio < kCriticalRatioMax)
        Add(exhaust.critical_ratio, piece.exhaust.critical_ratio);
    }
  }

  void OfBore(const LinePiece& piece, FlowElement& fill, FlowElement& exhaust) {
    const double bore_m = Bore(piece, state_);
    const double length_m = piece.tube->length_m;
    const double step_m = kBoreStep * bore_m;
    const FlowElement above = model::TubeElement(bore_m + step_m, length_m);
    const FlowElement below = model::TubeElement(bore_m - step_m, length_m);
    const double per_factor = piece.tube->inner_diameter_m / (2.0 * step_m);
    for (FlowElement* element : {&fill, &exhaust}) {
      Add(element->sonic_conductance_m3_per_s_pa,
          per_factor * (above.sonic_conductance_m3_per_s_pa - below.sonic_conductance_m3_per_s_pa));
      Add(element->critical_ratio, per_factor * (above.critical_ratio - below.critical_ratio));
    }
    Add(group_.chamber.dead_volume_m3,
        2.0 * model::BoreVolume(bore_m, length_m) / bore_m * piece.tube->inner_diameter_m);
  }

  const Run& run_;
  const ModelState& state_;
  model::Rig& rig_;
  model::GroupRig& group_;
  model::Direction direction_;
};

// Less the shift of the ambient pressure: readings are gauge plus the declared one.
Reading ReadingOf(model::Response response, double shift_pa) {
  Reading reading;
  if (response.groups.empty()) return reading;  // refused
  model::GroupResponse& group = response.groups.front();
  reading.pressure_pa = std::move(group.reading_pa.empty() ? group.pressure_pa : group.reading_pa);
  for (double& pa : reading.pressure_pa) pa -= shift_pa;
  reading.channels = {.source_pressure_pa = std::move(response.source_pressure_pa),
                      .inlet_pressure_pa = std::move(group.inlet_pressure_pa),
                      .temperature_k = std::move(group.temperature_k),
                      .volume_m3 = std::move(group.volume_m3),
                      .flow_m3_per_s = std::move(group.flow_m3_per_s),
                      .valve_opening = {},
                      .source_setpoint_pa = {}};
  return reading;
}

// Without heat_transfer the gas has the ambient's temperature.
void FillTemperature(const Run& run, Reading& reading) {
  if (reading.channels.temperature_k.empty())
    reading.channels.temperature_k.assign(reading.pressure_pa.size(), run.ambient.temperature_k);
}

}  // namespace

ForwardModel::ForwardModel(const Dataset& dataset) : dataset_(&dataset) {
  for (const Run& run : dataset.runs) driving_.push_back(DrivingRecordsOf(run));
}

ModelState ForwardModel::Declared() const {
  ModelState state;
  for (const MeasuredNumber& number : dataset_->measured) state.measured.push_back(number.declared);
  for (const Run& run : dataset_->runs) {
    state.initial_pressure_pa.push_back(run.initial_pressure_pa.value_or(FirstReading(run)));
    state.initial_temperature_k.push_back(
        run.initial_temperature_k.value_or(run.ambient.temperature_k));
  }
  state.specimen_factor = DeclaredFactors(*dataset_);
  state.clock_s.assign(dataset_->runs.size(), 0.0);
  state.phase_rad.assign(dataset_->runs.size(), 0.0);
  state.late_s.resize(dataset_->runs.size());
  for (const Run& run : dataset_->runs)
    state.moved_s.emplace_back(run.valve_uncertainty_s.size(), 0.0);
  return state;
}

model::Source ForwardModel::SourceOf(std::size_t index, const ModelState& state) const {
  const Run& run = dataset_->runs[index];
  const double factor = Factor(state, Declared::kSourcePressure);
  const double shift_pa = AmbientShift(run, state);
  const double pressure_pa = SourcePressure(run, factor, shift_pa);
  if (Evacuates(run)) return model::RegulatedSource{.pressure_pa = ExhaustPressure(run, shift_pa)};
  if (const model::TimeCourse& told = driving_[index].source_pa; !told.empty())
    return model::DrivenSource{told.time_s, told.value, factor};
  switch (run.supply) {
    case Supply::kRegulated:
      return model::RegulatedSource{.pressure_pa = pressure_pa};
    case Supply::kCompressor:
      return model::ReservoirSource{
          .volume_m3 = run.reservoir_volume_m3 * Factor(state, Declared::kReservoirVolume),
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

model::Rig ForwardModel::RigOf(std::size_t index, const ModelState& state) const {
  const Run& run = dataset_->runs[index];
  model::Rig rig;
  const double shift_pa = AmbientShift(run, state);
  rig.ambient = {run.ambient.pressure_pa + shift_pa, run.ambient.temperature_k};
  rig.gas = run.gas;
  rig.dense = driving_[index].dense;
  rig.source = SourceOf(index, state);
  if (Evacuates(run))
    rig.exhaust_pressure_pa =
        SourcePressure(run, Factor(state, Declared::kSourcePressure), shift_pa);
  else if (run.exhaust_pressure_pa > 0.0)
    rig.exhaust_pressure_pa = ExhaustPressure(run, shift_pa);
  model::GroupRig group;
  group.name = run.id;
  group.chamber = ChamberOf(run, FactorsOf(run, state), shift_pa);
  for (const LinePiece& declared : run.line) {
    const LinePiece piece = AsCrossed(declared, run);
    FlowElement fill = Scaled(piece.fill, state), exhaust = Scaled(piece.exhaust, state);
    if (piece.tube) {
      fill = exhaust = model::TubeElement(Bore(piece, state), piece.tube->length_m);
      group.chamber.dead_volume_m3 += model::BoreVolume(Bore(piece, state), piece.tube->length_m);
    }
    group.fill.push_back(fill);
    group.exhaust.insert(group.exhaust.begin(), exhaust);
  }
  group.inlet_after = InletAfter(run);
  for (const model::ValveCommand& command : run.valve)
    group.schedule.push_back(
        {command.time_s - StartOf(run) + state.clock_s[index], AsCrossed(command.state, run)});
  for (std::size_t k = 0; k < state.moved_s[index].size(); ++k)
    group.schedule[k].time_s += state.moved_s[index][k];
  group.initial_pressure_pa = state.initial_pressure_pa[index] + shift_pa;
  group.initial_temperature_k = state.initial_temperature_k[index];
  group.blocked = run.blocked;
  group.told = {driving_[index].opening, driving_[index].volume_m3};
  group.effects = state.effects;
  for (model::Effect& effect : group.effects) {
    if (double* phase_rad = NumberNamed(effect, model::kPhaseSpec.name))
      *phase_rad = state.phase_rad[index];
    double* lateness_s = NumberNamed(effect, model::kLatenessName);
    if (!lateness_s || state.late_s[index].empty()) continue;
    *lateness_s = 0.0;
    for (std::size_t k = 0; k < group.schedule.size(); ++k)
      group.schedule[k].time_s += state.late_s[index][k];
  }
  rig.groups = {std::move(group)};
  PutMeasured(run, state.measured, rig);
  return rig;
}

Prediction ForwardModel::Predict(std::size_t index, const ModelState& state,
                                 std::span<const Parameter> parameters,
                                 const PredictOptions& options) const {
  const Run& run = dataset_->runs[index];
  model::Rig rig = RigOf(index, state);
  model::SimulateOptions simulate;
  simulate.relative_tolerance = options.relative_tolerance;
  simulate.absolute_tolerance_pa = 1e4 * options.relative_tolerance;
  simulate.steps_max = options.steps_max;
  simulate.integrator = options.stiff ? model::Integrator::kImplicit : model::Integrator::kDamped;
  simulate.cancelled = options.cancelled;
  simulate.record = options.recorded_alone && !RecordsMore(run.channels) ? model::Record::kPressures
                                                                         : model::Record::kSamples;
  for (const double t_s : run.t_s) simulate.sample_times_s.push_back(t_s - StartOf(run));
  simulate.end_s = simulate.sample_times_s.back();

  std::vector<model::Direction> directions;
  std::vector<std::size_t> moved;  // parameter of each direction
  DirectionOf direction_of(run, state, rig);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    model::Direction direction = direction_of(parameters[j], index);
    if (direction.empty()) continue;
    directions.push_back(std::move(direction));
    moved.push_back(j);
  }
  model::SensitivityResponse result;
  if (!directions.empty()) result = model::SimulateAlongDirections(rig, simulate, directions);
  if (directions.empty()) result.response = model::Simulate(rig, simulate);
  Prediction prediction;
  prediction.status = result.response.status;
  prediction.detail = result.response.detail;
  prediction.stiff = result.response.stiff;
  prediction.reading = ReadingOf(std::move(result.response), AmbientShift(run, state));
  FillTemperature(run, prediction.reading);
  prediction.derivatives.resize(parameters.size());
  for (std::size_t j = 0; j < result.derivatives.size(); ++j) {
    const bool ambient = parameters[moved[j]] == Parameter{.declared = Declared::kAmbientPressure};
    prediction.derivatives[moved[j]] =
        ReadingOf(std::move(result.derivatives[j]), ambient ? run.ambient.pressure_pa : 0.0);
  }
  const auto slope = [&](std::size_t j) { return &prediction.derivatives[j].pressure_pa; };
  TakeGauge(run, state, parameters, slope, prediction.reading.pressure_pa);
  AddTableSlopes(*this, index, state, parameters, options, prediction);
  return prediction;
}

}  // namespace plenum::calibration
