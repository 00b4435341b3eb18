// What each number of a part does for the search. One table per family (part_tables.h) says it for
// all who ask: corners of boxes, dominance, and the checks of `verify`, each with rules of its own.
// Values only.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PART_FIELDS_H_
#define PLENUM_OPTIMIZER_PROBLEM_PART_FIELDS_H_

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "model/flow/parts.h"

namespace plenum::optimizer {

enum class Use : std::uint8_t {
  kMore,        // more is better
  kLess,        // less is better
  kRating,      // a pressure that the part stands: more is better, up to what any source gives
  kBoth,        // better for one requirement and worse for another: both ends count
  kMate,        // decides which parts fit together
  kFlow,        // conductance C and ratio b: more is better
  kSharedFlow,  // the same in a line: more may take air from other lines of the source
  kRule         // asked by a rule of the family alone
};

// What of several pieces counts.
enum class Pieces : std::uint8_t { kEach, kSum };

using FieldValue = std::variant<double, std::string_view, model::FlowElement>;

struct PartField {
  std::string_view name;  // in the catalogue; of a flow element that of its conductance
  Use use;
  FieldValue (*of)(const model::Parts& parts, int part);  // SI; of one piece
  Pieces pieces = Pieces::kEach;
  // Weight of the number's logarithm where trees divide boxes, and what is added to the number
  // before: its rough effect on a design's objective. Any weights would be right.
  double weight = 0.0, weight_offset = 0.0;
  double ratio_weight = 0.0;  // of a flow element: weight of b
};

// Reads what `get`, a member or a function of a part, gives of part `i` in `list`.
template <auto list, auto get>
FieldValue ValueIn(const model::Parts& parts, int i) {
  decltype(auto) value = std::invoke(get, (parts.*list)[i]);
  if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
    return static_cast<double>(value);
  else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::string>)
    return std::string_view(value);
  else
    return value;
}

// The field of that name; no such field is an error of compilation.
consteval PartField FieldNamed(std::span<const PartField> fields, std::string_view name) {
  for (const PartField& field : fields)
    if (field.name == name) return field;
  throw "no such field";
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PART_FIELDS_H_
