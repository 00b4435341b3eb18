// A measurement document as its dataset; each error of it is a failure.
#ifndef PLENUM_TESTS_API_MEASURE_READ_DATASET_H_
#define PLENUM_TESTS_API_MEASURE_READ_DATASET_H_

#include <gtest/gtest.h>

#include "api/measure/measurement.h"

namespace plenum::api {

inline calibration::Dataset Read(const Json& document) {
  const auto parsed = ParseMeasurement(document);
  if (const auto* errors = std::get_if<Errors>(&parsed)) {
    for (const Error& error : *errors) ADD_FAILURE() << error.pointer << ": " << error.detail;
    return {};
  }
  return std::get<calibration::Dataset>(parsed);
}

}  // namespace plenum::api

#endif  // PLENUM_TESTS_API_MEASURE_READ_DATASET_H_
