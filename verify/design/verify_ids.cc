#include "verify/design/verify_ids.h"

namespace plenum::verify {

Ids IdsOf(const Design& design) {
  Ids ids;
  for (const Choice& choice : design.parts)
    ids.emplace_back(choice.id, choice.group < 0 ? static_cast<int>(choice.quantity) : 1);
  return ids;
}

std::string Text(const Ids& ids) {
  std::string text;
  for (const auto& [id, quantity] : ids) {
    if (!text.empty()) text += ", ";
    if (quantity > 1) text += std::to_string(quantity) + " × ";
    text += id;
  }
  return text;
}

}  // namespace plenum::verify
