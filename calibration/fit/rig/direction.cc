#include "calibration/fit/rig/direction.h"

#include <algorithm>
#include <string_view>

#include "calibration/fit/rig/rig_effects.h"
#include "calibration/fit/rig/run_rig.h"
#include "calibration/values/crossing.h"
#include "calibration/values/measured_place.h"
#include "calibration/values/moved_numbers.h"
#include "model/effects/learned/learned.h"
#include "model/flow/tube.h"

namespace plenum::calibration {
namespace {

using model::FlowElement;

constexpr double kBoreStep = 1e-5;  // relative, of a central difference

// The numbers of the rig that a parameter moves, and how much of each per unit of it.
class Moved {
 public:
  Moved(const Run& run, const ModelState& state, model::Rig& rig)
      : run_(run), state_(state), rig_(rig), group_(rig.groups.front()) {}

  model::Direction operator()(const Parameter& parameter, std::size_t run_index) {
    direction_.clear();
    switch (parameter.kind) {
      case Parameter::Kind::kDeclared:
        if (Concerns(parameter, run_, state_)) OfFactor(parameter);
        for (const MeasuredPlace& place : run_.measured.places)
          std::erase_if(direction_, [&](const model::WeightedNumber& moved) {
            return moved.number == &NumberAt(rig_, place);
          });
        break;
      case Parameter::Kind::kMeasured:
        for (const double* moved : NumbersMovedBy(run_, parameter.number, rig_)) Add(*moved, 1.0);
        break;
      case Parameter::Kind::kEffect:
        for (const double* number :
             NumbersOfEffect(state_.effects, parameter.effect, parameter.number, run_, rig_))
          Add(*number, 1.0);
        break;
      case Parameter::Kind::kInitialPressure:
        for (const model::GroupRig& group : rig_.groups)
          if (parameter.run == run_index) Add(group.initial_pressure_pa, 1.0);
        break;
      case Parameter::Kind::kInitialTemperature:
        for (const model::GroupRig& group : rig_.groups)
          if (parameter.run == run_index) Add(group.initial_temperature_k, 1.0);
        break;
      case Parameter::Kind::kClock:
        if (parameter.run != run_index) break;
        for (const model::ValveCommand& command : group_.schedule) Add(command.time_s, 1.0);
        if (auto* reservoir = std::get_if<model::ReservoirSource>(&rig_.source))
          Add(reservoir->initial_pressure_pa, -PumpingRate(run_));
        break;
      case Parameter::Kind::kPhase:
        if (parameter.run != run_index) break;
        for (model::GroupRig& group : rig_.groups)
          for (model::Effect& effect : group.effects)
            if (double* phase_rad = NumberNamed(effect, model::kPhaseSpec.name))
              Add(*phase_rad, 1.0);
        break;
      case Parameter::Kind::kLateness:
      case Parameter::Kind::kInstant:
        if (parameter.run == run_index) Add(group_.schedule[parameter.number].time_s, 1.0);
        break;
      case Parameter::Kind::kSharedInstant:
        for (std::size_t k = 0; k < run_.valve.size(); ++k)
          if (SharesInstant(run_, k) &&
              static_cast<std::size_t>(run_.valve[k].state) == parameter.number)
            Add(group_.schedule[k].time_s, InstantUncertainty(run_, k));
        break;
    }
    return direction_;
  }

 private:
  void Add(const double& number, double weight) { direction_.push_back({&number, weight}); }

  // Where each chamber has the number for itself that of the parameter's; else of all.
  template <class Each>
  void ForChambers(const Parameter& parameter, const Each& each) {
    const Several& several = run_.several;
    if (several.empty()) return each(group_.chamber, run_.chamber);
    const bool own = OfEachSpecimen(state_, parameter.declared);
    for (std::size_t i = several.first(); i < several.all.size(); ++i)
      if (!own || i == several.first() + parameter.specimen)
        each(rig_.groups[i].chamber, several.all[i].chamber);
  }

