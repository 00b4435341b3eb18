// One choice's numbers, as the table of its family says: of so many pieces, and no more of a rating
// than any source gives.
#ifndef PLENUM_OPTIMIZER_CHOICES_PLANT_PART_NUMBERS_H_
#define PLENUM_OPTIMIZER_CHOICES_PLANT_PART_NUMBERS_H_

#include <algorithm>

#include "optimizer/choices/corner.h"
#include "optimizer/problem/part_fields.h"

namespace plenum::optimizer {

struct PartNumbers {
  const model::Parts& parts;
  int part;
  double pieces = 1.0;
  double useful_max_pa = kUnlimited;  // ratings beyond it are all the same

  // A number that is one; of a rating what is useful.
  double Number(const PartField& field) const {
    const double number = Rated(field);
    return field.use == Use::kRating ? std::min(number, useful_max_pa) : number;
  }
  // The same without that limit.
  double Rated(const PartField& field) const {
    const double number = std::get<double>(field.of(parts, part));
    return field.pieces == Pieces::kSum ? pieces * number : number;
  }
  model::FlowElement Flow(const PartField& field) const {
    return std::get<model::FlowElement>(field.of(parts, part));
  }
};

// The numbers of a corner that come from the fields of a part; what mates and what a rule of the
// family finds stays as it is.
void SetNumbers(const PartNumbers& numbers, TubeCorner& corner);
void SetNumbers(const PartNumbers& numbers, FittingCorner& corner);
void SetNumbers(const PartNumbers& numbers, ValveCorner& corner);
void SetNumbers(const PartNumbers& numbers, RegulatorCorner& corner);
void SetNumbers(const PartNumbers& numbers, BottleCorner& corner);
void SetNumbers(const PartNumbers& numbers, CompressorCorner& corner);
void SetNumbers(const PartNumbers& numbers, BatteryCorner& corner);
void SetNumbers(const PartNumbers& numbers, ReservoirCorner& corner);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_PART_NUMBERS_H_
