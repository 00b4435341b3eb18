// What dominance compares of a choice, as the table of its family says it.
#ifndef PLENUM_OPTIMIZER_CHOICES_PLANT_COMPARED_H_
#define PLENUM_OPTIMIZER_CHOICES_PLANT_COMPARED_H_

#include <cstdint>
#include <string>
#include <unordered_map>

#include "optimizer/choices/dominance.h"
#include "optimizer/choices/plant/part_numbers.h"

namespace plenum::optimizer {

// Numbers the choices of a family from 0 by what must be the same for one to dominate another:
// fields of which both ends count, and with `mates` those by which parts fit together.
class MatingClasses {
 public:
  int Of(const PartNumbers& numbers, std::span<const PartField> fields, bool mates) {
    key_.clear();
    for (const PartField& field : fields) {
      if (field.use == Use::kBoth) AddNumber(numbers.Rated(field));
      if (field.use == Use::kMate && mates) AddMate(field.of(numbers.parts, numbers.part));
    }
    return number_.try_emplace(key_, size()).first->second;
  }
  int size() const { return static_cast<int>(number_.size()); }

 private:
  void AddNumber(double number) {
    key_.append(reinterpret_cast<const char*>(&number), sizeof(number));
  }
  void AddMate(const FieldValue& value) {
    if (const auto* text = std::get_if<std::string_view>(&value)) {
      AddNumber(static_cast<double>(text->size()));
      key_.append(*text);
    } else {
      AddNumber(std::get<double>(value));
    }
  }

  std::string key_;
  std::unordered_map<std::string, int> number_;
};

// Where only the same flow compares, as in proof.h: of what is shared, of all. kPadded: nowhere, in
// a family of which others are kAlways, so that all have as many losses.
enum class EqualFlow : std::uint8_t { kNever, kPadded, kShared, kAlways };

// C, b and m as losses; `equal`: also the other way round, so that only the same flow compares.
inline void AddFlow(const model::FlowElement& flow, bool equal, bool padded, Losses& losses) {
  losses.push_back(-flow.sonic_conductance_m3_per_s_pa);
  losses.push_back(-flow.critical_ratio);
  losses.push_back(flow.subsonic_index);
  if (!equal && !padded) return;
  losses.push_back(equal ? flow.sonic_conductance_m3_per_s_pa : 0.0);
  losses.push_back(equal ? flow.critical_ratio : 0.0);
  losses.push_back(equal ? -flow.subsonic_index : 0.0);
}

inline void AddLosses(const PartNumbers& numbers, std::span<const PartField> fields,
                      EqualFlow equal, Losses& losses) {
  for (const PartField& field : fields) switch (field.use) {
      case Use::kMore:
      case Use::kRating:
        losses.push_back(-numbers.Rated(field));
        break;
      case Use::kLess:
        losses.push_back(numbers.Rated(field));
        break;
      case Use::kFlow:
        AddFlow(numbers.Flow(field), equal == EqualFlow::kAlways, false, losses);
        break;
      case Use::kSharedFlow:
        AddFlow(numbers.Flow(field), equal >= EqualFlow::kShared, equal == EqualFlow::kPadded,
                losses);
        break;
      case Use::kBoth:
      case Use::kMate:
      case Use::kRule:
        break;
    }
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_COMPARED_H_
