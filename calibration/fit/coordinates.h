// The coordinates in which a fit searches: each number of a model state as a smooth function of one
// coordinate u with bounds.
//
// An effect's size is linear in u with its absence on a bound, so that a fit that wants none of it
// arrives there in a few steps; times and volumes that only make sense above zero are exp(u); a
// conductance in series, which vanishes as it grows, is C = S·u^(−1/2), so that u is its resistance
// in the square law of series. A declared number of known uncertainty s is 1 + s·u, which makes its
// prior a unit normal; one of unknown size is exp(u), as is a measured conductance or volume.
#ifndef PLENUM_CALIBRATION_FIT_COORDINATES_H_
#define PLENUM_CALIBRATION_FIT_COORDINATES_H_

#include <limits>
#include <string>
#include <vector>

#include "calibration/fit/forward.h"

namespace plenum::calibration {

struct Coordinate {
  enum class Kind { kLinear, kLog, kSeries };
  Parameter parameter;
  Kind kind = Kind::kLinear;
  double origin = 0.0, scale = 1.0;  // linear: origin + scale·u; log: scale·e^u; series: S = scale
  double low = 0.0, high = 0.0;      // bounds of u
  bool prior = false;                // u is standard normal before any data
  // Between these a number tells its effect from instants that are off by a sample, and a decay
  // from what goes on for ever.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  double Number(double u) const;
  double Slope(double u) const;  // d number / du
  double At(double number) const;
  // Whether u lies at an end of what is searched: the readings do not fix the number.
  bool AtEnd(double u) const;
};

// What sizes and times are typical of a data set: effects start and scale by them.
struct TypicalSizes {
  double duration_s = 1.0;                // the longest run
  double interval_s = 1e-2;               // mean, of the sampling
  double stroke_s = 1.0;                  // V(p_op)/(C·P0) of the narrowest declared pair
  double gauge_pa = 1e5;                  // operating pressure
  double volume_m3 = 50e-6;               // at rest
  double conductance_m3_per_s_pa = 1e-9;  // of the narrowest pair
};
TypicalSizes SizesOf(const Dataset& dataset);
// With what was fitted of declared numbers of unknown uncertainty.
TypicalSizes SizesOf(const Dataset& dataset, const ModelState& fitted);

// The declared numbers that may move, and the initial pressures that are not known better than by a
// reading: of the runs given. A declared number that no such run has is left out; one that each
// specimen has stands for each specimen of these runs; one that is freed
// has no prior, and the scale of its uncertainty or, declared exact, kExactUncertainty. With
// `clocks`, each run's clock too: commands fall between samples, so that the prior is that of a
// time rounded to the sampling, 1/√12 of the interval. It makes a stroke early by no more than the
// time from the run's start to the first, and is fixed where a run begins with one: few readings
// have their first stroke within a sample of the start.
std::vector<Coordinate> BaseCoordinates(const ForwardModel& forward,
                                        const std::vector<std::size_t>& runs, bool clocks,
                                        const Freed& freed = {});

// The measured numbers of the runs given: without a prior, whatever is declared (measured.cc).
std::vector<Coordinate> MeasuredCoordinates(const Dataset& dataset,
                                            const std::vector<std::size_t>& runs);

// The initial temperatures, of those of the runs given whose gas may have come from a stroke just
// before: it began off the ambient pressure by a reading, and no temperature is declared. The prior
// is the ambient's within kInitialTemperatureK. They matter with an energy balance alone.
inline constexpr double kInitialTemperatureK = 10.0;
std::vector<Coordinate> TemperatureCoordinates(const ForwardModel& forward,
                                               const std::vector<std::size_t>& runs);

// What the effects leave to each of the runs given: the phase of what swings and the lateness of
// strokes. A stroke comes late by less than the time to the next command.
std::vector<Coordinate> RunCoordinates(const ForwardModel& forward,
                                       const std::vector<std::size_t>& runs,
                                       const std::vector<model::Effect>& effects,
                                       const TypicalSizes& sizes);

// The parameters of effect number `effect` of a state, without those that each run has of its own.
std::vector<Coordinate> EffectCoordinates(const model::EffectSpec& spec, std::size_t effect,
                                          const TypicalSizes& sizes);

// Values from which a fit of the effect starts, the likeliest first: modest ones, apart in the
// times that may have several optima.
std::vector<model::Effect> EffectStarts(const model::EffectSpec& spec, const TypicalSizes& sizes);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_COORDINATES_H_
