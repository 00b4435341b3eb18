#include "calibration/fit/coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "calibration/values/effect_sets.h"
#include "calibration/values/specimens.h"
#include "model/effects/learned/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastFactor = 0.05, kMostFactor = 20.0;  // of a number known to a share
constexpr double kUnknownSpan = 14.0;                      // e-folds either way
constexpr double kSeriesLow = 1e-3, kSeriesHigh = 1e6;     // of u
constexpr double kClockIntervals = 2.0;                    // most that a clock may be off
constexpr double kStroked = 0.05;         // gauge, of the operating pressure: a stroke came before
constexpr double kRoomOfStroke = 0.9;     // of the time to the next command
constexpr double kPressureStepPa = 1e3;   // scale of an initial pressure
constexpr double kLeastPressurePa = 1.0;  // absolute: a reading near vacuum may be below 0
constexpr double kSoundMPerS = 290.0;     // isothermal
constexpr double kCoarse = 0.2;           // of a stroke: less than five readings in one
constexpr double kMostDamping = 2.0;      // of an inertia: beyond, a wall only creeps
constexpr double kAtEnd = 1e-3;           // of a bound of u, beside it

enum class Size {
  kOne,
  kDuration,
  kStroke,
  kRate,
  kPressure,
  kVolume,
  kConductance,
  kLeak,
  kFlow,
  kViscous,
  kInertial
};

// How a parameter is searched: kind, the size that it goes by, starts in units of that size.
struct Search {
  std::string_view effect, parameter;
  Coordinate::Kind kind;
  Size size;
  double absent;               // linear only, in SI
  std::vector<double> starts;  // as many for each parameter of an effect
};

using enum Coordinate::Kind;

const std::vector<Search>& Searches() {
  static const std::vector<Search> kSearches = {
      {"valve_delay", "delay_s", kLinear, Size::kStroke, 0.0, {0.02}},
      {"valve_ramp", "duration_s", kLinear, Size::kStroke, 0.0, {0.01, 0.5}},
      {"directional_conductance", "fill_factor", kLinear, Size::kOne, 1.0, {0.02}},
      {"cracking_pressure", "pressure_pa", kLinear, Size::kPressure, 0.0, {0.02}},
      {"exhaust_restriction",
       "sonic_conductance_m3_per_s_pa",
       kSeries,
       Size::kConductance,
       0.0,
       {0.3}},
      {"exhaust_restriction", "critical_ratio", kLinear, Size::kOne, 0.0, {0.3}},
      {"dead_volume", "volume_m3", kLinear, Size::kVolume, 0.0, {0.05}},
      {"nonlinear_compliance", "curvature", kLinear, Size::kOne, 0.0, {0.05}},
      {"nonlinear_compliance", "s_amplitude", kLinear, Size::kOne, 0.0, {0.0}},
      {"hysteresis", "half_width_pa", kLinear, Size::kPressure, 0.0, {0.02}},
      {"creep", "fraction", kLinear, Size::kOne, 0.0, {0.05, 0.05}},
      {"creep", "time_constant_s", kLog, Size::kDuration, 0.0, {0.15, 0.02}},
      {"inertia", "natural_frequency_rad_per_s", kLog, Size::kRate, 0.0, {15.0, 50.0}},
      {"inertia", "damping_ratio", kLinear, Size::kOne, 0.0, {0.3, 0.3}},
      {"heat_transfer", "time_constant_s", kLog, Size::kStroke, 0.0, {0.3, 5.0, 0.02}},
      {"supply_droop", "volume_m3", kLog, Size::kVolume, 0.0, {6.0, 2.0}},
      {"supply_droop",
       "sonic_conductance_m3_per_s_pa",
       kSeries,
       Size::kConductance,
       0.0,
       {10.0, 0.5}},
      {"supply_droop", "critical_ratio", kLinear, Size::kOne, 0.0, {0.3, 0.3}},
      {"line_dynamics", "length_m", kLog, Size::kOne, 0.0, {0.5, 2.0, 0.15}},
      {"line_dynamics", "inner_diameter_m", kLog, Size::kOne, 0.0, {2e-3, 3e-3, 2e-3}},
      {"leak", "sonic_conductance_m3_per_s_pa", kLinear, Size::kLeak, 0.0, {0.03}},
      {"leak", "conductance_m3_per_s_pa", kLinear, Size::kLeak, 0.0, {0.03}},
      {"leak", "critical_ratio", kLinear, Size::kOne, 0.0, {0.3}},
      {"leak", "viscous_pa2_s_per_kg", kLog, Size::kViscous, 0.0, {30.0, 30.0, 0.3}},
      {"leak", "inertial_pa2_s2_per_kg2", kLog, Size::kInertial, 0.0, {1000.0, 10.0, 0.1}},
      {"outgassing", "initial_flow_m3_per_s", kLinear, Size::kFlow, 0.0, {0.03, 0.03}},
      {"outgassing", "time_constant_s", kLog, Size::kDuration, 0.0, {0.3, 0.03}},
      {"sensor_lag", "time_constant_s", kLinear, Size::kStroke, 0.0, {0.005}},
      {"sensor_gain", "gain", kLinear, Size::kOne, 1.0, {0.01}},
      {"sensor_offset", "offset_pa", kLinear, Size::kPressure, 0.0, {0.005}},
  };
  return kSearches;
}

