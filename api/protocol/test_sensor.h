// The sensor and the bottle that a test of a part is made with.
#ifndef PLENUM_API_PROTOCOL_TEST_SENSOR_H_
#define PLENUM_API_PROTOCOL_TEST_SENSOR_H_

#include <map>
#include <optional>
#include <string>

#include "api/json/json.h"
#include "api/json/range.h"
#include "catalog/fields/part.h"

namespace plenum::api {

struct TestSensor {
  double noise_kpa = 0.2;  // one standard deviation of a reading
  double resolution_kpa = 0.1;
  double sampling_hz = 100.0;
  std::optional<double> bottle_l = {};
  std::optional<double> bottle_uncertainty = {};  // relative; none: not weighed, assumed
};

inline Range SensorKpaRange() { return {0, 100}; }
inline Range SamplingRange() { return {1, 1e5}; }
inline Range BottleRange() { return {0.01, 1000}; }
inline Range BottleUncertaintyRange() { return {1e-4, 0.25}; }

// Query parameters of a protocol: sensor_noise_kpa, sensor_resolution_kpa, sampling_hz, bottle_l,
// bottle_uncertainty.
Parsed<TestSensor> ParseTestSensor(const std::multimap<std::string, std::string>& query);

// 0 where the part does not have it.
double NumberOf(const catalog::Part& part, const char* field);

// One standard deviation of a reading, Pa: noise and rounding together, at least what a diagnosis
// takes for the least noise of a sensor whose largest pressure is `gauge_pa`.
double ReadingNoisePa(const TestSensor& sensor, double gauge_pa);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_TEST_SENSOR_H_
