#include "bench/batch/simulate_batch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

#include "bench/batch/simulate_lanes.h"
#include "model/simulate/simulate_validate.h"

namespace plenum::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTooCloseToCall = 1e-6;
constexpr std::size_t kLaneStepsMax = 1000;
constexpr std::size_t kRigsAtOnce = 1024;

bool Positive(double value) { return value > 0.0 && value < kInfinity; }
bool NotNegative(double value) { return value >= 0.0 && value < kInfinity; }

bool LaneTakes(const std::vector<model::FlowElement>& line, double linear_ratio) {
  if (line.empty()) return true;
  const model::FlowElement& element = line[0];
  return line.size() == 1 && Positive(element.sonic_conductance_m3_per_s_pa) &&
         element.critical_ratio >= 0.0 && element.critical_ratio < linear_ratio &&
         element.subsonic_index == 0.5 && element.cracking_pressure_pa == 0.0;
}

bool LaneTakes(const model::Chamber& chamber, double ambient_pa) {
  return chamber.volume_curve.empty() && Positive(chamber.rest_volume_m3) &&
         chamber.expansion_ratio >= 1.0 && chamber.expansion_ratio < kInfinity &&
         chamber.operating_pressure_pa > ambient_pa && chamber.operating_pressure_pa < kInfinity &&
         chamber.ambient_pressure_pa == ambient_pa && NotNegative(chamber.dead_volume_m3);
}

bool LaneTakes(const model::NoSource&) { return true; }
bool LaneTakes(const model::RegulatedSource& source) {
  return Positive(source.pressure_pa) && !source.regulator && source.flow_max_m3_per_s == kInfinity;
}
bool LaneTakes(const model::ReservoirSource& source) {
  return Positive(source.volume_m3) && NotNegative(source.volume_rising_m3) &&
         Positive(source.initial_pressure_pa) && source.compressor.free_air_m3_per_s.empty();
}

bool LaneTakes(const model::DrivenSource&) { return false; }

// Only rigs that FullStrokes would find valid.
bool LaneTakes(const model::Rig& rig, double linear_ratio) {
  if (rig.groups.size() != 1) return false;
  const model::GroupRig& group = rig.groups[0];
  return Positive(rig.ambient.pressure_pa) && Positive(rig.ambient.temperature_k) &&
         group.count >= 1 && group.effects.empty() && NotNegative(group.initial_temperature_k) &&
         LaneTakes(group.fill, linear_ratio) && LaneTakes(group.exhaust, linear_ratio) &&
         LaneTakes(group.chamber, rig.ambient.pressure_pa) &&
         std::visit([](const auto& source) { return LaneTakes(source); }, rig.source);
}

// All legs of one formula, and the stroke that each belongs to.
struct LegList {
  std::vector<Leg> legs;
  std::vector<std::size_t> stroke;
};

enum class Reach { kReached, kNever, kTooClose };

Reach ReachOf(double target_pa, double final_pa, bool rise) {
  if (std::abs(final_pa - target_pa) <= kTooCloseToCall * target_pa) return Reach::kTooClose;
  return (target_pa < final_pa) == rise ? Reach::kReached : Reach::kNever;
}

class Batch {
 public:
  Batch(const model::SimulateOptions& options, Instructions instructions)
      : options_(options), instructions_(instructions) {}

