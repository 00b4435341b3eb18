// What plenum computes, from request to answer, both JSON text. `catalogue` is the path of one. All
// throw Refused, and catalog::StoreError where the catalogue cannot be read. module.cc: their names
// for Python.
#ifndef PLENUM_PYTHON_CORE_COMPUTATIONS_H_
#define PLENUM_PYTHON_CORE_COMPUTATIONS_H_

#include <string>
#include <vector>

#include "python/core/interruptible.h"

namespace plenum::python {

std::string Design(const std::string& requirements, const std::string& catalogue, Watch& watch);
// sweep/1 to sweep_table/1; progress is { "done", "of" }, of its patches.
std::string Sweep(const std::string& sweep, const std::string& catalogue, Watch& watch);
std::string Evaluate(const std::string& request, const std::string& catalogue);
// Opens the catalogue only if the request names parts.
std::string Simulate(const std::string& request, const std::string& catalogue);
std::string Map(const std::string& request);

// Each request on `threads` threads, its series as arrays (api/simulate/simulation.h); a request
// that is refused gives its errors as { "errors": [{ "pointer", "detail" }] } in its place.
// Cancelled: those not begun are empty.
struct TextWithArrays {
  std::string text;
  std::vector<std::vector<double>> arrays;
};
std::vector<TextWithArrays> SimulateMany(const std::vector<std::string>& requests,
                                         const std::string& catalogue, int threads, Watch& watch);

struct DiagnosisWish {
  std::string model;  // predicts with this saved model, without a fit; empty: none
  double time_limit_s = 0.0;
  std::vector<std::pair<std::string, std::string>> files;  // name and text, for the provenance
};
// `measurements` are documents measurement/1 of one rig.
std::string Diagnose(const std::vector<std::string>& measurements, const DiagnosisWish& wish,
                     const std::string& catalogue, Watch& watch);
// CSV and its rig file as a document.
std::string MeasurementFromCsv(const std::string& csv, const std::string& rig);

std::string Verify(const std::string& result, const std::string& catalogue, bool brute_force,
                   Watch& watch);

}  // namespace plenum::python

#endif  // PLENUM_PYTHON_CORE_COMPUTATIONS_H_
