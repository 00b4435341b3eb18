#include "api/design/proof_record.h"

#include <map>
#include <optional>

#include "api/design/read/selection.h"
#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

using optimizer::BoxKind;
using optimizer::Configuration;
using optimizer::Family;
using optimizer::ProofBox;
using optimizer::ProofItem;
using optimizer::ProofPlan;
using optimizer::ProofSlot;

constexpr int kNone = -1, kMade = -2;  // ProofItem::part
constexpr std::size_t kMany = 100'000'000;
constexpr int kConstraints = 9;

Json RenderSlot(const ProofSlot& slot, const model::Parts& parts) {
  Json ids = Json::array();
  std::map<int, int> places;  // of parts in `ids`
  const auto place = [&](const ProofItem& item) {
    const auto [entry, fresh] = places.try_emplace(item.part, static_cast<int>(ids.size()));
    if (fresh)
      ids.push_back(item.part == kNone ? Json(nullptr)
                    : item.part == kMade
                        ? Json(kCustomReservoir)
                        : Json(optimizer::BasicsOf(parts, slot.family, item.part).id));
    return entry->second;
  };
  Json choices = Json::array(), dominated = Json::array();
  std::map<std::pair<int, int>, int> choice_at;
  for (const ProofItem& item : slot.choices) {
    choice_at[{item.part, item.quantity}] = static_cast<int>(choices.size());
    choices.push_back({place(item), item.quantity});
  }
  for (const optimizer::ProofDominated& left_out : slot.dominated) {
    Json dominators = Json::array();
    for (const ProofItem& item : left_out.dominators)
      dominators.push_back(choice_at.at({item.part, item.quantity}));
    dominated.push_back({place(left_out.item), left_out.item.quantity, std::move(dominators)});
  }
  return {{"family", optimizer::Name(slot.family)},
          {"group", slot.group < 0 ? Json(nullptr) : Json(slot.group)},
          {"ids", std::move(ids)},
          {"choices", std::move(choices)},
          {"dominated", std::move(dominated)}};
}

Json RenderBox(const ProofBox& box) {
  const int kind = static_cast<int>(box.kind);
  switch (box.kind) {
    case BoxKind::kSplit:
      return {kind, box.slot, box.middle};
    case BoxKind::kInfeasible:
      return {kind, static_cast<int>(box.constraint)};
    case BoxKind::kDesign:
      return {kind, box.design};
    case BoxKind::kRefuted:
      return Json::array({kind});
    default:
      return {kind, Number(box.bound)};
  }
}

// The whole number at a place of a list, in [low, high].
std::optional<int> WholeAt(const Json& list, std::size_t place, int low, int high) {
  if (!list.is_array() || list.size() <= place || !list[place].is_number_integer())
    return std::nullopt;
  const auto number = list[place].get<std::int64_t>();
  if (number < low || number > high) return std::nullopt;
  return static_cast<int>(number);
}

std::optional<ProofBox> ParseBox(const Json& json) {
  const auto kind = WholeAt(json, 0, 0, 8);
  if (!kind) return std::nullopt;
  ProofBox box;
  box.kind = static_cast<BoxKind>(*kind);
  const auto first = WholeAt(json, 1, 0,
                             box.kind == BoxKind::kInfeasible ? kConstraints - 1
                             : box.kind == BoxKind::kSplit    ? 30'000
                                                              : 1'000'000);
  const auto middle = WholeAt(json, 2, 0, static_cast<int>(kMany));
  switch (box.kind) {
    case BoxKind::kSplit:
      if (!first || !middle) return std::nullopt;
      box.slot = static_cast<std::int16_t>(*first);
      box.middle = *middle;
      return box;
    case BoxKind::kInfeasible:
      if (!first) return std::nullopt;
      box.constraint = static_cast<optimizer::Constraint>(*first);
      return box;
    case BoxKind::kDesign:
      if (!first) return std::nullopt;
      box.design = *first;
      return box;
    case BoxKind::kRefuted:
      return box;
    default:
      if (json.size() != 2 || !(json[1].is_number() || json[1].is_null())) return std::nullopt;
      box.bound = json[1].is_null() ? optimizer::kUnlimited : json[1].get<double>();
      return box;
  }
}

template <typename Enum, std::size_t size>
std::map<std::string, Enum> NamesOf(const Enum (&values)[size]) {
  std::map<std::string, Enum> names;
  for (const Enum value : values) names[optimizer::Name(value)] = value;
  return names;
}

template <typename Enum>
Enum ReadName(Reader& reader, const char* field, const std::map<std::string, Enum>& names) {
  std::vector<std::string> allowed;
  allowed.reserve(names.size());
  for (const auto& [name, value] : names) allowed.push_back(name);
  const std::string chosen = reader.Choice(field, allowed);
  return chosen.empty() ? names.begin()->second : names.at(chosen);
}

