// A test of a part in a hidden world, from its protocol to the revision of the part.
#ifndef PLENUM_BENCH_LOOP_TESTING_H_
#define PLENUM_BENCH_LOOP_TESTING_H_

#include <string>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "tests/support/random.h"

namespace plenum::bench {

struct TestName {
  std::string part, protocol;
  auto operator<=>(const TestName&) const = default;
};

struct Tested {
  catalog::Part part;  // as the engineer knows it afterwards
  // { "part", "protocol", "verdict", "refused": [ reasons ], "contradicted", "seconds",
  //   "numbers": [ { "field", "pressure_kpa_gauge", "truth", "before", "fitted", "uncertainty",
  //   "interval_95", "saved" } ] }; the numbers are those of the diagnosis.
  api::Json told;
};

// Records a bottle test, diagnoses it and writes its numbers as `--save-part` does, with
// `--save-part-anyway` where they contradict what stood there. What a protocol reads by hand is
// typed into the part with the uncertainty that the protocol states, and off by that.
Tested TestPart(const catalog::Part& known, const catalog::Part& truth, const std::string& protocol,
                test::Random& random);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_LOOP_TESTING_H_
