#include "model/simulate/simulate_rig.h"

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

}  // namespace plenum::model
