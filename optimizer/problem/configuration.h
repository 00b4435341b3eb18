// Where the air comes from.
#ifndef PLENUM_OPTIMIZER_PROBLEM_CONFIGURATION_H_
#define PLENUM_OPTIMIZER_PROBLEM_CONFIGURATION_H_

#include <optional>

namespace plenum::optimizer {

// kDirectPump: pumps without a reservoir that fill one group after another (candidate.h).
// kVacuumPump, kDirectVacuumPump: the same two of evacuated actuators (Evacuated() below).
// kTankAndPump: a tank filled beforehand that a pump goes on filling (evaluate/refill.h).
// kEjector, kDirectEjector: as vacuum pumps, driven by compressed air from the wall (pump_feed.h).
enum class Configuration {
  kCylinder,
  kCo2,
  kCompressor,
  kMains,
  kTank,
  kDirectPump,
  kVacuumPump,
  kDirectVacuumPump,
  kTankAndPump,
  kEjector,
  kDirectEjector
};
inline constexpr int kConfigurations = 11;
// Of actuators under pressure, in the order in which people are told of them.
inline constexpr Configuration kPressureConfigurations[] = {
    Configuration::kCylinder,  Configuration::kCo2,  Configuration::kCompressor,
    Configuration::kMains,     Configuration::kTank, Configuration::kTankAndPump,
    Configuration::kDirectPump};
// As requests name them: "cylinder", "co2", …, "tank_and_pump".
const char* Name(Configuration configuration);
// Whether pumps keep a reservoir at its pressure, feed the lines themselves, or do either; and
// whether there is a tank filled beforehand, and any pump.
inline bool KeepsReservoir(Configuration configuration) {
  return configuration == Configuration::kCompressor ||
         configuration == Configuration::kVacuumPump || configuration == Configuration::kEjector;
}
inline bool IsDirect(Configuration configuration) {
  return configuration == Configuration::kDirectPump ||
         configuration == Configuration::kDirectVacuumPump ||
         configuration == Configuration::kDirectEjector;
}
inline bool IsPumped(Configuration configuration) {
  return KeepsReservoir(configuration) || IsDirect(configuration);
}
inline bool HasTank(Configuration configuration) {
  return configuration == Configuration::kTank || configuration == Configuration::kTankAndPump;
}
inline bool HasPump(Configuration configuration) {
  return IsPumped(configuration) || configuration == Configuration::kTankAndPump;
}
// Pumps without a motor.
inline bool IsEjector(Configuration configuration) {
  return configuration == Configuration::kEjector || configuration == Configuration::kDirectEjector;
}
inline bool IsVacuum(Configuration configuration) {
  return configuration == Configuration::kVacuumPump ||
         configuration == Configuration::kDirectVacuumPump || IsEjector(configuration);
}

// How pumps keep a rail of vacuum beside a pressure supply (evaluate/pumped_rail.h). Absolute.
struct RailSettings {
  double pressure_pa = 0.0;  // the weakest that it comes to, which lines are judged with
  double stop_pa = 0.0;      // at which its pumps stop
  double duty = 0.0;         // of each pump
  double volume_m3 = 0.0;    // of its reservoirs
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_CONFIGURATION_H_