  void OfFactor(const Parameter& parameter) {
    const Declared number = parameter.declared;
    switch (number) {
      case Declared::kRestVolume:
        ForChambers(parameter, [&](const model::Chamber& chamber, const model::Chamber& declared) {
          if (chamber.volume_curve.empty()) Add(chamber.rest_volume_m3, declared.rest_volume_m3);
        });
        break;
      case Declared::kExpansionRatio:
        ForChambers(parameter, [&](const model::Chamber& chamber, const model::Chamber& declared) {
          if (chamber.expansion_ratio != 1.0 && chamber.volume_curve.empty())
            Add(chamber.expansion_ratio, declared.expansion_ratio);
        });
        break;
      case Declared::kOperatingPressure:
        ForChambers(parameter, [&](const model::Chamber& chamber, const model::Chamber& declared) {
          Add(chamber.operating_pressure_pa,
              declared.operating_pressure_pa - run_.ambient.pressure_pa);
        });
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
        OfLine(number, run_.line, group_.fill, group_.exhaust, group_.chamber);
        for (const model::Link& link : rig_.links)
          OfLine(number, run_.several.all[link.to].line, link.fill, link.back,
                 rig_.groups[link.to].chamber);
        break;
    }
  }

  // All that was declared as gauge moves with it.
  void OfAmbient() {
    if (!Has(run_, Declared::kAmbientPressure)) return;
    const double ambient_pa = run_.ambient.pressure_pa;
    Add(rig_.ambient.pressure_pa, ambient_pa);
    for (const model::GroupRig& group : rig_.groups)
      for (const double* number :
           {&group.initial_pressure_pa, &group.chamber.operating_pressure_pa})
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

  // Of the run's line, or of that from one chamber to another.
  void OfLine(Declared number, const std::vector<LinePiece>& line,
              const std::vector<FlowElement>& fill, const std::vector<FlowElement>& back,
              const model::Chamber& behind) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const LinePiece piece = &line == &run_.line ? AsCrossed(line[i], run_) : line[i];
      OfPiece(number, piece, fill[i], back[back.size() - 1 - i], behind);
    }
  }

  void OfPiece(Declared number, const LinePiece& piece, const FlowElement& fill,
               const FlowElement& exhaust, const model::Chamber& behind) {
    if (piece.tube) {
      if (number == Declared::kTubeInnerDiameter) OfBore(piece, fill, exhaust, behind);
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

  void OfBore(const LinePiece& piece, const FlowElement& fill, const FlowElement& exhaust,
              const model::Chamber& behind) {
    const double bore_m = BoreOf(piece, state_);
    const double length_m = piece.tube->length_m;
    const double step_m = kBoreStep * bore_m;
    const FlowElement above = model::TubeElement(bore_m + step_m, length_m);
    const FlowElement below = model::TubeElement(bore_m - step_m, length_m);
    const double per_factor = piece.tube->inner_diameter_m / (2.0 * step_m);
    for (const FlowElement* element : {&fill, &exhaust}) {
      Add(element->sonic_conductance_m3_per_s_pa,
          per_factor * (above.sonic_conductance_m3_per_s_pa - below.sonic_conductance_m3_per_s_pa));
      Add(element->critical_ratio, per_factor * (above.critical_ratio - below.critical_ratio));
    }
    Add(behind.dead_volume_m3,
        2.0 * model::BoreVolume(bore_m, length_m) / bore_m * piece.tube->inner_diameter_m);
  }

  const Run& run_;
  const ModelState& state_;
  model::Rig& rig_;
  model::GroupRig& group_;
  model::Direction direction_;
};

}  // namespace

model::Direction DirectionOf(const Parameter& parameter, const Run& run, std::size_t index,
                             const ModelState& state, model::Rig& rig) {
  return Moved(run, state, rig)(parameter, index);
}

}  // namespace plenum::calibration
