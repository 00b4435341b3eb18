// What to do for a test of a part, in words, and how precise what is read by hand will be.
#ifndef PLENUM_API_PROTOCOL_TEST_STEPS_H_
#define PLENUM_API_PROTOCOL_TEST_STEPS_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/protocol/test_sensor.h"
#include "catalog/fields/part.h"

namespace plenum::api {

std::vector<std::string> StepsOf(std::string_view protocol, std::string_view family);

// A number that is read from an instrument or computed from two readings.
struct ReadNumber {
  std::string field;
  double uncertainty = 0.0;  // relative, one standard deviation
  std::string how;
};
std::vector<ReadNumber> ReadByHand(std::string_view protocol, const catalog::Part& part,
                                   const TestSensor& sensor);

// The mass of a part, `field` mass_kg or mass_kg_per_m, which a scale tells.
std::vector<std::string> WeighingSteps(const catalog::Part& part, const std::string& field);
std::vector<ReadNumber> WeighingOf(const catalog::Part& part, const std::string& field);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_TEST_STEPS_H_
