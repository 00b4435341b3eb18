// Sizing of one candidate with a made-to-measure reservoir by dense scans over volumes and, within
// each, over source pressures, refined by bisection and golden sections. Shares the evaluation of a
// pair of settings with the search and nothing of its bounds or solvers.
#ifndef PLENUM_TESTS_SUPPORT_SCAN_SIZING_H_
#define PLENUM_TESTS_SUPPORT_SCAN_SIZING_H_

#include "optimizer/evaluate/candidate.h"

namespace plenum::test {

struct Scanned {
  bool feasible = false;
  bool failed = false;  // an evaluation failed: nothing is known
  double objective = optimizer::kUnlimited;
  optimizer::OperatingPoint point;
};
Scanned ScanMadeReservoir(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_SCAN_SIZING_H_