// For a parameter that the list does not know, by its unit.
Search SearchByUnit(std::string_view effect, const model::ParameterSpec& spec) {
  const auto ends = [&](std::string_view unit) { return spec.name.ends_with(unit); };
  const Size size = ends("conductance_m3_per_s_pa") ? Size::kConductance
                    : ends("_rad_per_s")            ? Size::kRate
                    : ends("_hz")                   ? Size::kRate
                    : ends("_s")                    ? Size::kStroke
                    : ends("_pa")                   ? Size::kPressure
                    : ends("_m3")                   ? Size::kVolume
                                                    : Size::kOne;
  const bool above_zero = spec.low > 0.0;
  return {effect, spec.name, above_zero ? kLog : kLinear, size, 0.0, {above_zero ? 0.3 : 0.05}};
}

Search SearchOf(const model::EffectSpec& effect, const model::ParameterSpec& spec) {
  for (const Search& search : Searches())
    if (search.effect == WithoutChamber(effect).id && search.parameter == spec.name) return search;
  return SearchByUnit(effect.id, spec);
}

double InUnit(Size size, const TypicalSizes& sizes) {
  // A leak that empties the chamber in the time of a run, and the mass flow that goes with it.
  const double leak_m3_per_s =
      sizes.volume_m3 * sizes.gauge_pa / model::kReferencePressurePa / sizes.duration_s;
  const double leak_kg_per_s = leak_m3_per_s * model::kReferenceDensityKgPerM3;
  const double high_pa = sizes.gauge_pa + model::kReferencePressurePa;
  const double squares = high_pa * high_pa - std::pow(model::kReferencePressurePa, 2);
  switch (size) {
    case Size::kDuration:
      return sizes.duration_s;
    case Size::kStroke:
      return sizes.stroke_s;
    case Size::kRate:
      return 1.0 / sizes.stroke_s;
    case Size::kPressure:
      return sizes.gauge_pa;
    case Size::kVolume:
      return sizes.volume_m3;
    case Size::kConductance:
      return sizes.conductance_m3_per_s_pa;
    case Size::kLeak:
      return leak_m3_per_s / model::kReferencePressurePa;
    case Size::kFlow:
      return leak_m3_per_s;
    case Size::kViscous:
      return squares / leak_kg_per_s;
    case Size::kInertial:
      return squares / (leak_kg_per_s * leak_kg_per_s);
    case Size::kOne:
      break;
  }
  return 1.0;
}

// The part of a parameter's range that is searched: up to where an effect is as good as absent
// because it follows at once, so that going on would only make the simulation stiff.
std::pair<double, double> Visible(const model::EffectSpec& effect, const model::ParameterSpec& spec,
                                  const TypicalSizes& sizes) {
  std::pair<double, double> range = {spec.low, spec.high};
  const double shortest_s = std::min(sizes.interval_s, 0.1 * sizes.stroke_s);
  if (effect.id == "sensor_lag") range.first = std::max(spec.low, 0.05 * shortest_s);
  if (effect.id == "line_dynamics" && spec.name == "length_m")  // rings at a/L
    range.first = std::clamp(0.06 * shortest_s * kSoundMPerS, spec.low, 0.1);
  if (effect.id == "heat_transfer") range.first = std::max(spec.low, 0.003 * sizes.stroke_s);
  if (effect.id == "supply_droop" && spec.name == "volume_m3")
    range.first = std::max(spec.low, 0.03 * sizes.volume_m3);
  // Beyond these a sensor is broken; an offset far above all pressures and a loss of as much in the
  // line would take each other back.
  if (effect.id == "sensor_gain") range = {0.8, 1.25};
  if (effect.id == "sensor_offset")
    range = {std::max(spec.low, -0.25 * sizes.gauge_pa),
             std::min(spec.high, 0.25 * sizes.gauge_pa)};
  if (spec.name.ends_with("_rad_per_s")) range.second = std::min(spec.high, 150.0 / sizes.stroke_s);
  if (effect.id == "inertia" && spec.name == "damping_ratio")
    range.second = std::min(spec.high, kMostDamping);
  // A vessel of hundreds of litres or readings of minutes would begin beyond the law's own range.
  range.first = std::min(range.first, spec.high);
  range.second = std::max(range.second, range.first);
  return range;
}

