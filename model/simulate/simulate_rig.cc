#include "model/simulate/simulate_rig.h"

#include <algorithm>

#include "model/flow/dense_gas.h"

namespace plenum::model {

std::vector<ValveCommand> CycleSchedule(double frequency_hz, double inflate_fraction, int cycles,
                                        double phase) {
  std::vector<ValveCommand> schedule;
  for (int i = 0; i < cycles; ++i) {
    const double start = i + phase;
    schedule.push_back({start / frequency_hz, ValveState::kInflate});
    schedule.push_back({(start + inflate_fraction) / frequency_hz, ValveState::kDeflate});
  }
  return schedule;
}

bool IsDense(const Rig& rig) {
  double highest_pa = 0.0;
  if (const auto* source = std::get_if<RegulatedSource>(&rig.source))
    highest_pa = source->pressure_pa;
  if (const auto* source = std::get_if<ReservoirSource>(&rig.source))
    highest_pa = source->initial_pressure_pa;
  bool evacuated = false;
  for (const GroupRig& group : rig.groups) {
    highest_pa = std::max(highest_pa, group.initial_pressure_pa);
    evacuated = evacuated || group.chamber.evacuated;
  }
  return highest_pa >= kDenseFromPa && !evacuated;
}

bool MovesSmoothly(const Rig& rig, bool driven) {
  const auto any = [&](const TimeCourse Told::*course) {
    return std::any_of(rig.groups.begin(), rig.groups.end(),
                       [&](const GroupRig& group) { return !(group.told.*course).empty(); });
  };
  return (driven || any(&Told::opening)) && !any(&Told::volume_m3);
}

}  // namespace plenum::model
