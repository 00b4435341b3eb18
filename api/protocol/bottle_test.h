// The test of a part with a bottle of known volume and one pressure sensor, as the measurement that
// its recording will be.
#ifndef PLENUM_API_PROTOCOL_BOTTLE_TEST_H_
#define PLENUM_API_PROTOCOL_BOTTLE_TEST_H_

#include <optional>
#include <vector>

#include "api/json/json.h"
#include "api/protocol/test_sensor.h"
#include "catalog/fields/part.h"
#include "model/effects/effect.h"

namespace plenum::api {

struct BottleTest {
  Json measurement;                               // measurement/1 whose runs have no readings yet
  std::vector<double> t_s;                        // sample times of each run
  double bottle_l = 0.0, source_kpa_gauge = 0.0;  // source: 0 for a pump, which is its own
  double sampling_hz = 0.0;                       // at most the sensor's
  int repeats = 0;
  std::vector<model::Effect> effects;  // of a bare bottle: heat of its wall
  double check_bottle_l = 0.0;         // another bottle, of which the volume is checked by
  Json check_run;                      // one run with it
};

// The measurement as the template of a recording: with the run of the other bottle, and the time
// that its diagnosis may take.
Json TemplateOf(const BottleTest& test);

// Of a valve, fitting, regulator or compressor. The bottle is the smallest usual one in which a
// stroke lasts kStrokeLeastS and kStrokeSamples samples, unless the sensor's `bottle_l` says one.
inline constexpr double kStrokeLeastS = 1.0;
inline constexpr double kStrokeSamples = 100.0;
std::optional<BottleTest> MakeBottleTest(const catalog::Part& part, const TestSensor& sensor);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_BOTTLE_TEST_H_
