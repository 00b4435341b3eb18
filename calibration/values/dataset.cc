#include "calibration/values/dataset.h"

#include <algorithm>
#include <cmath>

namespace plenum::calibration {
namespace {

constexpr int kFirstReadings = 10;
constexpr double kLeastAmbientPa = 50e3, kMostAmbientPa = 110e3;  // on land

}  // namespace

std::string_view Name(Declared number) {
  static constexpr std::array<std::string_view, kDeclaredCount> kNames = {
      "rest_volume",       "expansion_ratio", "operating_pressure",  "source_pressure",
      "sonic_conductance", "critical_ratio",  "tube_inner_diameter", "reservoir_volume",
      "ambient_pressure",  "sensor_zero",     "sensor_gain"};
  return kNames[static_cast<std::size_t>(number)];
}

namespace {

// Whether the line has a pair whose number at one of both places is not measured.
bool HasUnmeasured(const Run& run, MeasuredPlace::Of fill, MeasuredPlace::Of exhaust) {
  const auto measures = [&](std::size_t piece, MeasuredPlace::Of of) {
    return std::any_of(
        run.measured.places.begin(), run.measured.places.end(),
        [&](const MeasuredPlace& place) { return place.of == of && place.piece == piece; });
  };
  for (std::size_t i = 0; i < run.line.size(); ++i)
    if (!run.line[i].tube && !(measures(i, fill) && measures(i, exhaust))) return true;
  return false;
}

}  // namespace

bool Has(const Run& run, Declared number) {
  using Of = MeasuredPlace::Of;
  const auto any = [&](bool tube) {
    return std::any_of(run.line.begin(), run.line.end(),
                       [&](const LinePiece& piece) { return piece.tube.has_value() == tube; });
  };
  switch (number) {
    case Declared::kExpansionRatio:
    case Declared::kOperatingPressure:
      return !run.blocked && run.chamber.expansion_ratio > 1.0;
    case Declared::kSourcePressure:
      return run.supply != Supply::kNone && run.supply != Supply::kFlow;
    case Declared::kSonicConductance:
      return HasUnmeasured(run, Of::kFillConductance, Of::kExhaustConductance);
    case Declared::kCriticalRatio:
      return HasUnmeasured(run, Of::kFillRatio, Of::kExhaustRatio);
    case Declared::kTubeInnerDiameter:
      return any(true);
    case Declared::kReservoirVolume:
      return run.supply == Supply::kCompressor;
    case Declared::kAmbientPressure:  // where no record of another gauge and no pump's curve has it
      return (run.supply == Supply::kNone || run.supply == Supply::kRegulated) &&
             run.channels.source_pressure_pa.empty() && run.channels.inlet_pressure_pa.empty() &&
             !FollowsSetpoint(run);
    case Declared::kSensorZero:
    case Declared::kSensorGain:
      return run.sensor.accuracy_pa > 0.0;
    case Declared::kRestVolume:
      break;
  }
  if (run.volume_imposed) return false;
  return std::none_of(run.measured.places.begin(), run.measured.places.end(),
                      [](const MeasuredPlace& place) { return place.of == Of::kVolume; });
}

bool RecordsMore(const Channels& channels) {
  return !channels.inlet_pressure_pa.empty() || !channels.temperature_k.empty() ||
         !channels.volume_m3.empty() || !channels.flow_m3_per_s.empty();
}

bool FollowsSetpoint(const Run& run) {
  return run.supply == Supply::kRegulated && !run.channels.source_setpoint_pa.empty();
}

double StartOf(const Run& run) {
  const double first_sample_s = run.t_s.empty() ? 0.0 : run.t_s.front();
  return run.valve.empty() ? first_sample_s : std::min(first_sample_s, run.valve.front().time_s);
}

double InstantUncertainty(const Run& run, std::size_t command) {
  return command < run.valve_uncertainty_s.size() ? run.valve_uncertainty_s[command] : 0.0;
}

double FirstReading(const Run& run) {
  if (run.pressure_pa.empty()) return run.ambient.pressure_pa;
  const auto opens = std::find_if(
      run.valve.begin(), run.valve.end(),
      [](const model::ValveCommand& command) { return command.state != model::ValveState::kHold; });
  const double until_s = opens == run.valve.end() ? run.t_s.back() : opens->time_s;
  const int most = run.volume_imposed ? 1 : kFirstReadings;  // it moves from the start
  double sum_pa = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < run.t_s.size() && count < most; ++i) {
    if (count > 0 && run.t_s[i] >= until_s) break;
    if (std::isnan(run.pressure_pa[i])) continue;
    sum_pa += run.pressure_pa[i];
    ++count;
  }
  return count == 0 ? run.ambient.pressure_pa : sum_pa / count;
}

std::pair<double, double> FactorRange(const Dataset& dataset, Declared number) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double ratio = kInfinity, expansion = 1.0, vacuum = kInfinity, lowest_pa = kInfinity,
         highest_pa = 0.0;
  for (const Run& run : dataset.runs) {
    lowest_pa = std::min(lowest_pa, run.ambient.pressure_pa);
    highest_pa = std::max(highest_pa, run.ambient.pressure_pa);
    if (run.source_pressure_pa < run.ambient.pressure_pa)
      vacuum = std::min(
          vacuum, run.ambient.pressure_pa / (run.ambient.pressure_pa - run.source_pressure_pa));
    if (!run.blocked) expansion = std::max(expansion, run.chamber.expansion_ratio);
    for (const LinePiece& piece : run.line)
      for (const double b : {piece.fill.critical_ratio, piece.exhaust.critical_ratio})
        if (!piece.tube && b > 0.0) ratio = std::min(ratio, b);
  }
  switch (number) {
    case Declared::kExpansionRatio:
      return {1.0 / expansion, kInfinity};
    case Declared::kCriticalRatio:
      return {0.0, std::max(1.0, kCriticalRatioMax / ratio)};
    case Declared::kSourcePressure:
      return {0.0, vacuum};
    case Declared::kAmbientPressure:
      return {std::min(1.0, kLeastAmbientPa / lowest_pa),
              std::max(1.0, kMostAmbientPa / highest_pa)};
    default:
      return {0.0, kInfinity};
  }
}

}  // namespace plenum::calibration
