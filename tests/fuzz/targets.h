// What is fuzzed: each takes bytes from anywhere and must neither crash nor run on.
#ifndef PLENUM_TESTS_FUZZ_TARGETS_H_
#define PLENUM_TESTS_FUZZ_TARGETS_H_

#include <cstdlib>
#include <string_view>

namespace plenum::fuzz {

// What must hold in a fuzzer, where no test library listens.
inline void Require(bool holds) {
  if (!holds) std::abort();
}

void Requirements(std::string_view text);
void Measurement(std::string_view text);
void Csv(std::string_view text);    // rows of parts; the first byte chooses the family
void Query(std::string_view text);  // "name=value&…" of a list of parts
void Frame(std::string_view text);  // bytes of a connection

}  // namespace plenum::fuzz

#endif  // PLENUM_TESTS_FUZZ_TARGETS_H_