Coordinate CoordinateOf(const model::EffectSpec& effect, const model::ParameterSpec& spec,
                        const TypicalSizes& sizes) {
  const Search search = SearchOf(effect, spec);
  Coordinate coordinate;
  coordinate.kind = search.kind;
  coordinate.scale = InUnit(search.size, sizes);
  const bool time = spec.name.ends_with("_s"), coarse = sizes.interval_s > kCoarse * sizes.stroke_s;
  if (time && coarse && ActsInTime(effect)) coordinate.least = sizes.interval_s;
  if (time && effect.id == "outgassing") coordinate.most = sizes.duration_s;
  if (search.kind == kSeries) {
    coordinate.low = kSeriesLow;
    coordinate.high = kSeriesHigh;
    return coordinate;
  }
  coordinate.origin = search.absent;
  coordinate.low = coordinate.At(spec.low);
  coordinate.high = coordinate.At(spec.high);
  const auto [least, most] = Visible(effect, spec, sizes);
  coordinate.low = std::max(coordinate.low, coordinate.At(least));
  coordinate.high = std::min(coordinate.high, coordinate.At(most));
  if (search.kind == kLog) {
    const auto [smallest, largest] =
        std::minmax_element(search.starts.begin(), search.starts.end());
    coordinate.low = std::max(coordinate.low, std::log(*smallest) - kUnknownSpan);
    coordinate.high = std::min(coordinate.high, std::log(*largest) + kUnknownSpan);
  }
  coordinate.low = std::min(coordinate.low, coordinate.high);
  return coordinate;
}

Coordinate FactorCoordinate(const Parameter& factor, double uncertainty, bool freed,
                            const std::pair<double, double>& range) {
  Coordinate coordinate;
  coordinate.parameter = factor;
  if (uncertainty == kUnknown) {
    coordinate.kind = kLog;
    coordinate.low = -kUnknownSpan, coordinate.high = kUnknownSpan;
  } else {
    coordinate.origin = 1.0;
    coordinate.scale = uncertainty > 0.0 ? uncertainty : kExactUncertainty;
    coordinate.low = coordinate.At(kLeastFactor), coordinate.high = coordinate.At(kMostFactor);
    coordinate.prior = !freed;
  }
  coordinate.low = std::max(coordinate.low, coordinate.At(range.first));
  coordinate.high = std::min(coordinate.high, coordinate.At(range.second));
  return coordinate;
}

double IntervalOf(const Run& run) {
  return (run.t_s.back() - run.t_s.front()) / static_cast<double>(run.t_s.size() - 1);
}

// From a run's start to its first stroke, by which its commands can be early; 0 without a stroke.
double FirstStrokeAfter(const Run& run) {
  for (const model::ValveCommand& command : run.valve)
    if (command.state != model::ValveState::kHold) return command.time_s - StartOf(run);
  return 0.0;
}

// A declared pressure that is the first reading itself was read, not set.
bool InitialIsRead(const Run& run) {
  return !run.initial_pressure_pa ||
         (!run.pressure_pa.empty() && *run.initial_pressure_pa == run.pressure_pa.front() &&
          *run.initial_pressure_pa != run.ambient.pressure_pa);
}

}  // namespace

double Coordinate::Number(double u) const {
  switch (kind) {
    case Kind::kLog:
      return scale * std::exp(u);
    case Kind::kSeries:
      return scale / std::sqrt(u);
    case Kind::kLinear:
      break;
  }
  return origin + scale * u;
}

double Coordinate::Slope(double u) const {
  switch (kind) {
    case Kind::kLog:
      return scale * std::exp(u);
    case Kind::kSeries:
      return -0.5 * scale / (u * std::sqrt(u));
    case Kind::kLinear:
      break;
  }
  return scale;
}

