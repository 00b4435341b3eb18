// Why a ranked list looks as it does: what each requirement costs, and what would have to change
// for a lower rank to come first. By exact searches anew, within a time limit; nothing is
// extrapolated.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_PRICES_H_
#define PLENUM_OPTIMIZER_EXPLAIN_PRICES_H_

#include <optional>
#include <string>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

inline constexpr double kPriceShare = 0.1;  // a requirement is priced by loosening it this much

// The problem solved again with one requirement looser.
struct Price {
  std::string requirement;  // JSON pointer
  double required = 0.0, loosened = 0.0;
  Status status = Status::kCancelled;  // of the search; without kOptimal `objective` may fall yet
  std::optional<double> objective;     // of the best design found
  double lower_bound = 0.0;            // no design has a lower objective
};

// Objectives are to be compared with the first design of the list for `problem`.
std::vector<Price> FindPrices(const Problem& problem, const SearchOptions& options);

// A change that makes a design of the list the first.
struct PartFlip {
  Family family;
  std::string id;
  double share = 0.0;  // of the part's number by which it must fall (mass, volume, price at once)
  bool confirmed = false;  // a proved search with the part so changed lists the design first
};
struct RequirementFlip {
  std::string requirement;
  double required = 0.0, tightened = 0.0;
  bool confirmed = false;  // a proved search with this value lists the design first
};
struct Flip {
  int rank = 0;
  double objective_gap = 0.0;  // to the first design
  std::vector<PartFlip> parts;
  std::vector<RequirementFlip> requirements;
  bool complete = false;  // all parts and requirements were looked at in time
};

// For ranks 2 to `ranks` of `designs`, the proved list for `problem`.
// * Parts: how much lighter, smaller and cheaper one part of the design would have to be, all three
//   by the same share, wherever it is used. Objectives of other designs fall with their own number
//   of pieces; a search with the part so changed confirms the design first or finds another, from
//   which the share is computed anew. Parts for which no share does are left out.
// * Requirements: the least tightening, by at most a factor of 2, at which every better design
// fails
//   and this one, sized anew, does not. By halving to 0.1 %, then confirmed by a search.
std::vector<Flip> FindFlips(const Problem& problem, const std::vector<Design>& designs, int ranks,
                            const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_PRICES_H_