ProofSlot ReadSlot(Reader& reader, Configuration configuration, const model::Parts& parts) {
  std::map<std::string, Family> families;
  for (const optimizer::FamilySpec& spec : optimizer::Families())
    families[spec.name] =
        optimizer::FamilyIn(configuration, optimizer::CatalogueFamily(spec.family));
  ProofSlot slot{ReadName(reader, "family", families), -1, {}, {}};
  if (reader.Has("group")) slot.group = reader.Integer("group", 0, 1000);
  std::map<std::string, int> part_of;
  for (int part = 0; part < optimizer::FamilySize(parts, slot.family); ++part)
    part_of.emplace(optimizer::BasicsOf(parts, slot.family, part).id, part);
  std::vector<int> ids;
  for (const Element& id : reader.List("ids", 0, kMany)) {
    if (id.value->is_null()) {
      ids.push_back(kNone);
    } else if (*id.value == kCustomReservoir && optimizer::SpecOf(slot.family).made_to_measure) {
      ids.push_back(kMade);
    } else {
      const auto found =
          id.value->is_string() ? part_of.find(id.value->get<std::string>()) : part_of.end();
      if (found == part_of.end())
        reader.errors().push_back({id.pointer, "is no allowed part of the family"});
      ids.push_back(found == part_of.end() ? kNone : found->second);
    }
  }
  const auto item = [&](const Element& element) {
    const auto id = WholeAt(*element.value, 0, 0, static_cast<int>(ids.size()) - 1);
    const auto quantity = WholeAt(*element.value, 1, 0, 1000);
    if (!id || !quantity) {
      reader.errors().push_back({element.pointer, "must start with a place in ids and a quantity"});
      return ProofItem{};
    }
    return ProofItem{ids[*id], *quantity};
  };
  for (const Element& choice : reader.List("choices", 0, kMany))
    slot.choices.push_back(item(choice));
  for (const Element& left_out : reader.List("dominated", 0, kMany)) {
    optimizer::ProofDominated dominated{item(left_out), {}};
    if (left_out.value->size() != 3 || !(*left_out.value)[2].is_array()) {
      reader.errors().push_back({left_out.pointer, "must end with a list of dominators"});
      continue;
    }
    const Json& list = (*left_out.value)[2];
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto at = WholeAt(list, i, 0, static_cast<int>(slot.choices.size()) - 1);
      if (at)
        dominated.dominators.push_back(slot.choices[*at]);
      else
        reader.errors().push_back({left_out.pointer, "names a dominator that is not a choice"});
    }
    slot.dominated.push_back(std::move(dominated));
  }
  reader.Finish();
  return slot;
}

}  // namespace

Json RenderRecord(const optimizer::ProofRecord& record, const model::Parts& parts) {
  Json plans = Json::array();
  for (const ProofPlan& plan : record.plans) {
    Json slots = Json::array(), boxes = Json::array();
    for (const ProofSlot& slot : plan.slots) slots.push_back(RenderSlot(slot, parts));
    for (const ProofBox& box : plan.boxes) boxes.push_back(RenderBox(box));
    plans.push_back({{"configuration", optimizer::Name(plan.configuration)},
                     {"equal_flow", plan.equal_flow},
                     {"tie", plan.tie},
                     {"slots", std::move(slots)},
                     {"boxes", std::move(boxes)}});
  }
  return {{"count", record.count}, {"plans", std::move(plans)}};
}

optimizer::ProofRecord ReadRecord(Reader& reader, const model::Parts& parts) {
  static const auto kConfigurations = NamesOf<Configuration>(
      {Configuration::kCylinder, Configuration::kCo2, Configuration::kCompressor,
       Configuration::kMains, Configuration::kTank, Configuration::kDirectPump,
       Configuration::kVacuumPump, Configuration::kDirectVacuumPump, Configuration::kTankAndPump,
       Configuration::kEjector, Configuration::kDirectEjector});
  optimizer::ProofRecord record;
  record.count = reader.Integer("count", 1, 1'000'000);
  for (const Element& element :
       reader.List("plans", 0, std::size_t{2} * optimizer::kConfigurations)) {
    Reader given(element, reader.errors());
    ProofPlan plan;
    plan.configuration = ReadName(given, "configuration", kConfigurations);
    plan.equal_flow = given.Bool("equal_flow", false);
    plan.tie = given.Number("tie", {0, 1e12});
    for (const Element& slot : given.List("slots", 0, 1000)) {
      Reader slot_reader(slot, reader.errors());
      plan.slots.push_back(ReadSlot(slot_reader, plan.configuration, parts));
      plan.own_regulators =
          plan.own_regulators ||
          (plan.slots.back().family == Family::kRegulator && plan.slots.back().group >= 0);
    }
    for (const Element& box : given.List("boxes", 0, kMany)) {
      const auto parsed = ParseBox(*box.value);
      if (parsed)
        plan.boxes.push_back(*parsed);
      else
        reader.errors().push_back({box.pointer, "is no box"});
    }
    given.Finish();
    record.plans.push_back(std::move(plan));
  }
  reader.Finish();
  return record;
}

}  // namespace plenum::api