double Coordinate::At(double number) const {
  switch (kind) {
    case Kind::kLog:
      return number > 0.0 ? std::log(number / scale) : -kInfinity;
    case Kind::kSeries:
      return std::pow(scale / number, 2);
    case Kind::kLinear:
      break;
  }
  return (number - origin) / scale;
}

bool Coordinate::AtEnd(double u) const {
  return u <= low + kAtEnd * std::abs(low) || u >= high - kAtEnd * std::abs(high);
}

TypicalSizes SizesOf(const Dataset& dataset) {
  TypicalSizes sizes;
  double conductance = kInfinity, operating_volume_m3 = 0.0, samples = 0.0, sampled_s = 0.0;
  sizes.duration_s = 0.0;
  for (const Run& run : dataset.runs) {
    sizes.duration_s = std::max(sizes.duration_s, run.t_s.back() - StartOf(run));
    sampled_s += run.t_s.back() - run.t_s.front();
    samples += static_cast<double>(run.t_s.size());
    for (const LinePiece& piece : run.line)
      if (!piece.tube)
        conductance = std::min({conductance, piece.fill.sonic_conductance_m3_per_s_pa,
                                piece.exhaust.sonic_conductance_m3_per_s_pa});
    sizes.gauge_pa = model::Span(run.chamber);
    sizes.volume_m3 = run.chamber.rest_volume_m3;
    operating_volume_m3 =
        std::max(sizes.volume_m3, model::Volume(run.chamber, run.chamber.operating_pressure_pa));
  }
  sizes.interval_s = sampled_s / samples;
  if (std::isfinite(conductance)) {
    sizes.conductance_m3_per_s_pa = conductance;
    sizes.stroke_s = operating_volume_m3 / (conductance * model::kReferencePressurePa);
  } else {
    sizes.stroke_s = sizes.duration_s;
    sizes.conductance_m3_per_s_pa =
        operating_volume_m3 / (sizes.stroke_s * model::kReferencePressurePa);
  }
  return sizes;
}

TypicalSizes SizesOf(const Dataset& dataset, const ModelState& fitted) {
  const auto factor = [&, all = FactorsOf(dataset.runs.back(), fitted)](Declared number) {
    const auto at = static_cast<std::size_t>(number);
    return dataset.relative_uncertainty[at] == kUnknown ? all[at] : 1.0;
  };
  const double conductance = factor(Declared::kSonicConductance);
  const double volume = factor(Declared::kRestVolume);
  TypicalSizes sizes = SizesOf(dataset);
  sizes.conductance_m3_per_s_pa *= conductance;
  sizes.volume_m3 *= volume;
  sizes.stroke_s *= volume / conductance;
  return sizes;
}

std::vector<Coordinate> BaseCoordinates(const ForwardModel& forward,
                                        const std::vector<std::size_t>& runs, bool clocks,
                                        const Freed& freed) {
  const Dataset& dataset = forward.dataset();
  std::vector<Coordinate> coordinates;
  for (std::size_t k = 0; k < kDeclaredCount; ++k) {
    const auto number = static_cast<Declared>(k);
    const double uncertainty = dataset.relative_uncertainty[k];
    for (const std::size_t specimen : SpecimensWith(dataset, runs, number))
      if (const bool free = freed.Holds(k, specimen); free || uncertainty > 0.0)
        coordinates.push_back(FactorCoordinate({.declared = number, .specimen = specimen},
                                               uncertainty, free, FactorRange(dataset, number)));
  }
  const ModelState declared = forward.Declared();
  for (const std::size_t i : runs) {
    if (!InitialIsRead(dataset.runs[i])) continue;
    Coordinate coordinate;
    coordinate.parameter = {.kind = Parameter::Kind::kInitialPressure, .run = i};
    coordinate.origin = std::max(declared.initial_pressure_pa[i], kLeastPressurePa);
    coordinate.scale = kPressureStepPa;
    coordinate.low = coordinate.At(kLeastPressurePa);
    coordinate.high = coordinate.At(10.0 * coordinate.origin);
    coordinates.push_back(coordinate);
  }
  for (const std::size_t i : runs) {
    const double interval_s = IntervalOf(dataset.runs[i]);
    const double room_s = FirstStrokeAfter(dataset.runs[i]);
    if (!clocks || !(room_s > 0.0)) continue;
    Coordinate coordinate;
    coordinate.parameter = {.kind = Parameter::Kind::kClock, .run = i};
    coordinate.scale = interval_s / std::sqrt(12.0);
    coordinate.low = -std::min(kClockIntervals * interval_s, room_s) / coordinate.scale;
    coordinate.high = kClockIntervals * std::sqrt(12.0);
    coordinate.prior = true;
    coordinates.push_back(coordinate);
  }
  return coordinates;
}

