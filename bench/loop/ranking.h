// Lists of designs of a catalogue, and what a design is in truth.
#ifndef PLENUM_BENCH_LOOP_RANKING_H_
#define PLENUM_BENCH_LOOP_RANKING_H_

#include <optional>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"

namespace plenum::bench {

// designs/1 of requirements, as `plenum design` answers; throws where they are refused.
api::Json Rank(const api::Json& requirements, const std::vector<catalog::Part>& rows);

// The first design of a list, or null.
api::Json FirstOf(const api::Json& list);

// By the parts' ids and quantities.
bool SameParts(const api::Json& design, const api::Json& other);

struct Verdict {
  bool meets = false;
  std::string missed = {};  // the requirement missed most, "works" where the design does not; ""
  double margin = 0.0;      // of that requirement, relative
  std::optional<double> objective = {};  // mass, kg
};

// A listed design at its settings, as `plenum evaluate` has it with the true numbers.
Verdict Judge(const api::Json& requirements, const api::Json& design,
              const std::vector<catalog::Part>& truth);

// Mass of the lightest design that `truth` allows, kg; none where none is proved.
std::optional<double> BestOf(const api::Json& requirements,
                             const std::vector<catalog::Part>& truth);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_LOOP_RANKING_H_
