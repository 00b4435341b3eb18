#include "optimizer/problem.h"

namespace plenum::optimizer {

const char* Name(Configuration configuration) {
  switch (configuration) {
    case Configuration::kCylinder:
      return "cylinder";
    case Configuration::kCo2:
      return "co2";
    case Configuration::kCompressor:
      return "compressor";
    case Configuration::kMains:
      return "mains";
  }
  return "";
}

const char* Name(Status status) {
  switch (status) {
    case Status::kOptimal:
      return "optimal";
    case Status::kFeasible:
      return "feasible";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kCancelled:
      return "cancelled";
  }
  return "";
}

}  // namespace plenum::optimizer