  void Run(std::span<const model::Rig> rigs, std::span<model::FullStroke> strokes) {
    scalar_.assign(rigs.size(), false);
    seconds_.assign(2 * rigs.size(), 0.0);
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      scalar_[i] = !LaneTakes(rigs[i], options_.linear_ratio) || !AddRise(rigs[i], 2 * i) ||
                   !AddFall(rigs[i], 2 * i + 1);
    }
    for (const LegStroke stroke :
         {LegStroke::kRise, LegStroke::kRiseFromReservoir, LegStroke::kFall}) {
      for (const LegFlow flow : {LegFlow::kChoked, LegFlow::kSubsonic, LegFlow::kLinear}) {
        AddTimes(stroke, flow);
      }
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      const double rise_s = seconds_[2 * i], fall_s = seconds_[2 * i + 1];
      if (scalar_[i] || std::isnan(rise_s + fall_s)) {
        const std::vector<model::FullStroke> own = model::FullStrokes(rigs[i], options_);
        std::copy(own.begin(), own.end(), strokes.begin() + static_cast<std::ptrdiff_t>(at));
      } else {
        strokes[at] = {rise_s, fall_s, 1.0 / (rise_s + fall_s)};
      }
      at += rigs[i].groups.size();
    }
  }

 private:
  LegList& List(LegStroke stroke, LegFlow flow) {
    return lists_[3 * static_cast<std::size_t>(stroke) + static_cast<std::size_t>(flow)];
  }

  // What all legs of a stroke share.
  static Leg LegOf(const model::Rig& rig, const model::FlowElement& element) {
    const model::GroupRig& group = rig.groups[0];
    const model::Chamber& chamber = group.chamber;
    const double heat = rig.ambient.temperature_k / model::kReferenceTemperatureK;
    Leg leg{};
    // P0·(T/T0)·C·√(T0/T)
    leg.conductance_pa_m3_per_s_pa = model::kReferencePressurePa * std::sqrt(heat) *
                                     model::FlowFactor(rig.gas) *
                                     element.sonic_conductance_m3_per_s_pa;
    leg.critical_ratio = element.critical_ratio;
    const double growth = group.blocked ? 0.0 : chamber.expansion_ratio - 1.0;
    leg.volume_slope_m3_per_pa = chamber.rest_volume_m3 * growth /
                                 (chamber.operating_pressure_pa - chamber.ambient_pressure_pa);
    leg.volume_at_zero_m3 = chamber.dead_volume_m3 + chamber.rest_volume_m3 -
                            leg.volume_slope_m3_per_pa * chamber.ambient_pressure_pa;
    return leg;
  }

  double Target(const model::Rig& rig, double fraction) const {
    const double ambient_pa = rig.ambient.pressure_pa;
    return ambient_pa + fraction * (rig.groups[0].chamber.operating_pressure_pa - ambient_pa);
  }

  // Legs from `stroke` through the pressures where flow stops choking and where its straight line
  // begins.
  void AddLegs(LegStroke kind, Leg stroke, double to_pa, double subsonic_pa, double linear_pa,
               std::size_t index) {
    const bool rise = kind != LegStroke::kFall;
    const double width = 1.0 - stroke.critical_ratio;
    const double share = (1.0 - options_.linear_ratio) / width;
    const std::array<double, 3> ends = {subsonic_pa, linear_pa, to_pa};
    double from_pa = stroke.start_pa;
    for (std::size_t f = 0; f < ends.size(); ++f) {
      const double end_pa = rise ? std::min(ends[f], to_pa) : std::max(ends[f], to_pa);
      if (!(rise ? from_pa < end_pa : from_pa > end_pa)) continue;
      const LegFlow flow = static_cast<LegFlow>(f);
      Leg leg = stroke;
      leg.from_pa = from_pa;
      leg.to_pa = end_pa;
      if (flow == LegFlow::kLinear) {
        leg.conductance_pa_m3_per_s_pa *=
            std::sqrt(share * (2.0 - share)) / (1.0 - options_.linear_ratio);
      }
      LegList& list = List(kind, flow);
      list.legs.push_back(leg);
      list.stroke.push_back(index);
      from_pa = end_pa;
    }
  }

  // False: not for the lanes.
  bool AddRise(const model::Rig& rig, std::size_t index) {
    const model::GroupRig& group = rig.groups[0];
    const auto* regulated = std::get_if<model::RegulatedSource>(&rig.source);
    const auto* reservoir = std::get_if<model::ReservoirSource>(&rig.source);
    seconds_[index] = kInfinity;
    if (group.fill.empty() || !(regulated || reservoir)) return true;
    Leg leg = LegOf(rig, group.fill[0]);
    leg.outer_pa = regulated ? regulated->pressure_pa : reservoir->initial_pressure_pa;
    leg.per_reservoir_m3 = regulated ? 0.0 : group.count / reservoir->volume_m3;
    leg.start_pa = rig.ambient.pressure_pa;
    const double to_pa = Target(rig, options_.rise_fraction);
    if (!(to_pa > leg.start_pa)) return false;

    // p = r·p_s with p_s = mass − (n/V_R)·p·(V(0) + V'·p).
    const double mass_pa =
        leg.outer_pa + leg.per_reservoir_m3 * leg.start_pa *
                           (leg.volume_at_zero_m3 + leg.volume_slope_m3_per_pa * leg.start_pa);
    const auto pressure_at = [&](double ratio) {
      const double share = ratio * leg.per_reservoir_m3;
      const double linear = 1.0 + share * leg.volume_at_zero_m3;
      const double bend = share * leg.volume_slope_m3_per_pa * ratio * mass_pa;
      return 2.0 * ratio * mass_pa / (linear + std::sqrt(linear * linear + 4.0 * bend));
    };
    switch (ReachOf(to_pa, pressure_at(1.0), true)) {
      case Reach::kNever:
        return true;
      case Reach::kTooClose:
        return false;
      case Reach::kReached:
        break;
    }
    seconds_[index] = 0.0;
    AddLegs(regulated ? LegStroke::kRise : LegStroke::kRiseFromReservoir, leg, to_pa,
            pressure_at(leg.critical_ratio), pressure_at(options_.linear_ratio), index);
    return true;
  }

  bool AddFall(const model::Rig& rig, std::size_t index) {
    const model::GroupRig& group = rig.groups[0];
    seconds_[index] = kInfinity;
    if (group.exhaust.empty()) return true;
    Leg leg = LegOf(rig, group.exhaust[0]);
    leg.outer_pa = rig.ambient.pressure_pa;
    leg.start_pa = group.chamber.operating_pressure_pa;
    const double to_pa = Target(rig, options_.fall_fraction);
    if (!(to_pa < leg.start_pa) || ReachOf(to_pa, leg.outer_pa, false) != Reach::kReached) {
      return false;
    }
    seconds_[index] = 0.0;
    AddLegs(LegStroke::kFall, leg, to_pa, leg.outer_pa / leg.critical_ratio,
            leg.outer_pa / options_.linear_ratio, index);
    return true;
  }

  void AddTimes(LegStroke stroke, LegFlow flow) {
    LegList& list = List(stroke, flow);
    times_.resize(list.legs.size());
    LegTimes(stroke, flow, list.legs,
             {options_.relative_tolerance, options_.absolute_tolerance_pa,
              std::min(options_.steps_max, kLaneStepsMax)},
             times_, instructions_);
    for (std::size_t i = 0; i < times_.size(); ++i) {
      double& seconds = seconds_[list.stroke[i]];
      seconds += times_[i];
      if (seconds > model::kFullStrokeHorizonS) seconds = kInfinity;
    }
    list.legs.clear();
    list.stroke.clear();
  }

  const model::SimulateOptions& options_;
  Instructions instructions_;
  std::array<LegList, 9> lists_;
  std::vector<double> times_, seconds_;  // of legs; of the rise and the fall of each rig
  std::vector<bool> scalar_;
};

