// Targets that go through to the computation: a request is read and, where it is right, run on a
// catalogue of one part a family within a small limit. What comes must be an answer that can be
// written down, or named errors.
#ifndef PLENUM_TESTS_FUZZ_COMPUTATIONS_H_
#define PLENUM_TESTS_FUZZ_COMPUTATIONS_H_

#include <string_view>

#include "api/json/json.h"

namespace plenum::fuzz {

void Design(std::string_view text);
void Evaluation(std::string_view text);
void Simulation(std::string_view text);
void Diagnosis(std::string_view text);
void Recording(std::string_view text);  // CSV of any dialect, measured on a small rig
void Import(std::string_view text);     // CSV of a family by the first byte; then a search with it
void Verify(std::string_view text);     // an answer, as saved or changed
api::Parsed<api::Json> VerifyWithinLimit(const api::Json& answer);

}  // namespace plenum::fuzz

#endif  // PLENUM_TESTS_FUZZ_COMPUTATIONS_H_
