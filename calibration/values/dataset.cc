#include "calibration/values/dataset.h"

#include <algorithm>
#include <cmath>
#include <set>

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
  const auto is = [](bool tube) {
    return [tube](const LinePiece& piece) { return piece.tube.has_value() == tube; };
  };
  const auto any = [&](bool tube) {
    return std::any_of(run.line.begin(), run.line.end(), is(tube)) ||
           run.several.HasPiece(is(tube));
  };
  switch (number) {
    case Declared::kExpansionRatio:
    case Declared::kOperatingPressure:
      if (run.blocked) return false;
      return run.chamber.expansion_ratio != 1.0 ||
             std::any_of(run.several.all.begin(), run.several.all.end(),
                         [](const auto& one) { return one.chamber.expansion_ratio != 1.0; });
    case Declared::kSourcePressure:
      return run.supply != Supply::kNone && run.supply != Supply::kFlow;
    case Declared::kSonicConductance:
      return HasUnmeasured(run, Of::kFillConductance, Of::kExhaustConductance) ||
             run.several.HasPiece(is(false));
    case Declared::kCriticalRatio:
      return HasUnmeasured(run, Of::kFillRatio, Of::kExhaustRatio) ||
             run.several.HasPiece(is(false));
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

bool Has(const Run& run, Declared number, std::size_t piece) {
  if (number != Declared::kExpansionRatio || run.several.empty()) return Has(run, number);
  return !run.blocked && ChamberOf(run, piece).expansion_ratio != 1.0;
}

const model::Chamber& ChamberOf(const Run& run, std::size_t specimen) {
  return run.several.empty() ? run.chamber : run.several.piece(specimen).chamber;
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

bool SharesInstant(const Run& run, std::size_t command) {
  const double uncertainty_s = InstantUncertainty(run, command);
  return uncertainty_s > 0.0 && std::isfinite(uncertainty_s);
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

std::size_t RecordingsOf(const Dataset& dataset, const std::vector<std::size_t>& runs) {
  std::set<std::string_view> shots;
  for (const std::size_t i : runs) {
    const Run& run = dataset.runs[i];
    shots.insert(run.several.shot.empty() ? run.id : run.several.shot);
  }
  return shots.size();
}

double LowestPressure(const Run& run) {
  double lowest_pa =
      std::min(run.ambient.pressure_pa, run.initial_pressure_pa.value_or(run.ambient.pressure_pa));
  if (run.supply == Supply::kRegulated) lowest_pa = std::min(lowest_pa, run.source_pressure_pa);
  if (run.exhaust_pressure_pa > 0.0) lowest_pa = std::min(lowest_pa, run.exhaust_pressure_pa);
  return lowest_pa;
}

std::pair<double, double> ExpansionRange(const Run& run, const model::Chamber& chamber) {
  if (!model::Shrinks(chamber)) return {1.0, std::numeric_limits<double>::infinity()};
  const double deepest_pa = std::min(LowestPressure(run), chamber.operating_pressure_pa);
  const double share = (deepest_pa - run.ambient.pressure_pa) /
                       (chamber.operating_pressure_pa - run.ambient.pressure_pa);
  return {std::max(kLeastVolume, 1.0 - (1.0 - kLeastVolume) / share), 1.0};
}

std::pair<double, double> FactorRange(const Dataset& dataset, Declared number) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double ratio = kInfinity, vacuum = kInfinity, lowest_pa = kInfinity, highest_pa = 0.0;
  std::pair<double, double> expansion = {0.0, kInfinity};
  for (const Run& run : dataset.runs) {
    lowest_pa = std::min(lowest_pa, run.ambient.pressure_pa);
    highest_pa = std::max(highest_pa, run.ambient.pressure_pa);
    if (run.source_pressure_pa < run.ambient.pressure_pa)
      vacuum = std::min(
          vacuum, run.ambient.pressure_pa / (run.ambient.pressure_pa - run.source_pressure_pa));
    for (std::size_t i = 0; i < std::max(run.several.all.size(), std::size_t{1}); ++i) {
      if (run.blocked) break;
      const model::Chamber& chamber =
          run.several.empty() ? run.chamber : run.several.all[i].chamber;
      const auto [least, most] = ExpansionRange(run, chamber);
      expansion = {std::max(expansion.first, least / chamber.expansion_ratio),
                   std::min(expansion.second, most / chamber.expansion_ratio)};
    }
    for (const LinePiece& piece : run.line)
      for (const double b : {piece.fill.critical_ratio, piece.exhaust.critical_ratio})
        if (!piece.tube && b > 0.0) ratio = std::min(ratio, b);
  }
  switch (number) {
    case Declared::kExpansionRatio:
      return {std::min(1.0, expansion.first), std::max(1.0, expansion.second)};
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