std::size_t GroupsOf(std::span<const model::Rig> rigs) {
  std::size_t groups = 0;
  for (const model::Rig& rig : rigs) groups += rig.groups.size();
  return groups;
}

struct Piece {
  std::span<const model::Rig> rigs;
  std::span<model::FullStroke> strokes;
};

}  // namespace

void FullStrokesOfMany(std::span<const model::Rig> rigs, const model::SimulateOptions& options,
                       std::span<model::FullStroke> strokes, int threads,
                       Instructions instructions) {
  assert(strokes.size() == GroupsOf(rigs));
  model::SimulateOptions checked = options;
  checked.end_s = checked.sample_hz = 0.0;
  const bool valid = model::WhyInvalid(checked).empty();
  std::fill(strokes.begin(), strokes.end(),
            model::FullStroke{
                kInfinity, kInfinity, 0.0,
                valid ? model::SimulateStatus::kCancelled : model::SimulateStatus::kInvalid});
  if (!valid) return;

  // Every thread takes the next piece of the list until none is left.
  std::vector<Piece> pieces;
  for (std::size_t at = 0; at < rigs.size(); at += kRigsAtOnce) {
    const auto some = rigs.subspan(at, std::min(rigs.size() - at, kRigsAtOnce));
    const std::size_t groups = GroupsOf(some);
    pieces.push_back({some, strokes.first(groups)});
    strokes = strokes.subspan(groups);
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    Batch batch(options, instructions);
    for (std::size_t i = next++; i < pieces.size(); i = next++) {
      if (options.cancelled && options.cancelled()) return;
      batch.Run(pieces[i].rigs, pieces[i].strokes);
    }
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
}

}  // namespace plenum::bench