std::vector<Coordinate> TemperatureCoordinates(const ForwardModel& forward,
                                               const std::vector<std::size_t>& runs) {
  std::vector<Coordinate> coordinates;
  const ModelState declared = forward.Declared();
  for (const std::size_t i : runs) {
    const Run& run = forward.dataset().runs[i];
    const double gauge_pa = declared.initial_pressure_pa[i] - run.ambient.pressure_pa;
    const double span_pa = model::Span(run.chamber);
    const bool stroked = InitialIsRead(run) && std::abs(gauge_pa) > kStroked * span_pa;
    if (run.initial_temperature_k || !stroked) continue;
    Coordinate coordinate;
    coordinate.parameter = {.kind = Parameter::Kind::kInitialTemperature, .run = i};
    coordinate.origin = run.ambient.temperature_k;
    coordinate.scale = kInitialTemperatureK;
    coordinate.low = -0.5 * coordinate.origin / coordinate.scale;
    coordinate.high = coordinate.origin / coordinate.scale;
    coordinate.prior = true;
    coordinates.push_back(coordinate);
  }
  return coordinates;
}

std::vector<Coordinate> RunCoordinates(const ForwardModel& forward,
                                       const std::vector<std::size_t>& runs,
                                       const std::vector<model::Effect>& effects,
                                       const TypicalSizes& sizes) {
  const auto any = [&](std::string_view name) {
    return std::any_of(effects.begin(), effects.end(), [&](const model::Effect& effect) {
      return std::any_of(effect.spec->parameters.begin(), effect.spec->parameters.end(),
                         [&](const model::ParameterSpec& spec) { return spec.name == name; });
    });
  };
  std::vector<Coordinate> coordinates;
  const bool swings = any(model::kPhaseSpec.name), late = any(model::kLatenessName);
  for (const std::size_t i : runs) {
    if (swings)
      coordinates.push_back({.parameter = {.kind = Parameter::Kind::kPhase, .run = i},
                             .low = model::kPhaseSpec.low,
                             .high = model::kPhaseSpec.high});
    const Run& run = forward.dataset().runs[i];
    for (std::size_t k = 0; late && k < run.valve.size(); ++k) {
      const auto before = k > 0 ? run.valve[k - 1].state : model::ValveState::kHold;
      const double next_s = k + 1 < run.valve.size() ? run.valve[k + 1].time_s : run.t_s.back();
      const double room_s = kRoomOfStroke * (next_s - run.valve[k].time_s);
      if (run.valve[k].state == before || !(room_s > 0.0)) continue;
      coordinates.push_back(
          {.parameter = {.kind = Parameter::Kind::kLateness, .number = k, .run = i},
           .scale = sizes.stroke_s,
           .high = room_s / sizes.stroke_s});
    }
  }
  return coordinates;
}

std::vector<Coordinate> EffectCoordinates(const model::EffectSpec& spec, std::size_t effect,
                                          const TypicalSizes& sizes) {
  std::vector<Coordinate> coordinates;
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    if (model::OfEachRun(spec.parameters[i])) continue;
    coordinates.push_back(CoordinateOf(spec, spec.parameters[i], sizes));
    coordinates.back().parameter = {
        .kind = Parameter::Kind::kEffect, .effect = effect, .number = i};
  }
  return coordinates;
}

std::vector<model::Effect> EffectStarts(const model::EffectSpec& spec, const TypicalSizes& sizes) {
  std::size_t count = 1;
  for (const auto& parameter : spec.parameters)
    count = std::max(count, SearchOf(spec, parameter).starts.size());
  std::vector<model::Effect> starts(count, model::Effect{&spec, {}});
  for (const auto& parameter : spec.parameters) {
    const Coordinate coordinate = CoordinateOf(spec, parameter, sizes);
    const std::vector<double> values = SearchOf(spec, parameter).starts;
    for (std::size_t k = 0; k < count; ++k) {
      const double value = values[std::min(k, values.size() - 1)];
      const double u = coordinate.kind == kLog ? std::log(value) : value;
      starts[k].parameters.push_back(
          std::clamp(coordinate.Number(u), parameter.low, parameter.high));
    }
  }
  return starts;
}

}  // namespace plenum::calibration
