// The numbers of a model of a data set's runs (fit/forward.h), one of them, and a model as an
// answer states it.
#ifndef PLENUM_CALIBRATION_VALUES_MODEL_STATE_H_
#define PLENUM_CALIBRATION_VALUES_MODEL_STATE_H_

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/placed_leaks.h"
#include "model/effects/effect.h"

namespace plenum::calibration {

using Factors = std::array<double, kDeclaredCount>;  // by Declared

// Which declared numbers a fit moves as far as the readings ask, without a prior: by Declared, of
// all specimens; of several chambers by chamber.
struct Freed {
  std::array<bool, kDeclaredCount> number{};
  std::array<std::array<bool, kChambersMax>, kOfActuator> of_chamber{};

  bool& operator[](std::size_t k) { return number[k]; }
  bool operator[](std::size_t k) const { return number[k]; }
  bool Holds(std::size_t k, std::size_t specimen) const {
    return number[k] || (k < kOfActuator && specimen < kChambersMax && of_chamber[k][specimen]);
  }
  bool operator==(const Freed&) const = default;
};

// The relative uncertainty by which a number that is declared exact counts its deviation.
inline constexpr double kExactUncertainty = 0.01;

struct ModelState {
  ModelState() { factor.fill(1.0); }

  Factors factor;
  // Of the actuator's own numbers a factor by specimen, in place of that in `factor`, where the
  // data set has several specimens and the number is uncertain; else empty.
  std::array<std::vector<double>, kOfActuator> specimen_factor;
  Freed freed{};
  std::vector<model::Effect> effects;
  std::vector<double> measured;               // SI, by Dataset::measured
  std::vector<double> initial_pressure_pa;    // absolute, by run of the data set
  std::vector<double> initial_temperature_k;  // by run; matters with an energy balance alone
  std::vector<double> clock_s;                // by run
  std::vector<double> phase_rad;              // by run
  // By run and command; empty: none is late but by what the effect itself says.
  std::vector<std::vector<double>> late_s;
  // By run and command, by how much its instant is after the recorded one; empty: by nothing.
  std::vector<std::vector<double>> moved_s;
  // By state of the valve, by how many of its uncertainties each command to it is after that, too
  // (SharesInstant of dataset.h).
  std::array<double, model::kValveStates> shared_sigmas{};
};

// One number of a model state.
struct Parameter {
  enum class Kind {
    kDeclared,
    kMeasured,
    kEffect,
    kInitialPressure,
    kInitialTemperature,
    kClock,
    kPhase,
    kLateness,
    kInstant,
    kSharedInstant
  };
  Kind kind = Kind::kDeclared;
  Declared declared = Declared::kRestVolume;  // kDeclared
  std::size_t effect = 0, number = 0;  // kEffect: of the list, of its parameters; kMeasured: of
                                       // Dataset::measured; kLateness, kInstant: of the run's
                                       // commands; kSharedInstant: of the valve's states
  std::size_t run = 0;                 // of one run's own number
  std::size_t specimen = 0;            // kDeclared: of a number that each specimen has
  bool operator==(const Parameter&) const = default;
};
double& NumberOf(ModelState& state, const Parameter& parameter);
double NumberOf(const ModelState& state, const Parameter& parameter);

// Whether each specimen has a factor of its own on that number.
bool OfEachSpecimen(const ModelState& state, Declared number);

// The factors with which a run is simulated.
Factors FactorsOf(const Run& run, const ModelState& state);
// Of several chambers those of one.
Factors FactorsOf(const Run& run, const ModelState& state, std::size_t specimen);

// Whether a parameter on a declared number moves anything in the run.
bool Concerns(const Parameter& parameter, const Run& run, const ModelState& state);

inline bool SameFactors(const ModelState& a, const ModelState& b) {
  return a.factor == b.factor && a.specimen_factor == b.specimen_factor;
}

// One factor for all runs and specimens.
void SetFactor(Declared number, double factor, ModelState& state);

// By how much a command of run `index` comes after the recorded instant, its clock aside.
double MovedBy(const Run& run, std::size_t index, std::size_t command, const ModelState& state);

// By how much the run's ambient pressure is above the declared one.
double AmbientShift(const Run& run, const ModelState& state);

// Gives a state the numbers of one run's own as another has them.
void CopyRun(const ModelState& from, std::size_t run, ModelState& to);

// Every number that a model's curves follow from. What a run that no fit saw has of its own was
// fitted to that run alone; where its line is of no other run, so were the factors on its pairs
// (C, b), and `run_factor` differs from the state's. So it does where runs are of several
// specimens: the state's factors on the actuator's own numbers are those of a piece that was not
// fitted.
struct StatedModel {
  ModelState state;
  std::vector<Factors> run_factor;                     // by run
  std::vector<std::vector<std::string>> fitted_alone;  // by run: "initial pressure of r5"
  bool several = false;  // each run has all specimens, chambers: their factors are the state's
};

// The model as the run has it.
inline ModelState OfRun(const StatedModel& model, std::size_t run) {
  ModelState state = model.state;
  state.factor = model.run_factor[run];
  if (!model.several) state.specimen_factor = {};
  return state;
}

// How errors on a run were got: simulated to this tolerance, at all readings but those left out.
struct StatedRun {
  double relative_tolerance = 0.0;
  std::vector<std::size_t> left_out;   // not missing, but wild or at an end of the sensor's range
  std::optional<std::size_t> copy_of;  // an earlier run with the same readings, which alone counts
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_MODEL_STATE_H_
