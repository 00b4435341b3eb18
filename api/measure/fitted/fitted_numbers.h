// Declared numbers that a diagnosis fitted, or found wrong, in the contract's units. A fitted
// number is the declared one of the first run that has it, times its factor; pressures among them
// are gauge. Of a number that each specimen has, the run is one of that specimen.
#ifndef PLENUM_API_MEASURE_FITTED_FITTED_NUMBERS_H_
#define PLENUM_API_MEASURE_FITTED_FITTED_NUMBERS_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

// A declared number: where it is zero and one unit of it in SI.
struct DeclaredNumber {
  double value = 0.0;  // SI, counted from the zero: gauge pressures
  double factor = 1.0;
  const char* unit = "1";
  double origin = 0.0;  // of the factor: where the number is 0
  double in_unit() const { return value / factor; }
};

// None where no run, or none of that specimen, has it.
std::optional<DeclaredNumber> DeclaredIn(const calibration::Dataset& dataset,
                                         calibration::Declared number,
                                         std::optional<std::size_t> specimen = {});

// A value with its interval, in units of `factor`.
Json RenderEstimate(const calibration::Estimate& estimate, double factor);

// By name; of a number that each specimen has that of the first specimen fitted, and which it is.
Json RenderFitted(const std::vector<calibration::FittedFactor>& factors,
                  const calibration::Dataset& dataset);

// One of them, alone.
Json RenderFactor(const calibration::FittedFactor& fitted, const DeclaredNumber& declared);

Json RenderWrong(const calibration::WrongNumber& wrong, const calibration::Dataset& dataset);

// A specimen's name, null of the common piece.
Json SpecimenName(const std::string& name);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_FITTED_FITTED_NUMBERS_H_
